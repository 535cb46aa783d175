# Compiler cache, warnings and sanitizers, the same for every target.
find_program(CCACHE ccache)
if(CCACHE)
  # Paths below the source count as relative: another clone finds the same objects.
  set(launcher ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${launcher})
  set(CMAKE_C_COMPILER_LAUNCHER ${launcher})
endif()

add_library(vpdr_warnings INTERFACE)
target_compile_options(vpdr_warnings INTERFACE -Wall -Wextra -Wshadow -Werror)
# g++ 12 reports uninitialised and out-of-bounds values in Eigen that are neither, and overlaps in
# "literal" + std::string (GCC PR 105329).
target_compile_options(vpdr_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-array-bounds -Wno-restrict>)

if(VPDR_SANITIZE)
  add_compile_options(-fsanitize=${VPDR_SANITIZE} -fno-omit-frame-pointer -O1 -g1)
  add_link_options(-fsanitize=${VPDR_SANITIZE})
  if(VPDR_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize-recover=undefined)
  endif()
endif()

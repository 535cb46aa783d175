# vpdr_add_library(NAME SOURCES a.cpp ... LIBS x y ...): a static library of the project.
# Headers are included from the roots libs/ and services/: "core/samples.hpp", "pdr/core/pdr.hpp".
function(vpdr_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR}/libs ${CMAKE_SOURCE_DIR}/services)
  target_link_libraries(${name} PUBLIC ${ARG_LIBS} PRIVATE vpdr_warnings)
endfunction()

# vpdr_add_executable(NAME SOURCES a.cpp ... LIBS x y ...): a program in build/bin.
function(vpdr_add_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} vpdr_warnings)
endfunction()

# vpdr_add_test(NAME SOURCES a.cpp ... LIBS x y ... LABELS unit): one GoogleTest program, one ctest
# entry. VPDR_DATA names the recordings; without them the tests that need them skip.
function(vpdr_add_test name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LIBS;LABELS;ENVIRONMENT" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(VPDR_SANITIZE)
    math(EXPR ARG_TIMEOUT "5 * ${ARG_TIMEOUT}")
  endif()
  add_executable(${name} ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/bin)
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_compile_definitions(${name} PRIVATE VPDR_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
                                             VPDR_BIN_DIR="${CMAKE_BINARY_DIR}/bin")
  target_link_libraries(${name} PRIVATE ${ARG_LIBS} vpdr_warnings GTest::gmock_main)
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES LABELS "${ARG_LABELS}" TIMEOUT ${ARG_TIMEOUT}
                                          ENVIRONMENT "${ARG_ENVIRONMENT}")
endfunction()

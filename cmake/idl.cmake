# vpdr_add_idl_library(NAME PACKAGES a b ...): a static library of the types of a.idl, b.idl, ... in
# the current directory, generated into build/idl, and of the texts in msg/a/*.msg.
#
# Only the types themselves are compiled. The *PubSubTypes that fastddsgen writes as well are not:
# libs/dds has one type support for all types, and the build stays light.
find_package(fastcdr REQUIRED)
find_package(fastrtps REQUIRED)
find_program(FASTDDSGEN fastddsgen REQUIRED)

function(vpdr_add_idl_library name)
  cmake_parse_arguments(ARG "" "" "PACKAGES" ${ARGN})
  set(out ${CMAKE_BINARY_DIR}/idl)
  set(scratch ${out}/preprocessed)
  file(MAKE_DIRECTORY ${out} ${scratch})
  foreach(package IN LISTS ARG_PACKAGES)
    list(APPEND idl_files ${CMAKE_CURRENT_SOURCE_DIR}/${package}.idl)
    list(APPEND sources ${out}/${package}.cxx)
    list(APPEND headers ${out}/${package}.h)
  endforeach()
  # fastddsgen writes the files of included packages again: one call for all of them, never two
  # at a time. It preprocesses into a folder under the same names every time: with the default, /tmp,
  # two checkouts that build at once would mix their types.
  add_custom_command(
    OUTPUT ${sources} ${headers}
    COMMAND ${FASTDDSGEN} -typeros2 -cs -replace -t ${scratch} -d ${out} ${idl_files} > ${out}/fastddsgen.log
    DEPENDS ${idl_files}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
    COMMENT "Generating C++ from idl/" VERBATIM)

  file(GLOB msg_files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/msg/*/*.msg)
  set(embed ${CMAKE_SOURCE_DIR}/cmake/embed_idl.cmake)
  add_custom_command(
    OUTPUT ${out}/idl_texts.cpp
    COMMAND ${CMAKE_COMMAND} "-DIDL_FILES=${idl_files}" "-DMSG_FILES=${msg_files}"
            -DOUTPUT=${out}/idl_texts.cpp -P ${embed}
    DEPENDS ${idl_files} ${msg_files} ${embed}
    COMMENT "Embedding the message definitions" VERBATIM)

  add_library(${name} STATIC ${sources} ${out}/idl_texts.cpp)
  target_include_directories(${name} SYSTEM PUBLIC ${out})
  target_compile_options(${name} PRIVATE -w)
  target_link_libraries(${name} PUBLIC fastcdr)
endfunction()

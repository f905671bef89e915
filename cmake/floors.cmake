# floor(NAME [USES lower floors...] [SOURCES files in src/NAME...] [LIBRARIES public...] [PRIVATE private...])
#
# Makes the library trace_NAME. Headers are written #include "NAME/file.h"; each floor's include root is
# a folder that holds nothing but a link NAME -> src/NAME, so only the floors used are visible.
function(floor NAME)
  cmake_parse_arguments(ARG "" "" "USES;SOURCES;LIBRARIES;PRIVATE" ${ARGN})
  set(root ${CMAKE_BINARY_DIR}/floors/${NAME})
  file(MAKE_DIRECTORY ${root})
  file(CREATE_LINK ${CMAKE_SOURCE_DIR}/src/${NAME} ${root}/${NAME} SYMBOLIC)

  set(target trace_${NAME})
  list(TRANSFORM ARG_USES PREPEND trace_)
  if(ARG_SOURCES)
    list(TRANSFORM ARG_SOURCES PREPEND ${CMAKE_SOURCE_DIR}/src/${NAME}/)
    add_library(${target} STATIC ${ARG_SOURCES})
    target_include_directories(${target} PUBLIC ${root})
    target_link_libraries(${target} PUBLIC ${ARG_USES} ${ARG_LIBRARIES} PRIVATE ${ARG_PRIVATE})
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${root})
    target_link_libraries(${target} INTERFACE ${ARG_USES} ${ARG_LIBRARIES})
  endif()
endfunction()

# floor(NAME [LIGHT] [USES lower floors...] [LIBRARIES public...] [PRIVATE private...] [PRECOMPILE headers...])
#
# Makes the library trace_NAME, for other projects Trace::NAME, of the .cpp files below src/NAME; those called *_avx*.cpp
# are added where the processor has what they need. Headers are written #include "NAME/file.h"; each floor's include root is
# a folder that holds nothing but a link NAME -> src/NAME, so only the floors used are visible. PRECOMPILE names the headers
# that many of its files include; a floor without any shares those of base.
# LIGHT: nothing in it is hot.
function(floor NAME)
  cmake_parse_arguments(ARG "LIGHT" "" "USES;LIBRARIES;PRIVATE;PRECOMPILE" ${ARGN})
  set(root ${PROJECT_BINARY_DIR}/floors/${NAME})
  file(MAKE_DIRECTORY ${root})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src/${NAME} ${root}/${NAME} SYMBOLIC)

  set(target trace_${NAME})
  list(TRANSFORM ARG_USES PREPEND trace_)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${NAME}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_avx[0-9]+\\.cpp$|/main\\.cpp$")
  add_library(${target} STATIC ${sources})
  target_include_directories(${target} PUBLIC ${root})
  target_link_libraries(${target} PUBLIC ${ARG_USES} ${ARG_LIBRARIES} PRIVATE ${ARG_PRIVATE})
  target_compile_features(${target} PUBLIC cxx_std_20)
  if(ARG_LIGHT)
    target_compile_options(${target} PRIVATE ${lightlyOptimised})
  endif()
  if(NAME MATCHES "app|cli")  # LOCAL ONLY
    target_compile_options(${target} PRIVATE -O0)
  endif()
  if(NAME MATCHES "scene|shading|render|formats")  # LOCAL ONLY
    target_compile_options(${target} PRIVATE -O1)
  endif()
  if(ARG_PRECOMPILE OR NAME STREQUAL base)
    precompile(${target} ${ARG_PRECOMPILE})
  else()
    target_precompile_headers(${target} REUSE_FROM trace_base)
  endif()
  add_library(Trace::${NAME} ALIAS ${target})
endfunction()

# One folder of src/base/os is compiled.
if(WIN32)
  set(otherSystem posix)
else()
  set(otherSystem windows)
endif()
# One of the studio's hosts is compiled: src/studio/host_*.cpp.
if(EMSCRIPTEN)
  set(otherHost desktop)
else()
  set(otherHost web)
endif()

# floor(NAME [LIGHT] [ROOMS] [USES lower floors...] [LIBRARIES public...] [PRIVATE private...] [PRECOMPILE headers...]
#       [PRECOMPILE_AS lower floor] [HOT files...] [COLD files...])
#
# Makes the library trace_NAME, for other projects Trace::NAME, of the .cpp files below src/NAME; those called *_avx*.cpp
# are added where the processor has what they need. Headers are written #include "NAME/file.h"; each floor's include root is
# a folder that holds nothing but a link NAME -> src/NAME, so only the floors used are visible. PRECOMPILE names the headers
# that many of its files include; a floor without any shares those of base, or of the floor that PRECOMPILE_AS names.
# ROOMS: its folders are compiled together, since each alone is small.
# LIGHT: nothing in it is hot but the files of HOT; else all is but those of COLD. What is not hot is compiled in less time.
function(floor NAME)
  cmake_parse_arguments(ARG "LIGHT;ROOMS" "PRECOMPILE_AS" "USES;LIBRARIES;PRIVATE;PRECOMPILE;HOT;COLD" ${ARGN})
  set(root ${PROJECT_BINARY_DIR}/floors/${NAME})
  file(MAKE_DIRECTORY ${root})
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/src/${NAME} ${root}/${NAME} RESULT unable SYMBOLIC)
  if(unable)  # Windows lets only some users make links
    set(root ${PROJECT_SOURCE_DIR}/src)
  endif()

  set(target trace_${NAME})
  list(TRANSFORM ARG_USES PREPEND trace_)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/${NAME}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "_avx[0-9]+\\.cpp$|/main\\.cpp$|/os/${otherSystem}/|_${otherHost}\\.cpp$")
  list(TRANSFORM ARG_HOT PREPEND ${PROJECT_SOURCE_DIR}/src/${NAME}/)
  list(REMOVE_ITEM sources ${ARG_HOT})
  add_library(${target} STATIC ${sources})
  set(parts ${target})
  if(ARG_LIGHT)
    target_compile_options(${target} PRIVATE ${lightlyOptimised})
  elseif(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${target} PRIVATE --param=inline-unit-growth=200)  # or files compiled together get less inlined
  endif()
  if(ARG_HOT)
    add_library(${target}_hot OBJECT ${ARG_HOT})
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_hot>)
    list(APPEND parts ${target}_hot)
  endif()
  foreach(part IN LISTS parts)
    target_include_directories(${part} PUBLIC ${root})
    target_link_libraries(${part} PUBLIC ${ARG_USES} ${ARG_LIBRARIES} PRIVATE ${ARG_PRIVATE})
    target_compile_features(${part} PUBLIC cxx_std_20)
    together(${part} ${ARG_ROOMS})
  endforeach()
  list(TRANSFORM ARG_COLD PREPEND src/${NAME}/)
  # Without precompiled headers: GCC 12 breaks where those were made with another optimisation.
  set_source_files_properties(${ARG_COLD} PROPERTIES COMPILE_OPTIONS "${lightlyOptimised}" SKIP_PRECOMPILE_HEADERS ON)
  if(ARG_PRECOMPILE OR NAME STREQUAL base)
    precompile(${target} ${ARG_PRECOMPILE})
  elseif(ARG_PRECOMPILE_AS)
    target_precompile_headers(${target} REUSE_FROM trace_${ARG_PRECOMPILE_AS})
  else()
    target_precompile_headers(${target} REUSE_FROM trace_base)
  endif()
  add_library(Trace::${NAME} ALIAS ${target})
endfunction()

# The library that other programs link (include/traceray, docs/cpp.md) and its Python module (docs/python.md).
#
# It is a shared library: a static one would hand OpenEXR, zlib and ten archives to whoever links it. The floors are
# compiled once for everything, so that all of them are position-independent. That costs `ray` next to nothing, since names are
# hidden (no call looks them up at run time) and threads' variables are found as in a program (docs/developers/performance.md).
# All names that others see begin with this one: `trace` is a module of Python, libtrace another library, `ray` a package.
set(TRACE_LIBRARY_NAME traceray)

option(TRACE_LIBRARY "the library for other programs, and its Python module where pybind11 is" ON)  # not under sanitizers
if(TRACE_LIBRARY)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  set(CMAKE_CXX_VISIBILITY_PRESET hidden)
  set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
  add_compile_options(-fno-semantic-interposition -ftls-model=initial-exec)
endif()

# The floor `library`, and what is made of it. To be called after floor(app ...).
function(trace_library)
  include(GNUInstallDirs)
  floor(library LIGHT USES app PRECOMPILE_AS app)
  target_include_directories(trace_library PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>)

  if(NOT TRACE_LIBRARY)
    return()
  endif()

  set(exports ${PROJECT_SOURCE_DIR}/cmake/library.map)
  add_library(${TRACE_LIBRARY_NAME} SHARED $<TARGET_OBJECTS:trace_library>)
  add_library(Trace::Trace ALIAS ${TRACE_LIBRARY_NAME})
  target_link_libraries(${TRACE_LIBRARY_NAME} PRIVATE trace_app)
  target_include_directories(${TRACE_LIBRARY_NAME} INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${TRACE_LIBRARY_NAME} INTERFACE cxx_std_20)
  if(NOT APPLE AND NOT WIN32)  # also what templates of the standard library made stays inside
    target_link_options(${TRACE_LIBRARY_NAME} PRIVATE -Wl,--version-script=${exports})
  endif()
  set_target_properties(${TRACE_LIBRARY_NAME} PROPERTIES
    LINKER_LANGUAGE CXX EXPORT_NAME Trace LINK_DEPENDS ${exports}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)

  if(PROJECT_IS_TOP_LEVEL)
    trace_python()
  endif()
  if(TRACE_INSTALL)
    trace_install_library()
  endif()
endfunction()

# The module of the system's Python, where pybind11 and numpy are.
function(trace_python)
  if(EXISTS /usr/bin/python3 AND NOT DEFINED Python3_EXECUTABLE)
    set(Python3_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python3 3.9 COMPONENTS Interpreter Development.Module QUIET)
  find_package(pybind11 2.6 QUIET)
  if(NOT Python3_Development.Module_FOUND OR NOT pybind11_FOUND)
    message(STATUS "without the Python module: it needs python3-dev and pybind11-dev; ./dev setup all installs them")
    return()
  endif()
  set(package ${PROJECT_BINARY_DIR}/python/${TRACE_LIBRARY_NAME})
  python3_add_library(trace_python MODULE WITH_SOABI ${PROJECT_SOURCE_DIR}/python/module.cpp)
  target_link_libraries(trace_python PRIVATE ${TRACE_LIBRARY_NAME} pybind11::headers)
  target_compile_options(trace_python PRIVATE ${lightlyOptimised} -Wno-shadow -Wno-pedantic)
  set_target_properties(trace_python PROPERTIES
    OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${package}
    INSTALL_RPATH "$ORIGIN/../../..;$ORIGIN/../../../${CMAKE_LIBRARY_ARCHITECTURE}")
  # Beside it what is written in Python, and stubs made of the lists of fields.
  add_custom_command(TARGET trace_python POST_BUILD
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${PROJECT_SOURCE_DIR}/python/traceray ${package}
    COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${PROJECT_BINARY_DIR}/python PYTHONDONTWRITEBYTECODE=1
      ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/python/make_stubs.py ${package}/__init__.pyi)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/python/traceray/*.py ${PROJECT_SOURCE_DIR}/python/make_stubs.py)
  set_target_properties(trace_python PROPERTIES LINK_DEPENDS "${sources}")
  set(TRACE_PYTHON ${Python3_EXECUTABLE} CACHE INTERNAL "that the module was built for")
  set(TRACE_PYTHON_MINOR ${Python3_VERSION_MINOR} CACHE INTERNAL "its version behind 3.")
endfunction()

# Components: `library` is what programs run with, `dev` what they are compiled with, `python` the module.
function(trace_install_library)
  include(CMakePackageConfigHelpers)
  set(cmakeDir ${CMAKE_INSTALL_LIBDIR}/cmake/Trace)
  install(TARGETS ${TRACE_LIBRARY_NAME} EXPORT Trace OPTIONAL  # it may not have been asked for
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT dev)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/${TRACE_LIBRARY_NAME} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev)
  install(EXPORT Trace NAMESPACE Trace:: FILE TraceConfig.cmake DESTINATION ${cmakeDir} COMPONENT dev)
  # While the version begins with 0, each minor version may change the face.
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/TraceConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/TraceConfigVersion.cmake DESTINATION ${cmakeDir} COMPONENT dev)
  file(RELATIVE_PATH pkgPrefix ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/library.pc.in ${PROJECT_BINARY_DIR}/${TRACE_LIBRARY_NAME}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${TRACE_LIBRARY_NAME}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT dev)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/c ${PROJECT_SOURCE_DIR}/examples/cpp DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/trace-ray/examples COMPONENT dev)
  if(TARGET trace_python)
    set(pythonDir ${CMAKE_INSTALL_LIBDIR}/python3/dist-packages)
    if(CMAKE_INSTALL_LIBDIR MATCHES "^lib/")  # Debian's own Python looks beside the folder of the architecture
      set(pythonDir lib/python3/dist-packages)
    endif()
    install(TARGETS trace_python OPTIONAL LIBRARY DESTINATION ${pythonDir}/${TRACE_LIBRARY_NAME} COMPONENT python)
    install(DIRECTORY ${PROJECT_BINARY_DIR}/python/${TRACE_LIBRARY_NAME} DESTINATION ${pythonDir} COMPONENT python OPTIONAL
      FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/python DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/trace-ray/examples COMPONENT python)
  endif()
endfunction()

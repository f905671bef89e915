# The packages of ./dev package: one of each component that is named here, for Debian. A further one is a name in the
# list, its variables below, and what cmake/finish_packages.cmake shall do to its files.
set(packaged program doc)
if(TARGET ray-studio)
  list(APPEND packaged studio)
endif()
if(TARGET ${TRACE_LIBRARY_NAME})
  list(APPEND packaged library dev)
endif()
if(TARGET trace_python)
  list(APPEND packaged python)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME trace-ray)
set(CPACK_PACKAGE_VENDOR "The Trace authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own, the first line of its description
set(TRACE_MAINTAINER "The Trace authors <trace-ray@packages.example.org>" CACHE STRING "who answers for the packages")
set(CPACK_PACKAGE_CONTACT "${TRACE_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL ${packaged})
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/finish_packages.cmake)
set(CPACK_TRACE_SOURCE ${PROJECT_SOURCE_DIR})  # for that script

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_THREADS 0)  # as many as there are
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)  # where the Python module finds the library

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME trace-ray)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "trace-ray-studio, trace-ray-doc")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA
    ${PROJECT_SOURCE_DIR}/packaging/debian/postinst ${PROJECT_SOURCE_DIR}/packaging/debian/prerm)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "ray tracer that explains every ray of a pixel
Trace reads the scenes of the graphics courses of Washington, Austin, Hong
Kong, British Columbia, Montreal and Southern California, and meshes such as
OBJ, PLY and glTF, and writes pictures: by Whitted's ray tracing, by path
tracing from one end or both, by photon maps or by Metropolis light transport.

For any pixel it prints all rays with their numbers. It also looks for likely
mistakes in scenes, and compares pictures.

The program is called trace-ray, and ray where no other program is.")

set(CPACK_DEBIAN_STUDIO_PACKAGE_NAME trace-ray-studio)
set(CPACK_DEBIAN_STUDIO_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_STUDIO_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_STUDIO_PACKAGE_DEPENDS "trace-ray (= ${PROJECT_VERSION}), libgl1")  # which GLFW opens by itself
set(CPACK_DEBIAN_STUDIO_PACKAGE_RECOMMENDS "fonts-roboto-unhinted | fonts-dejavu-core")
set(CPACK_DEBIAN_STUDIO_DESCRIPTION "window that renders scenes and shows the rays of any pixel
The studio of Trace, a ray tracer: the picture as it is rendered, every option
and field of the scene with undo, a reference to compare with, and for the
pixel that is clicked all of its rays, in space and as a tree with their
numbers.")

set(CPACK_DEBIAN_DOC_PACKAGE_NAME trace-ray-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_DESCRIPTION "ray tracer that explains every ray of a pixel - manual
The pages of Trace, a ray tracer, with their pictures: the language of scenes,
shapes, materials, lights, ways to find light, and where courses differ.

The pages are in Markdown; README.md is the first.")

# While the version begins with 0, each may change the interface: whoever links the library needs this version of it.
set(libraryPackage lib${TRACE_LIBRARY_NAME}${PROJECT_VERSION_MAJOR})
set(sameLibrary "${libraryPackage} (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${libraryPackage})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/triggers)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION "ray tracer that explains every ray of a pixel - library
Trace reads or builds scenes, renders them by six integrators, and explains
each pixel by its rays.

Programs that use Trace need this library.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME lib${TRACE_LIBRARY_NAME}-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "${sameLibrary}")
set(CPACK_DEBIAN_DEV_DESCRIPTION "ray tracer that explains every ray of a pixel - development files
The C++ header of Trace, a ray tracer, with its CMake package, its file for
pkg-config, and five examples of ten lines.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-${TRACE_LIBRARY_NAME})
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/python/prerm)
if(TARGET trace_python)  # whose file name has the version of the interpreter
  math(EXPR nextPython "${TRACE_PYTHON_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "${sameLibrary}, python3 (>= 3.${TRACE_PYTHON_MINOR}), python3 (<< 3.${nextPython}), python3-numpy")
endif()
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "ray tracer that explains every ray of a pixel - Python module
Build, edit and render scenes of Trace, a ray tracer, in Python: pictures and
passes are arrays of numpy, rays are dictionaries. With two notebooks.")

include(CPack)

# Programs for 64-bit Windows, made on Debian by its mingw-w64 (./dev build windows). Nothing of the machine's own libraries is
# seen: what is not the compiler's is in TRACE_WINDOWS_LIBRARIES, which cmake/libraries.sh fills.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

if(NOT DEFINED TRACE_WINDOWS_LIBRARIES)
  set(TRACE_WINDOWS_LIBRARIES ${CMAKE_CURRENT_LIST_DIR}/../../build/windows-libraries)
endif()
set(CMAKE_FIND_ROOT_PATH ${TRACE_WINDOWS_LIBRARIES} /usr/x86_64-w64-mingw32)
set(ZLIB_USE_STATIC_LIBS ON)
set(CMAKE_PREFIX_PATH ${TRACE_WINDOWS_LIBRARIES})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_CXX_STANDARD_INCLUDE_DIRECTORIES ${TRACE_WINDOWS_LIBRARIES}/include)
set(ENV{PKG_CONFIG_LIBDIR} ${TRACE_WINDOWS_LIBRARIES}/lib/pkgconfig)
set(PKG_CONFIG_ARGN --static)

# One program that needs no library beside it.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")

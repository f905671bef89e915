cmake_minimum_required(VERSION 3.24)

# Writes src/app/session/version.h's commit() into OUT, as git names it in ROOT, and sources(), a hash of what the program is made of: run
# before each build, so that `ray --version` is true. The file changes only with these. Without git or its folder the name is empty.
find_package(Git QUIET)
set(name "")
if(GIT_FOUND AND EXISTS ${ROOT}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty=+ --abbrev=7 --exclude=*
                  WORKING_DIRECTORY ${ROOT} OUTPUT_VARIABLE name OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(GLOB_RECURSE files LIST_DIRECTORIES false RELATIVE ${ROOT} ${ROOT}/src/* ${ROOT}/cmake/*.cmake ${ROOT}/CMakeLists.txt)
set(hashes "")
foreach(file IN LISTS files)
  file(SHA1 ${ROOT}/${file} hash)
  string(APPEND hashes "${hash} ${file}\n")
endforeach()
string(SHA1 sources "${hashes}")
string(SUBSTRING ${sources} 0 16 sources)
file(CONFIGURE OUTPUT ${OUT} CONTENT [[
#include "app/session/version.h"

std::string_view trace::commit() { return "@name@"; }
std::string_view trace::sources() { return "@sources@"; }
]] @ONLY)

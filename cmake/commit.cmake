# Writes src/app/version.h's commit() into OUT, as git names it in ROOT: run before each build, so that `ray --version` is true. The
# file changes only with the name. Without git or its folder the name is empty.
find_package(Git QUIET)
set(name "")
if(GIT_FOUND AND EXISTS ${ROOT}/.git)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty=+ --abbrev=7 --exclude=*
                  WORKING_DIRECTORY ${ROOT} OUTPUT_VARIABLE name OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT [[
#include "app/version.h"

std::string_view trace::commit() { return "@name@"; }
]] @ONLY)

# Standard headers are a third of the time of an ordinary file, and our own of the floors below a sixth, so each is
# compiled once for a target. A file still includes what it uses: it must compile with
# CMAKE_DISABLE_PRECOMPILE_HEADERS=ON too.
#
# Clang's name the files they were made of by their whole path, which ccache would hand to another checkout.
if(CCACHE AND NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
endif()

set(standardHeaders <algorithm> <array> <atomic> <cmath> <cstddef> <cstdint> <cstdio> <cstdlib> <cstring> <filesystem>
    <functional> <initializer_list> <limits> <map> <memory> <mutex> <optional> <set> <span> <stdexcept> <string>
    <string_view> <tuple> <type_traits> <unordered_map> <utility> <variant> <vector>)

# precompile(TARGET [headers as in "scene/scene.h"...]): the standard headers and these.
function(precompile TARGET)
  list(TRANSFORM ARGN REPLACE "(.+)" "<\\1>" OUTPUT_VARIABLE headers)  # found by the floor's own include path
  target_precompile_headers(${TARGET} PRIVATE ${standardHeaders} ${headers})
endfunction()

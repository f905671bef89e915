#!/usr/bin/env bash
# Another project takes Trace in by add_subdirectory(), or by FetchContent: its own file compiles with the headers of a floor, and
# it has neither Trace's tests nor its programs in its way. Usage: subproject_test.sh CHECKOUT COMPILER
set -euo pipefail

checkout="$1" compiler="$2"
folder="$(mktemp -d)"
trap 'rm -rf -- "$folder"' EXIT
fail() { echo "FAILED: $*" >&2; cat "$folder/log" >&2; exit 1; }

cat >"$folder/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.24)
project(Mine LANGUAGES CXX)
enable_testing()
add_subdirectory("$checkout" trace EXCLUDE_FROM_ALL)
add_library(mine OBJECT mine.cpp)
target_link_libraries(mine PRIVATE Trace::image)
add_library(through_the_library OBJECT library.cpp)
target_link_libraries(through_the_library PRIVATE Trace::Trace)
add_library(all_floors INTERFACE)
target_link_libraries(all_floors INTERFACE Trace::base Trace::math Trace::accel Trace::image Trace::geometry
  Trace::shading Trace::scene Trace::formats Trace::render Trace::app)
END
cat >"$folder/mine.cpp" <<'END'
#include "image/picture.h"
static_assert(__cplusplus >= 202002L);
int pixels() { return static_cast<int>(trace::Picture(2, 3).pixels.size()); }
END
cat >"$folder/library.cpp" <<'END'
#include <traceray/traceray.h>
#if __has_include("image/picture.h")
#error "the library shows headers of the floors"
#endif
traceray::Node ball() { return traceray::Node("sphere", {{"scale", 2}}); }
END
cmake -S "$folder" -B "$folder/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" >"$folder/log" 2>&1 || fail "configuring"
cmake --build "$folder/build" --target mine through_the_library >"$folder/log" 2>&1 || fail "compiling"
cmake --build "$folder/build" --target help >"$folder/log"
! grep -q 'test_' "$folder/log" || fail "Trace's tests are among the targets"
(cd "$folder/build" && ctest -N) >"$folder/log" 2>&1
grep -q 'Total Tests: 0' "$folder/log" || fail "Trace's tests are among the project's"
cmake --install "$folder/build" --prefix "$folder/usr" >"$folder/log" 2>&1 || fail "installing"
[[ ! -e "$folder/usr/bin/ray" ]] || fail "Trace is installed with the project"

# By FetchContent, as docs/cpp.md has it.
fetched="$(sed -n '/^    include(FetchContent)/,/^    FetchContent_MakeAvailable/s/^    //p' "$checkout/docs/cpp.md")"
[[ "$fetched" == *'SOURCE_DIR /path/to/trace'* ]] || fail "docs/cpp.md does not show FetchContent"
mkdir "$folder/fetch"
cp "$folder/library.cpp" "$folder/fetch"
cat >"$folder/fetch/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.24)
project(Mine LANGUAGES CXX)
$(sed "s|/path/to/trace|\"$checkout\"|" <<<"$fetched")
add_library(through_the_library OBJECT library.cpp)
target_link_libraries(through_the_library PRIVATE Trace::Trace)
END
cmake -S "$folder/fetch" -B "$folder/fetch/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" >"$folder/log" 2>&1 || fail "configuring by FetchContent"
cmake --build "$folder/fetch/build" --target through_the_library >"$folder/log" 2>&1 || fail "compiling by FetchContent"
cmake --build "$folder/fetch/build" --target help >"$folder/log"
! grep -q 'test_' "$folder/log" || fail "Trace's tests are among the targets by FetchContent"

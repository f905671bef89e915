#!/usr/bin/env bash
# The library as others have it: installed into a folder of its own, found by find_package() and by pkg-config, and the
# examples compiled against it. What it shows to the linker is a list.
# Usage: library_test.sh BUILD_FOLDER CHECKOUT COMPILER
set -euo pipefail

build="$1" checkout="$2" compiler="$3"
folder="$(mktemp -d)"
trap 'rm -rf -- "$folder"' EXIT
fail() { echo "FAILED: $*" >&2; cat "$folder/log" >&2; exit 1; }

cd "$folder"
for component in library dev; do
  cmake --install "$build" --prefix "$folder/usr" --component "$component" >log 2>&1 || fail "installing $component"
done
library="$(find usr -name 'libtraceray.so.*' -type f)"
[[ -f "$library" ]] || fail "no libtraceray.so.VERSION"
find usr/include -type f | sed 's|^usr/include/||' | sort >log
[[ "$(cat log)" == "traceray/traceray.h"$'\n'"traceray/traceray_c.h" ]] || fail "headers are installed that are not public"
nm -DC --defined-only "$library" | sed -E 's/^[0-9a-f]* . //' |
  grep -vE '^((typeinfo (name )?for |vtable for )?traceray::|traceray_[a-z_]+$)' >log && fail "these names are seen outside:"
nm -DC --defined-only "$library" >log  # a pipe into grep -q may be cut off
grep -q 'traceray::Scene::render' log || fail "the library shows no Scene::render"

# The header compiles alone, with warnings as errors, and needs nothing of the floors.
flags="$(PKG_CONFIG_PATH="$(dirname "$(find "$folder/usr" -name traceray.pc)")" pkg-config --cflags --libs traceray)"
[[ "$flags" == *-ltraceray* ]] || fail "pkg-config: $flags"
cmake -S "$checkout/examples/cpp" -B examples -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$folder/usr" \
  -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Werror" >log 2>&1 || fail "find_package(Trace)"
cmake --build examples >log 2>&1 || fail "compiling the examples"

scene="$checkout/scenes/glass.ray"
examples/open_and_render "$scene" open.png >log 2>&1 || fail "open_and_render"
examples/build_a_scene built.png >log 2>&1 || fail "build_a_scene"
examples/progress_and_cancel "$scene" part.png >log 2>&1 || fail "progress_and_cancel"
grep -q '^cancelled, written to part' log || fail "the render was not stopped"
examples/explain_a_pixel "$scene" 32 20 >log 2>&1 || fail "explain_a_pixel"
grep -q "sum to the picture's pixel, bit for bit" log || fail "the rays do not agree"
examples/passes "$scene" >log 2>&1 || fail "passes"
grep -q '^depth [0-9.]*, red [0-9.]*$' log || fail "no depth"
examples/polished_to_rough >log 2>&1 || fail "polished_to_rough"
for picture in open.png built.png part.png gold-5.png gold-20.png gold-60.png; do [[ -s $picture ]] || fail "no $picture"; done
# The how-to shows this program, as it is, and a CMakeLists.txt that builds it.
mkdir -p pasted
awk '/^```/ { on = /^```cpp$/; next } on' "$checkout/docs/how-to/from-cpp.md" >pasted/polished_to_rough.cpp
awk '/^```/ { on = /^```cmake$/; next } on' "$checkout/docs/how-to/from-cpp.md" >pasted/CMakeLists.txt
diff "$checkout/examples/cpp/polished_to_rough.cpp" pasted/polished_to_rough.cpp >log || fail "docs/how-to/from-cpp.md shows another program"
cmake -S pasted -B pasted/build -G Ninja -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$folder/usr" >log 2>&1 &&
  cmake --build pasted/build >log 2>&1 || fail "building what docs/how-to/from-cpp.md says"
# The face for C: a program in C99, and each function that the header declares is there.
cc -std=c99 -Wall -Wextra -Wpedantic -Werror "$checkout/examples/c/open_and_explain.c" -o open_and_explain $flags \
  -Wl,-rpath,"$(dirname "$folder/$library")" >log 2>&1 || fail "compiling the example in C"
./open_and_explain "$scene" c.png >log 2>&1 && [[ -s c.png ]] && grep -q ', pixel 32,20 of' log || fail "open_and_explain"
! ./open_and_explain no_such.ray c.png >log 2>&1 || fail "a missing scene is rendered from C"
grep -q 'no_such.ray' log || fail "the message does not name the file"
comm -23 <(grep -oE 'traceray_[a-z_]+\(' "$checkout/include/traceray/traceray_c.h" | tr -d '(' | sort -u) \
  <(nm -D --defined-only "$library" | sed 's/.* //' | sort -u) >log
[[ ! -s log ]] || fail "declared for C and not there:"
# What goes wrong is said as the program says it.
! examples/open_and_render "$checkout/tests/corpus/ray/no_such.ray" x.png >log 2>&1 || fail "a missing scene is rendered"
grep -q 'no_such.ray' log || fail "the message does not name the file"

#!/usr/bin/env bash
# cmake --install into a folder of its own: the program runs from there, and what belongs to it lies beside it.
# Usage: install_test.sh BUILD_FOLDER
set -euo pipefail

build="$1"
folder="$(mktemp -d)"
trap 'rm -rf -- "$folder"' EXIT
fail() { echo "FAILED: $*" >&2; exit 1; }

cmake --install "$build" --prefix "$folder/usr" >"$folder/log" || fail "cmake --install"
cd "$folder"
docs=(usr/share/doc/*)
[[ -f "${docs[0]}/LICENSE" && -f "${docs[0]}/README.md" ]] || fail "no licence or README in ${docs[*]}"
[[ -f "${docs[0]}/docs/ray-format.md" ]] || fail "no pages"
usr/bin/ray --version | grep -q '^Trace ' || fail "the installed program does not run"
usr/bin/ray "${docs[0]}/scenes/glass.ray" -w 16 picture.png -q || fail "it does not render the installed scene"
[[ -s picture.png ]] || fail "no picture"
if [[ -x "$build/bin/ray-studio" ]]; then
  [[ -x usr/bin/ray-studio ]] || fail "the studio was built and not installed"
fi
! find usr -name '*_test*' -o -name 'test_*' | grep . || fail "tests are installed"

#!/usr/bin/env bash
# Compiles the files of src/base/os for the systems that this is not: POSIX without what only Linux has, macOS, by a header of
# our own in place of its, and Windows, where Debian's compiler for it is installed. It makes no program.
# Usage: systems_test.sh CHECKOUT COMPILER
set -euo pipefail

cd -- "$1"
compiler="$2" windows=x86_64-w64-mingw32-g++-posix
flags=(-std=c++20 -Wall -Wextra -Wpedantic -Wshadow -Werror -fsyntax-only -Isrc)
for file in src/base/os/*.cpp src/base/os/posix/*.cpp; do
  "$compiler" "${flags[@]}" -DTRACE_OS_PLAIN_POSIX "$file"
  "$compiler" "${flags[@]}" -DTRACE_OS_PLAIN_POSIX -D__APPLE__ -isystem tests/build/macos "$file"
done
command -v "$windows" >/dev/null || { echo "SKIPPED: there is no $windows (./dev setup windows)"; exit 77; }
for file in src/base/os/*.cpp src/base/os/windows/*.cpp src/base/files/*.cpp; do
  "$windows" "${flags[@]}" "$file"
done

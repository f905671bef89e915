#!/usr/bin/env bash
# What packages say agrees with what is built, before anybody makes one. Usage: packaging_test.sh CHECKOUT BUILD_FOLDER
set -euo pipefail

packaging="$1/packaging" build="$2"
fail() { echo "FAILED: $*" >&2; exit 1; }
version="$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")"
grep -q "^trace-ray ($version) " <(head -n 1 "$packaging/debian/changelog") || fail "the changelog does not begin with $version"
words() { tr -s ' \n' '\n\n' | grep . | grep -vxF .; }
cmp -s <(sed -n '/^Permission/,$p' "$1/LICENSE" | words) \
       <(sed -n '/^ Permission/,$p' "$packaging/debian/copyright" | words) || fail "debian/copyright is not our licence"
for script in "$packaging"/*.sh "$packaging"/debian/{postinst,prerm} "$packaging"/debian/python/prerm; do
  "$(sed -n '1s/^#!.*[/ ]//p' "$script")" -n "$script" || fail "$script"
done

# The programs of an archive are started by a script: by their own loader, with what they were told, under their names.
folder="$(mktemp -d)"
trap 'rm -rf -- "$folder"' EXIT
mkdir -p "$folder/a b/bin" "$folder/a b/libexec/trace-ray/system"
sed 's|@LOADER@|loader|; s|@GLIBC@|999|' "$packaging/launcher.sh" >"$folder/a b/bin/trace-ray"
printf '#!/bin/sh\nprintf "%%s|" "$@"\n' >"$folder/a b/libexec/trace-ray/system/loader"
chmod +x "$folder/a b/bin/trace-ray" "$folder/a b/libexec/trace-ray/system/loader"
ln -s trace-ray "$folder/a b/bin/ray-studio"
ln -s "$folder/a b/bin/trace-ray" "$folder/ray"
home="$(readlink -f "$folder/a b")/libexec/trace-ray"
[[ "$("$folder/ray" 'x y' -w 9)" == "--argv0|ray|--library-path|$home/system:$home/lib|$home/ray|x y|-w|9|" ]] ||
  fail "ray of an archive: $("$folder/ray" 'x y' -w 9)"
[[ "$("$folder/a b/bin/ray-studio" s.ray)" == "--argv0|ray-studio|--library-path|$home/system:$home/lib|$home/ray-studio|s.ray|" ]] ||
  fail "ray-studio of an archive where the C library is older"

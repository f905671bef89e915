#!/usr/bin/env bash
# Checks that every guarantee of docs/developers/limits.md names tests, and that each of them exists. A name may contain
# `*`, as of tests over a list. Usage: check_limits.sh BUILD_FOLDER [checkout]
set -euo pipefail

build="$(cd -- "$1" && pwd -P)"
cd -- "${2:-"$(dirname -- "${BASH_SOURCE[0]}")/.."}"
# From a folder of its own, for ctest writes over the log of a running test.
listing="$(mktemp -d)"
trap 'rm -rf -- "$listing"' EXIT
echo "subdirs(\"$build\")" >"$listing/CTestTestfile.cmake"
tests="$(ctest --test-dir "$listing" -N | sed -n 's/^ *Test *#[0-9]*: //; T; s/ *# GetParam.*//; p')"
[[ -n "$tests" ]] || { echo "ctest knows no test in $build"; exit 1; }

wrong=0 promises=0
while IFS='|' read -r _ promise names _; do
  [[ "$promise" != ' promise ' && "$promise" != '---' ]] || continue
  promises=$((promises + 1))
  found=0
  while read -r name; do
    [[ -n "$name" ]] || continue
    found=1
    pattern="$(sed 's/[.[\/]/\\&/g; s/\*/.*/g' <<<"$name")"
    grep -qx -- "$pattern" <<<"$tests" || { echo "docs/developers/limits.md: no test is called $name"; wrong=$((wrong + 1)); }
  done < <(grep -oE '[a-z]+\.[A-Za-z0-9_/*]+(\.[A-Za-z0-9_/*]+)?' <<<"$names")
  ((found)) || { echo "docs/developers/limits.md: no test stands behind:$promise"; wrong=$((wrong + 1)); }
done < <(grep '^|' docs/developers/limits.md)
echo "$promises promises, $wrong without a test"
((promises > 0 && wrong == 0))

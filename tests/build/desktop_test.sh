#!/usr/bin/env bash
# The files for desktops are what desktops understand. Usage: desktop_test.sh CHECKOUT
set -euo pipefail

packaging="$1/packaging"
fail() { echo "FAILED: $*" >&2; exit 1; }
for tool in desktop-file-validate update-mime-database; do
  command -v "$tool" >/dev/null || { echo "SKIPPED: $tool is not installed"; exit 77; }
done
folder="$(mktemp -d)"
trap 'rm -rf -- "$folder"' EXIT

said="$(desktop-file-validate "$packaging/trace-ray-studio.desktop")" || fail "the desktop file: $said"
[[ -z "$said" ]] || fail "the desktop file: $said"
mkdir -p "$folder/packages"
cp "$packaging/trace-ray.xml" "$folder/packages"
update-mime-database "$folder" 2>"$folder/log" || { cat "$folder/log" >&2; fail "the type of scenes"; }
type="$(sed -n 's/^MimeType=\(.*\);$/\1/p' "$packaging/trace-ray-studio.desktop")"
grep -qx "50:$type:\*.ray" "$folder/globs2" || fail "*.ray is not of the type that the studio opens, $type"
grep -aq "60:$type" "$folder/magic" || fail "$type is not known by its first words"

#!/usr/bin/env bash
# Renders scenes by the program for browsers, in node, and by the desktop's, and compares the pictures and the times. Ends with 1
# if a picture has other bytes.
# Usage: same_bits.sh RAY RAY-JS [SCENE...]
set -euo pipefail
ray="$1" script="$2"
shift 2
root="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)"
cd "$root"
(($#)) || set -- scenes/{antialias,bumps,cornell,creases,csg,cubemap,fog,fractals,glass,lens,lights,materials,mesh,mirrors,motion,prism,room,shapes,soft-shadows,textures}.ray
folder="$(mktemp -d)"
trap 'rm -rf -- "$folder"' EXIT
seconds() { local TIMEFORMAT=%U; { time "$@" >/dev/null 2>&1; } 2>&1; }
differing=0
for scene in "$@"; do
  name="$(basename "$scene" .ray)"
  options=(-w 120 --spp 4 --threads 2)
  native="$(seconds "$ray" "$scene" "${options[@]}" -o "$folder/a.exr")"
  web="$(seconds node --no-experimental-fetch "$script" "$scene" "${options[@]}" -o "$folder/b.exr")"
  said="$("$ray" diff "$folder/a.exr" "$folder/b.exr" 2>&1 | head -n 1 || true)"
  printf '%-14s %6s s, %6s s  %s\n' "$name" "$native" "$web" "$said"
  cmp -s "$folder/a.exr" "$folder/b.exr" || grep -q identical <<<"$said" || differing=$((differing + 1))
done
echo "$differing of $# pictures differ"
((differing == 0))

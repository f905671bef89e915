#!/usr/bin/env bash
# What the choice among many lights costs and how well it does (docs/lights.md): a floor with balls under 1 to 10,000 lamps,
# of which every place asks all, or one or four that the tree chooses. Prints a Markdown table of instructions for each
# sample of a pixel, by callgrind, and of the root mean square error of 16 samples against the picture by all lights, as a
# part of white.
#
#   many_lights.sh BIN OUT
#
# BIN holds ray; OUT gets the scenes and pictures.
set -euo pipefail
export LC_ALL=C

bin="$(realpath "$1")" out="$(realpath -m "$2")"
command -v valgrind >/dev/null || { echo "bench: SKIPPED: valgrind is not installed" >&2; exit 0; }
mkdir -p "$out"
width=48 height=32 spp=16

scene() {  # COLUMNS ROWS: lamps in a grid of 20 x 20 units, which together are as strong whatever their number
  cat <<END
SBT-raytracer 1.0
camera { position = (0, 7, 13); look_at = (0, 0, 0); fov = 50; aspectratio = 1.5; }
rows { count = ($1, 1, $2); step = ($(bc -l <<<"20 / $1"), 0, $(bc -l <<<"20 / $2")); spread = (0.05, 0.5, 0.05);
  point_light { position = ($(bc -l <<<"10 / $1 - 10"), 1.6, $(bc -l <<<"10 / $2 - 10")); color = ($(bc -l <<<"20 / ($1 * $2)"), $(bc -l <<<"14 / ($1 * $2)"), $(bc -l <<<"8 / ($1 * $2)")); } }
rotate(1, 0, 0, -1.5708, scale(24, 24, 1, square { material = { diffuse = (0.7, 0.7, 0.7); specular = (0, 0, 0); }; }))
rows { count = (5, 1, 5); step = (4, 0, 4); translate(-8, 0.5, -8, scale(0.5, sphere { material = { diffuse = (0.6, 0.5, 0.4); specular = (0, 0, 0); }; })) }
END
}

instructions() {  # SCENE SPP FLAGS...: of the whole program
  valgrind --tool=callgrind --callgrind-out-file=/dev/null "$bin/ray" render "$1" -o "$out/x.exr" --width "$width" \
    --threads 1 --sampling sobol --spp "$2" "${@:3}" 2>&1 | sed -n 's/.*Collected : \([0-9]*\).*/\1/p'
}
perSample() {  # SCENE FLAGS...: without what reading and building takes
  local few many
  few="$(instructions "$1" 1 "${@:2}")" many="$(instructions "$1" 5 "${@:2}")"
  echo $(((many - few) / (4 * width * height)))
}
error() {  # SCENE FLAGS...
  "$bin/ray" render "$1" -o "$out/some.exr" --width "$width" --sampling sobol --spp "$spp" "${@:2}" >/dev/null 2>&1
  "$bin/ray" diff "$out/all.exr" "$out/some.exr" --print rmse || true
}

echo "| lights | all: instructions | one: instructions | error | four: instructions | error |"
echo "|---|---|---|---|---|---|"
for grid in "1 1" "5 2" "10 10" "40 25" "100 100"; do
  read -r columns rows <<<"$grid"
  file="$out/lights$((columns * rows)).ray"
  scene "$columns" "$rows" >"$file"
  all="$(perSample "$file" --light-choices 0)"
  "$bin/ray" render "$file" -o "$out/all.exr" --width "$width" --sampling sobol --spp "$spp" --light-choices 0 >/dev/null 2>&1
  echo "| $((columns * rows)) | $all | $(perSample "$file" --light-choices 1) | $(error "$file" --light-choices 1) | $(perSample "$file" --light-choices 4) | $(error "$file" --light-choices 4) |"
done

#!/usr/bin/env bash
# How many frames the window draws in a second while the 3D view is turned and the mouse moves, and how long a click
# takes until its rays are shown. On a display of its own, with OpenGL in software.
#
#   studio.sh RAY_STUDIO [--size WIDTHxHEIGHT] [--runs N] [SCENE...]
#
# Wall-clock and processor milliseconds of a frame, or of a click: medians of the runs.
set -euo pipefail
export LC_ALL=C

root="$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)"
studio="$(realpath "$1")"
shift
size=1920x1080 runs=5 scenes=()
while (($#)); do
  case "$1" in
    --size) size="$2"; shift ;;
    --runs) runs="$2"; shift ;;
    -*) echo "studio.sh: what is '$1'?" >&2; exit 2 ;;
    *) scenes+=("$(realpath "$1")") ;;
  esac
  shift
done
((${#scenes[@]})) || scenes=("$root"/scenes/{glass,shapes,kitchen}.ray)

folder="$(mktemp -d)"
server=''
trap '[[ -z "$server" ]] || kill "$server" 2>/dev/null || true; rm -rf -- "$folder"' EXIT
export LIBGL_ALWAYS_SOFTWARE=1 XDG_CONFIG_HOME="$folder/config"
unset WAYLAND_DISPLAY
mkfifo "$folder/display"
Xvfb -displayfd 3 -noreset -screen 0 "${size}x24" -nolisten tcp 3>"$folder/display" 2>/dev/null &
server=$!
read -r -t 60 number <"$folder/display" || { echo 'studio.sh: Xvfb does not start' >&2; exit 1; }
export DISPLAY=":$number"

median() { sort -n | awk '{ all[NR] = $1 } END { print all[int((NR + 1) / 2)] }'; }
printf '%-12s %-28s %9s %9s %13s\n' scene what frames/s 'wall ms' 'processor ms'
for scene in "${scenes[@]}"; do
  cat >"$folder/script" <<END
set spp 1
set width 400
times
open $scene
shown
times from opening to a picture
set integrator whitted
wait
pixel 200 150
rays
wait
END
  for ((run = 0; run < runs; ++run)); do
    cat >>"$folder/script" <<END
times
drag 30 space
times frame while turning
wait
hover 30 space
times
hover 30 space
times frame while hovering over 3D
hover 30 picture
times
hover 30 picture
times frame while hovering over 2D
wait
times
pixel $((160 + 20 * run)) $((120 + 10 * run))
seen
times click to rays
rays
wait
END
  done
  "$studio" --window "$size" --script "$folder/script" >"$folder/times"
  cut -f1 "$folder/times" | awk '!seen[$0]++' | while IFS= read -r what; do
    each=$([[ $what == frame* ]] && echo 1 || echo 0)
    wall="$(awk -F'\t' -v what="$what" -v each="$each" '$1 == what { print 1000 * $3 / (each ? $2 : 1) }' "$folder/times" | median)"
    busy="$(awk -F'\t' -v what="$what" -v each="$each" '$1 == what { print 1000 * $4 / (each ? $2 : 1) }' "$folder/times" | median)"
    printf '%-12s %-28s %9s %9.1f %13.1f\n' "$(basename "$scene" .ray)" "${what#frame }" \
      "$( ((each)) && awk -v ms="$wall" 'BEGIN { printf "%.1f", 1000 / ms }')" "$wall" "$busy"
  done
done

#!/usr/bin/env bash
# What it costs that rays could be recorded when none is: the same renders by a program that can, whose recording is
# off, and by one built without, in turn. CPU seconds of the tracing on one thread, the fastest of the runs of each,
# and the difference of two halves of the runs of the same program, which is the noise.
#
#   recording.sh BIN [--width PIXELS] [--runs N] [SCENE...]
set -euo pipefail
export LC_ALL=C

root="$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)"
bin="$(realpath "$1")"
shift
width=300 runs=20 scenes=()
while (($#)); do
  case "$1" in
    --width) width="$2"; shift ;;
    --runs) runs="$2"; shift ;;
    -*) echo "recording.sh: what is '$1'?" >&2; exit 2 ;;
    *) scenes+=("$1") ;;
  esac
  shift
done
((${#scenes[@]})) || scenes=("$root"/scenes/{shapes,glass,shadows,window}.ray)

least() { sort -n | head -n 1; }
printf '%-20s %12s %12s %9s %9s\n' scene 'can record' 'cannot' 'costs' 'noise'
for scene in "${scenes[@]}"; do
  can=() cannot=()
  for ((i = 0; i < runs; ++i)); do
    can+=("$("$bin/bench_recording" "$scene" "$width")")
    cannot+=("$("$bin/bench_recording_never" "$scene" "$width")")
  done
  half=$((runs / 2))
  on="$(printf '%s\n' "${can[@]}" | least)" off="$(printf '%s\n' "${cannot[@]}" | least)"
  first="$(printf '%s\n' "${cannot[@]:0:half}" | least)" second="$(printf '%s\n' "${cannot[@]:half}" | least)"
  awk -v name="$(basename "$scene")" -v on="$on" -v off="$off" -v a="$first" -v b="$second" 'BEGIN {
    noise = 100 * (a / b - 1)
    printf "%-20s %10.3f s %10.3f s %+7.1f %% %7.1f %%\n", name, on, off, 100 * (on / off - 1), noise < 0 ? -noise : noise
  }'
done

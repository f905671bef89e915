#!/usr/bin/env bash
# Whole programs, start to end: `ray` on the scenes that the courses time, and against POV-Ray 3.7 on the same
# scene in both languages. CPU time (user + system) of the process, one thread, the median; programs take turns.
#
# Those of textures look alike, and are not meant to be equal: noise is another in each program.
#
#   programs.sh BIN SHARED [--runs N] [--size PIXELS, against POV-Ray] [--json FILE]
#
# BIN holds ray and bench_scenes; SHARED is the folder of shared scenes and meshes.
set -euo pipefail
export LC_ALL=C

bench="$(realpath "$(dirname "$0")")" bin="$(realpath "$1")" shared="$(realpath -m "$2")"
shift 2
runs=5 size=400 json=
while (($#)); do
  case "$1" in
    --runs) runs="$2" ;;
    --size) size="$2" ;;
    --json) json="$2" ;;
    *) echo "programs.sh: what is '$1'?" >&2; exit 2 ;;
  esac
  shift 2
done
work="$(mktemp -d)"
trap 'rm -rf -- "$work"' EXIT

say() { printf 'bench: %s\n' "$*" >&2; }

# --- measuring -----------------------------------------------------------------------------------------

# Runs a command; appends its CPU seconds to the file SERIES.cpu; leaves what it printed in SERIES.log.
timed() {
  local series="$1" TIMEFORMAT='%3U %3S'
  shift
  { time "$@" >"$series.log" 2>&1; } 2>"$work/time" || { cat "$series.log" >&2; say "failed: $*"; exit 1; }
  awk '{ print $1 + $2 }' "$work/time" >>"$series.cpu"
}

median() { sort -g "$1" | awk '{ v[NR] = $1 } END { print (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }'; }
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.3g", a / b }'; }

# CPU seconds until the scene is ready, and of tracing, from a log, to SERIES.ready and SERIES.trace.
rayPhases() {
  awk -v ready="$1.ready" -v trace="$1.trace" '
    /"(read|build|trace)": \{/ { phase = $1 }
    /"cpu":/ && phase { seconds[phase] += $2; phase = "" }
    END { print seconds["\"read\":"] + seconds["\"build\":"] >>ready; print seconds["\"trace\":"] + 0 >>trace }' "$1.log"
}
povPhases() {  # POV-Ray adds CPU seconds in a second line where there is something to tell
  awk -v ready="$1.ready" -v trace="$1.trace" '
    /^ *[A-Z][a-z]+ Time: .*seconds\)/ { phase = $1; sub(/.*\(/, ""); seconds[phase] = $1 }
    /CPU-seconds total/ { sub(/.*with /, ""); seconds[phase] = $1 }
    END { print seconds["Parse"] + seconds["Bounding"] >>ready; print seconds["Trace"] + 0 >>trace }' "$1.log"
}

# --- the courses' scenes -------------------------------------------------------------------------------

# Seconds that the courses publish, on their machines: for orientation.
scenes=(trimesh1 trimesh2 trimesh3 dragon)
official=(0.50 56 1.81 0.70)
bestStudent=(0.25 2.6 1.3 0.34)

courses() {
  local scene file i pass
  for ((pass = 0; pass < runs; ++pass)); do
    for scene in "${scenes[@]}"; do
      file="$shared/scenes/uw/uw2005/polymesh/$scene.ray"
      if [[ ! -f "$file" ]]; then
        ((pass)) || say "SKIPPED $scene: there is no $file"
        continue
      fi
      timed "$work/$scene" "$bin/ray" -b -w 400 -r 5 -t 1 --like ut "$file" "$work/$scene.png"
    done
  done
  echo "Scenes of the courses, ray -b -w 400 -r 5 -t 1 --like ut: CPU seconds, whole program"
  echo
  echo "| scene    |    ray | official | ray / official | best student | ray / best student |"
  echo "|----------|-------:|---------:|---------------:|-------------:|-------------------:|"
  for i in "${!scenes[@]}"; do
    scene="${scenes[i]}"
    [[ -f "$work/$scene.cpu" ]] || continue
    local seconds; seconds="$(median "$work/$scene.cpu")"
    printf '| %-8s | %6.3f | %8s | %14s | %12s | %18s |\n' "$scene" "$seconds" \
      "${official[i]}" "$(ratio "$seconds" "${official[i]}")" "${bestStudent[i]}" "$(ratio "$seconds" "${bestStudent[i]}")"
    printf '{"scene":"%s","ray":%s,"official":%s,"bestStudent":%s}\n' "$scene" "$seconds" \
      "${official[i]}" "${bestStudent[i]}" >>"$work/courses.json"
  done
  echo
}

# --- POV-Ray -------------------------------------------------------------------------------------------

# Both programs told to draw the same thing: see scene_pair.h.
rayLikePov=(--like uw --highlight phong --air-index 1 --pixel-position center --rounding nearest)

povray37() {
  local pass scene pairs=(analytic textures) meshes=()
  command -v povray >/dev/null || { say "SKIPPED POV-Ray: it is not installed"; return 0; }
  if [[ -f "$shared/meshes/bunny.ply" ]]; then
    pairs+=(bunny) meshes+=("$shared/meshes/bunny.ply")
  else
    say "SKIPPED bunny: there is no $shared/meshes/bunny.ply"
  fi
  "$bin/bench_scenes" "$work" "${meshes[@]}"
  cp "$bench/textures.ray" "$bench/textures.pov" "$work"
  cd "$work"  # POV-Ray reads and writes only near here
  for ((pass = 0; pass < runs; ++pass)); do
    for scene in "${pairs[@]}"; do
      timed "$scene-ray" "$bin/ray" -w "$size" -r 5 -t 1 "${rayLikePov[@]}" --stats=json "$scene.ray" "$scene-ray.png"
      rayPhases "$scene-ray"
      timed "$scene-pov" povray "+I$scene.pov" "+O$scene-pov.png" "+W$size" "+H$size" +WT1 -D -A File_Gamma=1.0
      povPhases "$scene-pov"
    done
  done
  echo "Against POV-Ray 3.7, ${size}x$size, depth 5: CPU seconds of the whole program, and by its own count until the"
  echo "scene is ready and while it traces; last, how far apart the pictures are (mean levels, share beyond 8 levels)"
  echo
  echo "| scene    |    ray | POV-Ray | ray / POV-Ray | ray ready | POV ready | ray trace | POV trace | trace ratio | pictures differ |"
  echo "|----------|-------:|--------:|--------------:|----------:|----------:|----------:|----------:|------------:|----------------:|"
  for scene in "${pairs[@]}"; do
    local value of=()
    for value in ray.cpu pov.cpu ray.ready pov.ready ray.trace pov.trace; do of+=("$(median "$scene-$value")"); done
    local -a difference
    read -ra difference < <("$bin/ray" diff --print mean,beyond --tolerance 8 "$scene-ray.png" "$scene-pov.png")
    difference=("$(printf %.3f "${difference[0]}")" "$(awk -v p="${difference[1]}" 'BEGIN { printf "%.5f", p / 100 }')")
    printf '| %-8s | %6.3f | %7.3f | %13s | %9.3f | %9.3f | %9.3f | %9.3f | %11s | %15s |\n' "$scene" "${of[@]:0:2}" \
      "$(ratio "${of[0]}" "${of[1]}")" "${of[@]:2:4}" "$(ratio "${of[4]}" "${of[5]}")" "${difference[*]}"
    printf '{"scene":"%s","ray":%s,"pov":%s,"rayReady":%s,"povReady":%s,"rayTrace":%s,"povTrace":%s,"meanDifference":%s,"beyond8Levels":%s}\n' \
      "$scene" "${of[@]}" "${difference[@]}" >>"$work/pov.json"
  done
}

# --- all -----------------------------------------------------------------------------------------------

list() { [[ ! -f "$1" ]] || paste -sd, "$1"; }

courses
(povray37)
[[ -z "$json" ]] || printf '{"runs":%s,"size":%s,"courses":[%s],"pov":[%s]}\n' "$runs" "$size" \
  "$(list "$work/courses.json")" "$(list "$work/pov.json")" >"$json"

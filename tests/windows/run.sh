#!/usr/bin/env bash
# Runs the programs for Windows under Wine, and compares them with those of Linux. Ends with 1 if a test fails, a command
# answers otherwise or a picture has other bytes.
#
#   run.sh BUILD RAY [PART...]    BUILD: the folder of the build for Windows; RAY: the program for Linux; PART: test_base and the
#                                 other test programs, commands, scenes, studio; without one all
set -euo pipefail

build="$(cd -- "$1" && pwd -P)" ray="$(readlink -f -- "$2")"
shift 2
root="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)"
work="$build/wine"
export WINEPREFIX="$work/prefix" WINEDEBUG=-all LC_ALL=C.UTF-8  # by which Wine knows names of files
unset DISPLAY WAYLAND_DISPLAY
mkdir -p "$work"

# Wine limits no job's memory.
beyondWine='-*LackOfMemory*:*OutOfMemory*'

scenes=(showcase glass chess materials-models csg fractals bumps candles caustics cornell fog groups hearts isosurfaces jade lens
        metals kitchen lights mirrors)

failed=()

runTests() {  # PROGRAM
  local log="$work/$1.log" end=passed
  cd "$work"
  if ! wine "$build/bin/$1.exe" --gtest_brief=1 --gtest_filter="$beyondWine" >"$log" 2>&1 </dev/null; then
    end=FAILED
    failed+=("$1")
  fi
  printf '%-13s %s: %s\n' "$1" "$end" "$(grep -aE '^\[==========\].*ran' "$log" | tr -d '\r' | sed 's/^\[=*\] //' | tail -n 1)"
  grep -aE '^\[  (FAILED|SKIPPED)' "$log" | tr -d '\r' | sort -u | sed 's/^/    /' || true
}

# The exit code, and what is printed, of a command in a folder of each system.
answer() {  # SYSTEM WORDS...
  local system="$1" code=0
  shift
  cd "$work/$system"
  if [[ $system == linux ]]; then
    "$ray" "$@" >.out 2>.err <"${input:-/dev/null}" || code=$?
  else
    wine "$build/bin/ray.exe" "$@" >.out 2>.err <"${input:-/dev/null}" || code=$?
  fi
  echo "$code" >.code
}

# Fails unless the program for Windows answers as that for Linux does, byte for byte, and makes the same files.
isSame() {  # WORDS...
  local system
  for system in linux windows; do answer "$system" "$@"; done
  if diff -r "$work/linux" "$work/windows" >"$work/difference" 2>&1; then
    echo "the same: ray $*"
  else
    echo "DIFFERENT: ray $*"
    head -n 5 "$work/difference" | sed 's/^/    /'
    failed+=("ray $1")
    cp -- "$work"/linux/.??* "$work/windows"
  fi
}

compareCommands() {
  local system
  rm -rf -- "$work/linux" "$work/windows"
  mkdir -p "$work/linux" "$work/windows"
  for system in linux windows; do
    cp -r -- "$root/scenes/meshes" "$root/scenes/glass.ray" "$root/scenes/mesh-files.ray" "$work/$system"
    printf 'SBT-raytracer 1.0\ncamera { }\nsphere { radius = 1 \n' >"$work/$system/broken.ray"
  done
  isSame help all
  isSame features --markdown
  isSame texture --markdown
  isSame new first.ray
  isSame new first.ray                    # it is there
  isSame render none.ray
  isSame render broken.ray
  isSame render meshes                    # a folder
  isSame render glass.ray -o no/folder.png
  isSame render glass.ray -o glass.ray    # the scene itself
  isSame render glass.ray --nonsense
  isSame format first.ray -o 'Glück 日本.ray'
  isSame lint 'Glück 日本.ray'
  isSame expand glass.ray
  isSame convert mesh-files.ray -o meshes.glb
  isSame convert meshes.glb -o again.obj
  isSame explain glass.ray --pixel 200,150
  isSame lint mesh-files.ray --format json
  input="$work/linux/first.ray" isSame lint -
  isSame render 'Glück 日本.ray' -w 60 -o 'Glück 日本.png' --quiet --resume=never
  isSame render first.ray -w 60 -o - --quiet --resume=never
  isSame diff first-1.png first-2.png      # neither is there
}

compareScenes() {
  local name same=0 code verdict options=(-w 160 --spp 4 --resume=never --quiet --passes none)
  mkdir -p "$work/out"
  cd "$work/out"
  for name in "${scenes[@]}"; do
    "$ray" render "$root/scenes/$name.ray" -o "$name-linux.exr" "${options[@]}" >"$name-linux.log" 2>&1
    code=0
    wine "$build/bin/ray.exe" render "$root/scenes/$name.ray" -o "$name-windows.exr" "${options[@]}" \
      >"$name-windows.log" 2>&1 </dev/null || code=$?
    if ((code)); then
      failed+=("$name")
      echo "$name: FAILED with the code $code, see $work/out/$name-windows.log"
    elif cmp -s "$name-linux.exr" "$name-windows.exr"; then
      same=$((same + 1))
      echo "$name: the same bytes"
    else
      verdict="$("$ray" diff "$name-linux.exr" "$name-windows.exr" 2>&1 | head -n 3 | paste -sd ' ')" || true
      failed+=("$name")
      echo "$name: $verdict"
    fi
  done
  echo "$same of ${#scenes[@]} pictures have the same bytes"
}

# In a Wine of its own, since the other parts start one that has no display. The window opens, shows a scene and the rays of a
# pixel, and saves the picture that the program renders.
tryStudio() {
  local folder="$work/studio" scene="$root/scenes/glass.ray"
  command -v xvfb-run >/dev/null || { echo "studio SKIPPED: there is no xvfb-run"; return; }
  rm -rf -- "$folder"
  mkdir -p "$folder"
  cd "$folder"
  printf '%s\n' "open $scene" 'set width 160' wait 'save saved.png' 'pixel 80 60' rays 'screenshot window.png' >steps.txt
  "$ray" render "$scene" -w 160 -o linux.png --quiet --resume=never
  if ! WINEPREFIX="$work/prefix-window" xvfb-run -a -s '-screen 0 1280x800x24' wine "$build/bin/ray-studio.exe" --script steps.txt >log 2>&1 </dev/null; then
    failed+=(studio)
    echo "studio FAILED, see $folder/log"
    return
  fi
  "$ray" diff linux.png saved.png --tolerance 1 >diff.txt || failed+=("the studio's picture")
  head -n 1 diff.txt
  [[ "$(stat -c %s window.png)" -gt 20000 ]] || failed+=("the studio's window")
  echo "studio: $folder/window.png shows the window"
}

if (($# == 0)); then
  set -- $(cd "$build/bin" && ls test_*.exe | sed 's/\.exe$//') commands scenes studio
fi
for part in "$@"; do
  case "$part" in
    commands) compareCommands ;;
    scenes) compareScenes ;;
    studio) tryStudio ;;
    *) runTests "$part" ;;
  esac
done
if ((${#failed[@]})); then
  echo "failed: ${failed[*]}"
  exit 1
fi

#!/usr/bin/env bash
# Drags in the studio and gives up with Esc: numbers, options, handles. Folders that do not exist; a new scene.
# Exits 77 where that cannot be tried. Usage: escape_test.sh RAY_STUDIO
set -euo pipefail
studio="$1"
source "$(dirname -- "${BASH_SOURCE[0]}")/display.sh"
source "$(dirname -- "${BASH_SOURCE[0]}")/steps.sh"
openDisplay

cat >scene.ray <<'SCENE'
SBT-raytracer 1.0
camera { position = (0, 0, 8); look_at = (0, 0, 0); fov = 40; }
directional_light { direction = (0, 0, -1); color = (1, 1, 1); }
sphere { name = "ball"; material = { diffuse = (0.9, 0.1, 0.1) } }
SCENE

step wait 'set width 60' wait 'panel Scene' 'select camera 0' # 0
for ((i = 0; i < 3; ++i)); do step; done
step 'select object 0' # 4
for ((i = 0; i < 4; ++i)); do step; done
step 'panel Controls' # 9
for ((i = 0; i < 8; ++i)); do step; done
start scene.ray
begun="$(line undo)"

press() { xdotool key "$@"; next; }
drag() { xdotool mousedown 1 mousemove_relative 8 0 mousemove_relative 30 0; next; }  # needs a step
letGo() { xdotool mouseup 1; next; }

# A number of the camera.
goTo field position number 0
drag
is undo 'camera: position' "a number is dragged"
press Escape
is undo "$begun" "Esc gives back the number before the drag"
letGo
is undo "$begun" "letting go changes nothing"

# A handle of the ball, which is in the middle of the view.
skipTo 4
click from camera
goTo space
drag
is undo 'move ball' "a handle is dragged"
press Escape
is undo "$begun" "Esc gives back the place before the drag"
is selected 'object 0' "the object stays selected"
letGo

# An option.
skipTo 9
goTo option width
drag
[[ "$(line chosen width)" != 60 ]] || fail "the width is not dragged"
press Escape
is 'chosen width' 60 "Esc gives back the option before the drag"
letGo

# A folder that does not exist is said, and the dialog stays.
xdotool key ctrl+o
next
goTo dialog folder
xdotool click 1 key ctrl+a type --delay 5 /no/such/folder
xdotool key Return
next
is popup open "the dialog stays"
grep -q ' dialog problem there is no folder "/no/such/folder"$' "$now" || fail "it is not said that there is none"
press Escape
is popup none "Esc closes it"
kill $program
program=''
echo "Esc gives back numbers, options and places; a folder that is missing is said"

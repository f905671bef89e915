#!/usr/bin/env bash
# Works in the studio as a person does: menus and panels by keyboard, deleting, saving, typing what is out of range,
# clicking into space. Exits 77 where that cannot be tried. Usage: keyboard_test.sh RAY_STUDIO
set -euo pipefail
studio="$1"
source "$(dirname -- "${BASH_SOURCE[0]}")/display.sh"
source "$(dirname -- "${BASH_SOURCE[0]}")/steps.sh"
openDisplay

{
  cat <<'SCENE'
SBT-raytracer 1.0
camera { position = (0, 0, 8); look_at = (0, 0, 0); fov = 40; } // the eye
directional_light { direction = (0, 0, -1); color = (1, 1, 1); }
SCENE
  for ((i = 0; i < 30; ++i)); do echo "translate(-3, -2, $((-i)), scale(0.5, box { name = \"box $i\"; }))"; done
  echo 'sphere { name = "ball"; material = { diffuse = (0.9, 0.1, 0.1) } } // object 30'
} >scene.ray
cp scene.ray other.ray

step wait 'set width 60' wait 'panel Scene' 'select camera 0'
for ((i = 0; i < 44; ++i)); do step; done
step 'select camera 0' # 45
for ((i = 0; i < 9; ++i)); do step; done
step 'select object 0' # 55
for ((i = 0; i < 5; ++i)); do step; done
step 'select none 0' # 61
for ((i = 0; i < 5; ++i)); do step; done
step 'select none 0' # 67
for ((i = 0; i < 5; ++i)); do step; done
step 'panel Controls' # 73
for ((i = 0; i < 6; ++i)); do step; done
step 'set spp 3' 'drop scene.ray' # 80
for ((i = 0; i < 5; ++i)); do step; done
start scene.ray

press() { xdotool key "$@"; next; }
pressUntil() { # KEY LANDMARK
  for ((tries = 0; tries < 12; ++tries)); do
    [[ "$(line focused)" != "$2" ]] || return 0
    press "$1"
  done
  fail "step $now: $1 never comes to \"$2\""
}

# Menus.
press F10
is popup open "F10 opens a menu"
is focused 'action New scene...' "the keyboard is at its first entry"
pressUntil Down 'action Open reference...'
press Right
is focused 'action Undo' "Right opens the next menu"
press Escape
is popup none "Esc closes it"
press alt+h
is focused 'action Keys and mouse' "Alt with its first letter opens a menu"
press Return
is popup open "Enter takes an entry: the list of keys"
press Escape
is popup none "Esc closes it"

# The list of the panel Scene, and fields.
press alt+3
pressUntil Down 'entry background 0'
press Return
is selected 'background 0' "Enter selects"
pressUntil Down 'entry object 0'
press space
is selected 'object 0' "Space selects"
pressUntil Up 'entry camera 0'
press space
pressUntil Tab 'field position number 1'
press Escape

# Delete takes one thing out, once, and undo brings it back.
click entry object 0
press Delete
is objects 30 "the key deletes what is selected"
is selected 'none 0' "then nothing is selected"
press Delete
is objects 30 "so that nothing else is deleted"
press ctrl+z
is objects 31 "undo brings it back"
click entry object 0
goTo button Delete
slowly xdotool click --repeat 2 --delay 20 1
next
is objects 30 "a double click deletes one object"
press ctrl+z
click entry object 0
goTo button Duplicate
slowly xdotool click --repeat 2 --delay 20 1
next
is objects 32 "a double click makes one copy"
press ctrl+z
is objects 31 "undo takes it back"

# A camera that looks at a point goes on looking at it, in the file too; Ctrl+S saves over that.
((now < 45)) || fail "more steps than were foreseen: $now"
skipTo 45
goTo field position number 0
doubleClickAndType 3
xdotool key Return
next
is undo 'camera: position' "a position was typed"
press Delete
is objects 31 "a camera is not deleted"
press ctrl+s
next
is edited no "Ctrl+S saves the scene"
is popup none "it asks nothing"
cmp <(sed 's/position = (0, 0, 8)/position = (3, 0, 8)/' other.ray) <(grep -v '^settings' scene.ray) ||
  fail "more than the position and the width is saved"

# What is typed out of range is said.
goTo field fov number 0
doubleClickAndType 500
xdotool key Return
next
[[ "$(line logged)" == 'camera: fov: expected 0 to 180, found 500'* ]] || fail "the log says: $(line logged)"
((now < 55)) || fail "more steps than were foreseen: $now"
skipTo 55
goTo field scale number 0
doubleClickAndType 0
xdotool key Return
next
[[ "$(line logged)" == 'scale box 0 was not taken: expected a factor '* ]] || fail "the log says: $(line logged)"
is edited no "neither is taken"

# From where the camera is: a click selects what is there, the list scrolls to it, the wheel goes on from there.
((now < 61)) || fail "more steps than were foreseen: $now"
skipTo 61
is selected 'none 0' "nothing is selected"
click from camera
is from-camera yes "the view is the camera's"
click space
is selected 'object 30' "the ball is in the middle"
next
grep -q ' entry object 30$' "$now" || fail "the list does not scroll to the object"
skipTo 67
goTo space
xdotool click 4
next
is from-camera no "the wheel leaves the camera"
xdotool click 1
next
is selected 'object 30' "the view goes on where the camera was"

# Looking for an option that there is not; and Enter opens a file.
skipTo 73
click find an option
xdotool type --delay 5 zzz
next
grep -q ' nothing found$' "$now" || fail "it is not said that nothing was found"
press ctrl+o
click file other.ray
press Return
next
is file other.ray "Enter opens the file that was clicked"

# Leaving a scene that was changed: Save writes it over its file and goes on.
skipTo 80
is popup open "it is asked first"
goTo button Save
xdotool click 1
next
is file scene.ray "what was interrupted goes on"
grep -q 'spp = 3' other.ray || fail "Save does not write over the file"
kill $program
program=''
echo "menus, lists, fields, deleting, saving: all by keyboard and mouse"

#!/usr/bin/env bash
# Fields of the panels Scene and Controls that name other things: links between lights and objects, and files.
# Exits 77 where that cannot be tried. Usage: fields_test.sh RAY_STUDIO
set -euo pipefail
studio="$1"
source "$(dirname -- "${BASH_SOURCE[0]}")/display.sh"
source "$(dirname -- "${BASH_SOURCE[0]}")/steps.sh"
openDisplay

cat >scene.ray <<'SCENE'
SBT-raytracer 1.0
camera { position = (0, 0, 8); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }
directional_light { name = "sun"; direction = (0, 0, -1); color = (1, 1, 1); }
point_light { name = "lamp"; position = (0, 5, 5); color = (1, 1, 1); }
goniometric_light { position = (0, 5, 0); direction = (0, -1, 0); color = (1, 1, 1); }
sphere { name = "ball"; material = { diffuse = (0.9, 0.1, 0.1) } } // red
box { name = "crate"; }
SCENE
printf 'P3 1 1 255 0 255 0\n' >leaf.ppm
printf 'IESNA:LM-63-1995\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0 1 1 10\n0 45 90\n0\n100 50 0\n' >lamp.ies

step 'set width 40' wait 'panel Scene' 'select object 0' # 0
for ((i = 0; i < 16; ++i)); do step; done
step 'select light 1' # 17
for ((i = 0; i < 16; ++i)); do step; done
step 'save-scene linked.ray' 'select light 2' # 34
for ((i = 0; i < 12; ++i)); do step; done
step 'panel Controls' # 47
for ((i = 0; i < 12; ++i)); do step; done
step 'save-scene files.ray' # 60
start scene.ray

seek field lit_by names
click field lit_by names
click field lit_by name lamp
is undo 'ball: lit_by' "the object chose its light"
xdotool key Escape
skipTo 17
seek field excludes names
click field excludes names
click field excludes name ball
is undo 'lamp: excludes' "the light left an object out"
click field excludes name crate
click field excludes name ball
xdotool key Escape
skipTo 34
grep -q 'ball.*lit_by = ("lamp").*// red' linked.ray || fail "lit_by was not saved: $(cat linked.ray)"
grep -q 'lamp.*excludes = ("crate")' linked.ray || fail "excludes was not saved: $(cat linked.ray)"

# A photometric file, from the dialog and then by its name; one that is not there is not taken.
typeName() { xdotool click 1 key ctrl+a type --delay 5 "$1"; xdotool key Return; next; }
seek field file text
click field file choose
goTo file lamp.ies
xdotool click --repeat 2 --delay 20 1
next
next
is undo 'goniometric_light, line 5: file' "the file was chosen in the dialog"
goTo field file text
typeName gone.ies
line logged | grep -q 'not taken' || fail "the log does not say that it was not taken: $(line logged)"

# Files of options: the backdrop and the picture all around, typed and chosen.
skipTo 47
for option in backdrop environment; do
  goTo find an option
  xdotool click 1 key ctrl+a type --delay 5 "$option"
  next
  goTo type $option
  typeName gone.ppm
  is "chosen $option" none "a file that is not there is not taken"
  goTo type $option
  typeName leaf.ppm
  [[ "$(line "chosen $option")" == */leaf.ppm ]] || fail "$option is $(line "chosen $option"), not leaf.ppm"
done
click choose environment
goTo file leaf.ppm
xdotool click --repeat 2 --delay 20 1
next
[[ "$(line 'chosen environment')" == */leaf.ppm ]] || fail "the dialog chose $(line 'chosen environment')"
skipTo 60
grep -q 'file = "lamp.ies"' files.ray || fail "the photometry was not saved: $(cat files.ray)"
grep -q 'backdrop = "leaf.ppm"' files.ray || fail "the backdrop was not saved: $(cat files.ray)"

# The time limit of the command holds for a script that waits for ever.
printf 'await never-made\n' >waits
code=0
"$studio" --script waits --time-limit 1 2>late || code=$?
[[ "$code" == 5 ]] || fail "a script that is late ends with $code, not 5: $(cat late)"
grep -q 'waits:1:1: error: the time limit of 1 s is over' late || fail "a late script says: $(cat late)"

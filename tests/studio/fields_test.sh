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
sphere { name = "ball"; material = { diffuse = (0.9, 0.1, 0.1) } } // red
box { name = "crate"; }
SCENE

step 'set width 40' wait 'panel Scene' 'select object 0' # 0
for ((i = 0; i < 16; ++i)); do step; done
step 'select light 1' # 17
for ((i = 0; i < 16; ++i)); do step; done
step 'save-scene linked.ray' # 34
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

#!/usr/bin/env bash
# Textures in the panel Scene, by mouse and keyboard: another kind, its numbers, a texture within, a file, back to a
# plain value, undo; and what is saved then. Exits 77 where that cannot be tried. Usage: textures_test.sh RAY_STUDIO
set -euo pipefail
studio="$1"
source "$(dirname -- "${BASH_SOURCE[0]}")/display.sh"
source "$(dirname -- "${BASH_SOURCE[0]}")/steps.sh"
openDisplay

cat >scene.ray <<'SCENE'
SBT-raytracer 1.0
camera { position = (0, 0, 8); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }
directional_light { direction = (0, 0, -1); color = (1, 1, 1); }
sphere { material = { diffuse = checker { a = (0.9, 0.1, 0.1); scale = (0.5, 0.5, 0.5) }; specular = (0.2, 0.2, 0.2) } } // red
SCENE
printf 'P3\n1 1\n255\n0 255 0\n' >leaf.ppm

step 'set width 40' wait 'panel Scene' 'select material 0' # 0
for ((i = 0; i < 60; ++i)); do step wait; done
step 'save-scene saved.ray' # 61
step 'action Undo' 'action Undo' 'action Undo' 'save-scene undone.ray' # 62
for ((i = 0; i < 10; ++i)); do step; done
step 'save-scene plain.ray' # 73
for ((i = 0; i < 12; ++i)); do step; done
step 'save-scene mended.ray' # 86
start scene.ray

double() { goTo "${@:2}"; slowly doubleClickAndType "$1"; xdotool key Return; next; }
material='material 1: '

# A number of the texture.
double 0.25 field diffuse scale number 1
is undo "${material}diffuse checker scale" "the checker was scaled"
# Another kind: what both have is kept.
click field diffuse kind
click field diffuse kind brick
is undo "${material}diffuse brick" "the checker became bricks"
grep -q 'field diffuse mortar number 0' "$now" || fail "bricks have no field mortar"
# A texture within it.
click field diffuse a texture
click field diffuse a kind noise
is undo "${material}diffuse brick a noise" "the bricks have noise"
# What is typed and not taken is told with the whole way to the field.
says() { line logged | grep -qF -- "$1" || fail "step $now: the log does not say \"$1\": $(line logged)"; }
# A ramp begins with the colours that it takes the place of.
seek field diffuse a ramp add
click field diffuse a ramp add
is undo "${material}diffuse brick a noise ramp" "the noise has a ramp"
grep -q 'field diffuse a b idle' "$now" || fail "nothing says that b counts no longer"
seek field diffuse a seed number 0
double -99999999999 field diffuse a seed number 0
is undo "${material}diffuse brick a noise seed" "the seed is the nearest that there is"
sleep 0.5 # else the next click would be the third, on the same place within 0.3 s
next
double -99999999999 field diffuse a seed number 0 # changes nothing, so that no render is logged after it
says "${material}diffuse brick a noise seed: expected -1000000000 to 1000000000, found -99999999999"
seek field diffuse mortar number 0
double abc field diffuse mortar number 0
says "${material}diffuse brick mortar: expected 0 or more, found \"abc\"; not taken"
sleep 0.5 # else the next click would be the third, on the same place within 0.3 s
next
double 0,9 field diffuse mortar number 0
says 'found "0,9"; not taken; a point stands before decimals: 0.9'
goTo list
xdotool mousemove_relative 0 250 click --repeat 30 --delay 20 4
next
# A picture on another field, by its name, which counts from the scene's folder; one that is not there is not taken.
seek field specular texture
click field specular texture
click field specular kind image
seek field specular file text
goTo field specular file text
typeName() { xdotool click 1 key ctrl+a type --delay 5 "$1"; xdotool key Return; next; }
typeName gone.ppm
grep -q 'field specular flaw' "$now" || fail "nothing says that a picture without a file is black"
is undo "${material}specular image" "a file that is not there is not taken"
line logged | grep -q 'not taken' || fail "the log does not say that it was not taken: $(line logged)"
goTo field specular file text
typeName leaf.ppm
is undo "${material}specular image file" "a file that is there is"
# A bar moves no other one, and the list has one of its own.
press() { goTo "$@"; xdotool mousedown 1; }
drag() { slowly press "${@:3}"; next; xdotool mousemove_relative -- "$1" "$2"; next; xdotool mouseup 1; next; }
edge() { line "box" | grep -- " $*\$" | cut -d' ' -f"$edge"; }
edge=1 right="$(edge right bar)" left="$(edge left bar)"
drag 600 0 left bar
[[ "$(edge right bar)" == "$right" ]] || fail "the right bar moved with the left one: $(edge right bar), not $right"
[[ "$(edge left bar)" -gt "$left" ]] || fail "the left bar did not move: $(edge left bar)"
drag -600 0 left bar
edge=2 below="$(edge list bar)"
drag 0 -100 list bar
[[ "$(edge list bar)" == "$((below - 100))" ]] || fail "the list did not shrink: $(edge list bar), not $below - 100"
skipTo 61
grep -q 'diffuse = brick { a = noise { }' saved.ray || grep -q 'diffuse = brick {.*noise {' saved.ray ||
  fail "the bricks were not saved: $(cat saved.ray)"
tr -d '\n' <saved.ray | grep -q 'seed = -1000000000; *ramp = ((0, 1, 1, 1), (1, 0, 0, 0))' ||
  tr -d '\n' <saved.ray | grep -q 'ramp = ((0, 1, 1, 1), (1, 0, 0, 0)); .*seed = -1000000000' ||
  fail "the noise was not saved: $(cat saved.ray)"
grep -q 'mage { file = "leaf.ppm"' saved.ray || fail "the picture was not saved: $(cat saved.ray)"
grep -q '// red' saved.ray || fail "the comment went"
skipTo 62
grep -q 'specular = (0.2, 0.2, 0.2)' undone.ray || fail "undo keeps the texture: $(cat undone.ray)"
# Back to a plain value, which is the one that scaled the texture.
goTo list
xdotool mousemove_relative 0 250 click --repeat 20 --delay 20 4
next
click field diffuse kind
click field diffuse kind plain
is undo "${material}diffuse plain" "the texture went"
skipTo 73
grep -q 'diffuse = (1, 1, 1)' plain.ray || fail "the plain value was not saved: $(cat plain.ray)"
# A formula with a mistake stays in its field to be mended.
click field diffuse texture
click field diffuse kind formula
seek field diffuse value text
goTo field diffuse value text
typeName '0.5 * sin(x'
line logged | grep -q 'not taken' || fail "the log does not say that the formula was not taken: $(line logged)"
is undo "${material}diffuse formula" "a formula with a mistake was taken"
goTo field diffuse value text
xdotool click 1 key End type --delay 5 ')'
xdotool key Return
next
is undo "${material}diffuse formula value" "the formula was not mended"
skipTo 86
grep -q '"0.5 \* sin(x)"' mended.ray || fail "the mended formula was not saved: $(cat mended.ray)"

#!/usr/bin/env bash
# Drives the studio's window with a real mouse and keyboard: what is clicked, typed and pressed, also when the
# window is too slow to see each event by itself. Exits 77 where that cannot be tried.
# Usage: input_test.sh RAY_STUDIO
set -euo pipefail
studio="$1"
source "$(dirname -- "${BASH_SOURCE[0]}")/display.sh"
source "$(dirname -- "${BASH_SOURCE[0]}")/steps.sh"
openDisplay

cat >scene.ray <<'SCENE'
SBT-raytracer 1.0
camera { position = (0, 0, 8); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }
directional_light { direction = (0, 0, -1); color = (1, 1, 1); }
sphere { name = "ball"; material = { diffuse = (0.9, 0.1, 0.1) } }
SCENE
sed 's/0.9/0.5/' scene.ray >other.ray

step wait 'set width 100' wait 'pixel 50 50' rays pin rays 'panel Scene' 'select object 0' # 0
step                                       # 1: a number was typed into "turn", not yet finished
step                                       # 2: it was
step                                       # 3: another was taken back with Esc
step 'panel Controls' 'set moments 3'      # 4: the controls
step                                       # 5: moments was reset with x
step                                       # 6: the region was typed
step                                       # 7: a menu is open
step                                       # 8: Ctrl+Z while it was open
step                                       # 9: Esc closed it
step                                       # 10: options are looked for
step 'set width 200' wait rays             # 11: the pixel keeps its place
step 'open other.ray' wait rays            # 12: pinned rays went
step 'set spp 3' 'drop scene.ray'          # 13: an option that a scene keeps was changed: it is asked
step                                       # 14: Save as... was clicked
step                                       # 15: Enter: the file exists
step                                       # 16: Enter replaces it, and the scene that was dropped is opened
step 'panel Scene' 'select camera 0'       # 17: a field of view was typed that sees nothing
step 'select object 0'                     # 18: and a matrix that makes the ball flat
step                                       # 19: it was typed
start scene.ray

# A double click and a number, all within one frame: typed once, applied once, and only on Enter.
is pinned yes "the rays were pinned"
goTo field turn number 2
slowly doubleClickAndType 90
next
is undo width "a number that is being typed does not count yet"
xdotool key Return
next
is undo 'turn ball' "Enter makes it count"
goTo field move number 0
slowly doubleClickAndType 7
xdotool key Escape
next
is undo 'turn ball' "Esc takes it back"
next

# Options: x resets; a region; what is typed replaces all of a field after Ctrl+A, however slow the window is.
is 'chosen moments' 3 "the script sets it"
goTo reset moments
xdotool click 1
next
is 'chosen moments' 16 "x goes back to what the file says"
goTo option region
typeRegion() { xdotool click 1; xdotool type --delay 5 '9 9'; xdotool key ctrl+a; xdotool type --delay 5 '1, 2, 30 40'; }
slowly typeRegion
xdotool key Return
next
is 'chosen region' 1,2,30,40 "it was typed, in place of something else"
goTo menu View
xdotool click 1
next
is popup open "a click opens a menu"
xdotool key ctrl+z
next
is 'chosen region' 0,0,0,0 "Ctrl+Z works while a menu is open"
xdotool key Escape
next
is popup none "Esc closes a menu"
goTo find an option
xdotool click 1
xdotool type --delay 5 ANTIALIAS
xdotool key Return
next
[[ -n "$(grep ' option spp$' "$now")" ]] || fail "spp is not found as ANTIALIAS"
[[ -z "$(grep ' option width$' "$now")" ]] || fail "width is found as ANTIALIAS"
next
is pixel '101 101' "the chosen pixel stays where it is in the picture"
is traced '101 101' "its rays are shown"
next
is pinned no "another scene was opened"
is pixel '' "another scene was opened"
next

# Another scene is opened after what was changed is saved, with Enter alone in the dialog.
is edited yes "spp was chosen"
is file other.ray "it is asked first"
is popup open "it is asked"
goTo button Save as
xdotool click 1
next
is popup open "the dialog asks where"
xdotool key Return
next
is popup open "the file exists"
! grep -q spp other.ray || fail "the file was replaced unasked"
xdotool key Return
next
grep -q 'spp = 3' other.ray || fail "a second Enter does not replace the file"
is file scene.ray "what was interrupted goes on once the scene is saved"
is popup none "nothing is asked any more"
next

# What would lose the camera or the object goes back, and the log says so.
goTo field fov number 0
doubleClickAndType 180
xdotool key Return
logged="$(line log)"
next
is edited no "a field of view of 180 degrees is not taken"
(($(line log) > logged)) || fail "the log does not say that a field of view was not taken"
goTo field matrix x number 0
doubleClickAndType 0
xdotool key Return
logged="$(line log)"
next
is edited no "a matrix that makes the ball flat is not taken"
(($(line log) > logged)) || fail "the log does not say that a matrix was not taken"
: >"go-$now"
wait $program || fail "the script failed"
program=''
echo "double clicks, typed numbers, keys in menus: all came through"

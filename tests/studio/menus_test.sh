#!/usr/bin/env bash
# Goes along the menus and through the fields of a panel by keyboard, types what is no number, and undoes a delete.
# Exits 77 where that cannot be tried. Usage: menus_test.sh RAY_STUDIO
set -euo pipefail
studio="$1"
source "$(dirname -- "${BASH_SOURCE[0]}")/display.sh"
source "$(dirname -- "${BASH_SOURCE[0]}")/steps.sh"
openDisplay

{
  cat <<'SCENE'
SBT-raytracer 1.0
camera { position = (0, 0, 8); look_at = (0, 0, 0); fov = 40; }
directional_light { direction = (0, 0, -1); color = (1, 1, 1); }
SCENE
  for ((i = 0; i < 30; ++i)); do echo "translate(-3, -2, $((-i)), scale(0.5, box { name = \"box $i\"; }))"; done
  echo 'difference { box { material = { name = "bitten"; diffuse = (0.9, 0.1, 0.1) } }
    sphere { material = { name = "inner"; diffuse = (0.1, 0.9, 0.1) } } }'
} >scene.ray

step wait 'set width 60' wait 'panel Scene' 'select camera 0'
for ((i = 0; i < 30; ++i)); do step; done
step 'select object 12' # 31
for ((i = 0; i < 8; ++i)); do step; done
step 'select material 2' # 40
step
start scene.ray
press() { xdotool key "$@"; next; }

# Left and right go from menu to menu, round the bar.
press alt+f
is focused 'action New scene...' "Alt+F opens the first menu"
press Right
is focused 'action Undo' "Right opens the next"
press Right
is focused 'action Render' "and the next"
press Left
press Left
is focused 'action New scene...' "Left goes back"
press Left
is focused 'action Keys and mouse' "round the bar to the last"
press Right
is focused 'action New scene...' "and to the first again"
is popup open "all the while a menu is open"
press Escape
is popup none "Esc closes it"

# Tab goes on where it was, whatever Esc has ended.
press alt+3
for ((tries = 0; tries < 6; ++tries)); do
  [[ "$(line focused)" != 'field position number 1' ]] || break
  press Tab
done
is focused 'field position number 1' "Tab goes to the fields"
press Escape
press Tab
press Escape
is focused 'field position number 2' "Tab after Esc goes to the next field"
press Escape
press Escape
press Tab
press Escape
is focused 'field viewdir number 0' "Tab goes on after Esc that ended nothing"

# What is typed and is no number is said.
goTo field fov number 0
doubleClickAndType 4x5
xdotool key Return
next
[[ "$(line logged)" == 'camera: fov: expected 0 to 180, found "4x5"; not taken' ]] || fail "the log says: $(line logged)"
is undo width "it is not taken"
goTo field fov number 0
doubleClickAndType 4e1
xdotool key Return
next
is undo width "4e1 is the 40 of before"

# A chosen object stands whole in the list; undo of its deletion chooses it again.
skipTo 31
whole() {
  local row list
  row=($(grep -- "^box .* entry object 12\$" "$now" | cut -d' ' -f2-5)) || fail "the list does not show the object"
  list=($(grep -- '^box .* list$' "$now" | cut -d' ' -f2-5))
  ((row[1] >= list[1] && row[3] <= list[3])) || fail "row ${row[*]} is not whole in ${list[*]}"
}
whole
goTo button Delete
xdotool click 1
next
is selected 'none 0' "nothing is selected after Delete"
press ctrl+z
is selected 'object 12' "undo chooses what came back"
whole
press ctrl+y
is selected 'none 0' "redo takes it away"
press ctrl+z

# Materials of parts are in use.
skipTo 40
grep -q ' used by 1$' "$now" || fail "the material of a part is used by no object"
kill $program
program=''
echo "menus, Tab, lists, typed letters: as they should be"

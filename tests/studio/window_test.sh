#!/usr/bin/env bash
# Opens the studio on a display of its own, renders, changes an option, clicks a pixel, saves and quits, and looks
# at what came out. Exits 77 where that cannot be tried. Usage: window_test.sh RAY_STUDIO CHECKOUT COUNT_PIXELS
set -euo pipefail
studio="$1" root="$2" countPixels="$3"
source "$(dirname -- "${BASH_SOURCE[0]}")/display.sh"
cp -- "$root/scenes/shapes.ray" scene.ray

# Without a display: a clear error and the exit code for input and output.
code=0
env -u DISPLAY "$studio" scene.ray >log 2>&1 || code=$?
[[ $code == 1 ]] || fail "without a display it exits with $code, not 1"
grep -q 'display' log || fail "without a display it does not say so"


# What is asked of the program needs none. Its flags are those of `ray`.
ray="$(dirname -- "$studio")/ray"
[[ "$("$studio" --version)" == "$("$ray" --version)" ]] || fail "--version is not that of ray"
for help in -h --help '--help all' 'scene.ray -w 20 -Bt1 --help'; do
  # shellcheck disable=SC2086
  "$studio" $help | grep -q '^usage: ray-studio' || fail "$help does not help"
done
refused() { # WORDS EXPECTED
  # shellcheck disable=SC2086
  env -u DISPLAY "$studio" $1 >log 2>&1 && fail "$1 is taken"
  grep -q -- "$2" log || fail "\"$1\" is refused otherwise than with \"$2\""
}
refused '-w' '"-w": expected a value after it'
refused '--depth' '"--depth": expected a value after it'
refused '-Aq' 'unknown flag "-q": expected --NAME VALUE, or one of -h -w'
refused '-o x.png' 'Export picture'
refused '--version=2' '--version: takes no value'
refused '--no-denoise=on' '--no-denoise: takes no value'
refused '--no-width' 'unknown option "no-width"'
refused 'a.ray -- -w' 'at most one scene, found also "-w"'
for taken in '--denoise scene.ray' '--no-denoise scene.ray' '--denoise off scene.ray' '-abAB scene.ray' '-At1 -w20 -- scene.ray'; do
  refused "$taken" 'display'  # what is wrong is the display alone
done

openDisplay
pixels() { # PICTURE FORMULA: of how many pixels it is above 0
  local count
  count="$("$countPixels" "$1" "$2")" || fail "the pixels of $1 cannot be counted"
  echo "${count%% of *}"
}

cat >script <<'END'
wait
set width 160
set spp 1
wait
save small.png
set depth 0
wait
action Undo
wait
pixel 40 50
rays
ray 1
save-rays rays.svg
save-rays rays.png
panel Scene
select object 1
panel Controls
screenshot window.png
END
code=0
"$studio" scene.ray --script script >log 2>&1 || code=$?
[[ $code == 0 ]] || fail "the script ended with exit code $code"
for picture in small.png window.png; do
  [[ "$(head -c 4 "$picture" | tail -c 3)" == PNG ]] || fail "$picture was not written"
done
grep -q '<svg' rays.svg || fail "the rays are not drawn as SVG"
[[ "$(head -c 4 rays.png | tail -c 3)" == PNG ]] || fail "the rays are not drawn as PNG"
(($(stat -c %s window.png) > 20000)) || fail "the window shows almost nothing"

# The same file as from the command line; and a script fails when it should.
"$(dirname -- "$studio")/ray" scene.ray plain.png -w 160 -A 2>log || fail "ray does not render the scene"
cmp small.png plain.png || fail "the picture is not the one of the command line"
echo 'open nothing.ray' >script
code=0
"$studio" --script script >log 2>&1 || code=$?
[[ $code == 1 ]] || fail "a script that fails ends with exit code $code"
grep -q 'script:1' log || fail "a script that fails does not name its line"

# Options of the command line, and of a script before it opens a scene, hold for each scene that is opened.
cp scene.ray other.ray
cat >script <<'END'
set spp 4
open scene.ray
set depth 1
open other.ray
state options
END
"$studio" --threads 1 -w 40 --denoise --script script >log 2>&1 || fail "a scene cannot be opened after options"
for chosen in 'threads 1' 'width 40' 'spp 4' 'denoise on' 'depth 5'; do
  grep -q "^chosen $chosen\$" options || fail "the options of the second scene lack $chosen"
done

# Without a scene nothing can be saved, and no entry of a menu works that needs one.
for line in 'save none.png' 'save-scene none.ray' 'action Save scene' 'action Undo'; do
  echo "$line" >script
  code=0
  "$studio" --script script >log 2>&1 || code=$?
  [[ $code == 1 || $code == 2 ]] || fail "without a scene \"$line\" ends with exit code $code"
  grep -q 'script:1' log || fail "\"$line\" without a scene is not told with its line"
done

# What there is not is no place to click or to select; and what the command line names is told by itself.
for line in 'select object 99' 'select light -1' 'pixel 400 3' 'pixel 0 -1'; do
  printf '%s\n' wait "$line" >script
  code=0
  "$studio" scene.ray --script script >log 2>&1 || code=$?
  [[ $code == 2 ]] || fail "\"$line\" ends with exit code $code, not 2"
  grep -q 'script:2:1' log || fail "\"$line\" is not told with its line"
done
echo 'pixel 0 0' >script
! "$studio" --script script >log 2>&1 || fail "a pixel is clicked without a scene"
grep -q 'script:1:1.*no scene' log || fail "\"pixel\" without a scene is not told with its line"
printf 'SBT-raytracer 1.0\n@\n' >broken.ray
for script in '' '# nothing' wait; do
  echo "$script" >script
  for start in 'scene.ray --reference none.png' none.ray broken.ray; do
    code=0
    # shellcheck disable=SC2086
    "$studio" $start --script script >log 2>&1 || code=$?
    [[ $code == 1 ]] || fail "\"$start\" with the script \"$script\" ends with exit code $code, not 1"
    grep -q 'none\|broken.ray:2' log || fail "\"$start\" is refused without its name"
    ! grep -q 'script' log || fail "\"$start\" is told as a mistake of the script"
  done
done

# A script is looked at whole before it begins: all that is wrong in it is said, and nothing was done.
cat >script <<'END'
save early.png
set depth deep
# set nothing 1
flip
action Undo it
pixel 1
select sphere 0
view 9
screenshot window.txt
END
code=0
"$studio" scene.ray --script script >log 2>&1 || code=$?
[[ $code == 2 ]] || fail "a script with mistakes ends with exit code $code, not 2"
for line in 2 4 5 6 7 8 9; do grep -q "script:$line:" log || fail "the mistake in line $line is not told"; done
for line in 1 3; do ! grep -q "script:$line:" log || fail "line $line is no mistake"; done
[[ ! -e early.png ]] || fail "a script with mistakes did something"

# The view in space shows the same whatever the order of the objects: what is nearer hides, or shows through.
head='SBT-raytracer 1.0
camera { position = (0, 0, 8); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }
directional_light { direction = (0, 0, -1); color = (1, 1, 1); }'
objects=(
  'translate(-1.5, 0, 0, sphere { material = { diffuse = (0.9, 0.1, 0.1) } })'
  'translate(-1.5, 0, 0, scale(0.5, sphere { material = { diffuse = (0.1, 0.1, 0.9) } }))'
  'translate(1.5, 0, 0, sphere { material = { diffuse = (0.1, 0.6, 0.1); transmissive = (0.5, 0.9, 0.5) } })'
  'translate(1.5, 0, 0, scale(0.6, box { material = { diffuse = (0.6, 0.1, 0.1); transmissive = (0.9, 0.5, 0.5) } }))'
  'translate(0, -1.5, 0, scale(6, 0.1, 6, box { material = { diffuse = (0.6, 0.6, 0.1); transmissive = (0.9, 0.9, 0.5) } }))')
{ echo "$head"; printf '%s\n' "${objects[@]}"; } >forward.ray
{ echo "$head"; printf '%s\n' "${objects[@]}" | tac; } >backward.ray
for scene in forward backward; do
  printf '%s\n' wait 'set width 64' wait "screenshot $scene.png space" >script
  "$studio" $scene.ray --script script >log 2>&1 || fail "the view in space of $scene.ray cannot be shown"
done
(($(stat -c %s forward.png) > 3000)) || fail "the view in space shows almost nothing"
cmp forward.png backward.png || fail "the view in space depends on the order of the objects in the file"

# A closed room around the camera is seen into from outside, whatever its walls are made of.
head='SBT-raytracer 1.0
camera { position = (0, 0, 3); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }
directional_light { direction = (0, 0, -1); color = (1, 1, 1); }
scale(0.7, sphere { material = { diffuse = (0.9, 0, 0) } })'
echo "$head scale(8, box { material = { diffuse = (0, 0, 0.5) } })" >box.ray
{ echo "$head"
  for turn in '0, 1, 0, 0' '0, 1, 0, 1.5708' '0, 1, 0, 3.1416' '0, 1, 0, -1.5708' '1, 0, 0, 1.5708' '1, 0, 0, -1.5708'; do
    echo "rotate($turn, translate(0, 0, 4, scale(8, 8, 1, square { material = { diffuse = (0, 0, 0.5) } })))"
  done; } >walls.ray
for scene in box walls; do
  printf '%s\n' wait 'set width 64' wait "screenshot $scene.png space" >script
  "$studio" $scene.ray --script script >log 2>&1 || fail "the view in space of $scene.ray cannot be shown"
  red="$(pixels $scene.png 'r - 0.3')"
  ((red > 500)) || fail "the room of $scene.ray is closed: $red pixels are red"
done

# Frames are drawn when something changed, and the view in space only when it did itself.
cat >script <<'END'
wait
set width 64
wait
pixel 20 20
rays
state before
panel Scene
panel Controls
select object 1
select camera 0
state after
await go
state idle
END
{ sleep 2; touch go; } &  # in which the studio looks for news some sixty times
"$studio" scene.ray --script script >log 2>&1 || fail "the script of idle frames failed"
count() { grep "^$2 " "$1" | cut -d' ' -f2; }
(($(count after frames) > $(count before frames) + 8)) || fail "frames are not counted"
(($(count after space-drawn) <= $(count before space-drawn) + 3)) ||
  fail "the view in space is drawn in every frame"
(($(count after space-drawn) > $(count before space-drawn))) ||
  fail "the view in space does not show what is selected"
# A few steps make the view in space smooth.
(($(count idle frames) <= $(count after frames) + 16)) || fail "frames are drawn while nothing happens"

# The mouse over the view in space draws no surface again; a drag does, and what it ends with becomes smooth.
cat >script <<'END'
wait
set width 64
wait
pixel 20 20
rays
hover 2 space
screenshot before.png space
state before
hover 10 space
state hovered
drag 10 space
state dragged
screenshot turned.png space
END
"$studio" scene.ray --script script >log 2>&1 || fail "the view in space cannot be turned"
(($(count hovered space-drawn) == $(count before space-drawn))) || fail "the view in space is drawn for the mouse"
(($(count dragged space-drawn) >= $(count hovered space-drawn) + 8)) || fail "the view in space does not turn"
! cmp -s before.png turned.png || fail "the view in space is as before it was turned"

# When another scene is opened, nothing of the one before stays; why a pixel is black, and what cures it.
cp -- "$root/scenes/lessons/black-glass.ray" black.ray
cat >script <<'END'
open black.ray
set width 240
wait
pixel 75 78
rays
state black
drag 0 cure Pin and try depth 5
wait
rays
state cured
action Undo
wait
rays
state undone
END
"$studio" scene.ray --script script >log 2>&1 || fail "a black pixel is not explained"
grep -q '^why Black: the ray that should leave glass was not sent: depth limit 1\.$' black || fail "it does not say why a pixel is black"
(($(count black fault) > 0)) || fail "no ray is at fault"
grep -q ' cure depth 2$' black || fail "no button deepens by one"
grep -q '^chosen depth 5$' cured || fail "the cure does not choose the depth"
grep -q '^pinned yes$' cured || fail "the cure does not pin the rays"
grep -q '^fault -1$' cured || fail "the cure does not cure"
grep -q '^chosen depth 1$' undone || fail "the cure is not undone"

# The start page has lessons; a click opens one. The stage shows picture and rays alone, and steps through them.
cat >script <<'END'
state start
drag 0 start Black glass
wait
set width 240
wait
pixel 75 78
rays
action Stage
state staged
screenshot staged.png
action Stage
state left
END
"$studio" --script script >log 2>&1 || fail "the start page or the stage is not shown"
grep -q ' start Shadow acne$' start || fail "the start page has no lessons"
grep -q '^file black-glass.ray$' staged || fail "a click on a lesson does not open it"
grep -q '^stage yes$' staged || fail "there is no stage"
grep -q ' stage caption$' staged || fail "the stage has no caption"
! grep -q ' panel Log$' staged || fail "the stage shows panels"
grep -q '^stage no$' left || fail "the stage is not left"

# Files dropped onto the window; from a bad sample to its rays, and through them one by one; a background; themes.
cat >bad.ray <<'END'
SBT-raytracer 1.0
camera { position = (0, 0, 6); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }
background { colors = ((0.2, 0.4, 0.8), (0.8, 0.8, 0.9)); limits = (0.7); }
ambient_light { color = (0.3e308, 0.3, 0.3); }
directional_light { direction = (0, 0, -1); color = (1, 1, 1); }
sphere { material = { emissive = (1.7e308, 0, 0); ambient = 1; diffuse = 0.5; reflective = 0.5 } }
END
cat >script <<'END'
drop scene.ray
drop plain.png
set width 160
wait
view 4
save-scene kept.ray
drop bad.ray
set width 40
wait
bad 0
rays
ray 1
step 1
step 1
step -1
boxes
panel Bad samples
panel Scene
select background 0
action Light theme
action Larger text
screenshot bad.png
save-scene saved.ray
action Quit
END
code=0
"$studio" --script script >log 2>&1 || code=$?
[[ $code == 0 ]] || fail "the second script ended with exit code $code"
[[ "$(head -c 4 bad.png | tail -c 3)" == PNG ]] || fail "bad.png was not written"
grep -q 'limits = (0.7)' saved.ray || fail "the background was not saved"
echo 'bad 0' >script
code=0
"$studio" scene.ray --script script >log 2>&1 || code=$?
[[ $code == 2 ]] || fail "a script that asks for a bad sample of a good picture ends with exit code $code"

# Paths from both ends and their ways; a chain of mlt, move by move; a shadow ray that is blocked is drawn.
cat >lamp.ray <<'END'
SBT-raytracer 1.0
settings { integrator = bdpt; depth = 3; spp = 4; sampling = sobol; width = 40; chain-starts = 500; }
camera { position = (0, 1, 6); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 40; }
translate(0, 2, 0, scale(0.3, sphere { name = "lamp"; material = { emissive = (4, 4, 4) } }))
rotate(1, 0, 0, -1.5708, scale(8, 8, 1, square { material = { diffuse = (0.7, 0.7, 0.7) } }))
translate(0, 2, -3, scale(8, 8, 1, square { material = { diffuse = (0.7, 0.7, 0.7) } }))
END
cat >blocked.ray <<'END'
SBT-raytracer 1.0
camera { position = (0, 2, 6); viewdir = (0, -0.3, -1); updir = (0, 1, 0); fov = 40; }
point_light { position = (0, 3, 0); color = (1, 1, 1); constant_attenuation_coeff = 1; }
translate(0, 2, 0, sphere { material = { diffuse = (0.2, 0.2, 0.2) } })
rotate(1, 0, 0, -1.5708, scale(8, 8, 1, square { material = { diffuse = (0.2, 0.2, 0.2) } }))
END
cat >script <<'END'
open lamp.ray
wait
pixel 12 20
rays
tab Ways
way 0
state ways
set light-vertices 30
wait
rays
tab Ways
state without-ways
set light-vertices -1
wait
rays
tab Pyramid
rays
rays
screenshot pyramid.png pyramid 1 2
state pyramid
alone 1 2
rays
state alone
screenshot alone.png picture
set depth 2
wait
rays
state again
alone 1 2
state all-ways
set integrator mlt
wait
rays
tab Chain
state chain
move 1
rays
state moved
open blocked.ray
set width 40
wait
pixel 20 20
rays
screenshot blocked.png space
END
"$studio" --script script >log 2>&1 || fail "ways or chains are not shown"
grep -q '^ways [1-9]' ways || fail "a pixel of bdpt has no ways"
grep -q ' no ways$' without-ways || fail "the tab Ways does not stay and say why it is empty"
grep -q '^way 0' ways || fail "a way cannot be chosen"
grep -q '^pyramid 14$' pyramid || fail "the pyramid has not all its pictures"
grep -q ' pyramid 0 5$' pyramid || fail "the last row of the pyramid is not to be seen"
bright="$(pixels pyramid.png 'r + g + b - 0.3')"
((bright > 20)) || fail "the pyramid's picture of s = 1, t = 2 is black: $bright pixels are bright"
grep -q '^alone 1 + 2 alone: ' alone || fail "a way is not seen alone"
[[ "$(grep '^undo ' alone)" == "$(grep '^undo ' pyramid)" ]] || fail "looking at a way alone is a step of undo"
diff <(grep '^chosen ' pyramid) <(grep '^chosen ' alone) || fail "looking at a way alone changes options"
grep -q '^alone 1 + 2 alone: ' again || fail "the way is not made anew"
grep -q '^alone ' all-ways && fail "the way stays alone"
grep -q '^chain [0-9]* of [1-9]' chain || fail "no chain is followed"
at() { grep '^chain ' "$1" | cut -d' ' -f2; }
(($(at moved) == $(at chain) + 1)) || fail "the chain does not go on"
red="$(pixels blocked.png 'min(r - 0.6, r - 1.6 * g)')"
((red > 8)) || fail "a blocked shadow ray is not drawn: $red red points"

# In a small window the legend of rays leaves the switches above it free, also beside the pyramid.
cat >script <<'END'
open lamp.ray
wait
pixel 12 20
rays
tab Pyramid
rays
rays
state small
END
"$studio" --window 800x600 --script script >log 2>&1 || fail "the small window is not shown"
side() { grep -- "^box .* $2\$" small | cut -d' ' -f"$1"; }
grep -q '^box .* legend camera$' small || fail "the small window has no legend"
(($(side 3 'legend camera') >= $(side 5 'from camera'))) || fail "the legend covers the switches of the view in space"
grep -q ' pyramid 0 5$' small || fail "the last row of the pyramid is not to be seen in a small window"

# What was changed is remembered, and `ray` alone opens the window that remembers it.
command -v xdotool >/dev/null || skip "there is no xdotool; ./dev setup all installs it"
"$(dirname -- "$studio")/ray" >log 2>&1 &
program=$!
timeout 60 xdotool search --sync --onlyvisible --name '^Trace$' >/dev/null || fail "ray alone opens no window"
xdotool key ctrl+l ctrl+q
wait "$program" || fail "ray alone does not open a window that closes when asked"
grep -q '^theme light' config/trace/studio.txt || fail "the theme is not remembered"
echo "the window opened, rendered, changed, saved and closed"

#!/usr/bin/env bash
# A minute of clicks, drags and keys at random: the window does not crash or hang, and writes no scene.
# Exits 77 where that cannot be tried. Usage: monkey_test.sh RAY_STUDIO CHECKOUT
set -euo pipefail
studio="$1" root="$2"
source "$(dirname -- "${BASH_SOURCE[0]}")/display.sh"
openDisplay
cp -- "$root/scenes/shapes.ray" scene.ray
cp scene.ray before.ray

for seed in 1 2 3; do
  cat >script <<END
set width 60
set spp 1
wait
pixel 20 20
rays
monkey 500 $seed
state state
screenshot window.png
END
  code=0
  "$studio" scene.ray --max-memory 2000 --time-limit 600 --script script >log 2>&1 || code=$?
  [[ $code == 0 ]] || fail "seed $seed: the studio ended with exit code $code"
  (($(sed -n 's/^frames //p' state) > 500)) || fail "seed $seed: fewer frames were drawn than asked for"
done
cmp -s scene.ray before.ray || fail "the scene's file was written"
[[ "$(find . -newer before.ray -name '*.ray' | wc -l)" == 0 ]] || fail "scenes were written: $(ls)"
echo "the monkey broke nothing"

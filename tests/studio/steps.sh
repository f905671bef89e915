# Sourced after display.sh by tests that use a real mouse and keyboard: the script of the studio writes the
# window's state into 0, 1, 2 ..., says so, and goes on when somebody has made go-0, go-1 ...
command -v xdotool >/dev/null || skip "there is no xdotool; ./dev setup all installs it"

steps=0
step() { printf '%s\n' "$@" "state $steps" "say $steps" "await go-$steps" >>script; steps=$((steps + 1)); }

mkfifo said
now=0
start() {  # SCENE: the studio, up to the state 0
  "$studio" "$1" --script script >said 2>log &
  program=$!
  exec 4<said
  await
}
# Waits for the state `now`.
await() {
  local said=''
  read -r -t 100 -u 4 said || fail "the studio ended, or hangs, before state $now"
  [[ "$said" == "$now" ]] || fail "the studio wrote state $said, not $now"
}
# The state after all that was done up to now: what xdotool sent has arrived when it ends, and the studio goes on
# when it has seen all that has arrived.
next() { : >"go-$now"; now=$((now + 1)); await; }
# On to that state, past steps that were foreseen and not needed: the studio takes them at once.
skipTo() {
  ((now <= $1)) || fail "more steps than were foreseen: $now"
  for ((i = now; i < $1; ++i)); do : >"go-$i"; done
  while ((now < $1)); do
    now=$((now + 1))
    await
  done
}
line() { grep -- "^$1 " "$now" | cut -d' ' -f"$(($(wc -w <<<"$1") + 1))-" || true; }
is() { [[ "$(line "$1")" == "$2" ]] || fail "step $now: $1 is \"$(line "$1")\", expected \"$2\": $3"; }
goTo() {
  local at
  at="$(grep -- "^at [0-9-]* [0-9-]* $*\$" "$now" | cut -d' ' -f2,3 || true)"
  [[ -n "$at" ]] || fail "step $now: the window does not show \"$*\""
  # shellcheck disable=SC2086
  xdotool mousemove $at
}
# All of it arrives at once, as if the last frame had taken that long.
slowly() { kill -STOP "$program"; "$@"; kill -CONT "$program"; }
doubleClickAndType() { xdotool click --repeat 2 --delay 20 1 type --delay 5 -- "$1"; }
click() { goTo "$@"; xdotool click 1; next; }  # needs a step
# Takes a step for each turn of the wheel that it needs.
seek() { # LANDMARK...: the fields of the panel Scene scroll down until it is well in sight
  local place
  for ((tries = 0; tries < 12; ++tries)); do
    place="$(grep -- "^at [0-9-]* [0-9-]* $*\$" "$now" | cut -d' ' -f3 || true)"
    [[ -z "$place" || "$place" -gt 782 ]] || return 0
    goTo list
    xdotool mousemove_relative 0 250 click --repeat 3 --delay 20 5
    next
  done
  fail "step $now: \"$*\" is not to be found"
}

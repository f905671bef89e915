# Sourced after display.sh by tests that use a real mouse and keyboard: the script of the studio writes the
# window's state into 0, 1, 2 ... and goes on when somebody has made go-0, go-1 ...
command -v xdotool >/dev/null || skip "there is no xdotool; ./dev setup all installs it"

steps=0
step() { printf '%s\n' "$@" "state $steps" "await go-$steps" >>script; steps=$((steps + 1)); }

now=0
# Waits for the state `now`, then sees to it that the next one is written after what follows.
await() {
  for ((i = 0; i < 1200; ++i)); do
    [[ ! -s "$1" ]] || return 0
    kill -0 "$program" 2>/dev/null || fail "the studio ended before state $1"
    sleep 0.05
  done
  fail "the studio never wrote state $1"
}
next() { sleep 0.3; touch "go-$now"; now=$((now + 1)); await "$now"; sleep 0.1; }
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
doubleClickAndType() { xdotool click --repeat 2 --delay 20 1; sleep 0.1; xdotool type --delay 5 "$1"; }

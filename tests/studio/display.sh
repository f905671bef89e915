# Sourced by the tests of the studio: a folder and a display of their own. Expects $studio, the program; sets
# $folder and the display. Exits 77 where that cannot be had.
skip() { echo "SKIPPED: $*"; exit 77; }
fail() { echo "FAILED: $*"; cat "$folder/log" 2>/dev/null || true; exit 1; }
[[ -x "$studio" ]] || skip "ray-studio was not built; ./dev studio installs what it needs"
command -v Xvfb >/dev/null || skip "there is no Xvfb; ./dev setup all installs it"

folder="$(mktemp -d)"
server='' program=''
cleanUp() {
  [[ -z "$program" ]] || kill "$program" 2>/dev/null || true
  [[ -z "$server" ]] || kill "$server" 2>/dev/null || true
  rm -rf -- "$folder"
}
trap cleanUp EXIT
cd -- "$folder"
export XDG_CONFIG_HOME="$folder/config" LIBGL_ALWAYS_SOFTWARE=1
# Drivers keep what they took until the end, and no sanitizer can tell it from a leak.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"
unset WAYLAND_DISPLAY

openDisplay() {
  mkfifo display
  # -noreset: without it the server starts anew when the last window closes, and refuses the next one meanwhile.
  Xvfb -displayfd 3 -noreset -screen 0 1280x800x24 -nolisten tcp 3>display 2>/dev/null &
  server=$!
  read -r -t 60 number <display || skip "Xvfb does not start"
  export DISPLAY=":$number"
}

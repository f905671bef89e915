#!/usr/bin/env bash
# Tries the packages of a folder: lintian reads them, and each is installed in a bare Debian and used as a newcomer would.
# The archive is tried there, too, and on the Debian before, whose C library is older than what it was built with.
# Needs root for the bare Debians, and says so where it is none. Usage: check.sh FOLDER
set -euo pipefail

folder="$(CDPATH='' cd -- "$1" && pwd -P)"
work="$(mktemp -d /var/tmp/trace-packages.XXXXXX)"
trap 'rm -rf --one-file-system -- "$work"' EXIT
say() { printf 'packages: %s\n' "$*" >&2; }
fail() { say "FAILED: $*"; exit 1; }
shopt -s nullglob
debs=("$folder"/*.deb) archives=("$folder"/*.tar.gz)
((${#debs[@]} + ${#archives[@]})) || fail "there is no package in $folder"

# Errors and warnings fail; of what is only told, nothing is.
lint() {
  command -v lintian >/dev/null || { say "NOT CHECKED by lintian, which is not installed"; return; }
  local found
  found="$(lintian --fail-on none "${debs[@]}" 2>&1 | grep -E '^[EW]:' || true)"
  [[ -z "$found" ]] || { echo "$found" >&2; fail "lintian finds this"; }
  say "lintian finds nothing in ${#debs[@]} packages"
}

# A command in the root of that name.
within() {
  local root="$work/$1"
  shift
  unshare --mount --pid --fork --mount-proc="$root/proc" bash -c '
    mount --bind /dev "$1/dev"
    exec chroot "$1" env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin \
      LANG=C.UTF-8 TERM=dumb DEBIAN_FRONTEND=noninteractive bash -c "cd /root && $2" </dev/null' within "$root" "$1"
}

# A bare Debian in $work/NAME. Usage: bareRoot NAME SUITE [SOURCE]
bareRoot() {
  local name="$1" suite="$2" sources=() options=() file
  shift 2
  if (($#)); then
    sources=("$@")
  else  # where this machine takes its packages from
    for file in /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list; do
      [[ ! -s "$file" ]] || sources+=("$file")
    done
  fi
  for file in /etc/apt/apt.conf.d/*; do
    ! grep -qi acquire "$file" || options+=("--aptopt=$file")
  done
  # With manual pages, which containers often leave out.
  mmdebstrap --quiet --variant=apt "${options[@]}" "$suite" "$work/$name" "${sources[@]}" >"$work/$name.log" 2>&1 &&
    within "$name" 'apt-get update' >>"$work/$name.log" 2>&1
}

install='apt-get install -yq --no-install-recommends'

tryProgram() {
  local begin seconds picture='ray new first.ray && ray first.ray --quick -q && test -s first.png'
  within bare "$install ./trace-ray_*.deb" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "trace-ray does not install"; }
  begin="$(date +%s)"
  within bare "$picture" || fail "no first picture"
  seconds=$(($(date +%s) - begin))
  ((seconds <= 10)) || fail "the first picture took $seconds s"
  say "trace-ray: the first picture $seconds s after it was installed"
  within bare "ray --version && trace-ray --version" >"$work/log" || fail "ray and trace-ray do not run"
  within bare "ray /usr/share/doc/trace-ray/scenes/glass.ray -w 64 -q" || fail "a scene of the package is not rendered"

  within bare "$install man-db bash-completion" >"$work/log" 2>&1 || fail "no man-db, no bash-completion"
  within bare "man ray" >"$work/page" || fail "man ray"
  grep -q -- '--depth' "$work/page" || fail "man ray has no --depth"
  [[ -z "$(within bare "man --warnings ray 2>&1 >/dev/null; man --warnings trace-ray 2>&1 >/dev/null")" ]] ||
    fail "man warns of the page"
  within bare '. /usr/share/bash-completion/bash_completion; _completion_loader ray; complete -p ray
    COMP_WORDS=(ray first.ray --accel b) COMP_CWORD=3; _trace_ray; test ${COMPREPLY[0]} = bvh' >"$work/log" 2>&1 ||
    { cat "$work/log" >&2; fail "the completion of ray does not load"; }
  say "trace-ray: runs, man shows its page, bash completes it"
}

tryStudio() {
  within bare "$install ./trace-ray-studio_*.deb" >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "trace-ray-studio does not install"; }
  within bare "ray-studio --version && ray gui --help && man ray-studio" >"$work/log" || fail "ray-studio does not run"
  grep -q '^Trace ' "$work/log" || fail "ray-studio tells no version"
  say "trace-ray-studio: runs, as far as that can be seen without a display; man shows its page"
}

tryDoc() {
  within bare "$install ./trace-ray-doc_*.deb && test -s /usr/share/doc/trace-ray/docs/options.md" >"$work/log" 2>&1 ||
    fail "trace-ray-doc does not install"
  say "trace-ray-doc: the pages are there"
}

# The examples in C++ are compiled against the installed package, and one renders.
tryLibrary() {
  within bare "$install g++ cmake make pkg-config ./libtraceray0_*.deb ./libtraceray-dev_*.deb" >"$work/log" 2>&1 ||
    { cat "$work/log" >&2; fail "libtraceray-dev does not install"; }
  within bare 'cp -r /usr/share/doc/libtraceray-dev/examples/cpp mine && cmake -S mine -B mine/build && make -C mine/build &&
    mine/build/build_a_scene built.png && test -s built.png && pkg-config --exists traceray' >"$work/log" 2>&1 ||
    { cat "$work/log" >&2; fail "an example in C++ does not compile or run"; }
  say "libtraceray-dev: its examples compile, and one renders"
}

tryPython() {
  within bare "$install ./libtraceray0_*.deb ./python3-traceray_*.deb" >"$work/log" 2>&1 ||
    { cat "$work/log" >&2; fail "python3-traceray does not install"; }
  within bare 'python3 -c "
import traceray
scene = traceray.Scene()
scene.add(traceray.shapes.sphere(material=\"gold\"), traceray.lights.point_light(position=(3, 4, 5)))
shape = scene.render(width=32, spp=1).image.shape
assert shape == (24, 32, 3), shape"' >"$work/log" 2>&1 || { cat "$work/log" >&2; fail "a first picture in Python"; }
  say "python3-traceray: builds a scene and renders it to numpy"
}

# What was installed goes without a trace, and a `ray` of somebody else stays what it was.
tryLeaving() {
  within bare 'dpkg --purge python3-traceray libtraceray-dev libtraceray0 trace-ray-studio trace-ray-doc trace-ray' >"$work/log" 2>&1 || fail "the packages do not go"
  within bare 'for left in /usr/bin/ray /usr/bin/trace-ray /usr/libexec/trace-ray /usr/share/doc/trace-ray /usr/lib/libtraceray* \
      /usr/lib/python3/dist-packages/traceray /etc/alternatives/ray*; do test ! -e "$left" || { echo "$left"; exit 1; }; done' ||
    fail "files are left"
  within bare "echo other >/usr/bin/ray; $install ./trace-ray_*.deb" >"$work/log" 2>&1 || fail "beside another ray trace-ray does not install"
  within bare 'test "$(cat /usr/bin/ray)" = other && trace-ray --version' >"$work/log" || fail "another ray was overwritten"
  within bare 'dpkg --purge trace-ray; test "$(cat /usr/bin/ray)" = other' >"$work/log" 2>&1 || fail "another ray went with trace-ray"
  say "the packages leave nothing, and another program's /usr/bin/ray as it was"
}

tryArchive() {  # ROOT WORDS
  cp -- "${archives[0]}" "$work/$1/root/"
  within "$1" 'tar -xzf trace-ray-*-linux-*.tar.gz; cd trace-ray-*/; rm -f first.*
    PATH=$PWD/bin:$PATH; ray --version; ray new first.ray; ray first.ray --quick -q; test -s first.png
    ln -s "$PWD/bin/ray" /usr/local/bin/ray; cd /; /usr/local/bin/ray --version' >"$work/log" 2>&1 ||
    { cat "$work/log" >&2; fail "the archive does not run on $2"; }
  say "the archive runs on $2 ($(within "$1" 'ldd --version | head -n 1'))"
}

((${#debs[@]} == 0)) || lint
[[ $EUID == 0 ]] || { say "NOT TRIED in a bare Debian: that needs root"; exit 0; }
command -v mmdebstrap >/dev/null || { say "NOT TRIED in a bare Debian: mmdebstrap is not installed"; exit 0; }
suite="$(. /etc/os-release && echo "${VERSION_CODENAME:-}")"
bareRoot bare "$suite" || { tail -n 5 "$work/bare.log" >&2; say "NOT TRIED in a bare Debian: there is none to be had"; exit 0; }
if ((${#debs[@]})); then
  cp -- "${debs[@]}" "$work/bare/root/"
  tryProgram
  [[ ! -e "$(echo "$folder"/trace-ray-studio_*.deb)" ]] || tryStudio
  [[ ! -e "$(echo "$folder"/trace-ray-doc_*.deb)" ]] || tryDoc
  [[ ! -e "$(echo "$folder"/python3-traceray_*.deb)" ]] || tryPython
  [[ ! -e "$(echo "$folder"/libtraceray-dev_*.deb)" ]] || tryLibrary
  tryLeaving
fi
if ((${#archives[@]})); then
  tryArchive bare "this Debian"
  if bareRoot before bullseye 'deb http://deb.debian.org/debian bullseye main'; then
    tryArchive before "Debian 11"
  else
    say "the archive was NOT TRIED on Debian 11, whose packages cannot be had here"
  fi
fi
say "all that could be tried works"

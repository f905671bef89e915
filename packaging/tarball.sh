#!/usr/bin/env bash
# Packs what is built into one archive that runs on any Linux of this processor, however old or new its C library is: the
# libraries that the programs need lie within, the C library and its loader among them.
# Usage: tarball.sh BUILD_FOLDER OUT_FOLDER; prints the archive's name.
set -euo pipefail

build="$1" out="$2"
here="$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)"
fail() { echo "tarball: $*" >&2; exit 1; }
[[ -x "$build/bin/ray" ]] || fail "there is no $build/bin/ray"
version="$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")"
name="trace-ray-$version-linux-$(uname -m)"
stage="$(mktemp -d)"
trap 'rm -rf -- "$stage"' EXIT

umask 022
cmake --install "$build" --prefix "$stage/$name" --strip >/dev/null
cd "$stage/$name"
programs=libexec/trace-ray
third=share/doc/trace-ray/third-party
mkdir -p "$programs/system" "$programs/lib" "$third"

# The libraries of a program, one a line: its name and its file.
libraries() {
  ldd "$1" | sed -nE 's/^\s*(\S+) => (\S+) .*/\1 \2/p'
  echo "$(basename "$(loader "$1")") $(loader "$1")"
}
loader() { ldd "$1" | sed -nE 's/^\s*(\/\S+) \(.*/\1/p'; }

declare -A packages
take() {  # NAME FILE FOLDER
  cp -L -- "$2" "$3/$1"
  local package
  package="$(dpkg-query -S "$(readlink -f "$2")" "$2" 2>/dev/null | sed -n '1s/:.*//p' || true)"
  [[ -z "$package" ]] || packages["$package"]=1
}

for program in ray ray-studio; do
  [[ -x "$programs/$program" ]] || continue
  while read -r library file; do
    case "$library" in
      # What belongs to the screen comes from the machine that has it.
      libGL* | libOpenGL* | libEGL* | libX* | libxcb* | libbsd* | libmd.*) ;;
      ld-linux* | libc.* | libm.* | libpthread.* | libdl.* | librt.* | libstdc++.* | libgcc_s.* | libz.*)
        take "$library" "$file" "$programs/system" ;;
      *) take "$library" "$file" "$programs/lib" ;;
    esac
  done < <(libraries "$programs/$program")
done
loader="$(basename "$(loader "$programs/ray")")"
glibc="$(getconf GNU_LIBC_VERSION | sed 's/.* //')"

rm -f bin/trace-ray bin/ray-studio
sed -e "s|@LOADER@|$loader|; s|@GLIBC@|$glibc|" "$here/launcher.sh" >bin/trace-ray
chmod 755 bin/trace-ray
if [[ -x "$programs/ray-studio" ]]; then
  ln -s trace-ray bin/ray-studio
  ln -s ../../../bin/ray-studio "$programs/system/ray-studio"  # beside the loader, where `ray gui` looks
fi

for package in "${!packages[@]}" libcli11-dev libstb-dev nlohmann-json3-dev libtinyobjloader-dev libtinygltf-dev libimgui-dev; do
  [[ -n "$package" && -f "/usr/share/doc/$package/copyright" ]] || continue
  cp -- "/usr/share/doc/$package/copyright" "$third/$package.copyright"
done
{
  echo "The programs hold, or come with, files of these Debian packages. Their sources: https://snapshot.debian.org"
  echo
  for file in "$third"/*.copyright; do
    dpkg-query -W -f '${Package} ${Version}\n' "$(basename "${file%.copyright}")" 2>/dev/null || true
  done | sort -u
} >"$third/README"

mkdir -p "$out"
archive="$out/$name.tar.gz"
date="$(git -C "$here" log -1 --format=%ct 2>/dev/null || date +%s)"
tar -C "$stage" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$date" -cf - "$name" | gzip -9n >"$archive"
echo "$archive"

#!/usr/bin/env bash
# Packs the programs for Windows into one archive: a folder with ray.exe and ray-studio.exe, which need nothing else, the scenes and
# the licences of the libraries in them.
# Usage: windows.sh BUILD_FOLDER OUT_FOLDER; prints the archive's name.
set -euo pipefail

build="$1" out="$(cd -- "$2" && pwd -P)"
root="$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)"
fail() { echo "windows: $*" >&2; exit 1; }
for program in ray ray-studio; do
  [[ -x "$build/bin/$program.exe" ]] || fail "there is no $build/bin/$program.exe"
done
version="$(sed -n 's/^CMAKE_PROJECT_VERSION:STATIC=//p' "$build/CMakeCache.txt")"
name="trace-ray-$version-windows-x86_64"
stage="$(mktemp -d)"
trap 'rm -rf -- "$stage"' EXIT

umask 022
folder="$stage/$name"
mkdir -p "$folder/licences"
for program in ray ray-studio; do
  x86_64-w64-mingw32-strip -o "$folder/$program.exe" "$build/bin/$program.exe"
done
cp -r -- "$root/scenes" "$folder/scenes"
cp -- "$root/LICENSE" "$folder/LICENSE.txt"
sed 's/$/\r/' >"$folder/README.txt" <<'END'
Trace, the ray tracer you can see inside

Double-click ray-studio.exe, or ray.exe: a window opens. Choose a scene, and click a pixel to see its rays.
Drag a scene of the folder "scenes" onto ray.exe: its picture appears beside it.
Edit a scene with a text editor, and drag it onto ray.exe to see the change.

In a terminal, in this folder:

    .\ray.exe scenes\glass.ray -o glass.png
    .\ray.exe help

These programs were tried under Wine. The window needs OpenGL 3.3. Programs of students in a sandbox (ray grade --run) are for
Linux only. The folder "licences" holds the licences of the libraries in the programs.
END
licence() {  # PACKAGE of Debian, or a file of its source
  local file="/usr/share/doc/$1/copyright"
  [[ -f "$file" ]] || file="$(ls -d "$root/build/windows-libraries/sources/$1"-[0-9]*/debian/copyright 2>/dev/null | head -n 1)"
  [[ -f "$file" ]] || fail "no licence of $1"
  cp -- "$file" "$folder/licences/$1.txt"
}
for package in openexr imath libwebp draco meshoptimizer imgui glfw3 libz-mingw-w64-dev mingw-w64-x86-64-dev gcc-mingw-w64-x86-64-posix-runtime \
  libcli11-dev libstb-dev nlohmann-json3-dev libtinyobjloader-dev libtinygltf-dev; do
  licence "$package"
done

date="$(git -C "$root" log -1 --format=%ct 2>/dev/null || date +%s)"
find "$folder" -exec touch -h -d "@$date" {} +
rm -f -- "$out/$name.zip"
(cd "$stage" && find "$name" -type f | sort >list && cmake -E tar cf "$out/$name.zip" --format=zip --files-from=list)
echo "$out/$name.zip"

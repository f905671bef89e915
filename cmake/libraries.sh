#!/usr/bin/env bash
# Fills a folder with the libraries of Trace for a platform that Debian has no packages for: compiles Debian's sources of
# them, and links the headers of those that are only headers.
#
#   libraries.sh windows|web FOLDER     takes five to ten minutes on two cores; what is there is not compiled again
set -euo pipefail

platform="$1"
folder="$(mkdir -p -- "$2" && cd -- "$2" && pwd -P)"
here="$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)"
sources="$folder/sources"
case "$platform" in
  windows) how=(-DCMAKE_TOOLCHAIN_FILE="$here/windows/toolchain.cmake" -DTRACE_WINDOWS_LIBRARIES="$folder") ;;
  web)
    export NODE_PATH=/usr/share/nodejs EMSCRIPTEN=/usr/share/emscripten  # Debian's places; Draco asks for the second
    flags='-pthread -fexceptions'
    how=(-DCMAKE_TOOLCHAIN_FILE="$EMSCRIPTEN/cmake/Modules/Platform/Emscripten.cmake" -DCMAKE_FIND_ROOT_PATH="$folder"
         -DCMAKE_PREFIX_PATH="$folder" -DCMAKE_C_FLAGS="$flags" -DCMAKE_CXX_FLAGS="$flags")
    ;;
  *) echo "libraries.sh: the platforms are windows and web, not $platform" >&2; exit 2 ;;
esac

# The sources of the release that this machine runs, by lists of our own: those of the machine stay as they are.
fetchSources() {
  local release apt
  release="$(. /etc/os-release && echo "$VERSION_CODENAME")"
  mkdir -p "$sources/lists" "$sources/cache"
  cd "$sources"
  echo "deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] http://deb.debian.org/debian $release main" >sources.list
  apt=(apt-get -q -o "Dir::Etc::SourceList=$sources/sources.list" -o Dir::Etc::SourceParts=/dev/null
       -o "Dir::State::Lists=$sources/lists" -o "Dir::Cache=$sources/cache" -o APT::Sandbox::User=root)
  "${apt[@]}" update
  "${apt[@]}" --download-only source "$@"
  local description name
  for description in *.dsc; do
    name="$(tr _ - <<<"${description%-*}")"  # its folder: imath-3.1.6 of imath_3.1.6-1.dsc
    [[ -d "$name" ]] || dpkg-source --no-check -x "$description"
  done
}

sourceOf() { echo "$sources/$1"-[0-9]*; }

compile() {  # SOURCE, then options of cmake
  local source name
  source="$(sourceOf "$1")"
  name="$1"
  shift
  cmake -S "$source" -B "$folder/build/$name" -G Ninja -DCMAKE_BUILD_TYPE=Release "${how[@]}" \
    -DCMAKE_INSTALL_PREFIX="$folder" -DCMAKE_INSTALL_LIBDIR=lib \
    -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF -DCMAKE_POLICY_VERSION_MINIMUM=3.5 "$@"
  cmake --build "$folder/build/$name"
  cmake --install "$folder/build/$name"
}

# Files or folders of /usr/include. Links, since that folder holds the headers of this system too.
headers() {
  local header
  mkdir -p "$folder/include"
  for header in "$@"; do
    ln -sfn "/usr/include/$header" "$folder/include/$header"
  done
}

# A file by which find_package finds a library that is all headers.
package() {  # PACKAGE TARGET VERSION
  local package="$1" target="$2" version="$3" dir="$folder/lib/cmake/$1"
  mkdir -p "$dir"
  cat >"$dir/${package}Config.cmake" <<END
if(NOT TARGET $target)
  add_library($target INTERFACE IMPORTED)
  target_include_directories($target INTERFACE $folder/include)
endif()
END
  cat >"$dir/${package}ConfigVersion.cmake" <<END
set(PACKAGE_VERSION $version)
set(PACKAGE_VERSION_COMPATIBLE TRUE)
END
}

# A file by which pkg-config finds a library: some install it on other systems only.
describe() {  # NAME VERSION LIBRARIES [FLAGS]
  mkdir -p "$folder/lib/pkgconfig"
  printf '%s\n' "Name: $1" "Description: $1" "Version: $2" "Libs: -L$folder/lib $3" "Cflags: -I$folder/include ${4:-}" \
    >"$folder/lib/pkgconfig/$1.pc"
}

zlib() {  # for the web, where its own rules would make a shared library; Debian has it for Windows
  local source
  source="$(sourceOf zlib)"
  mkdir -p "$folder/build/zlib" "$folder/lib" "$folder/include"
  cp "$source/zlib.h" "$source/zconf.h" "$folder/include/"
  (cd "$folder/build/zlib" && emcc $flags -O2 -DHAVE_UNISTD_H -c "$source"/*.c && emar rcs "$folder/lib/libz.a" ./*.o)
}

headers CLI nlohmann stb tiny_obj_loader.h tiny_gltf.h
package CLI11 CLI11::CLI11 2
package nlohmann_json nlohmann_json::nlohmann_json 3
if [[ "$platform" == windows ]]; then
  fetchSources imath openexr libwebp draco meshoptimizer glfw3 imgui  # the last is compiled with the studio
  describe zlib 1.2 -l:libz.a  # from Debian's libz-mingw-w64-dev
else
  fetchSources zlib imath openexr libwebp draco meshoptimizer imgui  # the last is compiled with the studio
  zlib
fi
describe OpenEXR 3.1 '-lOpenEXR-3_1 -lOpenEXRCore-3_1 -lIlmThread-3_1 -lIex-3_1 -lImath-3_1 -l:libz.a' \
  "-I$folder/include/OpenEXR -I$folder/include/Imath"
describe draco 1.5 -ldraco
compile meshoptimizer
compile imath -DPYTHON=OFF
compile openexr -DOPENEXR_BUILD_TOOLS=OFF -DOPENEXR_INSTALL_EXAMPLES=OFF -DOPENEXR_INSTALL_TOOLS=OFF
compile libwebp -DWEBP_BUILD_{ANIM_UTILS,CWEBP,DWEBP,GIF2WEBP,IMG2WEBP,VWEBP,WEBPINFO,WEBPMUX,EXTRAS}=OFF
compile draco -DDRACO_TESTS=OFF -DDRACO_JS_GLUE=OFF
[[ "$platform" != windows ]] || compile glfw3 -DGLFW_BUILD_{EXAMPLES,TESTS,DOCS}=OFF
if [[ "$platform" == windows && -d /usr/src/googletest ]]; then
  ln -sfn /usr/src/googletest "$sources/googletest-0"
  compile googletest -DBUILD_GMOCK=OFF
fi
touch "$folder/complete"

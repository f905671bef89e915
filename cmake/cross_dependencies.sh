#!/usr/bin/env bash
# Builds the libraries of Trace for another platform from Debian's own source packages, as static libraries, and installs
# them into PREFIX; headers that need no compiling are linked from /usr/include. What is there already is left alone.
# Usage: cross_dependencies.sh PLATFORM PREFIX     PLATFORM: web
set -euo pipefail
platform="$1"
prefix="$(mkdir -p -- "$2" && cd -- "$2" && pwd -P)"
work="$prefix/sources"
mkdir -p "$work/lists" "$prefix/include"

case "$platform" in
  web)
    flags='-pthread -fexceptions -msimd128'
    configure=(emcmake cmake)
    cc=emcc
    ar=emar
    export NODE_PATH=/usr/share/nodejs  # where Debian keeps what Emscripten needs
    export EMSCRIPTEN=/usr/share/emscripten  # Draco asks for it
    ;;
  *) echo "cross_dependencies.sh: unknown platform: $platform" >&2; exit 2 ;;
esac

aptSources() {  # apt-get with a list of its own, so that the machine's stays as it is
  apt-get -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o Dir::State::Lists="$work/lists" -o APT::Sandbox::User=root "$@"
}

fetch() {  # PACKAGE: unpacks its original source into $work/PACKAGE
  [[ ! -d "$work/$1" ]] || return 0
  if ! compgen -G "$work/lists/*_Sources*" >/dev/null; then
    local mirror
    mirror="$(grep -rhoE 'https?://[^ ]*/debian/?( |$)' /etc/apt/sources.list /etc/apt/sources.list.d 2>/dev/null | head -n 1 || true)"
    echo "deb-src ${mirror:-http://deb.debian.org/debian} bookworm main" >"$work/sources.list"
    aptSources update >&2
  fi
  (cd "$work" && aptSources source --download-only "$1" >&2)
  local archive
  archive="$(find "$work" -maxdepth 1 -name "$1_*.orig.tar.*" ! -name '*.asc')"
  mkdir "$work/$1.part"
  tar -xf "$archive" -C "$work/$1.part" --strip-components=1
  mv "$work/$1.part" "$work/$1"
}

library() {  # PACKAGE CMAKE-OPTION...
  local package="$1"
  shift
  [[ ! -f "$prefix/built/$package" ]] || return 0
  fetch "$package"
  echo "cross_dependencies.sh: building $package" >&2
  "${configure[@]}" -S "$work/$package" -B "$work/$package.build" -G Ninja -D CMAKE_BUILD_TYPE=Release \
    -D CMAKE_INSTALL_PREFIX="$prefix" -D CMAKE_FIND_ROOT_PATH="$prefix" -D CMAKE_PREFIX_PATH="$prefix" \
    -D BUILD_SHARED_LIBS=OFF -D BUILD_TESTING=OFF -D CMAKE_C_FLAGS="$flags" -D CMAKE_CXX_FLAGS="$flags" "$@" >&2
  cmake --build "$work/$package.build" --target install >&2
  mkdir -p "$prefix/built"
  touch "$prefix/built/$package"
}

headers() {  # those of Debian's packages that have nothing to compile
  local name
  for name in "$@"; do ln -sfn "/usr/include/$name" "$prefix/include/$name"; done
  mkdir -p "$prefix/share/cmake"
  cp -r /usr/share/cmake/CLI11 /usr/share/cmake/nlohmann_json "$prefix/share/cmake/"
}

zlib() {  # whose own rules make shared libraries too
  [[ ! -f "$prefix/lib/libz.a" ]] || return 0
  fetch zlib
  echo "cross_dependencies.sh: building zlib" >&2
  mkdir -p "$prefix/lib/pkgconfig" "$work/zlib.build"
  (cd "$work/zlib.build" && "$cc" $flags -O2 -DHAVE_UNISTD_H -c "$work"/zlib/*.c && "$ar" rcs libz.a ./*.o)
  cp "$work/zlib/zlib.h" "$work/zlib/zconf.h" "$prefix/include/"
  cp "$work/zlib.build/libz.a" "$prefix/lib/"
}

zlib
library imath
library openexr -D OPENEXR_BUILD_TOOLS=OFF -D OPENEXR_INSTALL_EXAMPLES=OFF
library libwebp -D WEBP_BUILD_ANIM_UTILS=OFF -D WEBP_BUILD_CWEBP=OFF -D WEBP_BUILD_DWEBP=OFF -D WEBP_BUILD_GIF2WEBP=OFF \
  -D WEBP_BUILD_IMG2WEBP=OFF -D WEBP_BUILD_VWEBP=OFF -D WEBP_BUILD_WEBPINFO=OFF -D WEBP_BUILD_WEBPMUX=OFF \
  -D WEBP_BUILD_EXTRAS=OFF
flags="${flags/ -msimd128/}" library meshoptimizer  # its lanes are for a newer Emscripten
library draco -D DRACO_JS_GLUE=OFF
headers CLI nlohmann stb tiny_gltf.h tiny_obj_loader.h
fetch imgui

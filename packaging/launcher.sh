#!/bin/sh
# Starts the program of this name in ../libexec/trace-ray with the libraries that lie there, by their own loader: so the C
# library of the machine may be older. It may be newer, too: then the studio, whose drivers want that one, takes it.
self=$(readlink -f -- "$0") || exit 1
home=$(dirname -- "$(dirname -- "$self")")/libexec/trace-ray
system=$home/system

case $(basename -- "$0") in
  ray-studio)
    machine=$(getconf GNU_LIBC_VERSION 2>/dev/null | sed 's/.* //')
    if [ "$(printf '%s\n' @GLIBC@ "$machine" | sort -V | head -n 1)" = @GLIBC@ ]; then
      LD_LIBRARY_PATH=$home/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} exec "$home/ray-studio" "$@"
    fi
    exec "$system/@LOADER@" --argv0 ray-studio --library-path "$system:$home/lib" "$home/ray-studio" "$@" ;;
  *) exec "$system/@LOADER@" --argv0 ray --library-path "$system:$home/lib" "$home/ray" "$@" ;;
esac

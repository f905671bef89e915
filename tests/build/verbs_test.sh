#!/bin/bash
# `./dev VERB --help` prints the usage and does nothing else; an argument that a verb does not take is an error.
# Works on a copy of the script, so that a fault harms no build.
set -euo pipefail
source_folder="$1"
copy="$(mktemp -d)"
trap 'rm -rf "$copy"' EXIT
cp "$source_folder/dev" "$copy/dev"
mkdir "$copy/build"
for verb in clean gallery lessons features screenshots docs site floors words info; do
  said="$("$copy/dev" "$verb" --help 2>&1)" || { echo "./dev $verb --help fails: $said"; exit 1; }
  grep -q '^usage: ./dev' <<<"$said" || { echo "./dev $verb --help prints no usage: $said"; exit 1; }
  [[ "$verb" != gallery ]] || continue  # takes names
  if said="$("$copy/dev" "$verb" everything 2>&1)"; then echo "./dev $verb everything is no error"; exit 1; fi
  grep -q "'everything'" <<<"$said" || { echo "./dev $verb everything does not name the argument: $said"; exit 1; }
  [[ -d "$copy/build" ]] || { echo "./dev $verb removed the build"; exit 1; }
done

#!/usr/bin/env bash
# Checks names: every file and folder that the pages on the source name is there; and functions that are local to a file are called
# differently in every file of a folder, for these are compiled together (together.cmake), where one might take the other's calls.
# Usage: check_names.sh [checkout]
set -euo pipefail

cd -- "${1:-"$(dirname -- "${BASH_SOURCE[0]}")/.."}"
pages=(ARCHITECTURE.md docs/developers/principles.md docs/developers/adding.md)
wrong=0 names=0
while read -r name; do
  [[ $name == ../shared* ]] && continue  # which a checkout may lack
  names=$((names + 1))
  [[ -e "$name" || -e "src/$name" ]] || { echo "${pages[*]}: there is no $name"; wrong=$((wrong + 1)); }
done < <(grep -ohE '`[a-z_.]+(/[a-z_]+)*/[a-z_]*(\.(h|cpp|sh))?`|docs/[a-z/-]+\.md' "${pages[@]}" | tr -d '`' | sort -u)

mapfile -t files < <(find src -name '*.cpp' ! -name '*_avx*' ! -path 'src/render/integrators/*' | sort)
locals="$(awk '
  FNR == 1 { local = 0; folder = FILENAME; sub(/\/[^\/]*$/, "", folder) }
  /^namespace \{/ { local = 1 }
  /^}  \/\/ namespace/ { local = 0 }
  local && /^[A-Za-z_\[][^=(]*[ &*>][A-Za-z_0-9]+\(/ && !/^(using|struct|class|return|void main)/ {
    sub(/\(.*/, ""); sub(/.*[ &*>]/, ""); print folder, $0, FILENAME
  }' "${files[@]}" | sort -u)"
while read -r folder name; do
  echo "$folder: several files have a local function $name:" \
    "$(awk -v f="$folder" -v n="$name" '$1 == f && $2 == n { print $3 }' <<<"$locals" | tr '\n' ' ')"
  wrong=$((wrong + 1))
done < <(awk '{ print $1, $2 }' <<<"$locals" | uniq -d)

echo "$names names of files, $(wc -l <<<"$locals") local functions, $wrong wrong"
((names > 0 && wrong == 0))

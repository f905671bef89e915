#!/usr/bin/env bash
# Checks that every file and folder that ARCHITECTURE.md names is there. Usage: check_names.sh [checkout]
set -euo pipefail

cd -- "${1:-"$(dirname -- "${BASH_SOURCE[0]}")/.."}"
wrong=0 names=0
while read -r name; do
  names=$((names + 1))
  [[ -e "$name" || -e "src/$name" ]] || { echo "ARCHITECTURE.md: there is no $name"; wrong=$((wrong + 1)); }
done < <(grep -oE '`[a-z_.]+(/[a-z_]+)*/[a-z_]*(\.(h|cpp|sh))?`|docs/[a-z-]+\.md' ARCHITECTURE.md | tr -d '`' | sort -u)
echo "$names names, $wrong wrong"
((names > 0 && wrong == 0))

#!/usr/bin/env bash
# Prints the graph of floors (ARCHITECTURE.md) from the #include lines of src/, and fails when one goes
# upward, sideways or through "..". CMake's include paths already keep floors apart; this shows it, and
# catches what a relative path could smuggle past them. It also fails when another file than those that need it
# sees the structs of all shapes, lights, materials or textures, which is slow to compile, and when code asks which
# integrator is chosen, or for the operating system, and when it calls a function of the C library that systems round differently.
# Usage: check_floors.sh [checkout]
set -euo pipefail

# From the bottom. Floors on one line stand side by side and never see each other.
floors='base
math
accel image
geometry
shading
scene
formats render
app
cli studio library'

# Folders that are divided into rooms, each from the bottom: a room sees only those before it in the row.
rooms='formats/ray syntax read language file write
app advice session lint explain compare grading input editing view
render world maps rays samples lights media paths photons integrators chains picture'
most=30  # files in a folder, without those in folders below it

cd -- "${1:-"$(dirname -- "${BASH_SOURCE[0]}")/.."}"
for list in material texture light; do
  seers="$(grep -rlE "^#include \"shading/${list}_list.h\"" src | sort | tr '\n' ' ')"
  case "$list $seers" in
    'material src/shading/bsdf.cpp src/shading/material_table.cpp ' | 'texture src/shading/texture_table.cpp ' | \
      'light src/shading/light_table.cpp ') ;;
    *)
      echo "only the table of ${list}s, and the Bsdfs of materials, include shading/${list}_list.h, not: $seers"
      exit 1
      ;;
  esac
done
# A struct of these lists is seen by the list and by few others: each is a unit that its change compiles again.
mostSeers=7
manySeers='shading/materials/phong.h shading/materials/subsurface.h shading/textures/image_map.h'  # that formats make
while read -r header; do
  seers="$(grep -rlF "#include \"$header\"" src --include='*.h' --include='*.cpp' | grep -v '^src/studio/' | sort)"
  if (($(wc -l <<<"$seers") > mostSeers)) && [[ " $manySeers " != *" $header "* ]]; then
    echo "$header is included by more than $mostSeers files: ask the row, or a field by its keyword; for lights shading/lights/plain_lights.h"
    echo "$seers"
    exit 1
  fi
done < <(sed -nE 's/^#include "(shading\/(lights|materials|textures)\/[a-z_]+\.h)".*/\1/p' src/shading/{light,material,texture}_list.h)
seers="$(grep -rlE '^#include "geometry/shape_list.h"' src tests bench | sort | tr '\n' ' ')"
if [[ "$seers" != 'src/geometry/shape_table.cpp src/geometry/traced.cpp src/render/world/world_queries.cpp ' ]]; then
  echo "only the table of shapes, their traced form and the World's queries include geometry/shape_list.h, not: $seers"
  exit 1
fi
if grep -rnE '[!=]= *IntegratorKind::' src; then
  echo 'ask for a trait (scene/integrators.h), not for one integrator'
  exit 1
fi
system='_WIN32|_WIN64|__MINGW|__linux__|__unix__|__APPLE__|__GLIBC__'
headers='unistd|fcntl|signal|csignal|poll|dirent|pthread|sched|malloc|windows|io|sys/[a-z]+'
if grep -rnE "^ *# *(if|elif|ifdef|ifndef).*($system)|^#include <($headers)(\.h)?>" src --include='*.h' --include='*.cpp' |
  grep -v '^src/base/os/'; then
  echo 'only src/base/os asks for the operating system, or includes its headers'
  exit 1
fi
if grep -rnE 'std::(bit_cast|rot[lr]|jthread|stop_token|ranges|views|source_location|atomic_ref)|<=>' src --exclude-dir=windows --exclude=bits.h; then
  echo 'the library of the compiler for browsers lacks this; base/bits.h has some of it'
  exit 1
fi
functions='a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p)?|pow|cbrt|hypot|erfc?|[lt]gamma|complex|polar|[a-z_]+_distribution'
if grep -rnE "std::($functions)\>|^#include <(complex|random)>" src --include='*.h' --include='*.cpp' | grep -v '^src/base/os/'; then
  echo 'its last bits differ from system to system; math/elementary.h and math/complex.h have one that does not'
  exit 1
fi
while read -r folder; do
  count="$(find "$folder" -maxdepth 1 -type f | wc -l)"
  if ((count > most)); then
    echo "$folder has $count files; a folder has at most $most: give it rooms"
    exit 1
  fi
done < <(find src -type d)
{ grep -rnE '^[[:space:]]*#[[:space:]]*include[[:space:]]*[<"]' src || true; } | FLOORS="$floors" ROOMS="$rooms" awk '
  function complain(what) { print file ":" number ": error: " what; wrong++ }
  function isIn(path, folder) { return substr(path, 1, length(folder) + 1) == folder "/" }
  function roomOf(path, folder) { path = substr(path, length(folder) + 2); sub(/\/.*/, "", path); return path }

  BEGIN {
    height = split(ENVIRON["FLOORS"], rows, "\n")
    for (i = 1; i <= height; i++) {
      n = split(rows[i], names, " ")
      for (j = 1; j <= n; j++) { level[names[j]] = i; order[++folders] = names[j] }
    }
    height = split(ENVIRON["ROOMS"], rows, "\n")
    for (i = 1; i <= height; i++) {
      n = split(rows[i], names, " ")
      for (j = 2; j <= n; j++) room[names[1], names[j]] = j
      divided[names[1]]
    }
  }

  {  # file:line:#include "to/header.h"
    file = $0; sub(/:.*/, "", file)
    number = substr($0, length(file) + 2); sub(/:.*/, "", number)
    header = substr($0, length(file) + length(number) + 3)
    sub(/^[^<"]*[<"]/, "", header); sub(/[>"].*/, "", header)
    from = file; sub(/^src\//, "", from); sub(/\/.*/, "", from)
    to = header; sub(/\/.*/, "", to)

    if (!(from in level)) complain("\"" from "\" is no floor; the list is at the top of cmake/check_floors.sh")
    else if (header ~ /(^|\/)\.\.\//) complain("\"" header "\": write the path from src, without \"..\"")
    else if (header ~ /\// && to in level && to != from) {
      uses[from, to]++; total++
      if (level[to] >= level[from])
        complain(from " includes \"" header "\", but " to " is " (level[to] > level[from] ? "above" : "beside") " it")
    }
    for (folder in divided) {
      if (!isIn(path = substr(file, 5), folder)) continue
      here = roomOf(path, folder)
      if (!((folder, here) in room)) complain("\"" here "\" is no room of " folder "; the list is at the top of cmake/check_floors.sh")
      else if (isIn(header, folder) && room[folder, roomOf(header, folder)] > room[folder, here])
        complain(here " includes \"" header "\", but that room is above it")
    }
  }

  END {
    if (NR == 0) { print "no #include found below src"; exit 1 }
    print "floor      includes (how often), from the top of the house"
    for (i = folders; i >= 1; i--) {
      line = ""
      for (j = folders; j >= 1; j--)
        if ((order[i], order[j]) in uses) line = line "  " order[j] " " uses[order[i], order[j]]
      printf "%-8s %s%s\n", order[i], line == "" ? "" : "->", line
    }
    printf "%d includes between floors, %d wrong\n", total, wrong
    exit wrong > 0
  }'

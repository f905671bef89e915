#!/usr/bin/env bash
# The solids that POV-Ray has too, each in a scene of its own in both languages, at grazing angles: pictures side by
# side, how far apart they are, and the CPU seconds of the whole programs on one thread.
#
#   shapes.sh BIN OUT [--size PIXELS] [--runs N]
#
# BIN holds ray; OUT gets NAME.ray, NAME.pov, NAME-ray.png and NAME-pov.png.
set -euo pipefail
export LC_ALL=C

bin="$(realpath "$1")" out="$(realpath -m "$2")"
shift 2
size=400 runs=3
while (($#)); do
  case "$1" in
    --size) size="$2" ;;
    --runs) runs="$2" ;;
    *) echo "shapes.sh: what is '$1'?" >&2; exit 2 ;;
  esac
  shift 2
done
command -v povray >/dev/null || { echo "bench: SKIPPED: POV-Ray is not installed" >&2; exit 0; }
mkdir -p "$out"
cd "$out"  # POV-Ray reads and writes only near here

pair() {  # NAME, the object in .ray, the object in POV-Ray's language (z is up; material comes from outside)
  cat >"$1.ray" <<END
SBT-raytracer 1.0
camera { position = (0, -5, 0.7); look_at = (0, 0, 0); updir = (0, 0, 1); fov = 30; }
directional_light { direction = (1, 1, -1); color = (0.9, 0.9, 0.9); }
directional_light { direction = (-2, 1, -0.3); color = (0.3, 0.3, 0.4); }
ambient_light { color = (1, 1, 1); }
material = { ambient = (0.08, 0.08, 0.08); diffuse = (0.7, 0.6, 0.5); };
$2
END
  cat >"$1.pov" <<END
#version 3.7;
global_settings { assumed_gamma 1.0 ambient_light rgb 1 max_trace_level 5 }
camera { location <0, -5, 0.7> sky z up z right -x angle 30 look_at 0 }
light_source { -1e5 * <1, 1, -1> rgb 0.9 parallel point_at 0 }
light_source { -1e5 * <-2, 1, -0.3> rgb <0.3, 0.3, 0.4> parallel point_at 0 }
#default { pigment { rgb <0.7, 0.6, 0.5> } finish { ambient rgb <0.08, 0.08, 0.08> / <0.7, 0.6, 0.5> diffuse 1 } }
$3
END
}

tilt='rotate(1, 0, 0, 0.2, rotate(0, 1, 0, 0.15,' povTilt='rotate y*8.594366927 rotate x*11.45915590'
pair torus "$tilt torus { }))" "torus { 1, 0.25 rotate x*90 $povTilt }"
pair thin_torus "$tilt torus { minor_radius = 0.02; }))" "torus { 1, 0.02 rotate x*90 $povTilt }"
pair superellipsoid "$tilt superellipsoid { east = 0.25; north = 0.25; }))" "superellipsoid { <0.25, 0.25> $povTilt }"
pair lathe "$tilt lathe { capped = false; profile = ((0, -1), (0.9, -1), (0.9, -0.2), (0.4, 0), (0.1, 0.15), (0.2, 0.7), (0.7, 0.9)); }))" \
  "lathe { bezier_spline 8, <0,-1>, <0.9,-1>, <0.9,-0.2>, <0.4,0>, <0.4,0>, <0.1,0.15>, <0.2,0.7>, <0.7,0.9> rotate x*90 $povTilt }"
pair prism "$tilt translate(0, 0, -0.3, prism { height = 0.6; spline = bezier; outline = ((-1, 0), (-1, 1), (0, 1.5), (1, 1), (1, 0.2), (0.3, -1), (-1, 0)); })))" \
  "prism { bezier_spline linear_sweep -0.3, 0.3, 8, <-1,0>, <-1,-1>, <0,-1.5>, <1,-1>, <1,-1>, <1,-0.2>, <0.3,1>, <-1,0> rotate x*90 $povTilt }"
pair sphere_sweep "$tilt sphere_sweep { spline = bspline; points = ((-2.4, 0, 0.4, 0.3), (-1.2, 0.6, -0.2, 0.15), (-0.4, -0.5, 0.3, 0.4), (0.4, 0.5, -0.3, 0.2), (1.2, -0.4, 0.3, 0.35), (2.4, 0, 0, 0.2)); }))" \
  "sphere_sweep { b_spline 6, <-2.4,0,0.4>, 0.3, <-1.2,0.6,-0.2>, 0.15, <-0.4,-0.5,0.3>, 0.4, <0.4,0.5,-0.3>, 0.2, <1.2,-0.4,0.3>, 0.35, <2.4,0,0>, 0.2 $povTilt }"
pair metaballs "$tilt metaballs { threshold = 0.4; balls = ((-0.6, 0, 0, 0.9, 1), (0.6, 0, 0.2, 0.9, 1), (0, 0.5, 0.6, 0.7, 0.9), (0, -0.5, 0.2, 0.5, -0.8)); capsules = ((-0.8, 0, -0.6, 0.8, 0, -0.6, 0.5, 0.8)); }))" \
  "blob { threshold 0.4 sphere { <-0.6,0,0>, 0.9, 1 } sphere { <0.6,0,0.2>, 0.9, 1 } sphere { <0,0.5,0.6>, 0.7, 0.9 } sphere { <0,-0.5,0.2>, 0.5, -0.8 } cylinder { <-0.8,0,-0.6>, <0.8,0,-0.6>, 0.5, 0.8 } $povTilt }"
pair csg "$tilt difference { scale(1.4, box { }); scale(0.9, sphere { }); translate(0, 0, -1, scale(0.4, 0.4, 2, cylinder { })); }))" \
  "difference { box { -0.7, 0.7 } sphere { 0, 0.9 } cylinder { -z, z, 0.4 } $povTilt }"
pair isosurface "$tilt isosurface { formula = \"x^4 + y^4 + z^4 - x^2 - y^2 - z^2 + 0.4\"; }))" \
  "isosurface { function { x*x*x*x + y*y*y*y + z*z*z*z - x*x - y*y - z*z + 0.4 } contained_by { box { -1.2, 1.2 } } max_gradient 10 $povTilt }"
# POV-Ray stops 1 / precision before the set: 400 is usual, from 40000 on its picture stays the same.
for precision in 400 40000; do
  pair "julia_$precision" "$tilt julia { constant = (-0.2, 0.8, 0, 0); iterations = 10; }))" \
    "julia_fractal { <-0.2, 0.8, 0, 0> quaternion sqr max_iteration 10 precision $precision $povTilt }"
done
pair height_field "$tilt translate(0, 0, -0.3, scale(1, 1, 1.2, height_field { points = 257; capped = false; formula = \"0.3 + 0.15 * sin(5 * x) * cos(7 * y)\"; }))))" \
  "height_field { function 257, 257 { 0.3 + 0.15 * sin(5 * (2 * x - 1)) * cos(7 * (2 * y - 1)) } translate <-0.5, 0, -0.5> scale <2, 1.2, 2> rotate x*90 translate <0, 0, -0.3> $povTilt }"

median() { sort -g "$1" | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
timed() {  # appends CPU seconds to the file named first
  local series="$1" TIMEFORMAT='%3U %3S'
  shift
  { time "$@" >"$series.log" 2>&1; } 2>"$series.time" || { cat "$series.log" >&2; exit 1; }
  awk '{ print $1 + $2 }' "$series.time" >>"$series.cpu"
}

echo "CPU seconds of the whole program, ${size}x$size, one thread; last, how far apart the pictures are (mean levels, values"
echo "beyond 8 levels)"
echo
echo "| shape          |    ray | POV-Ray | ray / POV-Ray | pictures differ |"
echo "|----------------|-------:|--------:|--------------:|----------------:|"
for scene in torus thin_torus superellipsoid lathe prism sphere_sweep metaballs csg isosurface julia_400 julia_40000 height_field; do
  rm -f "$scene-ray.cpu" "$scene-pov.cpu"
  for ((pass = 0; pass < runs; ++pass)); do
    timed "$scene-ray" "$bin/ray" -w "$size" -t 1 --like uw --pixel-position center --rounding nearest "$scene.ray" "$scene-ray.png"
    timed "$scene-pov" povray "+I$scene.pov" "+O$scene-pov.png" "+W$size" "+H$size" +WT1 -D -A File_Gamma=1.0
  done
  a="$(median "$scene-ray.cpu")" b="$(median "$scene-pov.cpu")"
  printf '| %-14s | %6.3f | %7.3f | %13s | %15s |\n' "$scene" "$a" "$b" \
    "$(awk -v a="$a" -v b="$b" 'BEGIN { printf "%.2f", a / b }')" "$({ "$bin/ray" diff --print mean,beyond --tolerance 8 "$scene-ray.png" "$scene-pov.png" || (($? == 1)); } |
      awk '{ printf "%.3f %.3f %%", $1, $2 }')"
  rm -f "$scene"-{ray,pov}.{cpu,log,time}
done

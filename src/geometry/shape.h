// THE list of shapes. A new shape is one header and one line here; readers, writers, the reference page
// and the generic tests loop over the list.
//
// Every shape but Mesh answers, in its own space:
//   solid()             does it enclose space? (an open sheet is seen from both sides)
//   bounds()            a box that holds it, infinite if the shape is
//   crossings(ray, f)   f(Crossing) for every place, in any order and at any t, where the ray's line goes
//                       through the surface; for solids, entries and exits come in pairs, of which one may
//                       lie at infinity
//   surface(ray, c)     the point, put back on the surface, with error bounds, normal and uv
//
// A shape may add
//   convex()            a ray that leaves it on the side of its normal does not meet it again
//
// A shape of several materials adds
//   material(part, own)        the MaterialMix of a crossing; `own` is that of the whole
//   addMaterials(all)          the indices it may answer with beside that
//
// A shape that has to be worked out before it is traced (coefficients, hierarchies, children) has instead
//   prepared()          what rays meet in its place, or a shared handle to it: something with the four above.
// compile() asks for it once. What is costly to find everywhere may take the wanted part of the line:
//   crossings(ray, range, f)   as above, but only those in the Range need be visited; nearest first
#pragma once

#include <concepts>
#include <memory>
#include <string_view>
#include <variant>

#include "geometry/bezier_patches.h"
#include "geometry/blend.h"
#include "geometry/cone.h"
#include "geometry/conic.h"
#include "geometry/copies.h"
#include "geometry/csg.h"
#include "geometry/cube.h"
#include "geometry/disk.h"
#include "geometry/height_field.h"
#include "geometry/isosurface.h"
#include "geometry/julia.h"
#include "geometry/lathe.h"
#include "geometry/mandelbox.h"
#include "geometry/mandelbulb.h"
#include "geometry/menger.h"
#include "geometry/mesh.h"
#include "geometry/metaballs.h"
#include "geometry/plane.h"
#include "geometry/plant.h"
#include "geometry/prism.h"
#include "geometry/puff.h"
#include "geometry/quadric.h"
#include "geometry/rounded_box.h"
#include "geometry/sphere.h"
#include "geometry/sphere_sweep.h"
#include "geometry/square.h"
#include "geometry/superellipsoid.h"
#include "geometry/supertoroid.h"
#include "geometry/sweep.h"
#include "geometry/terrain.h"
#include "geometry/torus.h"

namespace trace {

using Shape =
    std::variant<Sphere, Cube, Square, Cylinder, Cone, Conic, Plane, Disk, RoundedBox, Torus, Ellipsoid,
                 EllipticCone, Paraboloid, Hyperboloid, TwoSheets, Quadric, Superellipsoid, Supertoroid,
                 Lathe, Prism, SphereSweep, Sweep, Plant, BezierPatches, HeightField, Terrain, Metaballs,
                 Isosurface, Menger, Sierpinski, Ifs, Julia, Mandelbulb, Mandelbox, Union, Intersection,
                 Difference, Clip, Blend, Puff, Mesh>;

}  // namespace trace

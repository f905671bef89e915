// Bodies that may shine, of about one unit around the origin, with their areas and volumes.
#pragma once

#include <string>
#include <vector>

#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/conic.h"
#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/disk.h"
#include "geometry/shapes/solids/quadric.h"
#include "geometry/shapes/solids/rounded_box.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/superellipsoid.h"
#include "geometry/shapes/solids/torus.h"
#include "math/transform.h"

namespace trace::test {

struct Body {
  std::string name;
  Shape shape;
  Affine place;
  double area = 0;    ///< of one side; 0: not known
  double volume = 0;  ///< 0: not known, or it is open
};

inline std::vector<Body> bodies() {
  const auto scaling = [](Real x, Real y, Real z) { return Affine::scaling({x, y, z}); };
  const Affine aslant = Affine::rotation(normalize(Vec3{1, 2, 0.5}), 0.7);
  Cylinder open;
  open.capped = false;
  Cone cone;
  cone.bottomRadius = 0.3, cone.topRadius = 0, cone.height = 0.4;
  Cone cup = cone;
  cup.topRadius = 0.1, cup.capped = false;
  Torus torus;
  torus.majorRadius = 0.4, torus.minorRadius = 0.1;
  Ellipsoid ellipsoid;
  ellipsoid.radii = {0.5, 0.5, 0.1};
  Disk ring;
  ring.radius = 0.5, ring.innerRadius = 0.3;
  Conic conic;
  conic.bottomRadius = 0.3, conic.topRadius = 0.2, conic.zMin = -0.2, conic.zMax = 0.2;
  const Affine tube = aslant * scaling(0.1, 0.1, 1) * Affine::translation({0, 0, -0.5});
  return {{"box", Cube{}, aslant * scaling(0.4, 0.8, 0.2), 1.12, 0.064},
          {"scaled sphere", Sphere{}, aslant * scaling(0.5, 0.5, 0.1), 1.717804, 0.10471976},
          {"ellipsoid", ellipsoid, aslant, 1.717804, 0.10471976},
          {"disk", Disk{}, aslant * scaling(0.5, 0.5, 0.5), 0.78539816, 0},
          {"ring", ring, aslant, 0.50265482, 0},
          {"tube", Cylinder{}, tube, 0.69115038, 0.031415927},
          {"open tube", open, tube, 0.62831853, 0},
          {"cone", cone, aslant, 0.75398224, 0.037699112},
          {"cup", cup, aslant, 0, 0},
          {"torus", torus, aslant, 1.5791367, 0.078956835},
          {"conic", conic, aslant, 0, 0},
          {"rounded box", RoundedBox{}, aslant * scaling(0.4, 0.5, 0.3), 0, 0},
          {"superellipsoid", Superellipsoid{}, aslant * scaling(0.4, 0.5, 0.3), 0, 0}};
}

}  // namespace trace::test

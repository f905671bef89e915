#include "formats/inventor/inventor_transform.h"

#include <cmath>
#include <map>

namespace trace::inventor {

Affine turn(const std::vector<double>& n) {
  if (n.size() < 4) return {};
  const Vec3 axis{n[0], n[1], n[2]};
  const Real l = length(axis);
  return l > 0 && std::isfinite(l) ? Affine::rotation(axis / l, n[3]) : Affine{};
}

Affine rowMatrix(const double* m) {
  Affine a;
  for (int r = 0; r < 3; ++r) {
    a.row[r] = {m[r], m[4 + r], m[8 + r]};
    a.offset[r] = m[12 + r];
  }
  return a;
}

Affine transformOf(const Values& v, std::string_view scale) {
  const Vec3 center = v.vector("center", {});
  const Affine lean = turn(v.numbers("scaleOrientation"));
  Affine unlean;  // inverse of the lean of a rotation
  for (int i = 0; i < 3; ++i) unlean.row[i] = {lean.row[0][i], lean.row[1][i], lean.row[2][i]};
  return Affine::translation(v.vector("translation", {})) * Affine::translation(center) *
         turn(v.numbers("rotation")) * lean * Affine::scaling(v.vector(scale, {1, 1, 1})) * unlean *
         Affine::translation(-center);
}

Real metres(std::string_view unit) {
  static const std::map<std::string_view, Real> kMetres{
      {"METERS", 1},       {"CENTIMETERS", 0.01},   {"MILLIMETERS", 0.001},  {"MICROMETERS", 1e-6},
      {"MICRONS", 1e-6},   {"NANOMETERS", 1e-9},    {"ANGSTROMS", 1e-10},    {"KILOMETERS", 1000},
      {"FEET", 0.3048},    {"INCHES", 0.0254},      {"POINTS", 0.0254 / 72}, {"YARDS", 0.9144},
      {"MILES", 1609.344}, {"NAUTICAL_MILES", 1852}};
  const auto found = kMetres.find(unit);
  return found == kMetres.end() ? 0 : found->second;
}

}  // namespace trace::inventor

// The Mandelbox (Lowe, 2010): the points c of space whose orbit stays within reach under folding at a box,
// then at a ball, scaling, and adding c. From -1 to 1 in x, y and z. How it is found: escape_search.h.
#pragma once

#include <memory>
#include <string_view>

#include "base/field.h"
#include "geometry/materials.h"
#include "geometry/ray.h"
#include "geometry/shapes/fractals/orbit_trap.h"
#include "math/box.h"

namespace trace {

class TracedMandelbox;

struct Mandelbox {
  static constexpr std::string_view kKeyword = "mandelbox";
  static constexpr std::string_view kHelp = "points of space that stay bounded under folding and scaling";

  Real scale = 3, minRadius = 0.5;
  int iterations = 5;
  Trap trap = Trap::none;
  MaterialList materials;

  static constexpr auto fields() {
    return Fields{
        Field{"scale", &Mandelbox::scale, "", -4, 4, "scale of the step; its size is above 1.1"},
        Field{"min_radius", &Mandelbox::minRadius, "", 0.05, 1,
              "radius of the sphere within which points only move out"},
        Field{"iterations", &Mandelbox::iterations, "", 1, 30, "number of iterations; more show more detail"},
        Field{"trap", &Mandelbox::trap, "", 0, 0, "the meaning of the texture coordinates"},
        Field{"materials", &Mandelbox::materials, "", 0, 0,
              "materials in the order of the trap's least distance"}};
  }
  bool operator==(const Mandelbox&) const = default;

  std::shared_ptr<const TracedMandelbox> prepared() const;
};

class TracedMandelbox {
 public:
  explicit TracedMandelbox(const Mandelbox& shape) : shape_(shape) {}

  bool solid() const { return true; }
  static constexpr std::int64_t partCount() { return TrapPart::kCount; }
  MaterialMix material(std::int64_t part, std::uint32_t own) const {
    return shape_.materials.empty() ? MaterialMix::only(own) : shape_.materials.at(TrapPart::level(part));
  }
  void addMaterials(std::vector<std::uint32_t>& to) const { shape_.materials.addTo(to); }
  Box3 bounds() const;
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;

 private:
  Mandelbox shape_;
};

}  // namespace trace

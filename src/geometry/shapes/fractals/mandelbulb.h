// The Mandelbulb (White and Nylander, 2009): the points c of space whose orbit w -> w^p + c stays within
// reach, where a power turns both angles of a point p times and raises its length. How it is found:
// escape_search.h.
#pragma once

#include <memory>
#include <string_view>

#include "base/field.h"
#include "geometry/materials.h"
#include "geometry/ray.h"
#include "geometry/shapes/fractals/orbit_trap.h"
#include "math/box.h"

namespace trace {

class TracedMandelbulb;

struct Mandelbulb {
  static constexpr std::string_view kKeyword = "mandelbulb";
  static constexpr std::string_view kHelp =
      "points of space that stay bounded under powers of both their angles";

  int power = 8, iterations = 3;
  bool julia = false;
  Vec3 constant{-0.4, 0.6, 0.3};
  Trap trap = Trap::none;
  MaterialList materials;

  static constexpr auto fields() {
    return Fields{
        Field{"power", &Mandelbulb::power, "", 2, 16,
              "factor on both angles: one more than the number of arms"},
        Field{"iterations", &Mandelbulb::iterations, "", 1, 30,
              "number of iterations; more show more detail"},
        Field{"julia", &Mandelbulb::julia, "", 0, 1, "c is `constant` everywhere; else the point itself"},
        Field{"constant", &Mandelbulb::constant, "", -2, 2, "c of the Julia set"},
        Field{"trap", &Mandelbulb::trap, "", 0, 0, "the meaning of the texture coordinates"},
        Field{"materials", &Mandelbulb::materials, "", 0, 0,
              "materials in the order of the trap's least distance"}};
  }
  bool operator==(const Mandelbulb&) const = default;

  std::shared_ptr<const TracedMandelbulb> prepared() const;
};

class TracedMandelbulb {
 public:
  explicit TracedMandelbulb(const Mandelbulb& shape) : shape_(shape) {}

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
  Mandelbulb shape_;
};

}  // namespace trace

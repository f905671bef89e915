// Solids that flow together: union, intersection and difference with a fillet along the edge where they meet.
// The fillet of two walls at a right angle is a quarter of a circle.
//
// Where both signed distances a and b are below the radius r the distance of the union is r - |(r - a, r -
// b)|, else the lesser of them (the round union of Mercury's hg_sdf, 2015); the others follow by signs. It is
// found by interval arithmetic, as isosurface.h finds a formula: nothing is missed.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "geometry/materials.h"
#include "geometry/ray.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/solve/distance.h"
#include "math/box.h"

namespace trace {

class TracedBlend;

struct Blend {
  static constexpr std::string_view kKeyword = "blend";
  static constexpr std::string_view kHelp =
      "solids joined by a fillet: a smooth union, intersection or difference";

  Operands objects;
  CsgOperation operation = CsgOperation::unite;
  Real radius = 0.2;

  static constexpr auto fields() {
    return Fields{
        Field{"objects", &Blend::objects, "", 0, 0, "solids; they stand in the block one after another"},
        Field{"operation", &Blend::operation, "", 0, 0, "how they are combined"},
        Field{"radius", &Blend::radius, "", 0, kNoLimit, "radius of the fillet"}};
  }
  bool operator==(const Blend&) const = default;

  /// Throws Error for an object whose distance is not known, and for a blend infinite.
  std::shared_ptr<const TracedBlend> prepared() const;
};

class TracedBlend {
 public:
  explicit TracedBlend(const Blend& shape);

  bool solid() const { return true; }
  Box3 bounds() const { return bounds_; }
  void crossings(const Ray& ray, const Range& range, VisitCrossing visit) const;
  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const;

  /// Along a fillet it leads from the material of one solid to that of the other.
  MaterialMix material(std::int64_t part, std::uint32_t own) const;
  void addMaterials(std::vector<std::uint32_t>& all) const;
  std::int64_t partCount() const { return kShares * count() * count(); }

 private:
  static constexpr std::int64_t kShares = 1 << 10;

  /// A step of the evaluation: a solid, or what the two values before become.
  struct Step {
    bool leaf = true;
    std::size_t index = 0;  ///< index of forms_
    CsgOperation operation = CsgOperation::unite;
    Real radius = 0;
  };
  std::int64_t count() const { return static_cast<std::int64_t>(forms_.size()); }

  /// Each adds the steps of a shape in its place, and returns a box that holds where its value is at most
  /// `near`, from 0.
  Box3 add(const Operand& operand, const Affine& wholeFromOutside, Real near);
  Box3 add(CsgOperation operation, Real radius, const std::vector<Operand>& operands,
           const Affine& wholeFromPart, Real near);
  Box3 add(DistanceForm form, std::uint32_t material, const Affine& wholeFromForm, Real near);
  class Line;
  std::int64_t partAt(const Vec3& p) const;

  std::vector<DistanceForm> forms_;
  std::vector<std::uint32_t> materials_;  ///< materials of each form
  std::vector<Step> steps_;
  Box3 bounds_;
};

}  // namespace trace

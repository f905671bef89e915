// An emissive body of a shape that has no formula of its own. Directions to it are chosen toward the ellipsoid
// around its bounds. Places on it are those where random lines through a ball around it enter: such lines cross
// a surface evenly, whatever its shape (Santalo, Integral Geometry and Geometric Probability, 1976).
#pragma once

#include <cstdint>
#include <optional>

#include "render/world/world.h"

namespace trace {

class BodyLamp {
 public:
  /// Nothing for an object whose shape is not known to be crossed so few times by a line: meshes, planes and
  /// most solids that are not convex.
  static std::optional<BodyLamp> of(const World& world, std::uint32_t object);

  /// A direction in which it may be met.
  struct Aim {
    Vec3 direction;  ///< unit
    Real density;    ///< per solid angle
    Real farthest;   ///< it ends before that distance
  };
  /// By two numbers from 0 up to 1.
  Aim aim(const Vec3& from, const Vec2& u) const;
  /// The density with which aim() gives that direction, in which the body lies.
  Real density(const Vec3& from, const Vec3& direction) const;

  /// A place on its surface.
  struct Place {
    Vec3 point, normal;  ///< unit, to the side on which it was chosen
  };
  /// By five numbers from 0 up to 1: of a line, and which of its crossings. Nothing where the line has fewer.
  std::optional<Place> place(const World& world, const Vec2& direction, const Vec2& disk, Real which) const;
  /// The density with which place() gives a place, per area and side.
  Real perArea() const;

  const Vec3& middle() const { return middle_; }
  Real radius() const { return radius_; }  ///< radius of the ball around it
  bool closed() const { return closed_; }  ///< only its outside shines
  Real area() const { return area_; }      ///< about
  /// Where the ray meets it first, whatever lies before.
  std::optional<Found> meets(const World& world, const Ray& ray, Statistics& statistics) const;

 private:
  Ray lineThrough(const Vec2& direction, const Vec2& disk) const;

  std::uint32_t object_ = 0;
  Affine fromWorld_, toWorld_;  ///< the space in which the ellipsoid is the ball of radius 1
  Real volume_ = 0;             ///< determinant of toWorld_
  Vec3 middle_;
  Real radius_ = 0, area_ = 0;
  int crossings_ = 0;  ///< the most places that a line has
  bool closed_ = true;
};

}  // namespace trace

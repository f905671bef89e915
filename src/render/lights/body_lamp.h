// An emissive object whose shape has no sampling formula of its own. Directions to it are sampled toward the
// ellipsoid around its bounds. Points on it are sampled by random lines through the sphere around it: these
// cross a surface uniformly, whatever its shape (Santalo, Integral Geometry and Geometric Probability, 1976).
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "render/world/world.h"

namespace trace {

class BodyLamp {
 public:
  /// Nothing for a shape that a line may cross many times: meshes, planes and most solids that are not
  /// convex.
  static std::optional<BodyLamp> of(const World& world, std::uint32_t object);

  /// A direction in which a ray may hit it.
  struct Aim {
    Vec3 direction;  ///< unit
    Real density;    ///< per solid angle
    Real farthest;   ///< the object ends before that distance
  };
  /// Samples a direction by two numbers from 0 up to 1.
  Aim aim(const Vec3& from, const Vec2& u) const;
  /// The density, per solid angle, with which aim() samples a direction toward the object.
  Real density(const Vec3& from, const Vec3& direction) const;

  /// A point on its surface.
  struct Place {
    Vec3 point, normal;  ///< unit; the side on which the point was sampled
  };
  /// Samples a point by five numbers from 0 up to 1: four choose a line, the last one of its crossings.
  /// Nothing if the line has fewer crossings.
  std::optional<Place> place(const World& world, const Vec2& direction, const Vec2& disk, Real which) const;
  /// The density with which place() samples a point, per area and side.
  Real perArea() const;

  const Vec3& middle() const { return middle_; }
  Real radius() const { return radius_; }  ///< radius of the ball around it
  bool closed() const { return closed_; }  ///< only its outside emits
  Real area() const { return area_; }      ///< approximate
  /// The first hit of the ray with it, regardless of objects in front.
  std::optional<Found> meets(const World& world, const Ray& ray, Statistics& statistics) const;

 private:
  /// A line through the unit ball around the origin.
  struct Line {
    Vec3 start, along;
  };
  static Line lineOf(const Vec2& direction, const Vec2& disk);
  /// Lines by which the area of every object is estimated.
  static const std::vector<Line>& sampleLines();
  Ray rayOf(const Line& line) const { return {middle_ + line.start * radius_, line.along}; }
  /// All places where a line enters the object, or crosses an open one.
  void crossings(const World& world, const Ray& line, std::vector<std::pair<Found, Place>>& places) const;

  std::uint32_t object_ = 0;
  Affine fromWorld_, toWorld_;  ///< the space in which the ellipsoid is the ball of radius 1
  Real volume_ = 0;             ///< determinant of toWorld_
  Vec3 middle_;
  Real radius_ = 0, area_ = 0;
  int crossings_ = 0;  ///< the largest number of crossings of a line
  bool closed_ = true;
};

}  // namespace trace

// How much a sample counts in a pixel by its distance from the centre: filters of reconstruction, which place
// samples by importance (Ernst, Stamminger and Greiner, Filter Importance Sampling, 2006).
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "math/vec.h"

namespace trace {

enum class FilterKind { box, tent, gaussian, mitchell, blackmanHarris };

/// A row of the table: a filter is the product of two profiles, across and down.
struct FilterRow {
  FilterKind kind;
  std::string_view name;
  std::string_view help;
  Real radius;                   ///< its usual one, in pixels
  Real (*profile)(Real across);  ///< at -1 to 1 of its radius
};
std::span<const FilterRow> filters();

/// A place of a sample, and what it counts.
struct FilmSample {
  Vec2 place;
  Real weight = 1;
};

class PixelFilter {
 public:
  /// A radius of 0 is the usual one.
  PixelFilter(FilterKind kind, Real radius);

  /// Every place in the pixel counts the same, and no other.
  bool isPixel() const { return isPixel_; }

  /// The size of all weights: the integral of the filter's absolute value over that of the filter.
  Real weight() const { return weight_ * weight_; }

  /// How far it reaches from the pixel's centre, in pixels.
  Real radius() const { return radius_; }
  /// The filter weight at that distance from the centre, across or down: over all places 1.
  Real share(Real away) const;

  /// A place relative to the pixel's centre, in pixels, for two numbers from 0 up to 1. They are as dense as
  /// the filter is far from 0; the weight has its sign, and a mean of 1.
  FilmSample sample(const Vec2& u) const;

 private:
  struct Along {
    Real place, weight;
  };
  Along along(Real u) const;

  const FilterRow* row_;
  Real radius_;
  Real whole_ = 2;  ///< the integral of the profile
  bool isPixel_;
  std::vector<Real>
      sums_;  ///< sums of the filter's absolute value, at equal steps from -radius to radius; ends with 1
  std::vector<Real> signs_;  ///< between them
  Real weight_ = 1;          ///< the integral of the absolute value over that of the filter
};

}  // namespace trace

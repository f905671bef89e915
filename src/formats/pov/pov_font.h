// Outlines of letters from a TrueType font. Source: the OpenType specification 1.9, tables cmap, glyf, head,
// hhea, hmtx and loca.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "math/vec.h"

namespace trace::pov {

class Font {
 public:
  using Point = std::array<Real, 2>;

  /// A letter, in ems: outlines of cubic Bezier arcs that share their ends, as Spline::bezier has them.
  struct Glyph {
    std::vector<std::vector<Point>> outlines;
    Real advance = 0;
    /// The least x of its outlines: a text begins there.
    Real left() const;
  };

  /// Refers to the bytes. Throws Error(Fault::scene) for what is no such font.
  explicit Font(std::string_view bytes);

  /// That of a character; the font's sign for missing ones where it has none.
  Glyph glyph(std::uint32_t character) const;
  /// The correction of the distance between two letters, in ems.
  Real kerning(std::uint32_t left, std::uint32_t right) const;

 private:
  struct Corner {
    Real x, y;
    bool on, last;
  };
  std::uint32_t number(std::size_t at, int bytes) const;
  int signedNumber(std::size_t at) const;
  std::size_t offset(std::string_view name) const;
  std::uint32_t indexOf(std::uint32_t character) const;
  void corners(std::uint32_t glyph, std::vector<Corner>& to, int depth) const;

  std::string_view bytes_;
  std::size_t cmap_ = 0, kern_ = 0, glyf_ = 0, loca_ = 0, hmtx_ = 0;
  std::uint32_t metrics_ = 1;
  bool longOffsets_ = false;
  Real em_ = 1000;
};

}  // namespace trace::pov

// The Menger sponge, a cube of which again and again the middle ninths are drilled out along all axes, to a
// given level: exactly that union of cubes.
//
// A ray goes from cell to cell of the levels. Planes have whole numbers in the finest grid, so that two cells
// that touch have the same place for their common face, and stretches that touch become one.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "base/field.h"
#include "geometry/solve/span.h"

namespace trace {

struct Menger {
  static constexpr std::string_view kKeyword = "menger";
  static constexpr std::string_view kHelp = "Menger sponge from -0.5 to 0.5 in x, y and z";
  static constexpr int kMostLevels = 12;

  int levels = 3;

  static constexpr auto fields() {
    return Fields{
        Field{"levels", &Menger::levels, "", 0, kMostLevels, "number of drilling levels; 0 is a cube"}};
  }
  bool operator==(const Menger&) const = default;

  bool solid() const { return true; }
  Box3 bounds() const { return {{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}; }

  /// A part is 6 times the number of the face's plane, plus 2 axis, plus 1 if it faces up.
  template <class Visit>
  void crossings(const Ray& ray, const Range& range, Visit&& visit) const {
    Walk walk{ray, range, count(), {-kInfinity, 0}, {-kInfinity, 0}, false};
    Crossing in{-kInfinity, 0}, out{kInfinity, 0};
    const int n = count();
    for (int axis = 0; axis < 3; ++axis) {
      const Real o = ray.origin[axis], d = ray.direction[axis];
      if (d == 0) {
        if (o < -0.5 || o > 0.5) return;
        continue;
      }
      const Crossing enter = walk.plane(axis, d > 0 ? 0 : n), leave = walk.plane(axis, d > 0 ? n : 0);
      if (enter.t > in.t) in = enter;
      if (leave.t < out.t) out = leave;
    }
    if (!(in.t <= out.t)) return;
    walk.cell({0, 0, 0}, n, in, out, visit);
    if (walk.open) {
      visit(walk.from);
      visit(walk.to);
    }
  }

  SurfacePoint surface(const Ray& ray, const Crossing& crossing) const {
    const auto axis = static_cast<int>(crossing.part % 6 / 2);
    const Real side = crossing.part % 2 ? 1 : -1;
    Vec3 p = ray.at(crossing.t), n;
    for (int i = 0; i < 3; ++i) p[i] = std::clamp(p[i], -0.5, 0.5);
    p[axis] = static_cast<Real>(crossing.part / 6) / count() - 0.5;
    n[axis] = side;
    const Real error = gammaError(6);
    return {p, {error, error, error}, n, n, {0.5 + p[axis == 0 ? 1 : 0], 0.5 + p[axis == 2 ? 1 : 2]}};
  }

 private:
  int count() const {
    int n = 1;
    for (int i = 0; i < std::clamp(levels, 0, kMostLevels); ++i) n *= 3;
    return n;
  }

  struct Walk {
    const Ray& ray;
    const Range& range;
    int count;          ///< count of finest cells along an axis
    Crossing from, to;  ///< the solid stretch hit last
    bool open;          ///< ... is not visited yet

    /// Where the ray crosses the plane of that number, and what face a solid would have there.
    Crossing plane(int axis, int number) const {
      const Real d = ray.direction[axis];
      return {(static_cast<Real>(number) / count - 0.5 - ray.origin[axis]) / d,
              std::int64_t{number} * 6 + 2 * axis};
    }
    Crossing facing(Crossing c, bool entering) const {
      const Real d = ray.direction[static_cast<int>(c.part % 6 / 2)];
      c.part += (d > 0) != entering;
      return c;
    }

    template <class Visit>
    void cell(const std::array<int, 3>& corner, int size, const Crossing& in, const Crossing& out,
              Visit& visit) {
      if (out.t < range.from || in.t > range.to) return;
      if (size == 1) {
        if (open && in.t <= to.t) {
          to = facing(out, false);
          return;
        }
        if (open) {
          visit(from);
          visit(to);
        }
        from = facing(in, true);
        to = facing(out, false);
        open = true;
        return;
      }
      const int third = size / 3;
      std::array<Crossing, 8> ends{};  // sorted; the planes come in few
      std::size_t n = 0;
      ends[n++] = in;
      for (int axis = 0; axis < 3; ++axis)
        for (int i = 1; i <= 2 && ray.direction[axis] != 0; ++i) {
          const Crossing c = plane(axis, corner[static_cast<std::size_t>(axis)] + i * third);
          if (!(c.t > in.t && c.t < out.t)) continue;
          std::size_t k = n++;
          for (; k > 1 && ends[k - 1].t > c.t; --k) ends[k] = ends[k - 1];
          ends[k] = c;
        }
      ends[n++] = out;
      for (std::size_t i = 0; i + 1 < n; ++i) {
        if (!(ends[i].t < ends[i + 1].t)) continue;
        const Vec3 middle = ray.at(0.5 * (ends[i].t + ends[i + 1].t));
        std::array<int, 3> child = corner;
        int inMiddle = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const Real place = (middle[static_cast<int>(axis)] + 0.5) * count - corner[axis];
          const int index = std::clamp(static_cast<int>(std::floor(place / third)), 0, 2);
          child[axis] += index * third;
          inMiddle += index == 1;
        }
        if (inMiddle < 2) cell(child, third, ends[i], ends[i + 1], visit);
      }
    }
  };
};

}  // namespace trace

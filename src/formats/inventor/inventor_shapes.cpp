#include "formats/inventor/inventor_shapes.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "math/box.h"
#include "math/elementary.h"
#include "math/transform.h"

namespace trace::inventor {
namespace {

/// The numbers of a list as they index something; what is no such number is kNone.
constexpr std::uint32_t kNone = 0xffffffff;
std::uint32_t asIndex(double number) {
  return number >= 0 && number < 4294967295.0 ? static_cast<std::uint32_t>(number) : kNone;
}

/// One corner of the file.
struct Item {
  std::uint32_t point, order, slot;
};

class Maker {
 public:
  Maker(std::size_t points) : points_(points) {}

  void polygon(const std::vector<Item>& items, std::uint32_t part) { add(items, part); }
  void strip(const std::vector<Item>& items, std::uint32_t part) {
    for (std::size_t i = 0; i + 2 < items.size(); ++i)
      add({items[i], items[i + 1 + i % 2], items[i + 2 - i % 2]}, part);
  }
  /// Faces that the file announces and has no points for.
  void leaveOut() { ++outline_.bad; }
  Outline finish() { return std::move(outline_); }

 private:
  void add(const std::vector<Item>& items, std::uint32_t part) {
    const bool good = items.size() >= 3 && std::all_of(items.begin(), items.end(),
                                                       [&](const Item& i) { return i.point < points_; });
    if (!good) return void(++outline_.bad);
    outline_.face(part);
    for (const Item& item : items) outline_.corner(item.point, item.order, item.slot);
  }

  std::size_t points_;
  Outline outline_;
};

/// Calls end(items, part) for each run of a list whose runs end with -1.
template <class End>
void indexedRuns(const std::vector<double>& indices, End&& end) {
  std::vector<Item> items;
  std::uint32_t order = 0, part = 0;
  for (std::size_t slot = 0; slot < indices.size(); ++slot) {
    if (indices[slot] >= 0)
      items.push_back({asIndex(indices[slot]), order++, static_cast<std::uint32_t>(slot)});
    if ((indices[slot] < 0 || slot + 1 == indices.size()) && !items.empty()) {
      end(items, part++);
      items.clear();
    }
  }
}

/// Calls end(items, part) for each run of consecutive points; a length of -1 takes all that are left.
template <class End>
void countedRuns(Maker& maker, const Values& shape, std::size_t points, End&& end) {
  std::vector<double> lengths = shape.numbers("numVertices");
  if (lengths.empty()) lengths = {-1};
  std::uint32_t point = asIndex(shape.number("startIndex", 0)), order = 0, part = 0;
  for (double length : lengths) {
    if (point >= points) return maker.leaveOut();
    const std::size_t left = points - point;
    const std::size_t wanted = length < 0 ? left : static_cast<std::size_t>(asIndex(length));
    const std::size_t count = std::min(left, wanted);
    if (wanted > left) maker.leaveOut();
    std::vector<Item> items;
    for (std::size_t i = 0; i < count; ++i, ++point, ++order) items.push_back({point, order, order});
    end(items, part++);
  }
}

void quadMesh(Maker& maker, const Values& shape) {
  const std::uint32_t start = asIndex(shape.number("startIndex", 0));
  const std::uint32_t columns = asIndex(shape.number("verticesPerRow", 1));
  const std::uint32_t rows = asIndex(shape.number("verticesPerColumn", 1));
  if (columns > 1u << 15 || rows > 1u << 15) return maker.leaveOut();
  const auto item = [&](std::uint32_t row, std::uint32_t column) {
    const std::uint32_t n = row * columns + column;
    return Item{start + n, n, n};
  };
  for (std::uint32_t r = 0; r + 1 < rows; ++r)
    for (std::uint32_t c = 0; c + 1 < columns; ++c)
      maker.polygon({item(r, c), item(r + 1, c), item(r + 1, c + 1), item(r, c + 1)}, r);
}

/// A face over points of the surface itself, where order and slot mean nothing of their own.
void quad(Outline& outline, std::uint32_t part, std::initializer_list<std::uint32_t> points) {
  outline.face(part);
  for (std::uint32_t p : points) outline.corner(p, p, p);
}

}  // namespace

Outline outlineOf(const Values& shape, std::string_view type, std::size_t points) {
  Maker maker(points);
  const auto polygon = [&](const std::vector<Item>& items, std::uint32_t part) {
    maker.polygon(items, part);
  };
  const auto strip = [&](const std::vector<Item>& items, std::uint32_t part) { maker.strip(items, part); };
  const std::vector<double>& indices = shape.numbers("coordIndex");
  if (type == "IndexedFaceSet")
    indexedRuns(indices, polygon);
  else if (type == "IndexedTriangleStripSet" || type == "IndexedTriangleMesh")
    indexedRuns(indices, strip);
  else if (type == "FaceSet")
    countedRuns(maker, shape, points, polygon);
  else if (type == "TriangleStripSet")
    countedRuns(maker, shape, points, strip);
  else if (type == "QuadMesh")
    quadMesh(maker, shape);
  return maker.finish();
}

Surface elevationGrid(const Values& grid) {
  Surface surface;
  const std::vector<double>& height = grid.numbers("height");
  const std::uint32_t nx = asIndex(grid.number("xDimension", 0)), nz = asIndex(grid.number("zDimension", 0));
  if (nx < 2 || nz < 2 || nx > height.size() || nz > height.size() / nx) return surface;
  const Real dx = grid.number("xSpacing", 1), dz = grid.number("zSpacing", 1);
  for (std::uint32_t z = 0; z < nz; ++z)
    for (std::uint32_t x = 0; x < nx; ++x) {
      surface.points.push_back({x * dx, height[std::size_t{z} * nx + x], z * dz});
      surface.uvs.push_back({Real(x) / (nx - 1), Real(z) / (nz - 1)});
    }
  for (std::uint32_t z = 0; z + 1 < nz; ++z)
    for (std::uint32_t x = 0; x + 1 < nx; ++x) {
      const std::uint32_t p = z * nx + x;
      quad(surface.outline, z * (nx - 1) + x, {p, p + nx, p + nx + 1, p + 1});
    }
  return surface;
}

namespace {

/// The turned frames in which the cross-section stands at each point of the spine.
class Spine {
 public:
  explicit Spine(const std::vector<Vec3>& points)
      : points_(points), closed_(points.size() > 2 && points.front() == points.back()) {
    for (std::size_t i = 0; i < points.size(); ++i) along_.push_back(unit(tangent(i)));
    fill(along_, {0, 1, 0});
    for (std::size_t i = 0; i < points.size(); ++i) across_.push_back(unit(bend(i)));
    if (!closed_ && points.size() > 2) {
      across_.front() = across_[1];
      across_.back() = across_[points.size() - 2];
    }
    fill(across_, straight());
    for (std::size_t i = 1; i < across_.size(); ++i)
      if (dot(across_[i], across_[i - 1]) < 0) across_[i] = -across_[i];
  }

  bool closed() const { return closed_; }
  Vec3 place(std::size_t i, const Vec3& p) const {
    const Vec3 &y = along_[i], z = across_[i], x = cross(y, z);
    return points_[i] + x * p.x + y * p.y + z * p.z;
  }

 private:
  static Vec3 unit(const Vec3& v) {
    const Real l = length(v);
    return l > 0 && std::isfinite(l) ? v / l : Vec3{};
  }
  Vec3 tangent(std::size_t i) const {
    const std::size_t n = points_.size(), last = n - 1;
    if (n < 2) return {};
    if (closed_ && (i == 0 || i == last)) return points_[1] - points_[n - 2];
    return points_[std::min(i + 1, last)] - points_[i > 0 ? i - 1 : 0];
  }
  Vec3 bend(std::size_t i) const {
    const std::size_t n = points_.size(), last = n - 1;
    if (n < 3) return {};
    const std::size_t before = i > 0     ? i - 1
                               : closed_ ? n - 2
                                         : 0,
                      after = i < last  ? i + 1
                              : closed_ ? 1
                                        : last;
    return cross(points_[after] - points_[i], points_[before] - points_[i]);
  }
  /// For a straight spine: z, turned as y is turned to the spine's direction.
  Vec3 straight() const {
    const Vec3 y{0, 1, 0}, d = along_.front(), axis = cross(y, d);
    const Real sine = length(axis), cosine = dot(y, d);
    if (!(sine > 1e-12)) return {0, 0, cosine < 0 ? -1.0 : 1.0};
    return linear(Affine::rotation(axis / sine, math::atan2(sine, cosine)), {0, 0, 1});
  }
  /// An undefined value is as the one before it, or as the first that is not.
  static void fill(std::vector<Vec3>& all, const Vec3& otherwise) {
    const auto known = std::find_if(all.begin(), all.end(), [](const Vec3& v) { return v != Vec3{}; });
    Vec3 last = known == all.end() ? otherwise : *known;
    for (Vec3& v : all) v == Vec3{} ? v = last : last = v;
  }

  const std::vector<Vec3>& points_;
  bool closed_;
  std::vector<Vec3> along_, across_;
};

}  // namespace

Surface extrusion(const Values& shape) {
  Surface surface;
  std::vector<Vec2> section = shape.pairs("crossSection");
  if (section.empty()) section = {{1, 1}, {1, -1}, {-1, -1}, {-1, 1}, {1, 1}};
  std::vector<Vec3> path = shape.vectors("spine");
  if (path.empty()) path = {{0, 0, 0}, {0, 1, 0}};
  if (section.size() < 2 || path.size() < 2) return surface;
  const std::vector<Vec2> scales = shape.pairs("scale");
  const std::vector<double>& turns = shape.numbers("orientation");
  constexpr std::size_t kMostPoints = 10'000'000;
  if (path.size() > kMostPoints / section.size())
    throw Error(Fault::limit,
                "an Extrusion of " + std::to_string(path.size()) + " times " +
                    std::to_string(section.size()) + " points is larger than " + std::to_string(kMostPoints),
                "give its spine or its crossSection fewer points");
  const Spine spine(path);
  const bool round = section.size() > 2 && section.front() == section.back();

  for (std::size_t i = 0; i < path.size(); ++i) {
    const Vec2 scale = scales.empty() ? Vec2{1, 1} : scales[std::min(i, scales.size() - 1)];
    Affine turn;
    if (turns.size() >= 4) {
      const std::size_t k = 4 * std::min(i, turns.size() / 4 - 1);
      const Vec3 axis{turns[k], turns[k + 1], turns[k + 2]};
      if (length(axis) > 0) turn = Affine::rotation(normalize(axis), turns[k + 3]);
    }
    for (const Vec2& p : section)
      surface.points.push_back(spine.place(i, linear(turn, {p.x * scale.x, 0, p.y * scale.y})));
  }

  const auto n = static_cast<std::uint32_t>(section.size()), rows = static_cast<std::uint32_t>(path.size());
  // Where the ends meet they are one point, so that the surface is smooth there.
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    if (spine.closed() && i == rows - 1) i = 0;
    return i * n + (round && j == n - 1 ? 0 : j);
  };
  // Sides: u along the cross-section, v along the spine. Lids: as the cross-section lies, on the scale of its
  // longer side.
  const auto slot = [&](std::uint32_t i, std::uint32_t j) {
    surface.uvs.push_back({Real(j) / (n - 1), Real(i) / (rows - 1)});
    return static_cast<std::uint32_t>(surface.uvs.size() - 1);
  };
  const auto corner = [&](std::uint32_t i, std::uint32_t j) {
    const std::uint32_t p = at(i, j);
    surface.outline.corner(p, p, slot(i, j));
  };
  for (std::uint32_t i = 0; i + 1 < rows; ++i)
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
      surface.outline.face(i);
      corner(i, j);
      corner(i, j + 1);
      corner(i + 1, j + 1);
      corner(i + 1, j);
    }
  Box3 flat;
  for (const Vec2& p : section) flat.extend({p.x, p.y, 0});
  const Real longest = max(flat.size().x, flat.size().y);
  const auto cap = [&](std::uint32_t row, bool turned) {
    const std::uint32_t corners = round ? n - 1 : n;
    if (corners < 3) return;
    surface.outline.face(rows);
    for (std::uint32_t j = 0; j < corners; ++j) {
      const std::uint32_t k = turned ? corners - 1 - j : j, p = at(row, k);
      const Vec2 q = section[k];
      surface.uvs.push_back(longest > 0 ? Vec2{(q.x - flat.low.x) / longest, (q.y - flat.low.y) / longest}
                                        : Vec2{});
      surface.outline.corner(p, p, static_cast<std::uint32_t>(surface.uvs.size() - 1));
    }
  };
  if (!spine.closed() && shape.flag("beginCap", true)) cap(0, true);
  if (!spine.closed() && shape.flag("endCap", true)) cap(rows - 1, false);
  return surface;
}

BoxUvs::BoxUvs(const Surface& surface) {
  Box3 box;
  for (std::uint32_t point : surface.outline.points) box.extend(surface.points[point]);
  if (box.empty()) return;
  const Vec3 size = box.size();
  low_ = box.low;
  for (int axis = 1; axis < 3; ++axis)
    if (size[axis] > size[u_]) u_ = axis;
  v_ = u_ == 0 ? 1 : 0;
  for (int axis = v_ + 1; axis < 3; ++axis)
    if (axis != u_ && size[axis] > size[v_]) v_ = axis;
  size_ = size[u_];
}

Vec2 BoxUvs::of(const Vec3& p) const {
  if (!(size_ > 0)) return {};
  return {(p[u_] - low_[u_]) / size_, (p[v_] - low_[v_]) / size_};
}

Surface boxWithUvs(const Vec3& size) {
  Surface surface;
  for (std::uint32_t i = 0; i < 8; ++i)
    surface.points.push_back(
        {size.x * (i & 1 ? 0.5 : -0.5), size.y * (i & 2 ? 0.5 : -0.5), size.z * (i & 4 ? 0.5 : -0.5)});
  // Each from its bottom left corner on, as seen from outside: front, back, left, right, top, bottom.
  constexpr std::uint32_t kSides[6][4] = {{4, 5, 7, 6}, {1, 0, 2, 3}, {0, 4, 6, 2},
                                          {5, 1, 3, 7}, {6, 7, 3, 2}, {0, 1, 5, 4}};
  constexpr Vec2 kCorners[4] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (std::uint32_t side = 0; side < 6; ++side) {
    surface.outline.face(side);
    for (std::uint32_t i = 0; i < 4; ++i) {
      surface.uvs.push_back(kCorners[i]);
      surface.outline.corner(kSides[side][i], 4 * side + i, 4 * side + i);
    }
  }
  return surface;
}

Surface disc(Real radius, Real y, bool up) {
  constexpr std::uint32_t kCorners = 64;
  Surface surface;
  surface.outline.face(0);
  for (std::uint32_t i = 0; i < kCorners; ++i) {
    const Real angle = (up ? -2 : 2) * kPi * i / kCorners;
    const Real x = math::cos(angle), z = math::sin(angle);
    surface.points.push_back({radius * x, y, radius * z});
    surface.uvs.push_back({0.5 + x / 2, 0.5 + (up ? -z : z) / 2});
    surface.outline.corner(i, i, i);
  }
  return surface;
}

}  // namespace trace::inventor

#include "render/maps/photon_map.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/budget.h"

namespace trace {
namespace {

/// The axis that a normal is nearest to, and its direction.
std::size_t facingOf(const Photon& photon) {
  const Vec3 size = abs(photon.normal);
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  return static_cast<std::size_t>(2 * axis + (photon.normal[axis] < 0));
}

/// The square of the distance from a point to a box.
Real distance2(const Vec3& point, const Box3& box) {
  const Vec3 away = max(max(box.low - point, point - box.high), Vec3{});
  return dot(away, away);
}

}  // namespace

PhotonMap::PhotonMap(std::vector<Photon> photons, Real reach, Real flatness, std::size_t nearest)
    : photons_(std::move(photons)),
      axes_(photons_.size()),
      reach2_(reach * reach),
      steepness_(flatness * flatness - 1),
      nearest_(nearest) {
  constexpr std::size_t kFacings = 6;
  auto begin = photons_.begin();
  for (std::size_t facing = 0; facing < kFacings; ++facing) {
    const auto end =
        std::stable_partition(begin, photons_.end(), [&](const Photon& p) { return facingOf(p) == facing; });
    if (begin == end) continue;
    Box3 normals;
    for (auto photon = begin; photon != end; ++photon) normals.extend(photon->normal);
    const auto first = static_cast<std::size_t>(begin - photons_.begin());
    facings_.push_back({first, static_cast<std::size_t>(end - photons_.begin()), normals});
    build(first, facings_.back().end);
    begin = end;
  }
}

void PhotonMap::build(std::size_t first, std::size_t end) {
  if (end - first < 2) return;
  checkBudget();
  Box3 box;
  for (std::size_t i = first; i < end; ++i) box.extend(photons_[i].point);
  const Vec3 extent = box.high - box.low;
  int axis = extent.x > extent.y ? 0 : 1;
  if (extent.z > extent[axis]) axis = 2;
  const std::size_t middle = first + (end - first) / 2;
  const auto at = [&](std::size_t i) { return photons_.begin() + static_cast<std::ptrdiff_t>(i); };
  // A complete order, or the tree would depend on the C++ library.
  const auto key = [axis](const Photon& p) {
    return std::tuple(p.point[axis], p.point.x, p.point.y, p.point.z, p.direction.x, p.direction.y,
                      p.direction.z);
  };
  std::nth_element(at(first), at(middle), at(end), [&](const Photon& a, const Photon& b) {
    return a.point[axis] != b.point[axis] ? a.point[axis] < b.point[axis] : key(a) < key(b);
  });
  axes_[middle] = static_cast<std::uint8_t>(axis);
  build(first, middle);
  build(middle + 1, end);
}

/// The nearest so far, the farthest of them first: a heap by distance.
struct PhotonMap::Search {
  struct Entry {
    Real distance2;
    const Photon* photon;
    bool operator<(const Entry& other) const {
      return distance2 != other.distance2 ? distance2 < other.distance2 : photon < other.photon;
    }
  };

  const Vec3& point;
  const Vec3 normal;
  Real alike;  ///< the least cosine of normals on one surface
  Real steepness;
  Real most2;  ///< what is farther does not count
  std::size_t nearest;
  std::array<Entry, kNearest> heap{};
  std::size_t count = 0;

  void take(const Photon& photon) {
    const Vec3 way = photon.point - point;
    if (dot(photon.normal, normal) < alike) return;
    // Between both normals, which on a ball is 0 for all of it.
    const Real height = dot(way, normal + photon.normal) / 2;
    const Real distance2 = dot(way, way) + steepness * (height * height);
    if (!(distance2 < most2)) return;
    if (count == nearest) std::pop_heap(heap.begin(), heap.begin() + count--);
    heap[count++] = {distance2, &photon};
    std::push_heap(heap.begin(), heap.begin() + count);
    if (count == nearest) most2 = heap[0].distance2;
  }
};

void PhotonMap::search(std::size_t first, std::size_t end, Search& s) const {
  if (first == end) return;
  const std::size_t middle = first + (end - first) / 2;
  const Photon& photon = photons_[middle];
  const int axis = axes_[middle];
  const Real away = s.point[axis] - photon.point[axis];
  away < 0 ? search(first, middle, s) : search(middle + 1, end, s);
  s.take(photon);
  if (away * away < s.most2) away < 0 ? search(middle + 1, end, s) : search(first, middle, s);
}

PhotonMap::Near PhotonMap::near(const Vec3& point, const Vec3& normal) const {
  Search s{point, normal, kAlike, steepness_, reach2_, nearest_};
  return found(s);
}

PhotonMap::Near PhotonMap::around(const Vec3& point) const {
  Search s{point, {}, 0, 0, reach2_, nearest_};
  return found(s);
}

PhotonMap::Near PhotonMap::found(Search& s) const {
  const Real apart2 = 2 - 2 * s.alike;  // the square of the distance between the ends of such normals
  for (const Facing& facing : facings_)
    if (!(distance2(s.normal, facing.normals) > apart2)) search(facing.first, facing.end, s);
  Near result;
  result.count = s.count;
  result.radius2 = s.most2;
  for (std::size_t i = 0; i < s.count; ++i) {
    result.photons[i] = s.heap[i].photon;
    result.distance2[i] = s.heap[i].distance2;
  }
  return result;
}

}  // namespace trace

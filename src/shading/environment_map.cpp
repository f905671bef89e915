#include "shading/environment_map.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "base/parallel.h"
#include "math/elementary.h"
#include "math/perpendicular.h"

namespace trace {
namespace {

/// Right, down and outward of each face, as seen from inside.
struct FaceAxes {
  Vec3 right, down, outward;
};
constexpr std::array<FaceAxes, 6> kFaces{{{{0, 0, 1}, {0, -1, 0}, {1, 0, 0}},
                                          {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}},
                                          {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                          {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                          {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                          {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};
constexpr int kRight = 0, kLeft = 1, kUp = 2, kDown = 3, kBack = 4, kFront = 5;

/// The face that the direction goes through: that of the largest component; of equal ones the first.
int faceOf(const Vec3& d) {
  const Real x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
  if (x >= y && x >= z) return d.x > 0 ? kRight : kLeft;
  if (y >= z) return d.y > 0 ? kUp : kDown;
  return d.z > 0 ? kBack : kFront;
}

/// At (x, y) in texels from the centre of the first, inside the picture.
Color between(const Picture& p, Real x, Real y) {
  const int x0 = std::clamp(static_cast<int>(x), 0, p.width - 1), x1 = std::min(x0 + 1, p.width - 1);
  const int y0 = std::clamp(static_cast<int>(y), 0, p.height - 1), y1 = std::min(y0 + 1, p.height - 1);
  const Real fx = x - x0, fy = y - y0;
  return lerp(fy, lerp(fx, p.at(x0, y0), p.at(x1, y0)), lerp(fx, p.at(x0, y1), p.at(x1, y1)));
}

Picture square(const Picture& from, int side, int column, int row, bool turned) {
  Picture face(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      face.at(x, y) =
          from.at(column * side + (turned ? side - 1 - x : x), row * side + (turned ? side - 1 - y : y));
  return face;
}

/// The six faces of a cross: up, left, front, right and down stand alike; the back face stands at the right
/// end of a lying one, and upside down at the foot of a standing one.
std::vector<Picture> cutCross(const Picture& cross) {
  const bool lying = cross.width > cross.height;
  const int side = lying ? cross.width / 4 : cross.width / 3;
  if (side < 1 || cross.width != side * (lying ? 4 : 3) || cross.height != side * (lying ? 3 : 4))
    throw std::invalid_argument("a cube cross has 4 x 3 or 3 x 4 squares, but the picture has " +
                                std::to_string(cross.width) + " x " + std::to_string(cross.height) +
                                " pixels");
  std::vector<Picture> faces(6);
  faces[kUp] = square(cross, side, 1, 0, false);
  faces[kLeft] = square(cross, side, 0, 1, false);
  faces[kFront] = square(cross, side, 1, 1, false);
  faces[kRight] = square(cross, side, 2, 1, false);
  faces[kDown] = square(cross, side, 1, 2, false);
  faces[kBack] = lying ? square(cross, side, 3, 1, false) : square(cross, side, 1, 3, true);
  return faces;
}

Color meanOfRow(const Picture& p, int y) {
  Color sum;
  for (int x = 0; x < p.width; ++x) sum += p.at(x, y);
  return sum / p.width;
}

std::vector<Picture> oneOrSix(Picture picture, EnvironmentKind kind) {
  if (picture.width < 1 || picture.height < 1) throw std::invalid_argument("the picture is empty");
  if (kind == EnvironmentKind::cube) return cutCross(picture);
  if (kind == EnvironmentKind::angular && picture.width != picture.height)
    throw std::invalid_argument("an angular map is square, but the picture has " +
                                std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                                " pixels");
  std::vector<Picture> one;
  one.push_back(std::move(picture));
  return one;
}

}  // namespace

EnvironmentMap::EnvironmentMap(EnvironmentKind kind, std::vector<Picture> pictures)
    : kind_(kind), pictures_(std::move(pictures)) {
  if (kind_ != EnvironmentKind::latLong) return;
  const Picture& picture = pictures_.front();
  top_ = meanOfRow(picture, 0);
  bottom_ = meanOfRow(picture, picture.height - 1);
}

EnvironmentMap::EnvironmentMap(Picture picture, EnvironmentKind kind)
    : EnvironmentMap(kind, oneOrSix(std::move(picture), kind)) {}

EnvironmentMap::EnvironmentMap(std::array<Picture, 6> faces)
    : EnvironmentMap(EnvironmentKind::cube,
                     {std::make_move_iterator(faces.begin()), std::make_move_iterator(faces.end())}) {
  const int side = pictures_.front().width;
  for (std::size_t i = 0; i < 6; ++i)
    if (const Picture& face = pictures_[i]; side < 1 || face.width != side || face.height != side)
      throw std::invalid_argument("the six faces of a cube are squares of one size, but \"" +
                                  std::string(kFaceNames[i]) + "\" has " + std::to_string(face.width) +
                                  " x " + std::to_string(face.height) + " pixels, \"" +
                                  std::string(kFaceNames[0]) + "\" " + std::to_string(side) + " x " +
                                  std::to_string(pictures_.front().height));
}

EnvironmentMap::Spot EnvironmentMap::cubeSpot(const Vec3& d) {
  const int face = faceOf(d);
  const FaceAxes& axes = kFaces[static_cast<std::size_t>(face)];
  const Real depth = dot(d, axes.outward);
  return {face, {(dot(d, axes.right) / depth + 1) / 2, (dot(d, axes.down) / depth + 1) / 2}};
}

EnvironmentMap::Spot EnvironmentMap::spot(const Vec3& d) const {
  if (kind_ == EnvironmentKind::cube) return cubeSpot(d);
  const Real across = math::hypot(d.x, d.z);
  if (kind_ == EnvironmentKind::latLong) {
    const Real around = across > 0 ? math::atan2(d.x, -d.z) : 0;
    return {0, {0.5 + around / (2 * kPi), math::atan2(across, d.y) / kPi}};
  }
  const Real off = math::hypot(d.x, d.y);
  if (off == 0) return {0, {d.z < 0 ? 0.5 : 1, 0.5}};
  const Real radius = math::atan2(off, -d.z) / (2 * kPi);
  return {0, {0.5 + radius * (d.x / off), 0.5 - radius * (d.y / off)}};
}

Vec3 EnvironmentMap::direction(const Spot& s) const {
  if (kind_ == EnvironmentKind::cube) {
    const FaceAxes& axes = kFaces[static_cast<std::size_t>(s.face)];
    return normalize(axes.outward + axes.right * (2 * s.uv.x - 1) + axes.down * (2 * s.uv.y - 1));
  }
  if (kind_ == EnvironmentKind::latLong) {
    const Real around = (s.uv.x - 0.5) * 2 * kPi, down = s.uv.y * kPi;
    const math::SinCos turn = math::sincos(around), fall = math::sincos(down);
    return {fall.sin * turn.sin, fall.cos, -fall.sin * turn.cos};
  }
  const Real x = 2 * s.uv.x - 1, y = 1 - 2 * s.uv.y, radius = math::hypot(x, y);
  if (radius > 1) return {};
  if (radius == 0) return {0, 0, -1};
  const math::SinCos fall = math::sincos(radius * kPi);
  const Real off = fall.sin / radius;
  return {off * x, off * y, -fall.cos};
}

Color EnvironmentMap::at(const Spot& s) const {
  if (kind_ == EnvironmentKind::cube) {
    const Picture& face = pictures_[static_cast<std::size_t>(s.face)];
    return between(face, s.uv.x * (face.width - 1), s.uv.y * (face.height - 1));
  }
  const Picture& p = pictures_.front();
  const Real x = s.uv.x * p.width - 0.5, y = s.uv.y * p.height - 0.5;
  const Real left = std::floor(x), top = std::floor(y), fx = x - left, fy = y - top;
  const int x0 = static_cast<int>(left), y0 = static_cast<int>(top);
  if (kind_ == EnvironmentKind::latLong) {  // around; a row of one colour at each pole, half a texel away
    const auto row = [&](int at) {
      const auto column = [&](int c) { return ((c % p.width) + p.width) % p.width; };
      return lerp(fx, p.at(column(x0), at), p.at(column(x0 + 1), at));
    };
    if (y < 0) return lerp(2 * s.uv.y * p.height, top_, row(0));
    if (y >= p.height - 1) return lerp(std::min(2 * (y - (p.height - 1)), 1.0), row(p.height - 1), bottom_);
    return lerp(fy, row(y0), row(y0 + 1));
  }
  Color sum;  // sum of the texels inside the disc
  Real weights = 0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const int cx = std::clamp(x0 + i, 0, p.width - 1), cy = std::clamp(y0 + j, 0, p.height - 1);
      const Real weight = (i == 0 ? 1 - fx : fx) * (j == 0 ? 1 - fy : fy);
      const Real half = p.width / 2.0;
      if (weight == 0 || math::hypot(cx + 0.5 - half, cy + 0.5 - half) > half) continue;
      sum += p.at(cx, cy) * weight;
      weights += weight;
    }
  if (weights > 0) return sum / weights;
  // The rim of a disc of few texels: the nearest one toward the middle.
  const auto inward = [&](Real c) { return std::clamp(0.5 + (c - 0.5) * (1 - 1.0 / p.width), 0.0, 1.0); };
  return p.at(std::min(static_cast<int>(inward(s.uv.x) * p.width), p.width - 1),
              std::min(static_cast<int>(inward(s.uv.y) * p.height), p.height - 1));
}

// --- blur ---------------------------------------------------------------------------------------------

Real EnvironmentMap::texelAngle() const {
  const int width = pictures_.front().width;
  return kind_ == EnvironmentKind::cube ? 2.0 / width : 2 * kPi / width;
}

template <class Texel>
EnvironmentMap EnvironmentMap::sampled(int side, int threads, const Texel& texel) {
  std::array<Picture, 6> faces;
  for (Picture& face : faces) face = Picture(side, side);
  Job job;
  parallelChunks(6 * side, threads > 0 ? threads : hardwareThreads(), job, [&](std::int64_t row, int) {
    checkBudget();
    const int face = static_cast<int>(row) / side, y = static_cast<int>(row) % side;
    const FaceAxes& axes = kFaces[static_cast<std::size_t>(face)];
    for (int x = 0; x < side; ++x) {
      const Real right = 2.0 * x / (side - 1) - 1, down = 2.0 * y / (side - 1) - 1;
      faces[static_cast<std::size_t>(face)].at(x, y) =
          texel(axes.outward + axes.right * right + axes.down * down);
    }
  });
  return EnvironmentMap(std::move(faces));
}

EnvironmentMap EnvironmentMap::blurred(Real angle, int threads) const {
  constexpr int kLeast = 17, kMost = 1025;
  const Real cone = angle * kPi / 180;
  if (cone < texelAngle()) return *this;  // a pixel of the picture is wider
  // As many samples as leave no gaps between them where the reduced picture is as coarse as it gets.
  const Real coarsest = kPi / 2 / (kLeast - 1);
  const int count = std::max(64, static_cast<int>(std::ceil(kPi * (cone / coarsest) * (cone / coarsest))));
  // A texel for each third of the angle; before that the picture is reduced to what lies between two samples.
  const auto sideFor = [&](Real spacing) {
    return static_cast<int>(std::clamp(std::ceil(kPi / 2 / spacing), Real{kLeast}, Real{kMost}));
  };
  const int reducedSide = sideFor(cone * std::sqrt(kPi / count)), side = sideFor(cone / 3);
  const Real cell = 2.0 / (reducedSide - 1);
  const int grid = static_cast<int>(std::clamp(std::ceil(cell / texelAngle()), 1.0, 64.0));
  const EnvironmentMap reduced = sampled(reducedSide, threads, [&](const Vec3& towards) {
    const Vec3 axis = normalize(towards);
    const Vec3 right = perpendicularTo(axis), down = cross(axis, right);
    Color sum;
    for (int j = 0; j < grid; ++j)
      for (int i = 0; i < grid; ++i)
        sum +=
            at(axis + right * (cell * ((i + 0.5) / grid - 0.5)) + down * (cell * ((j + 0.5) / grid - 0.5)));
    return sum / (grid * grid);
  });
  // Samples on a sunflower's spiral, of equal areas; weight (1 + cos) / 2 from the middle to the rim.
  struct Sample {
    Vec3 offset;  // x, y across; z along
    Real weight;
  };
  std::vector<Sample> samples(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const Real share = (k + 0.5) / count;
    const Real off = math::acos(1 - share * (1 - math::cos(cone)));
    const Real around = k * kPi * (3 - std::sqrt(5.0));
    samples[static_cast<std::size_t>(k)] = {
        {math::sin(off) * math::cos(around), math::sin(off) * math::sin(around), math::cos(off)},
        1 + math::cos(kPi * off / cone)};
  }
  return sampled(side, threads, [&](const Vec3& towards) {
    const Vec3 axis = normalize(towards);
    const Vec3 right = perpendicularTo(axis), down = cross(axis, right);
    Color sum;
    Real weights = 0;
    for (const Sample& s : samples) {
      sum += reduced.at(right * s.offset.x + down * s.offset.y + axis * s.offset.z) * s.weight;
      weights += s.weight;
    }
    return sum / weights;
  });
}

// --- kinds and faces by shape and name ----------------------------------------------------------------

EnvironmentKind kindByShape(int width, int height) {
  if (width % 4 == 0 && width / 4 * 3 == height) return EnvironmentKind::cube;
  if (width % 3 == 0 && width / 3 * 4 == height) return EnvironmentKind::cube;
  return width == height ? EnvironmentKind::angular : EnvironmentKind::latLong;
}

FaceName faceByName(std::string_view file) {
  const std::size_t slash = file.find_last_of('/');
  if (slash != file.npos) file.remove_prefix(slash + 1);
  std::string name(file.substr(0, file.find_last_of('.')));
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  struct Row {
    int face;
    std::string_view words[6];
  };
  constexpr Row kRows[]{{kRight, {"positive_x", "positivex", "posx", "pos_x", "right", "px"}},
                        {kLeft, {"negative_x", "negativex", "negx", "neg_x", "left", "nx"}},
                        {kUp, {"positive_y", "positivey", "posy", "pos_y", "top", "py"}},
                        {kDown, {"negative_y", "negativey", "negy", "neg_y", "bottom", "ny"}},
                        {kFront, {"positive_z", "positivez", "posz", "pos_z", "front", "pz"}},
                        {kBack, {"negative_z", "negativez", "negz", "neg_z", "back", "nz"}},
                        {kUp, {"up"}},
                        {kDown, {"down"}}};
  for (const Row& row : kRows)
    for (std::string_view word : row.words)
      if (!word.empty() && std::string_view(name).ends_with(word))
        return {row.face, name.substr(0, name.size() - word.size())};
  return {};
}

}  // namespace trace

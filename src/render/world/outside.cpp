#include "render/world/outside.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "image/srgb.h"
#include "math/elementary.h"

namespace trace {
namespace {

/// Between the centres of the pixels around; at the border the outermost pixels.
Color lookUp(const Picture& p, const Vec2& place) {
  const Real x = std::clamp(place.x * p.width - 0.5, 0.0, p.width - 1.0);
  const Real y = std::clamp(place.y * p.height - 0.5, 0.0, p.height - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, p.width - 1), y1 = std::min(y0 + 1, p.height - 1);
  return lerp(y - y0, lerp(x - x0, p.at(x0, y0), p.at(x1, y0)), lerp(x - x0, p.at(x0, y1), p.at(x1, y1)));
}

/// From the bottom left, and the other way about.
Vec2 fromTopLeft(const Vec2& place) { return {place.x, 1 - place.y}; }

Real elevationOf(const Vec3& d) { return math::atan2(d.y, math::hypot(d.x, d.z)) * 180 / kPi; }

}  // namespace

Outside::Outside(const Scene& scene, const Settings& settings, const CameraFrame& camera)
    : camera_(camera),
      background_(scene.background),
      backdrop_(scene.surroundings.backdrop),
      environment_(scene.surroundings.environment),
      transparent_(settings.alpha),
      turn_{math::cos(settings.environmentRotation * kPi / 180),
            math::sin(settings.environmentRotation * kPi / 180)},
      brightness_(settings.environmentBrightness) {
  if (settings.environmentRotation == 0) turn_ = {1, 0};
  if (background_.elevations.size() != background_.gradient.size()) background_.elevations.clear();
  if (background_.turbidity > 0) daylight_.emplace(background_.turbidity, background_.sun);
  sky_ = environment_                   ? Source::environment
         : daylight_                    ? Source::sky
         : background_.gradient.empty() ? Source::nothing
                                        : Source::gradient;
  const auto faces = background_.faces();
  panorama_ =
      !environment_ && std::any_of(faces.begin(), faces.end(), [](const Pixels* p) { return p->map; });
}

bool Outside::isEven() const {
  const std::vector<Color>& colors = background_.gradient;
  return !panorama_ && sky_ == Source::gradient &&
         std::all_of(colors.begin(), colors.end(), [&](const Color& c) { return c == colors.front(); });
}

Real Outside::unevennessOfGradient() const {
  if (panorama_ || sky_ != Source::gradient) return kInfinity;
  Real brightest = 0, sum = 0;
  for (const Color& color : background_.gradient) brightest = std::max(brightest, luminanceOf(color));
  for (int row = 0; row < SkySums::kRows; ++row) {
    const Real y = 1 - 2 * ((row + 0.5) / SkySums::kRows);
    sum += luminanceOf(background_.gradientAt(elevationOf({std::sqrt(1 - y * y), y, 0})));
  }
  sum -= brightest * static_cast<Real>(background_.gradient.size());  // rows in which the colour jumps
  return sum > 0 && brightest < kInfinity ? brightest * SkySums::kRows / sum : kInfinity;
}

std::shared_ptr<const SkySums> Outside::skySums(int threads) const {
  const std::lock_guard lock(skySums_->mutex);
  if (!skySums_->sums) skySums_->sums = std::make_shared<const SkySums>(*this, threads);
  return skySums_->sums;
}

void Outside::shareSkySums(const Outside& other) {
  const auto mine = background_.faces(), others = other.background_.faces();
  const bool sameFaces = std::equal(mine.begin(), mine.end(), others.begin(),
                                    [](const Pixels* a, const Pixels* b) { return a->map == b->map; });
  if (background_ == other.background_ && sameFaces && environment_ == other.environment_ &&
      turn_ == other.turn_ && brightness_ == other.brightness_)
    skySums_ = other.skySums_;
}

Vec3 Outside::turnedBack(const Vec3& d) const {
  return {turn_.x * d.x - turn_.y * d.z, d.y, turn_.y * d.x + turn_.x * d.z};
}

Outside::View Outside::view(const Ray& ray, RayKind kind) const {
  const bool camera = kind == RayKind::camera;
  if (camera && backdrop_) return seen(Source::backdrop, ray);
  const Source behind = camera && sky_ == Source::nothing ? Source::bands : sky_;
  if (!panorama_) return seen(behind, ray);

  const EnvironmentMap::Spot spot = EnvironmentMap::cubeSpot(turnedBack(ray.direction));
  const Pixels& face = *background_.faces()[static_cast<std::size_t>(spot.face)];
  const Texel texel =
      face.map ? face.map->at(fromTopLeft(spot.uv), {.u = Wrap::clamp, .v = Wrap::clamp}) : Texel{Color(), 0};
  if (texel.alpha <= 0) return seen(behind, ray);
  View view{Source::panorama, spot.uv, spot.face, ray.direction, texel.color * brightness_};
  if (texel.alpha < 1) view.color = lerp(texel.alpha, seen(behind, ray).color, view.color);
  return view;
}

Outside::View Outside::seen(Source source, const Ray& ray) const {
  const Vec3& direction = ray.direction;
  View view;
  view.source = source;
  view.direction = direction;
  switch (view.source) {
    case Source::nothing:
    case Source::panorama: break;
    case Source::backdrop:
      view.place = fromTopLeft(camera_.placeOf(ray));
      view.color = lookUp(*backdrop_, view.place);
      break;
    case Source::bands:
      if (background_.colors.size() > 1) view.place = {0, fromTopLeft(camera_.placeOf(ray)).y};
      view.color = background_.at(view.place.y);
      break;
    case Source::environment: {
      const Vec3 d = turnedBack(direction);
      const EnvironmentMap::Spot spot = environment_->spot(d);
      view.place = spot.uv;
      if (environment_->kind() == EnvironmentKind::cube) view.face = spot.face;
      view.color = environment_->at(spot) * brightness_;
      break;
    }
    case Source::sky: {
      const Vec3 d = turnedBack(direction);
      view.place.y = elevationOf(d);
      view.color = d.y < 0 ? background_.ground : toColor(daylight_->at(d)) * background_.skyBrightness;
      view.color = view.color * brightness_;
      break;
    }
    case Source::gradient:
      view.place.y = elevationOf(direction);
      view.color = background_.gradientAt(view.place.y) * brightness_;
      break;
  }
  return view;
}

std::string sentence(const Outside::View& view) {
  char text[96];
  const char* name = Outside::kNames[static_cast<std::size_t>(view.source)].data();
  switch (view.source) {
    case Outside::Source::nothing:
    case Outside::Source::bands: return "background";
    case Outside::Source::sky:
      if (view.place.y < 0) return "ground, below the horizon of the sky";
      [[fallthrough]];
    case Outside::Source::gradient:
      std::snprintf(text, sizeof text, "%s at %.4g degrees %s the horizon", name, std::abs(view.place.y),
                    view.place.y < 0 ? "below" : "above");
      return text;
    case Outside::Source::backdrop:
    case Outside::Source::environment:
    case Outside::Source::panorama: break;
  }
  const std::string face =
      view.face < 0
          ? ""
          : ", face " + std::string(EnvironmentMap::kFaceNames[static_cast<std::size_t>(view.face)]);
  std::snprintf(text, sizeof text, "%s%s at (%.4g, %.4g) from its top left", name, face.c_str(), view.place.x,
                view.place.y);
  return text;
}

}  // namespace trace

// Lights, cameras and what is behind all.
#include <algorithm>
#include <utility>

#include "base/text.h"
#include "formats/directions.h"
#include "formats/inventor/inventor_reader.h"
#include "formats/inventor/inventor_sky.h"
#include "formats/inventor/inventor_transform.h"
#include "math/elementary.h"
#include "shading/lights/plain_lights.h"

namespace trace::inventor {

void Reader::environment(const Values& v, State&) {
  if (const std::string_view fog = v.word("fogType", "NONE"); fog != "NONE")
    warn(v.node(), "the fog of an Environment is not rendered: fogType " + std::string(fog.substr(0, 40)),
         "fog");
  ambient_ = shine(v.color("ambientColor", Color(1)), v.number("ambientIntensity", 0.2));
  const Vec3 a = v.vector("attenuation", {0, 0, 1});  // squared, linear, constant
  fading_ = {a.z, a.y, a.x};
}

Color Reader::shine(const Color& color, Real factor) {
  constexpr Real kMost = 1e30;
  const auto limited = [&](Real c) { return std::clamp(c * factor, 0.0, kMost); };
  return {limited(color.r), limited(color.g), limited(color.b)};
}

Color Reader::shining(const Values& v) {
  const Color color = v.color("color", Color(1));
  if (vrml2_) ambient_ += shine(color, v.number("ambientIntensity", 0));
  return shine(color, v.number("intensity", 1));
}

Fading Reader::fading(const Values& v) {
  Vec3 fading = vrml2_ ? v.vector("attenuation", {1, 0, 0}) : fading_;
  if (fading == Vec3{}) fading = {1, 0, 0};
  constexpr Real kDefaultRadius = 100;
  if (vrml2_ && v.number("radius", kDefaultRadius) != kDefaultRadius)
    warn(v.node(), "the radius of a light is ignored: it lights objects farther away too", "radius");
  return {fading.x, fading.y, fading.z};
}

void Reader::addLight(const Values& v, const Light& light) {
  if (const Vec3* direction = light.direction(); direction && !(length(*direction) > 0))
    return warn(v.node(), "a light without a direction is left out", "light");
  if (const Vec3* position = light.position(); position && !isFinite(*position))
    return warn(v.node(), "a light without a position is left out", "light");
  scene_.lights.push_back({light, document_.place(v.node().token)});
}

Vec3 Reader::standard() const { return vrml2_ ? Vec3{} : Vec3{0, 0, 1}; }

void Reader::pointLight(const Values& v, State& s) {
  if (!v.flag("on", true)) return;
  const Vec3 position = s.worldFromObject * v.vector("location", standard());
  const Color color = shining(v);
  addLight(v, trace::pointLight(position, color, fading(v)));
}

void Reader::directionalLight(const Values& v, State& s) {
  if (!v.flag("on", true)) return;
  const Vec3 direction = linear(s.worldFromObject, v.vector("direction", {0, 0, -1}));
  addLight(v, trace::directionalLight(direction, shining(v)));
}

void Reader::spotLight(const Values& v, State& s) {
  if (!v.flag("on", true)) return;
  const Vec3 position = s.worldFromObject * v.vector("location", standard()),
             direction = linear(s.worldFromObject, v.vector("direction", {0, 0, -1}));
  const Color color = shining(v);
  const auto degrees = [](Real radians) { return std::clamp(radians * 180 / kPi, 0.0, 180.0); };
  SpotCone cone;
  cone.angle = cone.fullAngle = degrees(v.number("cutOffAngle", 0.785398));
  if (vrml2_)
    cone.fullAngle = std::min(cone.angle, degrees(v.number("beamWidth", 1.570796)));
  else
    cone.exponent = std::max(0.0, 128 * v.number("dropOffRate", 0));
  addLight(v, trace::spotLight(position, direction, color, cone, fading(v)));
}

void Reader::camera(const Values& v, const State& s, const Vec3& position, Real angle, Real aspect) {
  if (hasCamera_)
    return warn(v.node(), "the picture is seen through the first camera; others are left out", "cameras");
  const Affine own = turn(v.numbers("orientation"));
  Camera camera;
  camera.position = s.worldFromObject * v.vector("position", position);
  camera.viewdir = linear(s.worldFromObject, linear(own, {0, 0, -1}));
  camera.updir = linear(s.worldFromObject, linear(own, {0, 1, 0}));
  camera.fov = angle * 180 / kPi;
  if (aspect > 0.01 && aspect < 100) camera.aspectratio = aspect;
  const bool good = camera.fov > 0 && camera.fov < 180 && canLook(camera.viewdir, camera.updir) &&
                    isFinite(camera.position);
  if (!good) return warn(v.node(), "a camera that cannot look is left out", "camera");
  camera.viewdir = normalize(camera.viewdir);
  scene_.camera = camera;
  hasCamera_ = true;
}

void Reader::perspectiveCamera(const Values& v, State& s) {
  camera(v, s, {0, 0, 1}, v.number("heightAngle", 0.785398), v.number("aspectRatio", 1));
}

void Reader::orthographicCamera(const Values& v, State& s) {
  const bool isFirst = !hasCamera_;
  camera(v, s, {0, 0, 1}, kPi / 4, v.number("aspectRatio", 1));
  if (!isFirst || !hasCamera_) return;
  const SourcePlace place = document_.place(v.node().token);
  scene_.choices.push_back({"projection", "orthographic", place});
  scene_.choices.push_back({"view-height", toText(v.number("height", 2)), place});
}

void Reader::viewpoint(const Values& v, State& s) {
  camera(v, s, {0, 0, 10}, v.number("fieldOfView", 0.785398), 1);
}

void Reader::background(const Values& v, State& state) {
  if (std::exchange(hasBackground_, true))
    return warn(v.node(), "the first Background is shown; others are left out", "backgrounds");
  Background& is = scene_.background;
  const SourcePlace place = document_.place(v.node().token);
  const auto picture = [&](std::string_view field) { return Pixels{fileOf(v, field), nullptr, place}; };
  const Dome sky{v.colors("skyColor"), v.numbers("skyAngle")},
      ground{v.colors("groundColor"), v.numbers("groundAngle")};
  is = gradientOf(sky, ground);
  is.front = picture("frontUrl"), is.back = picture("backUrl");
  is.left = picture("leftUrl"), is.right = picture("rightUrl");
  is.top = picture("topUrl"), is.bottom = picture("bottomUrl");

  const auto faces = is.faces();
  const bool pictures =
      std::any_of(faces.begin(), faces.end(), [](const Pixels* p) { return !p->file.empty(); });
  if (!pictures && is.gradient.size() < 2) {  // one colour is behind everything, and in no mirror
    is.colors = std::exchange(is.gradient, {});
    is.elevations.clear();
    return;
  }
  const Vec3 up = linear(state.worldFromObject, {0, 1, 0}), ahead = linear(state.worldFromObject, {0, 0, -1});
  constexpr Real kTilted = 1e-6;
  if (!(up.y > 0) || math::hypot(up.x, up.z) > kTilted * up.y)
    return warn(v.node(), "a Background that is turned about another axis than y stands upright", "tilted");
  const Real turn = math::atan2(-ahead.x, -ahead.z) * 180 / kPi;
  if (pictures && turn != 0) scene_.choices.push_back({"environment-rotation", toText(turn), place});
}

void Reader::navigationInfo(const Values& v, State&) {
  if (v.has("headlight") && !headlight_) {
    headlight_ = v.flag("headlight", true);
    headlightAt_ = &v.field("headlight")->token;
  }
}

void Reader::drawStyle(const Values& v, State&) {
  const std::string_view style = v.word("style", "FILLED");
  if (style == "FILLED") return;
  warn(v.node(),
       "DrawStyle " + std::string(style.substr(0, 40)) + " is not rendered: surfaces are drawn whole",
       "draw style");
}

}  // namespace trace::inventor

#include "formats/ubc/ubc_scene.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "formats/directions.h"
#include "shading/lights/plain_lights.h"

namespace trace::ubc {
namespace {

constexpr Real kFarthest = 1e30;  // that the options of passes take

}  // namespace

Phong phong(const Surface& s) {
  Phong phong;
  phong.ambient = s.ambient;
  phong.diffuse = s.diffuse;
  phong.specular = s.specular;
  phong.emissive = s.emission;
  phong.reflective = Color(s.reflect);
  phong.shininess = s.shininess;
  phong.shadow = s.shadow;
  return phong;
}

void addLamp(Scene& scene, const Lamp& lamp, const SourcePlace& place) {
  if (!isBlack(lamp.ambient)) scene.lights.push_back({ambientLight(lamp.ambient), place});
  const Vec3& fading = lamp.attenuation;
  const Real constant = fading == Vec3{} ? 1 : fading.x;
  scene.lights.push_back({pointLight(lamp.position, lamp.diffuse, {constant, fading.y, fading.z}, lamp.radius,
                                     lamp.specular + lamp.diffuse * -1),
                          place});
}

Camera camera(const View& view, const SourcePlace& place) {
  Camera camera;
  camera.position = view.eye;
  camera.viewdir = view.center - view.eye;
  camera.updir = view.up;
  camera.fov = view.fovy;
  camera.aspectratio = view.aspect;
  camera.near = view.near;
  camera.far = view.far;
  if (!canLook(camera.viewdir, camera.updir))
    throw Error(
        Fault::scene, place,
        "expected a view whose up vector is not parallel to it, from an eye that is not its own target");
  camera.viewdir = normalize(camera.viewdir);
  if (!(view.fovy > 0 && view.fovy < 180))
    throw Error(Fault::scene, place, "expected a field of view between 0 and 180 degrees");
  if (!(view.aspect > 0))
    throw Error(Fault::scene, place, "expected an aspect ratio above 0, width / height");
  return camera;
}

void warnOfNothing(const Scene& scene, const View& view, const SourcePlace& viewPlace, Messages& messages) {
  const SourcePlace place{scene.file, 0, 0, {}};
  if (!(view.near < view.far))
    messages.warn(viewPlace, "expected near to be less than far, found " + toText(view.near) + " and " +
                                 toText(view.far) + ": nothing is seen");
  if (scene.objects.empty()) messages.warn(place, "no object: the picture will be empty");
}

void warnOfRanges(const Material& material, const SourcePlace& place, WarningsByKind& warnings) {
  const Phong phong = phongOf(material);
  const auto check = [&](const char* name, double value, double most) {
    if (value >= 0 && value <= most) return;
    const std::string range = most == kNoLimit ? "at least 0" : "0 to " + toText(most);
    warnings.warn(place, std::string(name) + " of a material: expected " + range + ", found " + toText(value),
                  {}, std::string("range of ") + name);
  };
  const auto least = [](const Color& c) { return min(c.r, min(c.g, c.b)); };
  check("ambient", least(phong.ambient), kNoLimit);
  check("diffuse", least(phong.diffuse), kNoLimit);
  check("specular", least(phong.specular), kNoLimit);
  check("emission", least(phong.emissive), kNoLimit);
  check("shininess", phong.shininess, kNoLimit);
  check("shadow", phong.shadow, 1);
  check("reflect", phong.reflective.r, 1);
  check("transparency", phong.transmissive.r, 1);
  if (!(phong.index > 0))
    warnings.warn(place, "the index of refraction of a material: expected a number above 0, found " +
                             toText(phong.index));
}

void addChoices(Scene& scene, int width, int height, const View& view) {
  const SourcePlace place{scene.file, 0, 0, {}};
  for (const auto& [option, value] : {std::pair<std::string, std::string>{"like", "ubc"},
                                      {"depth", "9"},
                                      {"width", std::to_string(width)},
                                      {"height", std::to_string(height)},
                                      {"passes", "depth"},
                                      {"pass-depth", "ray"},
                                      {"pass-format", "same"},
                                      {"pass-name", "underscore"}})
    scene.choices.push_back({option, value, place});
  if (view.near >= 0 && view.far > view.near && view.far <= kFarthest) {
    scene.choices.push_back({"pass-near", toText(view.near), place});
    scene.choices.push_back({"pass-far", toText(view.far), place});
  }
  const std::string::size_type dot = scene.file.find_last_of("./\\");
  const bool hasSuffix = dot != std::string::npos && scene.file[dot] == '.';
  scene.picture = scene.file.substr(0, hasSuffix ? dot : std::string::npos) + "_out.bmp";
}

}  // namespace trace::ubc

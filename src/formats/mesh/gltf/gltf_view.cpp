#include "formats/mesh/gltf/gltf_view.h"

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "formats/directions.h"
#include "formats/mesh/gltf/document/gltf_values.h"
#include "shading/lights/plain_lights.h"

namespace trace {

void readCamera(const tinygltf::Camera& from, const Affine& worldFromNode, const SourcePlace& place,
                Model& model, Messages& messages) {
  if (model.camera) return;
  const bool parallel = from.type == "orthographic";
  const double fov = parallel ? 45 : from.perspective.yfov * 180 / kPi;
  const double aspect =
      parallel ? from.orthographic.xmag / from.orthographic.ymag : from.perspective.aspectRatio;
  Camera camera;
  camera.position = worldFromNode * Vec3{};
  camera.viewdir = linear(worldFromNode, {0, 0, -1});
  camera.updir = linear(worldFromNode, {0, 1, 0});
  if (!(fov > 0 && fov < 180) || (parallel && !(std::abs(aspect) > 0 && std::isfinite(aspect))) ||
      !canLook(camera.viewdir, camera.updir) || !isFinite(camera.position))
    return messages.warn(place, "camera \"" + from.name + "\" cannot look; it is left out");
  camera.viewdir = normalize(camera.viewdir);
  camera.updir = normalize(camera.updir);
  camera.fov = fov;
  if (std::abs(aspect) > 0 && std::isfinite(aspect)) camera.aspectratio = std::abs(aspect);
  model.camera = camera;
  if (!parallel) return;
  model.choices.push_back({"projection", "orthographic", place});
  model.choices.push_back({"view-height", toText(std::abs(2 * from.orthographic.ymag)), place});
}

void readLight(const tinygltf::Light& from, const Affine& worldFromNode, const SourcePlace& place,
               Model& model, Messages& messages) {
  const Color color = colorOf(from.color, Color(1)) * (from.intensity / kPi);
  const Vec3 position = worldFromNode * Vec3{}, direction = linear(worldFromNode, {0, 0, -1});
  if (!isFinite(color) || !isFinite(position) || !isFinite(direction) || direction == Vec3{})
    return messages.warn(place, "light \"" + from.name + "\" is left out: its numbers are not finite");
  if (from.type == "directional") {
    model.lights.push_back({directionalLight(normalize(direction), color), place});
    return;
  }
  const auto degrees = [](Real radians) { return std::clamp(radians * 180 / kPi, 0.0, 90.0); };
  if (from.type == "spot")
    model.lights.push_back({spotLight(position, normalize(direction), color,
                                      {.angle = degrees(from.spot.outerConeAngle),
                                       .fullAngle = degrees(from.spot.innerConeAngle)},
                                      kInverseSquare),
                            place});
  else
    model.lights.push_back({pointLight(position, color), place});
  const bool isLifted = std::any_of(model.choices.begin(), model.choices.end(),
                                    [](const auto& choice) { return choice.option == "limit-attenuation"; });
  if (!isLifted) model.choices.push_back({"limit-attenuation", "off", place});
}

}  // namespace trace

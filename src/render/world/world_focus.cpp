// The focus of the lens of a World's camera (docs/lens.md).
#include <set>

#include "base/text.h"
#include "render/world/world.h"
#include "scene/scene.h"

namespace trace {

void World::focus(const Scene& scene, const Settings& settings) {
  const ScenePlace& place = settings.focusOn;
  if (!place.none()) {
    const Vec3 point = place.point ? *place.point : seenPlaceOf(place.object, scene);
    camera_.optics.lens.focus = camera_.focusOn(point);
    if (!(camera_.optics.lens.focus > 0))
      throw Error(Fault::usage, "--focus-on " + findOption("focus-on").get(settings) +
                                    " lies behind the camera, " + toText(-camera_.optics.lens.focus) +
                                    " units away");
  }
  if (!camera_.wantsMiddle()) return;
  Statistics uncounted;
  const std::optional<Found> found = closest({camera_.eye, camera_.ahead}, Faces::both, uncounted);
  camera_.setMiddle(found ? found->t : kInfinity);
}

Vec3 World::seenPlaceOf(const std::string& name, const Scene& scene) const {
  std::vector<std::uint32_t> named;
  Box3 around;
  bool endless = false;
  std::set<std::string_view> names;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    if (!scene.objects[i].name.empty()) names.insert(scene.objects[i].name);
    if (scene.objects[i].name != name) continue;
    named.push_back(i);
    const Box3 box = objects_[i].placement.outFromIn() * objects_[i].shape.bounds();
    endless = endless || box.unbounded();
    if (!box.unbounded()) around.extend(box);
  }
  if (named.empty()) {
    const std::vector<std::string_view> known(names.begin(), names.end());
    throw Error(Fault::usage, "--focus-on: no object of the scene is called \"" + name + "\"",
                known.empty() ? "give objects names, as in sphere { name = \"ball\"; }, or name a point x,y,z"
                              : didYouMean(name, known));
  }
  const Vec3 middle = endless || around.empty() ? camera_.eye + camera_.ahead : around.center();
  const bool parallel = camera_.optics.projection == Projection::orthographic;
  const Vec3 along = parallel ? camera_.ahead : normalize(middle - camera_.eye);
  const Ray ray{parallel ? middle - along * dot(middle - camera_.eye, along) : camera_.eye, along};
  Real nearest = kInfinity;
  Statistics uncounted;
  for (const std::uint32_t object : named)
    crossingsOf(object, ray, kInfinity, uncounted, [&](const Found& found) {
      nearest = std::min(nearest, found.t);
      return false;
    });
  return nearest < kInfinity ? ray.at(nearest) : middle;  // the middle of a ring is nothing that rays meet
}

}  // namespace trace

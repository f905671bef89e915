#include "app/explain/light_landings.h"

#include <algorithm>

#include "app/explain/path_ways.h"
#include "render/samples/pixel.h"

namespace trace {
namespace {

/// The places of a landing's path, which is traced once more.
std::string routeOf(const Session& session, const Landing& landing) {
  RayTree tree;
  PixelTracer(session.moments(), session.settings(), session.size(), &tree)
      .sample(landing.x, landing.y, landing.sample);
  const std::vector<PathWay> ways = pathWays(tree);
  const auto way = std::find_if(ways.begin(), ways.end(),
                                [&](const PathWay& w) { return w.camera == 1 && w.light == landing.light; });
  if (way == ways.end()) return "";
  std::vector<int> rays = raysOf(tree, *way);  // the last one leaves the light
  rays.erase(rays.begin());                    // to the camera
  std::string route;
  for (auto ray = rays.rbegin(); ray != rays.rend(); ++ray) {
    const RayNode& node = rayAt(tree, *ray);
    const bool last = ray + 1 == rays.rend();
    route += ray == rays.rbegin() ? "from a light by " : last ? " and " : ", ";
    route += node.hit ? objectName(session.sceneOf(tree), node.hit->object) : "a medium";
  }
  return route;
}

}  // namespace

LightLandings lightLandings(const Session& session, const Region& region, int x, int y, Job& job) {
  Settings settings = session.settings();
  settings.region = region;
  LightLandings landings{lightImageAt(session.moments(), settings, session.size(), x, y, job), {}};
  for (const Landing& landing : landings.image.brightest)
    landings.routes.push_back(routeOf(session, landing));
  return landings;
}

}  // namespace trace

#include "app/way_pyramid.h"

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace trace {
namespace {

constexpr int kPyramidWidth = 96, kPyramidSamples = 16;

Settings pyramidSettings(const Session& session, bool unweighted) {
  Settings settings = session.settings();
  const Size size = session.size();
  settings.width = std::min(kPyramidWidth, size.width);
  settings.height = std::max(1, settings.width * size.height / std::max(1, size.width));
  settings.region = {};
  settings.spp = kPyramidSamples;
  settings.noiseTarget = 0;
  settings.subdivide = 0;
  settings.denoise = false;
  settings.unweighted = unweighted;
  return settings;
}

}  // namespace

Pyramid wayPyramid(std::shared_ptr<const Session> session, bool unweighted, int places,
                   const Cancelled& cancelled) {
  Pyramid pyramid{session, unweighted, places};
  if (!session || session->settings().integrator != IntegratorKind::bdpt) return pyramid;
  Settings settings = pyramidSettings(*session, unweighted);
  try {
    for (int count = 2; count <= places; ++count)
      for (int light = 0; light < count && !(cancelled && cancelled()); ++light) {
        settings.lightVertices = light;
        settings.cameraVertices = count - light;
        Session one;
        one.open(session->scene(), settings);
        one.build(session.get());
        if (const RenderResult result = one.renderPicture(); !result.failure.empty())
          throw Error(Fault::scene, result.failure);
        pyramid.pictures.push_back({light, count - light, one.film().picture()});
      }
  } catch (const Error& error) {
    pyramid.problem = error.messages().front().what;
  } catch (const std::bad_alloc&) {
    pyramid.problem = "out of memory";
  }
  return pyramid;
}

void PyramidMaker::want(const std::shared_ptr<const Session>& session, bool unweighted, int places) {
  if (asked_.session == session && asked_.unweighted == unweighted && asked_.places == places) return;
  asked_ = {session, unweighted, places};
  task_.start([=](const Cancelled& cancelled) { return wayPyramid(session, unweighted, places, cancelled); });
}

bool PyramidMaker::update() {
  std::optional<Pyramid> made = task_.take();
  if (!made) return false;
  shown_ = std::move(*made);
  return true;
}

}  // namespace trace

#include "app/way_pyramid.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "app/workspace.h"
#include "base/error.h"

namespace trace {
namespace {

constexpr int kPyramidWidth = 96, kPyramidSamples = 16;

/// Of all ways; with those of the session that shows one of them.
Settings pyramidSettings(const Session& session, bool unweighted) {
  Settings settings = session.settings();
  settings.lightVertices = settings.cameraVertices = -1;
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

bool samePyramid(const Session& a, const Session& b) {
  return !differInPicture(pyramidSettings(a, false), pyramidSettings(b, false)) && a.scene() == b.scene();
}

/// Cancels a job as soon as its answer is not wanted, as long as this lives.
class CancelWatch {
 public:
  CancelWatch(Job& job, const Cancelled& cancelled)
      : thread_([&job, cancelled](const std::stop_token& stop) {
          while (cancelled && !stop.stop_requested() && !job.cancel) {
            if (cancelled()) job.cancel = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
          }
        }) {}

 private:
  std::jthread thread_;
};

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
        one.job().patience = {};
        const CancelWatch watch(one.job(), cancelled);
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
  const bool same = asked_.unweighted == unweighted && asked_.places == places;
  if (same && (session == asked_.session || session == alike_)) return;
  alike_ = session;
  if (same && session && asked_.session && samePyramid(*session, *asked_.session)) return;
  asked_ = {session, unweighted, places};
  task_.start([=](const Cancelled& cancelled) { return wayPyramid(session, unweighted, places, cancelled); });
}

void PyramidMaker::giveUp() {
  if (asked_.session == shown_.session && asked_.unweighted == shown_.unweighted &&
      asked_.places == shown_.places)
    return;
  asked_ = {shown_.session, shown_.unweighted, shown_.places};
  alike_.reset();
  task_.start([old = shown_](const Cancelled&) { return old; });
}

bool PyramidMaker::update() {
  std::optional<Pyramid> made = task_.take();
  if (!made) return false;
  shown_ = std::move(*made);
  return true;
}

}  // namespace trace

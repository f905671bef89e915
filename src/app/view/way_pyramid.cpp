#include "app/view/way_pyramid.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

#include "app/editing/workspace.h"
#include "base/error.h"
#include "base/own_thread.h"
#include "scene/options.h"

namespace trace {
namespace {

constexpr int kSmallWidth = 96, kLargeWidth = 320, kSamples = 16;

/// The picture of all strategies, with those of the session that shows one of them.
Settings pyramidSettings(const PyramidPlan& plan) {
  Settings settings = plan.session->settings();
  settings.lightVertices = settings.cameraVertices = -1;
  const Size size = plan.session->size();
  settings.width = std::min(plan.alone ? kLargeWidth : kSmallWidth, size.width);
  settings.height = std::max(1, settings.width * size.height / std::max(1, size.width));
  settings.region = {};
  settings.spp = kSamples;
  settings.noiseTarget = 0;
  settings.subdivide = 0;
  settings.denoise = false;
  settings.unweighted = plan.unweighted;
  return settings;
}

/// Both have the same pictures.
bool samePictures(const PyramidPlan& a, const PyramidPlan& b) {
  if (!a.session || !b.session || a.places != b.places || a.alone != b.alone) return false;
  return a.session->scene() == b.session->scene() && !differInPicture(pyramidSettings(a), pyramidSettings(b));
}

/// Cancels a job as soon as its answer is not wanted, as long as this lives. Without threads nobody can say
/// so.
class CancelWatch {
 public:
  CancelWatch(Job& job, const Cancelled& cancelled)
      : thread_(ownThread(Threads::own, [this, &job, cancelled] {
          while (cancelled && !over_ && !job.cancel) {
            if (cancelled()) job.cancel = true;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
          }
        })) {}
  ~CancelWatch() {
    over_ = true;
    if (thread_.joinable()) thread_.join();
  }
  CancelWatch(const CancelWatch&) = delete;
  CancelWatch& operator=(const CancelWatch&) = delete;

 private:
  std::atomic<bool> over_{false};
  std::thread thread_;
};

/// The contribution of these paths: all, if they have -1 vertices from both ends.
Picture wayPicture(const Session& session, Settings settings, const Way& way, const Cancelled& cancelled) {
  settings.lightVertices = way.light;
  settings.cameraVertices = way.camera;
  Session one;
  one.open(session.scene(), settings);
  one.build(&session);
  one.job().patience = {};
  const CancelWatch watch(one.job(), cancelled);
  if (const RenderResult result = one.renderPicture(); !result.failure.empty())
    throw Error(Fault::scene, result.failure);
  return one.film().picture();
}

std::vector<Way> waysOf(const PyramidPlan& plan) {
  if (plan.alone) return {*plan.alone};
  std::vector<Way> ways;
  for (int count = 2; count <= plan.places; ++count)
    for (int light = 0; light < count; ++light) ways.push_back({light, count - light});
  return ways;
}

double lightIn(const Picture& picture) {
  double sum = 0;
  for (const Color& c : picture.pixels) sum += luminanceOf(c);
  return sum;
}

}  // namespace

bool showsStrategies(const Settings& settings) { return findOption("light-vertices").concerns(settings); }

Pyramid wayPyramid(const PyramidPlan& plan, const Cancelled& cancelled) {
  Pyramid pyramid{plan};
  if (!plan.session || !showsStrategies(plan.session->settings())) return pyramid;
  const Settings settings = pyramidSettings(plan);
  const auto given = [&] { return cancelled && cancelled(); };
  try {
    double light = 0;
    for (const Way& way : waysOf(plan)) {
      if (given()) return pyramid;
      pyramid.pictures.push_back({way, wayPicture(*plan.session, settings, way, cancelled)});
      light += lightIn(pyramid.pictures.back().picture);
    }
    if (plan.alone || plan.unweighted) return pyramid;
    // The same samples, so that what is left is not noise.
    if (const double all = lightIn(wayPicture(*plan.session, settings, {-1, -1}, cancelled)); all > 0)
      pyramid.longer = std::max(0.0, 1 - light / all);
  } catch (const Error& error) {
    pyramid.problem = error.messages().front().what;
  } catch (const std::bad_alloc&) {
    pyramid.problem = "out of memory";
  }
  return pyramid;
}

void PyramidMaker::want(const PyramidPlan& plan) {
  if (plan == wanted_) return;
  wanted_ = plan;
  if (samePictures(plan, asked_)) return;
  const bool there = samePictures(plan, shown_.plan);
  asked_ = there ? shown_.plan : plan;
  if (plan.session && !there)
    task_.start([plan](const Cancelled& cancelled) { return wayPyramid(plan, cancelled); });
  else if (task_.pending())
    task_.start([](const Cancelled&) { return std::nullopt; });
}

bool PyramidMaker::update() {
  std::optional<std::optional<Pyramid>> made = task_.take();
  if (!made || !*made) return false;
  shown_ = std::move(**made);
  return true;
}

}  // namespace trace

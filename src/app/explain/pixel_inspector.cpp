#include "app/explain/pixel_inspector.h"

#include <algorithm>
#include <array>

#include "base/budget.h"
#include "render/integrators/make_integrator.h"
#include "scene/integrators.h"
#include "scene/options.h"

namespace trace {
namespace {

/// The largest number of rays of a pixel: those that are divided show corners of their neighbours, too.
int mostRaysOf(const Settings& settings) {
  const int across = (1 << settings.subdivide) + 1;
  return subdivides(settings) ? across * across : samplesOf(settings);
}

/// Parts of the picture to which no ray of the pixel contributes; the film knows the light image of bdpt.
std::string noteOn(const Settings& settings) {
  if (hasTrait(settings, Trait::byChains))
    return "Markov chains made this picture, in no order of pixels: these paths show the mean that they "
           "converge to.";
  return settings.denoise ? "Denoise makes the pixel a mean of pixels that are alike." : "";
}

/// Traces the pixel's sample as it would be with another value of an option.
std::optional<Color> retraced(const TracedPixel& pixel, std::string_view option, const std::string& value,
                              const Cancelled& cancelled) {
  constexpr double kMostSeconds = 0.5;
  if (cancelled && cancelled()) return {};
  Budget budget(budgetOfThread.budget);
  budget.limitTime(kMostSeconds);
  const BudgetScope scope(&budget);
  try {
    const Session& session = *pixel.session;
    Settings settings = session.settings();
    findOption(option).assign(settings, value);
    Messages ignored;  // said once the option is chosen
    const Compiled here{pixel.scene(), session.settings(), session.worldOf(pixel.tree())};
    const World world = compile(pixel.scene(), settings, ignored, &here);
    Job job;
    const std::unique_ptr<const Integrator> integrator = makeIntegrator(world, settings, job);
    const std::array moments{Moment{&world, integrator.get()}};
    const auto onlyTree = [] { return true; };
    const Explanation then =
        explain(moments, settings, session.size(), pixel.x, pixel.y, pixel.tree().sample, onlyTree);
    if (!then.tree.nodes.empty()) return then.tree.nodes.front().radiance;
  } catch (const std::exception&) {  // too many rays, or too little time
  }
  return {};
}

/// Facts that follow from the tree.
void arrange(TracedPixel& pixel, const Cancelled& cancelled) {
  pixel.segments = raySegments(pixel.tree());
  const std::vector<RayNode>& rays = pixel.tree().nodes;
  pixel.level.assign(rays.size(), 0);
  pixel.hasChildren.assign(rays.size(), 0);
  for (std::size_t i = 1; i < rays.size(); ++i) {
    if (rays[i].parent < 0) continue;
    const auto parent = static_cast<std::size_t>(rays[i].parent);
    pixel.level[i] = pixel.level[parent] + 1;
    pixel.hasChildren[parent] = 1;
  }
  pixel.ways = pathWays(pixel.tree());
  pixel.why = whyOf(pixel.tree(), pixel.scene(), pixel.session->settings(),
                    [&](std::string_view option, const std::string& value) {
                      return retraced(pixel, option, value, cancelled);
                    });
}

}  // namespace

TracedPixel arrangedPixel(std::shared_ptr<const Session> session, Explanation explanation) {
  TracedPixel pixel{std::move(session), explanation.tree.x, explanation.tree.y, 0, std::move(explanation)};
  arrange(pixel, {});
  return pixel;
}

TracedPixel tracePixel(std::shared_ptr<const Session> session, int x, int y, int sample,
                       const Cancelled& cancelled) {
  TracedPixel pixel{session, x, y, std::clamp(sample, 0, mostRaysOf(session->settings()) - 1)};
  try {
    pixel.explanation = pixel.session->explain(x, y, pixel.sample, cancelled);
    arrange(pixel, cancelled);
    pixel.note = noteOn(session->settings());
  } catch (const Error& error) {
    pixel.problem = error.messages().front().what;
  } catch (const std::exception& error) {
    pixel.problem = error.what();
  }
  return pixel;
}

std::string sampleText(const TracedPixel& pixel) {
  const std::size_t count = pixel.explanation.samples.size();
  return count < 2 ? "" : "sample " + std::to_string(pixel.tree().sample) + " of " + std::to_string(count);
}

void PixelInspector::want(const std::shared_ptr<const Session>& session, int x, int y, int sample) {
  if (session == session_ && x == x_ && y == y_ && sample == sample_) return;
  session_ = session;
  x_ = x;
  y_ = y;
  sample_ = sample;
  ask();
}

void PixelInspector::pin(bool on) {
  pinned_ = on ? shown_.traced : nullptr;
  if (pinned_ && !pinned_->problem.empty()) pinned_.reset();
  if (session_) ask();
}

void PixelInspector::forget() {
  shown_ = {};
  pinned_.reset();
  session_.reset();
  ask();
}

void PixelInspector::ask() {
  task_.start([session = session_, x = x_, y = y_, sample = sample_, pinned = pinned_,
               before = shown_.traced](const Cancelled& cancelled) {
    Shown answer{before, pinned, {}};
    if (!session) return Shown{nullptr, pinned, {}};
    if (!before || before->session != session || before->x != x || before->y != y || before->sample != sample)
      answer.traced = std::make_shared<const TracedPixel>(tracePixel(session, x, y, sample, cancelled));
    if (pinned && answer.traced->problem.empty() && !cancelled())
      answer.pairs =
          difference(pinned->tree(), pinned->scene(), answer.traced->tree(), answer.traced->scene());
    return answer;
  });
}

bool PixelInspector::update() {
  std::optional<Shown> answer = task_.take();
  if (!answer) return false;
  if (answer->pinned != pinned_) {  // asked for before forget()
    answer->pinned.reset();
    answer->pairs.clear();
  }
  shown_ = std::move(*answer);
  return true;
}

}  // namespace trace

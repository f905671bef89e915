// Rendering for programs.
#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <optional>

#include "app/explain/explain_json.h"
#include "app/explain/explain_text.h"
#include "app/explain/explained_rays.h"
#include "app/session/denoising.h"
#include "app/session/output.h"
#include "app/session/session.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "image/development/development.h"
#include "library/guard.h"
#include "library/images.h"
#include "library/scene_state.h"
#include "library/watched_work.h"
#include "render/picture/passes.h"
#include "scene/integrators.h"

namespace traceray {

struct RenderState {
  trace::Session session;
  trace::RenderResult result;
  std::vector<trace::Message> ofScene;  ///< warnings of reading and adding
  double seconds = 0;
  std::optional<trace::Picture> rendered, picture;  ///< with and without noise
  std::optional<Image> image;
  std::map<std::string, Image> passes;

  /// Linear light as a file of it has it, except for what two eyes see in one place.
  const trace::Picture& light() {
    if (!picture) {
      rendered = session.film().picture();
      picture = pictureOfFilm(session.film(), session.settings());
    }
    return *picture;
  }
  trace::Picture shown() {
    return developed(trace::finished(light(), session.settings()), developmentOf(session.settings()));
  }
};

namespace {

/// Ends what goes on before the first ray.
struct StoppedEarly {};

double secondsOf(const trace::Session& session) {
  for (const trace::Phase& phase : session.phases())
    if (phase.name == "trace") return phase.wall;
  return 0;
}

}  // namespace

Render::Render(std::unique_ptr<RenderState> state) : state_(std::move(state)) {}
Render::Render(Render&&) noexcept = default;
Render& Render::operator=(Render&&) noexcept = default;
Render::~Render() = default;

int Render::width() const {
  return trace::finished(state_->session.size(), state_->session.settings()).width;
}
int Render::height() const {
  return trace::finished(state_->session.size(), state_->session.settings()).height;
}
bool Render::finished() const { return state_->result.end == trace::End::finished; }
std::string Render::end() const {
  switch (state_->result.end) {
    case trace::End::cancelled: return "cancelled";
    case trace::End::timeLimit: return "time limit";
    case trace::End::outOfMemory: return "out of memory";
    case trace::End::failed: return "failed: " + state_->result.failure;
    case trace::End::finished: break;
  }
  return "finished";
}
double Render::seconds() const { return state_->seconds; }
std::uint64_t Render::rays() const { return state_->result.statistics.allRays(); }
std::vector<Problem> Render::warnings() const {
  std::vector<trace::Message> all = state_->ofScene;
  for (const trace::Message& message : state_->session.messages().all())
    if (std::find(all.begin(), all.end(), message) == all.end()) all.push_back(message);
  return problemsOf(all);
}

const Image& Render::image() const {
  return guarded([&]() -> const Image& {
    if (!state_->image) state_->image = imageOf(trace::finished(state_->light(), state_->session.settings()));
    return *state_->image;
  });
}

Image Render::shown() const {
  return guarded([&] { return imageOf(state_->shown()); });
}

std::vector<std::string> Render::passes() const {
  std::vector<std::string> names;
  for (const trace::PassRow* row : passesOf(state_->session.settings())) names.emplace_back(row->name);
  return names;
}

const Image& Render::pass(const std::string& name) const {
  return guarded([&]() -> const Image& {
    if (const auto found = state_->passes.find(name); found != state_->passes.end()) return found->second;
    const trace::Settings& settings = state_->session.settings();
    for (const trace::PassRow* row : passesOf(settings)) {
      if (row->name != name) continue;
      const trace::Picture values =
          valuesOf(*row, state_->session.film(), settings, state_->session.names(), state_->light());
      return state_->passes.emplace(name, imageOf(values)).first->second;
    }
    std::string known;
    for (const std::string& one : passes()) known += (known.empty() ? "" : ", ") + one;
    throw Error(Error::Kind::usage, "pass: expected one that was rendered, found \"" + name + "\"",
                known.empty() ? "render with the option passes, as in {\"passes\", \"" + name + "\"}"
                              : "there are " + known);
  });
}

std::string Render::write(const std::string& file) {
  return guarded([&] {
    trace::Session& session = state_->session;
    for (const trace::Output& output : outputs(file, session.settings())) {
      checkIsNoInput(output.path, session.scene().inputs);
      checkEncodable(trace::pictureFormatFor(output.path), width(), height());
      trace::checkWritable(output.path);
    }
    trace::PictureFiles files = session.filesFor(file);
    return session.save(files);
  });
}

std::string Render::png() const {
  return guarded([&] {
    const trace::Settings& settings = state_->session.settings();
    return encodePicture(trace::pictureFormatFor("picture.png"), state_->shown(), settings.rounding,
                         state_->session.metadata());
  });
}

Explanation Render::explain(int x, int y, int sample) const {
  return guarded([&] {
    const trace::Session& session = state_->session;
    const trace::Settings& settings = session.settings();
    if (hasTrait(settings, trace::Trait::byChains))
      throw Error(
          Error::Kind::usage,
          "explain: chains make this picture, in no order of pixels: expected another integrator than " +
              std::string(rowOf(settings).name),
          "{\"integrator\", \"path\"} has the same mean");
    const trace::Region& r = settings.region;
    if (!r.whole() && !(r.x0 <= x && x < r.x1 && r.y0 <= y && y < r.y1))
      throw Error(Error::Kind::usage, "explain: the pixel lies outside of the region that was rendered");
    // A render that was stopped may have a part of the pixel's samples, the first ones: they are explained.
    int taken = 0, asked = 0;
    if (!finished()) {
      const trace::Picture counts = session.film().sampleCounts();
      if (0 <= x && x < counts.width && 0 <= y && y < counts.height)
        taken = static_cast<int>(counts.at(x, y).r);
      if (taken == 0 || session.film().corners())
        throw Error(Error::Kind::usage, "explain: the render was stopped before this pixel was finished");
      if (sample >= taken)
        throw Error(Error::Kind::usage, "explain: the render was stopped after " + std::to_string(taken) +
                                            " samples of this pixel, found sample " + std::to_string(sample));
    }
    const auto isEnough = [&] { return !finished() && asked++ >= taken; };
    const trace::Explanation found = session.explain(x, y, sample, isEnough);
    const trace::Size size = session.size();
    const trace::Scene& scene = session.sceneOf(found.tree);
    const std::vector<trace::ExplainedRay> rays = explainedRays(found.tree, scene);
    const trace::PixelFacts facts{.scene = scene,
                                  .explanation = found,
                                  .rays = rays,
                                  .width = size.width,
                                  .height = size.height,
                                  .rendered = session.film().ofSamples(x, y),
                                  .settings = settings};
    Explanation explanation;
    explanation.text_ = explainText(facts, false);
    explanation.json_ = explainJson(facts);
    explanation.pixel_ = {found.pixel.r, found.pixel.g, found.pixel.b};
    explanation.agrees_ = facts.agrees();
    return explanation;
  });
}

Render Scene::render(const Options& options, const OnProgress& progress) const {
  std::exception_ptr thrown;  // by `progress`: it is the caller's own
  Render render = guarded([&] {
    const trace::ReadScope scope = state_->readScope();
    auto state = std::make_unique<RenderState>();
    Opened of = opened(*state_, choicesOf(options));
    state->ofScene = state_->allWarnings();
    trace::Session& session = state->session;
    session.open(std::move(of.scene), of.settings, std::move(of.sceneAt));
    if (!progress) {
      session.build();
      state->result = session.renderPicture();
    } else {
      std::atomic<bool> isStopped{false}, isEarly{true};  // later a stop keeps what is traced
      trace::Budget budget([&] {
        if (isStopped && isEarly) throw StoppedEarly{};
      });
      try {
        thrown = runWatched(
            budget,
            [&] {
              budget.limitTime(of.settings.timeLimit);
              session.build();
              isEarly = false;
              state->result = session.renderPicture();
            },
            progress, [&] { return session.job().fraction(); },
            [&] {
              isStopped = true;
              session.job().cancel = true;
            });
      } catch (const StoppedEarly&) {
        throw Error(Error::Kind::limit, "the render was stopped before its first ray");
      }
    }
    state->seconds = secondsOf(session);
    return Render(std::move(state));
  });
  if (thrown) std::rethrow_exception(thrown);
  return render;
}

Explanation Scene::explain(int x, int y, const Options& options, int sample) const {
  Options one = options;
  if (x < 0 || y < 0)
    throw Error(Error::Kind::usage, "explain: expected a pixel from (0, 0) at the top left on");
  one.push_back({"region", Value::List{x, y, x + 1, y + 1}});
  return render(one).explain(x, y, sample);
}

}  // namespace traceray

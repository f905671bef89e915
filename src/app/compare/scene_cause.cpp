// The search for the variant of a scene that makes a picture: see scene_cause.h. Next to the life of a
// picture; it serves `ray diff`.
//
// Each variant is traced at few pixels, which lie evenly and symmetrically, so that they form small pictures
// that can be turned. What needs the whole picture, such as a stretched tone, is rendered whole.
#include "app/compare/scene_cause.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <utility>

#include "app/compare/scene_variants.h"
#include "app/session/denoising.h"
#include "app/session/session.h"
#include "base/budget.h"
#include "base/parallel.h"
#include "image/development/development.h"
#include "render/integrators/make_integrator.h"
#include "render/picture/passes.h"
#include "render/samples/pixel.h"

namespace trace {
namespace {

constexpr int kMostAcross = 96, kFewestAcross = 24;  // traced pixels on the longer side
constexpr double kMostRays = 30000;                  // camera rays of a variant
constexpr double kHalfHelps = 0.75;           // the share of the difference that a half of a pair may leave
constexpr std::size_t kMostVariantParts = 5;  // two variants, and the changes of a picture
constexpr std::size_t kOtherPixels = 6;       // that confirm what the worst pixel says

/// So many places from 0 to pixels - 1, evenly and symmetrically.
std::vector<int> evenPlaces(int pixels, int wanted) {
  int count = std::clamp(wanted, 1, pixels);
  if (count % 2 == 1 && pixels % 2 == 0 && count > 1) --count;
  std::vector<int> places(static_cast<std::size_t>(count));
  for (int i = 0; i < (count + 1) / 2; ++i) {
    const int place = static_cast<int>((i + 0.5) * pixels / count);
    places[static_cast<std::size_t>(i)] = place;
    places[static_cast<std::size_t>(count - 1 - i)] = pixels - 1 - place;
  }
  return places;
}

/// The pixels that are traced.
struct PixelLattice {
  std::vector<int> columns, rows;

  PixelLattice(const Size& size, int samples) {
    const int longest = std::max(size.width, size.height);
    const double across =
        std::clamp(std::sqrt(kMostRays / samples), double{kFewestAcross}, double{kMostAcross});
    const auto along = [&](int side) {
      return evenPlaces(side, std::max(kFewestAcross, static_cast<int>(across * side / longest)));
    };
    columns = along(size.width);
    rows = along(size.height);
  }

  int width() const { return static_cast<int>(columns.size()); }
  int height() const { return static_cast<int>(rows.size()); }
  PixelPlace place(int x, int y) const {
    return {columns[static_cast<std::size_t>(x)], rows[static_cast<std::size_t>(y)]};
  }
  /// Those pixels of a picture; of one of the exchanged size, those that are theirs when it is turned.
  Picture of(const Picture& whole, bool exchanged = false) const {
    const std::vector<int>&xs = exchanged ? rows : columns, &ys = exchanged ? columns : rows;
    Picture picture(static_cast<int>(xs.size()), static_cast<int>(ys.size()));
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x)
        picture.at(x, y) = whole.at(xs[static_cast<std::size_t>(x)], ys[static_cast<std::size_t>(y)]);
    return picture;
  }
};

/// A pixel depends on its own samples only, all of which are taken.
bool isOfPixels(const Settings& s) {
  return !subdivides(s) && s.noiseTarget == 0 && !hasTrait(s, Trait::splats) &&
         !hasTrait(s, Trait::byChains) && !hasLightImage(s) && s.tone != Tone::stretch && s.bloom == 0 &&
         !s.denoise && !s.dither && !isAnaglyph(s.stereo);
}

/// The traced pixels of a variant: as light, and as levels of a screen.
struct VariantShot {
  LoadedPicture light, levels;

  const LoadedPicture& as(const LoadedPicture& other) const { return other.levels ? levels : light; }
};

LoadedPicture levelsOf(const Picture& light, const Settings& settings) {
  return {fromBytes(toBytes(developed(light, developmentOf(settings)), settings.rounding)), true};
}

/// A scene with variants, and what it shows.
struct TriedVariants {
  std::vector<std::string> names;
  VariantShot shot;
};

/// A scene to which variants are added.
struct SceneStart {
  Scene scene;
  Settings settings;
  TriedVariants tried;
};

struct VariantFit {
  const TriedVariants* tried = nullptr;
  ChangeFit fit;
  std::size_t parts = 0;

  bool explains() const {
    return tried && (parts == 0 ? fit.contrast > 0 && !fit.isWorthACause() : fit.explains());
  }
};

class VariantSearch {
 public:
  VariantSearch(const SceneQuestion& question, const LoadedPicture& reference, const LoadedPicture& test)
      : limit_(budgetOfThread.budget), reference_(reference), test_(test) {
    limit_.limitTime(question.seconds);
    Budget own(&limit_);  // the session sets it to the scene's own time limit
    const BudgetScope scope(&own);
    std::vector<Choice> choices = question.choices;
    const Picture& picture = reference.picture;
    for (const auto& [name, value] : {std::pair{"width", std::to_string(picture.width)},
                                      {"height", std::to_string(picture.height)},
                                      {"region", "0,0,0,0"},
                                      {"passes", "none"},
                                      {"shutter", "0"}})
      choices.push_back({name, value, {}});
    session_.open(question.file, choices, question.strict);
    session_.build();
    const Size size = finished(session_.size(), session_.settings());
    if (size.width != picture.width || size.height != picture.height)
      throw Error(Fault::usage,
                  "--scene: expected pictures of one eye each, found --stereo " +
                      findOption("stereo").get(session_.settings()),
                  "pictures of both eyes in one are not compared with scenes");
    result_.file = question.file;
    result_.inputs = session_.scene().inputs;
    result_.warnings = session_.messages().all();
    result_.unit = test.levels ? "levels" : "values";
  }

  std::optional<SceneCauses> run(const PixelPlace& worst) {
    lattice_.emplace(session_.size(), samplesOf(session_.settings()));
    const bool exchanged =
        test_.picture.width != reference_.picture.width || test_.picture.height != reference_.picture.height;
    sampledReference_ = {lattice_->of(reference_.picture), reference_.levels};
    sampledTest_ = {lattice_->of(test_.picture, exchanged), test_.levels};
    if (!areComparable(sampledReference_, sampledTest_)) return {};
    result_.pixels = sampledReference_.picture.pixels.size();
    SceneStart start{session_.scene(), session_.settings(), {}};
    start.tried.shot = shot(start.scene, start.settings);
    tried_.push_back(start.tried);
    VariantFit ofTest;
    try {
      addVariants(start);
      const VariantFit ofReference = best(sampledReference_, {});
      if (ofReference.explains()) result_.reference = matchOf(ofReference, sampledReference_);
      ofTest = best(sampledTest_, {});
      const bool isPlain = ofTest.explains() && ofTest.parts == 0;
      if (ofReference.explains() && ofReference.fit.change.parts() == 0 && ofReference.parts > 0 &&
          !isPlain) {
        start = startOf(*ofReference.tried);
        addVariants(start);
        if (const VariantFit other = best(sampledTest_, start.tried.names);
            other.explains() || !ofTest.explains())
          ofTest = other;
      }
      if (!ofTest.explains() || (ofTest.parts > 0 && ofTest.fit.isWorthACause()))
        if (const TriedVariants* half = helpful(start)) {
          addVariants(startOf(*half));
          ofTest = best(sampledTest_, start.tried.names);
        }
    } catch (const Error& error) {
      if (error.fault() != Fault::limit) throw;
      result_.stopped = error.messages().front().what;
      const BudgetScope late(nullptr);
      ofTest = best(sampledTest_, start.tried.names);
    }
    const BudgetScope late(result_.stopped.empty() ? budgetOfThread.budget : nullptr);
    if (!exchanged) result_.rmse = rmseAfter({}, start.tried.shot.as(test_), sampledTest_);
    if (ofTest.explains())
      result_.test = matchOf(ofTest, sampledTest_);
    else if (const TriedVariants* nearest = helpful(start))
      result_.nearest = SceneMatch{nearest->names, {}, rmseAfter({}, nearest->shot.as(test_), sampledTest_)};
    const bool isTurned = exchanged || (ofTest.explains() && ofTest.fit.change.parts() > 0);
    if (!isTurned && !(ofTest.explains() && ofTest.parts == 0) && result_.stopped.empty())
      explainPixel(start, worst);
    return std::move(result_);
  }

 private:
  /// Calls use(moments) for the scene, built.
  template <class Use>
  auto withMoments(const Scene& scene, const Settings& settings, const Use& use) const {
    const BudgetScope scope(&limit_);
    Messages known;
    const Compiled earlier{session_.scene(), session_.settings(), session_.world()};
    const World world = compile(scene, settings, known, &earlier);
    Job job;
    const std::unique_ptr<const Integrator> integrator = makeIntegrator(world, settings, job);
    return use(std::array{Moment{&world, integrator.get()}});
  }

  VariantShot shot(const Scene& scene, const Settings& settings) const {
    return withMoments(scene, settings, [&](const auto& moments) -> VariantShot {
      if (isOfPixels(settings)) {
        Picture light = tracedPixels(moments, settings);
        LoadedPicture levels = levelsOf(light, settings);
        return {{std::move(light), false}, std::move(levels)};
      }
      Job job;
      Film film = makeFilm(settings, session_.size().width, session_.size().height);
      const RenderResult rendered = render(moments, settings, film, job);
      if (rendered.end != End::finished) {
        lookAtBudget();
        throw Error(Fault::limit, "a variant was not rendered to its end: " + rendered.failure);
      }
      const Picture light = finished(pictureOfFilm(film, settings), settings);
      return {{lattice_->of(light), false}, {lattice_->of(levelsOf(light, settings).picture), true}};
    });
  }

  Picture tracedPixels(std::span<const Moment> moments, const Settings& settings) const {
    Picture picture(lattice_->width(), lattice_->height());
    Job job;
    parallelChunks(picture.height, settings.threads, job, [&](std::int64_t row, int) {
      const int y = static_cast<int>(row);
      PixelTracer tracer(moments, settings, session_.size());
      for (int x = 0; x < picture.width; ++x) {
        const PixelPlace place = lattice_->place(x, y);
        PixelSum sum;
        addWave(tracer, place.x, place.y, {0, tracer.samples()}, sum, [](const Color&, Real) {});
        picture.at(x, y) = sum.mean();
      }
    });
    return picture;
  }

  /// Traces the start with each of its variants. One that changes nothing that is seen is none; one that
  /// cannot be built neither.
  void addVariants(const SceneStart& start) {
    const std::vector<SceneVariant> variants = variantsOf(start.scene, start.settings);
    result_.variants += variants.size();
    Work work("trying variants of the scene", static_cast<std::int64_t>(variants.size()));
    for (std::size_t i = 0; i < variants.size(); ++i) {
      work.reached(static_cast<std::int64_t>(i));
      Scene scene = start.scene;
      Settings settings = start.settings;
      variants[i].apply(scene, settings);
      try {
        TriedVariants tried{start.tried.names, shot(scene, settings)};
        tried.names.push_back(variants[i].text);
        if (!(tried.shot.light.picture == start.tried.shot.light.picture) ||
            !(tried.shot.levels.picture == start.tried.shot.levels.picture))
          tried_.push_back(std::move(tried));
      } catch (const Error&) {
        const BudgetScope scope(&limit_);
        lookAtBudget();
      }
      ++result_.tried;
    }
  }

  /// The scene with those variants.
  SceneStart startOf(const TriedVariants& tried) const {
    SceneStart start{session_.scene(), session_.settings(), tried};
    for (const std::string& name : tried.names)
      for (const SceneVariant& variant : variantsOf(start.scene, start.settings))
        if (variant.text == name) {
          variant.apply(start.scene, start.settings);
          break;
        }
    return start;
  }

  static bool startsWith(const TriedVariants& tried, const std::vector<std::string>& names) {
    return tried.names.size() >= names.size() && std::equal(names.begin(), names.end(), tried.names.begin());
  }

  /// The decisive match with the fewest parts, among all that was traced upon those variants.
  VariantFit best(const LoadedPicture& picture, const std::vector<std::string>& upon) const {
    std::array<VariantFit, kMostVariantParts + 1> found;
    for (const TriedVariants& tried : tried_) {
      if (!startsWith(tried, upon)) continue;
      for (const ChangeFit& fit : bestChanges(tried.shot.as(picture), picture)) {
        const std::size_t parts =
            tried.names.size() - upon.size() + static_cast<std::size_t>(fit.change.parts());
        if (parts <= kMostVariantParts && fit.left < found[parts].fit.left - 1e-9 * fit.contrast)
          found[parts] = {&tried, fit, parts};
      }
    }
    VariantFit chosen = found[0];
    for (const VariantFit& other : found)
      if (other.tried && other.fit.replaces(chosen.fit)) chosen = other;
    return chosen;
  }

  /// The variant upon the start that leaves least of the test, if it leaves clearly less; null if none does.
  const TriedVariants* helpful(const SceneStart& start) const {
    const auto left = [&](const TriedVariants& tried) {
      return bestChanges(tried.shot.as(test_), sampledTest_)[0].left;
    };
    const TriedVariants* nearest = nullptr;
    double least = kHalfHelps * left(start.tried);
    for (const TriedVariants& tried : tried_) {
      if (!startsWith(tried, start.tried.names) || tried.names.size() == start.tried.names.size()) continue;
      if (const double own = left(tried); own < least) {
        least = own;
        nearest = &tried;
      }
    }
    return nearest;
  }

  static SceneMatch matchOf(const VariantFit& found, const LoadedPicture& picture) {
    return {found.tried->names, found.fit.change,
            rmseAfter(found.fit.change, found.tried->shot.as(picture), picture)};
  }

  void explainPixel(const SceneStart& start, const PixelPlace& worst) {
    try {
      result_.pixel = withMoments(start.scene, start.settings, [&](const auto& moments) {
        return pixelCause({start.scene, start.settings, moments, session_.size()}, test_,
                          differing(start.tried.shot, worst));
      });
    } catch (const Error& error) {
      if (error.fault() != Fault::limit) throw;
      result_.stopped = error.messages().front().what;
    }
  }

  /// The pixel, and some of those that differ at least half as much as any, from all parts of the picture.
  std::vector<PixelPlace> differing(const VariantShot& shot, const PixelPlace& worst) const {
    const Picture &a = shot.as(test_).picture, &b = sampledTest_.picture;
    const auto difference = [&](int x, int y) {
      const Color d = a.at(x, y) + b.at(x, y) * -1;
      const double most = std::max({std::abs(d.r), std::abs(d.g), std::abs(d.b)});
      return std::isfinite(most) ? most : 0;
    };
    double most = 0;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x) most = std::max(most, difference(x, y));
    std::vector<PixelPlace> large;
    for (int y = 0; y < a.height; ++y)
      for (int x = 0; x < a.width; ++x)
        if (most > 0 && difference(x, y) >= most / 2) large.push_back(lattice_->place(x, y));
    std::vector<PixelPlace> places{worst};
    const std::size_t count = std::min(kOtherPixels, large.size());
    for (std::size_t i = 0; i < count; ++i) places.push_back(large[(2 * i + 1) * large.size() / (2 * count)]);
    return places;
  }

  mutable Budget limit_;
  const LoadedPicture &reference_, &test_;
  Session session_;
  std::optional<PixelLattice> lattice_;
  LoadedPicture sampledReference_, sampledTest_;
  std::deque<TriedVariants> tried_;  // whose elements stay where they are
  SceneCauses result_;
};

}  // namespace

std::optional<SceneCauses> sceneCauses(const SceneQuestion& question, const LoadedPicture& reference,
                                       const LoadedPicture& test, const PixelPlace& worst) {
  if (!areComparable(reference, test)) return {};
  return VariantSearch(question, reference, test).run(worst);
}

}  // namespace trace

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

#include "app/compare/scene_values.h"
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
constexpr double kHalfHelps = 0.75;   // the share of the difference that a half of a pair may leave
constexpr double kMatchLeaves = 0.5;  // the share of the pixels' difference that a match may leave
constexpr double kExact = 0.1;        // the share that a variant may leave where it is not sought further
constexpr double kSeenLevels = 1;     // a difference in levels that an eye may see
constexpr std::size_t kMostVariantParts = 5;  // two variants, and the changes of a picture
constexpr std::size_t kMostAlike = 3;         // other variants of the same picture that are named
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

/// A scene with variants, each upon those before, and what it shows.
struct TriedVariants {
  std::vector<SceneVariant> variants;
  VariantShot shot;
  /// bestChanges() to the reference and to the test, once they are known.
  mutable std::optional<std::array<ChangeFit, 4>> toReference{}, toTest{};

  std::vector<std::string> names() const {
    std::vector<std::string> texts;
    for (const SceneVariant& variant : variants) texts.push_back(variant.text);
    return texts;
  }
  /// These variants begin with those of the other.
  bool isUpon(const TriedVariants& other) const {
    return variants.size() >= other.variants.size() &&
           std::equal(other.variants.begin(), other.variants.end(), variants.begin(),
                      [](const auto& a, const auto& b) { return a.text == b.text; });
  }
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
    exchanged_ =
        test_.picture.width != reference_.picture.width || test_.picture.height != reference_.picture.height;
    sampledReference_ = {lattice_->of(reference_.picture), reference_.levels};
    sampledTest_ = {lattice_->of(test_.picture, exchanged_), test_.levels};
    if (!areComparable(sampledReference_, sampledTest_)) return {};
    result_.pixels = sampledReference_.picture.pixels.size();
    start_ = {session_.scene(), session_.settings(), {}};
    try {
      search();
    } catch (const Error& error) {
      if (error.fault() != Fault::limit) throw;
      result_.stopped = error.messages().front().what;
    }
    if (tried_.empty()) return std::move(result_);
    const BudgetScope late(result_.stopped.empty() ? budgetOfThread.budget : nullptr);
    report();
    if (mayHavePixel() && result_.stopped.empty()) explainPixel(worst);
    if (result_.test && result_.pixel && result_.pixel->text.empty()) result_.pixel.reset();
    return std::move(result_);
  }

 private:
  /// Traces variants until one makes the test.
  void search() {
    start_.tried.shot = shot(start_.scene, start_.settings);
    tried_.push_back(start_.tried);
    addVariants(start_);
    result_.reference = referenceMatch();
    if (!result_.reference) return addUponHelpful();
    if (isSolved()) return;
    if (result_.reference->change.parts() == 0 && !result_.reference->variants.empty()) {
      start_ = startOf(*best(sampledReference_).tried);
      addVariants(start_);
    }
    if (!isSolved()) addValues();
    if (!isSolved()) addUponHelpful();
  }

  /// The best variant makes the test so well that no other is sought.
  bool isSolved() const {
    const VariantFit found = best(sampledTest_);
    if (!found.explains()) return false;
    const double left = rmseAfter(found.fit.change, found.tried->shot.as(test_), sampledTest_);
    return left <= kExact * differenceFromStart() || (found.parts == 0 && left <= seen());
  }

  /// Tries the variants upon the one that helps most, if one does.
  void addUponHelpful() {
    if (const TriedVariants* half = helpful()) addVariants(startOf(*half));
  }

  void report() {
    if (!result_.reference) result_.reference = referenceMatch();
    result_.rmse = differenceFromStart();
    const VariantFit ofTest = best(sampledTest_);
    if (ofTest.explains()) {
      result_.test = matchOf(ofTest, sampledTest_);
      result_.test->alike = alike(*ofTest.tried);
      if (ofTest.parts > 0 && result_.test->rmse > kMatchLeaves * result_.rmse) result_.test.reset();
    }
    if (!result_.test) result_.nearest = nearest();
  }

  /// The RMSE of the test and the scene as it makes the reference; infinite if the sizes are exchanged.
  double differenceFromStart() const { return rmseAfter({}, start_.tried.shot.as(test_), sampledTest_); }
  /// The smallest RMSE that an eye may see.
  double seen() const { return test_.levels ? kSeenLevels : kSeenLevels / 255; }

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

  /// Traces the start with each of its variants.
  void addVariants(const SceneStart& start) {
    const std::vector<SceneVariant> variants = variantsOf(start.scene, start.settings);
    result_.variants += variants.size();
    Work work("trying variants of the scene", static_cast<std::int64_t>(variants.size()));
    for (std::size_t i = 0; i < variants.size(); ++i) {
      work.reached(static_cast<std::int64_t>(i));
      addVariant(start, variants[i]);
    }
  }

  /// Traces the start with the variant. One that changes nothing that is seen is none; one that cannot be
  /// built neither.
  void addVariant(const SceneStart& start, const SceneVariant& variant) {
    SceneStart with{start.scene, start.settings, {start.tried.variants, {}, {}, {}}};
    variant.apply(with.scene, with.settings);
    with.tried.variants.push_back(variant);
    try {
      with.tried.shot = shot(with.scene, with.settings);
      if (!(with.tried.shot.light.picture == start.tried.shot.light.picture) ||
          !(with.tried.shot.levels.picture == start.tried.shot.levels.picture))
        tried_.push_back(std::move(with.tried));
    } catch (const Error&) {
      const BudgetScope scope(&limit_);
      lookAtBudget();
    }
    ++result_.tried;
  }

  /// Looks for other values of the scene that make the test.
  void addValues() {
    if (exchanged_ || !isOfPixels(start_.settings)) return;
    const std::vector<SceneValue> values = valuesOf(start_.scene);
    const ValueSearch task{
        start_.scene, start_.tried.shot.light.picture, sampledTest_,
        [&](const Scene& scene) { return shot(scene, start_.settings).light.picture; },
        [&](const Picture& light) {
          return test_.levels ? levelsOf(light, start_.settings) : LoadedPicture{light, false};
        }};
    result_.variants += values.size();
    Work work("trying values of the scene", static_cast<std::int64_t>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) {
      work.reached(static_cast<std::int64_t>(i));
      try {
        if (const auto variant = fittedVariant(values[i], task)) {
          addVariant(start_, *variant);
          continue;
        }
      } catch (const Error&) {  // the scene cannot be built
        const BudgetScope scope(&limit_);
        lookAtBudget();
      }
      ++result_.tried;
    }
  }

  /// The scene with those variants.
  SceneStart startOf(const TriedVariants& tried) const {
    SceneStart start{session_.scene(), session_.settings(), tried};
    for (const SceneVariant& variant : tried.variants) variant.apply(start.scene, start.settings);
    return start;
  }

  /// The decisive match with the fewest parts, among all that was traced upon the start.
  VariantFit best(const LoadedPicture& picture) const {
    std::array<VariantFit, kMostVariantParts + 1> found;
    for (const TriedVariants& tried : tried_) {
      if (!tried.isUpon(start_.tried)) continue;
      for (const ChangeFit& fit : changesOf(tried, picture)) {
        const std::size_t parts = extraVariants(tried) + static_cast<std::size_t>(fit.change.parts());
        if (parts <= kMostVariantParts && fit.left < found[parts].fit.left - 1e-9 * fit.contrast)
          found[parts] = {&tried, fit, parts};
      }
    }
    VariantFit chosen = found[0];
    for (const VariantFit& other : found)
      if (other.tried && other.fit.replaces(chosen.fit)) chosen = other;
    return exactOr(chosen, picture);
  }

  /// The changes that make one of the two pictures of what was tried.
  const std::array<ChangeFit, 4>& changesOf(const TriedVariants& tried, const LoadedPicture& picture) const {
    auto& known = &picture == &sampledTest_ ? tried.toTest : tried.toReference;
    if (!known) known = bestChanges(tried.shot.as(picture), picture);
    return *known;
  }

  std::size_t extraVariants(const TriedVariants& tried) const {
    return tried.variants.size() - start_.tried.variants.size();
  }

  /// Instead of what was chosen by blocks, the variant that leaves nearly nothing of the pixels: what differs
  /// in few of them hardly changes blocks.
  VariantFit exactOr(VariantFit chosen, const LoadedPicture& picture) const {
    if (!chosen.tried) return chosen;
    double least = kExact * rmseAfter(chosen.fit.change, chosen.tried->shot.as(picture), picture);
    for (const TriedVariants& tried : tried_) {
      if (least == 0) break;
      if (!tried.isUpon(start_.tried) || extraVariants(tried) != 1) continue;
      const LoadedPicture& own = tried.shot.as(picture);
      if (const double left = rmseAfter({}, own, picture); left < least) {
        least = left;
        chosen = {&tried, changesOf(tried, picture)[0], 1};
      }
    }
    return chosen;
  }

  /// The match of the reference; nothing if nothing that was tried makes it.
  std::optional<SceneMatch> referenceMatch() const {
    const VariantFit found = best(sampledReference_);
    if (!found.explains()) return {};
    return matchOf(found, sampledReference_);
  }

  /// The variants that give the picture of this one. Options count only where this is none: conventions
  /// contain each other.
  std::vector<std::string> alike(const TriedVariants& chosen) const {
    std::vector<std::string> texts;
    if (chosen.variants.empty() || chosen.variants.back().isOption) return texts;
    for (const TriedVariants& tried : tried_) {
      const bool isOther =
          &tried != &chosen && tried.variants.size() == chosen.variants.size() &&
          std::equal(tried.variants.begin(), tried.variants.end() - 1, chosen.variants.begin(),
                     [](const auto& a, const auto& b) { return a.text == b.text; });
      if (isOther && texts.size() < kMostAlike &&
          tried.shot.as(test_).picture == chosen.shot.as(test_).picture)
        texts.push_back(tried.variants.back().text);
    }
    return texts;
  }

  /// The variant, or two, whose pixels are nearest to the test, if they leave clearly less than the start.
  std::optional<SceneMatch> nearest() const {
    const TriedVariants* found = nullptr;
    double least = kMostLeftOfNearest * result_.rmse;
    for (std::size_t count = 1; count <= 2; ++count) {
      for (const TriedVariants& tried : tried_) {
        if (!tried.isUpon(start_.tried) || extraVariants(tried) != count) continue;
        if (const double left = rmseAfter({}, tried.shot.as(test_), sampledTest_); left < least) {
          least = left;
          found = &tried;
        }
      }
      least *= kMostLeftOfNearest;  // a second one must help as much
    }
    if (!found) return {};
    return SceneMatch{found->names(), {}, rmseAfter({}, found->shot.as(test_), sampledTest_)};
  }

  /// The pixels of the test are where the scene has them, and something of them is not explained.
  bool mayHavePixel() const {
    if (exchanged_) return false;
    if (!result_.test) return true;
    const PictureChange& change = result_.test->change;
    if (change.parts() == 0) return !result_.test->variants.empty() || result_.test->rmse > 0;
    return change.parts() == 1 && change.curve != PictureChange::Curve::none && result_.test->rmse > seen();
  }

  /// The variant upon the start that leaves least of the test, if it leaves clearly less; null if none does.
  const TriedVariants* helpful() const {
    const auto left = [&](const TriedVariants& tried) { return changesOf(tried, sampledTest_)[0].left; };
    const TriedVariants* nearest = nullptr;
    double least = kHalfHelps * left(start_.tried);
    for (const TriedVariants& tried : tried_) {
      if (!tried.isUpon(start_.tried) || extraVariants(tried) == 0) continue;
      if (const double own = left(tried); own < least) {
        least = own;
        nearest = &tried;
      }
    }
    return nearest;
  }

  static SceneMatch matchOf(const VariantFit& found, const LoadedPicture& picture) {
    const LoadedPicture& own = found.tried->shot.as(picture);
    const PictureChange change = withSharpestCurve(found.fit.change, own, picture);
    return {found.tried->names(), change, rmseAfter(change, own, picture)};
  }

  void explainPixel(const PixelPlace& worst) {
    try {
      result_.pixel = withMoments(start_.scene, start_.settings, [&](const auto& moments) {
        return pixelCause({start_.scene, start_.settings, moments, session_.size()}, test_,
                          differing(start_.tried.shot, worst));
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
  bool exchanged_ = false;           // width and height of the test
  SceneStart start_;                 // makes the reference, as far as is known
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

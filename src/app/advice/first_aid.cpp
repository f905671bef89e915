#include "app/advice/first_aid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "app/advice/auto_exposure.h"
#include "app/advice/darkness.h"
#include "app/advice/missing_caustic.h"
#include "image/development/development.h"
#include "image/srgb.h"
#include "math/elementary.h"
#include "render/samples/sampler.h"
#include "scene/integrators.h"

namespace trace {
namespace {

constexpr double kLargePart = 0.25;  // fraction of the picture
constexpr double kBeyond = 0.5;      // stops: white that is white on purpose is no brighter than this
constexpr double kOneLevel = 1.0 / 255, kWhite = 254.0 / 255;
// Levels of 255: as good as none, what is seen at a glance, and what denoising blurs.
constexpr double kQuiet = 0.25, kNoisy = 4, kRemoved = 10;

/// The fraction of the picture that a file shows as white in all channels. Without a tone curve white paper
/// is as white as that on purpose.
double whitePart(const Picture& cells, Development development) {
  if (development.tone == Tone::clamp) development.exposure -= kBeyond;
  const auto white = std::count_if(cells.pixels.begin(), cells.pixels.end(), [&](const Color& c) {
    const Color shown = developed(c, development);
    return shown.r >= kWhite && shown.g >= kWhite && shown.b >= kWhite;
  });
  return static_cast<double>(white) / static_cast<double>(cells.pixels.size());
}

std::optional<Message> clipped(const Scene& scene, const Settings& settings, const Picture& cells,
                               std::optional<Real> measured) {
  constexpr Real kHelps = 0.3;  // stops
  if (settings.tone == Tone::stretch) return {};
  Development development = developmentOf(settings);
  const double white = whitePart(cells, development);
  if (white < kLargePart) return {};
  development.exposure = 0;
  const Real stops = std::round(10 * (exposureFor(cells, development) - measured.value_or(0))) / 10 + 0.0;
  if (stops > settings.exposure - measured.value_or(0) - kHelps) return {};  // the light itself is seen
  char what[100], cure[100];
  std::snprintf(what, sizeof what, "%.0f %% of the picture is brighter than white and shows as white",
                100 * white);
  std::snprintf(cure, sizeof cure, "--exposure %g shows what is there", stops);
  return Message{Message::Severity::warning, {.file = scene.file}, what, cure};
}

/// A warning where no object is in the picture.
std::optional<Message> ofNothing(const Scene& scene, const World& world, const Film& film) {
  if (seesObjects(world, {film.width(), film.height()})) return {};
  const std::string where = whereToLook(scene);
  return Message{Message::Severity::warning,
                 {.file = scene.file},
                 "no object is in the picture",
                 where.empty() ? "`ray explain --pixel X,Y` says what a pixel shows" : where};
}

std::optional<Message> ofOneColor(const Scene& scene, const Settings& settings, const Picture& cells) {
  const Development development = developmentOf(settings);
  const Color first = developed(cells.pixels.front(), development);
  for (const Color& c : cells.pixels) {
    const Color shown = developed(c, development);
    if (!(std::abs(shown.r - first.r) < kOneLevel && std::abs(shown.g - first.g) < kOneLevel &&
          std::abs(shown.b - first.b) < kOneLevel))
      return {};
  }
  return Message{Message::Severity::warning,
                 {.file = scene.file},
                 "the whole picture has one colour",
                 "`ray explain --pixel X,Y` says what a pixel shows"};
}

/// The share of pixels that are noisier than the target, and the samples with which nine of ten reach it; ""
/// if as many have reached it.
std::string missedTargetText(const Settings& settings, const Film& film) {
  constexpr double kMost = 65536;  // samples of a pixel
  const Picture errors = film.errors(), counts = film.sampleCounts();
  std::vector<double> needed;  // samples
  std::size_t missed = 0;
  for (std::size_t i = 0; i < counts.pixels.size(); ++i) {
    const double taken = counts.pixels[i].r, excess = errors.pixels[i].r / film.noiseTarget();
    if (taken == 0) continue;
    needed.push_back(taken * excess * excess);
    missed += excess > 1;
  }
  if (10 * missed <= needed.size()) return "";
  const auto ninth = needed.begin() + 9 * std::ssize(needed) / 10;  // edges are the rest, and no noise
  std::nth_element(needed.begin(), ninth, needed.end());
  constexpr double kSure = 1.25;  // the errors are estimates themselves
  const double samples = math::exp2(std::ceil(math::log2(kSure * *ninth)));
  char text[200], cure[60] = "";
  if (samples <= kMost) std::snprintf(cure, sizeof cure, "; --spp %.0f brings nine of ten there", samples);
  std::snprintf(text, sizeof text, "; noisy: %s%.0f %% of the pixels miss the noise target of %.2g levels%s",
                settings.denoise ? "before denoising, " : "",
                100.0 * static_cast<double>(missed) / static_cast<double>(needed.size()),
                255 * film.noiseTarget(), cure);
  return text;
}

}  // namespace

std::optional<Message> firstAid(const Scene& scene, const Settings& settings, const World& world,
                                const Film& film, const RenderFacts& facts) {
  const Picture cells = cellsOf(film);
  if (auto dark = darkness(scene, settings, world, cells, facts)) return dark;
  const bool isPart = !settings.region.whole() || settings.unweighted || settings.lightVertices >= 0 ||
                      settings.cameraVertices >= 0;
  if (isPart || (scene.objects.empty() && scene.uses.empty()) || hasTrait(settings, Trait::showsData))
    return {};
  try {
    if (auto nothing = ofNothing(scene, world, film)) return nothing;
    if (auto white = clipped(scene, settings, cells, facts.measured)) return white;
    return ofOneColor(scene, settings, cells);
  } catch (const Error&) {  // the time is over
    return {};
  }
}

std::optional<PictureError> estimatedError(const Settings& settings, const Film& film) {
  if (film.corners() || film.takesSplats() || hasTrait(settings, Trait::showsData)) return {};
  const Picture errors = film.errors(), counts = film.sampleCounts();
  std::vector<double> levels;
  double sum = 0;
  for (std::size_t i = 0; i < errors.pixels.size(); ++i) {
    if (counts.pixels[i].r < 2) continue;
    levels.push_back(255 * errors.pixels[i].r);
    sum += levels.back();
  }
  if (levels.empty()) return {};
  std::sort(levels.begin(), levels.end());
  return PictureError{sum / static_cast<double>(levels.size()), levels[levels.size() / 2],
                      levels[9 * levels.size() / 10]};
}

std::string noiseText(const Settings& settings, const Film& film) {
  if (!hasTrait(settings, Trait::meetsLamps) || film.corners()) return "";
  if (film.noiseTarget() > 0) return missedTargetText(settings, film);
  if (film.takesSplats()) return "";
  std::vector<double> errors;
  double sum = 0, count = 0;
  for (const Color& error : film.errors().pixels) {
    sum += std::min(error.r, 1.0);
    ++count;
    if (255 * error.r > kQuiet) errors.push_back(error.r);
  }
  if (errors.empty()) return "";
  const auto middle = errors.begin() + std::ssize(errors) / 2;  // edges are few, and no noise
  std::nth_element(errors.begin(), middle, errors.end());
  // Specks are few too, but large: the mean has them.
  const double levels = 255 * std::max(std::min(*middle, 1.0), sum / count);
  if (!(levels >= (settings.denoise ? kRemoved : kNoisy))) return "";
  char text[160];
  std::snprintf(text, sizeof text,
                "; noisy: %sits estimated error is %.0f levels of 255, which --spp %d halves%s",
                settings.denoise ? "before denoising, " : "", levels, 4 * samplesOf(settings),
                settings.denoise ? "" : " and --denoise hides");
  return text;
}

std::string fireflyText(const Settings& settings, const World& world, const Film& film) {
  constexpr double kStandsOut = 64, kUnsure = 24;  // levels of 255: above all neighbours, and of error
  constexpr std::size_t kFew = 4, kOneIn = 20000;
  if (settings.fireflyLimit > 0 || !hasTrait(settings, Trait::meetsLamps)) return "";
  if (film.corners() || film.takesSplats()) return "";
  const Development development = developmentOf(settings);
  const Picture errors = film.errors();
  Picture levels = film.picture();
  for (Color& c : levels.pixels) c = Color(255 * luminanceOf(developed(c, development)));
  const auto standsOut = [&](int x, int y) {
    double around = 0;
    for (int j = -1; j <= 1; ++j)
      for (int i = -1; i <= 1; ++i)
        if (i != 0 || j != 0) around = std::max(around, levels.at(x + i, y + j).r);
    return levels.at(x, y).r > around + kStandsOut && 255 * errors.at(x, y).r > kUnsure;
  };
  std::size_t count = 0;
  for (int y = 1; y + 1 < levels.height; ++y)
    for (int x = 1; x + 1 < levels.width; ++x) count += standsOut(x, y);
  if (count < std::max(kFew, levels.pixels.size() / kOneIn)) return "";
  bool gathers = false;
  for (std::uint32_t i = 0; i < world.objectCount() && !gathers; ++i) gathers = gathersLight(world, i);
  const bool mayBeCaustic = gathers && hasTrait(settings, Trait::bounces);
  return "; " + std::to_string(count) + " fireflies, pixels far brighter than all around them, " +
         (mayBeCaustic ? "of light that glass or mirrors gather: --integrator bdpt finds it"
                       : "which --firefly-limit 8 removes");
}

}  // namespace trace

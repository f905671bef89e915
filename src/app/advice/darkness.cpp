#include "app/advice/darkness.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/budget.h"
#include "base/text.h"
#include "formats/kind_defaults.h"
#include "formats/ray/syntax/remarks.h"
#include "geometry/traced.h"
#include "image/development/development.h"
#include "image/srgb.h"
#include "math/elementary.h"
#include "render/lights/lamps.h"
#include "render/picture/passes.h"
#include "render/picture/render.h"
#include "render/samples/integrator.h"
#include "scene/groups.h"
#include "scene/integrators.h"
#include "scene/options.h"
#include "shading/lights/plain_lights.h"

namespace trace {
namespace {

constexpr int kCellsAcross = 64, kCellsDown = 48;
constexpr double kDarkLevel = 20;    // a level of 255; a pixel below it is dark to the eye
constexpr double kNearlyAll = 0.98;  // fraction of the picture
constexpr double kMostSeen = 0.95;   // fraction of the cells in which there is an object
constexpr double kWanted = 90;       // the mean level of what is seen with the cure

/// The settings of a picture of cells: nothing that only the finished picture needs.
Settings ofCells(Settings settings) {
  const Traits traits = traitsOf(settings);
  settings.width = kCellsAcross;
  settings.height = kCellsDown;
  settings.spp = traits.has(Trait::asksAllLights) ? 1 : 16;  // others are noisy
  settings.subdivide = 0;
  settings.noiseTarget = 0;
  settings.denoise = false;
  settings.passes = {};
  settings.region = {};
  settings.outlines = 0;
  settings.timeLimit = 0;
  settings.photons = std::min(settings.photons, 50000);
  settings.photonPasses = 1;
  settings.caustics = std::min(settings.caustics, 20000);
  if (traits.has(Trait::byChains)) settings.integrator = IntegratorKind::path;
  return settings;
}

/// The level that the eye judges by: the brightest channel, as the file will have it except for what needs
/// the whole picture.
double levelOf(const Color& linear, const Development& development) {
  const Color shown = developed(linear, development);
  const double most = std::max({shown.r, shown.g, shown.b});
  return most > 0 ? 255 * std::min(most, 1.0) : 0;  // NaN is black, too
}

/// Whether each pixel of a picture of that size shows an object in its middle.
std::vector<char> objectsSeen(const World& world, const Size& size = {kCellsAcross, kCellsDown}) {
  std::vector<char> seen;
  Statistics uncounted;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      checkBudget();
      const Ray ray = world.camera().ray({(x + 0.5) / size.width, 1 - (y + 0.5) / size.height});
      const auto found = world.closest(ray, Faces::both, uncounted);
      seen.push_back(found && world.camera().sees(found->t));
    }
  return seen;
}
bool anyOf(const std::vector<char>& seen) {
  return std::any_of(seen.begin(), seen.end(), [](char is) { return is != 0; });
}

/// Light of the cells with an object: what is there anyway, and what a light adds.
struct Lit {
  std::vector<Color> base, added;
};

double meanLevel(const Lit& lit, double factor, const Development& development) {
  double sum = 0;
  for (std::size_t i = 0; i < lit.base.size(); ++i)
    sum += levelOf(lit.base[i] + lit.added[i] * factor, development);
  return lit.base.empty() ? 0 : sum / static_cast<double>(lit.base.size());
}

/// The factor of the added light for which the mean level is the one wanted; nothing if none is.
std::optional<double> factorFor(const Lit& lit, const Development& development) {
  double low = 1e-12, high = 1e30;
  if (meanLevel(lit, high, development) < kWanted) return {};
  for (int i = 0; i < 200; ++i) {
    const double middle = std::sqrt(low * high);
    (meanLevel(lit, middle, development) < kWanted ? low : high) = middle;
  }
  return high;
}

/// The picture of the scene with these lights alone.
std::vector<Color> seenWith(const Scene& scene, const Settings& settings, const World& world,
                            std::vector<LightSource> lights, const std::vector<char>& seen) {
  Scene lit = scene;
  lit.lights = std::move(lights);
  Messages known;
  const Compiled earlier{scene, settings, world};
  const Settings small = ofCells(settings);
  const World changed = compile(lit, settings, known, &earlier);
  Film film = makeFilm(small, kCellsAcross, kCellsDown);
  Job job;
  if (render(changed, small, film, job).end != End::finished) lookAtBudget();
  const Picture picture = film.picture();
  std::vector<Color> colors;
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i]) colors.push_back(picture.pixels[i]);
  return colors;
}

std::string twoDigits(double value) {
  const double unit = math::pow(10.0, std::floor(math::log10(value)) - 1);
  return toText(unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit);
}
std::string rounded(const Color& c) {
  const auto channel = [](double value) { return value > 0 ? twoDigits(value) : "0"; };
  return "(" + channel(c.r) + ", " + channel(c.g) + ", " + channel(c.b) + ")";
}
std::string rounded(const Vec3& v) {
  const auto one = [](Real x) { return toText(std::round(x * 100) / 100 + 0.0); };
  return "(" + one(v.x) + ", " + one(v.y) + ", " + one(v.z) + ")";
}

/// It fades with the square of the distance, as point lights do unless they say otherwise.
bool fades(const Light& light) {
  const Real* quadratic = findValue<Real>(light, "quadratic_attenuation_coeff");
  return quadratic && *quadratic > 0;
}

struct Cure {
  SourcePlace place;
  std::string why, hint;
};

/// The text that gives the light that many times its strength, in the field by which its text says it. In
/// files of the kind `Trace 1` a colour is that of the light where it arrives, so that the scene has another.
std::string strengthText(const RayRemarks& remarks, const LightSource& source, const Color& color,
                         double factor) {
  const auto said = std::find_if(remarks.lights.begin(), remarks.lights.end(), [&](const auto& light) {
    return light.place.file == source.place.file && light.place.line == source.place.line &&
           light.place.column == source.place.column;
  });
  if (!remarks.isOfKind) return "color = " + rounded(color * factor) + "; in this light";
  if (said == remarks.lights.end() || !said->says)
    return twoDigits(factor) + " times its power or color in this light";
  if (said->power > 0)
    return "power = " + twoDigits(said->power * factor) + "; in place of the power of this light";
  return "color = " + rounded(said->color.value_or(Color(1)) * factor) + "; in this light";
}

/// The mean level of the cells with an object at so many stops more.
double meanLevel(const Picture& cells, const std::vector<char>& seen, Development development, Real stops) {
  development.exposure += stops;
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i]) continue;
    sum += levelOf(cells.pixels[i], development);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

/// Another exposure, if it is the cause: the settings' own darkens, or the measured one follows the light, so
/// that no other light would help. Light of a sky or an emissive object is left as it is, too.
std::optional<Cure> otherExposure(const Scene& scene, const Settings& settings, const Picture& cells,
                                  const std::vector<char>& seen, std::optional<Real> measured) {
  constexpr Real kDarkens = -1, kFarthest = 20;
  constexpr double kLeast = 60, kMost = 130;  // mean levels with which a picture needs no other cure
  const Real own = settings.exposure - measured.value_or(0);
  const bool hasLamp = std::any_of(scene.lights.begin(), scene.lights.end(),
                                   [](const LightSource& source) { return source.light.color() != nullptr; });
  if (!measured && hasLamp && own > kDarkens) return {};
  const Development development = developmentOf(settings);
  Real stops = -own;  // as if there were none
  const double plain = meanLevel(cells, seen, development, stops);
  if (own >= 0 || plain < kLeast || plain > kMost) {
    Real low = 0, high = kFarthest;
    if (meanLevel(cells, seen, development, high) < kWanted) return {};
    for (int i = 0; i < 40; ++i)
      (meanLevel(cells, seen, development, (low + high) / 2) < kWanted ? low : high) = (low + high) / 2;
    stops = high;
  }
  const std::string wanted = toText(std::round(10 * (own + stops)) / 10 + 0.0);
  return Cure{SourcePlace{.file = scene.file},
              own <= kDarkens ? "; exposure = " + toText(std::round(100 * own) / 100) + " darkens it"
                              : "; its exposure is too low",
              "--exposure " + wanted + " brings the visible objects to a mean level of about " +
                  toText(std::round(meanLevel(cells, seen, development, stops)))};
}

/// The light of the scene that adds most of what there is, and the strength that it needs.
std::optional<Cure> strongerLight(const Scene& scene, const Settings& settings, const World& world,
                                  const std::vector<char>& seen) {
  constexpr std::size_t kMostTried = 8;
  const Development development = developmentOf(settings);
  const RayRemarks remarks = remarksOn(scene);
  const std::vector<Color> base = seenWith(scene, settings, world, {}, seen);
  std::optional<Cure> best;
  double most = 0;
  std::size_t tried = 0;
  for (const LightSource& source : scene.lights) {
    const Color* color = source.light.color();
    if (!color || isBlack(*color) || ++tried > kMostTried) continue;
    Lit lit{base, seenWith(scene, settings, world, {source}, seen)};
    double sum = 0;
    for (std::size_t i = 0; i < base.size(); ++i) {
      lit.added[i] = lit.added[i] + base[i] * -1;
      if (isFinite(lit.added[i])) sum += luminanceOf(lit.added[i]);
    }
    const auto factor = factorFor(lit, development);
    if (!factor || sum <= most) continue;
    most = sum;
    best = Cure{source.place,
                fades(source.light) && !remarks.isOfKind
                    ? "; this light fades with the square of the distance (quadratic_attenuation_coeff = 1)"
                    : "; this light is too weak",
                strengthText(remarks, source, *color, *factor) +
                    " brings the visible objects to a mean level of about 90"};
  }
  return best;
}

/// The eye is in an opaque solid, and sees the inside of it.
std::optional<Cure> outOfSolid(const Scene& scene, const World& world) {
  Statistics uncounted;
  const Ray ray = world.camera().ray({0.5, 0.5});
  const auto found = world.closest(ray, Faces::both, uncounted);
  if (!found || found->object >= scene.objects.size() || !world.solid(found->object) ||
      !world.opaque(found->object) || !Hit(world, ray, *found).leaving)
    return {};
  const Object& object = scene.objects[found->object];
  return Cure{
      object.place,
      "; the camera is inside this " + std::string(object.shape.keyword()) + ", and no light shines in there",
      "move the camera's position out of it, or put a light into it"};
}

/// A parallel light that shines the other way from what is seen.
std::optional<Cure> turnedSun(const Scene& scene, const Settings& settings, const World& world,
                              const std::vector<char>& seen) {
  for (const LightSource& source : scene.lights) {
    const Color* color = source.light.color();
    if (source.light.type().starts != LightOrigin::parallel || !color || isBlack(*color)) continue;
    LightSource turned = source;
    Vec3* direction = editableValue<Vec3>(turned.light, "direction");
    if (!direction) continue;
    if (direction->y > 0)
      direction->y = -direction->y;
    else
      *direction = -*direction;
    const std::string text = rounded(*direction);
    const std::vector<Color> lit = seenWith(scene, settings, world, {turned}, seen);
    if (std::all_of(lit.begin(), lit.end(), [](const Color& c) { return isBlack(c); })) continue;
    return Cure{source.place, "; this light shines away from the visible objects",
                "direction = " + text + "; turns it to them"};
  }
  return {};
}

/// A light beside the eye, where nothing that is seen is in its way. Automatic exposure follows it.
std::optional<Cure> lightAtTheEye(const Scene& scene, const Settings& settings, const World& world,
                                  const std::vector<char>& seen, bool measures) {
  LightSource source;
  source.light = pointLight(world.camera().eye, Color(1), {});
  std::vector<LightSource> lights = scene.lights;
  Lit lit{seenWith(scene, settings, world, lights, seen), {}};
  lights.push_back(source);
  lit.added = seenWith(scene, settings, world, std::move(lights), seen);
  for (std::size_t i = 0; i < lit.base.size(); ++i) lit.added[i] = lit.added[i] + lit.base[i] * -1;
  const auto factor = factorFor(lit, developmentOf(settings));
  if (!factor) return {};
  const bool ray = scene.format == "ray";
  const std::string position = "point_light { position = " + rounded(world.camera().eye);
  const std::string strength = "; color = " + rounded(Color(*factor)) +
                               "; constant_attenuation_coeff = 1; quadratic_attenuation_coeff = 0;";
  return Cure{SourcePlace{.file = scene.file},
              scene.lights.empty() && !shines(scene) ? "; the scene has no light"
                                                     : "; no light reaches the visible objects",
              ray ? position + (measures ? "" : strength) + " } shines from the eye"
                  : "add a light that shines where the camera looks"};
}

/// Where to look, if nothing is seen.
std::optional<Cure> lookAround(const Scene& scene) {
  const std::string where = whereToLook(scene);
  if (where.empty()) return {};
  return Cure{SourcePlace{.file = scene.file}, "; no object is in the picture", where};
}

/// An emissive object whose shape is not sampled as a light: scattered rays find it at random alone.
std::optional<Cure> unsampledEmitter(const Scene& scene, const World& world) {
  if (!scene.lights.empty()) return {};
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!glows(scene.materials[object.material]) || Lamps::canSample(world, i)) continue;
    return Cure{
        object.place,
        "; rays find this emissive " + std::string(object.shape.keyword()) +
            " at random alone, since its shape is not sampled as a light",
        "squares, disks, boxes, spheres, cylinders, cones, tori and meshes are; or put a point_light there"};
  }
  return {};
}

std::optional<Cure> cureOf(const Scene& scene, const Settings& settings, const World& world,
                           const Picture& cells, const std::vector<char>& seen, const RenderFacts& facts) {
  if (!anyOf(seen)) return lookAround(scene);
  if (auto cure = unsampledEmitter(scene, world)) return cure;
  if (auto cure = otherExposure(scene, settings, cells, seen, facts.measured)) return cure;
  if (!facts.measured)
    if (auto cure = strongerLight(scene, settings, world, seen)) return cure;
  if (auto cure = outOfSolid(scene, world)) return cure;
  if (auto cure = turnedSun(scene, settings, world, seen)) return cure;
  if (facts.whyUnlit)
    if (const auto found = facts.whyUnlit()) return Cure{found->place, "; " + found->what, found->hint};
  return lightAtTheEye(scene, settings, world, seen, facts.measured.has_value());
}

}  // namespace

bool seesObjects(const World& world, const Size& size) {
  return anyOf(objectsSeen(world)) || anyOf(objectsSeen(world, size));
}

std::string whereToLook(const Scene& scene) {
  constexpr std::size_t kMostLookedAt = 2000;
  Box3 all;
  for (const Object& object : firstCopies(scene, kMostLookedAt).objects) {
    const Box3 box = object.worldFromObject * prepare(object.shape).bounds();
    if (!box.empty() && !box.unbounded()) all.extend(box);
  }
  if (all.empty()) return "";
  return scene.format == "ray"
             ? "look_at = " + rounded(all.center()) +
                   "; in the camera, in place of its look_at or viewdir, points it at the objects"
             : "turn the camera to " + rounded(all.center()) + ", the middle of the objects";
}

Picture cellsOf(const Film& film) {
  constexpr int kSide = 4;  // so many pixels of a cell are looked at, across and down
  const Picture whole = film.corners() ? film.picture() : Picture();
  const auto lookedAt = [](int count, int pixels) {  // along an axis
    std::vector<int> all;
    for (int cell = 0; cell < count; ++cell)
      for (int part = 0; part < kSide; ++part)
        all.push_back(std::min(pixels - 1, static_cast<int>((cell + (part + 0.5) / kSide) / count * pixels)));
    return all;
  };
  const std::vector<int> columns = lookedAt(kCellsAcross, film.width()),
                         rows = lookedAt(kCellsDown, film.height());
  const bool splats = film.takesSplats();
  Picture cells(kCellsAcross, kCellsDown);
  for (std::size_t y = 0; y < rows.size(); ++y)
    for (std::size_t x = 0; x < columns.size(); ++x) {
      const int px = columns[x], py = rows[y];
      Color& sum = cells.at(static_cast<int>(x) / kSide, static_cast<int>(y) / kSide);
      if (film.corners())
        sum += whole.at(px, py);
      else
        sum += film.ofSamples(px, py) + (splats ? film.ofSplats(px, py) : Color(0));
    }
  for (Color& sum : cells.pixels) sum = sum / (kSide * kSide);
  return cells;
}

Picture tracedCells(const World& world, const Settings& settings) {
  const Settings small = ofCells(settings);
  Film film = makeFilm(small, kCellsAcross, kCellsDown);
  Job job;
  if (render(world, small, film, job).end != End::finished) lookAtBudget();
  return film.picture();
}

std::optional<Message> darkness(const Scene& scene, const Settings& settings, const World& world,
                                const Picture& cells, const RenderFacts& facts) {
  const Development development = developmentOf(settings);
  if (!settings.region.whole() || settings.tone == Tone::stretch ||
      (scene.objects.empty() && scene.uses.empty()) || hasTrait(settings, Trait::showsData) ||
      settings.unweighted || settings.lightVertices >= 0 || settings.cameraVertices >= 0)
    return {};
  std::vector<char> dark;
  double level = 0;
  for (const Color& c : cells.pixels) {
    level += levelOf(c, development);
    dark.push_back(levelOf(c, development) < kDarkLevel);
  }
  level /= static_cast<double>(cells.pixels.size());
  const auto all = static_cast<double>(std::count(dark.begin(), dark.end(), 1));
  if (all < kNearlyAll * static_cast<double>(dark.size())) return {};
  try {
    const std::vector<char> seen = objectsSeen(world);
    double there = 0, darkThere = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      there += seen[i] != 0;
      darkThere += seen[i] != 0 && dark[i] != 0;
    }
    if (there > 0 && darkThere < kMostSeen * there) return {};
    const auto cure = cureOf(scene, settings, world, cells, seen, facts);
    constexpr double kBlack = 1e-3;
    if (!cure && level > kBlack) return {};
    if (!cure)
      return Message{
          Message::Severity::warning, SourcePlace{.file = scene.file}, "the picture is black",
          "`ray lint` looks for the cause, and `ray explain --pixel X,Y` follows the rays of a pixel"};
    char share[100];
    std::snprintf(share, sizeof share,
                  "%.0f %% of the picture is darker than level 20 of 255, its mean level is %.2g",
                  100 * all / static_cast<double>(dark.size()), level);
    return Message{Message::Severity::warning, cure->place, share + cure->why, cure->hint};
  } catch (const Error&) {  // the time is over, or the changed scene cannot be made
    return {};
  }
}

}  // namespace trace

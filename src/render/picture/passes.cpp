// The table of passes and how each is measured and shown: see passes.h. Between Tracer and Film; shown()
// stands where a picture has its tone. Averages only where the mean of two values means something: a depth,
// a place or a number half way between two objects belongs to neither.
#include "render/picture/passes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/budget.h"
#include "image/comparison/false_color.h"
#include "math/box.h"
#include "render/paths/interaction.h"
#include "render/picture/render.h"

namespace trace {
namespace {

Color colorOf(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Applies `show` to every pixel.
template <class Show>
Picture mapped(Picture picture, Show show) {
  for (Color& c : picture.pixels) {
    checkBudget();
    c = show(c);
  }
  return picture;
}

/// Levels from 0 to 1 in the colours of the settings.
Picture coloured(Picture levels, const Settings& settings) {
  if (settings.passColors == PassColors::grey) return levels;
  return mapped(std::move(levels), [](const Color& c) { return heatColor(c.r); });
}

// --- depth ---

Color depthValue(const PassPlace& at) {
  const Vec3& direction = at.camera.ray.direction;
  if (at.tracer.settings().passDepth == PassDepth::ray) return Color(at.hit.t * length(direction));
  return Color(at.hit.t * dot(direction, at.tracer.world().camera().ahead));
}

constexpr Color kTooNear(0);  // which no surface that is seen has

Picture depthShown(const Picture& values, const Settings& settings) {
  const bool given = settings.passFar > settings.passNear;
  const auto seen = [](const Color& c) { return c == kTooNear ? Color(kInfinity) : c; };
  const ValueRange range =
      given ? ValueRange{settings.passNear, settings.passFar} : finiteRange(mapped(values, seen));
  const double extent = range.high - range.low;
  const auto grey = [&](const Color& c) {
    if (!std::isfinite(c.r)) return Color(1);
    if (c == kTooNear) return Color(0);
    return extent > 0 ? clamp01(Color((c.r - range.low) / extent)) : Color(0);
  };
  if (settings.passColors == PassColors::heat) return coloured(mapped(values, grey), settings);
  return toned(mapped(values, grey), settings.tone);
}

// --- the others ---

Color normalValue(const PassPlace& at) { return colorOf(at.hit.surface.shading); }
Picture normalShown(const Picture& values, const Settings&) {
  return mapped(values, [](const Color& c) { return c * 0.5 + Color(0.5); });
}

Color idValue(const PassPlace& at) { return Color(at.hit.object + 1.0); }
Picture idShown(const Picture& values, const Settings&) {
  return mapped(values, [](const Color& c) { return numberColor(static_cast<std::uint64_t>(c.r)); });
}

Color uvValue(const PassPlace& at) {
  const Vec2 uv = at.hit.surface.uv;
  return {uv.x, uv.y, 0};
}
Picture uvShown(const Picture& values, const Settings&) { return mapped(values, clamp01); }

Color positionValue(const PassPlace& at) { return colorOf(at.hit.surface.point); }
Picture positionShown(const Picture& values, const Settings&) {
  Box3 box;
  for (const Color& c : values.pixels)
    if (isFinite(c)) box.extend(Vec3{c.r, c.g, c.b});
  const Vec3 size = box.size();
  const auto share = [](Real offset, Real extent) { return extent > 0 ? offset / extent : 0.5; };
  return mapped(values, [&](const Color& c) {
    if (!isFinite(c)) return Color(0);
    return Color(share(c.r - box.low.x, size.x), share(c.g - box.low.y, size.y),
                 share(c.b - box.low.z, size.z));
  });
}

Color samplesValue(const PassPlace&) { return Color(1); }
Picture samplesShown(const Picture& values, const Settings& settings) {
  const double most = samplesOf(settings);
  return coloured(mapped(values, [&](const Color& c) { return c * (1 / most); }), settings);
}

/// The albedo of the material: diffuse, reflected and transmitted straight.
Color albedoValue(const PassPlace& at) {
  const CameraRay& camera = at.camera;
  const Interaction place(at.tracer, camera.ray, at.hit, camera.differentials, camera.inside, 0.5);
  const WhittedTerms& terms = place.material;
  const Color scattered = scatter(place.bsdf(), place.frame, place.normal, -camera.ray.direction).diffuse;
  return clamp01(scattered + terms.reflective + terms.transmissive);
}
Picture plainShown(const Picture& values, const Settings&) { return mapped(values, clamp01); }

Color occlusionValue(const PassPlace& at) {
  const CameraRay& camera = at.camera;
  const Settings& settings = at.tracer.settings();
  const int rays =
      settings.ambientOcclusion > 0 ? settings.ambientOcclusion : std::max(1, 64 / samplesOf(settings));
  const Interaction place(at.tracer, camera.ray, at.hit, camera.differentials, camera.inside, 0.5);
  Gather open(at.tracer, 0);
  place.addOpen(open, Term::Kind::bounce, Color(1), rays, at.sampler);
  return open.radiance();
}

Color objectValue(const PassPlace& at) {
  return Color(at.facts && at.hit.object < at.facts->objects.size() ? at.facts->objects[at.hit.object] : 0);
}
/// The material with the largest share.
Color materialValue(const PassPlace& at) {
  const MaterialMix& mix = at.hit.materials;
  int most = 0;
  for (int i = 1; i < mix.count; ++i)
    if (mix.weight[i] > mix.weight[most]) most = i;
  const std::uint32_t material = mix.material[most];
  return Color(at.facts && material < at.facts->materials.size() ? at.facts->materials[material] : 0);
}

/// In pixels to the right and up.
Color motionValue(const PassPlace& at) {
  const Motion* motion = at.facts ? at.facts->motion.get() : nullptr;
  if (!motion || at.hit.object >= motion->objects.size() || !motion->objects[at.hit.object]) return Color(0);
  const Vec3 point = at.hit.surface.point;
  const auto now = at.tracer.world().camera().placeOf(point);
  const auto then = motion->camera.placeOf(*motion->objects[at.hit.object] * point);
  if (!now || !then) return Color(0);
  const Color moved{(then->x - now->x) * at.size.width, (then->y - now->y) * at.size.height, 0};
  return isFinite(moved) ? moved : Color(0);
}
/// Grey where nothing moves; 64 pixels are all of red and green.
Picture motionShown(const Picture& values, const Settings&) {
  constexpr double kMost = 64;
  return mapped(values, [](const Color& c) {
    return clamp01(Color(0.5 + 0.5 * c.r / kMost, 0.5 + 0.5 * c.g / kMost, 0.5));
  });
}

Picture lightShown(const Picture& values, const Settings& settings) {
  return developed(values, developmentOf(settings));
}

/// In levels of 255: what is removed from a pixel at most of a channel.
Picture changeShown(const Picture& values, const Settings& settings) {
  constexpr double kWhite = 16;  // levels
  const auto level = [](const Color& c) {
    return Color(255 / kWhite * std::max({std::abs(c.r), std::abs(c.g), std::abs(c.b)}));
  };
  return coloured(mapped(values, [&](const Color& c) { return clamp01(level(c)); }), settings);
}

/// The standard error of the pixel, in levels of 255.
Picture varianceShown(const Picture& values, const Settings& settings) {
  return changeShown(mapped(values, [](const Color& c) { return Color(std::sqrt(c.r)); }), settings);
}

// --- guides of denoising ---

Color albedoGuide(const PassPlace& at) { return albedoValue(at) * at.passes; }
/// 1 / depth has a mean where some samples hit nothing.
Color nearnessGuide(const PassPlace& at) {
  return Color(1 / (at.before > 0 ? at.before + at.hit.t : depthValue(at).r));
}

constexpr Color kNowhere(kInfinity);
constexpr std::array kPasses{
    PassRow{Pass::depth, "depth", "how far the first surface is from the eye; far is white",
            Film::Keep::first, kNowhere, kTooNear, depthValue, depthShown},
    PassRow{Pass::normal, "normal",
            "its normal for shading in the world; x, y, z from -1 to 1 are shown 0 to 1", Film::Keep::mean,
            Color(0), Color(0), normalValue, normalShown},
    PassRow{Pass::id, "id", "the number of the object in the scene, from 1; shown as a colour",
            Film::Keep::first, Color(0), Color(0), idValue, idShown},
    PassRow{Pass::uv, "uv", "its texture coordinates; u is shown red, v green", Film::Keep::first, Color(0),
            Color(0), uvValue, uvShown},
    PassRow{Pass::position, "position",
            "its position in the world; shown within the bounding box of all visible points",
            Film::Keep::first, kNowhere, kNowhere, positionValue, positionShown},
    PassRow{Pass::samples, "samples", "how many camera rays it has; most are white", Film::Keep::sum,
            Color(1), Color(1), samplesValue, samplesShown},
    PassRow{Pass::albedo, "albedo", "the albedo of its material: diffuse, reflected and transmitted",
            Film::Keep::mean, Color(0), Color(0), albedoValue, plainShown},
    PassRow{Pass::occlusion, "occlusion", "ambient occlusion, white where nothing is near", Film::Keep::mean,
            Color(1), Color(1), occlusionValue, plainShown},
    PassRow{Pass::change, "change", "the change by --denoise; shown by its size, 16 levels are white",
            Film::Keep::mean, Color(0), Color(0), nullptr, changeShown},
    PassRow{Pass::object, "object", "mattes of the objects by their names (Cryptomatte); shown as colours",
            Film::Keep::counts, Color(0), Color(0), objectValue, idShown},
    PassRow{Pass::material, "material",
            "mattes of the materials by their names (Cryptomatte); shown as colours", Film::Keep::counts,
            Color(0), Color(0), materialValue, idShown},
    PassRow{Pass::direct, "direct",
            "the light that was scattered once at most; in layers by each light and emissive object",
            Film::Keep::weighted, Color(0), Color(0), nullptr, lightShown},
    PassRow{Pass::indirect, "indirect", "all other light, likewise: both sum to the picture",
            Film::Keep::weighted, Color(0), Color(0), nullptr, lightShown},
    PassRow{Pass::motion, "motion", "how far it moves until the next frame, in pixels to the right and up",
            Film::Keep::first, Color(0), Color(0), motionValue, motionShown},
    PassRow{Pass::variance, "variance",
            "the variance of its mean luminance; shown by the standard error, 16 levels are white",
            Film::Keep::mean, Color(0), Color(0), nullptr, varianceShown},
};

constexpr std::array kGuides{
    PassRow{Pass::albedo, "guide albedo", "", Film::Keep::mean, Color(0), Color(0), albedoGuide, plainShown,
            true},
    PassRow{Pass::normal, "guide normal", "", Film::Keep::mean, Color(0), Color(0), normalValue, normalShown,
            true},
    PassRow{Pass::depth, "guide nearness", "", Film::Keep::mean, Color(0), Color(0), nearnessGuide,
            plainShown, true},
};

}  // namespace

std::span<const PassRow> passRows() { return kPasses; }

std::vector<const PassRow*> passesOf(const Settings& settings) {
  std::vector<const PassRow*> rows;
  const auto isMade = [&](const PassRow& row) {
    return (row.pass != Pass::direct && row.pass != Pass::indirect) || splitsLight(settings);
  };
  for (const PassRow& row : kPasses)
    if (settings.passes.has(row.pass) && isMade(row)) rows.push_back(&row);
  return rows;
}

std::vector<const PassRow*> layersOf(const Settings& settings) {
  std::vector<const PassRow*> rows;
  for (const PassRow& row : kPasses)
    if (row.value && settings.passes.has(row.pass)) rows.push_back(&row);
  for (const PassRow& row : kGuides)
    if (settings.denoise) rows.push_back(&row);
  return rows;
}

int layerOf(const Settings& settings, std::string_view pass) {
  const auto rows = layersOf(settings);
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const PassRow* row) { return row->name == pass; });
  return found == rows.end() ? -1 : static_cast<int>(found - rows.begin());
}

bool splitsLight(const Settings& settings) {
  const Traits traits = traitsOf(settings);
  return !traits.has(Trait::splats) && !traits.has(Trait::byChains) && !traits.has(Trait::showsData);
}

LightLayers lightLayersOf(const Settings& settings, std::size_t groups) {
  LightLayers layers;
  layers.end = static_cast<int>(layersOf(settings).size());
  const auto take = [&](int& first, std::size_t count) {
    first = layers.end;
    layers.end += static_cast<int>(count);
  };
  if (groups > 0 && splitsLight(settings)) {
    if (settings.passes.has(Pass::direct)) take(layers.direct, groups);
    if (settings.passes.has(Pass::indirect)) take(layers.indirect, groups);
  }
  if (settings.alpha) take(layers.alpha, 1);
  return layers;
}

Picture valuesOf(const PassRow& pass, const Film& film, const Settings& settings, const PassNames& names,
                 const Picture& shown) {
  if (pass.value) return film.layer(static_cast<std::size_t>(layerOf(settings, pass.name)));
  if (pass.pass == Pass::variance) return film.variances();
  if (pass.pass == Pass::change) {
    Picture picture = film.picture();
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
      picture.pixels[i] = shown.pixels[i] + picture.pixels[i] * -1;
    return picture;
  }
  const LightLayers layers = lightLayersOf(settings, names.groups.size());
  const int first = pass.pass == Pass::direct ? layers.direct : layers.indirect;
  Picture sum(film.width(), film.height());
  for (std::size_t group = 0; first >= 0 && group < names.groups.size(); ++group) {
    const Picture layer = film.layer(static_cast<std::size_t>(first) + group);
    for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += layer.pixels[i];
  }
  return sum;
}

Film makeFilm(const Settings& settings, int width, int height, const PassNames& names) {
  std::vector<Film::LayerKind> layers;
  for (const PassRow* row : layersOf(settings)) {
    const auto numbers = row->pass == Pass::object ? names.objects.size() : names.materials.size();
    layers.push_back({row->keep == Film::Keep::sum ? Color(0) : row->background, row->keep,
                      static_cast<std::uint32_t>(numbers)});
  }
  const LightLayers light = lightLayersOf(settings, names.groups.size());
  layers.resize(static_cast<std::size_t>(light.end), {Color(0), Film::Keep::weighted});
  const Traits traits = traitsOf(settings);
  Film film(width, height, samplesOf(settings), layers,
            traits.has(Trait::byChains) ? 0 : settings.noiseTarget);
  film.setWhite(whiteOf(settings));
  if (traits.has(Trait::splats)) film.takeSplats();
  if (subdivides(settings)) film.divide(subdivisionOf(settings, {width, height}));
  if (settings.denoise && !traits.has(Trait::byChains) && !film.corners()) film.keepHalves();
  return film;
}

}  // namespace trace

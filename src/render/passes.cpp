// The table of passes and how each is measured and shown: see passes.h. Between Tracer and Film; shown()
// stands where a picture has its tone. Averages only where the mean of two values means something: a depth,
// a place or a number half way between two objects belongs to neither.
#include "render/passes.h"

#include <array>
#include <cmath>

#include "image/false_color.h"
#include "math/box.h"
#include "render/integrator.h"
#include "render/render.h"

namespace trace {
namespace {

Color colorOf(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Applies `show` to every pixel.
template <class Show>
Picture mapped(Picture picture, Show show) {
  for (Color& c : picture.pixels) c = show(c);
  return picture;
}

// --- depth ---

Color depthValue(const Hit& hit, const Ray& ray, const Tracer& tracer) {
  const Real length = hit.t * trace::length(ray.direction);
  if (tracer.settings().passDepth == PassDepth::ray) return Color(length);
  return Color(hit.t * dot(ray.direction, tracer.world().camera().ahead));
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
  return toned(mapped(values, grey), settings.tone);
}

// --- the others ---

Color normalValue(const Hit& hit, const Ray&, const Tracer&) { return colorOf(hit.surface.shading); }
Picture normalShown(const Picture& values, const Settings&) {
  return mapped(values, [](const Color& c) { return c * 0.5 + Color(0.5); });
}

Color idValue(const Hit& hit, const Ray&, const Tracer&) { return Color(hit.object + 1.0); }
Picture idShown(const Picture& values, const Settings&) {
  return mapped(values, [](const Color& c) { return numberColor(static_cast<std::uint64_t>(c.r)); });
}

Color uvValue(const Hit& hit, const Ray&, const Tracer&) {
  const Vec2 uv = hit.surface.uv;
  return {uv.x, uv.y, 0};
}
Picture uvShown(const Picture& values, const Settings&) { return mapped(values, clamp01); }

Color positionValue(const Hit& hit, const Ray&, const Tracer&) { return colorOf(hit.surface.point); }
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

Color samplesValue(const Hit&, const Ray&, const Tracer&) { return Color(1); }
Picture samplesShown(const Picture& values, const Settings& settings) {
  const double most = samplesOf(settings);
  return mapped(values, [&](const Color& c) { return c * (1 / most); });
}

constexpr Color kNowhere(kInfinity);
constexpr std::array kTable{
    PassRow{Pass::depth, "depth", "how far the first surface is from the eye; far is white",
            Film::Keep::first, kNowhere, kTooNear, depthValue, depthShown},
    PassRow{Pass::normal, "normal",
            "its normal for shading in the world; x, y, z from -1 to 1 are shown 0 to 1", Film::Keep::mean,
            Color(0), Color(0), normalValue, normalShown},
    PassRow{Pass::id, "id", "the number of the object in the scene, from 1; shown as a colour",
            Film::Keep::first, Color(0), Color(0), idValue, idShown},
    PassRow{Pass::uv, "uv", "its texture coordinates; u is shown red, v green", Film::Keep::first, Color(0),
            Color(0), uvValue, uvShown},
    PassRow{Pass::position, "position", "its place in the world; shown within the box of all that is seen",
            Film::Keep::first, kNowhere, kNowhere, positionValue, positionShown},
    PassRow{Pass::samples, "samples", "how many camera rays it has; most are white", Film::Keep::sum,
            Color(1), Color(1), samplesValue, samplesShown},
};

}  // namespace

std::span<const PassRow> passRows() { return kTable; }

std::vector<const PassRow*> passesOf(const Settings& settings) {
  std::vector<const PassRow*> rows;
  for (const PassRow& row : kTable)
    if (settings.passes.has(row.pass)) rows.push_back(&row);
  return rows;
}

Film makeFilm(const Settings& settings, int width, int height) {
  std::vector<Film::LayerKind> layers;
  for (const PassRow* row : passesOf(settings))
    layers.push_back({row->keep == Film::Keep::sum ? Color(0) : row->background, row->keep});
  const IntegratorRow& row = rowOf(settings);
  Film film(width, height, samplesOf(settings), layers, row.byChains ? 0 : settings.noiseTarget);
  if (row.throws) film.takeSplats();
  return film;
}

}  // namespace trace

#include "app/compare/selftest.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "app/session/session.h"
#include "image/srgb.h"
#include "math/elementary.h"
#include "scene/picture_size.h"
#include "shading/optics/fresnel.h"
#include "shading/optics/optics.h"

namespace trace {
namespace {

/// The scene, without a file, and settings over its own.
std::unique_ptr<Session> sessionOf(const std::string& text, const std::vector<Choice>& choices = {}) {
  Messages messages;
  Scene scene = readScene("selftest.ray", "SBT-raytracer 1.0\n" + text, messages, 0);
  messages.throwIfFailed();
  const Settings settings = settingsFor(scene.camera, {scene.choices, choices});
  auto session = std::make_unique<Session>();
  session->open(std::move(scene), settings);
  session->build();
  return session;
}

Picture pictureOf(const std::string& text, const std::vector<Choice>& choices = {}) {
  const auto session = sessionOf(text, choices);
  const RenderResult result = session->renderPicture();
  if (result.end != End::finished) throw Error(Fault::limit, "the render did not end: " + result.failure);
  return session->picture();
}

/// The mean of green over all pixels.
double mean(const Picture& picture) {
  double sum = 0;
  for (const Color& c : picture.pixels) sum += c.g;
  return sum / static_cast<double>(picture.pixels.size());
}

double differentPixels(const Picture& a, const Picture& b) {
  double different = a.pixels.size() == b.pixels.size() ? 0 : kInfinity;
  for (std::size_t i = 0; i < a.pixels.size() && i < b.pixels.size(); ++i)
    different += a.pixels[i] == b.pixels[i] ? 0 : 1;
  return different;
}

// --- scenes -------------------------------------------------------------------------------------------

/// A patch of a floor at the origin, of that material, seen from aslant above by every pixel alike.
std::string patch(const std::string& settings, const std::string& material) {
  return "settings { width = 4; height = 4; spp = 1024; sampling = sobol; " + settings +
         "}\ncamera { position = (3, 1, 0); viewdir = (-3, -1, 0); updir = (0, 1, 0); fov = 0.02; }\n"
         "rotate(1, 0, 0, -1.5707963267948966, scale(0.02, 0.02, 1, square { material = { " +
         material + " } }))\n";
}

constexpr const char* kLampAbove =
    "translate(0, 1, 0, rotate(1, 0, 0, 1.5707963267948966, square { material = { emissive = (1, 1, 1); } "
    "}))\n";

/// Forty objects of several kinds, some glass, some mirrors, with textures, soft light and a lens.
constexpr const char* kMixture = R"(
settings { width = 90; height = 60; spp = 4; sampling = sobol; aperture = 0.05; depth = 4; }
camera { position = (0, 2, 9); viewdir = (0, -0.2, -1); updir = (0, 1, 0); fov = 35; }
point_light { position = (4, 6, 5); color = (0.9, 0.9, 0.9); radius = 0.5; quadratic_attenuation_coeff = 0; constant_attenuation_coeff = 1; }
directional_light { direction = (-1, -1, -1); color = (0.3, 0.3, 0.4); }
ambient_light { color = (0.1, 0.1, 0.1); }
material = { name = "marbled"; diffuse = marble { }; ambient = (0.5, 0.5, 0.5); };
translate(0, -1, 0, rotate(1, 0, 0, -1.5708, scale(30, 30, 1, square { material = "marbled"; })))
particles { count = 24; seed = 5; box_size = (6, 2, 3); particle_size = (0.2, 0.4);
            material = { diffuse = (0.7, 0.4, 0.2); specular = (0.4, 0.4, 0.4); reflective = (0.3, 0.3, 0.3); shininess = 30; } }
translate(-1.2, 0, 1, sphere { material = { transmissive = (0.9, 0.95, 1); reflective = (0.2, 0.2, 0.2); index = 1.5; } })
translate(1.6, 0, 0.5, torus { major_radius = 0.8; minor_radius = 0.3; material = { diffuse = (0.2, 0.5, 0.8); specular = (0.5, 0.5, 0.5); shininess = 50; } })
difference { translate(0.2, 0.4, -1, box { material = "marbled"; }) translate(0.4, 0.7, -0.6, scale(0.5, sphere { material = "marbled"; })) }
)";

// --- geometry -----------------------------------------------------------------------------------------

/// By parallel projection: the lengths inside along a grid of rays, which are 4 wide and high around the
/// origin.
double volumeOf(const std::string& object) {
  const auto session = sessionOf("settings { width = 4; height = 4; }\n" + object);
  constexpr int kSide = 400;
  constexpr double kStep = 4.0 / kSide;
  double volume = 0;
  Statistics statistics;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Ray ray{{-2 + (x + 0.5) * kStep, -2 + (y + 0.5) * kStep, 9}, {0, 0, -1}};
      std::vector<Real> met;
      session->world().crossings(ray, kInfinity, Faces::both, statistics, [&](const Found& found) {
        met.push_back(found.t);
        return false;
      });
      std::sort(met.begin(), met.end());
      for (std::size_t i = 0; i + 1 < met.size(); i += 2) volume += met[i + 1] - met[i];
    }
  return volume * kStep * kStep;
}

// --- the checks ---------------------------------------------------------------------------------------

/// In a room of that albedo whose walls shine with 1, at that depth.
double roomOf(const std::string& albedo, const std::string& depth) {
  const std::string material =
      "material = { diffuse = (" + albedo + ", " + albedo + ", " + albedo + "); emissive = (1, 1, 1); }";
  std::string text =
      "settings { integrator = path; width = 16; height = 16; spp = 128; sampling = sobol; depth = " + depth +
      "; }\ncamera { position = (0, 0, 0); viewdir = (0, 0, -1); updir = (0, 1, 0); }\n";
  for (const char* turn :
       {"0, 1, 0, 0", "0, 1, 0, 1.5707963267948966", "0, 1, 0, 3.141592653589793",
        "0, 1, 0, 4.71238898038469", "1, 0, 0, 1.5707963267948966", "1, 0, 0, 4.71238898038469"})
    text += "rotate(" + std::string(turn) + ", translate(0, 0, 1, scale(2, 2, 1, square { " + material +
            " })))\n";
  return mean(pictureOf(text));
}

/// Pixels of the mixture that differ from those by one thread.
double byThreads(const char* threads) {
  return differentPixels(pictureOf(kMixture, {{"threads", "1", {}}}),
                         pictureOf(kMixture, {{"threads", threads, {}}}));
}

/// Samples of the mixture whose rays do not sum up to what was rendered.
double notExplained() {
  const auto session = sessionOf(kMixture);
  session->renderPicture();
  const Picture picture = session->picture();
  double wrong = 0;
  for (int y = 5; y < picture.height; y += 10)
    for (int x = 5; x < picture.width; x += 10) {
      const Explanation e = session->explain(x, y, 1);
      wrong += sumsUp(e.tree) && e.pixel == picture.at(x, y) ? 0 : 1;
    }
  return wrong;
}

/// Pixels of the mixture that change if it is stopped on the way, kept as bytes and resumed.
double afterAStop() {
  const auto part = sessionOf(kMixture), rest = sessionOf(kMixture);
  std::thread stopper([&] {
    constexpr int kMostMilliseconds = 10000;
    for (int i = 0; i < kMostMilliseconds && part->job().fraction() < 0.3; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    part->job().cancel = true;
  });
  part->renderPicture();
  stopper.join();
  rest->film().restore(part->film().saved());
  rest->renderPicture();
  return differentPixels(pictureOf(kMixture), rest->picture());
}

/// A room of three colours under a lamp, with a box: four bounces of light.
constexpr const char* kSmallRoom = R"(
settings { integrator = path; width = 8; height = 8; spp = 1024; depth = 4; sampling = random; }
camera { position = (0.5, -1.35, 0.5); viewdir = (0, 1, 0); updir = (0, 0, 1); fov = 40; }
material = { name = "white"; diffuse = (0.73, 0.73, 0.73); };
translate(0.5, 0.5, 0, square { material = "white"; })
translate(0.5, 0.5, 1, rotate(1, 0, 0, 3.141592653589793, square { material = "white"; }))
translate(0.5, 1, 0.5, rotate(1, 0, 0, 1.5707963267948966, square { material = "white"; }))
translate(0, 0.5, 0.5, rotate(0, 1, 0, 1.5707963267948966, square { material = { diffuse = (0.63, 0.065, 0.05); } }))
translate(1, 0.5, 0.5, rotate(0, 1, 0, -1.5707963267948966, square { material = { diffuse = (0.14, 0.45, 0.09); } }))
translate(0.5, 0.5, 0.999, rotate(1, 0, 0, 3.141592653589793, scale(0.3, 0.3, 1, square { material = { emissive = (17, 17, 17); diffuse = (0, 0, 0); } })))
translate(0.6, 0.6, 0.25, scale(0.3, 0.3, 0.5, box { material = "white"; }))
)";

/// The squared error of that room's pixels by a generator, relative to that of independent samples, both
/// beside independent ones that are eight times as many.
double errorBesideRandom(const char* sampling) {
  static const Picture wanted = pictureOf(kSmallRoom, {{"spp", "8192", {}}, {"seed", "3", {}}});
  const auto squares = [](const Picture& found) {
    double sum = 0;
    for (std::size_t i = 0; i < wanted.pixels.size(); ++i) {
      const double off = luminanceOf(found.pixels[i]) - luminanceOf(wanted.pixels[i]);
      sum += off * off / math::pow(luminanceOf(wanted.pixels[i]), 2);
    }
    return sum;
  };
  static const double random = squares(pictureOf(kSmallRoom));
  return squares(pictureOf(kSmallRoom, {{"sampling", sampling, {}}})) / random;
}

constexpr double kDegree = kPi / 180;

constexpr const char* kNoMoreThanRandom = "at most 1 of independent samples'";

constexpr std::array kChecks{
    SelfCheck{"volume of a ball", "4 pi / 3", 4.18879, 0.01, [] { return volumeOf("sphere { }"); }},
    SelfCheck{"volume of a torus", "2 pi^2 R r^2", 1.2337, 0.005,
              [] { return volumeOf("torus { major_radius = 1; minor_radius = 0.25; }"); }},
    SelfCheck{"volume of two crossed cylinders", "16 / 3, Archimedes", 16.0 / 3, 0.02,
              [] {
                return volumeOf(
                    "intersection { translate(0, 0, -1.5, scale(1, 1, 3, cylinder { }))"
                    " rotate(0, 1, 0, 1.5707963267948966, translate(0, 0, -1.5, scale(1, 1, 3, "
                    "cylinder { }))) }");
              }},
    SelfCheck{"pixels that change without the hierarchy", "none may", 0, 0,
              [] {
                return differentPixels(pictureOf(kMixture), pictureOf(kMixture, {{"accel", "none", {}}}));
              }},
    SelfCheck{"pixels that change with 2 threads", "none may", 0, 0, [] { return byThreads("2"); }},
    SelfCheck{"pixels that change with 7 threads", "none may", 0, 0, [] { return byThreads("7"); }},
    SelfCheck{"samples that are not explained", "none may be", 0, 0, notExplained},
    SelfCheck{"pixels that change if a render is stopped", "none may", 0, 0, afterAStop},
    SelfCheck{"angle refracted from 60 degrees into glass", "Snell, index 1.5", 35.26439, 1e-5,
              [] {
                const Vec3 in{math::sin(60 * kDegree), -math::cos(60 * kDegree), 0};
                return math::asin(refracted(in, {0, 1, 0}, 1 / 1.5)->x) / kDegree;
              }},
    SelfCheck{"share that glass mirrors at 75 degrees", "Fresnel, index 1.5", 0.253061, 1e-6,
              [] { return fresnelDielectric(math::cos(75 * kDegree), 1, 1.5); }},
    SelfCheck{"light of a square panel on the floor under it", "form factor 0.239456", 0.239456, 5e-4,
              [] {
                return mean(pictureOf(
                    patch("light-samples = 1; ", "diffuse = (1, 1, 1);") +
                    "rectangle_light { position = (0, 1, 0); u = (1, 0, 0); v = (0, 0, 1); two_sided = true; "
                    "color = (1, 1, 1); }\n"));
              }},
    SelfCheck{"open sky in front of a wall as high as it is far", "(1 + cos 45) / 2", 0.853553, 0.004,
              [] {
                return mean(
                    pictureOf(patch("integrator = occlusion; ", "diffuse = (1, 1, 1);") +
                              "translate(-1, 0.5, 0, rotate(0, 1, 0, 1.5707963267948966, scale(10000, 1, 1, "
                              "square { })))\n"));
              }},
    SelfCheck{"transmittance of fog of 0.3 along 5", "exp(-1.5)", 0.22313, 1e-4,
              [] {
                return mean(pictureOf(
                    "settings { width = 2; height = 2; fog = 0.3; fog-color = 0; }\n"
                    "camera { position = (0, 0, 5); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 0.001; }\n"
                    "square { material = { emissive = (1, 1, 1); } }\n"));
              }},
    SelfCheck{"paths: light of a square emitter", "form factor 0.239456", 0.239456, 5e-4,
              [] {
                return mean(
                    pictureOf(patch("integrator = path; depth = 1; ", "diffuse = (1, 1, 1);") + kLampAbove));
              }},
    SelfCheck{"paths: an emissive room, 3 bounces", "(1 - a^5) / (1 - a), a = 0.5", 1.9375, 0.01,
              [] { return roomOf("0.5", "3"); }},
    SelfCheck{"paths: the same, as many as there are", "1 / (1 - a), a = 0.8", 5, 0.03,
              [] { return roomOf("0.8", "60"); }},
    SelfCheck{"paths: glass where light is even", "it vanishes: 1", 1, 0.006,
              [] {
                return mean(pictureOf(
                    "settings { integrator = path; width = 16; height = 16; spp = 64; sampling = sobol; "
                    "depth = 100; fresnel = exact; }\nbackground { gradient = ((1, 1, 1)); }\n"
                    "camera { position = (0, 0, 3); viewdir = (0, 0, -1); updir = (0, 1, 0); }\n"
                    "sphere { material = { transmissive = (1, 1, 1); reflective = (1, 1, 1); "
                    "index = 1.5; } }\n"));
              }},
    SelfCheck{"sampling grid: error in a room", kNoMoreThanRandom, 0.5, 0.6,
              [] { return errorBesideRandom("grid"); }},
    SelfCheck{"sampling jittered: error in a room", kNoMoreThanRandom, 0.5, 0.6,
              [] { return errorBesideRandom("jittered"); }},
    SelfCheck{"sampling stratified: error in a room", kNoMoreThanRandom, 0.5, 0.6,
              [] { return errorBesideRandom("stratified"); }},
    SelfCheck{"sampling halton: error in a room", kNoMoreThanRandom, 0.5, 0.6,
              [] { return errorBesideRandom("halton"); }},
    SelfCheck{"sampling sobol: error in a room", kNoMoreThanRandom, 0.5, 0.6,
              [] { return errorBesideRandom("sobol"); }},
    SelfCheck{"sampling blue: error in a room", kNoMoreThanRandom, 0.5, 0.6,
              [] { return errorBesideRandom("blue"); }},
    SelfCheck{"caustics: light behind a pane", "12 / 13 of it, Fresnel", 12.0 / 13, 0.03,
              [] {
                return mean(pictureOf(
                    "settings { width = 24; height = 24; caustics = 200000; caustic-radius = 0.2; "
                    "fresnel = exact; air-index = 1; depth = 20; }\n"
                    "camera { position = (0.5, 0.8, 0); viewdir = (-0.5, -0.8, 0); updir = (0, 0, 1); "
                    "fov = 15; }\n"
                    "directional_light { direction = (0, -1, 0); color = (1, 1, 1); }\n"
                    "rotate(1, 0, 0, -1.5707963267948966, scale(9, 9, 1, square { material = { "
                    "diffuse = (1, 1, 1); } }))\n"
                    "translate(0, 1, 0, scale(3, 0.2, 3, box { material = { transmissive = (1, 1, 1); "
                    "reflective = (1, 1, 1); index = 1.5; } }))\n"));
              }},
};

}  // namespace

std::span<const SelfCheck> selfChecks() { return kChecks; }

SelftestTime::SelftestTime() : shorts_{0, selfChecks().size()}, longs_{0, longSelfChecks().size()} {
  // How many times as long as the probe one check takes on the average, in processor time.
  constexpr double kShort = 0.5, kLong = 37;
  const auto begin = std::chrono::steady_clock::now();
  pictureOf(kMixture, {{"spp", "16", {}}});
  const double probe = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  shorts_.known = kShort * probe;
  longs_.known = kLong * probe;
}

void SelftestTime::note(bool isLong, double seconds) {
  Table& table = isLong ? longs_ : shorts_;
  ++table.done;
  table.seconds += seconds;
}

double SelftestTime::left() const {
  const auto of = [](const Table& table) {
    const double each = (kKnown * table.known + table.seconds) / (kKnown + static_cast<double>(table.done));
    return each * static_cast<double>(table.checks - table.done);
  };
  return of(shorts_) + of(longs_);
}

}  // namespace trace

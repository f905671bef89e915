// Energy and Fresnel's formula of every shading model, at all angles and roughnesses.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "shading/bsdf.h"
#include "shading/fresnel.h"

namespace trace {
namespace {

const Frame kFurnaceFrame{{0, 0, 1}};
const std::vector<Real> kFurnaceAngles{0, 20, 40, 55, 65, 75, 80, 83, 85, 87, 88, 89};
const std::vector<Real> kFurnaceRoughnesses{0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.85, 1};

Real cosineOf(Real degrees) { return std::cos(degrees * kPi / 180); }

/// The share of light's power that comes back to an eye at that cosine: the mean weight of samples that are
/// spread evenly (Roberts 2018), with the ray that a smooth surface mirrors.
Real furnace(const Bsdf& bsdf, Real cosine, int samples = 6'000) {
  constexpr Real kRoot = 1.2207440846057594;
  const auto number = [](int i, Real step) {
    const Real x = 0.5 + i * step;
    return x - std::floor(x);
  };
  const Vec3 eye = Vec3{std::sqrt(1 - cosine * cosine), 0, cosine};
  Real sum = 0;
  for (int i = 0; i < samples; ++i) {
    const Vec2 u{number(i, 1 / kRoot), number(i, 1 / (kRoot * kRoot))};
    if (const auto drawn =
            sample(bsdf, kFurnaceFrame, eye, number(i, 1 / (kRoot * kRoot * kRoot)), u, Transport::importance))
      sum += drawn->weight.g;
  }
  return sum / samples + (mirrorIsExact(bsdf) ? mirrorWeight(bsdf, cosine).g : 0);
}

/// A model that gives back all light, and how far it may be off.
struct White {
  std::string name;
  MaterialModel model;
  Real off = 0.01;
};

template <class Model, class Set>
White white(std::string name, const Set& set) {
  Model model;
  set(model);
  return {std::move(name), std::move(model)};
}

/// Those that promise it, of a roughness.
std::vector<White> whites(Real roughness) {
  std::vector<White> all;
  for (const Distribution kind : {Distribution::ggx, Distribution::beckmann}) {
    const std::string facets = kind == Distribution::ggx ? " ggx" : " beckmann";
    all.push_back(white<Conductor>("conductor" + facets, [&](Conductor& m) {
      m.color = Color(1), m.roughness = roughness, m.distribution = kind;
    }));
    for (const Real film : {0.0, 100.0, 300.0, 700.0})
      for (const Real index : {1.3, 1.5, 2.4})
        all.push_back(white<Coated>("coated" + facets + " film " + std::to_string(film) + " index " +
                                        std::to_string(index),
                                    [&](Coated& m) {
                                      m.diffuse = Color(1), m.roughness = roughness, m.distribution = kind;
                                      m.film = film, m.index = index;
                                    }));
    for (const Real index : {1.2, 1.5, 2.4})
      all.push_back(white<RoughGlass>("rough_glass" + facets + " index " + std::to_string(index),
                                      [&](RoughGlass& m) {
                                        m.roughness = roughness, m.distribution = kind, m.index = index;
                                        m.compensated = true;
                                      }));
  }
  for (const Real iridescence : {0.0, 0.5, 1.0})
    for (const Real strength : {0.5, 1.0})
      all.push_back(white<Principled>("principled iridescence " + std::to_string(iridescence) + " strength " +
                                          std::to_string(strength),
                                      [&](Principled& m) {
                                        m.color = Color(1), m.roughness = roughness;
                                        m.iridescence = iridescence, m.specularStrength = strength;
                                      }));
  all.push_back(white<Principled>("principled metal", [&](Principled& m) {
    m.color = Color(1), m.roughness = roughness, m.metallic = 1;
  }));
  all.push_back(white<Subsurface>("subsurface", [&](Subsurface& m) {
    m.absorbs = Color(0), m.roughness = roughness;
  }));
  return all;
}

TEST(WhiteFurnace, AllLightComesBackAtAllAnglesAndRoughnesses) {
  for (const Real roughness : kFurnaceRoughnesses)
    for (const White& w : whites(roughness))
      for (const bool exact : {false, true}) {
        const Bsdf bsdf = bsdfOf(w.model, {.exactFresnel = exact});
        for (const Real angle : kFurnaceAngles)
          for (const Real side : {1.0, -1.0}) {
            if (side < 0 && !std::holds_alternative<RoughGlass>(w.model)) continue;
            EXPECT_NEAR(furnace(bsdf, side * cosineOf(angle)), 1, w.off)
                << w.name << " roughness " << roughness << (exact ? " exact" : "") << " at "
                << side * angle << " degrees";
          }
      }
}

}  // namespace
}  // namespace trace

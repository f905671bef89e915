// What every shading model promises (shading/scattering.h), over the list of models.
#include "support/materials.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "shading/bsdf.h"
#include "shading/optics/dispersion.h"
#include "shading/optics/fresnel.h"
#include "shading/optics/thin_film.h"
#include "support/random.h"

namespace trace {
namespace {

using test::NamedModel;
using test::Random;

/// As much as light can depend on: a normal and a grain that are no axes.
const Frame kFrame{normalize({0.3, -0.5, 0.8}), {1, 2, 0.3}};

Vec3 world(const Vec3& local) { return kFrame.basis().toWorld(local); }
Vec3 local(Real cosine, Real phi) { return sphericalDirection(cosine, phi); }

/// The model with some values set.
template <class Model, class Set>
Bsdf with(const Set& set) {
  Model model;
  set(model);
  return bsdfOf(model, {});
}

/// Those whose surfaces scatter.
std::vector<NamedModel> scattering() {
  std::vector<NamedModel> all = test::variedModels();
  std::erase_if(all, [](const NamedModel& m) {
    const auto varies = [&](const char* field) { return m.name.find(field) != m.name.npos; };
    return !scatters(bsdfOf(m.model, {})) || varies(" emissive") || varies(" ambient") || varies(" shadow");
  });
  return all;
}

template <class Test>
void forEachModel(const Test& test) {
  for (const NamedModel& m : scattering()) {
    SCOPED_TRACE(m.name);
    test(m.model, bsdfOf(m.model, {}));
  }
}

bool reciprocal(const MaterialModel& model) { return model.type().reciprocal; }

TEST(Materials, AreReciprocalWhereTheySaySo) {
  Random random(1);
  forEachModel([&](const MaterialModel& model, const Bsdf& bsdf) {
    if (!reciprocal(model)) return;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 a = local(random.uniform(0.02, 1), random.uniform(0, 7));
      const Vec3 b = local(random.uniform(0.02, 1), random.uniform(0, 7));
      const Color ab = evaluate(bsdf, kFrame, world(a), world(b)) / b.z;
      const Color ba = evaluate(bsdf, kFrame, world(b), world(a)) / a.z;
      ASSERT_NEAR(ab.r, ba.r, 1e-9 + 1e-6 * ab.r) << a.z << " " << b.z;
      ASSERT_NEAR(ab.b, ba.b, 1e-9 + 1e-6 * ab.b) << a.z << " " << b.z;
    }
  });
}

TEST(Materials, AreFiniteAndNotNegativeAtAllAngles) {
  const std::vector<Real> cosines{-1, -0.5, -1e-9, 0, 1e-300, 1e-12, 1e-4, 0.3, 0.9999999999, 1};
  forEachModel([&](const MaterialModel&, const Bsdf& bsdf) {
    for (const Real cosEye : cosines)
      for (const Real cosLight : cosines)
        for (const Real phi : {0.0, 1e-9, 1.0, kPi}) {
          const Vec3 eye = world(local(cosEye, 0.5)), light = world(local(cosLight, 0.5 + phi));
          for (const Color& c :
               {evaluate(bsdf, kFrame, eye, light), scatter(bsdf, kFrame, light, eye).sum()}) {
            ASSERT_TRUE(isFinite(c)) << cosEye << " " << cosLight << " " << phi;
            ASSERT_GE(std::min(c.r, std::min(c.g, c.b)), 0) << cosEye << " " << cosLight << " " << phi;
          }
          const Real density = trace::density(bsdf, kFrame, eye, light);
          ASSERT_TRUE(std::isfinite(density) && density >= 0) << cosEye << " " << cosLight << " " << phi;
        }
  });
}

TEST(Materials, ScatterForWhittedWhatTheyEvaluate) {
  Random random(2);
  forEachModel([&](const MaterialModel&, const Bsdf& bsdf) {
    for (int i = 0; i < 100; ++i) {
      const Vec3 eye = world(local(random.uniform(0.01, 1), random.uniform(0, 7)));
      const Vec3 light = world(local(random.uniform(0.01, 1), random.uniform(0, 7)));
      const Color a = evaluate(bsdf, kFrame, eye, light) * kPi, b = scatter(bsdf, kFrame, light, eye).sum();
      ASSERT_NEAR(a.g, b.g, 1e-9 * (1 + a.g));
    }
  });
}

/// What is given back of light: by power, which does not change with the medium as radiance does.
/// The mean weight of samples whose numbers are spread evenly: multiples of powers of a root of
/// x^4 = x + 1 (Roberts 2018).
Color albedo(const Bsdf& bsdf, const Vec3& eye, int n = 12'000) {
  constexpr Real kRoot = 1.2207440846057594;
  const auto number = [](int i, Real step) {
    const Real x = 0.5 + i * step;
    return x - std::floor(x);
  };
  Color sum;
  for (int i = 0; i < n; ++i) {
    const Vec2 u{number(i, 1 / kRoot), number(i, 1 / (kRoot * kRoot))};
    if (const auto drawn =
            sample(bsdf, kFrame, eye, number(i, 1 / (kRoot * kRoot * kRoot)), u, Transport::importance))
      sum += drawn->weight;
  }
  return sum / n;
}

TEST(Materials, GiveBackNoMoreLightThanArrives) {
  forEachModel([&](const MaterialModel& model, const Bsdf& bsdf) {
    if (!model.type().keepsEnergy) return;
    Color diffuse, specular;
    bool hasBoth = false;
    forEachField(model, [&]<class Value>(const ModelField& f, const Value& value) {
      if constexpr (std::is_same_v<Value, Color>) {
        if (f.keyword == "diffuse") diffuse = value;
        if (f.keyword == "specular") specular = value, hasBoth = true;
      }
    });
    const Real most = hasBoth ? std::max(1.0, maxComponent(diffuse + specular)) : 1;
    for (const Real cosine : {1.0, 0.8, 0.5, 0.25, 0.1, 0.03})
      EXPECT_LT(maxComponent(albedo(bsdf, world(local(cosine, 0.7)), 4'000)), most + 0.01)
          << "at cosine " << cosine;
  });
}

TEST(Materials, SamplesHaveTheWeightsAndDensitiesThatAreReported) {
  Random random(3);
  forEachModel([&](const MaterialModel&, const Bsdf& bsdf) {
    for (int i = 0; i < 300; ++i) {
      const Vec3 eye = world(local(random.uniform(0.02, 1), random.uniform(0, 7)));
      const auto drawn = sample(bsdf, kFrame, eye, random.uniform(), {random.uniform(), random.uniform()});
      if (!drawn) continue;
      ASSERT_NEAR(length(drawn->toLight), 1, 1e-9);
      const Real density = trace::density(bsdf, kFrame, eye, drawn->toLight);
      ASSERT_NEAR(density / drawn->density, 1, 1e-4);
      const Color value = evaluate(bsdf, kFrame, eye, drawn->toLight);
      ASSERT_NEAR(value.g, drawn->weight.g * drawn->density, 1e-3 * value.g + 1e-9);
    }
  });
}

/// How often samples are expected, and found, in the cells of the sphere around a surface.
class HitCells {
 public:
  static constexpr int kAcross = 20, kAround = 40, kCoarse = 3, kFine = 14;

  HitCells(const Bsdf& bsdf, const Vec3& eye) : expected_(kAcross * kAround), found_(kAcross * kAround) {
    constexpr Real kHigh = kPi / kAcross, kWide = 2 * kPi / kAround;
    for (int i = 0; i < kAcross; ++i)
      for (int j = 0; j < kAround; ++j) {
        Real most = 0, sum = 0;
        const auto look = [&](int n) {  // at the middles of n x n parts
          most = sum = 0;
          for (int k = 0; k < n * n; ++k) {
            const Real theta = (i + (k / n + 0.5) / n) * kHigh, phi = (j + (k % n + 0.5) / n) * kWide;
            const Real found = density(bsdf, kFrame, eye, world(local(std::cos(theta), phi)));
            most = std::max(most, found);
            sum += std::sin(theta) * found * kHigh * kWide / (n * n);
          }
        };
        look(kCoarse);
        if (most * kHigh * kWide > 1e-4) look(kFine);  // else it is dark there
        expected_[at(i, j)] = sum;
      }
  }

  Real total() const {
    Real sum = 0;
    for (const Real e : expected_) sum += e;
    return sum;
  }
  void count(const Vec3& direction) {
    const Vec3 d = kFrame.basis().toLocal(direction);
    const Real theta = std::acos(std::clamp(d.z, -1.0, 1.0)), phi = std::atan2(d.y, d.x);
    const int i = std::min(kAcross - 1, static_cast<int>(theta / kPi * kAcross));
    const int j =
        std::min(kAround - 1, static_cast<int>((phi < 0 ? phi + 2 * kPi : phi) / (2 * kPi) * kAround));
    ++found_[at(i, j)];
  }
  /// Pearson's chi-square of n samples, as a standard normal deviate (Wilson and Hilferty 1931). HitCells
  /// where less than five are expected are taken together.
  Real deviate(int n) const {
    Real chi = 0, fewExpected = 0, fewFound = 0;
    int cells = 0;
    const auto add = [&](Real expected, Real found) {
      chi += (found - expected) * (found - expected) / expected;
      ++cells;
    };
    for (std::size_t i = 0; i < expected_.size(); ++i) {
      const Real e = expected_[i] * n, f = found_[i];
      if (e >= 5)
        add(e, f);
      else
        fewExpected += e, fewFound += f;
    }
    if (fewExpected >= 5) add(fewExpected, fewFound);
    const Real k = cells - 1;
    if (k < 1) return 0;
    return (std::cbrt(chi / k) - (1 - 2 / (9 * k))) / std::sqrt(2 / (9 * k));
  }

 private:
  static std::size_t at(int i, int j) { return static_cast<std::size_t>(i * kAround + j); }
  std::vector<Real> expected_;
  std::vector<int> found_;
};

/// Chi-square of n samples in k cells goes beyond the bound of 4.5 deviations where the density is wrong by
/// sqrt(4.5 sqrt(2 k) / n) of itself in the root mean square: 8 % with 20,000 samples and 400 cells.
TEST(Materials, SamplesAreAsDenseAsTheySay) {
  const int n = test::thorough() ? 1'000'000 : kSanitized ? 5'000 : 20'000;
  Random random(4);
  forEachModel([&](const MaterialModel&, const Bsdf& bsdf) {
    for (const Real cosine : {0.95, 0.4}) {
      const Vec3 eye = world(local(cosine, 2.1));
      HitCells cells(bsdf, eye);
      EXPECT_NEAR(cells.total(), 1, 3e-3) << "at cosine " << cosine;
      int drawn = 0;
      for (int i = 0; i < n; ++i)
        if (const auto s = sample(bsdf, kFrame, eye, random.uniform(), {random.uniform(), random.uniform()}))
          cells.count(s->toLight), ++drawn;
      EXPECT_GT(drawn, n * 0.999);
      EXPECT_LT(cells.deviate(n), 4.5) << "at cosine " << cosine;
    }
  });
}

// --- mixtures and conversions
// ---------------------------------------------------------------------------------

TEST(Materials, MixturesOfModelsAddWhatTheirPartsScatter) {
  const Bsdf a = bsdfOf(Lambert{}, {}), b = bsdfOf(OrenNayar{}, {});
  Phong shiny;
  shiny.specular = Color(0.5), shiny.shininess = 10, shiny.index = 2;
  const Bsdf c = bsdfOf(shiny, {}), mixed = mix(a, b, c, {0.5, 0.3, 0.2});
  const Vec3 eye = world(local(0.5, 1)), light = world(local(0.7, 4));
  const auto value = [&](const Bsdf& bsdf) { return evaluate(bsdf, kFrame, eye, light).r; };
  EXPECT_NEAR(value(mixed), 0.5 * value(a) + 0.3 * value(b) + 0.2 * value(c), 1e-15);
  EXPECT_NEAR(whitted(mixed).index, 1.2, 1e-15);
  HitCells cells(mixed, eye);
  EXPECT_NEAR(cells.total(), 1, 2e-3);
  Random random(5);
  for (int i = 0; i < 40'000; ++i)
    cells.count(sample(mixed, kFrame, eye, random.uniform(), {random.uniform(), random.uniform()})->toLight);
  EXPECT_LT(cells.deviate(40'000), 4);
  EXPECT_TRUE(mix(a, a, a, {0.2, 0.3, 0.5}).is<LambertBsdf>()) << "of one model: its fields";
}

TEST(Materials, AnotherModelKeepsTheFieldsThatBothHave) {
  for (const NamedModel& m : test::variedModels()) {
    const Lambert lambert = *converted(m.model, Lambert{}).as<Lambert>();
    const MaterialModel usual(m.model.type());
    const std::vector<ModelField> said = m.model.fields(), unsaid = usual.fields();
    for (std::size_t i = 0; i < said.size(); ++i) {
      if (said[i].keyword == "shadow") {
        EXPECT_EQ(lambert.shadow, valueOf<Real>(said[i])) << m.name;
      } else if (said[i].keyword == "diffuse") {
        EXPECT_EQ(lambert.diffuse,
                  sameValue(said[i], unsaid[i]) ? Lambert().diffuse : valueOf<Color>(said[i]))
            << m.name;
      }
    }
    EXPECT_EQ(converted(m.model, m.model), m.model) << m.name;
  }
  EXPECT_EQ(*converted(Phong{}, Coated{}).as<Coated>(), Coated{}) << "what nobody said is no value";
  Material material{
      "", Phong{}, {{"diffuse", pictureTexture("a.png")}, {"specular", pictureTexture("b.png")}}};
  EXPECT_EQ(withModel(material, Lambert{}).textures.size(), 1u);
}

// --- exact values
// -----------------------------------------------------------------------------------------------

TEST(Materials, LambertGivesBackItsReflectance) {
  const Bsdf bsdf = with<Lambert>([](Lambert& m) { m.diffuse = {0.3, 0.6, 0.9}; });
  for (const Real cosine : {1.0, 0.3, 0.01}) {
    const Color a = albedo(bsdf, world(local(cosine, 1)), 50);
    EXPECT_NEAR(a.r, 0.3, 1e-12);
    EXPECT_NEAR(a.b, 0.9, 1e-12);
  }
}

TEST(Materials, OrenNayarWithoutRoughnessIsLambert) {
  const Bsdf rough = with<OrenNayar>([](OrenNayar& m) { m.diffuse = Color(0.5), m.roughness = 0; });
  const Bsdf even = with<Lambert>([](Lambert& m) { m.diffuse = Color(0.5); });
  const Vec3 eye = world(local(0.3, 0)), light = world(local(0.2, 1));
  EXPECT_EQ(evaluate(rough, kFrame, eye, light), evaluate(even, kFrame, eye, light));
  // Equation 30 at 30 and 60 degrees, 45 degrees apart, sigma = 0.5: A = 0.7844828, B = 0.3308824.
  const Bsdf half = with<OrenNayar>([](OrenNayar& m) { m.diffuse = Color(1), m.roughness = 0.5; });
  const Vec3 a = local(std::cos(kPi / 6), 0), b = local(std::cos(kPi / 3), kPi / 4);
  const Real expected =
      (0.78448275862 + 0.33088235294 * std::cos(kPi / 4) * std::sin(kPi / 3) * std::tan(kPi / 6)) / kPi;
  EXPECT_NEAR(evaluate(half, kFrame, world(a), world(b)).r / b.z, expected, 1e-9);
}

TEST(Materials, WhiteOnesVanishInAWhiteFurnace) {
  const auto expectWhite = [](const Bsdf& bsdf) {
    for (const Real cosine : {1.0, 0.7, 0.4, 0.2, 0.1})
      EXPECT_NEAR(albedo(bsdf, world(local(cosine, 0.3)), 60'000).g, 1, 0.01) << "at cosine " << cosine;
  };
  for (const Distribution kind : {Distribution::ggx, Distribution::beckmann})
    for (const Real roughness : {0.2, 0.5, 0.8, 1.0}) {
      SCOPED_TRACE(roughness);
      expectWhite(with<Conductor>(
          [&](Conductor& m) { m.color = Color(1), m.roughness = roughness, m.distribution = kind; }));
      expectWhite(with<Coated>(
          [&](Coated& m) { m.diffuse = Color(1), m.roughness = roughness, m.distribution = kind; }));
    }
  for (const Real metallic : {0.0, 1.0})
    expectWhite(with<Principled>([&](Principled& m) { m.color = Color(1), m.metallic = metallic; }));
  expectWhite(with<Lambert>([](Lambert& m) { m.diffuse = Color(1); }));
}

TEST(Materials, PrincipledPlasticMirrorsAsStronglyAndInTheColourSaid) {
  const auto plastic = [](Real strength, const Color& tint, Real roughness = 0.4) {
    return with<Principled>([&](Principled& m) {
      m.color = Color(1), m.roughness = roughness;
      m.specularStrength = strength, m.specularColor = tint;
    });
  };
  const Vec3 eye = world(local(0.8, 0)), light = world(local(0.7, 2.8));
  const Color none = evaluate(plastic(0, Color(1)), kFrame, eye, light),
              half = evaluate(plastic(0.5, Color(1)), kFrame, eye, light),
              whole = evaluate(plastic(1, Color(1)), kFrame, eye, light);
  EXPECT_NEAR(none.g, 0.7 / kPi, 1e-12) << "Lambert";
  EXPECT_NEAR(half.g, (none.g + whole.g) / 2, 1e-12);
  for (const Real strength : {0.0, 0.5})
    for (const Real cosine : {1.0, 0.4, 0.1})
      EXPECT_NEAR(albedo(plastic(strength, Color(1)), world(local(cosine, 0.3))).g, 1, 0.01) << "a furnace";
  // Along the normal 0.04 times the tint, and no more than all.
  const Color along = mirrorWeight(plastic(1, {2, 0.5, 100}, 0), 1);
  EXPECT_NEAR(along.g / along.r, 0.25, 1e-12);
  EXPECT_NEAR(along.b / along.r, 1 / 0.08, 1e-9);
}

TEST(Materials, MetalsMirrorAsMeasured) {
  EXPECT_NEAR(fresnelConductor(1, 0.2, 3.9), 0.951952, 1e-6);
  const auto color = [](Metal metal) {
    Conductor conductor;
    conductor.metal = metal, conductor.color = Color(1);
    return conductor.mirrored(1);
  };
  const Color aluminium = color(Metal::aluminium), gold = color(Metal::gold), copper = color(Metal::copper);
  EXPECT_GT(aluminium.g, 0.91);
  EXPECT_LT(aluminium.g, 0.925);
  EXPECT_NEAR(gold.r, 0.98, 1e-3);
  EXPECT_NEAR(gold.g, 0.7823, 1e-3);
  EXPECT_NEAR(gold.b, 0.3435, 1e-3);
  EXPECT_GT(copper.r, copper.g * 1.3) << "red";
  EXPECT_GT(copper.g, copper.b) << "rather than pink";
}

TEST(Materials, SmoothOnesOnlyMirror) {
  const Bsdf mirror = with<Conductor>([](Conductor& m) { m.color = Color(0.5), m.roughness = 0; });
  EXPECT_FALSE(scatters(mirror));
  EXPECT_TRUE(mirrorIsExact(mirror));
  EXPECT_NEAR(mirrorWeight(mirror, 1).r, 0.5, 1e-12);
  EXPECT_NEAR(mirrorWeight(mirror, 0).r, 1, 1e-12);
  EXPECT_FALSE(sample(mirror, kFrame, world({0, 0, 1}), 0.5, {0.5, 0.5}));
  const Bsdf varnish = with<Coated>([](Coated& m) { m.diffuse = Color(1), m.roughness = 0; });
  EXPECT_NEAR(mirrorWeight(varnish, 1).r, 0.04, 1e-12);
  for (const Real cosine : {1.0, 0.3}) {
    const Real base = albedo(varnish, world(local(cosine, 0))).r;
    EXPECT_NEAR(base + mirrorWeight(varnish, cosine).r, 1, 0.005) << "what is not mirrored comes back evenly";
  }
}

// --- glass
// ------------------------------------------------------------------------------------------------------

/// f(a, b) / n_b^2 = f(b, a) / n_a^2, where n is the index on the side of a direction.
TEST(RoughGlass, IsReciprocalAcrossItsSurface) {
  Random random(6);
  for (const auto& [index, compensated] :
       {std::pair{1.5, false}, std::pair{0.7, false}, std::pair{1.5, true}, std::pair{0.7, true}}) {
    const Bsdf glass = with<RoughGlass>([&, n = index, c = compensated](RoughGlass& m) {
      m.roughness = 0.6, m.index = n, m.compensated = c;
    });
    int lit = 0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3 out = local(random.uniform(0.02, 1), random.uniform(0, 7));
      const Vec3 in = local(-random.uniform(0.02, 1), random.uniform(0, 7));
      const Real toOut = evaluate(glass, kFrame, world(out), world(in)).g / -in.z;
      const Real toIn = evaluate(glass, kFrame, world(in), world(out)).g / out.z;
      ASSERT_NEAR(toOut, toIn / (index * index), 1e-9 + 1e-6 * toOut);
      lit += toOut > 0.01;
    }
    EXPECT_GT(lit, 500);
  }
}

TEST(RoughGlass, LosesOnlyWhatMeetsSeveralFacets) {
  for (const bool inside : {false, true})
    for (const auto& [roughness, least] : {std::pair{0.2, 0.99}, std::pair{0.5, 0.8}, std::pair{1.0, 0.4}}) {
      const Bsdf glass = with<RoughGlass>([&, r = roughness](RoughGlass& m) { m.roughness = r; });
      for (const Real cosine : {1.0, 0.7, 0.4}) {
        const Real all = albedo(glass, world(local(inside ? -cosine : cosine, 0.3))).g;
        EXPECT_LT(all, 1.001) << roughness << " " << cosine;
        EXPECT_GT(all, least) << roughness << " " << cosine << (inside ? " inside" : "");
      }
    }
}

TEST(RoughGlass, LosesNothingWhereItIsCompensated) {
  for (const Distribution kind : {Distribution::ggx, Distribution::beckmann})
    for (const Real index : {1.5, 2.3, 0.7})
      for (const Real roughness : {0.15, 0.5, 0.77, 1.0}) {
        const Bsdf glass = with<RoughGlass>([&](RoughGlass& m) {
          m.roughness = roughness, m.index = index, m.distribution = kind, m.compensated = true;
        });
        for (const Real cosine : {1.0, 0.7, 0.4, 0.2, -1.0, -0.8, -0.45, -0.15})
          EXPECT_NEAR(albedo(glass, world(local(cosine, 0.3)), 4000).g, 1, 0.01)
              << "roughness " << roughness << ", index " << index << ", cosine " << cosine;
      }
}

TEST(RoughGlass, KnowsWhichSideIsInside) {
  const Bsdf glass = with<RoughGlass>([](RoughGlass&) {});
  const Frame turned{-kFrame.normal, kFrame.along, true};
  const Vec3 eye = world(local(-0.8, 0.4)), light = world(local(0.6, 3));
  EXPECT_GT(evaluate(glass, kFrame, eye, light).g, 0);
  EXPECT_NEAR(evaluate(glass, kFrame, eye, light).g, evaluate(glass, turned, eye, light).g, 1e-12)
      << "a normal that was turned to the eye says so";
}

TEST(RoughGlass, OfRoughnessZeroIsGlass) {
  const Bsdf glass = with<RoughGlass>([](RoughGlass& m) { m.roughness = 0; });
  EXPECT_FALSE(scatters(glass));
  EXPECT_EQ(whitted(glass).sharp, 1);
  EXPECT_EQ(whitted(glass).passage, Passage::byFresnel);
}

TEST(ThinFilm, OfNoThicknessIsNotThere) {
  for (const Real cosine : {1.0, 0.5, 0.1}) {
    const Real bare = fresnelDielectric(cosine, 1, 1.5);
    EXPECT_NEAR((ThinFilm{1.33, 1.5, 0}.mirrored(cosine, 550)), bare, 1e-12);
    EXPECT_NEAR((ThinFilm{1.33, 1.5, 0}.mirrored(cosine).g), bare, 1e-4);
  }
  EXPECT_NEAR((ThinFilm{1.33, 1, 0}.mirrored(1).g), 0, 1e-4) << "the black film of a bubble that bursts";
}

TEST(ThinFilm, CancelsAndAddsByTheWavelength) {
  const Real coat = std::sqrt(1.5);
  EXPECT_NEAR((ThinFilm{coat, 1.5, 550 / coat / 4}.mirrored(1, 550)), 0, 1e-12) << "a lens with its coat";
  const Real bare = (1.33 - 1) / (1.33 + 1), most = 2 * bare / (1 + bare * bare);
  EXPECT_NEAR((ThinFilm{1.33, 1, 550 / 1.33 / 4}.mirrored(1, 550)), most * most, 1e-12) << "both faces";
  EXPECT_NEAR((ThinFilm{1.33, 1, 550 / 1.33 / 2}.mirrored(1, 550)), 0, 1e-12);
}

/// By the sum over wavelengths that the tables stand for.
TEST(ThinFilm, WhiteLightIsTheSumOverWavelengths) {
  for (const ThinFilm film : {ThinFilm{1.33, 1, 300}, ThinFilm{1.47, 1.33, 450}, ThinFilm{2.4, 1.5, 120}})
    for (const Real cosine : {1.0, 0.6, 0.2}) {
      Color sum, weights;
      for (int nm = 400; nm <= 700; nm += 5) {
        sum += spectralColor(nm) * film.mirrored(cosine, nm);
        weights += spectralColor(nm);
      }
      const Color white = film.mirrored(cosine);
      EXPECT_NEAR(white.r, std::clamp(sum.r / weights.r, 0.0, 1.0), 2e-4);
      EXPECT_NEAR(white.g, std::clamp(sum.g / weights.g, 0.0, 1.0), 2e-4);
      EXPECT_NEAR(white.b, std::clamp(sum.b / weights.b, 0.0, 1.0), 2e-4);
    }
  const Color thick = ThinFilm{1.33, 1, 9000}.mirrored(1);
  EXPECT_NEAR(thick.r, thick.b, 1e-3) << "a thick one has no colour";
}

TEST(ThinFilm, OfNoThicknessOnMetalIsBareMetal) {
  for (const Real index : {1.33, 2.4})
    for (const auto& [eta, k] : {std::pair{0.2, 3.9}, std::pair{2.7, 3.4}, std::pair{5.8, 0.0}})
      for (const Real cosine : {1.0, 0.6, 0.2}) {
        const ThinFilm film{index, 1, 0};
        const Real bare = fresnelConductor(cosine, eta, k);
        EXPECT_NEAR(film.mirroredOn(eta, k, cosine, 550), bare, 1e-12);
        EXPECT_NEAR(film.mirroredOn({Color(eta), Color(k)}, cosine).g, bare, 1e-4);
      }
}

/// By the characteristic matrix of a layer (Born and Wolf, section 1.6.2; Macleod, Thin-Film Optical Filters,
/// section 2.5), with admittances in place of amplitudes.
Real byMatrix(Real index, Real thickness, std::complex<Real> metal, Real cosine, Real wavelength) {
  using Complex = std::complex<Real>;
  const Real sine2 = 1 - cosine * cosine, inFilm = std::sqrt(1 - sine2 / (index * index));
  const Complex inMetal = std::sqrt(1.0 - sine2 / (metal * metal)), i(0, 1);
  const Real phase = 2 * kPi * index * inFilm * thickness / wavelength;
  Real sum = 0;
  for (const bool inPlane : {false, true}) {
    const Real before = inPlane ? 1 / cosine : cosine, film = inPlane ? index / inFilm : index * inFilm;
    const Complex behind = inPlane ? metal / inMetal : metal * inMetal;
    const Complex b = std::cos(phase) - i * std::sin(phase) / film * behind,
                  c = std::cos(phase) * behind - i * film * std::sin(phase);
    sum += std::norm((before * b - c) / (before * b + c)) / 2;
  }
  return sum;
}

TEST(ThinFilm, OnMetalMirrorsAsItsMatrixSays) {
  EXPECT_NEAR(byMatrix(1.47, 400, 1.5, 0.7, 500), (ThinFilm{1.47, 1.5, 400}.mirrored(0.7, 500)), 1e-12);
  for (const Real thickness : {20.0, 130.0, 777.0})
    for (const auto& [eta, k] : {std::pair{0.2, 3.9}, std::pair{2.7, 3.4}, std::pair{1.2, 7.0}})
      for (const Real cosine : {1.0, 0.6, 0.1})
        for (const Real wavelength : {420.0, 550.0, 690.0}) {
          const ThinFilm film{2.4, 1, thickness};
          const Real expected = byMatrix(2.4, thickness, {eta, k}, cosine, wavelength);
          EXPECT_NEAR(film.mirroredOn(eta, k, cosine, wavelength), expected, 1e-12)
              << thickness << " nm, " << eta << " + " << k << " i, " << cosine << ", " << wavelength;
        }
}

TEST(ThinFilm, OnMetalWhiteLightIsTheSumOverWavelengths) {
  const ComplexIndex gold = indexOf(Metal::gold);
  for (const Real thickness : {50.0, 300.0, 900.0})
    for (const Real cosine : {1.0, 0.3}) {
      const ThinFilm film{2.1, 1, thickness};
      Color sum, weights;
      for (int nm = 400; nm <= 700; nm += 5) {
        sum += spectralColor(nm) * Color{film.mirroredOn(gold.eta.r, gold.k.r, cosine, nm),
                                         film.mirroredOn(gold.eta.g, gold.k.g, cosine, nm),
                                         film.mirroredOn(gold.eta.b, gold.k.b, cosine, nm)};
        weights += spectralColor(nm);
      }
      const Color white = film.mirroredOn(gold, cosine);
      EXPECT_NEAR(white.r, std::clamp(sum.r / weights.r, 0.0, 1.0), 5e-4);
      EXPECT_NEAR(white.g, std::clamp(sum.g / weights.g, 0.0, 1.0), 5e-4);
      EXPECT_NEAR(white.b, std::clamp(sum.b / weights.b, 0.0, 1.0), 5e-4);
    }
}

TEST(ThinFilm, ColoursTheMetalAndWhatIridesces) {
  const auto along = [](const Bsdf& bsdf) { return mirrorWeight(bsdf, 0.8); };
  const ThinFilm film{2.4, 1, 60};
  const Bsdf gold = with<Conductor>(
      [](Conductor& m) { m.metal = Metal::gold, m.color = Color(1), m.roughness = 0, m.film = 60; });
  EXPECT_EQ(along(gold), film.mirroredOn(indexOf(Metal::gold), 0.8));
  // What glTF calls metal of a colour absorbs nothing: F0 = ((n - 1) / (n + 1))^2.
  EXPECT_NEAR(indexMirroring(Color(0.04)).eta.g, 1.5, 1e-12);
  const auto metal = [&](Real iridescence) {
    return with<Principled>([&](Principled& m) {
      m.metallic = 1, m.color = {0.9, 0.5, 0.3}, m.roughness = 0, m.iridescence = iridescence;
      m.iridescenceIndex = 1.8, m.iridescenceThickness = 250;
    });
  };
  const Color bare = along(metal(0)), half = along(metal(0.5)), whole = along(metal(1));
  EXPECT_NEAR(half.r, (bare.r + whole.r) / 2, 1e-12);
  const auto onMetal = [](Real nanometres) {
    return ThinFilm{1.8, 1, nanometres}.mirroredOn(indexMirroring(Color(0.5)), 0.8).g;
  };
  EXPECT_NEAR((whole.g - bare.g) * (schlick(0.8, Color(0.5)).g / bare.g), onMetal(250) - onMetal(0), 1e-12)
      << "what the film changes, in one facet";
  const auto plastic = [&](Real iridescence) {
    return along(with<Principled>([&](Principled& m) { m.roughness = 0, m.iridescence = iridescence; }));
  };
  EXPECT_GT(std::abs(plastic(1).r - plastic(1).b), 0.005) << "colours";
  EXPECT_NEAR(plastic(0).r, plastic(0).b, 1e-12) << "none without";
}

TEST(ThinGlass, GivesBackAllLight) {
  const auto shares = [](Real index, Real film, Real cosine) {
    ThinGlass glass;
    glass.index = index, glass.film = film;
    return glass.shares(cosine);
  };
  for (const Real film : {0.0, 350.0})
    for (const Real cosine : {1.0, 0.4, 0.05, 0.0}) {
      const auto [mirrored, passed] = shares(1.4, film, cosine);
      EXPECT_NEAR((mirrored + passed).r, 1, 1e-12);
      EXPECT_NEAR((mirrored + passed).b, 1, 1e-12);
    }
  // A pane of R = 0.04 mirrors 2 R / (1 + R), to and fro included.
  EXPECT_NEAR(shares(1.5, 0, 1).mirrored.g, 0.08 / 1.04, 1e-12);
  EXPECT_EQ(shares(1, 0, 0.3).passed, Color(1)) << "index 1 is not there";
  const Bsdf pane = with<ThinGlass>([](ThinGlass& m) { m.color = {0.5, 1, 1}; });
  EXPECT_FALSE(scatters(pane));
  EXPECT_LT(passWeight(pane, 0.3).r, passWeight(pane, 1).r) << "a longer way inside";
}

// --- strands and drawings
// ------------------------------------------------------------------------------------------------------

TEST(Marschner, WhiteStrandsGiveBackAllLight) {
  const Bsdf strand = with<Marschner>([](Marschner& m) { m.color = Color(1); });
  for (const Real cosine : {1.0, 0.6, 0.2})
    EXPECT_NEAR(albedo(strand, world(local(cosine, 0.4)), 50'000).g, 1, 0.01) << cosine;
}

TEST(Marschner, PigmentsAbsorbAsTheirConcentrationSays) {
  Marschner hair;
  hair.eumelanin = 2, hair.pheomelanin = 0.5;
  EXPECT_NEAR(hair.absorption().g, 2 * 0.697 + 0.5 * 0.4, 1e-12);
  Marschner same;  // the colour of a head is that whose absorption is the pigments'
  same.color = hair.headColor();
  EXPECT_NEAR(same.absorption().r, hair.absorption().r, 1e-9);
  EXPECT_NEAR(same.absorption().b, hair.absorption().b, 1e-9);
  const auto brightness = [](Real eumelanin) {
    const Bsdf strand = with<Marschner>([&](Marschner& m) { m.eumelanin = eumelanin; });
    return albedo(strand, world(local(0.6, 0.4)), 20'000);
  };
  const Color blond = brightness(0.3), brown = brightness(1.3), black = brightness(8);
  EXPECT_GT(blond.g, 1.3 * brown.g);
  EXPECT_GT(brown.g, 1.3 * black.g);
  EXPECT_GT(blond.r, blond.g);
  EXPECT_GT(blond.g, blond.b);
}

TEST(Marschner, LightComesThroughAndIsColoured) {
  const Bsdf strand = with<Marschner>([](Marschner& m) { m.color = {0.8, 0.4, 0.1}, m.angle = 0; });
  const Vec3 eye = world({0, 0, 1});
  const Color front = evaluate(strand, kFrame, eye, world(normalize(Vec3{0, 0.3, 1})));
  const Color through = evaluate(strand, kFrame, eye, world({0, 0, -1}));
  EXPECT_GT(through.r, 1.3 * through.b) << "by what it absorbs";
  EXPECT_GT(front.b / front.r, 1.1 * through.b / through.r) << "the first highlight is white";
  EXPECT_TRUE(whitted(strand).litThrough);
}

TEST(Cel, RampsGiveTheColoursOfLight) {
  const Bsdf cel = with<Cel>([](Cel& m) {
    m.diffuse = Color(1);
    m.ramp = {{0, 0.1, 0, 0}, {0.5, 0.1, 0, 0}, {0.5, 0, 0.7, 0}};
  });
  const Vec3 eye = world({0, 0, 1});
  const auto at = [&](Real cosine) { return scatter(cel, kFrame, world(local(cosine, 0)), eye).sum(); };
  EXPECT_NEAR(at(0.4).r, 0.1, 1e-12);
  EXPECT_NEAR(at(0.6).g, 0.7, 1e-12);
  EXPECT_NEAR(at(-0.6).r, 0.1, 1e-12) << "the side away has the first";
}

TEST(Hatching, IsInkWhereLightIsBelowTheScreen) {
  const Bsdf drawn = with<Hatching>([](Hatching& m) { m.screen = 0.5, m.softness = 0; });
  const Vec3 eye = world({0, 0, 1});
  const auto at = [&](Real cosine) { return scatter(drawn, kFrame, world(local(cosine, 0)), eye).sum(); };
  EXPECT_NEAR(at(0.51).r, Hatching().paper.r, 1e-12);
  EXPECT_NEAR(at(0.49).r, Hatching().ink.r, 1e-12);
}

TEST(Fresnel, OfDielectrics) {
  const auto at = [](Real degrees, Real before, Real behind) {
    return fresnelDielectric(std::cos(degrees * kPi / 180), before, behind);
  };
  const Real expected[][2] = {{0, 0.04},      {30, 0.041523}, {45, 0.050240},
                              {60, 0.089187}, {75, 0.253061}, {85, 0.612800}};
  for (const auto& [degrees, share] : expected) EXPECT_NEAR(at(degrees, 1, 1.5), share, 1e-6) << degrees;
  EXPECT_NEAR(at(56.30993, 1, 1.5), 0.073964, 1e-6) << "Brewster's angle";
  EXPECT_EQ(at(41.811, 1.5, 1), 1);
  EXPECT_LT(at(41.80, 1.5, 1), 1);
  EXPECT_NEAR(at(19.47122063449069, 1.5, 1), at(30, 1, 1.5), 1e-12) << "the same from both sides";
}

// --- principled: a sheet, and a coat with a normal of its own ---------------------------------------------

Color sheetAt(const Vec3& eye, const Vec3& light, Real metallic, Real transmission) {
  Principled model;
  model.color = {1, 0.5, 0.25};
  model.roughness = 0.5;
  model.metallic = metallic;
  model.transmission = transmission;
  return evaluate(bsdfOf(model, {}), Frame{{0, 0, 1}}, eye, light);
}

TEST(PrincipledSheet, WhatFacetsDoNotMirrorGoesStraightOn) {
  // Along the normal: D = 1 / (pi a^2) with a = roughness^2, nothing is hidden, and 4 % is mirrored.
  const Color through = sheetAt({0, 0, 1}, {0, 0, -1}, 0.5, 0.6);
  const Real expected = 0.3 * 0.96 / (4 * kPi * 0.0625);
  EXPECT_NEAR(through.r, expected, 1e-12);
  EXPECT_NEAR(through.g, expected / 2, 1e-12);
  EXPECT_EQ(sheetAt({0, 0, 1}, {0, 0, -1}, 1, 0.6), Color(0)) << "metal";
  EXPECT_EQ(sheetAt({0, 0, 1}, {0, 0, -1}, 0, 0), Color(0));
  // It comes back the same way.
  const Vec3 a = normalize({0.3, 0.1, 1}), b = normalize({-0.5, 0.2, -1});
  const Frame behind{{0, 0, -1}};
  Principled model;
  model.transmission = 0.7;
  model.clearcoat = 0.5;
  model.sheen = Color(0.3);
  const Bsdf bsdf = bsdfOf(model, {});
  EXPECT_NEAR(evaluate(bsdf, Frame{{0, 0, 1}}, a, b).g / -b.z, evaluate(bsdf, behind, b, a).g / a.z, 1e-12);
}

TEST(PrincipledSheet, KeepsLight) {
  Principled model;
  model.color = Color(1);
  model.roughness = 0.3;
  model.transmission = 1;
  for (const Real transmission : {0.4, 1.0})
    for (const Real cosine : {1.0, 0.5, 0.2}) {
      model.transmission = transmission;
      const Real back = albedo(bsdfOf(model, {}), world(local(cosine, 0.7))).g;
      EXPECT_LT(back, 1.005) << transmission << " " << cosine;
      EXPECT_GT(back, 0.9) << transmission << " " << cosine;
    }
  const Bsdf bsdf = bsdfOf(model, {});
  EXPECT_EQ(whitted(bsdf).passage, Passage::straight);
  model.roughness = 0;
  EXPECT_NEAR(passWeight(bsdfOf(model, {}), 1).g, 0.96, 1e-4);
}

TEST(PrincipledCoat, MirrorsAroundItsOwnNormal) {
  Principled model;  // nothing but the coat is seen
  model.color = Color(0);
  model.specularStrength = 0;
  model.clearcoat = 1;
  model.clearcoatRoughness = 0.4;
  const Bsdf bsdf = bsdfOf(model, {});
  const Vec3 up{0, 0, 1}, coat = normalize({0.2, 0.1, 1});
  Frame apart{up};
  apart.coat = coat;
  const Vec3 eye = normalize({0.1, -0.3, 1});
  for (const Vec3& light : {normalize({0.5, 0.4, 1}), normalize({-0.3, 0.2, 1})}) {
    const Real there = evaluate(bsdf, Frame{coat}, eye, light).g;
    EXPECT_GT(there, 0.001);
    EXPECT_NEAR(evaluate(bsdf, apart, eye, light).g, there, 1e-12);
    EXPECT_NE(evaluate(bsdf, Frame{up}, eye, light).g, there);
  }
  Random random(11);
  for (int i = 0; i < 200; ++i) {
    const auto drawn = sample(bsdf, apart, eye, random.uniform(), {random.uniform(), random.uniform()});
    if (!drawn) continue;
    EXPECT_NEAR(density(bsdf, apart, eye, drawn->toLight) / drawn->density, 1, 1e-9);
  }
}

TEST(Materials, PhongHasBrillianceAndAMirrorThatGains) {
  Phong phong;
  phong.diffuse = Color(0.5);
  phong.brilliance = 3;
  phong.reflective = Color(0.1);
  phong.grazing = Color(0.8);
  phong.grazingExponent = 2;
  const PhongBsdf bsdf = phong.at({});
  const Vec3 normal{0, 0, 1}, light = normalize(Vec3{1, 0, 1});
  EXPECT_NEAR(bsdf.scatter(normal, light, normal).diffuse.r, 0.5 * std::pow(0.5, 1.5), 1e-12);
  EXPECT_NEAR(bsdf.mirrorWeight(1).r, 0.1, 1e-12);
  EXPECT_NEAR(bsdf.mirrorWeight(0.5).r, 0.1 + 0.8 * 0.25, 1e-12);
  EXPECT_NEAR(bsdf.mirrorWeight(0).r, 0.9, 1e-12);
  phong.reflective = {};
  EXPECT_TRUE(phong.at({}).mirrors()) << "at grazing angles";
}

}  // namespace
}  // namespace trace

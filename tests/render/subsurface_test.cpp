// Bodies in which light spreads: three ways against one another and against closed forms.
#include "render/paths/subsurface.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "render/photons/photons.h"
#include "render/picture/explain.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "shading/materials/subsurface.h"
#include "support/half_space.h"
#include "support/rooms.h"

namespace trace::test::subsurface_test {
namespace {

constexpr std::array kWays{Spreading::dipole, Spreading::diffusion, Spreading::walk};

Settings small(IntegratorKind integrator, int spp) {
  Settings settings;
  settings.width = settings.height = 4;
  settings.integrator = integrator;
  settings.sampling = SampleKind::sobol;
  settings.spp = spp;
  settings.subsurfaceSamples = 1;
  return settings;
}
Color mean(const Scene& scene, const Settings& settings) {
  Color sum;
  const Picture all = picture(scene, settings);
  for (const Color& c : all.pixels) sum += c;
  return sum / static_cast<Real>(all.pixels.size());
}
void add(Scene& scene, const Shape& shape, const Affine& place, const Subsurface& model) {
  scene.materials.push_back({"", model, {}});
  scene.objects.push_back({"", shape, place, static_cast<std::uint32_t>(scene.materials.size() - 1), {}});
}
/// A camera that looks at a thick flat body, straight down or aslant.
Scene overSlab(const Subsurface& model, const Vec3& from = {0, 0, 10}) {
  Scene scene;
  scene.camera.position = from, scene.camera.viewdir = -from, scene.camera.fov = 1e-4;
  scene.camera.updir = {0, 1, 0};
  add(scene, Cube{}, Affine::translation({0, 0, -500}) * scaled(1000), model);
  return scene;
}
Subsurface matched(Real albedo, Spreading spreading) {
  Subsurface model;
  model.scatters = Color(albedo), model.absorbs = Color(1 - albedo);
  model.millimetres = 1, model.index = 1, model.roughness = 0;
  model.spreading = spreading;
  return model;
}

TEST(Subsurface, TheWalkInAHalfSpaceIsChandrasekhars) {
  for (const Real albedo : {0.5, 0.9, 0.98}) {
    const HalfSpace half(albedo);
    for (const Real cosine : {1.0, 0.5}) {
      Scene scene =
          overSlab(matched(albedo, Spreading::walk), Vec3{std::sqrt(1 - cosine * cosine), 0, cosine} * 10);
      scene.background.gradient = {Color(1), Color(1)};
      const Real mirrored = schlickWeight(cosine);  // what its surface mirrors, though its index is 1
      const Real expected = mirrored + (1 - mirrored) * half.reflects(cosine);
      EXPECT_NEAR(mean(scene, small(IntegratorKind::path, 400)).g / expected, 1, 0.02)
          << albedo << " " << cosine;
    }
  }
}

TEST(Subsurface, ProfilesGiveBackTheAlbedoOfTheirSurface) {
  for (const Real albedo : {0.6, 0.9, 0.99})
    for (const Real index : {1.0, 1.5}) {
      const Dipole dipole(albedo, 1 - albedo, index);
      for (const Spreading spreading : {Spreading::dipole, Spreading::diffusion}) {
        Subsurface model = matched(albedo, spreading);
        model.index = index;
        Scene scene = overSlab(model);
        scene.background.gradient = {Color(1), Color(1)};
        const Real mirrored = mirroredAlongNormal(index);
        EXPECT_NEAR(mean(scene, small(IntegratorKind::path, 400)).g,
                    mirrored + (1 - mirrored) * dipole.albedo, 0.02)
            << albedo << " " << index;
      }
    }
}

/// Diffusion is an approximation: the better, the less is swallowed (Jensen and others 2001, section 2.4).
TEST(Subsurface, TheThreeAgreeWhereLittleIsSwallowed) {
  for (const Real index : {1.0, 1.3, 1.5}) {
    std::vector<Real> found;
    for (const Spreading spreading : kWays) {
      Subsurface model = matched(0.995, spreading);
      model.index = index;
      Scene scene = overSlab(model);
      scene.background.gradient = {Color(1), Color(1)};
      found.push_back(mean(scene, small(IntegratorKind::path, 400)).g);
    }
    EXPECT_NEAR(found[0] / found[2], 1, 0.06) << index;
    EXPECT_NEAR(found[1] / found[2], 1, 0.06) << index;
  }
}

TEST(Subsurface, WhatSwallowsNothingVanishesInAnEvenSky) {
  for (const Spreading spreading : kWays) {
    Subsurface model;
    model.scatters = {3, 5, 8}, model.absorbs = Color(0);
    model.millimetres = 1, model.spreading = spreading;
    Scene scene;
    // To profiles a body that curves is flat: a large one nearly is.
    const Real radius = spreading == Spreading::walk ? 3 : 60;
    scene.camera.position = {0, 0, 5 * radius}, scene.camera.viewdir = {0, 0, -1}, scene.camera.fov = 15;
    scene.background.gradient = {Color(1), Color(1)};
    add(scene, Sphere{}, scaled(radius), model);
    Settings settings = small(IntegratorKind::path, 256);
    settings.depth = 100;
    const Color seen = mean(scene, settings);
    EXPECT_NEAR((seen.r + seen.g + seen.b) / 3, 1, spreading == Spreading::walk ? 0.002 : 0.03)
        << static_cast<int>(spreading);
    EXPECT_NEAR(seen.r, 1, 0.06) << static_cast<int>(spreading);
    EXPECT_NEAR(seen.b, 1, 0.06) << static_cast<int>(spreading);
  }
}

// Where the way of light is lost in rounding the body is a surface: as bright as one that is merely large.
TEST(Subsurface, BodiesBeyondRoundingAreSurfaces) {
  for (const Spreading spreading : {Spreading::diffusion}) {
    const auto brightness = [&](Real millimetres) {
      Subsurface model;
      model.millimetres = millimetres, model.spreading = spreading;
      Scene scene;
      scene.camera.position = {0, 0, 5}, scene.camera.viewdir = {0, 0, -1}, scene.camera.fov = 5;
      scene.background.gradient = {Color(1), Color(1)};
      add(scene, Sphere{}, {}, model);
      return mean(scene, small(IntegratorKind::path, 16)).g;
    };
    const Real large = brightness(1e6);
    for (const Real millimetres : {1e12, 1e15, 1e300})
      EXPECT_NEAR(brightness(millimetres) / large, 1, 0.02) << millimetres;
  }
}

TEST(Subsurface, WhittedAndThePathTracerGiveTheSameLightOfALamp) {
  for (const Spreading spreading : kWays) {
    Subsurface model = matched(0.95, spreading);
    model.index = 1.4, model.roughness = 0.3;
    Scene scene = overSlab(model);
    scene.lights.push_back({DirectionalLight{.direction = {0.6, 0, -0.8}, .color = Color(1)}, {}});
    Settings whitted = small(IntegratorKind::whitted, 256), path = small(IntegratorKind::path, 1024);
    whitted.depth = path.depth = 0;
    const Real a = mean(scene, whitted).g, b = mean(scene, path).g;
    EXPECT_GT(a, 0.2);
    EXPECT_NEAR(a / b, 1, 0.03) << static_cast<int>(spreading);
  }
}

TEST(Subsurface, LightComesOutBesideWhereItGoesIn) {
  for (const Spreading spreading : kWays) {
    Subsurface model = matched(0.99, spreading);
    Scene scene = overSlab(model, {0, 0.1, 10});
    // A spot of light on one side of an edge, which the camera looks at from the dark side.
    Phong black;
    addObject(scene, Cube{}, Affine::translation({-5, 0, 2}) * Affine::scaling({10, 20, 0.1}), black);
    scene.camera.position = {-0.5, 0, 1.5}, scene.camera.viewdir = {0, 0, -1};
    scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}});
    const Real near = mean(scene, small(IntegratorKind::path, 400)).g;
    scene.camera.position = {-6, 0, 1.5};
    const Real far = mean(scene, small(IntegratorKind::path, 400)).g;
    EXPECT_GT(near, 0.05) << static_cast<int>(spreading);
    EXPECT_LT(far, near / 3) << static_cast<int>(spreading);
  }
}

/// A closed room, of which the camera and a large ball of wax are inside.
Scene roomWithWax(Spreading spreading) {
  Scene scene = openRoom({0.6, 0.1, 0.1});
  addObject(scene, Square{}, wall(), diffuse(0.7));
  addObject(scene, Square{},
            Affine::translation({0, 0.99, 0}) * turned({1, 0, 0}, 0.5) * Affine::scaling({0.7, 0.7, 1}),
            diffuse(Color(0.5), 8));
  scene.camera.position = {0, 0.2, 0.95}, scene.camera.fov = 90;
  Subsurface wax;
  wax.scatters = {2.19, 2.62, 3.0}, wax.absorbs = {0.02, 0.041, 0.071};
  wax.millimetres = 5, wax.index = 1.4, wax.spreading = spreading;
  add(scene, Sphere{}, Affine::translation({0, -0.4, -0.2}) * scaled(0.6), wax);
  return scene;
}

/// The means of the picture, which are the same by every integrator that follows light; of photons and of
/// chains nearly.
TEST(Subsurface, AllIntegratorsGiveTheSameLightOfARoom) {
  const auto seen = [](const Scene& scene, IntegratorKind integrator, int spp, Chains chains = Chains::path) {
    Settings settings = small(integrator, spp);
    settings.width = settings.height = 8;
    settings.depth = 12, settings.airIndex = 1;
    settings.chains = chains, settings.chainStarts = 100000;
    settings.photons = 100000;
    return meanColor(picture(scene, settings));
  };
  for (const Spreading spreading : kWays) {
    const Scene scene = roomWithWax(spreading);
    const Color path = seen(scene, IntegratorKind::path, 512);
    const auto expectAlike = [&](const char* what, const Color& found, Real tolerance) {
      for (const auto channel : {&Color::r, &Color::g, &Color::b})
        EXPECT_NEAR(found.*channel / path.*channel, 1, tolerance)
            << what << " " << names(spreading)[static_cast<std::size_t>(spreading)];
    };
    expectAlike("bdpt", seen(scene, IntegratorKind::bdpt, 256), 0.02);
    expectAlike("photon", seen(scene, IntegratorKind::photon, 64), 0.03);
    if (spreading != Spreading::diffusion) continue;
    expectAlike("mlt", seen(scene, IntegratorKind::mlt, 512), 0.05);
    expectAlike("mlt over bdpt", seen(scene, IntegratorKind::mlt, 1024, Chains::bdpt), 0.05);
  }
}

/// In a black room all light comes to the walls that a body swallows nothing of.
TEST(Subsurface, PhotonsThatGoInComeOut) {
  for (const Spreading spreading : kWays) {
    Scene scene = openRoom();
    addObject(scene, Square{}, wall(), {});
    for (Material& material : scene.materials) material.model = diffuse(Color(1e-9));
    Subsurface milk;
    milk.scatters = {3, 5, 8}, milk.absorbs = Color(0);
    milk.millimetres = spreading == Spreading::walk ? 2 : 40;  // to profiles a ball is flat
    milk.index = 1.4, milk.spreading = spreading;
    add(scene, Sphere{}, Affine::translation({0, -0.4, 0}) * scaled(0.6), milk);
    scene.lights.push_back(
        {PointLight{.position = {0.3, 0.6, 0.1}, .color = Color(0.5), .constant = 0, .quadratic = 1}, {}});
    Settings settings = small(IntegratorKind::photon, 1);
    settings.photons = 20000, settings.depth = 20, settings.finalGather = true;
    settings.limitAttenuation = false;
    const World world = build(scene, settings);
    Job job;
    const PhotonMap map = globalMaps(world, settings, Lamps(world, 1), job).surfaces;
    Color onWalls;
    for (const Photon& photon : map.photons())
      if (length(photon.point - Vec3{0, -0.4, 0}) > 0.61) onWalls += photon.power;
    const Real sent = 4 * kPi * kPi * 0.5;
    for (const auto channel : {&Color::r, &Color::g, &Color::b})
      EXPECT_NEAR(onWalls.*channel / sent, 1, 0.02) << static_cast<int>(spreading);
  }
}

TEST(Subsurface, IsTheSameForAnyThreadsAndAsExplained) {
  for (const Spreading spreading : kWays)
    for (const IntegratorKind integrator :
         {IntegratorKind::whitted, IntegratorKind::path, IntegratorKind::bdpt, IntegratorKind::photon}) {
      Subsurface model = matched(0.95, spreading);
      model.index = 1.4, model.roughness = 0.3;
      Scene scene;
      scene.camera.position = {0, 0, 12}, scene.camera.viewdir = {0, 0, -1}, scene.camera.fov = 20;
      add(scene, Sphere{}, scaled(3), model);
      scene.lights.push_back({DirectionalLight{.direction = {0.6, 0, -0.8}, .color = Color(1)}, {}});
      Settings settings = small(integrator, 2);
      settings.width = settings.height = 20;
      settings.photons = 2000;
      settings.distortion = 1e-9;  // what paths from lights throw at the picture is not explained
      settings.threads = 1;
      const Picture one = picture(scene, settings);
      for (const int threads : {2, 7}) {
        settings.threads = threads;
        EXPECT_EQ(picture(scene, settings).pixels, one.pixels) << threads;
      }
      const World world = build(scene, settings);
      const auto explained = integratorOf(world, settings);
      int bodies = 0;
      for (int x = 6; x < 14; ++x) {
        const Explanation e =
            explain(world, *explained, settings, pictureSize(settings, scene.camera), x, 9, 1);
        EXPECT_TRUE(sumsUp(e.tree)) << x;
        EXPECT_EQ(e.pixel, one.at(x, 9)) << x;
        bodies += std::any_of(e.tree.nodes.begin(), e.tree.nodes.end(), [](const RayNode& node) {
          return std::any_of(node.terms.begin(), node.terms.end(), [](const Term& term) {
            return term.kind == Term::Kind::subsurface && !isBlack(term.factor * term.value);
          });
        });
      }
      EXPECT_GT(bodies, 0);
    }
}

}  // namespace
}  // namespace trace::test::subsurface_test

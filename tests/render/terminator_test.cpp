// The line between light and shade on coarse meshes: against the true sphere, and that no light leaks.
#include <gtest/gtest.h>

#include <algorithm>

#include "math/warp.h"
#include "render/picture/explain.h"
#include "shading/lights/directional_light.h"
#include "support/ball.h"
#include "support/scenes.h"

namespace trace::test::terminator_test {
namespace {

const Vec3 kToLight = normalize({1, 0.3, 0.2});

Phong white() {
  Phong phong;
  phong.diffuse = Color(1);
  return phong;
}

Scene ball(const std::shared_ptr<const MeshData>& mesh, const Affine& placed = {}) {
  Scene scene;
  addObject(scene, Mesh{mesh}, placed, white());
  scene.lights.push_back({DirectionalLight{.direction = -kToLight, .color = Color(1)}, {}});
  return scene;
}

/// What Whitted's integrator sees along rays.
class Eye {
 public:
  Eye(const Scene& scene, bool smooth, IntegratorKind kind = IntegratorKind::whitted)
      : settings_{.spp = kSamples, .integrator = kind, .smoothTerminator = smooth},
        world_(build(scene, settings_)),
        integrator_(integratorOf(world_, settings_)),
        rules_(settings_, {1, 1}) {}

  static constexpr int kSamples = 16;

  Real brightness(const Vec3& from, const Vec3& direction, int sample = 0) const {
    Tracer tracer(world_, settings_);
    const Ray ray{from, direction};
    const CameraRay camera(ray, tracer.interfacesAt(from),
                           [&](Interfaces& inside) { return tracer.cast(ray, RayKind::camera, inside); });
    EXPECT_TRUE(camera.hit);
    return integrator_->radiance(tracer, Sampler(rules_, 0, 0, sample), camera).g;
  }
  const World& world() const { return world_; }

 private:
  Settings settings_;
  World world_;
  std::unique_ptr<const Integrator> integrator_;
  SampleRules rules_;
};

/// Directions all around, in rings.
std::vector<Vec3> directions() {
  std::vector<Vec3> all;
  for (int i = 0; i < 100; ++i)
    for (int j = 0; j < 200; ++j)
      all.push_back(sphericalDirection(1 - 2 * (i + 0.31) / 100, 2 * kPi * (j + 0.37) / 200));
  return all;
}

/// The largest difference to the n l of the true sphere, whose normals the mesh mixes.
Real worstError(const Eye& eye) {
  Real worst = 0;
  for (const Vec3& n : directions())
    worst = std::max(worst, std::abs(eye.brightness(n * 3, -n) - std::max(0.0, dot(n, kToLight))));
  return worst;
}

TEST(SmoothTerminator, IsThatOfTheTrueSphere) {
  const Scene coarse = ball(sphereMesh(8, 4));
  EXPECT_GT(worstError(Eye(coarse, false)), 0.3);
  EXPECT_LT(worstError(Eye(coarse, true)), 1e-6);
  EXPECT_LT(worstError(Eye(coarse, true, IntegratorKind::direct)), 1e-6);
}

TEST(SmoothTerminator, KnowsNoScale) {
  for (const Real scale : {1e-4, 1e6}) {
    Scene scene = ball(sphereMesh(8, 4), Affine::scaling({scale, scale, scale}));
    const Eye eye(scene, true);
    for (const Vec3& n : directions())
      ASSERT_NEAR(eye.brightness(n * (3 * scale), -n), std::max(0.0, dot(n, kToLight)), 1e-6);
  }
}

TEST(SmoothTerminator, ChangesNothingWithoutNormalsOfItsOwn) {
  MeshData flat = *sphereMesh(8, 4);
  flat.normals.clear();
  const Scene scene = ball(std::make_shared<const MeshData>(flat));
  const Eye off(scene, false), on(scene, true);
  for (const Vec3& n : directions()) ASSERT_EQ(off.brightness(n * 3, -n), on.brightness(n * 3, -n));
}

TEST(SmoothTerminator, NoLightComesThroughAThinShell) {
  Scene scene = ball(sphereMesh(8, 4));
  addObject(scene, Mesh{sphereMesh(8, 4)}, Affine::scaling({1.001, 1.001, 1.001}), white());
  const Eye eye(scene, true);
  Statistics statistics;
  for (const Vec3& n : directions()) {
    const auto shell = eye.world().closest({n * 3, -n}, Faces::both, statistics);
    ASSERT_TRUE(shell);
    ASSERT_EQ(eye.brightness(n * (3 - shell->t - 2e-4), -n), 0) << "between the two";
  }
}

TEST(SmoothTerminator, NoLightComesIntoAClosedBody) {
  const Scene scene = ball(sphereMesh(8, 4));
  const World world = build(scene);
  const Settings settings;
  Tracer tracer(world, settings);
  for (const Vec3& n : directions()) {
    Interfaces inside = tracer.interfacesAt({});
    const auto hit = tracer.cast({{}, n}, RayKind::camera, inside);
    ASSERT_TRUE(hit);
    EXPECT_TRUE(world.raised(*hit, false).has_value());
    EXPECT_FALSE(world.raised(*hit, true).has_value()) << "from inside it is hollow";
  }
}

TEST(SmoothTerminator, OpensWhatAConvexBallSeesOfTheSky) {
  const Scene scene = ball(sphereMesh(8, 4));
  const Eye off(scene, false, IntegratorKind::occlusion), on(scene, true, IntegratorKind::occlusion);
  Real closed = 0;
  for (const Vec3& n : directions())
    for (int k = 0; k < Eye::kSamples; ++k) {
      closed += 1 - off.brightness(n * 3, -n, k);
      ASSERT_EQ(on.brightness(n * 3, -n, k), 1);
    }
  EXPECT_GT(closed, 100);
}

TEST(SmoothTerminator, IsExplained) {
  Scene scene = ball(sphereMesh(8, 4));
  scene.camera.position = {0, 0, 4};
  Settings settings{.width = 40, .smoothTerminator = true};
  const World world = build(scene, settings);
  const auto integrator = integratorOf(world, settings);
  int raised = 0;
  for (int x = 0; x < 40; ++x) {
    const Explanation why =
        explain(world, *integrator, settings, pictureSize(settings, scene.camera), x, 20, 0);
    EXPECT_TRUE(sumsUp(why.tree));
    const RayNode& seen = why.tree.nodes.front();
    if (!seen.raised) continue;
    ++raised;
    EXPECT_GT(dot(*seen.raised - seen.hit->surface.point, seen.hit->surface.normal), 0);
    for (const RayNode& node : why.tree.nodes) {
      if (node.kind == RayKind::shadow) {
        EXPECT_EQ(node.ray.origin, *seen.raised);
      }
    }
  }
  EXPECT_GT(raised, 5);
}

}  // namespace
}  // namespace trace::test::terminator_test

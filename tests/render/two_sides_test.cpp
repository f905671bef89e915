// Material::sides: what is shaded from both sides looks from behind as it does from the front.
#include <gtest/gtest.h>

#include <utility>

#include "geometry/shapes/solids/cube.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/square.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "support/ball.h"
#include "support/materials.h"
#include "support/rooms.h"

namespace trace::test::two_sides_test {
namespace {

constexpr ShadedSides kFront = ShadedSides::front, kBoth = ShadedSides::both;

Settings smallSettings(IntegratorKind kind, int samples = 8) {
  Settings settings{.width = 12, .spp = samples, .integrator = kind, .depth = 4};
  settings.threads = 1;
  settings.photons = settings.chainStarts = 4000;
  return settings;
}

/// A panel at z = 0 that fills the picture. `away`: its front is turned from the camera. `normals`: 0 for
/// none, otherwise a factor of the front's.
Shape panel(bool away, Real normals = 0) {
  MeshData mesh;
  mesh.points = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};  // by which grain lies
  const Real toFront = away ? -normals : normals;
  if (away)
    for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  if (normals != 0)
    for (const Vec3f& p : mesh.points)
      mesh.normals.push_back(Vec3f(normalize(Vec3{0.3 * p.x, 0.2 * p.y, 1}) * toFront));
  return Mesh{std::make_shared<const MeshData>(std::move(mesh))};
}

void add(Scene& scene, Shape shape, const Affine& transform, const MaterialModel& model, ShadedSides sides) {
  scene.materials.push_back({.name = "", .model = model, .sides = sides});
  scene.objects.push_back(
      {"", std::move(shape), transform, static_cast<std::uint32_t>(scene.materials.size() - 1), {}});
}

/// Lights of every kind of lamp on the camera's side of the panel.
Scene lit(Shape shape, const MaterialModel& model, ShadedSides sides) {
  Scene scene;
  add(scene, std::move(shape), {}, model, sides);
  add(scene, Sphere{}, Affine::translation({2.5, 1.5, 3}) * scaled(0.5), diffuse(Color(0), 8), kFront);
  scene.lights.push_back({PointLight{.position = {-1, 0.5, 2}, .color = Color(0.8)}, {}});
  scene.lights.push_back({DirectionalLight{.direction = {0.2, 0.1, -1}, .color = Color(0.5)}, {}});
  scene.camera.position = {0, 0, 4};
  scene.camera.fov = 30;
  return scene;
}

TEST(TwoSides, EveryIntegratorShowsTheBackAsTheFront) {
  const Phong matt = diffuse(Color(0.7, 0.5, 0.3));
  for (const IntegratorRow& row : integrators()) {
    SCOPED_TRACE(std::string(row.name));
    const bool looks = row.traits.has(Trait::showsData);
    for (const Real normals : {0.0, 1.0, -1.0}) {
      const auto show = [&](bool away, ShadedSides sides) {
        return mean(picture(lit(panel(away, normals), matt, sides), smallSettings(row.kind)));
      };
      // Normals against their facets tell the front by themselves: from there nothing is seen without `both`.
      const Real front = show(false, normals < 0 ? kBoth : kFront), back = show(true, kBoth);
      EXPECT_GT(front, 0.01);
      if (!looks) {
        EXPECT_NEAR(back, front, 0.05 * front) << normals;
      }
      const bool open = row.kind == IntegratorKind::occlusion;  // it shades by no light
      if (!looks && !open && normals >= 0) {
        EXPECT_LT(show(true, kFront), 0.3 * front) << normals;
      }
    }
  }
  for (const Chains chains : {Chains::path, Chains::veach}) {
    Settings settings = smallSettings(IntegratorKind::mlt);
    settings.chains = chains;
    const Real front = mean(picture(lit(panel(false), matt, kFront), settings)),
               back = mean(picture(lit(panel(true), matt, kBoth), settings));
    EXPECT_NEAR(back, front, 0.05 * front);
  }
}

TEST(TwoSides, EveryModelLooksFromBehindAsFromTheFront) {
  forEachType<ModelList>([]<class Model>(Model*) {
    SCOPED_TRACE(std::string(Model::kKeyword));
    const Bsdf bsdf = bsdfOf(MaterialModel(Model{}), {});
    if (whitted(bsdf).transmits() || whitted(bsdf).passage == Passage::straight)
      return;                                       // two different sides
    if (std::is_same_v<Model, Subsurface>) return;  // a body
    for (const IntegratorKind kind : {IntegratorKind::whitted, IntegratorKind::path, IntegratorKind::bdpt}) {
      const auto show = [&](bool away, ShadedSides sides) {
        return picture(lit(panel(away), Model{}, sides), smallSettings(kind, 1));
      };
      const Real front = mean(show(false, kFront));
      EXPECT_NEAR(mean(show(true, kBoth)), front, 0.05 * front + 1e-3);
    }
  });
}

TEST(TwoSides, TheOutsideOfAClosedMeshStaysAsItIs) {
  // Also at its outline, where the normals between its vertices point away from the camera.
  for (const IntegratorKind kind : {IntegratorKind::whitted, IntegratorKind::path, IntegratorKind::bdpt}) {
    SCOPED_TRACE(static_cast<int>(kind));
    Settings settings = smallSettings(kind, 4);
    settings.width = 40;
    const auto show = [&](ShadedSides sides) {
      return picture(lit(Mesh{sphereMesh(7, 5)}, diffuse(0.7), sides), settings);
    };
    EXPECT_EQ(show(kBoth), show(kFront));
  }
}

TEST(TwoSides, BothEndsAgreeOnSmoothSheets) {
  // Half a ball of few triangles, seen into and past its rim.
  auto mesh = std::make_shared<MeshData>(*sphereMesh(7, 5));
  std::erase_if(mesh->triangles, [&](const Triangle& t) {
    return mesh->points[t[0]].z + mesh->points[t[1]].z + mesh->points[t[2]].z > 0.3;
  });
  const Scene scene = lit(Mesh{mesh}, diffuse(0.7), kBoth);
  Settings settings = smallSettings(IntegratorKind::path, 256);
  settings.sampling = SampleKind::random;
  const Real path = mean(picture(scene, settings));
  settings.integrator = IntegratorKind::bdpt;
  EXPECT_NEAR(mean(picture(scene, settings)), path, 0.02 * path);
}

TEST(TwoSides, TheInsideOfASolidIsLit) {
  for (const Shape& shape : {Shape(Sphere{}), Shape(Cube{})})
    for (const ShadedSides sides : {kFront, kBoth}) {
      Scene scene;
      add(scene, shape, {}, diffuse(0.7), sides);
      scene.camera.position = {};
      scene.lights.push_back({PointLight{.position = {0.1, 0.1, 0.1}, .color = Color(1)}, {}});
      const Real seen = mean(picture(scene, smallSettings(IntegratorKind::whitted, 1)));
      if (sides == kFront)
        EXPECT_EQ(seen, 0) << shape.keyword();
      else
        EXPECT_GT(seen, 0.1) << shape.keyword();
    }
}

TEST(TwoSides, NoRuleHidesThem) {
  for (const BackFaces hidden : {BackFaces::cullAll, BackFaces::cullSeen}) {
    Settings settings = smallSettings(IntegratorKind::whitted, 1);
    settings.backFaces = hidden;
    for (const Real normals : {0.0, 1.0}) {
      const Scene front = lit(panel(false, normals), diffuse(0.7), kFront),
                  back = lit(panel(true, normals), diffuse(0.7), kBoth);
      EXPECT_NEAR(mean(picture(back, settings)), mean(picture(front, settings)), 1e-6);
      EXPECT_EQ(mean(picture(lit(panel(true, normals), diffuse(0.7), kFront), settings)), 0);
    }
  }
}

TEST(TwoSides, EachPlaceIsAsItsOwnMaterialSays) {
  MeshData mesh;  // two triangles side by side, turned away
  mesh.points = {{-2, -2, 0}, {0, -2, 0}, {-1, 2, 0}, {0.1f, -2, 0}, {2, -2, 0}, {1, 2, 0}};
  mesh.triangles = {{0, 2, 1}, {3, 5, 4}};
  mesh.materials = {0, 0, 0, 1, 1, 1};
  Scene scene;
  scene.materials.push_back({.name = "", .model = diffuse(0.7), .sides = kFront});
  scene.materials.push_back({.name = "", .model = diffuse(0.7), .sides = kBoth});
  scene.objects.push_back({"", Mesh{std::make_shared<const MeshData>(mesh)}, {}, 0, {}});
  scene.lights.push_back({DirectionalLight{.direction = {0, 0, -1}, .color = Color(1)}, {}});
  scene.camera.position = {0, 0, 4};
  for (const BackFaces faces : {BackFaces::both, BackFaces::cullAll}) {
    Settings settings = smallSettings(IntegratorKind::whitted, 1);
    settings.backFaces = faces;
    const Picture shown = picture(scene, settings);
    EXPECT_EQ(shown.at(3, 7), Color(0));
    EXPECT_NE(shown.at(8, 7), Color(0));
  }
}

}  // namespace
}  // namespace trace::test::two_sides_test

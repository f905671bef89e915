// Every shape seen through a narrow view from a thousand to ten million of its sizes away looks as it does
// from near. The light is at the camera: what the camera sees, it lights, so that a dark place would be a
// shadow that the shape throws on itself by rounding, or by a detail that one ray meets and the next one does
// not.
#include <gtest/gtest.h>

#include "geometry/mesh/mesh.h"
#include "shading/lights/ambient_light.h"
#include "shading/lights/point_light.h"
#include "support/scenes.h"

namespace trace::test::far_views_test {
namespace {

constexpr int kSide = 32;
constexpr Real kAmbient = 0.125;

struct View {
  int covered = 0, dark = 0;
  Real level = 0;  ///< mean over the picture
};

View seen(const Shape& shape, Real away) {
  Scene scene;
  Phong matt;
  matt.ambient = Color(1), matt.diffuse = Color(0.75);
  addObject(scene, shape, {}, matt);
  Box3 box = closeBoundsOf(prepare(shape));
  box = {max(box.low, Vec3{-1, -1, -1} * 1.5), min(box.high, Vec3{1, 1, 1} * 1.5)};  // of those without end
  const Real size = length(box.size());
  const Vec3 from = normalize({0.31, 0.47, 0.83});
  scene.camera.position = box.center() + from * (away * size);
  scene.camera.viewdir = -from;
  scene.camera.fov = 2 * std::atan(0.5 / away) * 180 / kPi;
  scene.lights.push_back({AmbientLight{.color = Color(kAmbient)}, {}});
  PointLight light{.position = scene.camera.position, .color = Color(1)};
  light.constant = 1, light.quadratic = 0;
  scene.lights.push_back({light, {}});
  Settings settings;
  settings.integrator = IntegratorKind::whitted;
  settings.width = settings.height = kSide;
  settings.spp = 1, settings.depth = 0, settings.threads = 1;
  View view;
  for (const Color& c : picture(scene, settings).pixels) {
    view.level += c.g / (kSide * kSide);
    view.covered += c.g > 0;
    view.dark += c.g > 0 && c.g <= kAmbient * 1.001;
  }
  return view;
}

/// `dark`: the share of dark places that is allowed beyond those seen from near.
void expectTheSameFromAfar(const Shape& shape, Real dark, Real level) {
  SCOPED_TRACE(shape.keyword());
  const View near = seen(shape, 300);
  ASSERT_GT(near.covered, 20);
  for (const Real away : {1e3, 1e4, 1e5, 1e6, 1e7}) {
    SCOPED_TRACE(away);
    const View far = seen(shape, away);
    EXPECT_NEAR(far.covered, near.covered, 3 + 0.02 * near.covered);
    EXPECT_LE(far.dark, near.dark + 1 + dark * far.covered);  // a puff has normals that turn away
    EXPECT_NEAR(far.level, near.level, level * near.level);
  }
}

TEST(FarViews, EveryShapeLooksAsFromNear) {
  for (const ShapeType& type : shapeTypes()) {
    Shape shape = typical(type);
    Random random(3);
    if (type.keyword == Mesh::kKeyword) shape = Mesh{ballMesh(6, random)};
    expectTheSameFromAfar(shape, 0.01, 0.03);
  }
}

/// Sets so folded that no search tells their turns apart.
TEST(FarViews, FractalsDoNotTurnToDust) {
  std::vector<Shape> shapes;
  for (const int power : {3, 8})
    for (const int iterations : {6, 10, 30})
      shapes.push_back(Mandelbulb{.power = power, .iterations = iterations, .materials = {}});
  for (const Real scale : {3.0, 2.0, -1.5})
    for (const int iterations : {8, 15, 30}) {
      Mandelbox box;
      box.scale = scale, box.iterations = iterations;
      shapes.push_back(box);
    }
  for (const Iteration iteration :
       {Iteration::square, Iteration::cube, Iteration::hypercomplex, Iteration::sine, Iteration::exponential})
    for (const int iterations : {10, 40})
      for (const bool mandelbrot : {false, true}) {
        Julia julia;
        julia.iteration = iteration, julia.iterations = iterations, julia.mandelbrot = mandelbrot;
        shapes.push_back(julia);
      }
  for (const Shape& shape : shapes) {
    const View near = seen(shape, 300), far = seen(shape, 1e5), farther = seen(shape, 1e7);
    std::string name(shape.keyword());
    forEachField(shape, [&](const AnyField& field, const auto& value) {
      if constexpr (requires { name += std::to_string(value); })
        name += " " + std::string(field.keyword) + " " + std::to_string(value);
    });
    SCOPED_TRACE(name);
    for (const View& view : {near, far, farther}) {
      EXPECT_LE(view.dark, 2 + 0.12 * view.covered);  // of dust it was a third to two thirds
      EXPECT_NEAR(view.covered, near.covered, 4 + 0.05 * near.covered);
      EXPECT_NEAR(view.level, near.level, 0.08 * near.level + 0.002);
    }
  }
}

}  // namespace
}  // namespace trace::test::far_views_test

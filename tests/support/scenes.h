// Small scenes, made in code.
#pragma once

#include "image/development/tone.h"
#include "render/integrators/make_integrator.h"
#include "render/picture/passes.h"
#include "render/picture/render.h"
#include "shading/lights/directional_light.h"
#include "shading/lights/point_light.h"
#include "support/shapes.h"

namespace trace::test {

inline std::uint32_t addMaterial(Scene& scene, const Phong& phong) {
  scene.materials.push_back({"", phong, {}});
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

inline void addObject(Scene& scene, Shape shape, const Affine& transform, const Phong& phong) {
  scene.objects.push_back({"", std::move(shape), transform, addMaterial(scene, phong), {}});
}

inline World build(const Scene& scene, const Settings& settings = {}) {
  Messages messages;
  return compile(scene, settings, messages);
}

inline std::unique_ptr<const Integrator> integratorOf(const World& world, const Settings& settings) {
  Job job;
  return makeIntegrator(world, settings, job);
}

inline Picture picture(const World& world, const Settings& settings, const Camera& camera,
                       Statistics* statistics = nullptr) {
  const Size size = pictureSize(settings, camera);
  Film film = makeFilm(settings, size.width, size.height);
  Job job;
  const RenderResult result = render(world, settings, film, job);
  if (statistics) *statistics = result.statistics;
  return film.picture();
}

inline Picture picture(const Scene& scene, const Settings& settings, Statistics* statistics = nullptr) {
  return picture(build(scene, settings), settings, scene.camera, statistics);
}

/// Objects of every shape, and meshes, under random transforms; some glass, some mirrors; three lights.
inline Scene randomScene(Random& random, int objects, double scale = 1) {
  Scene scene;
  const std::vector<Shape> shapes = analyticShapes();
  for (int i = 0; i < objects; ++i) {
    Phong phong;
    phong.diffuse = {random.uniform(), random.uniform(), random.uniform()};
    phong.specular = Color(random.uniform(0, 0.5));
    phong.shininess = random.uniform(1, 50);
    if (i % 3 == 0) phong.reflective = Color(0.4);
    if (i % 4 == 0) phong.transmissive = {0.9, 0.6, 0.7}, phong.index = random.uniform(1, 2);
    Shape shape = shapes[static_cast<size_t>(random.below(static_cast<int>(shapes.size())))];
    if (i % 5 == 0) {
      const auto mesh = ballMesh(6 + i % 7, random);
      if (i % 10 == 0) addNeedles(*mesh, random);
      shape = Mesh{mesh};
    }
    addObject(scene, shape, random.affine(0.25 * scale), phong);
  }
  for (int i = 0; i < 2; ++i)
    scene.lights.push_back(
        {PointLight{.position = random.inCube(4 * scale), .color = Color(0.8), .constant = 1, .quadratic = 0},
         {}});
  scene.lights.push_back({DirectionalLight{.direction = random.direction(), .color = Color(0.5)}, {}});
  scene.camera.position = Vec3{0, 0, 6} * scale;
  return scene;
}

/// Largest difference of two pictures in 8-bit levels, and how many channel values differ by more than one.
struct Levels {
  int most = 0;
  int beyondOne = 0;
};
inline Levels compareLevels(const Picture& a, const Picture& b) {
  Levels result;
  const Bytes x = toBytes(a, Rounding::truncate), y = toBytes(b, Rounding::truncate);
  for (size_t i = 0; i < x.rgb.size(); ++i) {
    const int d = std::abs(int{x.rgb[i]} - int{y.rgb[i]});
    result.most = std::max(result.most, d);
    result.beyondOne += d > 1;
  }
  return result;
}

}  // namespace trace::test

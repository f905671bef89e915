// Rooms of squares, what they are made of, and what is asked of their pictures, for the tests of integrators.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "geometry/shapes/solids/square.h"
#include "support/scenes.h"

namespace trace::test {

inline Phong diffuse(const Color& albedo, Real emissive = 0) {
  Phong phong;
  phong.diffuse = albedo, phong.emissive = Color(emissive);
  return phong;
}
inline Phong diffuse(Real albedo, Real emissive = 0) { return diffuse(Color(albedo), emissive); }

/// By so many half turns.
inline Affine turned(const Vec3& axis, Real halfTurns) { return Affine::rotation(axis, halfTurns * kPi); }
inline Affine scaled(Real factor) { return Affine::scaling({factor, factor, factor}); }

/// A wall of a cube of two units around the origin, to be turned to its side.
inline Affine wall() { return Affine::translation({0, 0, 1}) * Affine::scaling({2, 2, 1}); }

/// The inside of that cube.
inline void addRoom(Scene& scene, const Phong& phong) {
  for (const auto& [axis, angle] : {std::pair{Vec3{0, 1, 0}, 0.0},
                                    {Vec3{0, 1, 0}, 0.5},
                                    {Vec3{0, 1, 0}, 1.0},
                                    {Vec3{0, 1, 0}, 1.5},
                                    {Vec3{1, 0, 0}, 0.5},
                                    {Vec3{1, 0, 0}, 1.5}})
    addObject(scene, Square{}, turned(axis, angle) * wall(), phong);
}

/// The cube without its front, toward the camera at z = 4; two of its walls are coloured.
inline Scene openRoom(const Color& right = {0.8, 0.1, 0.1}, const Color& left = Color(0.7)) {
  Scene scene;
  addObject(scene, Square{}, turned({0, 1, 0}, 1) * wall(), diffuse(0.7));
  addObject(scene, Square{}, turned({0, 1, 0}, 0.5) * wall(), diffuse(right));
  addObject(scene, Square{}, turned({0, 1, 0}, 1.5) * wall(), diffuse(left));
  addObject(scene, Square{}, turned({1, 0, 0}, 0.5) * wall(), diffuse(0.7));
  addObject(scene, Square{}, turned({1, 0, 0}, 1.5) * wall(), diffuse(0.7));
  scene.camera.position = {0, 0, 4};
  scene.camera.fov = 40;
  return scene;
}

/// A body without a surface: what it is filled with is up to the caller.
inline Material& addCloud(Scene& scene, const Shape& shape, const Affine& place, Real density) {
  Material cloud;
  cloud.opacity = 0;
  cloud.mediumDensity = density;
  scene.materials.push_back(cloud);
  scene.objects.push_back({"", shape, place, static_cast<std::uint32_t>(scene.materials.size() - 1), {}});
  return scene.materials.back();
}

inline Color meanColor(const Picture& picture) {
  Color sum;
  for (const Color& c : picture.pixels) sum += c;
  return sum * (1.0 / static_cast<Real>(picture.pixels.size()));
}
/// The mean of the green light.
inline Real mean(const Picture& picture) {
  Real sum = 0;
  for (const Color& c : picture.pixels) sum += c.g;
  return sum / static_cast<Real>(picture.pixels.size());
}

/// The picture by one thread; those of two and of seven are expected to be the same.
inline Picture sameForAnyThreads(const Scene& scene, Settings settings) {
  settings.threads = 1;
  const Picture one = picture(scene, settings);
  for (const int threads : {2, 7}) {
    settings.threads = threads;
    EXPECT_EQ(picture(scene, settings), one) << threads << " threads";
  }
  return one;
}

/// The picture, stopped after so many samples of each pixel and gone on with.
inline Picture afterAStop(const Scene& scene, const Settings& settings, int samples) {
  const World world = build(scene, settings);
  const Size size = pictureSize(settings, scene.camera);
  Settings fewer = settings;
  fewer.spp = samples;
  Film first = makeFilm(fewer, size.width, size.height), film = makeFilm(settings, size.width, size.height);
  Job job;
  render(world, fewer, first, job);
  film.restore(first.saved());
  render(world, settings, film, job);
  EXPECT_TRUE(film.complete());
  return film.picture();
}

}  // namespace trace::test

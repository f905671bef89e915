// How a person turns and stretches an object, in steps that multiply what is there; and what may be typed.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "geometry/ray.h"
#include "geometry/shape.h"
#include "math/box.h"
#include "math/transform.h"
#include "scene/scene.h"
#include "shading/cameras/camera.h"
#include "shading/lights/light.h"

namespace trace {

/// Turned about the axes x, y and z, in this order, through the object's origin, which stays; degrees.
Affine turned(const Affine& placed, const Vec3& degrees);

/// A factor by which an object may be stretched: it leaves something to see, and can be taken back.
bool isFactor(Real factor);

/// Stretched along the object's own axes. Precondition: the factors are such.
Affine stretched(const Affine& placed, const Vec3& factors);

/// Without what only rounding left: 2.8e-17 beside 1, or 0.30000000000000004.
Affine withoutNoise(const Affine& placed);

/// An object that is placed so is still there when the scene is read again: the transform is finite and does
/// not make it flat.
bool keepsObject(const Affine& placed);

/// The box of an object in the world; an endless one is everywhere.
Box3 boxOf(const Object& object);
/// Boxes of the objects that have an end.
std::vector<Box3> boxesOf(const Scene& scene);

/// Turns a shape whose axis is its own z, such as a cone, so that it stands upright for a camera; others
/// stay.
Affine upright(const ShapeType& shape, const Vec3& updir);

/// A surface that the camera sees, and the box of its object.
struct SeenObject {
  SurfacePoint surface;
  Box3 box;
};
using LookAt = std::function<std::optional<SeenObject>(const Vec2& place)>;

/// A new object on something flat, as near to the middle of the picture as there is room: it lies wholly in
/// the picture, overlaps none of the `others` and hides little of them. Something that is wide, as a floor,
/// is preferred to the top of a small thing. Its size is that of placedInSight(), or less where there is no
/// room. None if there is no such place.
std::optional<Affine> placedAmong(const Box3& bounds, const CameraFrame& camera, const Vec3& updir,
                                  const std::vector<Box3>& others, const LookAt& lookAt);

/// A new object in the middle of the camera's picture: it stands on what is there, or floats `ahead` of the
/// camera where nothing is, and fills about a quarter of the picture's height. Its own bounds are `bounds`;
/// one without an end stays as it is made.
Affine placedInSight(const Box3& bounds, const CameraFrame& camera, const Vec3& updir,
                     const std::optional<SurfacePoint>& there, Real ahead);

/// Moved so that the lowest place of its box is where it was before.
Affine onItsFoot(const Box3& before, const Affine& placed, const Box3& after, const Vec3& updir);

/// The move that lets a new object, whose box this is, down onto what is below it. `distance` finds the first
/// thing that a ray hits. None if there is nothing below.
Vec3 letDown(const Box3& own, const Vec3& updir,
             const std::function<std::optional<Real>(const Ray&)>& distance);

/// The move that frees a new object, whose box this is, from the boxes of others: to the right, to the left,
/// toward the eye, or on top of them. None if it is free. What holds it and the eye, as a room does, is no
/// obstacle.
Vec3 freedFrom(const std::vector<Box3>& others, const Box3& own, const CameraFrame& camera,
               const Vec3& updir);

/// Where a new light goes: above and to the left of what the camera looks at.
Vec3 placeOfLight(const CameraFrame& camera, const Vec3& updir, const Vec3& target);
/// Puts the light there, toward the target, and makes it bright enough to be seen on it.
void aimLight(Light& light, const Vec3& position, const Vec3& target);

/// Readers take the camera: its field of view, its aspect ratio and its axes make a picture.
bool cameraSees(const Camera& camera);

}  // namespace trace

// How a person turns and stretches an object, in steps that multiply what is there; and what may be typed.
#pragma once

#include "math/transform.h"
#include "shading/cameras/camera.h"

namespace trace {

/// Turned about the axes x, y and z, in this order, through the object's origin, which stays; degrees.
Affine turned(const Affine& placed, const Vec3& degrees);

/// A factor by which an object may be stretched: it leaves something to see, and can be taken back.
bool isFactor(Real factor);

/// Stretched along the object's own axes. Precondition: the factors are such.
Affine stretched(const Affine& placed, const Vec3& factors);

/// An object that is placed so is still there when the scene is read again: the transform is finite and does
/// not make it flat.
bool keepsObject(const Affine& placed);

/// Readers take the camera: its field of view, its aspect ratio and its axes make a picture.
bool cameraSees(const Camera& camera);

}  // namespace trace

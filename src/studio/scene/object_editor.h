// Widgets for a shape in its place, with its material: an object of the scene, or one of the solids that a
// solid is made of, however deep.
#pragma once

#include <functional>
#include <string>

#include "scene/scene.h"

namespace trace::studio {

struct Studio;

/// The edited data: copies of an object's members, or of an operand's.
struct PlacedShape {
  std::string& name;
  Shape& shape;
  Affine& transform;
  std::uint32_t& material;
};

/// Draws the widgets; calls changed(what) when something has changed.
void editPlacedShape(Studio& studio, PlacedShape placed,
                     const std::function<void(const std::string& what)>& changed);

/// A menu of the shapes that can be made in the studio, with what they are; calls chosen(shape).
void shapeMenu(const std::function<void(Shape)>& chosen);

/// "ball", or "sphere" where it has no name.
std::string nameOf(const std::string& name, const Shape& shape);

}  // namespace trace::studio

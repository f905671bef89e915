// Where things are in the window, by name: for scripts that test it.
#pragma once

#include <array>
#include <map>
#include <string>

namespace trace::studio {

/// Low and high corner, in pixels of the window.
using Landmark = std::array<float, 4>;

/// From now on landmarks are kept; before, they are not.
void keepLandmarks();
/// Begins a frame.
void forgetLandmarks();
/// The widget that was drawn last is called so; in a table of fields, after its field.
void landmark(const std::string& name);
/// The field that widgets belong to from now on; "" for none.
void landmarksOf(const std::string& field);
/// The one that the keyboard is at, in the last frame; "" if none.
const std::string& focusedLandmark();
/// The landmarks of the last frame.
const std::map<std::string, Landmark>& landmarks();

}  // namespace trace::studio

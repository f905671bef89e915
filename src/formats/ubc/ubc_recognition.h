// How a scene of British Columbia begins.
#pragma once

#include <array>
#include <string_view>

namespace trace::ubc {

inline constexpr std::array<std::string_view, 14> kCommands{
    "Conic",      "Dimensions", "LookAt",     "Material", "Mesh",  "Perspective", "Plane",
    "PointLight", "PopMatrix",  "PushMatrix", "Rotate",   "Scale", "Sphere",      "Translate"};

/// Counts lines at the file's beginning that start with a command.
struct Beginning {
  int commands = 0;
  bool first = false;  ///< the first word of all is one
  bool old = false;    ///< one is of the older grammar
};
Beginning beginning(std::string_view bytes);

}  // namespace trace::ubc

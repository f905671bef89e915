// The lines of an OBJ file, before tinyobjloader takes them apart: it reads what is no number as 0.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace trace {

/// Checks the numbers of the points, normals, uv and faces. Returns how many faces have fewer than three
/// corners. Throws Error(Fault::scene) with line and column. Linear in the text.
std::size_t checkObjLines(const std::string& file, std::string_view bytes);

}  // namespace trace

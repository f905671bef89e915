// Triangle meshes of .ray files.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "formats/ray/read/material.h"
#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"
#include "geometry/mesh/mesh.h"
#include "shading/lights/light_links.h"

namespace trace::rayfile {

/// A mesh and what its block says beside its shape.
struct MeshNode {
  Mesh mesh;
  NotedMaterial material;
  std::string name;
  ObjectLinks links{};
};

/// Meshes that later blocks may name: `shared = NAME;`.
using SharedMeshes = std::map<std::string, Mesh, std::less<>>;

/// The mesh of a block `polymesh { ... }`. Reports what is wrong, and returns nothing if it cannot be used.
/// Points and faces are counted from 0 in messages, as in the file.
std::optional<MeshNode> readMesh(Findings& findings, Materials& materials, SharedMeshes& shared,
                                 const Item& block);

}  // namespace trace::rayfile

// Meshes of .ray files that are kept in other files: `mesh { file = "bunny.ply"; }`.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "formats/model.h"
#include "formats/ray/read/material.h"
#include "formats/ray/read/mesh_operations.h"
#include "formats/ray/syntax/findings.h"
#include "formats/ray/syntax/syntax.h"
#include "formats/scene_time.h"

namespace trace::rayfile {

/// Does the block name a file?
bool namesMeshFile(const Item& block);

/// The files that one scene names, each read once.
class MeshFiles {
 public:
  MeshFiles(Findings& findings, Materials& materials, SceneTime& time)
      : findings_(findings), materials_(materials), time_(time) {}

  /// The objects of a block `polymesh { file = "..."; ... }`. Their transforms are those inside the file. A
  /// file named twice gives objects that share their meshes. Reports what is wrong, and then returns nothing.
  std::vector<Object> read(const Item& block);

 private:
  const Model* model(const Item& field, const std::string& name);
  static void change(std::vector<Object>& objects, bool generate, const MeshOperations& operations,
                     const SourcePlace& place);

  Findings& findings_;
  Materials& materials_;
  SceneTime& time_;
  std::map<std::string, Model> models_;
  /// By file, number of the material for parts without one, and what is done to the meshes.
  std::map<std::tuple<const Model*, std::uint32_t, bool, MeshOperations>, std::vector<Object>> placed_;
};

}  // namespace trace::rayfile

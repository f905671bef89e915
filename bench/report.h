// The measurements as a table for people and as JSON for what compares runs.
#pragma once

#include <iosfwd>
#include <nlohmann/json.hpp>
#include <span>

#include "measure.h"

namespace trace::bench {

void printTables(std::ostream& out, std::span<const MeshReport> meshes);
nlohmann::ordered_json toJson(std::span<const MeshReport> meshes, const Plan& plan);

}  // namespace trace::bench

// A Part of the library: one thing of a scene, and the access to its fields.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "formats/ray/file/part.h"
#include "library/scene_state.h"
#include "traceray/traceray.h"

namespace traceray {

struct PartState {
  using Category = PartCategory;

  std::shared_ptr<SceneState> owner;
  Category category = kObject;
  std::uint64_t id = 0;  ///< id of an object or a light; index of a material

  // As the functions of Part.
  std::string categoryName() const;
  std::string keyword() const;
  std::string name() const;
  std::vector<std::string> fields() const;
  Value get(std::string_view field) const;
  Node node() const;
  void set(const Fields& fields);
  PartState material() const;
  std::array<double, 16> transform() const;
  void setTransform(const std::array<double, 16>& worldFromObject);
  void move(const Fields& fields);
  void remove();

 private:
  /// In its list. Throws Error(usage) if it is not there any more.
  std::size_t index() const;
  trace::Object& object() const;
  /// Its fields with their values.
  Fields all() const;
  void setObject(const Fields& fields);
  void setLight(const Fields& fields);
  void setMaterial(const Fields& fields);
  void setCamera(const Fields& fields);
  void setBackground(const Fields& fields);
  /// Reads the node into a scene of its own; its warnings take the place of those of the part. Throws
  /// trace::Error.
  trace::rayfile::PartGiven readAgain(const Node& node, trace::Scene& into) const;
};

}  // namespace traceray

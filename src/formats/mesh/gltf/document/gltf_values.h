// Values of tinygltf's tree: indices, colours, and numbers of extensions.
#pragma once

#include <cstddef>
#include <fstream>  // for tinygltf, which forgets it
#include <limits>
#include <vector>

#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>
// Where it includes the header of Windows, these are macros of nothing.
#undef near
#undef far

#include "math/color.h"
#include "math/vec.h"

namespace trace {

inline bool isIndex(int index, std::size_t count) {
  return index >= 0 && static_cast<std::size_t>(index) < count;
}

inline Color colorOf(const std::vector<double>& numbers, const Color& otherwise) {
  return numbers.size() < 3 ? otherwise : Color{numbers[0], numbers[1], numbers[2]};
}

/// The value `field` of an extension; null if the material or node does not have it.
inline const tinygltf::Value* extensionValue(const tinygltf::ExtensionMap& all, const char* name,
                                             const char* field) {
  const auto found = all.find(name);
  if (found == all.end() || !found->second.IsObject() || !found->second.Has(field)) return nullptr;
  return &found->second.Get(field);
}

/// The number `field` of an extension, if there is one.
inline double extension(const tinygltf::ExtensionMap& all, const char* name, const char* field,
                        double otherwise) {
  const tinygltf::Value* value = extensionValue(all, name, field);
  return value && value->IsNumber() ? value->GetNumberAsDouble() : otherwise;
}

/// As a number of something in the file; -1 for what is no such number.
inline int wholeOf(double number) {
  return number >= 0 && number <= std::numeric_limits<int>::max() ? static_cast<int>(number) : -1;
}

/// The first `count` numbers of the list `field` of an extension; none if it is shorter.
inline std::vector<double> extensionList(const tinygltf::ExtensionMap& all, const char* name,
                                         const char* field, std::size_t count) {
  const tinygltf::Value* list = extensionValue(all, name, field);
  std::vector<double> numbers;
  if (!list || !list->IsArray() || list->ArrayLen() < count) return numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const tinygltf::Value& x = list->Get(static_cast<int>(i));
    if (!x.IsNumber()) return {};
    numbers.push_back(x.GetNumberAsDouble());
  }
  return numbers;
}
inline Vec2 extensionPair(const tinygltf::ExtensionMap& all, const char* name, const char* field,
                          const Vec2& otherwise) {
  const std::vector<double> pair = extensionList(all, name, field, 2);
  return pair.empty() ? otherwise : Vec2{pair[0], pair[1]};
}

}  // namespace trace

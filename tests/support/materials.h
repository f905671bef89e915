// Instances of every shading model on the list, made by looping over their fields: a new model is tested
// without a new line here.
#pragma once

#include <algorithm>
#include <string>
#include <type_traits>
#include <vector>

#include "base/text.h"
#include "geometry/field_value.h"
#include "shading/material.h"
#include "shading/material_list.h"

namespace trace::test {

struct NamedModel {
  std::string name;
  MaterialModel model;
};

/// Other values for a field, within its range.
template <class Value, class Field>
std::vector<Value> otherValues(const Field& field, const Value& value) {
  if constexpr (std::is_same_v<Value, Color>) {
    const Color green{0.1, 0.6, 0.3};
    return {value == green ? Color(0.5) : green};
  } else if constexpr (std::is_same_v<Value, Real>) {
    std::vector<Real> all;
    const Real low = std::max(field.least, -90.0);
    if (field.most == kNoLimit)
      all = {value == 0 ? 5 : value * 4, std::max(low, value / 3)};
    else
      all = {low + (field.most - low) * 0.25, low + (field.most - low) * 0.7, field.most};
    std::erase(all, value);
    return all;
  } else if constexpr (std::is_same_v<Value, bool>) {
    return {!value};
  } else if constexpr (std::is_same_v<Value, ColorRamp>) {
    return {{{0, 0.1, 0.1, 0.3}, {0.4, 0.1, 0.1, 0.3}, {0.4, 0.8, 0.5, 0.3}}};
  } else if constexpr (std::is_same_v<Value, int>) {
    return {static_cast<int>(std::min(field.most, value + 2.0))};
  } else {
    std::vector<Value> all;
    for (std::size_t i = 0; i < names(Value{}).size(); ++i)
      if (static_cast<Value>(i) != value) all.push_back(static_cast<Value>(i));
    return all;
  }
}

/// Each model with its defaults, and with one field changed.
inline std::vector<NamedModel> variedModels() {
  std::vector<NamedModel> all;
  forEachType<ModelList>([&]<class Model>(Model*) {
    Model usual;
    if constexpr (std::is_same_v<Model, Phong>)
      usual.diffuse = {0.5, 0.4, 0.1}, usual.specular = {0.4, 0.4, 0.5}, usual.shininess = 20;
    forEachField<Model>([&](const auto& f) {  // lobes that a grid of directions resolves
      if constexpr (std::is_same_v<decltype(&(usual.*f.member)), Real*>)
        if (f.keyword.find("roughness") != f.keyword.npos) usual.*f.member = std::max(0.3, usual.*f.member);
    });
    all.push_back({std::string(Model::kKeyword), usual});
    forEachField<Model>([&](const auto& f) {
      using Value = std::remove_cvref_t<decltype(usual.*f.member)>;
      for (const Value& value : otherValues<Value>(f, usual.*f.member)) {
        Model other = usual;
        other.*f.member = value;
        all.push_back({std::string(Model::kKeyword) + " with another " + std::string(f.keyword), other});
        if constexpr (std::is_same_v<Value, Real>) all.back().name += " " + toText(value);
      }
    });
  });
  return all;
}

}  // namespace trace::test

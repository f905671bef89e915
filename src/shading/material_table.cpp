// The table of shading models, made of their list.
#include <stdexcept>
#include <string>

#include "shading/bsdf.h"
#include "shading/material.h"
#include "shading/material_list.h"

namespace trace {
namespace {

template <class Model>
const Model& modelHeld(const void* model) {
  return *static_cast<const Model*>(model);
}

template <class Model>
ModelType rowFor(std::size_t index) {
  return {ListedRow<ModelField>::of<Model>(index),
          Model::kReciprocal,
          Model::kKeepsEnergy,
          [](const void* model, const Rules& rules) { return Bsdf(modelHeld<Model>(model).at(rules)); },
          [](const void* model, const std::vector<FieldTexture>& textures, const TexturePlace& place,
             const Rules& rules) {
            Model said = modelHeld<Model>(model);
            applyTextures(said, textures, place);
            return Bsdf(said.at(rules));
          },
          [](const void* model) -> Phong { return modelHeld<Model>(model).asPhong(); }};
}

}  // namespace

std::span<const ModelType> modelTypes() {
  static const std::array kTable = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{rowFor<std::variant_alternative_t<I, ModelList>>(I)...};
  }
  (std::make_index_sequence<std::variant_size_v<ModelList>>{});
  return kTable;
}

const ModelType* findModelType(std::string_view keyword) {
  for (const ModelType& type : modelTypes())
    if (type.keyword == keyword) return &type;
  return nullptr;
}

std::vector<std::string_view> modelKeywords() {
  std::vector<std::string_view> words;
  for (const ModelType& type : modelTypes()) words.push_back(type.keyword);
  return words;
}

template <>
const ModelType& rowCalled<ModelType>(std::string_view keyword) {
  if (const ModelType* type = findModelType(keyword)) return *type;
  throw std::logic_error("no shading model of the list is called " + std::string(keyword));
}

Bsdf bsdfOf(const MaterialModel& model, const Rules& rules) { return model.type().bsdf(model.data(), rules); }

Bsdf bsdfAt(const MaterialModel& model, const std::vector<FieldTexture>& textures, const TexturePlace& place,
            const Rules& rules) {
  return model.type().bsdfAt(model.data(), textures, place, rules);
}

Phong phongOf(const MaterialModel& model) { return model.type().asPhong(model.data()); }

}  // namespace trace

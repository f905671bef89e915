#include "shading/material.h"

#include <algorithm>
#include <any>
#include <type_traits>
#include <utility>

namespace trace {
namespace {

/// A field of a model, whatever its type. So models are known one by one, not in pairs, which are very many.
struct AnyField {
  std::string_view keyword;
  std::any value;
};

/// Those that differ from the default, which another model may have another of.
std::vector<AnyField> changedFields(const MaterialModel& model) {
  std::vector<AnyField> fields;
  match(model, [&]<class M>(const M& m) {
    forEachField<M>([&](const auto& f) {
      if (!(m.*f.member == M{}.*f.member)) fields.push_back({f.keyword, m.*f.member});
    });
  });
  return fields;
}

/// Those that the model has, too.
void takeFields(const std::vector<AnyField>& fields, MaterialModel& model) {
  match(model, [&]<class M>(M& m) {
    forEachField<M>([&](const auto& f) {
      auto& value = m.*f.member;
      for (const AnyField& field : fields)
        if (field.keyword == f.keyword)
          if (const auto* given = std::any_cast<std::remove_cvref_t<decltype(value)>>(&field.value))
            value = *given;
    });
  });
}

}  // namespace

MaterialModel::MaterialModel() = default;
MaterialModel::MaterialModel(const MaterialModel&) = default;
MaterialModel::MaterialModel(MaterialModel&&) noexcept = default;
MaterialModel& MaterialModel::operator=(const MaterialModel&) = default;
MaterialModel& MaterialModel::operator=(MaterialModel&&) noexcept = default;
MaterialModel::~MaterialModel() = default;
bool MaterialModel::operator==(const MaterialModel& other) const {
  return static_cast<const variant&>(*this) == static_cast<const variant&>(other);
}

std::optional<MaterialModel> modelCalled(std::string_view keyword) {
  std::optional<MaterialModel> model;
  forEachType<MaterialModel>([&]<class M>(M*) {
    if (M::kKeyword == keyword) model = M{};
  });
  return model;
}

std::vector<std::string_view> modelKeywords() {
  std::vector<std::string_view> words;
  forEachType<MaterialModel>([&]<class M>(M*) { words.push_back(M::kKeyword); });
  return words;
}

std::string_view keywordOf(const MaterialModel& model) {
  return match(model, [](const auto& m) { return m.kKeyword; });
}

void changeColors(MaterialModel& model, std::initializer_list<std::string_view> keywords,
                  const std::function<Color(const Color&)>& change) {
  match(model, [&]<class M>(M& m) {
    forEachField<M>([&](const auto& f) {
      auto& value = m.*f.member;
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Color>)
        if (std::find(keywords.begin(), keywords.end(), f.keyword) != keywords.end()) value = change(value);
    });
  });
}

MaterialModel converted(const MaterialModel& from, const MaterialModel& to) {
  if (from.index() == to.index()) return from;
  MaterialModel result = match(to, []<class M>(const M&) -> MaterialModel { return M{}; });
  takeFields(changedFields(from), result);
  return result;
}

Material withModel(Material material, const MaterialModel& to) {
  material.model = converted(material.model, to);
  std::erase_if(material.textures, [&](const FieldTexture& t) {
    bool known = false;
    forEachField<Material>([&](const auto& f) { known |= f.keyword == t.field; });
    match(material.model, [&]<class M>(const M&) {
      forEachField<M>([&](const auto& f) {
        using Value = std::remove_cvref_t<decltype(std::declval<M&>().*f.member)>;
        known |= kIsContinuous<Value> && f.keyword == t.field;
      });
    });
    return !known;
  });
  return material;
}

Phong phongOf(const MaterialModel& model) {
  return match(model, [](const auto& said) -> Phong { return said.asPhong(); });
}

Phong phongOf(const Material& material) {
  Phong phong = phongOf(material.model);
  const Real there = material.opacity;
  if (!(there < 1)) return phong;
  if (!phong.transmits()) phong.index = 1;
  for (Color Phong::*part :
       {&Phong::emissive, &Phong::ambient, &Phong::diffuse, &Phong::specular, &Phong::reflective})
    phong.*part = phong.*part * there;
  phong.transmissive = phong.transmissive * there + Color(1 - there);
  return phong;
}

Phong phongWithoutTextures(const Material& material) {
  Material solid = material;
  if (textureOf(material.textures, kOpacity)) solid.opacity = 1;
  Phong phong = phongOf(solid);
  if (textureOf(material.textures, "transmissive")) phong.transmissive = Color(0);
  return phong;
}

}  // namespace trace

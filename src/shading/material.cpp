#include "shading/material.h"

#include <algorithm>
#include <type_traits>

namespace trace {

void changeColors(MaterialModel& model, std::initializer_list<std::string_view> keywords,
                  const std::function<Color(const Color&)>& change) {
  editEachField(model, [&]<class Value>(const ModelField& field, Value& value) {
    if constexpr (std::is_same_v<Value, Color>)
      if (std::find(keywords.begin(), keywords.end(), field.keyword) != keywords.end()) value = change(value);
  });
}

MaterialModel converted(const MaterialModel& from, const MaterialModel& to) {
  if (&from.type() == &to.type()) return from;
  MaterialModel result(to.type());
  takeChangedFields(result, from);
  return result;
}

Material withModel(Material material, const MaterialModel& to) {
  material.model = converted(material.model, to);
  std::erase_if(material.textures, [&](const FieldTexture& t) {
    bool known = false;
    forEachField<Material>([&](const auto& f) { known |= f.keyword == t.field; });
    forEachField(material.model, [&]<class Value>(const ModelField& f, const Value&) {
      known |= kIsContinuous<Value> && f.keyword == t.field;
    });
    return !known;
  });
  return material;
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

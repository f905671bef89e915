// The table of textures, made of their list.
#include <stdexcept>
#include <string>

#include "shading/texture.h"
#include "shading/texture_list.h"

namespace trace {
namespace {

template <class Model>
const Model& textureHeld(const void* model) {
  return *static_cast<const Model*>(model);
}

template <class Model>
Color colorAt(const void* at, const std::vector<FieldTexture>& inputs, const TexturePlace& place) {
  const Model& model = textureHeld<Model>(at);
  if (inputs.empty()) return model.at(place);
  Model own = model;
  if constexpr (requires { own.pattern(place); }) {
    for (const FieldTexture& t : inputs)
      if (t.field != "a" && t.field != "b") applyTexture(own, t, place);
    const Real pattern = own.pattern(place);
    for (const FieldTexture& t : inputs)
      if ((t.field == "a" && pattern < 1) || (t.field == "b" && pattern > 0)) applyTexture(own, t, place);
    return own.shade(pattern);
  } else {
    applyTextures(own, inputs, place);
    return own.at(place);
  }
}

template <class Model>
bool looksAtFootprint(const void* at) {
  if constexpr (requires(const Model& model) { model.wantsFootprint(); })
    return textureHeld<Model>(at).wantsFootprint();
  else
    return requires(const Model& model) { model.octaves; };
}

template <class Model>
bool looksAtUv(const void* at) {
  if constexpr (requires(const Model& model) { model.space; })
    return textureHeld<Model>(at).space == TextureSpace::uv;
  else
    return requires(const Model& model) { model.wantsUv(); };
}

template <class Model>
bool looksAtSecondUv(const void* at) {
  if constexpr (requires(const Model& model) { model.secondUv; })
    return textureHeld<Model>(at).secondUv;
  else
    return false;
}

}  // namespace

std::span<const TextureType> textureTypes() {
  static const std::array kTable = []<class... Model>(const std::variant<Model...>*) {
    std::size_t index = 0;
    return std::array{TextureType{ListedRow<TextureField>::of<Model>(index++), colorAt<Model>,
                                  looksAtFootprint<Model>, looksAtUv<Model>, looksAtSecondUv<Model>}...};
  }(static_cast<const TextureList*>(nullptr));
  return kTable;
}

const TextureType* findTextureType(std::string_view keyword) {
  for (const TextureType& type : textureTypes())
    if (type.keyword == keyword) return &type;
  return nullptr;
}

template <>
const TextureType& rowCalled<TextureType>(std::string_view keyword) {
  if (const TextureType* type = findTextureType(keyword)) return *type;
  throw std::logic_error("no texture of the list is called " + std::string(keyword));
}

}  // namespace trace

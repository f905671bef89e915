// A texture as a scene keeps it: a value that changes over a surface. texture_list.h has the list of types.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/listed.h"
#include "math/transform.h"
#include "shading/formula_text.h"
#include "shading/pixels.h"
#include "shading/texture_place.h"
#include "shading/textures/pattern.h"

namespace trace {

struct FieldTexture;

/// A field of a texture and where its value lies.
struct TextureField
    : FieldValue<bool, int, Real, Vec3, Color, ColorRamp, std::array<Real, 6>, Pixels, FormulaText> {};

/// A row of the table of textures.
struct TextureType : ListedRow<TextureField> {
  /// At a place, with textures in place of fields.
  Color (*at)(const void* model, const std::vector<FieldTexture>& inputs, const TexturePlace& place);
  bool (*wantsFootprint)(const void* model);
  bool (*wantsUv)(const void* model);
  bool (*wantsSecondUv)(const void* model);
};

std::span<const TextureType> textureTypes();
/// Null if no texture has that keyword.
const TextureType* findTextureType(std::string_view keyword);
template <>
const TextureType& rowCalled<TextureType>(std::string_view keyword);

/// A texture of whatever type. Copies share their data.
class TextureModel : public Listed<TextureType, TextureField> {
 public:
  using Listed::Listed;
  /// A picture.
  TextureModel() : Listed(textureTypes().front()) {}

  Color at(const std::vector<FieldTexture>& inputs, const TexturePlace& place) const {
    return type().at(data(), inputs, place);
  }
  /// It looks at how large a part of the surface a place stands for.
  bool wantsFootprint() const { return type().wantsFootprint(data()); }
  bool wantsUv() const { return type().wantsUv(data()); }
  bool wantsSecondUv() const { return type().wantsSecondUv(data()); }
};

/// How a pattern stands in its object: first scaled, then turned about x, y and z, then moved. What lies in u
/// and v is moved there, as if they were x and y.
struct TexturePlacement {
  Vec3 scale{1, 1, 1};
  Vec3 rotate{}, translate{};

  static constexpr auto fields() {
    return Fields{
        Field{"scale", &TexturePlacement::scale, "", -kNoLimit, kNoLimit, "makes the pattern larger"},
        Field{"rotate", &TexturePlacement::rotate, "degrees", -kNoLimit, kNoLimit,
              "rotates it about x, then y, then z"},
        Field{"translate", &TexturePlacement::translate, "", -kNoLimit, kNoLimit, "moves it"}};
  }
  bool operator==(const TexturePlacement&) const = default;
};

struct TextureNode;

/// Constant data that copies share.
class Texture {
 public:
  Texture(TextureNode node);  // NOLINT(google-explicit-constructor): a node is a texture

  const TextureNode& operator*() const;
  const TextureNode* operator->() const { return &**this; }
  Color at(const TexturePlace& place) const;
  /// The number of textures that one place evaluates, this one and those in it; one that stands in two places
  /// counts twice.
  double size() const;

  /// Two that share their data are equal at once.
  bool operator==(const Texture& other) const;

 private:
  struct Data;
  static Color at(const TextureNode& node, const TexturePlace& place);
  std::shared_ptr<const Data> data_;
};

/// A texture in place of a constant: the field's own value scales it. Numbers take its luminance.
struct FieldTexture {
  std::string field;  ///< keyword of the material's or texture's field
  Texture texture;
  bool operator==(const FieldTexture&) const = default;
};

struct TextureNode {
  std::string name{};
  TextureModel model{};
  TexturePlacement placement{};
  std::vector<FieldTexture> inputs{};
  bool operator==(const TextureNode&) const = default;
};

/// The texture of the field; null if it has none.
const Texture* textureOf(const std::vector<FieldTexture>& textures, std::string_view field);

/// Gives the field this texture. The list is in the order of the alphabet.
void setTexture(std::vector<FieldTexture>& textures, std::string_view field, Texture texture);

/// A picture on a field.
Texture pictureTexture(std::string file, SourcePlace place = {});

/// It, or a texture in it, looks at how large a part of the surface a place stands for.
bool wantsFootprint(const Texture& texture);

/// It, or a texture in it, looks at u and v.
bool wantsUv(const Texture& texture);
/// It, or a texture in it, looks at the second u and v of a mesh.
bool wantsSecondUv(const Texture& texture);

/// A few words for a person: its name, or what it is.
std::string summary(const Texture& texture);

/// The number that stands for a colour: of a grey that grey, to the last bit.
constexpr Real luminance(const Color& c) {
  return c.r == c.g && c.g == c.b ? c.r : 0.299 * c.r + 0.587 * c.g + 0.114 * c.b;
}

/// Multiplies the field that has the texture by it.
template <class Struct>
void applyTexture(Struct& to, const FieldTexture& t, const TexturePlace& place) {
  forEachField<Struct>([&](const auto& f) {
    auto& value = to.*f.member;
    if constexpr (requires { value.r; }) {
      if (f.keyword == t.field) value *= t.texture.at(place);
    } else if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Real>) {
      if (f.keyword == t.field) value *= luminance(t.texture.at(place));
    }
  });
}
template <class Struct>
void applyTextures(Struct& to, const std::vector<FieldTexture>& textures, const TexturePlace& place) {
  for (const FieldTexture& t : textures) applyTexture(to, t, place);
}

/// The same texture with every picture in it, however deep, changed: change(Pixels&).
template <class Change>
Texture withPixels(const Texture& texture, const Change& change) {
  TextureNode node = *texture;
  editEachField(node.model, [&]<class Value>(const TextureField&, Value& value) {
    if constexpr (std::is_same_v<Value, Pixels>) change(value);
  });
  for (FieldTexture& input : node.inputs) input.texture = withPixels(input.texture, change);
  return node;
}

}  // namespace trace

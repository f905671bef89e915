// Textures of .ray files, in place of a constant:
//   diffuse = map("file.png");                              the picture, as the courses' programs have it
//   diffuse = checker { a = (1, 1, 1); scale = (2, 2, 2); };
//   diffuse = texture("floor");                             one that has a name:
//                                                           texture = checker { name = floor; ... }
//   diffuse = texture(checker { }, (0.5, 0.5, 0.5));        with the constant that scales it
//   diffuse = texture(map("file.png"), (0.5, 0.5, 0.5));    the same as map("file.png", (0.5, 0.5, 0.5))
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/ray/read/fields.h"
#include "formats/ray/syntax/findings.h"
#include "shading/texture.h"

namespace trace::rayfile {

/// The keyword of named textures.
inline constexpr std::string_view kTexture = "texture";

/// The file as a picture on a surface, as the courses' programs look it up.
Texture mappedPicture(std::string file, SourcePlace place = {});

/// Keywords of all kinds of textures.
std::vector<std::string_view> textureKinds();

class TextureReader {
 public:
  explicit TextureReader(Findings& findings) : findings_(findings) {}

  /// `texture = KIND { name = ...; ... }`.
  void define(const Item& value);

  /// Reads `field` into the member of that keyword, or the texture that stands there into `textures`. False
  /// if Struct has no such field.
  template <class Struct>
  bool assign(Struct& target, std::vector<FieldTexture>& textures, const Item& field, std::string_view owner);

  bool isTexture(const Item& value) const;

  /// All that have names so far.
  const std::map<std::string, Texture, std::less<>>& named() const { return named_; }

 private:
  struct Scaled {
    Texture texture;
    std::optional<Item> by{};
    bool isMap = false;
  };
  /// Nothing, after a report, if it cannot be had.
  std::optional<Scaled> read(const Item& value);
  std::optional<Texture> block(const Item& call);
  void readFields(const Item& block, TextureNode& node);
  std::optional<Texture> named(const Item& word);

  Findings& findings_;
  std::map<std::string, Texture, std::less<>> named_;
};

template <class Struct>
bool TextureReader::assign(Struct& target, std::vector<FieldTexture>& textures, const Item& field,
                           std::string_view owner) {
  const std::string_view key = canonical(field.key());
  if (!isTexture(field.value())) {
    if (!assignField(findings_, target, field)) return false;
    std::erase_if(textures, [&](const FieldTexture& t) { return t.field == key; });
    checkRange(findings_, target, field, owner);
    return true;
  }
  bool known = false;
  editEachField(target, [&]<class Value>(const auto& f, Value& value) {
    if (f.keyword != key) return;
    known = true;
    if constexpr (std::is_same_v<Value, Color> || std::is_same_v<Value, Real>) {
      const std::optional<Scaled> scaled = read(field.value());
      if (!scaled) return;
      setTexture(textures, key, scaled->texture);
      value = Value(1);
      if (scaled->isMap && key == "shininess") value = Value(128);  // as the courses' programs have it
      if (scaled->by) rayfile::read(findings_, key, *scaled->by, value);
    } else {
      rayfile::read(findings_, key, field.value(), value);
    }
  });
  return known;
}

/// Textures that have been written with their names, which then stand for them.
using WrittenTextures = std::map<std::string, Texture, std::less<>>;

/// A texture, and the text of the constant that it scales, as TextureReader reads them; `plain` if the
/// constant is the one that a texture alone stands for.
std::string textured(const Texture& texture, const std::string& constant, bool plain, int digits,
                     WrittenTextures* written = nullptr);
template <class Value>
std::string textured(const Texture& texture, const Value& constant, int digits,
                     WrittenTextures* names = nullptr) {
  bool plain = false;
  if constexpr (kIsContinuous<Value>) plain = constant == Value(1);
  return textured(texture, written(constant, digits), plain, digits, names);
}

}  // namespace trace::rayfile

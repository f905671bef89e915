#include "formats/ray/read/texture.h"

#include <algorithm>
#include <utility>

#include "base/files/file.h"
#include "base/text.h"
#include "formats/ray/read/student_textures.h"
#include "image/codecs/picture_name.h"
#include "shading/texture_flaws.h"
#include "shading/textures/image_map.h"
#include "shading/textures/marble.h"

namespace trace::rayfile {
namespace {

constexpr std::string_view kMap = "map", kName = "name";

/// The type that a call names; null if it is none.
const TextureType* typeOf(const Item& call) {
  return call.is(Kind::call) ? findTextureType(textureKeyword(call.key())) : nullptr;
}

/// `map("file")`, without a constant: inside `texture( )` it stands for the picture.
bool isPlainMap(const Item& value) {
  if (!value.is(Kind::call) || value.key() != kMap || !value.value().is(Kind::tuple)) return false;
  return value.value().count() == 1 && (*value.value().begin()).is(Kind::word);
}

/// A bare string where a constant is expected.
bool isPictureFile(const Item& value) { return value.is(Kind::word) && value.source().starts_with('"'); }

}  // namespace

std::vector<std::string_view> textureKinds() {
  std::vector<std::string_view> kinds;
  for (const TextureType& type : textureTypes()) kinds.push_back(type.keyword);
  return kinds;
}

Texture mappedPicture(std::string file, SourcePlace place) {
  ImageMap map;
  map.file = {std::move(file), nullptr, std::move(place)};
  map.wrapU = map.wrapV = Wrap::clamp;
  map.centersAtEnds = true;
  return TextureNode{.model = std::move(map)};
}

bool TextureReader::isTexture(const Item& value) const {
  if (isPictureFile(value)) return true;
  if (!value.is(Kind::call)) return false;
  return value.key() == kMap || value.key() == kTexture || typeOf(value);
}

std::optional<TextureReader::Scaled> TextureReader::read(const Item& value) {
  const auto picture = [&](const Item& word) {
    findings_.scene().inputs.noteNamed(
        besideFile(findings_.syntax().file(), pictureName(std::string(word.text())).file));
    return mappedPicture(std::string(word.text()), findings_.syntax().shortPlace(value.offset()));
  };
  if (isPictureFile(value)) return Scaled{picture(value), {}, true};
  const bool isMap = value.key() == kMap;
  if (!isMap && value.key() != kTexture) {
    std::optional<Texture> own = block(value);
    return own ? std::optional(Scaled{*std::move(own)}) : std::nullopt;
  }
  const Item tuple = value.value();
  const auto count = tuple.is(Kind::tuple) ? tuple.count() : 0;
  if (count < 1 || count > 2 || (isMap && !(*tuple.begin()).is(Kind::word))) {
    findings_.expected(value, value.key(),
                       isMap ? "map(\"file\") or map(\"file\", constant)"
                             : "texture(\"name\"), texture(map(\"file\")), or one of them with a constant "
                               "after it");
    return {};
  }
  const Item first = *tuple.begin();
  const std::optional<Item> by = count == 2 ? std::optional(*++tuple.begin()) : std::nullopt;
  if (isMap) return Scaled{picture(first), by, true};
  if (isPlainMap(first)) return Scaled{picture(*first.value().begin()), by, true};
  std::optional<Texture> texture = first.is(Kind::word) ? named(first) : block(first);
  return texture ? std::optional(Scaled{*std::move(texture), by}) : std::nullopt;
}

std::optional<Texture> TextureReader::named(const Item& word) {
  if (const auto found = named_.find(word.text()); found != named_.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& [name, texture] : named_) names.push_back(name);
  std::string hint = didYouMean(word.text(), names);
  if (hint.empty()) hint = "a texture is named before its first use: texture = checker { name = floor; ... }";
  findings_.error(word, "expected the name of a texture, found " + describe(word), std::move(hint));
  return {};
}

std::optional<Texture> TextureReader::block(const Item& call) {
  const TextureType* type = typeOf(call);
  if (!type) {
    findings_.expected(call, kTexture, "a texture, as in checker { }",
                       call.is(Kind::call) ? didYouMean(call.key(), textureKinds()) : std::string());
    return {};
  }
  const std::optional<Item> fields = blockOf(findings_, call);
  if (!fields) return {};
  TextureNode node{.model = TextureModel(*type)};
  if (!node.model.is<Marble>() || !readStudentMarble(findings_, *fields, node)) readFields(*fields, node);
  for (const std::string& flaw : flawsOf(node)) findings_.warn(call, flaw);
  constexpr double kMostTextures = 1000;
  Texture texture(std::move(node));
  if (texture.size() > kMostTextures) {
    findings_.error(call,
                    "expected at most " + toText(kMostTextures) + " textures in one another, found " +
                        toText(texture.size()),
                    "each point of a surface evaluates all of them; one in two fields counts twice");
    return {};
  }
  if (!texture->name.empty()) named_.insert_or_assign(texture->name, texture);
  return texture;
}

void TextureReader::readFields(const Item& block, TextureNode& node) {
  const std::string_view keyword = node.model.keyword();
  RepeatedFields repeats(findings_, keyword);
  for (const Item field : block) {
    if (!isField(findings_, field, keyword)) continue;
    repeats.note(field);
    if (field.key() == kName)
      rayfile::read(findings_, kName, field.value(), node.name);
    else if (!assign(node.model, node.inputs, field, keyword) &&
             !assignField(findings_, node.placement, field))
      findings_.unknownField(keyword, field, keywords(node.model, {"name", "scale", "rotate", "translate"}));
  }
}

void TextureReader::define(const Item& value) {
  if (const auto texture = block(value); texture && (*texture)->name.empty())
    findings_.warn(value, "a texture without a name is never used");
}

// --- writing --------------------------------------------------------------------------------------------

namespace {

std::string blockText(const Texture& texture, int digits, WrittenTextures* names) {
  const TextureNode& node = *texture;
  std::string text = std::string(node.model.keyword()) + " { ";
  const auto add = [&](std::string_view keyword, const std::string& value) {
    text += std::string(keyword) + " = " + value + "; ";
  };
  if (!node.name.empty()) add("name", written(node.name, digits));
  const TextureModel usual(node.model.type());
  const std::vector<TextureField> all = node.model.fields(), unsaid = usual.fields();
  for (std::size_t i = 0; i < all.size(); ++i)
    visitValueOf(all[i], [&](const auto& value) {
      if (const Texture* input = textureOf(node.inputs, all[i].keyword))
        add(all[i].keyword, textured(*input, value, digits, names));
      else if (!sameValue(all[i], unsaid[i]))
        add(all[i].keyword, written(value, digits));
    });
  forEachField<TexturePlacement>([&](const auto& f) {
    const auto& value = node.placement.*f.member;
    if (value != TexturePlacement{}.*f.member) add(f.keyword, written(value, digits));
  });
  return text + "}";
}

/// The file, if `map("file")` stands for the texture.
const std::string* mappedFile(const Texture& texture) {
  const auto* map = texture->model.as<ImageMap>();
  return map && texture == mappedPicture(map->file.file) ? &map->file.file : nullptr;
}

}  // namespace

std::string textured(const Texture& texture, const std::string& constant, bool plain, int digits,
                     WrittenTextures* names) {
  if (const std::string* file = mappedFile(texture)) return "map(" + exactly(*file) + ", " + constant + ")";
  const auto before = names ? names->find(texture->name) : WrittenTextures::iterator();
  if (names && before != names->end() && before->second == texture)
    return "texture(" + written(texture->name, digits) + ", " + constant + ")";
  const std::string text = blockText(texture, digits, names);
  if (names && !texture->name.empty()) names->insert_or_assign(texture->name, texture);
  return plain ? text : "texture(" + text + ", " + constant + ")";
}

}  // namespace trace::rayfile

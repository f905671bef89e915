#include "formats/ray/ray_texture.h"

#include <algorithm>
#include <utility>

#include "base/file.h"
#include "base/text.h"
#include "formats/ray/ray_student_textures.h"
#include "shading/texture_flaws.h"

namespace trace::rayfile {
namespace {

constexpr std::string_view kMap = "map", kName = "name";

/// Calls visit(model) with a texture of that keyword; false if there is none.
template <class Visit>
bool withModel(std::string_view keyword, Visit&& visit) {
  bool found = false;
  forEachType<TextureModel>([&](auto* type) {
    using Model = std::remove_pointer_t<decltype(type)>;
    if (Model::kKeyword != keyword) return;
    found = true;
    visit(Model{});
  });
  return found;
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
  forEachType<TextureModel>(
      [&](auto* type) { kinds.push_back(std::remove_pointer_t<decltype(type)>::kKeyword); });
  return kinds;
}

Texture mappedPicture(std::string file, Place place) {
  ImageMap map;
  map.file = {std::move(file), nullptr, std::move(place)};
  map.wrapU = map.wrapV = Wrap::clamp;
  map.centersAtEnds = true;
  return TextureNode{.model = std::move(map)};
}

bool TextureReader::isTexture(const Item& value) const {
  if (isPictureFile(value)) return true;
  if (!value.is(Kind::call)) return false;
  return value.key() == kMap || value.key() == kTexture ||
         withModel(textureKeyword(value.key()), [](const auto&) {});
}

std::optional<TextureReader::Scaled> TextureReader::read(const Item& value) {
  const auto picture = [&](const Item& word) {
    findings_.scene().inputs.noteNamed(besideFile(findings_.syntax().file(), std::string(word.text())));
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
  TextureNode node;
  const bool known = call.is(Kind::call) && withModel(textureKeyword(call.key()),
                                                      [&](auto model) { node.model = std::move(model); });
  if (!known) {
    findings_.expected(call, kTexture, "a texture, as in checker { }",
                       call.is(Kind::call) ? didYouMean(call.key(), textureKinds()) : std::string());
    return {};
  }
  const std::optional<Item> fields = blockOf(findings_, call);
  if (!fields) return {};
  if (!std::holds_alternative<Marble>(node.model) || !readStudentMarble(findings_, *fields, node))
    readFields(*fields, node);
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
  match(node.model, [&](auto& model) {
    using Model = std::remove_cvref_t<decltype(model)>;
    RepeatedFields repeats(findings_, Model::kKeyword);
    for (const Item field : block) {
      if (!isField(findings_, field, Model::kKeyword)) continue;
      repeats.note(field);
      if (field.key() == kName)
        rayfile::read(findings_, kName, field.value(), node.name);
      else if (!assign(model, node.inputs, field) && !assignField(findings_, node.placement, field))
        findings_.unknownField(Model::kKeyword, field,
                               keywords<Model>({"name", "scale", "rotate", "translate"}));
    }
  });
}

void TextureReader::define(const Item& value) {
  if (const auto texture = block(value); texture && (*texture)->name.empty())
    findings_.warn(value, "a texture without a name is never used");
}

// --- writing --------------------------------------------------------------------------------------------

namespace {

template <class Struct>
void addFields(std::string& text, const Struct& from, const std::vector<FieldTexture>& textures, int digits,
               WrittenTextures* names) {
  const Struct otherwise{};
  forEachField<Struct>([&](const auto& f) {
    const auto& value = from.*f.member;
    using Value = std::remove_cvref_t<decltype(value)>;
    const Texture* texture = textureOf(textures, f.keyword);
    if (!texture && value == otherwise.*f.member) return;
    text += std::string(f.keyword) + " = ";
    if constexpr (std::is_same_v<Value, Color> || std::is_same_v<Value, Real>)
      text += texture ? textured(*texture, value, digits, names) : written(value, digits);
    else
      text += written(value, digits);
    text += "; ";
  });
}

std::string blockText(const Texture& texture, int digits, WrittenTextures* names) {
  const TextureNode& node = *texture;
  return match(node.model, [&](const auto& model) {
    std::string text = std::string(model.kKeyword) + " { ";
    if (!node.name.empty()) text += "name = " + written(node.name, digits) + "; ";
    addFields(text, model, node.inputs, digits, names);
    addFields(text, node.placement, {}, digits, nullptr);
    return text + "}";
  });
}

/// The file, if `map("file")` stands for the texture.
const std::string* mappedFile(const Texture& texture) {
  const auto* map = std::get_if<ImageMap>(&texture->model);
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

#include "formats/ray/write/patch_material.h"

#include <algorithm>
#include <utility>

#include "formats/ray/read/material.h"
#include "formats/ray/read/texture.h"
#include "formats/ray/write/patch_texture.h"
#include "shading/library.h"

namespace trace::rayfile {
namespace {

bool sameTexture(const Material& a, const Material& b, std::string_view field) {
  const Texture *x = textureOf(a.textures, field), *y = textureOf(b.textures, field);
  return x && y ? *x == *y : x == y;
}

template <class Value>
std::string valueText(const Material& material, std::string_view field, const Value& value) {
  const Texture* texture = textureOf(material.textures, field);
  return texture ? textured(*texture, value, 0) : written(value, 0);
}

/// Follows, as the reader does, whether the mirror has the colour of the highlight.
struct Mirror {
  bool specular, given = false;
  void meet(std::string_view key, bool namesSpecular) {
    if (key == "reflective") {
      given = !namesSpecular;
      specular = namesSpecular;
    } else if (key == "specular" && !given) {
      specular = true;
    }
  }
};

/// The start of a block: the material that it inherits, or names of the library.
Material startOf(const Item& block, const Material& inherited) {
  const std::optional<Item> named = fieldOf(block, kLibrary);
  std::optional<Material> found = named ? libraryMaterial(named->value().text()) : std::optional<Material>();
  if (!found) return inherited;
  if (block.syntax().isOfKind()) found->sides = inherited.sides;  // as the reader has it
  return *found;
}

/// The block gives the field itself.
bool saysOwn(const Item& block, std::string_view field) {
  return fieldOf(block, field) || (field == "bump" && fieldOf(block, "bump_mapping"));
}

bool namesSpecular(const Item& value) { return value.is(Kind::word) && value.text() == "specular"; }

}  // namespace

MaterialEdits::MaterialEdits(TextEdits& edits, const Notes& notes,
                             std::vector<std::optional<Material>> wanted)
    : edits_(edits), notes_(notes), wanted_(std::move(wanted)) {
  const auto isOther = [](const Material& m) { return !m.model.is<Phong>(); };
  for (const Notes::Block& block : notes_.blocks) hasModels_ |= isOther(block.material);
  for (const std::optional<Material>& material : wanted_) hasModels_ |= material && isOther(*material);
}

void MaterialEdits::want(const Item& call, std::uint32_t has, const Material& was, const Material& material) {
  const bool other = has >= wanted_.size() || !wanted_[has] || !(*wanted_[has] == material);
  const std::optional<Item> own = fieldOf(call.value(), Material::kKeyword);
  if (own) {
    if (other) instead_.insert_or_assign(own->value().offset(), material);
    return;
  }
  const auto inForce = notes_.inForce.find(call.offset());
  if (inForce == notes_.inForce.end()) return;
  const NotedMaterial& base = inForce->second;
  // No block says what shapes start from, or the grey of a mesh from a file.
  const bool stands = base.block == NotedMaterial::kNoBlock ? was == material : !other;
  if (!stands) additions_.insert_or_assign(call.offset(), Addition{call, material});
}

bool MaterialEdits::isDropped(std::size_t offset) const {
  return std::any_of(dropped_.begin(), dropped_.end(),
                     [&](const auto& range) { return range.first <= offset && offset < range.second; });
}

bool MaterialEdits::isKnown(const Material& material) const {
  const auto found = material.name.empty() ? named_.end() : named_.find(material.name);
  return found != named_.end() && found->second == material;
}

void MaterialEdits::define(const Material& material) {
  if (!material.name.empty()) named_.insert_or_assign(material.name, material);
}

void MaterialEdits::run() {
  for (const Notes::Block& block : notes_.blocks) now_.push_back(block.material);
  auto next = additions_.begin();
  for (const Notes::Use& use : notes_.uses) {
    for (; next != additions_.end() && next->first < use.offset; ++next) add(next->second);
    this->use(use);
  }
  for (; next != additions_.end(); ++next) add(next->second);
}

const Material& MaterialEdits::now(const NotedMaterial& material) const {
  return material.block == NotedMaterial::kNoBlock ? material : now_[material.block];
}

void MaterialEdits::use(const Notes::Use& use) {
  if (use.block == NotedMaterial::kNoBlock) return;
  const Notes::Block& block = notes_.blocks[use.block];
  const bool counts = block.index < wanted_.size() && wanted_[block.index];
  if (isDropped(use.offset)) {
    if (counts) now_[use.block] = *wanted_[block.index];
    return;
  }
  if (!seen_.insert(use.offset).second) return;  // the objects of particles are read several times
  const auto instead = instead_.find(use.offset);
  const std::optional<Item> item = edits_.syntax().itemAt(use.offset);
  if (!item) return;

  if (item->is(Kind::word)) {
    const Material& wanted = instead == instead_.end() ? now_[use.block] : instead->second;
    const auto means = named_.find(std::string(item->text()));
    if (means != named_.end() && means->second == wanted) return;
    if (isKnown(wanted)) return edits_.replace(*item, written(wanted.name, 0));
    edits_.replace(*item, blockText({}, wanted, true));
    return define(wanted);
  }

  const Material from =
      startOf(*item, block.inherits == NotedMaterial::kNoBlock ? block.inherited : now_[block.inherits]);
  if (instead != instead_.end()) {
    const Material& wanted = instead->second;
    now_[use.block] = wanted;
    if (isKnown(wanted)) return edits_.replace(*item, written(wanted.name, 0));
    edits_.replace(*item, blockText(from, wanted, false));
    return define(wanted);
  }
  const Material wanted = counts ? *wanted_[block.index] : followed(*item, from, block.material);
  changeBlock(*item, from, block.material, wanted);
  now_[use.block] = wanted;
  define(wanted);
}

/// The material of the block if its text stays and what it inherits from is `from`. If that is of another
/// model, and the block names none, the block keeps what it said.
Material MaterialEdits::followed(const Item& block, const Material& from, const Material& was) const {
  if (&from.model.type() != &was.model.type() && !fieldOf(block, kModel)) return was;
  Material result = was;
  result.model = converted(from.model, was.model);
  std::erase_if(result.textures, [&](const FieldTexture& t) { return !saysOwn(block, t.field); });
  std::vector<ModelField> fields = result.model.editFields();
  const std::vector<ModelField> before = was.model.fields();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::optional<Item> given = fieldOf(block, fields[i].keyword);
    if (given && !namesSpecular(given->value()))
      takeValue(fields[i], before[i]);
    else if (const Texture* texture = textureOf(from.textures, fields[i].keyword))
      setTexture(result.textures, fields[i].keyword, *texture);
  }
  if (Phong* phong = result.model.edit<Phong>()) {
    Mirror mirror{phong->mirrorsSpecular};
    for (const Item item : block)
      if (item.keyed()) mirror.meet(canonical(item.key()), namesSpecular(item.value()));
    phong->mirrorsSpecular = mirror.specular;
  }
  forEachField<Material>([&](const auto& f) {
    if (saysOwn(block, f.keyword)) return;
    result.*f.member = from.*f.member;
    if (const Texture* texture = textureOf(from.textures, f.keyword))
      setTexture(result.textures, f.keyword, *texture);
  });
  return result;
}

template <class Value>
void MaterialEdits::changeValue(const Item& item, const Material& was, const Value& from,
                                const Material& wanted, const Value& to, std::string_view field) {
  const Texture *before = textureOf(was.textures, field), *now = textureOf(wanted.textures, field);
  if (before && now && changeTexture(edits_, item, *before, written(from, 0), *now, written(to, 0))) return;
  const std::string indent = std::string(edits_.indentAt(item.offset())) + "    ";
  edits_.change(item, laidOut(valueText(wanted, field, to), indent));
}

void MaterialEdits::changeBlock(const Item& block, const Material& from, const Material& was,
                                const Material& wanted) {
  if (&was.model.type() != &wanted.model.type()) return edits_.replace(block, blockText(from, wanted, false));
  if (const std::optional<Item> name = fieldOf(block, "name"); name && was.name != wanted.name) {
    if (wanted.name.empty())
      edits_.erase(*name);
    else
      edits_.change(name->value(), written(wanted.name, 0));
  }
  const std::vector<ModelField> before = was.model.fields(), after = wanted.model.fields();
  for (std::size_t i = 0; i < after.size(); ++i) {
    const std::string_view keyword = after[i].keyword;
    const std::optional<Item> given = fieldOf(block, keyword);
    if (!given || (sameValue(before[i], after[i]) && sameTexture(was, wanted, keyword))) continue;
    visitValueOf(after[i], [&]<class Value>(const Value& value) {
      const Value& old = valueOf<Value>(before[i]);
      changeValue(given->value(), was, old, wanted, value, keyword);
    });
  }
  forEachField<Material>([&](const auto& f) {
    const auto& value = wanted.*f.member;
    const bool same = was.*f.member == value && sameTexture(was, wanted, f.keyword);
    if (const auto given = fieldOf(block, f.keyword); given && !same)
      changeValue(given->value(), was, was.*f.member, wanted, value, f.keyword);
  });
  for (const std::string& field : missing(&block, from, wanted, false)) edits_.addField(block, field);
}

/// The fields that a block lacks which starts as a copy of `from` and is to say `wanted`.
MaterialEdits::Fields MaterialEdits::missing(const Item* block, const Material& from, const Material& wanted,
                                             bool all) const {
  Fields fields;
  const auto given = [&](std::string_view key) { return block && fieldOf(*block, key); };
  if (!wanted.name.empty() && !given("name")) fields.push_back("name = " + written(wanted.name, 0));
  const bool otherModel = &from.model.type() != &wanted.model.type();
  if (!given(kModel) && (otherModel || (all && hasModels_)))
    fields.push_back(std::string(kModel) + " = " + std::string(wanted.model.keyword()));
  const Material start = withModel(from, wanted.model);
  const auto *phong = wanted.model.as<Phong>(), *phongBefore = start.model.as<Phong>();
  Mirror mirror{phong && phongBefore->mirrorsSpecular};
  if (phong && block) {
    const bool changed = !(phongBefore->reflective == phong->reflective);
    for (const Item item : *block)
      if (item.keyed()) mirror.meet(canonical(item.key()), namesSpecular(item.value()) && !changed);
  }
  const auto add = [&](std::string_view key, const std::string& value) {
    fields.push_back(std::string(key) + " = " + value);
    mirror.meet(key, value == "specular");
  };
  const std::vector<ModelField> before = start.model.fields(), after = wanted.model.fields();
  for (std::size_t i = 0; i < after.size(); ++i) {
    const std::string_view keyword = after[i].keyword;
    if (given(keyword)) continue;
    if (all || !sameValue(before[i], after[i]) || !sameTexture(start, wanted, keyword))
      visitValueOf(after[i], [&](const auto& value) { add(keyword, valueText(wanted, keyword, value)); });
  }
  if (phong && mirror.specular != phong->mirrorsSpecular)
    add("reflective", mirror.specular ? valueText(wanted, "reflective", phong->reflective) : "specular");
  forEachField<Material>([&](const auto& f) {
    const auto& value = wanted.*f.member;
    const bool same = from.*f.member == value && sameTexture(from, wanted, f.keyword);
    if (!(block && saysOwn(*block, f.keyword)) && !same)
      fields.push_back(std::string(f.keyword) + " = " + valueText(wanted, f.keyword, value));
  });
  return fields;
}

std::string MaterialEdits::blockText(const Material& from, const Material& wanted, bool whole) const {
  Fields fields = missing(nullptr, from, wanted, whole);
  if (std::optional<Material> own = whole ? std::nullopt : libraryMaterial(wanted.name)) {
    // One of the library, perhaps changed a little, says so.
    constexpr std::size_t kLittle = 3;  // fields, its name among them
    own->sides = edits_.syntax().isOfKind() ? from.sides : own->sides;
    own->name.clear();
    if (Fields changed = missing(nullptr, *own, wanted, false); changed.size() <= kLittle) {
      changed.insert(changed.begin() + 1, std::string(kLibrary) + " = " + written(wanted.name, 0));
      fields = std::move(changed);
    }
  }
  const auto* phong = wanted.model.as<Phong>();
  if (fields.empty() && phong && edits_.syntax().isOfKind())  // an empty block would be grey
    fields.push_back("diffuse = " + valueText(wanted, "diffuse", phong->diffuse));
  std::string text = "{ ";
  for (const std::string& field : fields) text += field + "; ";
  return laidOut(text + "}", "    ");
}

void MaterialEdits::add(const Addition& addition) {
  if (isDropped(addition.call.offset())) return;
  const Material& from = now(notes_.inForce.at(addition.call.offset()));
  const std::string text = isKnown(addition.material) ? written(addition.material.name, 0)
                                                      : blockText(from, addition.material, false);
  define(addition.material);
  edits_.addField(addition.call.value(), "material = " + text);
}

std::string MaterialEdits::text(const Material& material, bool whole) {
  if (isKnown(material)) return written(material.name, 0);
  define(material);
  return blockText(now(notes_.last), material, whole);
}

}  // namespace trace::rayfile

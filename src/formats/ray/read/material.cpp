#include "formats/ray/read/material.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/files/file.h"
#include "base/text.h"
#include "formats/model.h"
#include "formats/ray/read/fields.h"
#include "shading/library.h"
#include "shading/textures/image_map.h"
#include "shading/textures/mix.h"

namespace trace::rayfile {
namespace {

std::size_t mixed(std::size_t hash, std::size_t more) {
  return (hash ^ more) * 0x9e3779b97f4a7c15u + (hash >> 29);
}

std::size_t hashOf(const Material& material) {
  std::size_t hash = mixed(std::hash<std::string>{}(material.name), material.model.type().index);
  for (const FieldTexture& t : material.textures)
    hash = mixed(hash, std::hash<std::string>{}(t.field + summary(t.texture)));
  const auto add = [&](double number) { hash = mixed(hash, std::hash<double>{}(number)); };
  forEachField(material.model, [&](const ModelField&, const auto& value) {
    if constexpr (requires { value.r; }) {
      add(value.r);
      add(value.g);
      add(value.b);
    } else if constexpr (requires { value.size(); })
      add(static_cast<double>(value.size()));
    else if constexpr (requires { value.index(); })
      add(static_cast<double>(value.index()));
    else
      add(static_cast<double>(value));
  });
  return hash;
}

/// The names in a sentence: "a, b or c".
std::string list(const std::vector<std::string_view>& names, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0                  ? ""
             : i + 1 == names.size() ? " " + std::string(last) + " "
                                     : ", ") +
            std::string(names[i]);
  return text;
}

/// `map("file")` inside `texture(map("file"))`; any other value as it is.
Item insideTexture(const Item& value) {
  const bool wraps = value.is(Kind::call) && value.key() == kTexture && value.value().is(Kind::tuple) &&
                     value.value().count() == 1 && (*value.value().begin()).is(Kind::call);
  return wraps ? *value.value().begin() : value;
}

/// `normal = "file"` or `normal_map = map("file")`, of students at Hong Kong: a picture of normals.
bool isNormalMap(const Item& field) {
  if (field.key() != "normal" && field.key() != "normal_map") return false;
  const Item value = insideTexture(field.value());
  if (value.is(Kind::word)) return true;
  if (!value.is(Kind::call) || value.key() != "map" || !value.value().is(Kind::tuple)) return false;
  return value.value().count() == 1 && (*value.value().begin()).is(Kind::word);
}

/// The block says something of how it looks.
bool saysLooks(const Item& block) {
  for (const Item item : block)
    if (!item.keyed() || (item.key() != "name" && item.key() != "sides")) return true;
  return false;
}

/// `reflective = specular`.
bool mirrorsSpecular(const Item& field) {
  return field.key() == "reflective" && field.value().is(Kind::word) && field.value().text() == "specular";
}

}  // namespace

/// `pattern_scale` and the like: a field of TexturePlacement, for all patterns of the material.
static bool readPatternField(Findings& findings, TexturePlacement& to, const Item& field) {
  constexpr std::string_view kPattern = "pattern_";
  if (!field.key().starts_with(kPattern)) return false;
  bool known = false;
  forEachField<TexturePlacement>([&](const auto& f) {
    if (f.keyword != field.key().substr(kPattern.size())) return;
    known = true;
    Real factor = 1;
    if (f.keyword == "scale" && field.value().is(Kind::number)) {
      if (read(findings, field.key(), field.value(), factor)) to.*f.member = Vec3{factor, factor, factor};
    } else {
      read(findings, field.key(), field.value(), to.*f.member);
    }
  });
  return known;
}

/// Pictures in u and v stay where they are. Returns the number of patterns.
static int movePatterns(Material& material, const TexturePlacement& placement) {
  int count = 0;
  for (FieldTexture& t : material.textures) {
    if (wantsUv(t.texture)) continue;
    TextureNode moved = *t.texture;
    if (!(moved.placement == TexturePlacement{})) {  // within its own
      moved = {.model = Mix{.a = Color(1), .b = Color(1), .amount = 0}};
      setTexture(moved.inputs, "a", t.texture);
    }
    moved.placement = placement;
    t.texture = std::move(moved);
    ++count;
  }
  return count;
}

/// A material block being read.
struct Materials::Block {
  Material material;
  bool gaveReflective = false;
  std::optional<Item> shininess;
  TexturePlacement patterns{};  ///< where all its patterns go
  bool unquoted = false;        ///< a name of several words without quotation marks was met
};

/// How a colour or a texture, which is no material, is given to one.
std::string Materials::asMaterial(const Item& value) const {
  constexpr std::size_t kLongest = 40;
  const std::string_view source = value.source();
  if (!findings_.isOfKind() || source.size() > kLongest) return {};
  if (value.is(Kind::tuple) && value.count() == 3)
    return "material = { diffuse = " + std::string(source) + " } has that colour";
  if (textures_.isTexture(value))
    return "a texture is the value of a field: material = { diffuse = " + std::string(source) + " }";
  return {};
}

NotedMaterial Materials::read(const Item& value, const NotedMaterial& inherited) {
  if (value.is(Kind::word)) {
    const auto found = named_.find(value.text());
    if (found != named_.end()) {
      found->second.used = true;
      if (Notes* notes = findings_.notes())
        notes->uses.push_back({value.offset(), found->second.material.block});
      return found->second.material;
    }
    std::vector<std::string_view> names;
    for (const auto& [name, material] : named_) names.push_back(name);
    std::string hint = didYouMean(value.text(), names);
    const std::vector<std::string_view> library = libraryNames();
    if (std::find(library.begin(), library.end(), value.text()) != library.end())
      hint = "{ library = " + std::string(value.text()) + " } takes it from the library";
    if (hint.empty())
      hint = std::string("a material is named before its first use: ") +
             (findings_.isOfKind() ? "let foo = material { ... }" : "material = { name = foo; ... }");
    findings_.error(value, "expected the name of a material, found " + describe(value), std::move(hint));
    return inherited;
  }
  if (!value.is(Kind::block)) {
    findings_.expected(value, "material", "{ ... } or the name of a material", asMaterial(value));
    return inherited;
  }

  Block block{inherited, false, {}};
  block.material.name.clear();
  if (const std::optional<Item> model = modelOf(value)) chooseModel(block, *model);
  RepeatedFields repeats(findings_, Material::kKeyword);
  for (const Item item : value) {
    if (item.is(Kind::word) && block.unquoted) continue;  // the rest of a name, which was told
    // It takes nothing back: the colour counts where a convention does not mirror with the highlight.
    if (item.keyed() && !mirrorsSpecular(item)) repeats.note(item);
    field(block, item);
  }
  if (!(block.patterns == TexturePlacement{}) && movePatterns(block.material, block.patterns) == 0)
    findings_.warn(value, "pattern_scale and the like: this material has no pattern",
                   "stones and woods of the library have, and so have textures such as wood { }");
  const Phong* phong = block.material.model.as<Phong>();
  if (phong) warnOfInheritedGlass(value, inherited);
  if (phong && block.shininess && !isBlack(phong->specular))
    findings_.noteShininess(*block.shininess, phong->shininess);
  markUsed(inherited.name);
  NotedMaterial result = noted(std::move(block.material), value, inherited);
  result.given = inherited.given || saysLooks(value);
  if (result.name.empty()) return result;
  Named named{result, findings_.syntax().shortPlace(value.offset())};
  if (const auto before = named_.find(result.name); before != named_.end()) {
    const Material& other = before->second.material;
    if (before->second.place != named.place && other != result)
      findings_.warn(value, "a second material is called \"" + result.name.substr(0, 60) +
                                "\": it counts from here on, that of line " +
                                std::to_string(before->second.place.line) + " no longer");
  }
  named_.insert_or_assign(result.name, std::move(named));
  return result;
}

NotedMaterial Materials::noted(Material material, const Item& block, const NotedMaterial& inherited) {
  NotedMaterial result(std::move(material));
  if (Notes* notes = findings_.notes()) {
    result.block = static_cast<std::uint32_t>(notes->blocks.size());
    notes->blocks.push_back({inherited.block, inherited, result});
    notes->uses.push_back({block.offset(), result.block});
  }
  return result;
}

std::optional<Item> Materials::modelOf(const Item& block) {
  for (const Item item : block)
    if (item.keyed() && item.key() == kModel) return item.value();
  return {};
}

/// The fields that the block starts from and the other model has stay; the rest are the model's defaults.
void Materials::chooseModel(Block& block, const Item& value) {
  std::string word;
  if (value.is(Kind::word)) word = value.text();
  if (const ModelType* model = findModelType(word)) {
    block.material = withModel(std::move(block.material), MaterialModel(*model));
    return;
  }
  const std::vector<std::string_view> known = modelKeywords();
  std::string hint = didYouMean(word, known);
  findings_.expected(value, kModel, "the name of a shading model",
                     hint.empty() ? "there are " + list(known, "and") : std::move(hint));
}

void Materials::field(Block& block, const Item& field) {
  if (!field.keyed())
    return findings_.expected(
        field, "material", "a field, as in diffuse = (1, 1, 1)",
        field.is(Kind::number) ? "the three numbers of a colour stand in parentheses" : "");
  const std::string_view key = field.key();
  if (key == kModel) return;  // chosen before
  if (key == "name") {
    rayfile::read(findings_, key, field.value(), block.material.name);
    return;
  }
  if (key == kLibrary) return fromLibrary(block, field.value());
  if (readPatternField(findings_, block.patterns, field)) return;
  Phong* phong = block.material.model.edit<Phong>();
  if (phong && mirrorsSpecular(field)) {
    block.gaveReflective = false;
    phong->mirrorsSpecular = true;
    return;
  }
  const bool isNumber = field.value().is(Kind::number);
  if (key == "bump" && !textures_.isTexture(field.value()) && !(isNumber && field.value().number() == 0))
    return findings_.expected(field.value(), "bump",
                              "a texture of heights, as in bump = texture(noise { }, 0.1), or 0");
  if (!pattern(block, field)) {
    if (!textures_.assign(block.material.model, block.material.textures, field, Material::kKeyword) &&
        !textures_.assign(block.material, block.material.textures, field, Material::kKeyword) &&
        !studentBump(block, field))
      return unknownField(block, field);
    forEachField(block.material.model, [&]<class Value>(const ModelField& f, const Value& value) {
      if constexpr (std::is_same_v<Value, Real>)
        if (key == "index" && f.keyword == key && value == 0)
          findings_.warn(field, "index of material: nothing has an index of 0",
                         "air has 1, water 1.33, glass 1.5");
    });
    if (key == "shininess" && field.value().is(Kind::number)) block.shininess = field;
    warnOfHuge(block.material, field);
  }
  if (!phong) return;
  if (key == "reflective") {
    block.gaveReflective = true;
    phong->mirrorsSpecular = false;
  }
  if (key == "specular" && !block.gaveReflective) phong->mirrorsSpecular = true;
}

/// A value without an upper limit that is nevertheless too large.
void Materials::warnOfHuge(const Material& material, const Item& field) {
  constexpr Real kBrightest = 1e12, kHighest = 1e9;
  if (field.key() == "bump" && std::abs(material.bump) > kHighest)
    findings_.warn(field,
                   "bump of material: expected heights of the object's size, found " + toText(material.bump) +
                       ": every normal lies in the surface",
                   "bump = texture(noise { }, 0.1) is usual");
  if (field.key() != kEmissive) return;
  const Real most = maxComponent(phongOf(material.model).emissive);
  if (most > kBrightest)
    findings_.warn(field, "emissive of material: expected 0 to 1e12, found " + toText(most),
                   "the sun's disk is 50000 times as bright as white paper in it");
}

/// Files of the courses have fields that no program knows any more; who names a model means it.
void Materials::unknownField(const Block& block, const Item& field) {
  const std::string_view key = field.key();
  const MaterialModel& model = block.material.model;
  if (!model.is<Phong>()) {
    const auto fields =
        keywords(model, {"name", "bump", kOpacity, "casts_shadow", "displacement", "displacement_levels",
                         "pattern_scale", "pattern_rotate", "pattern_translate", "pattern_space"});
    const std::string meant = didYouMean(key, fields);
    return findings_.error(
        field,
        "the shading model " + std::string(model.keyword()) + " has no field \"" + std::string(key) + "\"",
        meant.empty() ? "it has " + list(fields, "and") : meant);
  }
  std::vector<std::string_view> having;
  for (const ModelType& type : modelTypes())
    for (const ModelField& f : MaterialModel(type).fields())
      if (f.keyword == key) having.push_back(type.keyword);
  if (having.empty() && (key == kTexture || key == "map") && findings_.isOfKind())
    return findings_.error(field, "material has no field \"" + std::string(key) + "\"",
                           "a texture takes the place of a field's value: diffuse = map(\"a.png\")");
  if (having.empty())
    return findings_.unknownField(Material::kKeyword, field,
                                  keywords(model, {"name", "bump", kOpacity, "casts_shadow", "displacement",
                                                   "displacement_levels", "pattern_scale", "pattern_rotate",
                                                   "pattern_translate", "pattern_space", kModel, kLibrary}));
  const std::string of = "it is one of model = " + list(having, "or");
  if (findings_.isOfKind())
    return findings_.error(
        field, "material has no field \"" + std::string(key) + "\": " + of,
        key == kColor ? "diffuse = (red, green, blue) is its colour"
                      : "name the model first, as in material = { model = " + std::string(having.front()) +
                            "; " + std::string(key) + " = ... }");
  findings_.warn(field, "unknown field \"" + std::string(key) + "\" of material is ignored: " + of,
                 "say which model, before the field");
}

/// For the first word of a name of several.
static std::string inQuotes(const std::string& word) {
  for (const std::string_view name : libraryNames())
    if (name.starts_with(word + " "))
      return "a name of several words stands in quotation marks: \"" + std::string(name) + "\"";
  return {};
}

/// Starts the block as a copy of a material of the library; its name stays.
void Materials::fromLibrary(Block& block, const Item& value) {
  std::string name;
  if (!rayfile::read(findings_, kLibrary, value, name)) return;
  const std::optional<Material> found = libraryMaterial(name);
  if (!found) {
    std::string hint = value.source().starts_with('"') ? "" : inQuotes(name);
    block.unquoted = !hint.empty();
    if (hint.empty()) hint = nearInLibrary(name);
    if (hint.empty()) hint = "ray materials lists them; diffuse = (red, green, blue) makes a colour";
    findings_.error(value, "library: expected the name of a material, found " + describe(value),
                    std::move(hint));
    return;
  }
  std::string own = std::move(block.material.name);
  const ShadedSides sides = findings_.isOfKind() ? block.material.sides : found->sides;
  block.material = *found;
  block.material.sides = sides;
  block.material.name = std::move(own);
}

/// Is the field given by a pattern that Trace does not render? White shows where it goes.
bool Materials::pattern(Block& block, const Item& field) {
  const Item value = field.value();
  if (!value.is(Kind::call) || textures_.isTexture(value) || !isRelative(value.key())) return false;
  bool known = false;
  editEachField(block.material.model, [&]<class Value>(const ModelField& f, Value& constant) {
    if (f.keyword != field.key()) return;
    known = true;
    if constexpr (std::is_same_v<Value, Color>) constant = Color(1);
  });
  if (known) findings_.notRendered(value.key(), value, {});
  return known;
}

/// `bump_mapping = bump("file")`, of a student at Austin: heights, of which only the differences from texel
/// to texel counted. The height is ours.
bool Materials::studentBump(Block& block, const Item& field) {
  constexpr Real kHeight = 0.02;
  const Item value = field.value();
  if (isNormalMap(field)) {
    const Item map = insideTexture(value);
    std::string file(map.is(Kind::word) ? map.text() : (*map.value().begin()).text());
    Texture picture = mappedPicture(std::move(file), findings_.syntax().shortPlace(map.offset()));
    TextureNode normals = *picture;
    normals.model.edit<ImageMap>()->relief = Relief::normals;
    setTexture(block.material.textures, "bump", std::move(normals));
    block.material.bump = 1;
    return true;
  }
  if (field.key() != "bump_mapping" || !value.is(Kind::call) || value.key() != "bump") return false;
  const Item tuple = value.value();
  if (!tuple.is(Kind::tuple) || tuple.count() != 1 || !(*tuple.begin()).is(Kind::word)) {
    findings_.expected(value, "bump_mapping", "bump(\"file\")");
    return true;
  }
  setTexture(
      block.material.textures, "bump",
      mappedPicture(std::string((*tuple.begin()).text()), findings_.syntax().shortPlace(value.offset())));
  block.material.bump = kHeight;
  return true;
}

/// Whoever describes all looks of a material but that it is glass seldom wants the glass of another.
void Materials::warnOfInheritedGlass(const Item& block, const Material& inherited) {
  const Phong before = phongOf(inherited);
  if (!before.transmits()) return;
  bool looks = false;
  for (const Item item : block) {
    if (!item.keyed()) continue;
    if (item.key() == "transmissive" || item.key() == "index" || item.key() == kLibrary) return;
    looks |= item.key() == "diffuse";
  }
  if (!looks) return;
  const std::string of = inherited.name.empty() ? "the material in force" : "\"" + inherited.name + "\"";
  findings_.warn(block, std::string(kInheritsGlass) + " of " + of + ", which it starts as a copy of",
                 "add transmissive = (0, 0, 0) if it is to be opaque, or transmissive with a value",
                 kInheritsGlass);
}

void Materials::markUsed(const std::string& name) {
  if (const auto found = named_.find(name); found != named_.end()) found->second.used = true;
}

std::vector<UnusedMaterial> Materials::unused() const {
  std::vector<UnusedMaterial> all;
  for (const auto& [name, named] : named_)
    if (!named.used) all.push_back({name, named.place});
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.place.line < b.place.line; });
  return all;
}

NotedMaterial Materials::completed(NotedMaterial material) const {
  if (material.given || !findings_.isOfKind()) return material;
  makePlain(material);
  material.given = true;
  return material;
}

std::uint32_t Materials::index(const NotedMaterial& material) {
  std::uint32_t index;
  if (material.given || !findings_.isOfKind()) {
    index = this->index(static_cast<const Material&>(material));
  } else {
    const auto [known, isNew] = leftOut_.try_emplace({material.name, material.sides});
    if (isNew) known->second = this->index(static_cast<const Material&>(completed(material)));
    index = known->second;
  }
  if (Notes* notes = findings_.notes(); notes && material.block != NotedMaterial::kNoBlock)
    notes->blocks[material.block].index = index;
  return index;
}

std::uint32_t Materials::index(const Material& material) {
  markUsed(material.name);
  std::vector<Material>& all = findings_.scene().materials;
  if (last_ && all[*last_] == material) return *last_;
  const std::size_t hash = hashOf(material);
  const auto [first, last] = byHash_.equal_range(hash);
  for (auto found = first; found != last; ++found)
    if (all[found->second] == material) return *(last_ = found->second);
  last_ = static_cast<std::uint32_t>(all.size());
  all.push_back(material);
  byHash_.emplace(hash, *last_);
  return *last_;
}

}  // namespace trace::rayfile

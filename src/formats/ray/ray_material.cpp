#include "formats/ray/ray_material.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/file.h"
#include "base/text.h"
#include "formats/ray/ray_fields.h"
#include "formats/ray/ray_format.h"
#include "shading/substances.h"

namespace trace::rayfile {
namespace {

std::size_t mixed(std::size_t hash, std::size_t more) {
  return (hash ^ more) * 0x9e3779b97f4a7c15u + (hash >> 29);
}

std::size_t hashOf(const Material& material, const Phong& phong) {
  std::size_t hash = std::hash<std::string>{}(material.name);
  for (const FieldTexture& t : material.textures)
    hash = mixed(hash, std::hash<std::string>{}(t.field + summary(t.texture)));
  const auto add = [&](double number) { hash = mixed(hash, std::hash<double>{}(number)); };
  forEachField<Phong>([&](const auto& f) {
    const auto& value = phong.*f.member;
    if constexpr (requires { value.r; })
      add(value.r), add(value.g), add(value.b);
    else
      add(static_cast<double>(value));
  });
  return hash;
}

}  // namespace

/// A material block being read.
struct Materials::Block {
  Material material;
  Phong phong;
  bool gaveReflective = false;
  std::optional<Item> shininess;
};

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
    if (hint.empty()) hint = "a material is named before its first use: material = { name = foo; ... }";
    findings_.error(value, "expected the name of a material, found " + describe(value), std::move(hint));
    return inherited;
  }
  if (!value.is(Kind::block)) {
    findings_.expected(value, "material", "{ ... } or the name of a material");
    return inherited;
  }

  Block block{inherited, phongOf(inherited), false, {}};
  block.material.name.clear();
  RepeatedFields repeats(findings_, Phong::kKeyword);
  for (const Item item : value) {
    if (item.keyed()) repeats.note(item);
    field(block, item);
  }
  warnOfInheritedGlass(value, inherited);
  block.material.model = block.phong;
  if (block.shininess && !isBlack(block.phong.specular))
    findings_.noteShininess(*block.shininess, block.phong.shininess);
  markUsed(inherited.name);
  NotedMaterial result = noted(std::move(block.material), value, inherited);
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

void Materials::field(Block& block, const Item& field) {
  if (!field.keyed()) return findings_.expected(field, "material", "a field, as in diffuse = (1, 1, 1)");
  const std::string_view key = field.key();
  if (key == "name") {
    rayfile::read(findings_, key, field.value(), block.material.name);
    return;
  }
  if (key == kLibrary) return fromLibrary(block, field.value());
  if (key == "reflective" && field.value().is(Kind::word) && field.value().text() == "specular") {
    block.gaveReflective = false, block.phong.mirrorsSpecular = true;
    return;
  }
  if (!pattern(block, field)) {
    if (!textures_.assign(block.phong, block.material.textures, field))
      return findings_.unknownField(Phong::kKeyword, field, keywords<Phong>({"name", kLibrary}));
    if (key == "index" && block.phong.index == 0)
      findings_.warn(field, "index of material: expected a number above 0, found 0",
                     "air has 1, water 1.33, glass 1.5");
    if (key == "shininess" && field.value().is(Kind::number)) block.shininess = field;
  }
  if (key == "reflective") block.gaveReflective = true, block.phong.mirrorsSpecular = false;
  if (key == "specular" && !block.gaveReflective) block.phong.mirrorsSpecular = true;
}

/// Starts the block as a copy of a material of the library; its name stays.
void Materials::fromLibrary(Block& block, const Item& value) {
  std::string name;
  if (!rayfile::read(findings_, kLibrary, value, name)) return;
  const std::optional<Material> found = libraryMaterial(name);
  if (!found) {
    std::string hint = didYouMean(name, libraryNames());
    if (hint.empty()) hint = "docs/indices.md lists them, as in library = water";
    findings_.error(value, "library: expected the name of a material, found " + describe(value),
                    std::move(hint));
    return;
  }
  block.material.textures.clear();
  block.phong = phongOf(*found);
}

/// Is the field given by a pattern that Trace does not render? White shows where it goes.
bool Materials::pattern(Block& block, const Item& field) {
  const Item value = field.value();
  if (!value.is(Kind::call) || textures_.isTexture(value) || !isRelative(value.key())) return false;
  bool known = false;
  forEachField<Phong>([&](const auto& f) {
    if (f.keyword != field.key()) return;
    known = true;
    auto& constant = block.phong.*f.member;
    if constexpr (requires { constant.r; }) constant = Color(1);
  });
  if (known) findings_.notRendered(value.key(), value, {});
  return known;
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

std::uint32_t Materials::index(const NotedMaterial& material) {
  const std::uint32_t index = this->index(static_cast<const Material&>(material));
  if (Notes* notes = findings_.notes(); notes && material.block != NotedMaterial::kNoBlock)
    notes->blocks[material.block].index = index;
  return index;
}

std::uint32_t Materials::index(const Material& material) {
  markUsed(material.name);
  std::vector<Material>& all = findings_.scene().materials;
  const std::size_t hash = hashOf(material, phongOf(material));
  const auto [first, last] = byHash_.equal_range(hash);
  for (auto found = first; found != last; ++found)
    if (all[found->second] == material) return found->second;
  const auto added = static_cast<std::uint32_t>(all.size());
  all.push_back(material);
  byHash_.emplace(hash, added);
  return added;
}

}  // namespace trace::rayfile

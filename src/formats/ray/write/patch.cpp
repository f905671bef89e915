#include "formats/ray/write/patch.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "base/files/file.h"
#include "formats/ray/file/format.h"
#include "formats/ray/file/students.h"
#include "formats/ray/syntax/names.h"
#include "formats/ray/write/edits.h"
#include "formats/ray/write/outline.h"
#include "formats/ray/write/round.h"
#include "formats/ray/write/same.h"
#include "formats/ray/write/writer.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "scene/rows.h"

namespace trace {
namespace rayfile {
namespace {

namespace fs = std::filesystem;

constexpr int kMostRounds = 4;

/// Lights of the kind of file have none.
bool samePlace(const SourcePlace& a, const SourcePlace& b) {
  return a.file == b.file && a.line == b.line && a.column == b.column;
}

/// Which thing of `before` each of `after` is, by its place in the text: the k-th of several at one place.
/// New ones go to the end.
template <class Thing>
std::vector<std::size_t> matched(const std::vector<Thing>& before, std::vector<Thing>& after) {
  std::map<std::pair<int, int>, std::vector<std::size_t>> places;
  for (std::size_t i = before.size(); i-- > 0;)
    places[{before[i].place.line, before[i].place.column}].push_back(i);
  std::vector<std::pair<std::size_t, Thing>> all;
  for (Thing& thing : after) {
    auto found = places.find({thing.place.line, thing.place.column});
    const bool known = found != places.end() && !found->second.empty() &&
                       samePlace(before[found->second.back()].place, thing.place);
    all.emplace_back(known ? found->second.back() : Wanted::kNew, std::move(thing));
    if (known) found->second.pop_back();
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::size_t> indices;
  after.clear();
  for (auto& [index, thing] : all) {
    indices.push_back(index);
    after.push_back(std::move(thing));
  }
  return indices;
}

/// With the materials that blocks of the text say as they are to become: those blocks are changed.
Scene withWantedMaterials(const Reading& now, const Wanted& wanted) {
  Scene scene;
  scene.materials = now.scene.materials;
  for (const Notes::Block& block : now.notes.blocks)
    if (block.index < wanted.materials.size() && wanted.materials[block.index])
      scene.materials.at(block.index) = *wanted.materials[block.index];
  return scene;
}

/// Objects that stand in one place of the text together, such as particles, stay together or become single
/// objects at the end of the file.
void breakUpChanged(const Reading& now, Wanted& wanted, Messages& messages) {
  const Scene& from = now.scene;
  const Outline outline(*now.syntax);
  const Scene becoming = withWantedMaterials(now, wanted);
  std::vector<bool> changed(from.objects.size(), false);
  std::vector<std::size_t> kept(from.objects.size(), Wanted::kNew);
  for (std::size_t i = 0; i < wanted.objects.size(); ++i)
    if (wanted.objects[i] != Wanted::kNew) kept[wanted.objects[i]] = i;
  for (std::size_t first = 0; first < from.objects.size();) {
    std::size_t end = first + 1;
    while (end < from.objects.size() && samePlace(from.objects[end].place, from.objects[first].place)) ++end;
    if (from.objects[first].place.file != now.syntax->file() || from.objects[first].place.line < 1) {
      first = end;  // an included file has them
      continue;
    }
    bool differs = false, left = false;
    const std::size_t offset = now.syntax->offsetOf(from.objects[first].place);
    const bool single = end - first == 1 && outline.find(offset) != nullptr;
    const std::optional<Item> node = now.syntax->itemAt(offset);
    // Particles make materials of those of the text; copies in rows, loops and definitions have them as they
    // are.
    const bool isCopy = node && node->is(Kind::call) && node->key() == Rows::kKeyword;
    const Scene& said = isCopy || now.syntax->usesLanguage() ? becoming : from;
    for (std::size_t i = first; i < end && !single; ++i) {
      const bool gone = kept[i] == Wanted::kNew;
      left = left || !gone;
      differs =
          differs || gone || !sameObject(said, from.objects[i], wanted.scene, wanted.scene.objects[kept[i]]);
    }
    for (std::size_t i = first; i < end; ++i) changed[i] = differs;
    if (differs && left)
      messages.warn(
          from.objects[first].place,
          "the objects that this makes are written one by one at the end of the file, as they were edited");
    first = end;
  }
  std::vector<std::pair<std::size_t, Object>> all;
  for (std::size_t i = 0; i < wanted.objects.size(); ++i) {
    const std::size_t index = wanted.objects[i];
    const bool alone = index == Wanted::kNew || changed[index];
    all.emplace_back(alone ? Wanted::kNew : index, std::move(wanted.scene.objects[i]));
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  wanted.objects.clear();
  wanted.scene.objects.clear();
  for (auto& [index, object] : all) {
    wanted.objects.push_back(index);
    wanted.scene.objects.push_back(std::move(object));
  }
}

/// For what was not edited, what the text and the files that it names say now.
bool takeOver(const Scene& read, const Scene& now, Wanted& wanted) {
  if (read == now) return true;
  if (read.objects.size() != now.objects.size() || read.materials != now.materials ||
      read.lights != now.lights || read.choices != now.choices)
    return false;
  for (std::size_t i = 0; i < wanted.objects.size(); ++i) {
    const std::size_t index = wanted.objects[i];
    if (index == Wanted::kNew) continue;
    Object& object = wanted.scene.objects[i];
    if (object.shape == read.objects[index].shape) object.shape = now.objects[index].shape;
  }
  return true;
}

/// The materials of a text after the edits, found by the objects that have them.
class MaterialMap {
 public:
  MaterialMap(const Scene& from, const Scene& to) : from_(from), to_(to), map_(from.materials.size()) {
    for (std::size_t i = 0; i < from.objects.size(); ++i) {
      pair(from.objects[i].material, to.objects[i].material);
      pairAll(from.objects[i].shape, to.objects[i].shape);
    }
  }
  std::vector<std::optional<Material>> take() { return std::move(map_); }

 private:
  void pair(std::uint32_t from, std::uint32_t to) {
    if (!map_.at(from)) map_[from] = to_.materials.at(to);
  }
  void pairAll(const std::vector<std::uint32_t>& from, const std::vector<std::uint32_t>& to) {
    for (std::size_t i = 0; i < std::min(from.size(), to.size()); ++i) pair(from[i], to[i]);
  }
  void pairAll(const Shape& from, const Shape& to) {
    if (&from.type() != &to.type()) return;
    pairAll(materialsOf(from), materialsOf(to));
    const auto &a = from.operands().list(), &b = to.operands().list();
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
      pair(a[i].material, b[i].material);
      pairAll(a[i].shape, b[i].shape);
    }
  }

  const Scene &from_, &to_;
  std::vector<std::optional<Material>> map_;
};

/// The changed text; nothing if it cannot be brought to say the scene.
class Patch {
 public:
  /// `lost`: of what the text said. `messages`: of the rest.
  Patch(const SceneText& read, Messages& lost, Messages& messages)
      : read_(read), lost_(lost), messages_(messages) {}

  std::optional<std::string> text(const Scene& edited) {
    auto now = std::make_unique<Reading>(read_.file, *read_.bytes, read_.time);
    Wanted wanted = first(*read_.scene, edited);
    if (!takeOver(*read_.scene, now->scene, wanted)) return {};
    breakUpChanged(*now, wanted, lost_);
    noteUnused(edited, now->scene.materials.size());
    Anew anew;
    for (int round = 0; !says(*now, wanted); ++round) {
      if (round == kMostRounds) return {};
      const std::string text = changedText(*now, wanted, anew, lost_);
      noteRewritten(*now, anew);
      now = std::make_unique<Reading>(read_.file, text, read_.time);
      const Scene &is = now->scene, &to = wanted.scene;
      if (is.objects.size() != to.objects.size() || is.lights.size() != to.lights.size()) return {};
      anew = {};
      if (round > 0) anew = {wrongObjects(is, to), wrongLights(is, to)};
      wanted.materials = MaterialMap(now->scene, wanted.scene).take();
      for (std::size_t i = 0; i < wanted.objects.size(); ++i) wanted.objects[i] = i;
      for (std::size_t i = 0; i < wanted.lights.size(); ++i) wanted.lights[i] = i;
    }
    return *now->text;
  }

 private:
  static Wanted first(const Scene& read, const Scene& edited) {
    Wanted wanted{edited, {}, {}, {}};
    for (Object& object : wanted.scene.objects) object.name = sayable(object.name);
    for (Material& material : wanted.scene.materials) material.name = sayable(material.name);
    wanted.objects = matched(read.objects, wanted.scene.objects);
    wanted.lights = matched(read.lights, wanted.scene.lights);
    for (std::size_t i = 0; i < std::min(read.materials.size(), edited.materials.size()); ++i)
      wanted.materials.emplace_back(wanted.scene.materials[i]);
    return wanted;
  }

  /// A name with the letters that the format takes.
  static std::string sayable(const std::string& name) {
    const std::string text = written(name, 0);
    const Syntax syntax("", text);
    return std::string((*syntax.root().begin()).text());
  }

  static bool says(const Reading& now, const Wanted& wanted) { return sameScene(now.scene, wanted.scene); }

 public:
  /// Does a text that says the one say the other?
  static bool sameScene(const Scene& is, const Scene& to) {
    return is.objects.size() == to.objects.size() && is.lights.size() == to.lights.size() &&
           wrongObjects(is, to).empty() && sameButObjects(is, to) && sameGroups(is, to);
  }

 private:
  static std::set<std::size_t> wrongObjects(const Scene& is, const Scene& to) {
    std::set<std::size_t> wrong;
    for (std::size_t i = 0; i < is.objects.size(); ++i)
      if (!sameObject(is, is.objects[i], to, to.objects[i])) wrong.insert(i);
    return wrong;
  }

  static bool sameGroups(const Scene& is, const Scene& to) {
    const auto same = [&](const Group& a, const Group& b) {
      return a.uses == b.uses &&
             std::equal(a.objects.begin(), a.objects.end(), b.objects.begin(), b.objects.end(),
                        [&](const Object& x, const Object& y) { return sameObject(is, x, to, y); });
    };
    return is.uses == to.uses &&
           std::equal(is.groups.begin(), is.groups.end(), to.groups.begin(), to.groups.end(), same);
  }

  static std::set<std::size_t> wrongLights(const Scene& is, const Scene& to) {
    std::set<std::size_t> wrong;
    for (std::size_t i = 0; i < is.lights.size(); ++i)
      if (!(is.lights[i].light == to.lights[i].light && is.lights[i].links == to.lights[i].links))
        wrong.insert(i);
    return wrong;
  }

  static bool sameButObjects(const Scene& is, const Scene& to) {
    return is.camera == to.camera && is.background == to.background && sameSettings(is, to) &&
           wrongLights(is, to).empty();
  }

  static void addMaterials(const Shape& shape, std::uint32_t material, std::set<std::uint32_t>& used) {
    used.insert(material);
    for (const Operand& operand : shape.operands().list())
      addMaterials(operand.shape, operand.material, used);
  }

  /// Named materials that were added; one without a name was made for an object that has another now.
  void noteUnused(const Scene& edited, std::size_t known) {
    std::set<std::uint32_t> used;
    for (const Object& object : edited.objects) addMaterials(object.shape, object.material, used);
    for (std::size_t i = known; i < edited.materials.size(); ++i)
      if (!edited.materials[i].name.empty() && !used.contains(static_cast<std::uint32_t>(i)))
        messages_.warn(SourcePlace{.file = read_.file},
                       nameOf(edited.materials[i], i) + " is not kept: no object has it");
  }

  void noteRewritten(const Reading& now, const Anew& anew) {
    for (std::size_t i : anew.lights)
      lost_.warn(now.scene.lights[i].place, "this light is rewritten: comments within it are lost");
    for (std::size_t i : anew.objects)
      lost_.warn(now.scene.objects[i].place,
                 "this object is rewritten: comments and nesting within it are lost");
  }

  const SceneText& read_;
  Messages &lost_, &messages_;
};

bool isFileOption(std::string_view name) {
  return std::any_of(options().begin(), options().end(), [&](const Option& option) {
    return option.kind == Option::Kind::file && option.name == name;
  });
}

/// Whether the field of that name is a picture of a background.
bool isFaceOfBackground(std::string_view key) {
  bool is = false;
  forEachField<Background>([&](const auto& f) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(Background{}.*f.member)>, Pixels>)
      is |= f.keyword == key;
  });
  return is;
}

/// The text with the names of files beside the scene as they are seen from another folder.
std::string moved(const std::string& text, const std::string& from, const std::string& to) {
  std::error_code error;
  const fs::path source = fs::absolute(from, error).parent_path().lexically_normal();
  const fs::path target = fs::absolute(to, error).parent_path().lexically_normal();
  if (error || source == target) return text;
  const Syntax syntax(from, text);
  TextEdits edits(syntax);
  const auto see = [&](const Item& name) {
    const fs::path path = fs::path(std::string(name.text()));
    if (!name.is(Kind::word) || path.empty() || path.is_absolute()) return;
    if (!fs::exists(source / path, error)) return;
    edits.replace(name, exactly(nameFrom(target.string(), (source / path).lexically_normal().string())));
  };
  for (std::size_t i = 0; i < syntax.nodes().size(); ++i) {
    const Item item(syntax, static_cast<std::uint32_t>(i));
    if (item.is(Kind::include)) see(Item(syntax, static_cast<std::uint32_t>(i + 1)));
    if (!item.keyed()) continue;
    const std::string_view key = item.key();
    const bool names = key == "file" || key == "objfile" || isFileOption(key) || isFaceOfBackground(key);
    if (item.is(Kind::entry) && names) see(item.value());
    if (item.is(Kind::call) && key == "map" && item.value().count() > 0) see(*item.value().begin());
  }
  return edits.text();
}

}  // namespace
}  // namespace rayfile

std::string withNamesSeenFrom(const std::string& text, const std::string& from, const std::string& to) {
  return rayfile::moved(text, from, to);
}

Rewritten rewriteRay(const SceneText& read, const Scene& edited, const std::string& file,
                     Messages& messages) {
  Messages lost, others;
  std::optional<std::string> text;
  try {
    const rayfile::Syntax syntax(read.file, *read.bytes);
    if (rayfile::Patch::sameScene(*read.scene, edited))
      text = *read.bytes;
    else if (!rayfile::speaksStudents(syntax))
      text = rayfile::Patch(read, lost, others).text(edited);
  } catch (const Error&) {
    text.reset();  // a file that it names is gone, or the reader does not take the text
  }
  if (text) {
    warnOfUnsayable(edited, file, messages);
    for (const Messages* all : {&lost, &others})
      for (const Message& message : all->all()) messages.warn(message.place, message.what, message.hint);
    return {{{file, rayfile::moved(*text, read.file, file)}}, lost.all().empty()};
  }
  messages.warn(
      SourcePlace{.file = file},
      "the text could not be kept: the scene is rewritten, without its comments and nesting" +
          std::string(changesWithTime(read.file, *read.bytes) ? " and as it is at this moment" : ""),
      "undo, or edit the file itself");
  return {writeRay(edited, file, {}, messages), false};
}

}  // namespace trace

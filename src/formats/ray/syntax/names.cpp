#include "formats/ray/syntax/names.h"

#include <algorithm>
#include <type_traits>
#include <vector>

#include "formats/ray/syntax/syntax.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "scene/scene.h"

namespace trace {
namespace {

/// The first text that cannot be said among those that it is shown.
class Search {
 public:
  explicit Search(bool files) : files_(files) {}

  void look(const std::string& text) {
    if (!found && !isSayable(text)) found = Unsayable{text, files_};
  }
  /// Names of things, and those by which lights and objects name each other.
  template <class Links>
  void lookThrough(const Links& links) {
    forEachField<Links>([&](const auto& f) {
      using Value = std::remove_cvref_t<decltype(links.*f.member)>;
      if constexpr (std::is_same_v<Value, std::string>)
        look(links.*f.member);
      else if constexpr (!std::is_same_v<Value, bool>)
        for (const std::string& name : links.*f.member) look(name);
    });
  }
  void lookThrough(const std::string& name, const Shape& shape) {
    look(name);
    for (const Operand& operand : shape.operands().list()) lookThrough(operand.name, operand.shape);
  }

  std::optional<Unsayable> found;

 private:
  bool files_;
};

void lookForFiles(Search& search, const Scene& scene) {
  const auto look = [&](const Pixels& pixels) { search.look(pixels.file); };
  for (Material material : scene.materials)
    if (!material.textures.empty()) changePixels(material, look);
  for (const LightSource& source : scene.lights)
    forEachField(source.light, [&]<class Value>(const LightField&, const Value& value) {
      if constexpr (std::is_same_v<Value, Pixels> || std::is_same_v<Value, PhotometryFile>)
        search.look(value.file);
    });
  Background background = scene.background;
  changePixels(background, look);
}

void lookForNames(Search& search, const Scene& scene) {
  for (const Object& object : scene.objects) {
    search.lookThrough(object.name, object.shape);
    search.lookThrough(object.links);
  }
  for (const LightSource& source : scene.lights) search.lookThrough(source.links);
  for (const Material& material : scene.materials) search.look(material.name);
}

std::optional<Unsayable> found(bool files, const Scene& scene, void (*look)(Search&, const Scene&)) {
  Search search(files);
  look(search, scene);
  return search.found;
}

}  // namespace

bool isSayable(std::string_view text) {
  return text.size() + 2 <= rayfile::Syntax::kLongestWord && std::all_of(text.begin(), text.end(), isHeld);
}

std::string Unsayable::why() const {
  const std::string of = isFile ? "the name of a file" : "a name";
  if (text.size() + 2 > rayfile::Syntax::kLongestWord)
    return "expected " + of + " of at most " + std::to_string(rayfile::Syntax::kLongestWord - 2) +
           " characters, found " + std::to_string(text.size());
  return "expected " + of + " without " +
         (text.find('"') == text.npos ? "control characters" : "quotation marks") +
         ", which .ray files cannot hold, found " + text;
}

std::string Unsayable::hint() const { return isFile ? "give the file another name" : ""; }

std::optional<Unsayable> unsayableIn(const Scene& scene) {
  const std::optional<Unsayable> file = found(true, scene, lookForFiles);
  return file ? file : found(false, scene, lookForNames);
}

void warnOfUnsayable(const Scene& scene, const std::string& file, Messages& messages) {
  if (const std::optional<Unsayable> name = found(false, scene, lookForNames))
    messages.warn(SourcePlace{.file = file}, name->why() + ": names are written as near as can be");
}

}  // namespace trace

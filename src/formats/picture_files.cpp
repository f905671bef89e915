#include "formats/picture_files.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/files/file.h"
#include "formats/textures.h"
#include "geometry/field_value.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "image/codecs/codec.h"
#include "image/codecs/picture_name.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

void addMaterials(const Shape& shape, std::uint32_t material, std::set<std::uint32_t>& used) {
  used.insert(material);
  used.insert(materialsOf(shape).begin(), materialsOf(shape).end());
  for (const Operand& operand : shape.operands().list()) addMaterials(operand.shape, operand.material, used);
}

std::set<std::uint32_t> usedMaterials(const Scene& scene) {
  std::set<std::uint32_t> used;
  for (const Object& object : scene.objects) addMaterials(object.shape, object.material, used);
  return used;
}

/// In the name of a file, and in all formats.
std::string plain(std::string_view name) {
  std::string text;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    text += byte >= 0x80 || std::isalnum(byte) || c == '.' || c == '_' || c == '-' ? c : '-';
  }
  return text;
}

/// The part of a name that differs from others of its scene: its own name, or where it lies: "images-0-",
/// "11-7".
std::string nameOf(const Pixels& pixels, const PictureFormat& format) {
  constexpr std::size_t kLong = 60;
  std::string name = plain(pixels.inside->name);
  if (name.empty()) name = plain(pixels.file.substr(pixels.file.find('#') + 1));
  for (const std::string_view suffix : format.suffixes)
    if (name.size() > suffix.size() && name.ends_with(suffix)) name.erase(name.size() - suffix.size());
  if (name.size() > kLong) {
    name.erase(kLong);
    while (!name.empty() && static_cast<unsigned char>(name.back()) >= 0x80) name.pop_back();
  }
  return name.substr(0, name.find_last_not_of('-') + 1);
}

/// Finds places beside the file for pictures from inside.
class PlacesBeside {
 public:
  PlacesBeside(std::string file, const InputFiles& inputs) : file_(std::move(file)), inputs_(inputs) {}

  /// Whether anything can lie beside it: not beside a pipe.
  bool any() const {
    std::error_code ignored;
    return !fs::exists(file_, ignored) || fs::is_regular_file(file_, ignored);
  }

  /// Where the picture goes, and what it leaves alone.
  NamedBytes place(const Pixels& pixels) {
    const std::string& bytes = pixels.inside->bytes;
    const PictureFormat& format = pictureFormatOf(bytes, pixels.file);
    const std::string start = plain(fs::path(file_).stem().generic_string()) + "-" + nameOf(pixels, format);
    NamedBytes picture{.file = {}, .bytes = bytes};
    for (int& number = numbers_[start];;) {
      ++number;
      const std::string name =
          start + (number == 1 ? "" : "-" + std::to_string(number)) + std::string(format.suffixes.front());
      const std::string path = (fs::path(file_).parent_path() / name).generic_string();
      if (!taken_.contains(path) && isFree(path, name, bytes)) {
        picture.file = path;
        taken_.insert(path);
        return picture;
      }
      if (number == 1 && !taken_.contains(path)) picture.spared = path;
    }
  }

 private:
  bool isFree(const std::string& path, const std::string& name, const std::string& bytes) {
    const auto& inputs = inputs_.all();
    if (std::any_of(inputs.begin(), inputs.end(), [&](const auto& in) { return sameFile(in.path, path); }))
      return false;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return true;
    if (!fs::is_regular_file(path, ignored)) return false;
    return (fs::file_size(path, ignored) == bytes.size() && readFile(path) == bytes) || wasNamed(name);
  }

  /// Whether the file that is replaced names that picture.
  bool wasNamed(const std::string& name) {
    std::error_code ignored;
    if (!before_) before_ = fs::exists(file_, ignored) ? readFile(file_) : "";
    const auto begins = [](char c) { return c == '"' || c == '='; };
    const auto ends = [](char c) { return c == '"' || c == ' ' || c == '\n'; };
    for (std::size_t at = before_->find(name, 1); at != before_->npos; at = before_->find(name, at + 1)) {
      const std::size_t end = at + name.size();
      if (begins((*before_)[at - 1]) && end < before_->size() && ends((*before_)[end])) return true;
    }
    return false;
  }

  const std::string file_;
  const InputFiles& inputs_;
  std::optional<std::string> before_;  ///< what the file says that is replaced, once it is wanted
  std::map<std::string, int> numbers_;
  std::set<std::string> taken_;
};

}  // namespace

SeenFrom seenFrom(const Scene& scene, const std::string& file, Messages& messages) {
  std::error_code error;
  const fs::path target = fs::absolute(file, error).parent_path().lexically_normal();
  const bool same = fs::absolute(scene.file, error).parent_path().lexically_normal() == target;
  PlacesBeside places(file, scene.inputs);
  SeenFrom seen{scene, {}};
  std::map<const InsideFile*, std::string> written;  ///< pictures from inside, and their names
  std::size_t left = 0;
  /// As the other file names it.
  const auto placed = [&](const std::string& name) {
    if (same || name.empty() || fs::path(name).is_absolute()) return name;
    const fs::path path = fs::absolute(pictureFile(scene.file, name), error).lexically_normal();
    return fs::exists(path, error) ? pictureName(name).of(nameFrom(target.string(), path.string())) : name;
  };
  const auto see = [&](Pixels& pixels) {
    if (pixels.inside) {
      const auto [known, fresh] = written.try_emplace(pixels.inside.get());
      if (fresh && places.any()) {
        seen.pictures.push_back(places.place(pixels));
        known->second = fs::path(seen.pictures.back().file).filename().generic_string();
      }
      left += fresh && known->second.empty();
      if (known->second.empty()) return;
      pixels.file = known->second;
      pixels.inside = nullptr;
      return;
    }
    pixels.file = placed(pixels.file);
  };
  for (const std::uint32_t used : usedMaterials(scene)) changePixels(seen.scene.materials.at(used), see);
  for (LightSource& source : seen.scene.lights)
    editEachField(source.light, [&]<class Value>(const LightField&, Value& value) {
      if constexpr (std::is_same_v<Value, Pixels>) see(value);
      if constexpr (std::is_same_v<Value, PhotometryFile>) value.file = placed(value.file);
    });
  changePixels(seen.scene.background, see);
  if (left > 0)
    messages.warn({scene.file, 0, 0, {}},
                  "pictures that lie inside the file are left out: " + std::to_string(left),
                  "write to an ordinary file: they are written beside it");
  return seen;
}

std::vector<NamedBytes> picturesNamed(const std::set<std::string>& names, const SeenFrom& seen) {
  std::vector<NamedBytes> named;
  for (const NamedBytes& picture : seen.pictures)
    if (names.contains(fs::path(picture.file).filename().generic_string())) named.push_back(picture);
  return named;
}

}  // namespace trace

// The files of materials that an OBJ names, read for tinyobjloader, which knows no folders.
#pragma once

#include <tiny_obj_loader.h>

#include <istream>
#include <map>
#include <set>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "formats/mesh/mtl_lines.h"
#include "formats/model.h"
#include "formats/textures.h"
#include "formats/warnings.h"

namespace trace {

/// A stream that reads bytes where they are.
class ByteStream : private std::streambuf, public std::istream {
 public:
  explicit ByteStream(std::string_view bytes) : std::istream(static_cast<std::streambuf*>(this)) {
    char* first = const_cast<char*>(bytes.data());  // streambuf's interface; nothing is written
    setg(first, first, first + bytes.size());
  }
};

class ObjMaterials {
 public:
  /// Names of materials, and the offset in the text of the first use.
  using Names = std::map<std::string_view, std::size_t>;

  /// Materials go to `model`, warnings to `warnings` and `messages`. All must live longer.
  ObjMaterials(const std::string& file, std::string_view bytes, const Names& names, Model& model,
               WarningsByKind& warnings, Messages& messages)
      : file_(file), bytes_(bytes), names_(names), model_(model), warnings_(warnings), messages_(messages) {}

  /// Reads the files that a line names, with the offset of that in the text: one whose name may have blanks
  /// if it is there, or else several.
  void read(std::string_view names, std::size_t offset);
  /// An index into Model::materials of what a line calls so, perhaps with a comment behind it.
  std::uint32_t numberOf(std::string_view name);
  /// Warns of pictures that are not rendered and of materials that no file defines.
  void report();

 private:
  void readFile(const std::string& name, const SourcePlace& place);
  void addMaterials(const std::string& name, const SourcePlace& place);
  std::string pictureName(const std::string& materialFile, const std::string& picture) const;
  void notePictures(const tinyobj::material_t& m, const std::string& materialFile);
  void warnUndefined();

  const std::string& file_;
  std::string_view bytes_;
  const Names& names_;
  Model& model_;
  WarningsByKind& warnings_;
  Messages& messages_;
  UnusedTextures unused_;
  std::vector<tinyobj::material_t> materials_;
  std::map<std::string, int> numbers_;
  MapPlaces maps_;
  std::set<std::string> readFiles_;
  std::set<std::string_view> undefined_;
  bool missing_ = false;  ///< a file of materials
};

}  // namespace trace

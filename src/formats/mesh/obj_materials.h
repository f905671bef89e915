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

#include "formats/mesh/obj_lines.h"
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

class ObjMaterials : public tinyobj::MaterialReader {
 public:
  /// Materials go to `model`, warnings to `warnings` and `messages`. `names` is known once materials are
  /// asked for. All must live longer.
  ObjMaterials(const std::string& file, std::string_view bytes, const ObjNames& names, Model& model,
               WarningsByKind& warnings, Messages& messages)
      : file_(file), bytes_(bytes), names_(names), model_(model), warnings_(warnings), messages_(messages) {}

  /// Reads the file of that name.
  bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                  std::map<std::string, int>* numbers, std::string*, std::string*) override;
  /// An index into Model::materials; `number` is tinyobj's, below 0 where it knows none of that name.
  std::uint32_t numberOf(const std::string& name, int number);
  /// Warns of pictures that are not rendered and of materials that no file defines.
  void report();

 private:
  Place place() const { return {file_, 0, 0, {}}; }
  Place placeOfFile(const std::string& name) const;
  std::string pictureName(const std::string& materialFile, const std::string& picture) const;
  void notePictures(const tinyobj::material_t& m, const std::string& materialFile);
  void warnUndefined();

  const std::string& file_;
  std::string_view bytes_;
  const ObjNames& names_;
  Model& model_;
  WarningsByKind& warnings_;
  Messages& messages_;
  UnusedTextures unused_;
  std::set<std::string> undefined_;
  bool missing_ = false;  ///< a file of materials
};

}  // namespace trace

// The lines of a material file of an OBJ that its reader, tinyobj, passes over in silence.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "formats/textures.h"
#include "formats/warnings.h"

namespace trace {

/// Where a material file names the pictures of maps: the first line of each keyword and picture.
class MapPlaces {
 public:
  struct Line {
    SourcePlace place;
    std::string keyword;  ///< as the file has it
  };
  /// `keyword` is one of a map, in any of its spellings.
  void note(std::string_view keyword, std::string_view picture, Line line);
  /// Null where there is no such line.
  const Line* find(std::string_view keyword, std::string_view picture) const;

 private:
  std::map<std::string, Line, std::less<>> lines_;
};

/// Notes the textures that are not rendered, where maps name their pictures, and warns of lines that are
/// not known, of what should be a number and is none, and of numbers out of their range. Returns the text as
/// tinyobj can read it: continued lines are one, a colour of one number has three, options of a texture have
/// all their numbers, and what a texture multiplies is white where the material does not say it. Linear in
/// the text.
std::string checkedMtl(const std::string& file, std::string_view text, UnusedTextures& textures,
                       MapPlaces& pictures, WarningsByKind& warnings);

}  // namespace trace

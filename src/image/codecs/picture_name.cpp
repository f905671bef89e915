#include "image/codecs/picture_name.h"

namespace trace {

PictureName pictureName(const std::string& name) {
  constexpr std::string_view kLayerMark = ".exr:";
  std::string lower = name;
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const std::size_t mark = lower.rfind(kLayerMark);
  if (mark == lower.npos || mark == 0 || mark + kLayerMark.size() == name.size()) return {name, ""};
  const std::size_t colon = mark + kLayerMark.size() - 1;
  return {name.substr(0, colon), name.substr(colon + 1)};
}

}  // namespace trace

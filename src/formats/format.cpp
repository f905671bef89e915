#include "formats/format.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "base/file.h"
#include "formats/ray_format.h"

namespace trace {
namespace {

constexpr std::array kTable{
    SceneFormat{"ray", "scenes that begin with SBT-raytracer 1.0", recognisesRay,
                [](const std::string& file, std::string_view bytes, Messages& messages) {
                  return readRay(file, bytes, messages);
                },
                readRay},
};

/// What bytes that are no scene look like.
std::string kindOf(std::string_view bytes) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kBeginnings{{
      {"\x89PNG", "a PNG picture"},
      {"\xff\xd8\xff", "a JPEG picture"},
      {"BM", "a BMP picture"},
      {"GIF8", "a GIF picture"},
      {"\x76\x2f\x31\x01", "an OpenEXR picture"},
      {"#?RADIANCE", "a Radiance picture"},
      {"ply", "a PLY mesh"},
      {"#Inventor", "an Open Inventor scene, which Trace does not read yet"},
      {"#VRML", "a VRML scene, which Trace does not read"},
      {"glTF", "a glTF scene, which Trace does not read"},
      {"%PDF", "a PDF document"},
      {"PK\x03\x04", "a zip archive"},
      {"\x7f"
       "ELF",
       "a program"},
      {"\x1f\x8b", "a gzip archive"},
  }};
  for (const auto& [beginning, kind] : kBeginnings)
    if (bytes.starts_with(beginning)) return std::string(kind);
  if (bytes.find('\0') < 4096) return "binary data";
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return bytes.empty() ? "an empty file" : "only white space";
  if (bytes[first] == '{' || bytes[first] == '[') return "what looks like JSON";
  if (bytes[first] == '<') return "what looks like XML or HTML";
  return "other text";
}

std::string expectedFormats() {
  std::string text;
  for (const SceneFormat& format : sceneFormats())
    text += (text.empty() ? "" : "; ") + std::string(format.name) + ", " + std::string(format.help);
  return text;
}

}  // namespace

std::span<const SceneFormat> sceneFormats() { return kTable; }

Scene readScene(const std::string& file, Messages& messages, Real time) {
  return readScene(file, readFile(file), messages, time);
}

Scene readScene(const std::string& file, std::string_view bytes, Messages& messages, Real time) {
  for (const SceneFormat& format : sceneFormats())
    if (format.recognises(bytes))
      return format.readAt ? format.readAt(file, bytes, messages, time) : format.read(file, bytes, messages);
  throw Error(Fault::scene, Place{file, 0, 0, {}}, "expected a scene, found " + kindOf(bytes),
              "formats Trace reads: " + expectedFormats());
}

}  // namespace trace

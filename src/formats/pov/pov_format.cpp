#include "formats/pov/pov_format.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "formats/pov/pov_reader.h"
#include "formats/pov/pov_scene.h"

namespace trace {
namespace {

/// The text behind blanks and comments.
std::string_view withoutComments(std::string_view s) {
  for (;;) {
    const std::size_t at = s.find_first_not_of(" \t\r\n");
    if (at == std::string_view::npos) return {};
    s.remove_prefix(at);
    if (s.starts_with("//")) {
      const std::size_t end = s.find('\n');
      if (end == std::string_view::npos) return {};
      s.remove_prefix(end);
    } else if (s.starts_with("/*")) {
      const std::size_t end = s.find("*/", 2);
      if (end == std::string_view::npos) return {};
      s.remove_prefix(end + 2);
    } else {
      return s;
    }
  }
}

}  // namespace

bool recognisesPov(std::string_view bytes) {
  const std::string_view s = withoutComments(bytes);
  if (s.starts_with("#")) {
    const std::size_t at = s.find_first_not_of(" \t", 1);
    if (at == std::string_view::npos) return false;
    const std::string_view word = s.substr(at, s.find_first_of(" \t\r\n(\"", at) - at);
    constexpr std::string_view kDirectives[]{"version", "include", "declare", "local",  "macro",
                                             "default", "if",      "ifdef",   "ifndef", "debug",
                                             "switch",  "while",   "for"};
    return std::find(std::begin(kDirectives), std::end(kDirectives), word) != std::end(kDirectives) &&
           !(word == "include" && s.find('<', at) < s.find('"', at));
  }
  constexpr std::string_view kStatements[]{"global_settings", "light_source", "sky_sphere"};
  return std::any_of(std::begin(kStatements), std::end(kStatements), [&](std::string_view w) {
    if (!s.starts_with(w)) return false;
    const std::size_t at = s.find_first_not_of(" \t\r\n", w.size());
    return at != std::string_view::npos && s[at] == '{';
  });
}

bool mayBePov(std::string_view bytes) {
  return !bytes.empty() && bytes.find('\0') == std::string_view::npos && !withoutComments(bytes).empty();
}

Scene readPov(const std::string& file, std::string_view bytes, Messages& messages, SceneTime& time) {
  Scene scene;
  scene.file = file;
  scene.format = "pov";
  auto reader = std::make_unique<pov::Reader>(file, bytes, scene.inputs, time, messages);
  pov::World world;
  try {
    world = reader->read();
  } catch (const Error& error) {
    if (error.fault() != Fault::scene || !reader->asksFrame()) throw;
    reader = std::make_unique<pov::Reader>(file, bytes, scene.inputs, time, messages);
    reader->setAnimated();
    world = reader->read();
    messages.warn(SourcePlace{.file = file},
                  "frame_number is 1: only as part of an animation can the scene be read");
  }
  pov::addTo(scene, world, reader->warnings());
  reader->warnings().report(messages);
  if (scene.objects.empty()) messages.warn(SourcePlace{.file = file}, "no object: the picture will be empty");
  return scene;
}

}  // namespace trace

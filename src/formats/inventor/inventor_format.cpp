#include "formats/inventor/inventor_format.h"

#include <utility>

#include "formats/inventor/inventor_reader.h"
#include "formats/model.h"
#include "shading/lights/plain_lights.h"

namespace trace {
namespace inventor {

Scene Reader::read() {
  scene_.inputs.note(document_.inputs());
  walk();
  finish();
  return std::move(scene_);
}

Scene Reader::readPart() {
  scene_.inputs.note(document_.inputs());
  walk();
  warnings_.report(messages_);
  textures_.report(messages_);
  return std::move(scene_);
}

// --- the whole ---

void Reader::finish() {
  const SourcePlace place{scene_.file, 0, 0, {}};
  if (headlight_ && *headlight_ != scene_.lights.empty())
    warn(*headlightAt_,
         *headlight_ ? "the headlight is left out, since the file has lights"
                     : "a file without lights is lit from the camera, though its headlight is off",
         "headlight");
  warnings_.report(messages_);
  if (!meshes_.empty()) repairs_.report(place, messages_);
  textures_.report(messages_);
  if (scene_.objects.empty()) messages_.warn(place, "no object: the picture will be empty");
  if (!hasCamera_) {
    scene_.camera = framing(bounds(scene_));
    scene_.camera.fov = 45;
  }
  if (scene_.lights.empty())  // the headlight of every viewer
    scene_.lights.push_back({trace::directionalLight(scene_.camera.viewdir, Color(1)), place});
  if (!isBlack(ambient_)) scene_.lights.push_back({ambientLight(ambient_), place});
  for (const auto& [option, value] : {std::pair<std::string, std::string>{"shininess-scale", "128"},
                                      {"pixel-position", "center"},
                                      {"mirror-default", "zero"}})
    scene_.choices.push_back({option, value, place});
}

}  // namespace inventor

bool recognisesInventor(std::string_view bytes) { return inventor::hasHeader(bytes); }

Scene readInventor(const std::string& file, std::string_view bytes, Messages& messages) {
  const inventor::Document document(file, bytes, messages);
  inventor::Library library;
  library.try_emplace(file);  // it cannot bring itself
  return inventor::Reader(document, messages, library).read();
}

}  // namespace trace

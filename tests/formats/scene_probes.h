// Reading the probes of scene formats: what is seen is the scene as a .ray file.
#pragma once

#include <map>
#include <string>

#include "base/files/file.h"
#include "formats/format.h"
#include "formats/ray/write/writer.h"
#include "formats/textures.h"
#include "probes.h"
#include "support/folder.h"

namespace trace {

/// Reads bytes as a file of that name, beside the files that it may name.
class SceneProbes {
 public:
  SceneProbes(std::string name, const std::map<std::string, std::string>& beside = {})
      : file_(folder_ / name) {
    for (const auto& [other, bytes] : beside) writeFile(folder_ / other, bytes);
  }

  Outcome operator()(const std::string& bytes) const {
    Outcome outcome;
    Messages messages;
    try {
      Scene scene = readScene(file_, bytes, messages);
      Messages ignored;
      outcome.seen = writeRay(scene, file_, {}, ignored).front().bytes;
      loadTextures(scene, messages);
    } catch (const Error& error) {
      outcome.error = error.messages().front().what;
    }
    for (const Message& message : messages.all()) {
      outcome.told.push_back(message.what);
      outcome.lines.push_back(message.place.line);
    }
    return outcome;
  }
  void add(const std::string& name, const std::string& bytes) const { writeFile(folder_ / name, bytes); }

 private:
  test::Folder folder_;
  std::string file_;
};

}  // namespace trace

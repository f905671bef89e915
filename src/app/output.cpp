// Names and contents of the files a render writes: see output.h. The end of a picture's life: Film, tone,
// file.
#include "app/output.h"

#include <filesystem>

#include "image/codec.h"
#include "render/passes.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

std::string passFile(const fs::path& picture, std::string_view pass, PassFormat format) {
  const std::string suffix = format == PassFormat::exr   ? ".exr"
                             : format == PassFormat::png ? ".png"
                                                         : picture.extension().string();
  return fs::path(picture).replace_extension("." + std::string(pass) + suffix).string();
}

Picture pictureOf(const Output& output, const Film& film, const Settings& settings) {
  const PictureFormat& format = pictureFormatFor(output.path);
  if (output.layer < 0) return format.keepsBright ? film.picture() : toned(film.picture(), settings.tone);
  const auto layer = static_cast<std::size_t>(output.layer);
  const bool raw = format.keepsBright && format.lossless;  // Radiance has no negative and no infinite values
  return raw ? film.layer(layer) : passesOf(settings)[layer]->shown(film.layer(layer), settings);
}

}  // namespace

std::vector<Output> outputs(const std::string& path, const Settings& settings) {
  std::vector<Output> all{{path, -1}};
  for (const PassRow* pass : passesOf(settings))
    all.push_back({passFile(path, pass->name, settings.passFormat), static_cast<int>(all.size()) - 1});
  return all;
}

void write(const Output& output, const Film& film, const Scene& scene, const Settings& settings) {
  Metadata metadata = describe(scene, settings);
  if (output.layer >= 0)
    metadata.emplace_back("Pass", passesOf(settings)[static_cast<std::size_t>(output.layer)]->name);
  writePicture(output.path, pictureOf(output, film, settings), settings.rounding, metadata);
}

Metadata describe(const Scene& scene, const Settings& settings) {
  std::string changed;
  for (const Choice& choice : changedOptions(settings))
    changed += (changed.empty() ? "" : " ") + choice.option + "=" + choice.value;
  return {{"Software", "Trace " TRACE_VERSION},
          {"Title", fs::path(scene.file).filename().string()},
          {"Settings", changed.empty() ? "defaults" : changed}};
}

}  // namespace trace

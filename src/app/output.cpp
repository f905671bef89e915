// Names and contents of the files a render writes: see output.h. The end of a picture's life: Film, tone,
// file.
#include "app/output.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <type_traits>

#include "base/error.h"
#include "image/codec.h"
#include "render/passes.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

constexpr const char *kSettings = "Settings", *kDefaults = "defaults", *kPass = "Pass";

std::string passFile(const fs::path& picture, std::string_view pass, const Settings& settings) {
  const PassFormat format = settings.passFormat;
  const std::string suffix = format == PassFormat::exr   ? ".exr"
                             : format == PassFormat::png ? ".png"
                                                         : picture.extension().string();
  const char* between = settings.passName == PassName::dot ? "." : "_";
  return (picture.parent_path() / picture.stem()).string() + between + std::string(pass) + suffix;
}

/// As FNV-1a (Fowler, Noll, Vo), but of eight bytes at a time, and folded so that all bits count for all.
class Hash {
 public:
  void add(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    std::uint64_t word = 0;
    std::size_t i = 0;
    for (; i + 8 <= size; i += 8) std::memcpy(&word, bytes + i, 8), add(word);
    word = 0;
    if (i < size) std::memcpy(&word, bytes + i, size - i), add(word);
    value_ = (value_ ^ size) * 0x100000001b3u;
  }
  template <class Plain>
  void add(const std::vector<Plain>& values) {
    static_assert(std::has_unique_object_representations_v<Plain> || sizeof(Plain) == 3 * sizeof(float));
    if (!values.empty()) add(values.data(), values.size() * sizeof(Plain));
  }
  std::string text() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value_));
    return text;
  }

 private:
  void add(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x100000001b3u;
    value_ ^= value_ >> 32;
  }

  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// The words, with only those options that change what is rendered.
std::map<std::string, std::string> whatCounts(const Metadata& metadata) {
  std::map<std::string, std::string> words;
  for (const auto& [key, text] : metadata) words[key] = text;
  std::istringstream options(words[kSettings]);
  std::string kept, one;
  while (options >> one) {
    const std::string_view name = std::string_view(one).substr(0, one.find('='));
    const auto all = trace::options();
    const auto row = std::find_if(all.begin(), all.end(), [&](const Option& o) { return o.name == name; });
    if (row == all.end() || row->repeats != Repeats::nothing) kept += one + " ";
  }
  words[kSettings] = kept == std::string(kDefaults) + " " ? "" : kept;
  return words;
}

/// Calls use(picture) with what the file is to hold.
template <class Use>
void withPictureOf(const Output& output, const Film& film, const Settings& settings, Use use) {
  const PictureFormat& format = pictureFormatFor(output.path);
  if (output.layer < 0) {
    film.withPicture([&](const Picture& picture) {
      if (format.keepsBright || settings.tone == Tone::clamp)
        use(picture);
      else
        use(toned(picture, settings.tone));
    });
    return;
  }
  const auto layer = static_cast<std::size_t>(output.layer);
  const bool raw = format.keepsBright && format.lossless;  // Radiance has no negative and no infinite values
  use(raw ? film.layer(layer) : passesOf(settings)[layer]->shown(film.layer(layer), settings));
}

}  // namespace

std::vector<Output> outputs(const std::string& path, const Settings& settings) {
  std::vector<Output> all{{path, -1, ""}};
  for (const PassRow* pass : passesOf(settings))
    all.push_back({passFile(path, pass->name, settings), static_cast<int>(all.size()) - 1, pass->name});
  return all;
}

std::string fingerprint(std::string_view bytes, const Scene& scene) {
  Hash hash;
  hash.add(bytes.data(), bytes.size());
  std::set<const MeshData*> seen;
  for (const Object& object : scene.objects)
    if (const Mesh* mesh = std::get_if<Mesh>(&object.shape); mesh && seen.insert(mesh->data.get()).second) {
      hash.add(mesh->data->points);
      hash.add(mesh->data->triangles);
      hash.add(mesh->data->normals);
    }
  return hash.text();
}

bool isRendered(const Output& output, const Metadata& metadata) {
  std::error_code ignored;
  if (!fs::exists(output.path, ignored)) return false;
  try {
    const Metadata stored = readMetadata(output.path);
    Metadata expected = metadata;
    if (!output.pass.empty()) expected.emplace_back(kPass, output.pass);
    return !stored.empty() && whatCounts(stored) == whatCounts(expected);
  } catch (const Error&) {  // not a sound picture
    return false;
  }
}

void write(const Output& output, const Film& film, const Settings& settings, Metadata metadata) {
  if (!output.pass.empty()) metadata.emplace_back(kPass, output.pass);
  if (!film.complete()) metadata.emplace_back("Incomplete", "the render was stopped");
  withPictureOf(output, film, settings, [&](const Picture& picture) {
    writePicture(output.path, picture, settings.rounding, metadata);
  });
}

Metadata describe(const Scene& scene, const Settings& settings) {
  std::string changed;
  for (const Choice& choice : changedOptions(settings))
    changed += (changed.empty() ? "" : " ") + choice.option + "=" + choice.value;
  return {{"Software", "Trace " TRACE_VERSION},
          {"Title", fs::path(scene.file).filename().string()},
          {kSettings, changed.empty() ? kDefaults : changed}};
}

}  // namespace trace

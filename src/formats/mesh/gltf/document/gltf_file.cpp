// tinygltf takes the JSON apart and finds the buffers. It trusts the file in some places where a damaged one
// must not be trusted: these are looked at first.
#include "formats/mesh/gltf/document/gltf_file.h"

#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "base/files/named_file.h"
#include "base/files/read_scope.h"
#include "formats/mesh/gltf/document/gltf_check.h"
#include "formats/mesh/gltf/document/gltf_json.h"
#include "formats/mesh/gltf/document/gltf_tree.h"
#include "formats/mesh/gltf/document/gltf_unused.h"
#include "formats/mesh/gltf/document/gltf_upgrade.h"
#include "formats/mesh/gltf/gltf_buffers.h"
#include "formats/mesh/gltf/gltf_unpack.h"

#define TINYGLTF_IMPLEMENTATION
#include "formats/mesh/gltf/document/gltf_values.h"

namespace trace {
namespace {

constexpr std::string_view kMagic = "glTF";

std::uint32_t littleInt(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

// --- the container ----------------------------------------------------------------------------------

/// The JSON of the file: all of it, or the first chunk of a binary one. Throws Error if chunks do not fit.
std::string_view jsonOf(const SourcePlace& place, std::string_view bytes) {
  if (!bytes.starts_with(kMagic)) return bytes;
  const auto fail = [&](const char* what) { throw Error(Fault::scene, place, what); };
  if (bytes.size() < 20) fail("expected a glTF header of 20 bytes, found the end of the file");
  const std::size_t length = littleInt(bytes, 12), end = 20 + length;
  if (littleInt(bytes, 8) > bytes.size() || end > bytes.size())
    fail("the file is shorter than its header says");
  const bool hasChunks = littleInt(bytes, 4) >= 2;  // before, the rest was the body
  if (hasChunks && end + 8 <= bytes.size() && littleInt(bytes, end) > bytes.size() - end - 8)
    fail("the binary chunk is longer than the rest of the file");
  return bytes.substr(20, length);
}

/// Files that the scene names, each read once.
struct GltfFiles {
  std::set<std::string> read;
  InputFiles& inputs;
  const SourcePlace& place;
  Messages& messages;

  static bool exists(const std::string& path, void* self) {
    const GltfFiles& files = *static_cast<GltfFiles*>(self);
    const std::string real = namedFile("", path).path;
    if (path.starts_with("./") && !mayRead(real)) return false;  // tinygltf tries the current folder, too
    try {
      checkMayRead(real);
    } catch (const ReadDenied& denied) {
      denied.at(files.place);
    }
    std::error_code ignored;
    return std::filesystem::is_regular_file(real, ignored);
  }
  static std::string expand(const std::string& path, void*) { return path; }
  static bool readWhole(std::vector<unsigned char>* to, std::string* error, const std::string& path,
                        void* self) {
    GltfFiles& files = *static_cast<GltfFiles*>(self);
    if (!files.read.insert(path).second) {
      *error = "two buffers are the same file";
      return false;
    }
    try {
      const NamedFile named = namedFile("", path);
      if (!named.remark.empty()) files.messages.warn(files.place, named.remark);
      const std::string bytes = readBeside("", named.path, files.inputs);
      to->assign(bytes.begin(), bytes.end());
      return true;
    } catch (const ReadDenied& denied) {
      denied.at(files.place);
    } catch (const Error& failure) {
      if (failure.fault() == Fault::limit) throw;
      *error = failure.messages().front().what;
      return false;
    }
  }
};

}  // namespace

bool isBinaryGltf(std::string_view bytes) { return bytes.starts_with(kMagic); }

namespace {

tinygltf::Model checkedGltf(const std::string& file, std::string_view bytes, const nlohmann::json& root,
                            const SourcePlace& place, InputFiles& inputs, Messages& messages) {
  checkGltf(root, place, messages);
  checkGltfBuffers(root, place);
  checkGltfTree(root, place);
  GltfFiles files{{}, inputs, place, messages};
  tinygltf::TinyGLTF parser;
  parser.SetFsCallbacks({GltfFiles::exists, GltfFiles::expand, GltfFiles::readWhole, nullptr, &files});
  // Only the bytes of a data URI are kept: those in a buffer lie where nobody has looked yet.
  parser.SetImageLoader(
      [](tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* data,
         int size, void*) {
        if (image->bufferView < 0) image->image.assign(data, data + size);
        return true;
      },
      nullptr);
  tinygltf::Model model;
  std::string errors, warnings;
  const std::string folder = std::filesystem::path(file).parent_path().generic_string();
  const auto size = static_cast<unsigned>(bytes.size());
  bool good = false;
  try {
    good =
        isBinaryGltf(bytes)
            ? parser.LoadBinaryFromMemory(&model, &errors, &warnings,
                                          reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
            : parser.LoadASCIIFromString(&model, &errors, &warnings, bytes.data(), size, folder);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    errors = error.what();
  }
  constexpr std::string_view kMissing = "File not found : ";
  if (!good && errors.starts_with(kMissing))
    throw Error(Fault::scene, place,
                "cannot find the file \"" +
                    errors.substr(kMissing.size(), errors.find('\n') - kMissing.size()) + "\" that it names");
  if (!good)
    throw Error(Fault::scene, place, "not a sound glTF file: " + errors.substr(0, errors.find('\n')));
  unpackGltf(model, place, messages);
  return model;
}

}  // namespace

tinygltf::Model parsedGltf(const std::string& file, std::string_view bytes, const SourcePlace& place,
                           InputFiles& inputs, Messages& messages) {
  nlohmann::json json = parseGltfJson(place, bytes, jsonOf(place, bytes));
  std::string changed;
  const bool isOld = isGltf1(json);
  if (isOld) json = upgradedGltf(json, place);
  const bool hasPictures = plainGltfPictures(json), hasFallbacks = dropGltfFallbacks(json),
             hasDraco = dropDracoIndices(json);
  if (hasPictures || hasFallbacks || hasDraco || isOld) {
    changed = upgradedGltfFile(json, bytes);
    bytes = changed;
  }
  Messages found;
  const auto report = [&] {
    for (const Message& message : found.all()) messages.warn(message.place, message.what, message.hint);
  };
  try {
    tinygltf::Model model = checkedGltf(file, bytes, json, place, inputs, found);
    report();
    return model;
  } catch (const ReadDenied&) {
    throw;
  } catch (const Error& error) {
    if (error.fault() != Fault::scene) throw;
    const auto without = [&](std::size_t dropped, const char* why) -> std::optional<tinygltf::Model> {
      if (dropped == 0) return {};
      found = {};
      try {
        tinygltf::Model model = checkedGltf(file, upgradedGltfFile(json, bytes), json, place, inputs, found);
        messages.warn(place, error.messages().front().what + why);
        report();
        return model;
      } catch (const Error&) {  // the first error is of the file as it is
        return {};
      }
    };
    if (auto model = without(dropUnusedGltf(json), "; nothing uses it, and it is left out"))
      return *std::move(model);
    if (auto model = without(json.erase("animations"), "; no animation is played")) return *std::move(model);
    throw;
  }
}

}  // namespace trace

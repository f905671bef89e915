// tinygltf takes the JSON apart and finds the buffers. It trusts the file in some places where a damaged one
// must not be trusted: these are looked at first.
#include "formats/mesh/gltf_file.h"

#include <filesystem>
#include <set>
#include <utility>

#include "base/file.h"
#include "formats/mesh/gltf_buffers.h"
#include "formats/mesh/gltf_check.h"
#include "formats/mesh/gltf_json.h"
#include "formats/mesh/gltf_tree.h"
#include "formats/mesh/gltf_upgrade.h"

#define TINYGLTF_IMPLEMENTATION
#include "formats/mesh/gltf_values.h"

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
std::string_view jsonOf(const Place& place, std::string_view bytes) {
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

  static bool exists(const std::string& path, void*) {
    std::error_code ignored;
    return std::filesystem::is_regular_file(path, ignored);
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
      const std::string bytes = readFile(path);
      files.inputs.noteRead(path, bytes);
      to->assign(bytes.begin(), bytes.end());
      return true;
    } catch (const Error& failure) {
      if (failure.fault() == Fault::limit) throw;
      *error = failure.messages().front().what;
      return false;
    }
  }
};

}  // namespace

bool isBinaryGltf(std::string_view bytes) { return bytes.starts_with(kMagic); }

tinygltf::Model parsedGltf(const std::string& file, std::string_view bytes, const Place& place,
                           InputFiles& inputs, Messages& messages) {
  nlohmann::json json = parseGltfJson(place, bytes, jsonOf(place, bytes));
  std::string upgraded;
  if (isGltf1(json)) {
    json = upgradedGltf(json, place);
    upgraded = upgradedGltfFile(json, bytes);
    bytes = upgraded;
  }
  checkGltf(json, place, messages);
  checkGltfBuffers(json, place);
  checkGltfTree(json, place);
  GltfFiles files{{}, inputs};
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
  const std::string folder = std::filesystem::path(file).parent_path().string();
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
  if (!good)
    throw Error(Fault::scene, place, "not a sound glTF file: " + errors.substr(0, errors.find('\n')));
  return model;
}

}  // namespace trace

// Source: Khronos Group, glTF 2.0 Specification, section 3.6; RFC 2397, The "data" URL scheme.
#include "formats/mesh/gltf/gltf_buffers.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace trace {
namespace {

using nlohmann::json;

bool isDigit(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
}

/// The media types that tinygltf decodes, in buffers and in pictures.
constexpr std::string_view kDataMark = ";base64,", kDataForms[] = {"application/octet-stream",
                                                                   "text/plain",
                                                                   "application/gltf-buffer",
                                                                   "image/jpeg",
                                                                   "image/png",
                                                                   "image/bmp",
                                                                   "image/gif"};

/// Whether tinygltf decodes the bytes after this head, which starts after "data:".
bool isKnownData(std::string_view head) {
  return std::any_of(std::begin(kDataForms), std::end(kDataForms), [&](std::string_view form) {
    return head.starts_with(form) && head.substr(form.size()) == kDataMark;
  });
}

/// A buffer or an embedded picture.
class BufferCheck {
 public:
  BufferCheck(const SourcePlace& place, std::string_view list, std::size_t number)
      : place_(place), path_(std::string(list) + "[" + std::to_string(number) + "]"), first_(number == 0) {}

  void checkPicture(const json& image) const {
    if (!image.is_object()) fail("", "expected an object");
    const auto uri = image.find("uri");
    if (uri == image.end()) return;
    if (!uri->is_string()) fail(".uri", "expected the name of a file, or \"data:\" and its bytes");
    const std::string_view text = uri->get_ref<const std::string&>();
    if (text.starts_with("data:") && bytesOf(text) == 0) fail(".uri", "expected a picture, found no bytes");
  }

  void check(const json& buffer) const {
    if (!buffer.is_object()) fail("", "expected an object");
    const auto length = buffer.find("byteLength");
    if (length == buffer.end()) fail(".byteLength", "expected the number of bytes, found none");
    if (!length->is_number_unsigned() || length->get<std::uint64_t>() == 0)
      fail(".byteLength", "expected a whole number above 0, found " + length->dump().substr(0, 40));
    const auto uri = buffer.find("uri");
    if (uri == buffer.end()) {
      if (!first_) fail(".uri", "expected one: only the first buffer may lie in the file itself");
      return;
    }
    if (!uri->is_string()) fail(".uri", "expected the name of a file, or \"data:\" and its bytes");
    const std::string_view text = uri->get_ref<const std::string&>();
    if (!text.starts_with("data:")) return;
    if (const std::uint64_t bytes = bytesOf(text); bytes != length->get<std::uint64_t>())
      fail(".uri",
           "expected the " + length->dump() + " bytes that byteLength says, found " + std::to_string(bytes));
  }

 private:
  [[noreturn]] void fail(std::string_view of, const std::string& what) const {
    throw Error(Fault::scene, place_, path_ + std::string(of) + ": " + what);
  }

  /// How many the text stands for.
  std::uint64_t bytesOf(std::string_view text) const {
    const std::size_t comma = text.find(',');
    const std::size_t start = comma == text.npos ? text.size() : comma + 1;
    const std::string_view head = text.substr(5, start - 5);
    if (!isKnownData(head))
      fail(".uri", "expected \"data:application/octet-stream;base64,\" before the bytes, found \"" +
                       std::string(text.substr(0, std::min<std::size_t>(start, 60))) + "\"");
    std::string_view digits = text.substr(start);
    for (int i = 0; i < 2 && digits.ends_with('='); ++i) digits.remove_suffix(1);
    const auto odd = std::find_if_not(digits.begin(), digits.end(), isDigit);
    if (odd != digits.end())
      fail(".uri",
           "expected digits of base64, found " +
               (*odd > ' ' && *odd < 127 ? "\"" + std::string(1, *odd) + "\"" : "a character that is none") +
               " after " + std::to_string(odd - digits.begin()) + " of them");
    return digits.size() * 6 / 8;
  }

  const SourcePlace& place_;
  std::string path_;
  bool first_;
};

}  // namespace

bool plainGltfPictures(json& root) {
  const auto images = root.find("images");
  if (images == root.end() || !images->is_array()) return false;
  bool changed = false;
  for (json& image : *images) {
    const auto uri = image.is_object() ? image.find("uri") : image.end();
    if (uri == image.end() || !uri->is_string()) continue;
    const std::string text = uri->get<std::string>();
    const std::size_t comma = text.find(',');
    if (!text.starts_with("data:") || comma == text.npos) continue;
    const std::string_view head = std::string_view(text).substr(5, comma - 4);
    if (isKnownData(head) || !head.ends_with(kDataMark)) continue;
    *uri = "data:application/octet-stream;base64," + text.substr(comma + 1);
    changed = true;
  }
  return changed;
}

bool dropGltfFallbacks(json& root) {
  const auto buffers = root.find("buffers"), views = root.find("bufferViews");
  const bool areLists =
      buffers != root.end() && buffers->is_array() && views != root.end() && views->is_array();
  if (!areLists) return false;
  const auto extensionOf = [](const json& of) -> const json* {
    const json::json_pointer name("/extensions/EXT_meshopt_compression");
    return of.is_object() && of.contains(name) && of[name].is_object() ? &of[name] : nullptr;
  };
  std::vector<bool> isPlain(buffers->size()), isPacked(buffers->size());
  const auto note = [](std::vector<bool>& list, const json& owner) {
    const auto number = owner.find("buffer");
    if (number == owner.end() || !number->is_number_unsigned()) return;
    if (const auto i = number->get<std::uint64_t>(); i < list.size()) list[i] = true;
  };
  for (const json& view : *views) {
    if (!view.is_object()) continue;
    const json* packed = extensionOf(view);
    note(packed ? isPacked : isPlain, view);
    if (packed) note(isPlain, *packed);
  }
  bool changed = false;
  for (std::size_t i = 0; i < buffers->size(); ++i) {
    json& buffer = (*buffers)[i];
    const json* said = extensionOf(buffer);
    const bool saysSo = said && said->value("fallback", json()) == true && !buffer.contains("uri");
    if (!saysSo && (isPlain[i] || !isPacked[i])) continue;
    buffer = {{"byteLength", 1u}, {"uri", "data:application/octet-stream;base64,AA=="}};
    changed = true;
  }
  return changed;
}

bool dropDracoIndices(json& root) {
  const auto meshes = root.find("meshes"), accessors = root.find("accessors");
  const bool areLists =
      meshes != root.end() && meshes->is_array() && accessors != root.end() && accessors->is_array();
  if (!areLists) return false;
  const auto isWithoutView = [&](const json& number) {
    if (!number.is_number_unsigned() || number.get<std::uint64_t>() >= accessors->size()) return false;
    const json& accessor = (*accessors)[number.get<std::size_t>()];
    return accessor.is_object() && !accessor.contains("bufferView");
  };
  bool changed = false;
  for (json& mesh : *meshes) {
    const auto primitives = mesh.is_object() ? mesh.find("primitives") : mesh.end();
    if (primitives == mesh.end() || !primitives->is_array()) continue;
    for (json& primitive : *primitives) {
      const bool isPacked = primitive.is_object() &&
                            primitive.contains(json::json_pointer("/extensions/KHR_draco_mesh_compression"));
      const auto indices = isPacked ? primitive.find("indices") : primitive.end();
      if (indices == primitive.end() || !isWithoutView(*indices)) continue;
      primitive.erase(indices);
      changed = true;
    }
  }
  return changed;
}

void checkGltfBuffers(const json& root, const SourcePlace& place) {
  const auto each = [&](const char* name, auto check) {
    const auto list = root.find(name);
    if (list == root.end()) return;
    if (!list->is_array()) throw Error(Fault::scene, place, std::string(name) + ": expected a list");
    for (std::size_t i = 0; i < list->size(); ++i) (BufferCheck(place, name, i).*check)((*list)[i]);
  };
  each("buffers", &BufferCheck::check);
  each("images", &BufferCheck::checkPicture);
}

}  // namespace trace

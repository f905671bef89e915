#include "ply.h"

#include <cstring>
#include <map>
#include <sstream>

#include "base/error.h"
#include "base/files/file.h"

namespace trace::bench {
namespace {

struct Property {
  std::string name, type;
  std::string countType;  ///< count type of a list; empty for a single value
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

class Reader {
 public:
  Reader(const std::string& path, std::string bytes) : path_(path), bytes_(std::move(bytes)) {}

  std::vector<Element> header() {
    std::vector<Element> elements;
    if (line() != "ply") fail("this is not a PLY file");
    for (;;) {
      std::istringstream words(line());
      std::string key, word;
      words >> key;
      if (key == "end_header") return elements;
      if (key == "format" && words >> word && word != "binary_little_endian")
        fail("only binary_little_endian is read here, not " + word);
      if (key == "element") {
        Element& element = elements.emplace_back();
        words >> element.name >> element.count;
      } else if (key == "property") {
        if (elements.empty()) fail("a property before any element");
        Property& property = elements.back().properties.emplace_back();
        words >> property.type;
        if (property.type == "list") words >> property.countType >> property.type;
        words >> property.name;
      }
    }
  }

  double number(const std::string& type) {
    static const std::map<std::string, double (Reader::*)()> kTypes{
        {"char", &Reader::take<std::int8_t>},     {"int8", &Reader::take<std::int8_t>},
        {"uchar", &Reader::take<std::uint8_t>},   {"uint8", &Reader::take<std::uint8_t>},
        {"short", &Reader::take<std::int16_t>},   {"int16", &Reader::take<std::int16_t>},
        {"ushort", &Reader::take<std::uint16_t>}, {"uint16", &Reader::take<std::uint16_t>},
        {"int", &Reader::take<std::int32_t>},     {"int32", &Reader::take<std::int32_t>},
        {"uint", &Reader::take<std::uint32_t>},   {"uint32", &Reader::take<std::uint32_t>},
        {"float", &Reader::take<float>},          {"float32", &Reader::take<float>},
        {"double", &Reader::take<double>},        {"float64", &Reader::take<double>}};
    const auto found = kTypes.find(type);
    if (found == kTypes.end()) fail("a number of unknown type " + type);
    return (this->*found->second)();
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(Fault::io, SourcePlace{.file = path_}, what);
  }

 private:
  std::string line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string::npos) fail("the header has no end");
    std::string text = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    if (!text.empty() && text.back() == '\r') text.pop_back();
    return text;
  }

  template <class T>
  double take() {
    if (bytes_.size() - at_ < sizeof(T)) fail("the file ends too early");
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return static_cast<double>(value);
  }

  std::string path_, bytes_;
  std::size_t at_ = 0;
};

}  // namespace

MeshData readPly(const std::string& path, double scale) {
  Reader reader(path, readFile(path));
  MeshData mesh;
  for (const Element& element : reader.header()) {
    for (std::size_t i = 0; i < element.count; ++i) {
      Vec3 point;
      for (const Property& property : element.properties) {
        if (property.countType.empty()) {
          const double value = reader.number(property.type);
          if (property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
            point[property.name[0] - 'x'] = value;
          continue;
        }
        std::vector<std::uint32_t> corners(static_cast<std::size_t>(reader.number(property.countType)));
        for (std::uint32_t& corner : corners)
          corner = static_cast<std::uint32_t>(reader.number(property.type));
        if (element.name != "face" || !property.name.starts_with("vertex_ind")) continue;
        for (std::size_t k = 2; k < corners.size(); ++k)
          mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
      }
      if (element.name == "vertex") mesh.points.emplace_back(point * scale);
    }
  }
  for (const Triangle& triangle : mesh.triangles)
    for (std::uint32_t corner : triangle)
      if (corner >= mesh.points.size()) reader.fail("a face names a point that does not exist");
  if (mesh.triangles.empty()) reader.fail("there are no triangles");
  return mesh;
}

}  // namespace trace::bench

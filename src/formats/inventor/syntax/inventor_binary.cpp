// Source: Silicon Graphics, Open Inventor 2.1 (LGPL): SoInput, SoBase, SoFieldData and SoSFImage, and the
// fields that its headers declare. All numbers are big-endian and 4 bytes long, times 8; texts are filled up
// to a multiple of 4.
#include "formats/inventor/syntax/inventor_binary.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/bits.h"
#include "base/budget.h"
#include "base/error.h"
#include "base/nesting.h"
#include "base/text.h"
#include "formats/words.h"

namespace trace::inventor {
namespace {

/// Names of fields that have a type in all nodes, but for kOtherTypes.
struct TypedFields {
  std::string_view type, names;
};
constexpr std::array kTypes{
    TypedFields{"MFVec3f", "A B C D E F G H from point to vector vertex"},
    TypedFields{"MFFloat",
                "a b c d duty e f g h knotVector range sKnotVector screenArea shininess tKnotVector "
                "transparency uKnotVector vKnotVector w x y z"},
    TypedFields{"SFFloat",
                "alpha ambientIntensity angle aspectRatio bottomRadius creaseAngle cutOffAngle depth "
                "dropOffRate farDistance focalDistance fogVisibility frequency height heightAngle "
                "intensity lineWidth minDiscRotDot nearDistance pointSize radius size spacing speed "
                "textureQuality width"},
    TypedFields{"SFColor", "ambientColor blendColor color fogColor"},
    TypedFields{"SFVec3f",
                "attenuation bboxCenter bboxSize center direction directionS directionT location "
                "position scaleFactor separation1 separation2 separation3 translation translation0 "
                "translation1"},
    TypedFields{"SFEnum",
                "axis boundingBoxCaching faceType family fogType justification linkage map mode model "
                "origin pickCulling policy renderCaching renderCulling shapeType sizing style type "
                "value vertexOrdering viewportMapping wrapS wrapT"},
    TypedFields{"MFName", "childTypeNames"},
    TypedFields{"SFName", "containerTypeName label typeField"},
    TypedFields{"MFInt32", "coordIndex index materialIndex normalIndex numVertices textureCoordIndex"},
    TypedFields{"SFString", "description filename name"},
    TypedFields{"MFColor", "diffuseColor emissiveColor rgb specularColor"},
    TypedFields{"SFBool", "disable enable isActive on pause recalcAlways"},
    TypedFields{"SFTime", "duration timeIn"},
    TypedFields{"MFString", "expression string"},
    TypedFields{"SFBitMask", "flags parts whatToReset"},
    TypedFields{"SFImage", "image"},
    TypedFields{"SFTrigger",
                "input0 input1 input2 input3 input4 input5 input6 input7 input8 input9 off syncIn "
                "toggle trigger"},
    TypedFields{"MFMatrix", "matrix"},
    TypedFields{"SFInt32",
                "linePattern max min numControlPoints numElements1 numElements2 numElements3 "
                "numNodesUpToContainer numNodesUpToReset numPoints numSControlPoints "
                "numTControlPoints numUControlPoints numVControlPoints reset startIndex step "
                "verticesPerColumn verticesPerRow whichChild"},
    TypedFields{"MFEnum", "operation"},
    TypedFields{"MFInt32", "orderedRGBA"},
    TypedFields{"SFRotation", "orientation rotation rotation0 rotation1 scaleOrientation"},
    TypedFields{"SFPath", "path"},
    TypedFields{"SFPlane", "plane"},
    TypedFields{"MFVec2f", "texCoord"},
};
constexpr std::array kOtherTypes{
    TypedFields{"MFBool", "BoolOperation.a BoolOperation.b"},
    TypedFields{"MFColor", "Material.ambientColor"},
    TypedFields{"MFFloat",
                "ComposeRotation.angle AsciiText.width InterpolateFloat.input0 "
                "InterpolateFloat.input1"},
    TypedFields{"MFVec3f",
                "ComposeRotation.axis ComposeMatrix.center DecomposeMatrix.center "
                "InterpolateVec3f.input0 InterpolateVec3f.input1 VertexProperty.normal "
                "ComposeMatrix.scaleFactor ComposeMatrix.translation"},
    TypedFields{"SFVec2f",
                "Texture2Transform.center Texture2Transform.scaleFactor "
                "Texture2Transform.translation"},
    TypedFields{"SFInt32", "SelectOne.index"},
    TypedFields{"MFRotation",
                "InterpolateRotation.input0 InterpolateRotation.input1 "
                "DecomposeRotation.rotation ComposeMatrix.rotation "
                "ComposeMatrix.scaleOrientation"},
    TypedFields{"MFVec2f",
                "InterpolateVec2f.input0 InterpolateVec2f.input1 ProfileCoordinate2.point "
                "TextureCoordinate2.point DecomposeVec2f.vector"},
    TypedFields{"MFVec4f",
                "InterpolateVec4f.input0 InterpolateVec4f.input1 Coordinate4.point "
                "DecomposeVec4f.vector"},
    TypedFields{"SFEnum", "VertexProperty.materialBinding VertexProperty.normalBinding Units.units"},
    TypedFields{"SFMatrix", "MatrixTransform.matrix"},
    TypedFields{"SFName", "Font.name"},
    TypedFields{"SFTrigger", "OnOff.on ElapsedTime.reset"},
    TypedFields{"SFFloat", "Texture2Transform.rotation Complexity.value"},
    TypedFields{"SFString", "Info.string"},
    TypedFields{"SFBitMask", "FontStyle.style"},
};

bool lists(std::string_view names, std::string_view name) {
  for (std::size_t at = names.find(name); at != names.npos; at = names.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || names[at - 1] == ' ') && (end == names.size() || names[end] == ' ')) return true;
  }
  return false;
}

/// Parts of node kits and all else is a node.
std::string_view typeOf(const std::string& node, const std::string& field) {
  const std::string full = node + "." + field;
  for (const TypedFields& fields : kOtherTypes)
    if (lists(fields.names, full)) return fields.type;
  for (const TypedFields& fields : kTypes)
    if (lists(fields.names, field)) return fields.type;
  return "SFNode";
}

/// How many floats make a value of the type, behind its SF or MF; 0 for other types.
std::size_t floatsOf(std::string_view type) {
  constexpr std::pair<std::string_view, std::size_t> kCounts[] = {
      {"Float", 1}, {"Vec2f", 2}, {"Vec3f", 3},    {"Vec4f", 4},
      {"Color", 3}, {"Plane", 4}, {"Rotation", 4}, {"Matrix", 16}};
  for (const auto& [name, count] : kCounts)
    if (name == type) return count;
  return 0;
}

/// Version 2.0 does not say which nodes have children, nor how many fields those have that can have none.
constexpr std::string_view kGroups =
    "Separator Group TransformSeparator Switch LOD LevelOfDetail Annotation Selection Array MultipleCopy "
    "PathSwitch Blinker WWWAnchor";
constexpr std::string_view kWithoutFields =
    "Group TransformSeparator TextureCoordinateDefault TextureCoordinateEnvironment Callback EventCallback";

class BinaryReader {
 public:
  BinaryReader(const std::string& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  std::string text() {
    const std::size_t end = bytes_.find('\n');
    const std::string_view head = bytes_.substr(0, end);
    at_ = end == bytes_.npos ? bytes_.size() : end + 1;
    old_ = hasWord(head, "V2.0");
    if (!old_ && !hasWord(head, "V2.1"))
      fail("expected version 2.0 or 2.1 of binary Open Inventor", kConverter);
    text_ = "#Inventor V2.1 ascii\n";
    while (at_ < bytes_.size()) node();
    return std::move(text_);
  }

 private:
  static constexpr const char* kConverter = "ivcat of Debian's inventor-clients makes a text file of it";

  [[noreturn]] void fail(const std::string& what, const char* hint = "") const {
    throw Error(Fault::scene, SourcePlace{.file = file_}, "byte " + std::to_string(at_) + ": " + what, hint);
  }

  // --- what the file is made of ---

  std::string_view take(std::size_t size) {
    checkBudget();
    if (size > bytes_.size() - at_)
      fail("expected " + std::to_string(size) + " bytes, found the end of the file");
    const std::string_view taken = bytes_.substr(at_, size);
    at_ += size;
    return taken;
  }
  std::uint64_t whole(std::size_t size) {
    std::uint64_t value = 0;
    for (const char c : take(size)) value = value << 8 | static_cast<unsigned char>(c);
    return value;
  }
  std::uint32_t number() { return static_cast<std::uint32_t>(whole(4)); }
  /// The number of values of at least 4 bytes each.
  std::size_t count(const char* of) {
    const std::size_t n = number();
    if (n <= (bytes_.size() - at_) / 4) return n;
    at_ -= 4;
    fail("expected a number of " + std::string(of) + " that fits into the file, found " + std::to_string(n));
  }
  std::string string() {
    const std::size_t size = number();
    if (size > bytes_.size()) fail("expected a text, found one of " + std::to_string(size) + " bytes");
    const std::string value(take(size));
    take((4 - size % 4) % 4);
    return value;
  }

  // --- the text ---

  /// A word of the text, of any bytes.
  static std::string word(const std::string& name) {
    std::string plain;
    for (const char c : name) {
      const bool isPlain =
          (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
      plain += isPlain ? c : '_';
    }
    const bool isName = !plain.empty() && (plain[0] < '0' || plain[0] > '9');
    return (isName ? "" : "_") + plain;
  }
  void put(std::string_view text) { (text_ += text) += ' '; }
  template <class T>
  void putNumber(T value) {
    appendNumber(text_, value);
    text_ += ' ';
  }
  void putFloats(std::size_t n) {
    for (; n > 0; --n) putNumber(bitCast<float>(number()));
  }

  void node() {
    std::string type = string();
    if (type.empty() || type == "NULL") return put("NULL");
    if (type == "USE") {
      put("USE");
      return put(word(string()));
    }
    if (type == "DEF") {
      put("DEF");
      put(word(string()));
      type = string();
    }
    constexpr std::uint32_t kGroup = 2;
    const std::uint32_t flags = old_ ? (lists(kGroups, type) ? kGroup : 0) : number();
    put(word(type));
    put("{");
    if (++depth_ > kMostNesting)
      fail("expected at most " + std::to_string(kMostNesting) + " levels of nodes, found more");
    if (!old_ || !lists(kWithoutFields, type)) fields(type);
    if (flags & kGroup)
      for (std::size_t n = count("children"); n > 0; --n) node();
    --depth_;
    text_ += "}\n";
  }

  void fields(const std::string& node) {
    constexpr std::uint32_t kCount = 0xff, kDescribed = 0x100;
    const std::uint32_t said = number();
    std::map<std::string, std::string> types;  // field types of a node that its program has added
    if (said & kDescribed)
      for (std::uint32_t n = said & kCount; n > 0; --n) {
        std::string type = string();
        if (type.starts_with("So")) type.erase(0, 2);
        types[string()] = type;
      }
    for (std::uint32_t n = said & kCount; n > 0; --n) {
      const std::string name = string();
      const auto described = types.find(name);
      field(name, described == types.end() ? typeOf(node, name) : std::string_view(described->second));
    }
  }

  void field(const std::string& name, std::string_view type) {
    constexpr std::uint32_t kIgnored = 1, kConnected = 2;
    const std::size_t start = text_.size();
    put(word(name));
    const bool isTrigger = type.ends_with("Trigger");  // has no value
    if (!isTrigger) value(name, type);
    const std::uint32_t flags = number();
    if (flags & kIgnored) put("~");
    if (flags & kConnected) {
      put("=");
      node();
      put(".");
      put(word(string()));
    } else if (isTrigger) {
      text_.resize(start);
    }
  }

  void value(const std::string& name, std::string_view type) {
    const bool several = type.starts_with("MF");
    if (!several && !type.starts_with("SF")) type = {};
    const std::string_view of = type.substr(std::min<std::size_t>(type.size(), 2));
    if (!several) return one(name, of);
    put("[");
    for (std::size_t n = count("values"); n > 0; --n) one(name, of);
    put("]");
  }

  void one(const std::string& name, std::string_view type) {
    if (const std::size_t floats = floatsOf(type); floats > 0) {
      putFloats(floats);
    } else if (type == "Int32" || type == "Long" || type == "Short" || type == "UShort") {
      put(std::to_string(static_cast<std::int32_t>(number())));
    } else if (type == "Bool") {
      put(number() != 0 ? "TRUE" : "FALSE");
    } else if (type == "UInt32" || type == "ULong") {
      put(std::to_string(number()));
    } else if (type == "Enum" || type == "Name") {
      put(word(string()));
    } else if (type == "String") {
      text_ += '"';
      for (const char c : string()) (text_ += c == '"' || c == '\\' ? "\\" : "") += c;
      put("\"");
    } else if (type == "BitMask") {
      put("(");
      for (std::string bit = string(); !bit.empty(); bit = string()) put(word(bit));
      put(")");
    } else if (type == "Time") {
      putNumber(bitCast<double>(whole(8)));
    } else if (type == "Image") {
      image();
    } else if (type == "Node" || type == "Engine") {
      node();
    } else {
      fail("the type of the field " + word(name).substr(0, 40) + " is not known", kConverter);
    }
  }

  void image() {
    const std::uint64_t width = number(), height = number(), components = number();
    const std::uint64_t each = old_ ? 4 : components, size = width * height * each;
    if (width > 65536 || height > 65536 || components > 4 || size > bytes_.size() - at_)
      fail("expected an image that fits into the file");
    for (const std::uint64_t n : {width, height, components}) put(std::to_string(n));
    if (components == 0) return;
    for (std::uint64_t pixels = width * height; pixels > 0; --pixels) put(std::to_string(whole(each)));
    take((4 - size % 4) % 4);
  }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t at_ = 0;
  bool old_ = false;  ///< version 2.0
  int depth_ = 0;
  std::string text_;
};

}  // namespace

bool isBinary(std::string_view bytes) {
  const std::string_view line = bytes.substr(0, std::min<std::size_t>(bytes.find_first_of("\r\n"), 100));
  return sameWord(line.substr(0, 9), "#Inventor") && hasWord(line, "binary");
}

std::string textOfBinary(const std::string& file, std::string_view bytes) {
  return BinaryReader(file, bytes).text();
}

}  // namespace trace::inventor

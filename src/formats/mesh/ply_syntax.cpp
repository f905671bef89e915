#include "formats/mesh/ply_syntax.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/text.h"
#include "formats/words.h"

namespace trace::ply {
namespace {

constexpr bool kLittleMachine = __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__;

struct TypeName {
  std::string_view name;
  Type type;
};
constexpr std::array<TypeName, 16> kTypeNames{{{"char", Type::int8},
                                               {"uchar", Type::uint8},
                                               {"short", Type::int16},
                                               {"ushort", Type::uint16},
                                               {"int", Type::int32},
                                               {"uint", Type::uint32},
                                               {"float", Type::float32},
                                               {"double", Type::float64},
                                               {"int8", Type::int8},
                                               {"uint8", Type::uint8},
                                               {"int16", Type::int16},
                                               {"uint16", Type::uint16},
                                               {"int32", Type::int32},
                                               {"uint32", Type::uint32},
                                               {"float32", Type::float32},
                                               {"float64", Type::float64}}};

/// Calls visit with a zero of the C++ type.
template <class Visit>
decltype(auto) withType(Type type, Visit&& visit) {
  switch (type) {
    case Type::int8: return visit(std::int8_t{});
    case Type::uint8: return visit(std::uint8_t{});
    case Type::int16: return visit(std::int16_t{});
    case Type::uint16: return visit(std::uint16_t{});
    case Type::int32: return visit(std::int32_t{});
    case Type::uint32: return visit(std::uint32_t{});
    case Type::float32: return visit(float{});
    case Type::float64: break;
  }
  return visit(double{});
}

std::size_t sizeOf(Type type) {
  return withType(type, [](auto zero) { return sizeof zero; });
}

template <class T>
T load(const char* from, bool swap) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, from, sizeof(T));
  if (swap) std::reverse(bytes, bytes + sizeof(T));
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

bool isBlank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

std::uint32_t toIndex(double number) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  if (!(number >= 0 && number < kNone) || number != std::floor(number)) return kNone;
  return static_cast<std::uint32_t>(number);
}

/// Splits the header into lines and words.
class HeaderReader {
 public:
  HeaderReader(const std::string& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  Header read() {
    while (nextLine() && words_.empty()) {
    }
    if (words_.empty() || !is(0, "ply")) fail("expected \"ply\"");
    bool format = false;
    for (;;) {
      if (!nextLine()) fail("expected \"end_header\", found the end of the file");
      if (words_.empty() || is(0, "obj_info")) continue;
      if (is(0, "comment")) {
        readComment();
        continue;
      }
      if (is(0, "end_header")) break;
      if (is(0, "format")) {
        readFormat();
        format = true;
      } else if (is(0, "element"))
        readElement();
      else if (is(0, "property"))
        readProperty();
      else
        readUnknown();
    }
    if (!format) fail("expected a line \"format ...\" before the end of the header");
    header_.end = at_;
    return std::move(header_);
  }

 private:
  static constexpr std::size_t kMostProperties = 1000;

  bool is(std::size_t i, std::string_view word) const { return sameWord(words_[i], word); }

  bool nextLine() {
    if (at_ >= bytes_.size()) return false;
    lineStart_ = at_;
    const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
    std::string_view line = bytes_.substr(at_, end - at_);
    at_ = std::min(end + 1, bytes_.size());
    words_.clear();
    for (;;) {
      const std::size_t start = line.find_first_not_of(" \t\r");
      if (start == std::string_view::npos) return true;
      line.remove_prefix(start);
      const std::size_t length = std::min(line.find_first_of(" \t\r"), line.size());
      if (words_.size() < 8) words_.push_back(line.substr(0, length));
      line.remove_prefix(length);
    }
  }

  /// `comment TextureFile wood.png`: the name is the rest of the line.
  void readComment() {
    if (words_.size() < 3 || !is(1, "TextureFile")) return;
    const auto start = static_cast<std::size_t>(words_[2].data() - bytes_.data());
    std::string_view name = bytes_.substr(start, at_ - start);
    name = name.substr(0, name.find_last_not_of(" \t\r\n") + 1);
    header_.textures.emplace_back(std::string(name), linePlace());
  }

  /// A line whose first word is nearly a keyword is a mistake; any other is taken for a comment.
  void readUnknown() {
    constexpr std::array<std::string_view, 5> kKeywords{"format", "element", "property", "comment",
                                                        "end_header"};
    const std::string word(words_[0].substr(0, 40));
    if (!nearest(word, kKeywords).empty() || header_.unknown.size() >= kMostProperties)
      fail("expected a line of a PLY header (format, element, property, comment or end_header), found \"" +
           word + "\"");
    header_.unknown.emplace_back(word, linePlace());
  }

  void readFormat() {
    const std::string_view name = words_.size() > 1 ? words_[1] : "";
    if (sameWord(name, "ascii"))
      header_.encoding = Encoding::text;
    else if (sameWord(name, "binary_little_endian"))
      header_.encoding = Encoding::little;
    else if (sameWord(name, "binary_big_endian"))
      header_.encoding = Encoding::big;
    else
      fail("expected format ascii, binary_little_endian or binary_big_endian");
    if (words_.size() > 2 && words_[2] != "1.0")
      fail("expected version 1.0 of the format, found \"" + std::string(words_[2].substr(0, 40)) + "\"");
  }

  void readElement() {
    if (words_.size() < 3) fail("expected an element's name and number, as in \"element vertex 8\"");
    const auto number = parseNumber(words_[2]);
    if (!number || number->length != words_[2].size() || !(number->value >= 0 && number->value < 1e15) ||
        number->value != std::floor(number->value))
      fail("expected a number of elements, found \"" + std::string(words_[2].substr(0, 40)) + "\"");
    header_.elements.push_back(
        {std::string(words_[1]), static_cast<std::size_t>(number->value), {}, linePlace()});
  }

  void readProperty() {
    if (header_.elements.empty()) fail("expected an element before its properties");
    const bool isList = words_.size() > 1 && is(1, "list");
    if (words_.size() < (isList ? 5u : 3u))
      fail(
          "expected a type and a name, as in \"property float x\" or \"property list uchar int "
          "vertex_indices\"");
    Property property{std::string(words_[isList ? 4 : 2]), type(words_[isList ? 3 : 1]), isList,
                      isList ? type(words_[2]) : Type::uint8, linePlace()};
    std::vector<Property>& all = header_.elements.back().properties;
    for (const Property& before : all)
      if (before.name == property.name)
        fail("expected each property once, found \"" + property.name.substr(0, 40) + "\" again");
    if (all.size() >= kMostProperties) fail("expected at most 1000 properties of an element");
    all.push_back(std::move(property));
  }

  Type type(std::string_view word) const {
    for (const TypeName& known : kTypeNames)
      if (sameWord(known.name, word)) return known.type;
    fail("expected a type, as in float or uchar, found \"" + std::string(word.substr(0, 40)) + "\"");
  }

  [[noreturn]] void fail(std::string what) const { throw Error(Fault::scene, linePlace(), std::move(what)); }
  SourcePlace linePlace() const { return placeAt(file_, bytes_.substr(0, at_), lineStart_); }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t at_ = 0, lineStart_ = 0;
  std::vector<std::string_view> words_;
  Header header_;
};

}  // namespace

int Element::find(const std::vector<std::string_view>& names) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    for (std::string_view wanted : names)
      if (sameWord(wanted, properties[i].name)) return static_cast<int>(i);
  return -1;
}

bool Element::hasLists() const {
  return std::any_of(properties.begin(), properties.end(), [](const Property& p) { return p.isList; });
}

Header readHeader(const std::string& file, std::string_view bytes) {
  return HeaderReader(file, bytes).read();
}

Body::Body(const std::string& file, std::string_view bytes, const Header& header)
    : file_(file), bytes_(bytes), encoding_(header.encoding), at_(header.end) {
  if (encoding_ != Encoding::text) return;
  std::size_t rows = 0, lines = 0;
  for (const Element& element : header.elements) rows += element.properties.empty() ? 0 : element.count;
  for (std::size_t at = at_; at < bytes.size() && lines < rows;) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
    lines += bytes.substr(at, end - at).find_first_not_of(" \t\r") < end - at;
    at = end + 1;
  }
  rowsAreLines_ = rows > 0 && lines >= rows;
}

SourcePlace Body::place() const {
  return encoding_ == Encoding::text ? placeAt(file_, bytes_, std::min(rowAt_, bytes_.size()))
                                     : SourcePlace{file_, 0, 0, {}};
}

SourcePlace Body::nextPlace() const {
  if (encoding_ != Encoding::text) return {file_, 0, 0, {}};
  return placeAt(file_, bytes_, std::min(bytes_.find_first_not_of(" \t\r\n", at_), bytes_.size()));
}

void Body::beginRow() {
  if (encoding_ == Encoding::text)
    while (at_ < bytes_.size() && isBlank(bytes_[at_])) ++at_;
  rowAt_ = at_;
}

/// Each row has a line of its own: what else stands there belongs to none.
void Body::endRow() {
  if (!rowsAreLines_) return;
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  const bool more = bytes_.substr(at_, end - at_).find_first_not_of(" \t\r") < end - at_;
  if (more && surplus_++ == 0) firstSurplus_ = place();
  at_ = end;
}

void Body::fail(std::string what) const {
  if (encoding_ == Encoding::text) throw Error(Fault::scene, placeAt(file_, bytes_, at_), std::move(what));
  throw Error(Fault::scene, SourcePlace{file_, 0, 0, {}},
              what + " (byte " + std::to_string(at_) + " of the file)");
}

std::size_t Body::left() const {
  if (encoding_ != Encoding::text) return bytes_.size() - at_;
  const std::string_view rest = bytes_.substr(at_);
  return rest.find_last_not_of(" \t\r\n\v\f") + 1;
}

void Body::need(std::size_t bytes) const {
  if (bytes_.size() - at_ < bytes) fail(what_ + ": the file ends too early");
}

void Body::checkCount(const Element& element) const {
  std::size_t least = 0;  // bytes of a row; in text a digit and a blank for each number
  for (const Property& p : element.properties)
    least += encoding_ == Encoding::text ? 2 : sizeOf(p.isList ? p.countType : p.type);
  const std::size_t rest = bytes_.size() - at_ + 1;  // the last number of a text may end the file
  if (least > 0 && element.count > rest / least)
    fail("expected " + std::to_string(element.count) + " of element \"" + element.name +
         "\", but the file has bytes for at most " + std::to_string(rest / least));
}

double Body::number(Type type) {
  if (encoding_ != Encoding::text) {
    const std::size_t size = sizeOf(type);
    need(size);
    const bool swap = (encoding_ == Encoding::little) != kLittleMachine;
    const double value = withType(type, [&](auto zero) {
      return static_cast<double>(load<decltype(zero)>(bytes_.data() + at_, swap));
    });
    at_ += size;
    return value;
  }
  while (at_ < bytes_.size() && isBlank(bytes_[at_])) ++at_;
  need(1);
  const auto parsed = parseNumber(bytes_.substr(at_));
  const std::size_t end = at_ + (parsed ? parsed->length : 0);
  if (!parsed || (end < bytes_.size() && !isBlank(bytes_[end]))) return wrongWord();
  at_ = end;
  return parsed->value;
}

double Body::wrongWord() {
  const std::size_t end = std::min(bytes_.find_first_of(" \t\r\n\v\f", at_), bytes_.size());
  const std::string word(bytes_.substr(at_, std::min<std::size_t>(end - at_, 40)));
  if (wrongWords_++ == 0)
    firstWrong_ = {Message::Severity::warning,
                   placeAt(file_, bytes_, at_),
                   what_ + ": expected a number, found \"" + word + "\"",
                   {}};
  at_ = end;
  return std::numeric_limits<double>::quiet_NaN();
}

std::size_t Body::startOfRow(const Element& element, std::size_t row) const {
  Body ahead = *this;
  Element before = element;
  before.count = row;
  ahead.skip(before);
  ahead.beginRow();
  return ahead.rowAt_;
}

std::size_t Body::listLength(const Property& property) {
  const std::uint32_t length = toIndex(number(property.countType));
  const std::size_t least = encoding_ == Encoding::text ? 2 : sizeOf(property.type);
  if (length > (bytes_.size() - at_ + 1) / least)
    fail(what_ + ": a list is longer than the rest of the file");
  return length;
}

void Body::readColumns(const Element& element, std::span<const Column> columns) {
  what_ = "element \"" + element.name + "\"";
  checkCount(element);
  if (encoding_ != Encoding::text && !element.hasLists()) return readFixedColumns(element, columns);
  if (element.properties.empty()) return;
  for (std::size_t row = 0; row < element.count; ++row) {
    beginRow();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (property.isList) {
        for (std::size_t n = listLength(property); n > 0; --n) number(property.type);
      } else {
        const double value = number(property.type);
        if (columns[i].to) columns[i].to[row * columns[i].step] = static_cast<float>(value);
      }
    }
    endRow();
  }
}

void Body::readFixedColumns(const Element& element, std::span<const Column> columns) {
  std::size_t stride = 0;
  for (const Property& property : element.properties) stride += sizeOf(property.type);
  need(stride * element.count);
  const bool swap = (encoding_ == Encoding::little) != kLittleMachine;
  std::size_t offset = at_;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const Type type = element.properties[i].type;
    if (columns[i].to)
      withType(type, [&](auto zero) {
        const char* from = bytes_.data() + offset;
        float* to = columns[i].to;
        for (std::size_t row = 0; row < element.count; ++row, from += stride, to += columns[i].step)
          *to = static_cast<float>(load<decltype(zero)>(from, swap));
      });
    offset += sizeOf(type);
  }
  at_ += stride * element.count;
}

void Body::readLists(const Element& element, const Lists& lists, const VisitList& visit) {
  what_ = "element \"" + element.name + "\"";
  checkCount(element);
  const Property& list = element.properties[static_cast<std::size_t>(lists.items)];
  std::vector<std::uint32_t> items;
  std::vector<float> numbers;
  const bool usual = encoding_ != Encoding::text && element.properties.size() == 1 &&
                     sizeOf(list.countType) == 1 && (list.type == Type::int32 || list.type == Type::uint32);
  if (usual) {
    const bool swap = (encoding_ == Encoding::little) != kLittleMachine;
    items.resize(256);
    for (std::size_t row = 0; row < element.count; ++row) {
      need(1);
      rowAt_ = at_;
      const std::size_t length = static_cast<unsigned char>(bytes_[at_++]);
      need(4 * length);
      const char* from = bytes_.data() + at_;
      for (std::size_t i = 0; i < length; ++i) items[i] = load<std::uint32_t>(from + 4 * i, swap);
      at_ += 4 * length;
      visit({items.data(), length}, {});
    }
    return;
  }
  for (std::size_t row = 0; row < element.count; ++row) {
    beginRow();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (!property.isList) {
        const double value = number(property.type);
        if (i < lists.columns.size() && lists.columns[i].to)
          lists.columns[i].to[row * lists.columns[i].step] = static_cast<float>(value);
        continue;
      }
      const std::size_t length = listLength(property);
      if (&property == &list) {
        items.resize(length);
        for (std::uint32_t& item : items) item = toIndex(number(property.type));
      } else if (static_cast<int>(i) == lists.numbers) {
        numbers.resize(length);
        for (float& n : numbers) n = static_cast<float>(number(property.type));
      } else {
        for (std::size_t n = length; n > 0; --n) number(property.type);
      }
    }
    endRow();
    visit(items, numbers);
  }
}

void Body::skip(const Element& element) {
  const std::vector<Column> nowhere(element.properties.size());
  readColumns(element, nowhere);
}

}  // namespace trace::ply

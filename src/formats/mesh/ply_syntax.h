// The grammar of PLY files, apart from their meaning: a header that lists elements and their properties, and
// a body of numbers, as text or binary in either byte order (Turk, The PLY Polygon File Format, 1994).
//
// Rows without lists, in a binary file, are read column by column, and the usual list of faces in one tight
// loop; anything else number by number. Counts in a header are held against the size of the file before
// memory is taken for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace trace::ply {

enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class Encoding : std::uint8_t { text, little, big };

struct Property {
  std::string name;
  Type type;  ///< type of the number, or of a list's items
  bool isList = false;
  Type countType = Type::uint8;  ///< count type of a list
  SourcePlace place{};           ///< its line in the header
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
  SourcePlace place{};  ///< its line in the header

  /// The index of the first of these properties that it has, or -1.
  int find(const std::vector<std::string_view>& names) const;
  bool hasLists() const;
};

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::size_t end = 0;  ///< offset of the body
  std::vector<std::pair<std::string, SourcePlace>>
      textures;  ///< that comments name, as scanners' programs write them
  /// Lines that are none of a header, as some programs write their names.
  std::vector<std::pair<std::string, SourcePlace>> unknown;
};

/// Throws Error(Fault::scene).
Header readHeader(const std::string& file, std::string_view bytes);

/// Where the numbers of a property go: `to`, `to + step`, ...; nowhere if null.
struct Column {
  float* to = nullptr;
  std::size_t step = 0;
};

/// Reads the elements of a body, which must be asked for in their order.
class Body {
 public:
  Body(const std::string& file, std::string_view bytes, const Header& header);

  /// Throws Error(Fault::scene) if the rest of the file is too short for the element's number of rows. To be
  /// asked before memory is taken for them.
  void checkCount(const Element& element) const;

  /// One column for each property of the element; those of lists are ignored.
  void readColumns(const Element& element, std::span<const Column> columns);

  /// Which properties of an element are wanted: a list of whole numbers, perhaps one of others (-1 for none),
  /// and columns, as readColumns() has them, or none at all.
  struct Lists {
    int items, numbers = -1;
    std::span<const Column> columns{};
  };
  /// Calls visit(items, numbers) for each row. An item that is no whole number, or negative, comes as 2^32 -
  /// 1 or near it.
  using VisitList = std::function<void(std::span<const std::uint32_t>, std::span<const float>)>;
  void readLists(const Element& element, const Lists& lists, const VisitList& visit);

  void skip(const Element& element);

  [[noreturn]] void fail(std::string what) const;
  /// Where the row begins that was read last; in a text.
  SourcePlace place() const;
  /// Where the next value is; in a text.
  SourcePlace nextPlace() const;

  /// Rows of a text behind whose values others stand on the same line, which are skipped.
  std::size_t surplus() const { return surplus_; }
  const SourcePlace& firstSurplus() const { return firstSurplus_; }

  /// Words of a text that are no numbers, which are read as NaN, and the first.
  std::size_t wrongWords() const { return wrongWords_; }
  const Message& firstWrong() const { return firstWrong_; }

  /// The byte where a row of the element begins, which stands next.
  std::size_t startOfRow(const Element& element, std::size_t row) const;
  /// The byte of the row that was read last.
  std::size_t row() const { return rowAt_; }
  bool isText() const { return encoding_ == Encoding::text; }

  /// Bytes that no element has used, blanks at the end of a text not counted.
  std::size_t left() const;

 private:
  double number(Type type);
  double wrongWord();
  std::size_t listLength(const Property& property);
  void need(std::size_t bytes) const;
  void beginRow();
  void endRow();
  void readFixedColumns(const Element& element, std::span<const Column> columns);

  const std::string& file_;
  std::string_view bytes_;
  Encoding encoding_;
  std::size_t at_;
  std::string what_;  ///< the row being read, for messages
  bool rowsAreLines_ = false;
  std::size_t rowAt_ = 0, surplus_ = 0, wrongWords_ = 0;
  SourcePlace firstSurplus_{};
  Message firstWrong_{};
};

}  // namespace trace::ply

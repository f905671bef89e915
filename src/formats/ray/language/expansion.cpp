#include "formats/ray/language/expansion.h"

#include "base/text.h"
#include "formats/ray/language/language.h"
#include "formats/ray/read/fields.h"
#include "formats/ray/syntax/syntax.h"
#include "formats/scene_time.h"

namespace trace {
namespace rayfile {
namespace {

/// Prints a plain tree, of which the text of the file may be nothing any more.
class PlainText {
 public:
  explicit PlainText(const Syntax& syntax) : syntax_(syntax) {}

  std::string text() {
    const Item root = syntax_.root();
    std::size_t number = 0;
    for (const Item item : root) {
      if (number > 1) {  // behind the first line
        comment(item);
        lineStart_ = out_.size();
        print(item);
        out_ += std::string(endOf(item)) + "\n";
      } else {
        out_ += std::string(item.source()) + (number == 0 ? " " : "\n");
      }
      ++number;
    }
    return std::move(out_);
  }

 private:
  static constexpr std::size_t kWidth = 100;

  /// Which line made it.
  void comment(const Item& item) {
    const SourcePlace place = syntax_.place(item.offset());
    out_ += "\n// " + place.file.str() + ":" + std::to_string(place.line);
    if (const std::string chain = item.chain(); !chain.empty()) out_ += ", " + chain;
    out_ += "\n";
  }
  /// Nothing that follows becomes a part of the item.
  static std::string_view endOf(const Item& item) {
    const bool closed = item.is(Kind::block) || (item.is(Kind::call) && item.value().is(Kind::block));
    return closed ? "" : ";";
  }
  void newLine() {
    out_ += '\n';
    lineStart_ = out_.size();
    out_.append(2 * static_cast<std::size_t>(depth_), ' ');
  }

  void print(const Item& item) {
    switch (item.kind()) {
      case Kind::number: out_ += toText(item.number()); return;
      case Kind::word: return word(item);
      case Kind::tuple: return tuple(item);
      case Kind::block: return block(item);
      case Kind::entry: out_ += std::string(item.key()) + " = "; return print(item.value());
      case Kind::call:
        out_ += std::string(item.key()) + (item.value().is(Kind::block) ? " " : "");
        return print(item.value());
      default: return;  // expand() leaves no others
    }
  }
  void word(const Item& item) {
    const Node& node = syntax_.nodes()[item.index()];
    out_ += node.quoted || node.number > 0 ? exactly(std::string(item.text())) : std::string(item.text());
  }
  void tuple(const Item& item) {
    out_ += '(';
    bool first = true;
    for (const Item part : item) {
      if (!first) out_ += ',';
      if (!first && out_.size() - lineStart_ > kWidth)
        newLine();
      else if (!first)
        out_ += ' ';
      first = false;
      print(part);
    }
    out_ += ')';
  }
  void block(const Item& item) {
    if (item.begin() == item.end()) return void(out_ += "{ }");
    out_ += '{';
    ++depth_;
    for (const Item part : item) {
      newLine();
      print(part);
      out_ += endOf(part);
    }
    --depth_;
    newLine();
    out_ += '}';
  }

  const Syntax& syntax_;
  std::string out_;
  std::size_t lineStart_ = 0;
  int depth_ = 0;
};

}  // namespace
}  // namespace rayfile

Expansion expansionOf(const std::string& file, std::string_view text, Real time) {
  rayfile::Syntax syntax(file, text);
  SceneTime moment(time);
  Expansion result;
  rayfile::expand(syntax, moment, result.inputs);
  syntax.throwMistakes();
  result.text = rayfile::PlainText(syntax).text();
  result.changesWithTime = moment.changesScene();
  return result;
}

}  // namespace trace

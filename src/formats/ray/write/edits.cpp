#include "formats/ray/write/edits.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "base/match.h"
#include "base/text.h"
#include "geometry/field_value.h"
#include "geometry/shapes/solids/csg_tree.h"

namespace trace::rayfile {
namespace {

bool isSpace(char c) { return c == ' ' || c == '\t'; }

bool isKey(const Item& value) {
  const bool number = value.is(Kind::number) || value.is(Kind::tuple);
  return number && value.source().starts_with(Syntax::kKey);
}

/// Numbers and lists of them, as they are at this moment.
bool sameNumbers(const Item& a, const Item& b) {
  if (a.kind() != b.kind()) return false;
  if (a.is(Kind::number)) return a.number() == b.number();
  if (!a.is(Kind::tuple) || a.count() != b.count()) return false;
  auto other = b.begin();
  for (const Item item : a) {
    if (!sameNumbers(item, *other)) return false;
    ++other;
  }
  return true;
}

/// The one number of which a tuple has three, as of a grey.
std::optional<double> onlyNumber(const Item& tuple) {
  std::optional<double> only;
  if (!tuple.is(Kind::tuple) || tuple.count() != 3) return {};
  for (const Item item : tuple) {
    if (!item.is(Kind::number) || (only && *only != item.number())) return {};
    only = item.number();
  }
  return only;
}

template <class AnyField>
void changeListed(TextEdits& edits, const Item& block, const std::vector<AnyField>& was,
                  const std::vector<AnyField>& is) {
  for (std::size_t i = 0; i < is.size(); ++i)
    match(is[i].value, [&]<class Value>(const Value& value) {
      const Value& before = *std::get_if<Value>(&was[i].value);
      if constexpr (std::is_same_v<Value, EnumValue>) {
        if (before.index() != value.index()) changeField(edits, block, is[i].keyword, value);
      } else if constexpr (!std::is_same_v<Value, Operands*> && !std::is_same_v<Value, MaterialList*>) {
        if (*before != *value) changeField(edits, block, is[i].keyword, *value);
      }
    });
}

}  // namespace

bool isComputed(const Item& value) {
  if (!value.syntax().usesLanguage()) return false;
  if (value.is(Kind::number)) {
    const auto read = parseNumber(value.source());
    return !read || read->length != value.source().size();
  }
  if (!value.is(Kind::tuple) || value.count() == 0) return false;
  return (*value.begin()).offset() == value.offset() || !value.source().starts_with('(');
}

std::optional<Item> fieldOf(const Item& block, std::string_view keyword) {
  std::optional<Item> found;
  for (const Item item : block)
    if (item.keyed() && canonical(item.key()) == keyword) found.emplace(item);
  return found;
}

TextEdits::TextEdits(const Syntax& syntax) : syntax_(syntax), source_(syntax.source()) {
  std::size_t all = 0, withReturn = 0;
  for (std::size_t newline = source_.find('\n'); newline != source_.npos;
       newline = source_.find('\n', newline + 1)) {
    ++all;
    if (newline > 0 && source_[newline - 1] == '\r') ++withReturn;
  }
  if (2 * withReturn > all) lineBreak_ = "\r\n";
}

void TextEdits::replace(std::size_t begin, std::size_t end, std::string text) {
  if (end > source_.size()) throw Error(Fault::scene, syntax_.shortPlace(begin), "it stands in another file");
  edits_.push_back({begin, end, broken(text)});
}

void TextEdits::change(const Item& value, const std::string& text) {
  const Syntax wanted("", text);
  const auto become = [&](auto&& self, const Item& old, const Item& now) -> void {
    if (sameNumbers(old, now)) return;
    const std::string source(now.source());
    if (isKey(old)) {
      lostKeys_.push_back(old.offset());
      return replace(old, source);
    }
    if (isComputed(old)) {
      lostExpressions_.push_back(old);
      return replace(old, source);
    }
    if (old.is(Kind::number)) {
      const std::optional<double> grey = onlyNumber(now);
      if (!grey && !now.is(Kind::number)) return replace(old, source);
      const double number = grey ? *grey : now.number();
      if (old.number() == number) return;
      return replace(old, grey ? std::string((*now.begin()).source()) : source);
    }
    if (old.is(Kind::word) && now.is(Kind::word)) {
      if (old.text() != now.text()) replace(old, source);
      return;
    }
    const bool lists = old.is(Kind::tuple) && now.is(Kind::tuple);
    if (!lists || old.count() == 0 || old.count() > now.count()) return replace(old, source);
    auto next = now.begin();
    std::size_t end = 0;
    for (const Item item : old) {
      self(self, item, *next);
      end = endOf(item);
      ++next;
    }
    std::string more;
    for (; next != now.end(); ++next) more += ", " + std::string((*next).source());
    if (!more.empty()) insert(end, more);
  };
  become(become, value, *wanted.root().begin());
}

void TextEdits::addField(const Item& block, const std::string& field) {
  fields_.try_emplace(block.offset(), block, std::vector<std::string>{})
      .first->second.second.push_back(field);
}

void TextEdits::erase(const Item& item) {
  std::size_t begin = item.offset(), end = endOf(item);
  std::size_t next = end;
  while (next < source_.size() && isSpace(source_[next])) ++next;
  if (next < source_.size() && (source_[next] == ';' || source_[next] == ',')) end = next + 1;
  const bool first = isBlank(lineStart(begin), begin), last = isBlank(end, lineEnd(end));
  if (first && last) {
    begin = lineStart(begin);
    end = lineEnd(end);
    const std::size_t newline = source_.find('\n', end);
    end = newline == source_.npos ? source_.size() : newline + 1;
  } else if (!last) {
    while (end < source_.size() && isSpace(source_[end])) ++end;
  } else {
    while (begin > 0 && isSpace(source_[begin - 1])) --begin;
  }
  replace(begin, end, "");
}

std::optional<std::size_t> TextEdits::endOfHead(std::size_t line) const {
  bool hasComment = false;
  for (std::size_t newline = source_.find('\n', line); newline != source_.npos;
       newline = source_.find('\n', newline + 1)) {
    const std::size_t begin = newline + 1, end = lineEnd(begin);
    if (isBlank(begin, end) && hasComment) return std::min(source_.find('\n', begin), source_.size() - 1) + 1;
    const std::string_view text = source_.substr(begin, end - begin);
    if (isBlank(begin, end)) continue;
    if (!text.substr(text.find_first_not_of(" \t")).starts_with("//")) return {};
    hasComment = true;
  }
  return {};
}

void TextEdits::addOnTop(std::string line) {
  auto item = syntax_.root().begin();
  const std::size_t version = endOf(*++item), end = lineEnd(version);
  const std::string_view rest = source_.substr(version, end - version);
  const std::size_t comment = rest.find_first_not_of(" \t\r;,");
  const bool alone = comment == rest.npos || rest.substr(comment).starts_with("//");
  if (const std::optional<std::size_t> head = alone ? endOfHead(end) : std::nullopt)
    insert(*head, line + "\n");
  else if (alone)
    insert(end, "\n" + line);
  else
    insert(version, "\n" + line + "\n");
}

std::string TextEdits::text(std::size_t begin, std::size_t end) const {
  std::string result;
  std::size_t at = begin;
  for (const Edit& edit : edits()) {
    if (edit.begin < begin || edit.end > end) continue;
    const bool inside = edit.begin < at;  // inside a text that is replaced as a whole
    if (inside && (!edit.text.empty() || edit.end <= at)) continue;
    if (!inside) result += source_.substr(at, edit.begin - at);
    result += edit.text;
    at = edit.end;
  }
  result += source_.substr(at, end - at);
  return result;
}

std::vector<TextEdits::Edit> TextEdits::edits() const {
  std::vector<Edit> all = edits_;
  for (const auto& [offset, added] : fields_) all.push_back(addition(added.first, added.second));
  std::stable_sort(all.begin(), all.end(), [](const Edit& a, const Edit& b) {
    if (a.begin != b.begin) return a.begin < b.begin;
    const bool insertsA = a.end == a.begin, insertsB = b.end == b.begin;
    return insertsA != insertsB ? insertsA : !insertsA && a.end > b.end;  // a whole before its parts
  });
  return all;
}

TextEdits::Edit TextEdits::addition(const Item& block, const std::vector<std::string>& fields) const {
  const std::size_t close = endOf(block) - 1;
  std::optional<Item> last;
  for (const Item item : block) last.emplace(item);
  std::string text;
  if (isBlank(lineStart(close), close) && lineStart(close) > block.offset()) {
    const bool ownLine = last && isBlank(lineStart(last->offset()), last->offset());
    const std::string indent =
        ownLine ? std::string(indentAt(last->offset())) : std::string(indentAt(close)) + "  ";
    for (const std::string& field : fields) text += indent + field + ";\n";
    return {lineStart(close), lineStart(close), broken(text)};
  }
  std::size_t at = last ? endOf(*last) : block.offset() + 1;
  if (last) {
    std::size_t next = at;
    while (next < close && isSpace(source_[next])) ++next;
    if (source_[next] == ';' || source_[next] == ',')
      at = next + 1;
    else
      text = ";";
  }
  for (const std::string& field : fields) text += " " + field + ";";
  if (at == close) text += " ";
  return {at, at, broken(text)};
}

std::string TextEdits::tail() const {
  if (appended_.empty()) return {};
  const bool ends = source_.empty() || source_.back() == '\n';
  return (ends ? "" : lineBreak_) + broken(appended_);
}

bool TextEdits::isBlank(std::size_t begin, std::size_t end) const {
  return std::all_of(source_.begin() + static_cast<std::ptrdiff_t>(begin),
                     source_.begin() + static_cast<std::ptrdiff_t>(end),
                     [](char c) { return isSpace(c) || c == '\r'; });
}

std::size_t TextEdits::lineStart(std::size_t at) const {
  const std::size_t newline = at == 0 ? source_.npos : source_.rfind('\n', at - 1);
  return newline == source_.npos ? 0 : newline + 1;
}

std::size_t TextEdits::lineEnd(std::size_t at) const {
  const std::size_t newline = source_.find('\n', at);
  if (newline == source_.npos) return source_.size();
  return newline > at && source_[newline - 1] == '\r' ? newline - 1 : newline;
}

std::string_view TextEdits::indentAt(std::size_t at) const {
  const std::size_t start = lineStart(at);
  std::size_t end = start;
  while (end < source_.size() && isSpace(source_[end])) ++end;
  return source_.substr(start, end - start);
}

std::string TextEdits::broken(std::string_view text) const {
  if (lineBreak_ == "\n") return std::string(text);
  std::string result;
  for (char c : text) {
    if (c == '\n')
      result += lineBreak_;
    else
      result += c;
  }
  return result;
}

std::string laidOut(std::string_view text, std::string_view indent) {
  constexpr std::size_t kLine = 110;
  std::string result;
  std::size_t lineStart = 0, mayBreak = 0;  // in the result; behind the last field of the line
  bool quoted = false;
  for (const char c : text) {
    result += c;
    if (c == '"') quoted = !quoted;
    if (c == '\n') lineStart = result.size();
    if (!quoted && result.ends_with("; ")) mayBreak = result.size();
    if (result.size() - lineStart <= kLine || mayBreak <= lineStart) continue;
    result.replace(mayBreak - 1, 1, "\n" + std::string(indent));
    lineStart = mayBreak;
  }
  return result;
}

void sayField(TextEdits& edits, const Item& block, std::string_view keyword, const std::string& text) {
  const std::optional<Item> field = fieldOf(block, keyword);
  if (field && text.empty())
    edits.erase(*field);
  else if (field)
    edits.change(field->value(), text);
  else if (!text.empty())
    edits.addField(block, std::string(keyword) + " = " + text);
}

void changeFields(TextEdits& edits, const Item& block, const Shape& from, const Shape& to) {
  changeListed(edits, block, from.fields(), to.fields());
}
void changeFields(TextEdits& edits, const Item& block, const Light& from, const Light& to) {
  changeListed(edits, block, from.fields(), to.fields());
}

}  // namespace trace::rayfile

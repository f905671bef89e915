#include "formats/ray/syntax/syntax.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "formats/ray/syntax/parser.h"
#include "formats/words.h"

namespace trace::rayfile {

std::string quoted(std::string_view text) { return "\"" + std::string(text) + "\""; }

Syntax::Syntax(std::string file, std::string_view source) {
  sources_.emplace_back().name = std::move(file);
  sources_.back().text = source;
  nodes_.reserve(source.size() / 4);  // more than most files need; what is not used takes no memory
  parse(sources_.back());
}

std::uint32_t Syntax::include(std::string file, std::string source) {
  const Source& last = sources_.back();
  const auto base = static_cast<std::uint32_t>(last.base + last.text.size() + 1);
  Source& added = sources_.emplace_back();
  added.name = std::move(file);
  added.owned = std::move(source);
  added.text = added.owned;
  added.base = base;
  const auto first = static_cast<std::uint32_t>(nodes_.size());
  parse(added);
  return first;
}

void Syntax::parse(Source& source) {
  if (source.base + source.text.size() >= std::numeric_limits<std::uint32_t>::max())
    throw Error(Fault::limit, SourcePlace{source.name, 0, 0, {}},
                "expected a scene of less than 4 GiB of text");
  for (std::size_t newline = source.text.find('\n'); newline != std::string_view::npos;
       newline = source.text.find('\n', newline + 1))
    source.lineStarts.push_back(static_cast<std::uint32_t>(newline + 1));
  const Parsed parsed = parseRay(*this, source.text, source.base, nodes_);
  hasKeys_ |= parsed.hasKeys;
  usesLanguage_ |= parsed.usesLanguage;
  for (const Parsed::Slip& slip : parsed.slips)
    remark({slip.offset, "expected a number, found \"" + slip.text + "\": it is read as " + slip.readAs, ""});
}

const Syntax::Source& Syntax::includedSource(std::size_t offset) const {
  const auto after = std::upper_bound(sources_.begin(), sources_.end(), offset,
                                      [](std::size_t at, const Source& source) { return at < source.base; });
  return *(after - 1);
}

bool Syntax::isOfKind() const {
  return nodes_.size() > 1 && nodes_[1].kind == Kind::word && sameWord(textOf(nodes_[1]), kKind);
}

Item Syntax::root() const { return {*this, 0}; }

std::optional<Item> Syntax::itemAt(std::size_t offset) const {
  if (byOffset_.empty()) {  // loops and names give the nodes another order
    byOffset_.resize(nodes_.size() - 1);
    std::iota(byOffset_.begin(), byOffset_.end(), 1u);
    std::stable_sort(byOffset_.begin(), byOffset_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return nodes_[a].offset < nodes_[b].offset; });
  }
  const auto found =
      std::lower_bound(byOffset_.begin(), byOffset_.end(), offset,
                       [&](std::uint32_t node, std::size_t at) { return nodes_[node].offset < at; });
  if (found == byOffset_.end() || nodes_[*found].offset != offset) return {};
  return Item(*this, *found);
}

Syntax::Line Syntax::line(const Source& source, std::size_t at) {
  const auto after = std::upper_bound(source.lineStarts.begin(), source.lineStarts.end(), at);
  std::size_t end = after == source.lineStarts.end() ? source.text.size() : *after - 1;
  const std::size_t start = *(after - 1);
  if (end > start && source.text[end - 1] == '\r') --end;
  return {static_cast<std::size_t>(after - source.lineStarts.begin()), start, end};
}

void Syntax::note(Mistake mistake) {
  constexpr std::size_t kMostTimes = 1000;
  for (Mistake& other : mistakes_) {
    if (other.offset != mistake.offset || other.what != mistake.what) continue;
    if (++other.times == kMostTimes) throwMistakes();
    return;
  }
  mistakes_.push_back(std::move(mistake));
  if (mistakes_.size() == Messages::kMostErrors) throwMistakes();
}

void Syntax::throwMistakes() const {
  if (mistakes_.empty()) return;
  std::vector<Mistake> sorted = mistakes_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Mistake& a, const Mistake& b) { return a.offset < b.offset; });
  std::vector<Message> messages;
  for (Mistake& mistake : sorted)
    messages.push_back(
        {Message::Severity::error, place(mistake.offset), std::move(mistake.what), std::move(mistake.hint)});
  throw Error(Fault::scene, std::move(messages));
}

SourcePlace Syntax::place(std::size_t offset) const { return place(offset, std::string_view::npos); }

SourcePlace Syntax::shortPlace(std::size_t offset) const {
  constexpr std::size_t kLongLine = 200;
  return place(offset, kLongLine);
}

SourcePlace Syntax::place(std::size_t offset, std::size_t longestLine) const {
  const Source& source = sourceOf(offset);
  const std::size_t at = offset - source.base;
  const Line on = line(source, at);
  const bool isLong = on.end - on.start > longestLine;
  return {source.name, static_cast<int>(on.number), static_cast<int>(at - on.start) + 1,
          std::string(isLong ? std::string_view() : source.text.substr(on.start, on.end - on.start))};
}

std::string Syntax::chain(std::uint32_t node) const {
  constexpr int kMostFrames = 8;
  std::string text;
  int count = 0;
  auto after = std::upper_bound(frames_.begin(), frames_.end(), node,
                                [](std::uint32_t at, const Frame& frame) { return at < frame.first; });
  while (after != frames_.begin() && count < kMostFrames) {
    const Frame& frame = *--after;
    if (node >= frame.end) continue;
    text += (text.empty() ? "in " : ", in ") + frame.what + " at " + placeText(place(frame.offset));
    ++count;
  }
  return text;
}

std::string describe(const Item& item) {
  const std::string_view text = item.source();
  if (text.size() <= 40 && text.find('\n') == std::string_view::npos)
    return item.is(Kind::word) ? quoted(item.text()) : std::string(text);
  switch (item.kind()) {
    case Kind::number: return "a number of " + std::to_string(text.size()) + " characters";
    case Kind::word: return quoted(text.substr(0, 37)) + "...";
    case Kind::tuple: return "a list of " + std::to_string(item.count());
    case Kind::block: return "{ ... }";
    case Kind::entry: return std::string(item.key().substr(0, 40)) + " = ...";
    case Kind::call:
      return std::string(item.key().substr(0, 40)) + (item.value().is(Kind::tuple) ? "( ... )" : " { ... }");
    default: return quoted(text.substr(0, 37)) + "...";
  }
  return {};
}

}  // namespace trace::rayfile

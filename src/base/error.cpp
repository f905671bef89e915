#include "base/error.h"

#include <algorithm>
#include <utility>

#include "base/printable.h"

namespace trace {
namespace {

/// The line of the file with a caret under the column, shortened to a window around it.
std::string excerpt(const SourcePlace& place) {
  constexpr size_t kWindow = 100;
  std::string line = place.text;
  size_t column = place.column > 0 ? static_cast<size_t>(place.column - 1) : 0;
  column = std::min(column, line.size());
  if (line.size() > kWindow) {
    const size_t start = column > kWindow / 2 ? column - kWindow / 2 : 0;
    line = line.substr(start, kWindow);
    column -= start;
  }
  std::string caret;
  for (size_t i = 0; i < column; ++i) caret += line[i] == '\t' ? '\t' : ' ';
  std::string shown = printableInPlace(line);
  for (size_t i = 0; i < line.size(); ++i)
    if (line[i] == '\t') shown[i] = '\t';
  std::string text = "  ";
  text.append(shown).append("\n  ").append(caret).append("^\n");
  return text;
}

std::string joined(const std::vector<Message>& messages) {
  std::string text;
  for (const Message& message : messages) text += toString(message);
  return text;
}

}  // namespace

std::string placeText(const SourcePlace& place) {
  std::string text = place.file;
  if (place.line > 0) text += ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
  return text;
}

std::string toString(const Message& message) {
  std::string text;
  const SourcePlace& place = message.place;
  if (!place.file.empty()) text += printable(placeText(place)) + ": ";
  text += message.severity == Message::Severity::error ? "error: " : "warning: ";
  text += printable(message.what) + "\n";
  if (!place.text.empty()) text += excerpt(place);
  if (!message.hint.empty()) text += "  hint: " + printable(message.hint) + "\n";
  return text;
}

Error::Error(Fault fault, std::string what, std::string hint)
    : Error(fault, SourcePlace{}, std::move(what), std::move(hint)) {}

Error::Error(Fault fault, SourcePlace place, std::string what, std::string hint)
    : Error(fault, std::vector<Message>{
                       {Message::Severity::error, std::move(place), std::move(what), std::move(hint)}}) {}

Error::Error(Fault fault, std::vector<Message> messages)
    : fault_(fault), messages_(std::move(messages)), text_(joined(messages_)) {}

void Messages::warn(SourcePlace place, std::string what, std::string hint) {
  messages_.push_back({Message::Severity::warning, std::move(place), std::move(what), std::move(hint)});
}

void Messages::error(SourcePlace place, std::string what, std::string hint) {
  messages_.push_back({Message::Severity::error, std::move(place), std::move(what), std::move(hint)});
  if (++errors_ >= kMostErrors) throwIfFailed();
}

void Messages::throwIfFailed(bool strict) const {
  if (errors_ == 0 && !(strict && !messages_.empty())) return;
  std::vector<Message> failed;
  for (Message message : messages_) {
    if (strict) message.severity = Message::Severity::error;
    if (message.severity == Message::Severity::error) failed.push_back(std::move(message));
  }
  throw Error(Fault::scene, std::move(failed));
}

}  // namespace trace

#include "formats/ray/read/settings.h"

#include <algorithm>
#include <optional>
#include <string>

#include "base/text.h"
#include "formats/ray/read/fields.h"
#include "scene/options.h"

namespace trace::rayfile {
namespace {

/// As on the command line: `(0, 0, 8, 8)` is 0,0,8,8.
std::string choiceText(const Item& value) {
  if (value.is(Kind::word)) return std::string(value.text());
  if (value.is(Kind::number) && !isLiteral(value)) return toText(value.number());
  if (!value.is(Kind::tuple)) return std::string(value.source());
  std::string text;
  for (const Item item : value) text += (text.empty() ? "" : ",") + choiceText(item);
  return text;
}

void choice(Findings& findings, const Item& item) {
  const Choice choice{std::string(item.key()), choiceText(item.value()),
                      findings.syntax().shortPlace(item.offset())};
  Item wrong = item;
  try {
    Settings scratch;
    const Option& option = findOption(choice.option);
    wrong = item.value();
    option.assign(scratch, choice.value);
    findings.scene().choices.push_back(choice);
  } catch (const Error& error) {
    const Message& message = error.messages().front();
    const std::string_view what = message.what;
    findings.error(wrong, std::string(what.starts_with("--") ? what.substr(2) : what), message.hint);
  }
}

}  // namespace

void readSettings(Findings& findings, const Item& call) {
  const std::optional<Item> block = blockOf(findings, call);
  if (!block) return;
  RepeatedFields repeats(findings, kSettings);
  for (const Item item : *block) {
    if (!isField(findings, item, kSettings)) continue;
    repeats.note(item);
    choice(findings, item);
  }
}

std::string writtenChoice(const std::string& value) {
  const std::optional<ParsedNumber> number = parseNumber(value);
  if (number && number->length == value.size()) return value;
  const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const bool word =
      !value.empty() && isLetter(value[0]) && std::all_of(value.begin(), value.end(), [&](char c) {
        return isLetter(c) || c == '-' || c == '_' || (c >= '0' && c <= '9');
      });
  return word ? value : exactly(value);
}

}  // namespace trace::rayfile

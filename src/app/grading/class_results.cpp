// After the head come records: sixteen digits of the key, then the record as a field. A field is its length,
// a colon and its bytes, and the fields of a record follow one another.
#include "app/grading/class_results.h"

#include <filesystem>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/hash.h"
#include "base/text.h"

namespace trace {
namespace {

constexpr std::string_view kResultsHead = "Trace results of a class 2\n";

void appendField(std::string& to, std::string_view field) {
  to += std::to_string(field.size()) + ":";
  to += field;
}

/// Takes fields from the front; `sound` becomes false where the bytes are no field.
struct FieldReader {
  std::string_view rest;
  bool sound = true;

  std::string_view text() {
    const std::size_t colon = rest.find(':');
    const auto size = parseNumber(rest.substr(0, colon));
    sound = sound && colon != rest.npos && size && size->length == colon && size->value >= 0 &&
            size->value <= static_cast<double>(rest.size() - colon - 1);
    if (!sound) return {};
    const std::string_view field = rest.substr(colon + 1, static_cast<std::size_t>(size->value));
    rest.remove_prefix(colon + 1 + field.size());
    return field;
  }
  double number() {
    const std::string_view field = text();
    const auto value = parseNumber(field);
    sound = sound && value && value->length == field.size();
    return sound ? value->value : 0;
  }
  std::size_t count() {
    const double value = number();
    sound = sound && value >= 0 && value < 1000;
    return sound ? static_cast<std::size_t>(value) : 0;
  }
};

std::string recordOf(const GradedPair& pair) {
  std::string bytes;
  appendField(bytes, toText(static_cast<int>(pair.verdict)));
  for (const std::string* text :
       {&pair.problem, &pair.cause, &pair.unit, &pair.testPicture, &pair.heatPicture})
    appendField(bytes, *text);
  appendField(bytes, toText(pair.width));
  appendField(bytes, toText(pair.height));
  appendField(bytes, toText(pair.cpu));
  appendField(bytes, toText(pair.ourCpu));
  appendField(bytes, std::to_string(pair.mistakes.size()));
  for (const std::string& mistake : pair.mistakes) appendField(bytes, mistake);
  appendField(bytes, std::to_string(pair.values.size()));
  for (double value : pair.values) appendField(bytes, toText(value));
  return bytes;
}

bool fillFrom(std::string_view bytes, GradedPair& pair) {
  FieldReader reader{bytes};
  const std::size_t verdict = reader.count();
  if (verdict > static_cast<std::size_t>(Verdict::identical)) return false;
  pair.verdict = static_cast<Verdict>(verdict);
  for (std::string* text : {&pair.problem, &pair.cause, &pair.unit, &pair.testPicture, &pair.heatPicture})
    *text = reader.text();
  pair.width = static_cast<int>(reader.number());
  pair.height = static_cast<int>(reader.number());
  pair.cpu = reader.number();
  pair.ourCpu = reader.number();
  pair.mistakes.clear();
  for (std::size_t i = reader.count(); i > 0 && reader.sound; --i) pair.mistakes.emplace_back(reader.text());
  pair.values.clear();
  const std::size_t values = reader.count();
  for (std::size_t i = 0; i < values && reader.sound; ++i) pair.values.push_back(reader.number());
  return reader.sound && (values == 0 || values == metrics().size());
}

}  // namespace

ClassResults::ClassResults(std::string file) : file_(std::move(file)) {
  if (file_.empty() || !std::filesystem::exists(file_)) return;
  const std::string bytes = readFile(file_);
  if (!bytes.starts_with(kResultsHead.substr(0, kResultsHead.find(" class"))))
    throw Error(Fault::io, "\"" + file_ + "\" is in the way: it holds no results of a class",
                "move it, or choose another name for the page");
  if (!bytes.starts_with(kResultsHead)) return;
  constexpr std::size_t kDigits = 16;
  FieldReader reader{std::string_view(bytes).substr(kResultsHead.size())};
  while (!reader.rest.empty()) {
    const std::string key(reader.rest.substr(0, kDigits));
    if (key.size() < kDigits || key.find_first_not_of("0123456789abcdef") != key.npos) return;
    reader.rest.remove_prefix(kDigits);
    const std::string_view record = reader.text();
    if (!reader.sound) return;
    records_[std::stoull(key, nullptr, 16)] = {std::string(record), false};
  }
}

bool ClassResults::find(std::uint64_t key, GradedPair& pair) const {
  const auto found = records_.find(key);
  if (found == records_.end()) return false;
  GradedPair filled = pair;
  if (!fillFrom(found->second.bytes, filled)) return false;
  found->second.used = true;
  pair = std::move(filled);
  return true;
}

void ClassResults::add(std::uint64_t key, const GradedPair& pair) { records_[key] = {recordOf(pair), true}; }

void ClassResults::save(bool onlyUsed) {
  if (file_.empty()) return;
  std::string bytes(kResultsHead);
  for (const auto& [key, record] : records_) {
    if (onlyUsed && !record.used) continue;
    bytes += hexText(key);
    appendField(bytes, record.bytes);
  }
  writeFile(file_, bytes);
}

}  // namespace trace

#include "app/grading/rubric.h"

#include <algorithm>
#include <cmath>

#include "app/compare/grade.h"
#include "base/files/file.h"
#include "base/text.h"

namespace trace {
namespace {

constexpr std::string_view kMistakeNames[] = {"flipped", "channels", "gamma", "brightness", "shift"};
constexpr std::string_view kRowKinds[] = {"scene", "cause", "metric"};

bool fitsPattern(std::string_view pattern, std::string_view name) {
  if (pattern.empty()) return name.empty();
  if (pattern[0] != '*')
    return !name.empty() && pattern[0] == name[0] && fitsPattern(pattern.substr(1), name.substr(1));
  for (std::size_t taken = 0; taken <= name.size(); ++taken)
    if (fitsPattern(pattern.substr(1), name.substr(taken))) return true;
  return false;
}

/// Reads rows of words; # begins a comment.
class RubricReader {
 public:
  RubricReader(const std::string& file, std::string_view text) : file_(file), text_(text) {}

  Rubric read() {
    for (std::size_t at = 0; at < text_.size();) {
      const std::size_t end = std::min(text_.find('\n', at), text_.size());
      try {
        readRow(at, std::min(text_.substr(0, end).find('#', at), end));
      } catch (const Error& error) {
        const Message& message = error.messages().front();
        messages_.error(message.place, message.what, message.hint);
      }
      at = end + 1;
    }
    messages_.throwIfFailed();
    return std::move(rubric_);
  }

 private:
  struct Word {
    std::size_t at;
    std::string_view text;
  };

  [[noreturn]] void fail(std::size_t at, const std::string& expected, std::string_view found,
                         const std::string& hint = {}) const {
    throw Error(Fault::scene, placeAt(file_, text_, at),
                "expected " + expected + ", found " +
                    (found.empty() ? std::string("the end of the line") : "\"" + std::string(found) + "\""),
                hint);
  }

  void readRow(std::size_t begin, std::size_t end) {
    constexpr std::string_view kSpace = " \t\r";
    std::vector<Word> words;
    for (std::size_t at = begin; at < end;) {
      at = text_.find_first_not_of(kSpace, at);
      if (at == text_.npos || at >= end) break;
      const std::size_t stop = std::min(text_.find_first_of(kSpace, at), end);
      words.push_back({at, text_.substr(at, stop - at)});
      at = stop;
    }
    if (words.empty()) return;
    const auto word = [&](std::size_t i) { return i < words.size() ? words[i] : Word{end, {}}; };
    const std::string_view kind = words[0].text;
    std::size_t count = 3;
    if (kind == "scene") {
      if (word(1).text.empty()) fail(word(1).at, "the name of a scene", {});
      rubric_.scenes.push_back(
          {std::string(word(1).text), number(word(2)), placeAt(file_, text_, word(1).at)});
    } else if (kind == "cause") {
      const auto name = std::find(std::begin(kMistakeNames), std::end(kMistakeNames), word(1).text);
      if (name == std::end(kMistakeNames))
        fail(word(1).at, "flipped, channels, gamma, brightness or shift", word(1).text,
             didYouMean(word(1).text, kMistakeNames));
      rubric_.mistakes.emplace_back(*name, share(word(2)));
    } else if (kind == "metric") {
      try {
        findMetric(word(1).text);
      } catch (const Error& error) {
        throw Error(Fault::scene, placeAt(file_, text_, word(1).at), error.messages().front().what,
                    error.messages().front().hint);
      }
      const double value = number(word(2));
      rubric_.steps.push_back({std::string(word(1).text), value, share(word(3))});
      count = 4;
    } else {
      fail(words[0].at, "scene, cause or metric", kind, didYouMean(kind, kRowKinds));
    }
    if (words.size() > count) fail(words[count].at, "the end of the line", words[count].text);
  }

  double number(const Word& word, std::string_view suffix = {}) const {
    const auto read = parseNumber(word.text);
    if (!read || !std::isfinite(read->value) || read->value < 0 || word.text.substr(read->length) != suffix)
      fail(word.at, suffix.empty() ? "a number from 0 on" : "a share, such as 80%", word.text);
    return read->value;
  }

  double share(const Word& word) const {
    const double percent = number(word, "%");
    if (percent > 100) fail(word.at, "a share from 0% to 100%", word.text);
    return percent / 100;
  }

  const std::string& file_;
  std::string_view text_;
  Rubric rubric_;
  Messages messages_;
};

}  // namespace

std::vector<std::string_view> mistakeNames() { return {std::begin(kMistakeNames), std::end(kMistakeNames)}; }

void Rubric::checkScenes(const std::vector<std::string>& names) const {
  const std::vector<std::string_view> known(names.begin(), names.end());
  Messages messages;
  for (const SceneRow& row : scenes)
    if (std::none_of(names.begin(), names.end(),
                     [&](const std::string& name) { return fitsPattern(row.pattern, name); }))
      messages.error(
          row.place,
          "expected the name of a reference picture without its suffix, found \"" + row.pattern + "\"",
          didYouMean(row.pattern, known));
  messages.throwIfFailed();
}

double Rubric::pointsOf(std::string_view scene) const {
  for (const SceneRow& row : scenes)
    if (fitsPattern(row.pattern, scene)) return row.points;
  return 1;
}

double Rubric::shareOf(const GradedPair& pair) const {
  if (passes(pair.verdict)) return 1;
  double best = 0, all = pair.mistakes.empty() ? 0 : 1;
  for (const std::string& mistake : pair.mistakes) {
    const auto row = std::find_if(mistakes.begin(), mistakes.end(),
                                  [&](const auto& named) { return named.first == mistake; });
    all *= row == mistakes.end() ? 0 : row->second;
  }
  for (const Step& step : steps) {
    const Metric& metric = findMetric(step.metric);
    if (pair.values.empty()) break;
    const double value = pair.values[static_cast<std::size_t>(&metric - metrics().data())];
    if (metric.higherIsBetter ? value >= step.value : value <= step.value) best = std::max(best, step.share);
  }
  return std::max(best, all);
}

Rubric readRubric(const std::string& file) {
  const std::string text = readFile(file);
  return RubricReader(file, text).read();
}

}  // namespace trace

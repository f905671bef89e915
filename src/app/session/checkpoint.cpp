#include "app/session/checkpoint.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>

#include "app/session/output.h"
#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/text.h"
#include "render/samples/sampler.h"
#include "scene/options.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBegin = "Trace checkpoint 1\n", kProgramLine = "Program: ";

/// The settings that decide about the film: all options but those that are applied to it later.
std::string identityOf(const Metadata& metadata, const Settings& settings, const std::string& program) {
  std::string text = std::string(kProgramLine) + program + "\n";
  for (const auto& [key, value] : metadata)
    if (key == "Software" || key == "Scene") text += key + ": " + value + "\n";
  text += "Settings:";
  const bool continues = generatorOf(settings).continues;
  for (const Choice& choice : changedOptions(settings)) {
    const Option& option = findOption(choice.option);
    const bool later = option.repeats == Repeats::nothing || option.repeats == Repeats::tone;
    if (later || option.group == "Resources" || (continues && choice.option == "spp")) continue;
    text += " " + choice.option + "=" + choice.value;
  }
  return text + "\n";
}

/// The lines before the film.
struct Head {
  std::string identity;
  std::int64_t done = 0;   ///< samples of tiles
  std::string hash;        ///< hash of the film
  std::size_t length = 0;  ///< length of these lines, in bytes
};

/// Digits alone.
std::optional<std::int64_t> countIn(std::string_view text) {
  std::int64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 0) return {};
  return count;
}

/// Nothing of a file that is no checkpoint.
std::optional<Head> headOf(const std::string& path) {
  constexpr std::size_t kLongest = 1 << 20;  // longest of lines that say of which picture it is
  if (!isOrdinaryFile(path)) return {};      // a pipe might never answer
  std::ifstream file(path, std::ios::binary);
  std::string begin(kLongest, '\0');
  begin.resize(static_cast<std::size_t>(file.read(begin.data(), kLongest).gcount()));
  if (!begin.starts_with(kBegin)) return {};
  Head head;
  head.length = kBegin.size();
  std::optional<std::int64_t> done;
  for (std::size_t end; (end = begin.find('\n', head.length)) != begin.npos;) {
    const std::string line = begin.substr(head.length, end - head.length);
    head.length = end + 1;
    if (done) {
      if (!line.starts_with("Hash: ")) return {};
      head.done = *done;
      head.hash = line.substr(6);
      return head;
    }
    if (!line.starts_with("Done: ")) {
      head.identity += line + "\n";
      continue;
    }
    done = countIn(std::string_view(line).substr(6));
    if (!done) return {};
  }
  return {};
}

std::string hashOf(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hexText(hash.value());
}

std::string checkpointName(const std::string& picture, int number) {
  return picture + ".checkpoint" + (number == 1 ? "" : "-" + std::to_string(number));
}

/// The lines of an identity by what stands before their colons, and the words of its settings by their names.
std::map<std::string, std::string> partsOf(const std::string& identity) {
  std::map<std::string, std::string> parts;
  std::istringstream lines(identity);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t colon = std::min(line.find(':'), line.size());
    const std::string key = line.substr(0, colon);
    if (key != "Settings") {
      parts[key] = line;
      continue;
    }
    std::istringstream words(line.substr(std::min(colon + 1, line.size())));
    for (std::string word; words >> word;) parts["--" + word.substr(0, word.find('='))] = word;
  }
  return parts;
}

/// The options in which two pictures differ.
struct Difference {
  std::string what;      ///< for a person
  std::size_t size = 0;  ///< how far they are apart
};
Difference differenceOf(const std::string& a, const std::string& b) {
  auto one = partsOf(a), other = partsOf(b);
  constexpr std::size_t kFar = 1000;
  if (one["Software"] != other["Software"]) return {"another version of Trace wrote it", kFar + 2};
  if (const std::string its = one["Program"], ours = other["Program"]; its != ours)
    return {"another build of Trace wrote it (" + its.substr(std::min(its.size(), kProgramLine.size())) +
                "; this one is " + ours.substr(std::min(ours.size(), kProgramLine.size())) + ")",
            kFar + 1};
  if (one["Scene"] != other["Scene"]) return {"the scene has changed", kFar};
  std::set<std::string> names;
  for (const auto& parts : {one, other})
    for (const auto& [name, value] : parts)
      if (one[name] != other[name]) names.insert(name);
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  list += names.size() == 1 ? " differs" : " differ";
  if (names == std::set<std::string>{"--noise-target"})
    list +=
        " (pixels that had settled for the one were given no more samples, and for the other they may need "
        "them)";
  return {list, names.size()};
}

/// A file does not fit.
struct Misfit {
  std::string why;
  std::size_t distance = 0;  ///< how much less it is worth to tell of it
  bool damaged = false;
};

/// Throws Misfit, or what restoring throws.
void fill(Film& film, const std::string& path, const std::string& identity) {
  const std::optional<Head> head = headOf(path);
  if (!head) throw Misfit{"it is no checkpoint that this version of Trace wrote"};
  if (head->identity != identity) {
    const Difference other = differenceOf(head->identity, identity);
    throw Misfit{"it is of another picture: " + other.what, other.size};
  }
  const std::string bytes = readFile(path);
  const std::string_view state = std::string_view(bytes).substr(std::min(head->length, bytes.size()));
  if (hashOf(state) != head->hash) throw Misfit{.why = "it is damaged", .damaged = true};
  try {
    film.restore(state);
  } catch (const TooManySamples&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw Misfit{.why = std::string("it is damaged: ") + error.what(), .damaged = true};
  }
  if (head->done <= film.samplesDone()) return;
  film.clear();  // nobody would ever be ahead of it
  throw Misfit{.why = "it is damaged: it has fewer samples than it says", .damaged = true};
}

}  // namespace

Checkpoint::Checkpoint(const std::string& picture, const Metadata& metadata, const Settings& settings,
                       const std::string& program)
    : picture_(picture), identity_(identityOf(metadata, settings, program)) {}

bool Checkpoint::load(Film& film) {
  const std::vector<std::string> lying = all();
  std::optional<Misfit> nearest;
  for (const std::string& path : lying) {
    const auto note = [&](Misfit misfit) {
      if (nearest && nearest->distance <= misfit.distance) return;
      nearest = misfit;
      whyNot_ = path + ": " + misfit.why;
    };
    try {
      fill(film, path, identity_);
      path_ = path;
      return true;
    } catch (const Misfit& misfit) {
      if (misfit.damaged) damaged_.insert(path);
      note(misfit);
    } catch (const Error& error) {
      note({error.messages().front().what});
    } catch (const std::runtime_error& error) {
      note({error.what()});
    } catch (const std::bad_alloc&) {
      note({"there is not enough memory to read it"});
    }
  }
  if (const std::size_t others = lying.size(); others > 1)
    whyNot_ += "; " + counted(others - 1, "other") + (others == 2 ? " lies" : " lie") + " there, too";
  return false;
}

void Checkpoint::save(const Film& film) {
  const std::int64_t done = film.samplesDone();
  std::error_code ignored;
  for (int number = 1; path_.empty() || fs::exists(path_, ignored); ++number) {
    const std::optional<Head> head = path_.empty() ? std::nullopt : headOf(path_);
    const bool ours = head && head->identity == identity_ && !damaged_.contains(path_);
    if (ours && head->done >= done) return;  // another process is ahead
    if (ours) break;
    path_ = checkpointName(picture_, number);
  }
  const std::string state = film.saved();
  writeFile(path_, std::string(kBegin) + identity_ + "Done: " + std::to_string(done) +
                       "\nHash: " + hashOf(state) + "\n" + state);
}

bool Checkpoint::exists() const {
  const std::vector<std::string> lying = all();
  return std::any_of(lying.begin(), lying.end(), [&](const std::string& path) { return isOurs(path); });
}

std::vector<std::string> Checkpoint::others() const {
  std::vector<std::string> lying = all();
  std::erase_if(lying, [&](const std::string& path) { return isOurs(path); });
  return lying;
}

void Checkpoint::remove(const Film& film) {
  std::error_code ignored;
  for (const std::string& path : all()) {
    const std::optional<Head> head = headOf(path);
    if (head && head->identity == identity_ && head->done <= film.samplesDone()) fs::remove(path, ignored);
  }
}

bool Checkpoint::isOurs(const std::string& path) const {
  const auto head = headOf(path);
  return head && head->identity == identity_;
}

std::vector<std::string> Checkpoint::all() const {
  const std::string first = checkpointName(picture_, 1), name = fs::path(first).filename().string();
  std::set<int> numbers;  // some may have been taken away in between
  std::error_code error;
  const fs::path folder = fs::path(first).parent_path();
  fs::directory_iterator files(folder.empty() ? fs::path(".") : folder, error), end;
  for (; !error && files != end; files.increment(error)) {
    const std::string file = files->path().filename().string();
    if (file == name) numbers.insert(1);
    if (!file.starts_with(name + "-")) continue;
    const std::string digits = file.substr(name.size() + 1);
    const auto number = parseNumber(digits);
    if (number && number->length == digits.size() && number->value >= 2 && number->value < 1e6 &&
        checkpointName(name, static_cast<int>(number->value)).ends_with("-" + digits))
      numbers.insert(static_cast<int>(number->value));
  }
  std::vector<std::string> paths;
  for (const int number : numbers) paths.push_back(checkpointName(picture_, number));
  return paths;
}

}  // namespace trace

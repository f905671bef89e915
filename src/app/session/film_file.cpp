#include "app/session/film_file.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "base/error.h"
#include "base/files/file.h"
#include "base/hash.h"
#include "render/samples/sampler.h"
#include "scene/options.h"

namespace trace {
namespace {

constexpr std::string_view kFilmBegin = "Trace checkpoint 1\n", kProgramLine = "Program: ";

/// Digits alone.
std::optional<std::int64_t> countIn(std::string_view text) {
  std::int64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 0) return {};
  return count;
}

std::string hashOf(std::string_view bytes) {
  Hash hash;
  hash.add(bytes);
  return hexText(hash.value());
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

}  // namespace

std::string filmIdentity(const Metadata& metadata, const Settings& settings, const std::string& program,
                         const TileShare& share) {
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
  text += "\n";
  if (share.count > 1)
    text += "Part: " + std::to_string(share.number + 1) + " of " + std::to_string(share.count) + "\n";
  return text;
}

std::optional<FilmHead> filmHead(const std::string& path) {
  constexpr std::size_t kLongest = 1 << 20;  // longest of lines that say of which picture it is
  if (!isOrdinaryFile(path)) return {};      // a pipe might never answer
  std::ifstream file(std::filesystem::path(path), std::ios::binary);
  std::string begin(kLongest, '\0');
  begin.resize(static_cast<std::size_t>(file.read(begin.data(), kLongest).gcount()));
  if (!begin.starts_with(kFilmBegin)) return {};
  FilmHead head;
  head.length = kFilmBegin.size();
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

std::optional<std::string> filmBytes(const std::string& path, const FilmHead& head) {
  std::string bytes = readFile(path);
  bytes.erase(0, head.length);
  if (hashOf(bytes) != head.hash) return {};
  return bytes;
}

void writeFilm(const std::string& path, const std::string& identity, const Film& film) {
  const std::int64_t done = film.samplesDone();  // before others add more
  const std::string state = film.saved();
  writeFile(path, std::string(kFilmBegin) + identity + "Done: " + std::to_string(done) +
                      "\nHash: " + hashOf(state) + "\n" + state);
}

void mergePart(Film& film, const std::string& path, const std::string& identity, const TileShare& share) {
  const auto refuse = [&](const std::string& why, const std::string& hint) {
    return Error(Fault::io, SourcePlace{.file = path}, why, hint);
  };
  const std::string again = "remove it, and render this part again";
  const std::optional<FilmHead> head = filmHead(path);
  if (!head) throw refuse("this is no part of a picture that this version of Trace wrote", again);
  if (head->identity != identity)
    throw refuse("this is of another picture or part: " + differenceOf(head->identity, identity).what, "");
  const std::optional<std::string> bytes = filmBytes(path, *head);
  if (!bytes) throw refuse("this part of a picture is damaged: its bytes have changed", again);
  try {
    film.merge(*bytes, share);
  } catch (const std::runtime_error& error) {
    throw refuse(std::string("this part does not fit: ") + error.what(), again);
  }
}

IdentityDifference differenceOf(const std::string& its, const std::string& ours) {
  auto one = partsOf(its), other = partsOf(ours);
  constexpr std::size_t kFar = 1000;
  if (one["Software"] != other["Software"]) return {"another version of Trace wrote it", kFar + 2};
  if (const std::string theirs = one["Program"], own = other["Program"]; theirs != own)
    return {"another build of Trace wrote it (" +
                theirs.substr(std::min(theirs.size(), kProgramLine.size())) + "; this one is " +
                own.substr(std::min(own.size(), kProgramLine.size())) + ")",
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
    list += " (pixels that reached the one target took no more samples, and may need them for the other)";
  return {list, names.size()};
}

}  // namespace trace

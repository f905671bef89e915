#include "app/session/checkpoint.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
#include <stdexcept>

#include "app/session/film_file.h"
#include "base/error.h"
#include "base/text.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

std::string checkpointName(const std::string& picture, int number) {
  return picture + ".checkpoint" + (number == 1 ? "" : "-" + std::to_string(number));
}

/// A file does not fit.
struct Misfit {
  std::string why;
  std::size_t distance = 0;  ///< how much less it is worth to tell of it
  bool damaged = false;
};

/// Throws Misfit, or what restoring throws.
void fill(Film& film, const std::string& path, const std::string& identity) {
  const std::optional<FilmHead> head = filmHead(path);
  if (!head) throw Misfit{"it is no checkpoint that this version of Trace wrote"};
  if (head->identity != identity) {
    const IdentityDifference other = differenceOf(head->identity, identity);
    throw Misfit{"it is of another picture: " + other.what, other.size};
  }
  const std::optional<std::string> state = filmBytes(path, *head);
  if (!state) throw Misfit{.why = "it is damaged", .damaged = true};
  try {
    film.restore(*state);
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
                       const std::string& program, const TileShare& share)
    : picture_(picture), identity_(filmIdentity(metadata, settings, program, share)) {}

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
    const std::optional<FilmHead> head = path_.empty() ? std::nullopt : filmHead(path_);
    const bool ours = head && head->identity == identity_ && !damaged_.contains(path_);
    if (ours && head->done >= done) return;  // another process is ahead
    if (ours) break;
    path_ = checkpointName(picture_, number);
  }
  writeFilm(path_, identity_, film);
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
    const std::optional<FilmHead> head = filmHead(path);
    if (head && head->identity == identity_ && head->done <= film.samplesDone()) fs::remove(path, ignored);
  }
}

bool Checkpoint::isOurs(const std::string& path) const {
  const auto head = filmHead(path);
  return head && head->identity == identity_;
}

std::vector<std::string> Checkpoint::all() const {
  const std::string first = checkpointName(picture_, 1), name = fs::path(first).filename().generic_string();
  std::set<int> numbers;  // some may have been taken away in between
  std::error_code error;
  const fs::path folder = fs::path(first).parent_path();
  fs::directory_iterator files(folder.empty() ? fs::path(".") : folder, error), end;
  for (; !error && files != end; files.increment(error)) {
    const std::string file = files->path().filename().generic_string();
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

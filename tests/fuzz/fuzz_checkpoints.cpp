// Fuzz target: any bytes as the film of a checkpoint, or as a whole checkpoint, with the hash that they need:
// a forger would write it, and without it no fuzzer comes further. Whatever they are, the film is refused, or
// can be looked at, rendered to its end and saved. The first byte says which film (support/films.h), and
// whether the rest is all of a file.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "app/session/checkpoint.h"
#include "base/files/file.h"
#include "base/hash.h"
#include "support/films.h"

namespace {

using namespace trace;

constexpr std::uint8_t kWholeFile = 0x80;

const std::string& picture() {
  static const std::string& path = *new std::string([] {  // lives until the folder is gone
    std::string folder = (std::filesystem::temp_directory_path() / "fuzz-XXXXXX").string();
    if (!mkdtemp(folder.data())) std::abort();
    std::atexit([] { std::filesystem::remove_all(std::filesystem::path(picture()).parent_path()); });
    return folder + "/out.png";
  }());
  return path;
}
Checkpoint checkpoint() { return Checkpoint(picture(), {}, {}, "fuzz"); }

/// The checkpoint of a film that is half rendered.
const std::string& sample(int kind) {
  static std::string samples[test::kFilmKinds];
  std::string& bytes = samples[kind];
  if (!bytes.empty()) return bytes;
  Film film = test::blankFilm(kind);
  test::renderPart(film, 3);
  checkpoint().save(film);
  bytes = readFile(picture() + ".checkpoint");
  std::filesystem::remove(picture() + ".checkpoint");
  return bytes;
}

constexpr std::string_view kHash = "\nHash: ";
std::size_t filmAt(std::string_view file) { return file.find('\n', file.find(kHash) + 1) + 1; }

std::string repaired(const std::string& file) {
  const std::size_t line = file.find(kHash);
  if (line == file.npos || filmAt(file) == 0) return file;
  const std::string film = file.substr(filmAt(file));
  Hash hash;
  hash.add(film);
  return file.substr(0, line) + std::string(kHash) + hexText(hash.value()) + "\n" + film;
}

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// Begins with checkpoints as they are written.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  if (size < 8) {
    const int kind = static_cast<int>(seed % test::kFilmKinds);
    const bool whole = seed / test::kFilmKinds % 8 == 0;
    const std::string_view file = sample(kind), bytes = whole ? file : file.substr(filmAt(file));
    if (bytes.size() + 1 > most) return size;
    data[0] = static_cast<std::uint8_t>(kind | (whole ? kWholeFile : 0));
    bytes.copy(reinterpret_cast<char*>(data) + 1, bytes.size());
    return bytes.size() + 1;
  }
  return 1 + LLVMFuzzerMutate(data + 1, size - 1, most - 1);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const int kind = (data[0] & ~kWholeFile) % test::kFilmKinds;
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string& good = sample(kind);
  const bool whole = (data[0] & kWholeFile) != 0;
  const std::string file = repaired(whole ? bytes : good.substr(0, filmAt(good)) + bytes);
  std::ofstream(picture() + ".checkpoint", std::ios::binary) << file;
  Film film = test::blankFilm(kind);
  Checkpoint read = checkpoint();
  if (read.load(film)) {
    test::lookAtAll(film);
    test::renderRest(film);
    if (!film.complete()) std::abort();
    test::lookAtAll(film);
  } else if (film.samplesDone() != 0 || read.whyNot().empty()) {
    std::abort();
  }
  read.save(film);
  read.remove(film);
  for (const std::string& left : checkpoint().others()) std::filesystem::remove(left);
  return 0;
}

#include "formats/textures.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "base/budget.h"
#include "base/files/named_file.h"
#include "base/files/read_scope.h"
#include "base/parallel.h"
#include "image/codecs/codec.h"
#include "image/codecs/picture_name.h"
#include "scene/input_files.h"

namespace trace {
namespace {

/// A picture file of the scene, and what came of reading it.
struct Loaded {
  std::string name;   ///< as the scene has it
  SourcePlace place;  ///< where the scene names it first
  InputFiles inputs;  ///< it, read or not
  std::shared_ptr<const MipMap> map;
  std::string remark;   ///< what is odd about its name
  std::string failure;  ///< why there is no map
};

void load(const std::string& path, Loaded& loaded) {
  try {
    const std::string bytes = readBeside("", pictureName(path).file, loaded.inputs);
    loaded.map = MipMap::decode(bytes, path);
    if (const std::string remark = pictureRemark(bytes, path); !remark.empty())
      loaded.remark += (loaded.remark.empty() ? "\"" + loaded.name + "\": " : "; ") + remark;
  } catch (const ReadDenied& denied) {
    denied.at(loaded.place);
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    loaded.failure = error.messages().front().what;
  }
}

constexpr std::size_t kMostNamed = 3, kLongName = 80;
constexpr std::string_view kUnread = " cannot be read";

}  // namespace

std::shared_ptr<const MipMap> missingPicture() {
  static const auto kMissing = [] {
    Picture checker(8, 8);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) checker.at(x, y) = (x + y) % 2 ? Color(0) : Color(1, 0, 1);
    return std::make_shared<const MipMap>(std::move(checker));
  }();
  return kMissing;
}

std::string pictureFile(const std::string& from, const std::string& name) {
  return namedFile(from, pictureName(name).file).path;
}

bool loadTextures(Scene& scene, Messages& messages) {
  std::map<std::string, Loaded> byPath;
  std::vector<std::pair<const std::string, Loaded>*> files;  // in the order met
  changePixels(scene, [&](Pixels& pixels) {
    if (pixels.map || pixels.file.empty()) return;
    const PictureName name = pictureName(pixels.file);
    const NamedFile named = namedFile(scene.file, name.file);
    const auto [found, fresh] = byPath.try_emplace(name.of(named.path));
    if (!fresh) return;
    found->second.name = pixels.file;
    found->second.remark = named.remark;
    found->second.place = pixels.place.file.empty() ? SourcePlace{.file = scene.file} : pixels.place;
    files.push_back(&*found);
  });
  if (files.empty()) return true;
  const ReadScope scope = ReadScope::ofScene(scene.file);
  const Work work("reading the textures", std::ssize(files));
  Job job;
  parallelChunks(std::ssize(files), 0, job, [&](std::int64_t i, int) {
    auto& [path, loaded] = *files[static_cast<std::size_t>(i)];
    load(path, loaded);
  });

  UnusedTextures unread;
  std::string reason;  // reason of the first
  for (auto* file : files) {
    auto& [path, loaded] = *file;
    scene.inputs.note(loaded.inputs);
    if (!loaded.remark.empty()) messages.warn(loaded.place, loaded.remark);
    if (loaded.map) continue;
    loaded.map = missingPicture();
    if (unread.empty()) reason = loaded.failure;
    unread.note(loaded.name, loaded.place);
  }
  unread.reportUnread(messages, reason);
  changePixels(scene, [&](Pixels& pixels) {
    if (pixels.map || pixels.file.empty()) return;
    pixels.map = byPath.at(pictureName(pixels.file).of(pictureFile(scene.file, pixels.file))).map;
  });
  return unread.empty();
}

bool isOfUnreadTextures(const Message& warning) {
  return warning.what.starts_with("the texture") && warning.what.find(kUnread) != std::string::npos;
}

void UnusedTextures::note(std::string_view name, const SourcePlace& place, std::string_view use) {
  if (names_.empty()) place_ = place;
  if (!known_.insert(std::string(name) + '\n' + std::string(use)).second) return;
  names_.emplace_back(name.substr(0, kLongName));
  shown_.push_back('"' + names_.back() + '"' + (use.empty() ? "" : " of " + std::string(use)));
}

std::string UnusedTextures::list() const {
  const std::size_t count = names_.size();
  const std::size_t named = count <= kMostNamed + 1 ? count : kMostNamed;
  std::string list;
  for (std::size_t i = 0; i < named; ++i) {
    const bool last = i + 1 == count;
    list += (i == 0 ? "" : last ? " and " : ", ") + shown_[i];
  }
  if (named < count) list += " and " + std::to_string(count - named) + " more";
  return (count == 1 ? "the texture " : "the textures ") + list;
}

void UnusedTextures::report(Messages& messages, std::string_view instead) const {
  if (names_.empty()) return;
  messages.warn(place_, list() + (names_.size() == 1 ? " is" : " are") + " not rendered yet",
                std::string(instead) + " shows instead");
}

void UnusedTextures::reportUnread(Messages& messages, std::string_view reason) const {
  if (names_.empty()) return;
  constexpr std::string_view kAgain = "cannot read ";
  if (reason.starts_with(kAgain)) reason.remove_prefix(kAgain.size());
  std::string why = ": " + std::string(reason);
  if (const std::string name = '"' + names_.front() + '"'; names_.size() == 1 && reason.starts_with(name))
    why = reason.substr(name.size());  // ": No such file", or " as PNG: the file ends too early"
  const bool isWord = std::all_of(names_.begin(), names_.end(), [](const std::string& file) {
    return file.find_first_of("./\\") == file.npos;  // as in diffuse = "red"
  });
  messages.warn(place_, list() + std::string(kUnread) + why,
                std::string("a checker of magenta and black shows instead") +
                    (isWord ? "; a colour is (red, green, blue), each from 0 to 1" : ""));
}

}  // namespace trace

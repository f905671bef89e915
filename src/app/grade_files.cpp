#include "app/grade_files.h"

#include <algorithm>

#include "base/error.h"
#include "base/file.h"
#include "formats/format.h"
#include "image/codec.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

class Walk {
 public:
  Walk(const std::string& folder, bool (*wanted)(const fs::path&)) : folder_(folder), wanted_(wanted) {
    std::string why;
    if (!enter({}, why)) throw Error(Fault::io, "cannot read the folder \"" + folder + "\": " + why);
    std::sort(found_.files.begin(), found_.files.end());
    std::sort(found_.unreadable.begin(), found_.unreadable.end());
  }
  FolderFiles take() { return std::move(found_); }

 private:
  /// Looks at what is in a folder that is seen from the first. False, and why, if it cannot be read.
  bool enter(const fs::path& folder, std::string& why) {
    std::error_code error;
    const fs::path real = fs::canonical(folder_ / folder, error);
    if (!error) {
      if (std::find(inside_.begin(), inside_.end(), real) != inside_.end()) return true;
      inside_.push_back(real);
      for (fs::directory_iterator i(folder_ / folder, error), end; !error && i != end; i.increment(error))
        look(folder / i->path().filename());
      inside_.pop_back();
    }
    why = error.message();
    return !error;
  }

  void look(const fs::path& name) {
    std::error_code error;
    const fs::file_status status = fs::status(folder_ / name, error);
    if (fs::is_directory(status)) {
      std::string why;
      if (!enter(name, why)) found_.unreadableFolders[name] = why;
    } else if (fs::is_regular_file(status)) {
      try {
        if (wanted_(folder_ / name)) found_.files.push_back(name);
      } catch (const Error&) {
        found_.unreadable.push_back(name);
      }
    } else if (error || status.type() == fs::file_type::not_found) {  // a link that leads nowhere, for one
      found_.unreadable.push_back(name);
    }
  }

  const fs::path folder_;
  bool (*const wanted_)(const fs::path&);
  std::vector<fs::path> inside_;  ///< the folder looked at and those it is in, without links
  FolderFiles found_;
};

}  // namespace

FolderFiles filesBelow(const std::string& folder, bool (*wanted)(const fs::path&)) {
  return Walk(folder, wanted).take();
}

std::string lowerCase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

bool isPictureFile(const fs::path& file) {
  const std::string suffix = lowerCase(file.extension().string());
  for (const PictureFormat& format : pictureFormats())
    for (std::string_view known : format.suffixes)
      if (known == suffix) return true;
  return false;
}

bool isSceneFile(const fs::path& file) {
  if (isPictureFile(file)) return false;
  const std::string bytes = readFile(file.string());
  for (const SceneFormat& format : sceneFormats())
    if (format.recognises(bytes)) return true;
  return false;
}

}  // namespace trace

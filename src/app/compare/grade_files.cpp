#include "app/compare/grade_files.h"

#include <algorithm>

#include "base/budget.h"
#include "base/error.h"
#include "base/files/file.h"
#include "formats/format.h"
#include "formats/text_front.h"
#include "image/codecs/codec.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

class Walk {
 public:
  Walk(const std::string& folder, FileKind (*kindOf)(const fs::path&)) : folder_(folder), kindOf_(kindOf) {
    std::string why;
    if (!enter({}, why)) throw Error(Fault::io, "cannot read the folder \"" + folder + "\": " + why);
    for (std::vector<fs::path>* list : {&found_.files, &found_.others, &found_.noFiles})
      std::sort(list->begin(), list->end());
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
      return;
    }
    const FileKind kind = kindOf_(folder_ / name);
    if (kind == FileKind::unwanted) return;
    if (error || !fs::exists(status))  // as a link may lead nowhere
      found_.others.push_back(name);
    else if (!fs::is_regular_file(status))
      found_.noFiles.push_back(name);
    else
      (kind == FileKind::wanted ? found_.files : found_.others).push_back(name);
  }

  const fs::path folder_;
  FileKind (*const kindOf_)(const fs::path&);
  std::vector<fs::path> inside_;  ///< the folder looked at and those it is in, without links
  FolderFiles found_;
};

}  // namespace

FolderFiles filesBelow(const std::string& folder, FileKind (*kindOf)(const fs::path&)) {
  return Walk(folder, kindOf).take();
}

std::string lowerCase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

FileKind pictureKind(const fs::path& file) {
  return pictureFormatNamed(file.filename().generic_string()) ? FileKind::wanted : FileKind::unwanted;
}

bool hasSceneSuffix(const fs::path& file) {
  const std::string suffix = lowerCase(file.extension().generic_string());
  for (const SceneFormat& format : sceneFormats())
    for (std::string_view known : format.suffixes)
      if (known == suffix) return true;
  return false;
}

FileKind sceneKind(const fs::path& file) {
  if (pictureKind(file) == FileKind::wanted) return FileKind::unwanted;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return FileKind::perhaps;
  try {
    const std::string bytes = readFile(file.generic_string());
    const TextFront front(file.generic_string(), bytes);
    for (const SceneFormat& format : sceneFormats())
      if (format.recognises(front.text())) return FileKind::wanted;
  } catch (const Error&) {  // whoever reads it as a scene is told why
    lookAtBudget();
  }
  return FileKind::perhaps;
}

}  // namespace trace

#include "app/editing/typed_file.h"

#include <filesystem>

#include "base/error.h"
#include "base/files/file.h"
#include "formats/ray/syntax/names.h"

namespace trace {

namespace fs = std::filesystem;

std::string typedFile(const std::string& text, const std::string& option, const std::string& scene) {
  if (text.empty() || text == "none") return "none";
  if (!isSayable(text)) {
    const Unsayable name{text, true};
    throw Error(Fault::usage, option + ": " + name.why() + "; not taken", name.hint());
  }
  const std::string file = besideFile(scene, text);
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw Error(Fault::usage,
                option + ": expected a file, found \"" + text + "\", which does not exist; not accepted",
                "names that begin at no root count from the scene's folder");
  return file;
}

std::string shownFile(const std::string& value, const std::string& scene) {
  if (value == "none") return "";
  std::error_code error;
  const fs::path folder = fs::absolute(scene, error).parent_path().lexically_normal();
  const fs::path below = fs::absolute(value, error).lexically_normal().lexically_relative(folder);
  return error || below.empty() || *below.begin() == ".." ? value : below.generic_string();
}

}  // namespace trace

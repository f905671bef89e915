// A browser for files to open and to save.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/editing/folder.h"

namespace trace::studio {

class FileDialog {
 public:
  enum class Purpose { read, write };

  /// Starts at the file `at`, or in its folder. `chosen` is called with the file.
  void open(const std::string& title, Purpose purpose, const std::string& at,
            std::vector<std::string> suffixes, std::function<void(const std::string&)> chosen);
  bool isOpen() const { return open_; }
  /// Was Esc or Enter pressed in this frame?
  void draw(bool escape, bool entered);

 private:
  void enter(const std::string& folder);
  void choose(const std::string& name);
  void drawEntries();

  bool open_ = false, appearing_ = false, overwrite_ = false;
  bool focusName_ = false;  ///< in the next frame: Enter in the name presses the button
  Purpose purpose_ = Purpose::read;
  std::string title_, folder_, name_, problem_;
  std::string suffix_;   ///< what a name without one gets that is to be written
  std::string focused_;  ///< the row that the keyboard is at
  std::vector<std::string> suffixes_;
  std::vector<FolderEntry> entries_;
  std::function<void(const std::string&)> chosen_;
};

/// The suffixes of pictures that can be read, or written.
std::vector<std::string> pictureSuffixes(FileDialog::Purpose purpose);

}  // namespace trace::studio

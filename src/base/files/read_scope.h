// Which files may be read for a scene: those below its own folder, and those that the command line allows.
//
// A scene may come from a stranger. What it names is read only by readBeside() (base/files/file.h) and
// readNamed() (base/files/named_file.h), which ask here. The rules of the calling thread are ambient, as its
// budget is (base/budget.h): they have to reach every reader, and none can forget to hand them on.
// parallelChunks() gives them to its workers. docs/security.md states the model.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"

namespace trace {

/// A scene names a file that it may not read.
class ReadDenied : public Error {
 public:
  using Error::Error;
  /// Throws it again, with `place` if it has none.
  [[noreturn]] void at(const SourcePlace& place) const;
};

/// Paths are absolute and without links.
struct ReadRules {
  std::string root;                  ///< the scene's folder; "" while no scene is read: all may be read
  std::vector<std::string> allowed;  ///< files, and folders with all below them
  std::vector<std::string> denied;   ///< files and folders, whatever else allows them
};

class ReadScope {
 public:
  /// Files and folders that may be read besides, and those that may not, as long as the scope lives.
  explicit ReadScope(const std::vector<std::string>& allowed, const std::vector<std::string>& denied = {});
  /// The rules of another thread or moment; null for none.
  explicit ReadScope(std::shared_ptr<const ReadRules> rules);
  /// The rules for the files that the scene `file` names. Inside of another scene that one's rules hold.
  static ReadScope ofScene(const std::string& file);
  ~ReadScope();
  ReadScope(const ReadScope&) = delete;
  ReadScope& operator=(const ReadScope&) = delete;

  static std::shared_ptr<const ReadRules> current();

 private:
  std::shared_ptr<const ReadRules> before_;
};

/// The text as one word of a command line.
std::string shellWord(const std::string& text);

/// Does not reveal whether the file exists.
bool mayRead(const std::string& path);

/// Throws ReadDenied, whose hint names the flag that allows it.
void checkMayRead(const std::string& path);

}  // namespace trace

#include "base/files/read_scope.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/files/file.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

using Rules = std::shared_ptr<const ReadRules>;

/// The rules, on the heap; null for none. No object with a destructor: glibc registers that when a thread
/// first looks at it, and ends the process where there is no memory for it.
constinit thread_local Rules* cellOfThread = nullptr;

const ReadRules* rulesOfThread() { return cellOfThread ? cellOfThread->get() : nullptr; }

void setRules(Rules rules) {
  if (!rules) {
    delete std::exchange(cellOfThread, nullptr);
  } else if (cellOfThread) {
    *cellOfThread = std::move(rules);
  } else {
    cellOfThread = new Rules(std::move(rules));
  }
}

/// Absolute and without links, in letters that can be compared; what does not exist is kept as it is named.
/// "" if it cannot be told.
std::string realPath(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path.empty() ? "." : path, error);
  if (error) return {};
  fs::path real = fs::weakly_canonical(whole, error);
  if (error) return {};
  if (!real.has_filename() && real.has_parent_path() && real != real.root_path()) real = real.parent_path();
  return comparedName(real.generic_string());
}

constexpr const char* kEverywhere = "/";  // on all drives of Windows

/// Is the path the folder, or below it?
bool isBelow(const std::string& path, const std::string& folder) {
  if (folder == kEverywhere) return true;
  if (folder.empty() || !path.starts_with(folder)) return false;
  return path.size() == folder.size() || folder.back() == '/' || path[folder.size()] == '/';
}

bool isBelowOne(const std::string& path, const std::vector<std::string>& folders) {
  return std::any_of(folders.begin(), folders.end(),
                     [&](const std::string& folder) { return isBelow(path, folder); });
}

void addReal(std::vector<std::string>& to, const std::vector<std::string>& paths) {
  for (const std::string& path : paths)
    if (std::string real = path == kEverywhere ? path : realPath(path); !real.empty())
      to.push_back(std::move(real));
}

ReadRules copyOfCurrent() { return rulesOfThread() ? *rulesOfThread() : ReadRules{}; }

}  // namespace

void ReadDenied::at(const SourcePlace& place) const {
  Message message = messages().front();
  if (message.place.file.empty()) message.place = place;
  throw ReadDenied(fault(), {message});
}

ReadScope::ReadScope(const std::vector<std::string>& allowed, const std::vector<std::string>& denied)
    : before_(current()) {
  ReadRules rules = copyOfCurrent();
  addReal(rules.allowed, allowed);
  addReal(rules.denied, denied);
  setRules(std::make_shared<const ReadRules>(std::move(rules)));
}

ReadScope::ReadScope(std::shared_ptr<const ReadRules> rules) : before_(current()) {
  setRules(std::move(rules));
}

ReadScope ReadScope::ofScene(const std::string& file) {
  ReadRules rules = copyOfCurrent();
  if (rules.root.empty()) rules.root = realPath(fs::path(file).parent_path());
  if (rules.root.empty()) rules.root = file;  // a folder that cannot be found holds nothing
  return ReadScope(std::make_shared<const ReadRules>(std::move(rules)));
}

ReadScope::~ReadScope() { setRules(before_); }

std::shared_ptr<const ReadRules> ReadScope::current() { return cellOfThread ? *cellOfThread : nullptr; }

std::string shellWord(const std::string& text) {
  const bool plain = text.find_first_of(" \t\"'\\$&;()<>|*?`!#~") == text.npos;
  return plain ? text : "\"" + text + "\"";
}

bool mayRead(const std::string& path) {
  if (!rulesOfThread()) return true;
  const ReadRules& rules = *rulesOfThread();
  const std::string real = realPath(path);
  if (real.empty() || isBelowOne(real, rules.denied)) return false;
  return rules.root.empty() || isBelow(real, rules.root) || isBelowOne(real, rules.allowed);
}

void checkMayRead(const std::string& path) {
  if (mayRead(path)) return;
  const std::string real = realPath(path);
  if (real.empty() || isBelowOne(real, rulesOfThread()->denied))
    throw ReadDenied(Fault::scene, "\"" + path + "\" may not be read by a scene");
  fs::path folder = fs::path(path).parent_path().lexically_normal();
  if (folder.empty()) folder = ".";
  throw ReadDenied(Fault::scene,
                   "\"" + path + "\" is outside the scene's folder, and a scene may read only below that",
                   "--allow-read " + shellWord(folder.generic_string()) + " allows it (docs/security.md)");
}

}  // namespace trace

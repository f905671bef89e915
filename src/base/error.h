// Errors, told to a person: where, what was expected, what was found, what to try.
//
// Loading and compiling a scene throw one type, Error, caught in few places (the command, later the
// studio). Repairs are collected as warnings in a Messages and returned with the result. Nothing below
// app/ prints.
#pragma once

#include <exception>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace trace {

/// The name of a file, shared by all that stands in it: a scene may have a million objects.
class FileName {
 public:
  FileName() = default;
  FileName(std::string name)  // NOLINT(google-explicit-constructor)
      : name_(name.empty() ? nullptr : std::make_shared<const std::string>(std::move(name))) {}
  FileName(const char* name) : FileName(std::string(name)) {}  // NOLINT(google-explicit-constructor)

  const std::string& str() const {
    static const std::string kNone;
    return name_ ? *name_ : kNone;
  }
  operator const std::string&() const { return str(); }  // NOLINT(google-explicit-constructor)
  bool empty() const { return !name_; }
  bool operator==(const FileName& other) const { return name_ == other.name_ || str() == other.str(); }
  bool operator<(const FileName& other) const { return str() < other.str(); }

 private:
  std::shared_ptr<const std::string> name_;  ///< null: ""
};

/// A place in a file the user wrote. `line` and `column` count from 1; 0 means the file as a whole.
struct SourcePlace {
  FileName file{};
  int line = 0;
  int column = 0;
  std::string text{};  ///< that line of the file, for the caret; may be empty

  bool operator==(const SourcePlace&) const = default;
};

/// "scene.ray:12:3", as far as known.
std::string placeText(const SourcePlace& place);

struct Message {
  enum class Severity { warning, error };

  Severity severity = Severity::error;
  SourcePlace place{};
  std::string what{};  ///< what was expected and what was found
  std::string hint{};  ///< what to try; may be empty

  bool operator==(const Message&) const = default;
};

/// `file:line:column: error: what`, the line with a caret below, and the hint.
std::string toString(const Message& message);

/// Why a program failed; the values are the exit codes of the command line.
enum class Fault { io = 1, usage = 2, scene = 3, limit = 5 };

/// The one exception type. Holds one or several messages; what() is all of them.
class Error : public std::exception {
 public:
  Error(Fault fault, std::string what, std::string hint = {});
  Error(Fault fault, SourcePlace place, std::string what, std::string hint = {});
  Error(Fault fault, std::vector<Message> messages);

  const char* what() const noexcept override { return text_.c_str(); }
  Fault fault() const { return fault_; }
  const std::vector<Message>& messages() const { return messages_; }

 private:
  Fault fault_;
  std::vector<Message> messages_;
  std::string text_;
};

/// Warnings and errors met while reading one scene, in the order met.
class Messages {
 public:
  /// More errors than this end the reading at once.
  static constexpr int kMostErrors = 20;

  void warn(SourcePlace place, std::string what, std::string hint = {});
  /// Notes an error and returns, so that one reading reports several; throws at the twentieth.
  void error(SourcePlace place, std::string what, std::string hint = {});
  /// Throws an Error with all messages if there was an error, or, when `strict`, a warning.
  void throwIfFailed(bool strict = false) const;

  const std::vector<Message>& all() const { return messages_; }

 private:
  std::vector<Message> messages_;
  int errors_ = 0;
};

}  // namespace trace

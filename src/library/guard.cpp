#include "library/guard.h"

#include "app/session/version.h"

namespace traceray {
namespace {

trace::Fault faultOf(Error::Kind kind) {
  switch (kind) {
    case Error::Kind::file: return trace::Fault::io;
    case Error::Kind::usage: return trace::Fault::usage;
    case Error::Kind::limit: return trace::Fault::limit;
    case Error::Kind::scene: break;
  }
  return trace::Fault::scene;
}

Error::Kind kindOfError(trace::Fault fault) {
  switch (fault) {
    case trace::Fault::io: return Error::Kind::file;
    case trace::Fault::usage: return Error::Kind::usage;
    case trace::Fault::limit: return Error::Kind::limit;
    case trace::Fault::scene: break;
  }
  return Error::Kind::scene;
}

std::string textOf(std::span<const Problem> problems) {
  std::string text;
  for (const Problem& problem : problems) text += problem.text;
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

}  // namespace

std::string version() { return trace::versionText(); }

Error::Error(Kind kind, std::vector<Problem> problems)
    : kind_(kind), problems_(std::move(problems)), text_(textOf(problems_)) {}
Error::Error(Kind kind, const std::string& what, const std::string& hint)
    : Error(kind, problemsOf(trace::Error(faultOf(kind), what, hint).messages())) {}
Error::Error(const Error&) = default;
Error& Error::operator=(const Error&) = default;
Error::~Error() = default;
const char* Error::what() const noexcept { return text_.c_str(); }
Error::Kind Error::kind() const { return kind_; }
const std::vector<Problem>& Error::problems() const { return problems_; }

Problem problemOf(const trace::Message& message) {
  return {.file = message.place.file,
          .line = message.place.line,
          .column = message.place.column,
          .isError = message.severity == trace::Message::Severity::error,
          .what = message.what,
          .hint = message.hint,
          .text = toString(message)};
}

std::vector<Problem> problemsOf(std::span<const trace::Message> messages) {
  std::vector<Problem> problems;
  for (const trace::Message& message : messages) problems.push_back(problemOf(message));
  return problems;
}

void rethrow(const trace::Error& error) {
  throw Error(kindOfError(error.fault()), problemsOf(error.messages()));
}

}  // namespace traceray

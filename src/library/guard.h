// Exceptions of the floors below become the one exception of the library.
#pragma once

#include <exception>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
#include "traceray/traceray.h"

namespace traceray {

Problem problemOf(const trace::Message& message);
std::vector<Problem> problemsOf(std::span<const trace::Message> messages);
/// Throws it as an Error of the library.
[[noreturn]] void rethrow(const trace::Error& error);

/// The result of work(); everything that it throws becomes an Error.
template <class Work>
auto guarded(Work&& work) -> decltype(work()) {
  try {
    return work();
  } catch (const Error&) {
    throw;
  } catch (const trace::Error& error) {
    rethrow(error);
  } catch (const std::bad_alloc&) {
    throw Error(Error::Kind::limit, "out of memory");
  } catch (const std::exception& error) {  // thrown by the file system
    throw Error(Error::Kind::file, error.what());
  }
}

}  // namespace traceray

// Windows' own header, and its text.
#pragma once

#ifndef NOMINMAX
#define NOMINMAX
#endif
#ifndef WIN32_LEAN_AND_MEAN
#define WIN32_LEAN_AND_MEAN
#endif
// clang-format off
#include <windows.h>  // before the others, which need it
#include <psapi.h>
#include <shellapi.h>
// clang-format on

#include <string>
#include <string_view>

namespace trace::os {

/// The text of UTF-8 as Windows' functions take it, and back.
std::wstring wide(std::string_view text);
std::string narrow(std::wstring_view text);

/// The reason of a failure, in the words that POSIX has for it.
std::string reasonOf(DWORD error);

/// A handle that is closed when this goes.
class Handle {
 public:
  explicit Handle(HANDLE handle) : handle_(handle) {}
  ~Handle() {
    if (*this) ::CloseHandle(handle_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  HANDLE get() const { return handle_; }
  explicit operator bool() const { return handle_ && handle_ != INVALID_HANDLE_VALUE; }

 private:
  HANDLE handle_;
};

}  // namespace trace::os

#include "base/os/windows/api.h"

#include <cerrno>
#include <cstdint>
#include <cwchar>
#include <system_error>

namespace trace::os {

std::wstring wide(std::string_view text) {
  const int length = static_cast<int>(text.size());
  std::wstring result(
      static_cast<std::size_t>(::MultiByteToWideChar(CP_UTF8, 0, text.data(), length, nullptr, 0)), L'\0');
  ::MultiByteToWideChar(CP_UTF8, 0, text.data(), length, result.data(), static_cast<int>(result.size()));
  return result;
}

std::string narrow(std::wstring_view text) {
  const int length = static_cast<int>(text.size());
  const auto convert = [&](char* to, int room) {
    return ::WideCharToMultiByte(CP_UTF8, 0, text.data(), length, to, room, nullptr, nullptr);
  };
  std::string result(static_cast<std::size_t>(convert(nullptr, 0)), '\0');
  convert(result.data(), static_cast<int>(result.size()));
  return result;
}

std::string reasonOf(DWORD error) {
  switch (error) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME:
    case ERROR_BAD_NETPATH: return "No such file or directory";
    case ERROR_ACCESS_DENIED:
    case ERROR_WRITE_PROTECT: return "Permission denied";
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION: return "another program has it open";
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL: return "No space left on device";
    case ERROR_DIRECTORY: return "Not a directory";
    default: return std::system_category().message(static_cast<int>(error));
  }
}

}  // namespace trace::os

/// The program uses this for mbrtowc of the C library (CMakeLists.txt), so that it reads UTF-8:
/// std::filesystem::path(std::string) goes by it, and the C library of Windows that mingw-w64 uses has no
/// locale of UTF-8. A character beyond 16 bits becomes two units: the first three of its four bytes give the
/// one, the last byte gives the other, whose upper bits are kept in `state`.
extern "C" std::size_t __wrap_mbrtowc(wchar_t* to, const char* from, std::size_t count,
                                      std::mbstate_t* state) {
  constexpr auto kWrong = static_cast<std::size_t>(-1), kMore = static_cast<std::size_t>(-2);
  constexpr unsigned kHalf = 16;  // in the state: the second unit is yet to come
  static thread_local std::mbstate_t ownState{};
  if (!state) state = &ownState;
  if (!from || count == 0) return from ? kMore : 0;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(from[i])); };
  const auto give = [&](unsigned unit, std::size_t bytes) {
    if (to) *to = static_cast<wchar_t>(unit);
    return unit == 0 ? 0 : bytes;
  };
  const auto wrong = [&] {
    errno = EILSEQ;
    *state = 0;
    return kWrong;
  };
  if (const auto held = static_cast<unsigned>(*state); held & kHalf) {
    *state = 0;
    return (byte(0) & 0xc0) == 0x80 ? give(0xdc00 | (held & 15) << 6 | (byte(0) & 63), 1) : wrong();
  }
  if (byte(0) < 0x80) return give(byte(0), 1);
  if (byte(0) < 0xc2 || byte(0) > 0xf4) return wrong();
  const std::size_t length = byte(0) < 0xe0 ? 2 : 3;  // three for now if it has four bytes
  if (count < length) return kMore;
  unsigned bits = byte(0) & (byte(0) < 0xe0 ? 0x1f : byte(0) < 0xf0 ? 0x0f : 0x07);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return wrong();
    bits = bits << 6 | (byte(i) & 63);
  }
  if (byte(0) < 0xf0) return give(bits, length);
  if (bits < 0x400 || bits >= 0x4400) return wrong();
  *state = static_cast<std::mbstate_t>(kHalf | (bits & 15));
  return give(0xd800 + ((bits - 0x400) >> 4), length);
}

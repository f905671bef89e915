// Fuzz target: any bytes as a picture of any format of the table, with its words. Whatever they are, reading
// them returns a picture or throws; and a picture that was read is written and read again by the same format,
// if that is written.
#include <cstddef>
#include <cstdint>
#include <exception>
#include <string_view>

#include "base/error.h"
#include "image/codecs/codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  constexpr trace::PictureLimits kLimits{.memory = 64 << 20};
  for (const trace::PictureFormat& format : trace::pictureFormats()) {
    if (!format.recognise(bytes)) continue;
    try {
      format.metadata(bytes);
    } catch (const std::exception&) {
    }
  }
  try {
    const trace::Picture picture = trace::decodePicture(bytes, "fuzz", kLimits);
    const trace::PictureFormat& format = trace::pictureFormatOf(bytes, "fuzz");
    if (!format.encode) return 0;
    const std::string again = trace::encodePicture(format, picture);
    const trace::Picture back = trace::decodePicture(again, "again", kLimits);
    if (back.width != picture.width || back.height != picture.height) __builtin_trap();
  } catch (const trace::Error& error) {
    if (error.messages().empty()) __builtin_trap();
  }
  return 0;
}

// Fuzz target: any bytes as a scene of any format of the table. Whatever they are, reading them returns a
// scene or throws Error.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "formats/format.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    trace::Messages messages;
    const trace::Scene scene =
        trace::readScene("fuzz.ray", std::string_view(reinterpret_cast<const char*>(data), size), messages);
    if (!(scene == scene)) __builtin_trap();  // no NaN gets in
  } catch (const trace::Error& error) {
    if (error.messages().empty()) __builtin_trap();
  }
  return 0;
}

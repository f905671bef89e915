// Fuzz target: any bytes as a photometric file. Whatever they are, reading them throws Error or returns a
// lamp whose intensities are finite in every direction.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "formats/ies.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  trace::Messages messages;
  try {
    const trace::Photometry lamp =
        trace::readIes("fuzz.ies", std::string_view(reinterpret_cast<const char*>(data), size), messages);
    for (const trace::Vec3& to :
         {trace::Vec3{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {-0.6, 0.64, 0.48}}) {
      const trace::Real candelas = lamp.at(to);
      if (!(candelas >= 0 && candelas <= lamp.brightest() * (1 + 1e-9))) __builtin_trap();
    }
    if (!(lamp.lumens() >= 0 && lamp.widest() >= 0 && lamp.widest() < 3.15)) __builtin_trap();
  } catch (const trace::Error& error) {
    if (error.messages().empty()) __builtin_trap();
  }
  return 0;
}

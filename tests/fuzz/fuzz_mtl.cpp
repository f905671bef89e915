// Fuzz target: any bytes as the MTL file of a small OBJ. Whatever they are, reading returns a scene or throws
// Error.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/files/file.h"
#include "formats/format.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string folder =
      (std::filesystem::temp_directory_path() / ("trace-fuzz-mtl-" + std::to_string(::getpid()))).string();
  std::filesystem::create_directories(folder);
  trace::writeFile(folder + "/a.mtl", std::string_view(reinterpret_cast<const char*>(data), size));
  constexpr std::string_view kObject =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl glass\nf 3 2 1\n";
  trace::Messages messages;
  try {
    const trace::Scene scene = trace::readScene(folder + "/a.obj", kObject, messages);
    if (!(scene == scene)) __builtin_trap();  // no NaN gets in
  } catch (const trace::Error& error) {
    if (error.messages().empty()) __builtin_trap();
  }
  return 0;
}

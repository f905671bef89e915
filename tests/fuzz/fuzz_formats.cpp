// Fuzz target: any bytes as a scene of any format of the table. Whatever they are, reading them returns a
// scene or throws Error; and what was read can be written as .ray and read again, unless it names a file
// that no .ray file can name.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "formats/ray/file/format.h"
#include "formats/ray/syntax/names.h"
#include "formats/ray/write/writer.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  trace::Messages messages;
  trace::Scene scene;
  try {
    scene =
        trace::readScene("fuzz.ray", std::string_view(reinterpret_cast<const char*>(data), size), messages);
  } catch (const trace::Error& error) {
    if (error.messages().empty()) __builtin_trap();
    return 0;
  }
  if (!(scene == scene)) __builtin_trap();  // no NaN gets in
  std::string text;
  try {
    text = trace::writeRay(scene, "out.ray", {}, messages).at(0).bytes;
  } catch (const trace::Error&) {
    const std::optional<trace::Unsayable> name = trace::unsayableIn(scene);
    if (!name || !name->isFile) __builtin_trap();
    return 0;
  }
  const trace::Scene back = trace::readRay("out.ray", text, messages);
  if (back.objects.size() != scene.objects.size()) __builtin_trap();
  return 0;
}

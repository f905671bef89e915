// count_pixels PICTURE FORMULA: how many pixels there are in which the formula in r, g, b (from 0 to 1) is
// above 0, for tests by scripts. Prints "COUNT of ALL". Example: count_pixels out.png 'min(r - 0.6, r - 1.6 *
// g)'
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "image/codecs/codec.h"
#include "math/expression.h"

namespace {

/// The formula in x, y, z. Functions keep their names: none holds a lone letter.
std::string inSpace(std::string formula) {
  const auto isLetter = [&](std::size_t i) {
    return i < formula.size() && (formula[i] | 0x20) >= 'a' && (formula[i] | 0x20) <= 'z';
  };
  for (std::size_t i = 0; i < formula.size(); ++i)
    if (!isLetter(i - 1) && !isLetter(i + 1))
      formula[i] = formula[i] == 'r' ? 'x' : formula[i] == 'g' ? 'y' : formula[i] == 'b' ? 'z' : formula[i];
  return formula;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (count != 3) throw std::runtime_error("usage: count_pixels PICTURE FORMULA");
    const trace::Picture picture = trace::readPicture(arguments[1]);
    const trace::Expression formula(inSpace(arguments[2]));
    std::size_t found = 0;
    for (const trace::Color& c : picture.pixels) found += formula.at({c.r, c.g, c.b}) > 0;
    std::printf("%zu of %zu\n", found, picture.pixels.size());
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "count_pixels: %s\n", error.what());
    return 2;
  }
}

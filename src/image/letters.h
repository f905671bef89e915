// Letters of our own, made of strokes, for words in drawings: at any height, and without a file.
#pragma once

#include <string_view>
#include <vector>

#include "math/vec.h"

namespace trace {

/// A stroke of a letter, in pixels from the upper left corner of its line, y down.
struct LetterStroke {
  Vec2 from, to;
};

/// The strokes of the words in a line of that height. A character that has no letter, such as one beyond
/// ASCII, is a box.
std::vector<LetterStroke> letterStrokes(std::string_view words, double height);

/// The width of the words in such a line.
double lettersWidth(std::string_view words, double height);

}  // namespace trace

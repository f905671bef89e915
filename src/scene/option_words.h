// Other names of the options: for looking one up in the studio, and for hints on unknown names.
#pragma once

#include <string_view>
#include <vector>

#include "scene/options.h"

namespace trace {

/// Other words for the option, with spaces between; "" if it has none.
std::string_view wordsFor(const Option& option);

/// The word for the least value of a number that is no quantity: "auto", "all"; "" if it is one.
std::string_view leastWordFor(const Option& option);

/// The field of the camera, which is no option, that a person may look for by these words; "" if there is
/// none.
std::string_view cameraFieldMeant(std::string_view words);

/// Every word of `text` is part of the option's name, group, help, choices or other words; letters may be
/// small or capital.
bool isAbout(const Option& option, std::string_view text);

/// How well the text names the option, for the best first in a list: the least, over its words, of 3 where
/// the word is the option's name, one of its other words or the start of its name, 2 where it is a word of
/// the name or a choice, else 1.
int relevance(const Option& option, std::string_view text);

/// The names of the options that have the word among theirs.
std::vector<std::string_view> optionsMeant(std::string_view word);

}  // namespace trace

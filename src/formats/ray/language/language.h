// The language of scenes (docs/language.md): named values, functions, loops, conditions, objects with
// parameters and included files. Everything of it is computed before anything is made of the scene:
// expand() turns the tree that the parser made into the plain one that the reader knows, as settleKeys() does
// with keys.
//
// Names are lexical: a block sees its own names and those around it, and all names of a block are known
// throughout it. A value is computed when it is first used. Nothing is assigned twice, so the order of
// definitions does not matter.
#pragma once

#include <string_view>
#include <vector>

#include "formats/ray/syntax/syntax.h"
#include "formats/scene_time.h"
#include "scene/input_files.h"

namespace trace::rayfile {

/// More nodes than this are not made, and not this many steps taken: a nest of loops ends with an error.
inline constexpr std::size_t kMostMadeNodes = std::size_t{1} << 25;
inline constexpr std::size_t kMostSteps = 100'000'000;
/// Definitions and functions may call one another this deep.
inline constexpr int kMostCalls = 200;

/// Leaves numbers, words, tuples, blocks, entries and calls. Notes the files that are
/// included. Throws Error(Fault::scene) with the place and the calls and loops around it, Error(Fault::io)
/// for a file that cannot be included, and Error(Fault::limit) for more than the above. Free where the file
/// uses nothing of the language.
/// With `instances`, a name of objects that is used often leaves nodes of the kind again.
void expand(Syntax& syntax, SceneTime& time, InputFiles& inputs, bool instances = false);

/// The tree of which the reader makes a scene: that at `time`, expanded, with values in the place of keys.
void settle(Syntax& syntax, SceneTime& time, InputFiles& inputs);

/// A row of the table of functions.
struct FunctionHelp {
  std::string_view name, parameters, help;
};
std::vector<FunctionHelp> functionsOfLanguage();

}  // namespace trace::rayfile

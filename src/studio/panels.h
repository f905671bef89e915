// THE table of panels. A new one is a function and a row in panels.cpp.
#pragma once

#include <span>
#include <string_view>

#include "studio/studio.h"

namespace trace::studio {

struct Panel {
  std::string_view name;
  std::string_view help;  ///< one sentence, no full stop
  Dock dock;              ///< at first
  int key;                ///< with Alt: brings it to the front
  void (*draw)(Studio&);
};

std::span<const Panel> panels();

// The functions of the table; each in its own file.
void drawPicture(Studio&);
/// The picture without its surroundings, in the rest of the child window.
void drawPictureAlone(Studio&);
void drawControls(Studio&);
/// The options that people use most, in lines of the rest of the child window.
void drawFrequentOptions(Studio&);
void drawScene(Studio&);
void drawRays(Studio&);
void drawBadSamples(Studio&);
void drawLog(Studio&);
void drawStatistics(Studio&);

/// One click from a bad sample to its rays.
void showBadSample(Studio&, const BadSample&);

}  // namespace trace::studio

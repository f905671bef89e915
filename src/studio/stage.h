// The stage, for a room full of people: the picture and the view in space alone, with large text and thick
// lines.
#pragma once

namespace trace::studio {

struct Studio;

void toggleStage(Studio& studio);
/// The next ray in the order of tracing; after the last one all of them.
void stepOnStage(Studio& studio);
void drawStage(Studio& studio);

}  // namespace trace::studio

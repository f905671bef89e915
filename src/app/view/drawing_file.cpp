// A Drawing as a file, of the kind that its ending says.
#include "app/editing/folder.h"
#include "app/view/drawing.h"
#include "base/error.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"

namespace trace {

void writeDrawing(const std::string& file, const Drawing& drawing) {
  if (const std::string problem = endingProblem(file, kDrawingSuffixes); !problem.empty())
    throw Error(Fault::usage, problem);
  if (endingProblem(file, {".png"}).empty()) return writePicture(file, toPicture(drawing), Rounding::nearest);
  writeFile(file, toSvg(drawing));
}

}  // namespace trace

// A flat drawing of lines, circles, words and pictures, and its two ways to a file: SVG, or pixels of our
// own.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "image/picture.h"

namespace trace {

/// In pixels from the top left, y down.
struct Point2 {
  double x = 0, y = 0;
};

struct DrawnLine {
  Point2 from, to;
  Color color;
  double width = 1;
  bool dashed = false;
};
struct DrawnTriangle {
  Point2 a, b, c;
  Color color;
};
struct DrawnDisk {
  Point2 center;
  double radius = 1;
  Color color;
};
struct DrawnWords {
  Point2 at;  ///< where the first letter's upper left corner is
  std::string words;
  Color color;
  double height = 14;  ///< height of a line
};
struct DrawnPicture {
  Point2 at;  ///< its upper left corner; a pixel is a pixel
  Picture picture;
};

/// Everything drawn up to the next call is clipped to this rectangle.
struct DrawnFrame {
  Point2 at;
  double width = 0, height = 0;
};
using Drawn = std::variant<DrawnLine, DrawnTriangle, DrawnDisk, DrawnWords, DrawnPicture, DrawnFrame>;

/// On white, each over those before it. Colours are levels of the screen.
struct Drawing {
  int width = 0, height = 0;
  std::vector<Drawn> things;
};

/// An SVG 1.1 file; pictures are inside it, as PNG.
std::string toSvg(const Drawing& drawing);

/// The endings of files that drawings are written to.
inline const std::vector<std::string> kDrawingSuffixes{".svg", ".png"};

/// Writes by the file's ending. Throws Error(Fault::usage) for another ending, and Error(Fault::io).
void writeDrawing(const std::string& file, const Drawing& drawing);

/// Smooth edges; words in the letters of image/letters.h.
Picture toPicture(const Drawing& drawing);

}  // namespace trace

// Height fields: landscapes from pictures. Source: the POV-Ray 3.7 reference, section 2.4.1.5.
#include <algorithm>
#include <utility>

#include "formats/pov/pov_reader.h"
#include "geometry/shapes/surfaces/height_field.h"
#include "image/codecs/codec.h"

namespace trace::pov {

void Reader::heightField(Node& node, const Token& at) {
  constexpr int kMostSide = 4096;
  HeightField shape;
  shape.floor = 0;
  std::string file;
  if (takesName("function")) {
    while (startsNumber()) number(), comma();
    if (peek().isMark("{")) omitBlock();
    leaveOut(at, "a height_field of a function");
    node.kind = Node::Kind::nothing;
  } else {
    while (peek().is(Token::Kind::name) && !startsText()) next();  // the type of the file
    file = text();
  }
  for (;;) {
    if (takesName("smooth"))
      shape.smooth = flag();
    else if (takesName("water_level"))
      shape.floor = number();
    else if (takesName("gamma") || takesName("premultiplied"))
      flag();
    else
      break;
  }
  if (node.kind == Node::Kind::nothing) return;
  try {
    const std::string bytes = readNamed(at, file);
    const Picture picture = decodePicture(bytes, file);
    if (std::min(picture.width, picture.height) < 2 || std::max(picture.width, picture.height) > kMostSide) {
      node.kind = Node::Kind::nothing;
      return leaveOut(at, "a height_field of a picture beyond 2 to 4096 pixels a side");
    }
    auto grid = std::make_shared<HeightGrid>(picture.width, picture.height);
    for (int y = 0; y < picture.height; ++y)
      for (int x = 0; x < picture.width; ++x) {
        const Color& c = picture.at(x, y);
        grid->at(x, picture.height - 1 - y) = static_cast<float>(0.297 * c.r + 0.589 * c.g + 0.114 * c.b);
      }
    shape.file = {file, std::move(grid)};
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    node.kind = Node::Kind::nothing;
    return leaveOut(at, "a height_field whose picture cannot be read", error.messages().front().what);
  }
  shape.height = 1;
  Affine m;  // x and y from -1 to 1 become x and z from 0 to 1
  m.row[0] = {0.5, 0, 0};
  m.row[1] = {0, 0, 1};
  m.row[2] = {0, 0.5, 0};
  m.offset = {0.5, 0, 0.5};
  node.shape = std::move(shape);
  node.shapeAt = m;
}

}  // namespace trace::pov

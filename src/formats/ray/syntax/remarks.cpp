#include "formats/ray/syntax/remarks.h"

#include <cmath>

#include "formats/ray/syntax/syntax.h"
#include "formats/text_front.h"
#include "math/vec.h"
#include "shading/cameras/camera.h"

namespace trace {
namespace {

using namespace rayfile;

void addAngle(const Syntax& syntax, const Item& rotation, RayRemarks& remarks) {
  if (!rotation.value().is(Kind::tuple)) return;
  auto argument = rotation.value().begin();
  for (int axis = 0; axis < 3 && argument != rotation.value().end(); ++axis) ++argument;
  if (argument == rotation.value().end() || !(*argument).is(Kind::number)) return;
  const double angle = (*argument).number();
  if (std::abs(angle) > 2 * kPi && 2 * angle == std::round(2 * angle))
    remarks.degrees.push_back({syntax.place((*argument).offset()), angle});
}

}  // namespace

RayRemarks remarksOn(const std::string& file, std::string_view bytes) {
  const TextFront front(file, bytes);
  const Syntax syntax(file, front.text());
  RayRemarks remarks;
  remarks.camera.file = file;
  for (std::uint32_t i = 0; i < syntax.nodes().size(); ++i) {
    const Item item(syntax, i);
    if (!item.is(Kind::call)) continue;
    if (item.key() == "rotate" && !syntax.isOfKind()) addAngle(syntax, item, remarks);
    if (item.key() == Camera::kKeyword) remarks.camera = syntax.place(item.offset());
  }
  return remarks;
}

}  // namespace trace

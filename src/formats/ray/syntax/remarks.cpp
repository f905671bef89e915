#include "formats/ray/syntax/remarks.h"

#include <cmath>
#include <map>
#include <string_view>

#include "base/files/file.h"
#include "formats/ray/syntax/syntax.h"
#include "formats/text_front.h"
#include "math/vec.h"
#include "shading/cameras/camera.h"
#include "shading/lights/light.h"

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

std::optional<Color> plainColor(const Item& value) {
  if (!value.is(Kind::tuple) || value.count() != 3) return {};
  double channels[3];
  int count = 0;
  for (const Item channel : value) {
    if (!channel.is(Kind::number)) return {};
    channels[count++] = channel.number();
  }
  return Color(channels[0], channels[1], channels[2]);
}

void addStrength(const Syntax& syntax, const Item& light, RayRemarks& remarks) {
  RayRemarks::Strength strength{syntax.place(light.offset())};
  for (const Item field : light.value()) {
    if (!field.keyed()) continue;
    if (field.key() == "power") {
      strength.says = strength.says && field.value().is(Kind::number);
      if (field.value().is(Kind::number)) strength.power = field.value().number();
    } else if (field.key() == "color" || field.key() == "colour") {
      strength.color = plainColor(field.value());
      strength.says = strength.says && strength.color;
    }
  }
  remarks.lights.push_back(std::move(strength));
}

/// The names that a file defines, and how often its words name them.
class NameUses {
 public:
  explicit NameUses(const Syntax& syntax) : syntax_(syntax) {
    for (std::uint32_t i = 0; i < syntax.nodes().size(); ++i) {
      if (isName(i)) ++words_[Item(syntax, i).text()];
      includes_ |= kind(i) == Kind::include;
    }
  }

  void addUnused(RayRemarks& remarks) const {
    for (std::uint32_t i = 0; i < syntax_.nodes().size(); ++i) {
      if (kind(i) != Kind::let && kind(i) != Kind::define) continue;
      const std::uint32_t name = i + 1, parameters = end(name);
      if (!includes_ && words_.at(Item(syntax_, name).text()) == 1) add(remarks, name, false);
      const bool takes = parameters < end(i) && kind(parameters) == Kind::tuple && end(parameters) < end(i);
      if (takes) addParameters(remarks, parameters, end(i));
    }
  }

 private:
  Kind kind(std::uint32_t i) const { return syntax_.nodes()[i].kind; }
  std::uint32_t end(std::uint32_t i) const { return syntax_.nodes()[i].end; }
  bool isName(std::uint32_t i) const { return kind(i) == Kind::word && !syntax_.nodes()[i].quoted; }
  void add(RayRemarks& remarks, std::uint32_t name, bool isParameter) const {
    const Item item(syntax_, name);
    remarks.unused.push_back({syntax_.place(item.offset()), std::string(item.text()), isParameter});
  }
  /// Parameters may have others in their defaults.
  void addParameters(RayRemarks& remarks, std::uint32_t parameters, std::uint32_t bodyEnd) const {
    for (std::uint32_t i = parameters + 1; i < end(parameters); i = end(i)) {
      const std::uint32_t name = kind(i) == Kind::entry ? i + 1 : i;
      if (!isName(name)) continue;
      int uses = 0;
      for (std::uint32_t other = parameters + 1; other < bodyEnd; ++other)
        uses += isName(other) && Item(syntax_, other).text() == Item(syntax_, name).text();
      if (uses == 1) add(remarks, name, true);
    }
  }

  const Syntax& syntax_;
  std::map<std::string_view, int> words_;
  bool includes_ = false;
};

}  // namespace

RayRemarks remarksOn(const std::string& file, std::string_view bytes) {
  const TextFront front(file, bytes);
  const Syntax syntax(file, front.text());
  RayRemarks remarks;
  remarks.camera.file = file;
  remarks.isOfKind = syntax.isOfKind();
  if (syntax.usesLanguage()) NameUses(syntax).addUnused(remarks);
  for (std::uint32_t i = 0; i < syntax.nodes().size(); ++i) {
    const Item item(syntax, i);
    if (!item.is(Kind::call)) continue;
    if (item.key() == "rotate" && !syntax.isOfKind()) addAngle(syntax, item, remarks);
    if (item.value().is(Kind::block) && findLightType(item.key())) addStrength(syntax, item, remarks);
    if (item.key() == Camera::kKeyword) remarks.camera = syntax.place(item.offset());
  }
  return remarks;
}

RayRemarks remarksOn(const Scene& scene) {
  RayRemarks none;
  none.camera.file = scene.file;
  if (scene.format != "ray" || !isOrdinaryFile(scene.file)) return none;  // a pipe is empty by now
  try {
    return remarksOn(scene.file, readFile(scene.file));
  } catch (const Error&) {
    return none;
  }
}

}  // namespace trace

#include "formats/ray/file/made_by.h"

#include <optional>
#include <vector>

#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "formats/ray/language/language.h"
#include "formats/ray/syntax/syntax.h"
#include "formats/text_front.h"
#include "scene/groups.h"

namespace trace {
namespace {

using namespace rayfile;

bool isAt(const SourcePlace& place, const SourcePlace& other) {
  return place.line == other.line && place.column == other.column && place.file == other.file;
}

/// The nodes that isWanted(index, offset of the text), where they are of the text at a place, in their order.
template <class IsWanted>
std::vector<std::uint32_t> nodesAt(const Syntax& syntax, const SourcePlace& place, const IsWanted& isWanted) {
  std::vector<std::uint32_t> nodes;
  std::optional<std::uint32_t> known;
  for (std::uint32_t i = 0; i < syntax.nodes().size(); ++i) {
    const std::optional<std::uint32_t> offset = isWanted(i);
    if (!offset) continue;
    if (!known && isAt(syntax.shortPlace(*offset), place)) known = offset;
    if (known && *offset == *known) nodes.push_back(i);
  }
  return nodes;
}

/// Objects or placements of one place in the text: their number, and how many come before one of them.
struct Among {
  SourcePlace place;
  std::size_t before = 0, all = 0;
};

Among amongObjects(const Scene& scene, std::size_t object) {
  Among among{scene.objects[object].place};
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (isAt(scene.objects[i].place, among.place)) {
      among.before += i < object;
      ++among.all;
    }
  return among;
}

/// Among the placements in the world. Those of one text may be of several groups; then their order is lost.
std::optional<Among> amongPlacements(const Scene& scene, const NumberedObject::Step& step) {
  const std::uint32_t wanted = step.use().place;
  Among among{scene.usePlaces.at(wanted)};
  for (const GroupUses& uses : scene.uses)
    for (std::size_t i = 0; i < uses.list->size(); ++i) {
      if ((*uses.list)[i].place != wanted) continue;
      if (&uses != step.uses) return {};
      among.before += i < step.index;
      ++among.all;
    }
  return among;
}

}  // namespace

std::string callsThatMade(const Scene& scene, std::uint32_t number, Real time) {
  if (scene.format != "ray" || !isOrdinaryFile(scene.file)) return "";
  const NumberedObject found = objectOf(scene, number);
  const bool placed = !found.steps.empty();
  const std::optional<Among> among =
      placed ? amongPlacements(scene, found.steps.front()) : amongObjects(scene, number);
  if (!among) return "";
  try {
    const ReadScope scope = ReadScope::ofScene(scene.file);
    const std::string bytes = readFile(scene.file);
    const TextFront front(scene.file, bytes);
    Syntax syntax(scene.file, front.text());
    SceneTime moment(time);
    InputFiles inputs;
    settle(syntax, moment, inputs);
    const auto isWanted = [&](std::uint32_t i) -> std::optional<std::uint32_t> {
      const Node& node = syntax.nodes()[i];
      if (placed && node.kind != Kind::again) {
        const Syntax::Root* root = syntax.rootAt(i);
        return root ? std::optional(root->offset) : std::nullopt;
      }
      return placed || node.kind == Kind::call ? std::optional(node.offset) : std::nullopt;
    };
    const std::vector<std::uint32_t> nodes = nodesAt(syntax, among->place, isWanted);
    return nodes.size() == among->all ? syntax.chain(nodes[among->before]) : "";
  } catch (const Error&) {  // the file has changed
    return "";
  }
}

}  // namespace trace

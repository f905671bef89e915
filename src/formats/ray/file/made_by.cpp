#include "formats/ray/file/made_by.h"

#include <optional>
#include <vector>

#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "formats/ray/language/language.h"
#include "formats/ray/syntax/syntax.h"
#include "formats/text_front.h"

namespace trace {
namespace {

using namespace rayfile;

bool isAt(const SourcePlace& place, const SourcePlace& other) {
  return place.line == other.line && place.column == other.column && place.file == other.file;
}

/// The nodes that the text at a place became, in the order of the objects.
std::vector<std::uint32_t> nodesAt(const Syntax& syntax, const SourcePlace& place) {
  std::vector<std::uint32_t> nodes;
  std::optional<std::uint32_t> offset;
  for (std::uint32_t i = 0; i < syntax.nodes().size(); ++i) {
    const Node& node = syntax.nodes()[i];
    if (node.kind != Kind::call) continue;
    if (!offset && isAt(syntax.shortPlace(node.offset), place)) offset = node.offset;
    if (offset && node.offset == *offset) nodes.push_back(i);
  }
  return nodes;
}

}  // namespace

std::string callsThatMade(const Scene& scene, std::size_t object, Real time) {
  if (scene.format != "ray" || !scene.uses.empty() || !isOrdinaryFile(scene.file)) return "";
  const SourcePlace& place = scene.objects[object].place;
  std::size_t before = 0, all = 0;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (isAt(scene.objects[i].place, place)) {
      before += i < object;
      ++all;
    }
  try {
    const ReadScope scope = ReadScope::ofScene(scene.file);
    const std::string bytes = readFile(scene.file);
    const TextFront front(scene.file, bytes);
    Syntax syntax(scene.file, front.text());
    SceneTime moment(time);
    InputFiles inputs;
    settle(syntax, moment, inputs);
    const std::vector<std::uint32_t> nodes = nodesAt(syntax, place);
    return nodes.size() == all ? syntax.chain(nodes[before]) : "";
  } catch (const Error&) {  // the file has changed
    return "";
  }
}

}  // namespace trace

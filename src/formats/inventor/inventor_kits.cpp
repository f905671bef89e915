// Node kits: nodes that keep what belongs together in parts with names, in an order that their kind fixes.
// Source: Inventor's node reference, the catalogs of SoBaseKit and of those below it.
#include <array>

#include "formats/inventor/inventor_reader.h"

namespace trace::inventor {
namespace {

/// The parts of all kits, in the order in which they act.
constexpr std::array<std::string_view, 32> kKitParts{"cameraList",
                                                     "lightList",
                                                     "pickStyle",
                                                     "lightModel",
                                                     "environment",
                                                     "drawStyle",
                                                     "material",
                                                     "complexity",
                                                     "texture2",
                                                     "font",
                                                     "appearance",
                                                     "units",
                                                     "transform",
                                                     "texture2Transform",
                                                     "camera",
                                                     "light",
                                                     "icon",
                                                     "childList",
                                                     "materialBinding",
                                                     "normalBinding",
                                                     "textureCoordinateBinding",
                                                     "shapeHints",
                                                     "coordinate3",
                                                     "coordinate4",
                                                     "normal",
                                                     "textureCoordinate2",
                                                     "textureCoordinateFunction",
                                                     "profileCoordinate2",
                                                     "profileList",
                                                     "localTransform",
                                                     "shape",
                                                     "contents"};

}  // namespace

void Reader::kit(const Values& v, State& state) {
  State own = state;
  parts(v, own);
  static const Node kCube = [] {  // the shape of a ShapeKit that has no other
    Node node;
    node.type = "Cube";
    return node;
  }();
  if (v.node().type == "ShapeKit" && !v.has("shape")) visit({&kCube, nullptr}, own);
}

/// An AppearanceKit acts on what follows it, as its parts do.
void Reader::parts(const Values& v, State& state) {
  for (const std::string_view part : kKitParts)
    for (const NodeIn& node : v.nodes(part)) visit(node, state);
}

void Reader::kitList(const Values& v, State& state) {
  for (const NodeIn& container : v.nodes("containerNode")) visit(container, state);
}

}  // namespace trace::inventor

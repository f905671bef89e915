#include "render/rays/visited_boxes.h"

#include "render/rays/tracer.h"

namespace trace {
namespace {

/// The box around all children of the node.
Box3 bounds(const BvhNode& node) {
  Box3 box;
  for (std::size_t lane = 0; lane < 8; ++lane) {
    const auto corner = [&](std::size_t side) {
      return Vec3{node.plane[0][side][lane], node.plane[1][side][lane], node.plane[2][side][lane]};
    };
    if (const Box3 child{corner(0), corner(1)}; !child.empty()) box.extend(child);
  }
  return box;
}

struct Notes {
  const World& world;
  std::vector<VisitedBox> boxes{};

  void note(const BvhNode& node, std::uint32_t owner) {
    const Box3 box = bounds(node);
    const Affine toWorld = owner == NodeWatch::kTop ? Affine{} : world.worldFromObject(owner);
    VisitedBox visited{owner, {}};
    for (unsigned i = 0; i < 8; ++i)
      visited.corners[i] = toWorld * Vec3{i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                                          i & 4 ? box.high.z : box.low.z};
    boxes.push_back(visited);
  }
};

}  // namespace

std::vector<VisitedBox> visitedBoxes(const World& world, const Settings& settings, const RayNode& node) {
  Notes notes{world};
  const auto note = [](void* context, const BvhNode& visited, std::uint32_t owner) {
    static_cast<Notes*>(context)->note(visited, owner);
  };
  Tracer(world, settings).retrace(node, {note, &notes});
  return std::move(notes.boxes);
}

}  // namespace trace

#include "render/chains/record.h"

#include "render/rays/gather.h"

namespace trace::veach {
namespace {

/// The light of the sampled light, by a shadow ray.
void addLight(Gather& sum, const Path& path, const Interaction& at) {
  Tracer& tracer = sum.tracer();
  const PathPlace place(at);
  const auto arriving = tracer.world().illuminate(path.light, place.point(), path.onLight);
  if (!arriving || !(dot(arriving->toLight, arriving->toLight) > 0)) return;
  const Ray ray = place.leave(arriving->toLight);
  const Color all = place.scattered(*arriving),
              passed = tracer.visible(at.hit, ray, arriving->distance, at.inside);
  const Scatter parts = scatter(at.bsdf(), at.frame, arriving->toLight, place.from());
  sum.addLight(path.light, *arriving, parts, all * at.material.shadow, passed);
  if (at.material.shadow < 1)
    sum.addLight(path.light, *arriving, parts, all * (1 - at.material.shadow), Color(1));
}

/// The radiance along the ray that arrives at place i.
Color arriving(const Path& path, std::size_t i, Tracer& tracer, const Ray& ray, Interfaces inside) {
  const World& world = tracer.world();
  const RayKind kind = path.nodes[i - 1].leaves;
  const auto hit = tracer.cast(ray, kind, inside);
  Gather sum(tracer, static_cast<int>(i) - 1);
  const bool isEnd = i == path.last();
  if (isEnd && path.end == Path::End::seen) {
    if (const auto lamp = world.lampAlong(ray, hit ? hit->t : kInfinity)) {
      sum.add(*lamp);
      return sum.radiance(inside.passed(lamp->seen.t));
    }
  }
  if (!hit) {
    if (isEnd && path.end == Path::End::sky) sum.add(Term::Kind::background, path.shines);
    return sum.radiance();
  }
  Interaction at(tracer, ray, *hit, nullptr, inside, 0);
  sum.note(at.bsdf());
  sum.note(at.indices);
  if (isEnd) {
    if (path.end == Path::End::lamp) sum.add(Term::Kind::emissive, at.material.emissive);
    return sum.radiance(inside.passed(hit->t));
  }
  const Node& node = path.nodes[i];
  if (path.end == Path::End::light && i + 1 == path.last()) {
    addLight(sum, path, at);
  } else if (node.leaves == RayKind::bounce) {
    const PathPlace place(at);
    const Vec3& toLight = path.toLight(i);
    const Color light = arriving(path, i + 1, tracer, at.leaveToLight(toLight), place.side(toLight));
    sum.add(termOf(node.leaves), node.factor, light);
  } else if (const auto only = Onward(at, 0).only(node.leaves)) {
    const Color light = arriving(path, i + 1, tracer, hit->leave(only->direction), only->in(inside));
    sum.add(termOf(node.leaves), only->weight, light);
  }
  return sum.radiance(inside.passed(hit->t));
}

}  // namespace

Color record(const Path& path, Tracer& tracer) {
  const Interfaces inside = tracer.interfacesAt(path.ray.origin);
  if (path.nodes.size() > 1) return arriving(path, 1, tracer, path.ray, inside);
  Interfaces there = inside;
  tracer.cast(path.ray, RayKind::camera, there);
  return Gather(tracer, 0).radiance();
}

}  // namespace trace::veach

// Facts that lint finds by tracing rays: which object is inside which, and where a light shines.
#pragma once

#include <cstdint>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "render/world/world.h"

namespace trace {

struct LightGeometry;

/// The objects that enclose the point on all sides: a ray from it crosses each an odd number of times, in
/// every one of many directions. So an open surface encloses nothing.
std::vector<std::uint32_t> objectsAround(const World& world, const Vec3& point);

/// The object closes off the environment the point: the one crossing that a ray from there has with it is the
/// last with anything; so in half of many directions or more, and in the others it is not hit. Spheres and
/// boxes that enclose the point do, and so do domes, and infinite planes.
bool isShell(const World& world, std::uint32_t object, const Vec3& point);

/// The most light that arrives at anything around the point where the light stands.
Real strongestAround(const World& world, const Light& light, const Vec3& position);

/// Something is in the cone of the light, near or far.
bool shinesOnSomething(const World& world, const LightGeometry& light);

/// The share of a mesh's faces whose front looks to the inside of the mesh: seen from there, the ray comes
/// through an odd number of the mesh's surfaces. 0 for open surfaces.
double shareInsideOut(const World& world, std::uint32_t object, const MeshData& mesh);

/// Every crossing of the ray once, nearest first.
std::vector<Found> allCrossings(const World& world, const Ray& ray, Real tMost);

}  // namespace trace

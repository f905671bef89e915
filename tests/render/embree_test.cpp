// Our closest and any hits against Embree's robust mode, where Embree is installed (Debian libembree-dev). It
// is an oracle here and a yardstick in bench/, never part of the program.
#include <gtest/gtest.h>

#include "geometry/mesh/mesh.h"
#include "support/scenes.h"

#if defined(TRACE_HAS_EMBREE)
#include <embree3/rtcore.h>
#endif

namespace trace::test::embree_test {
namespace {

#if defined(TRACE_HAS_EMBREE)

class EmbreeMesh {
 public:
  explicit EmbreeMesh(const MeshData& mesh)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<Vec3f*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f), mesh.points.size()));
    std::copy(mesh.points.begin(), mesh.points.end(), points);
    auto* triangles = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(Triangle), mesh.triangles.size()));
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeMesh() { rtcReleaseScene(scene_), rtcReleaseDevice(device_); }
  EmbreeMesh(const EmbreeMesh&) = delete;
  EmbreeMesh& operator=(const EmbreeMesh&) = delete;

  /// The distance to the nearest hit, or infinity.
  float closest(const Ray& ray) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const Vec3f o(ray.origin), d(ray.direction);
    RTCRayHit hit{};
    hit.ray = {o.x, o.y, o.z, 0, d.x, d.y, d.z, 0, std::numeric_limits<float>::infinity(), ~0u, 0, 0};
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene_, &context, &hit);
    return hit.ray.tfar;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

TEST(Embree, FindsTheSameHits) {
  if (kSanitized) GTEST_SKIP() << "SKIPPED: Embree is not built for the sanitizers";
  Random random(1);
  int hits = 0, rays = 0, differ = 0;
  for (double scale : {1e-4, 1.0, 1e4}) {
    auto mesh = ballMesh(60, random);
    addNeedles(*mesh, random);
    for (Vec3f& p : mesh->points) p = Vec3f(Vec3(p) * scale);
    const EmbreeMesh oracle(*mesh);
    Scene scene;
    addObject(scene, Mesh{mesh}, {}, {});
    const World world = build(scene);
    Statistics statistics;
    for (int i = 0; i < 100000; ++i, ++rays) {
      // Both get the same ray: what floats can hold.
      const Ray ray{Vec3(Vec3f(random.inCube(3 * scale))), Vec3(Vec3f(random.direction()))};
      const auto found = world.closest(ray, Faces::both, statistics);
      const double ours = found ? found->t : kInfinity, theirs = oracle.closest(ray);
      const bool any = [&] {
        bool met = false;
        world.crossings(ray, kInfinity, Faces::both, statistics, [&](const Found&) { return met = true; });
        return met;
      }();
      EXPECT_EQ(any, found.has_value());
      hits += found.has_value();
      if (std::isinf(ours) != std::isinf(theirs) ||
          (found && std::abs(ours - theirs) > 1e-4 * (ours + scale)))
        ++differ;
    }
  }
  EXPECT_GT(hits, rays / 20);
  EXPECT_LE(differ, 1e-5 * rays) << "of " << rays;
}

#else

TEST(Embree, FindsTheSameHits) { GTEST_SKIP() << "SKIPPED: needs Embree 3 (Debian libembree-dev)"; }

#endif

}  // namespace
}  // namespace trace::test::embree_test

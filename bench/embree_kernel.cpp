// The yardstick: Embree 3's calls for single rays and for coherent packets of eight, at default build quality
// on one thread; robust is its watertight triangle test.
#include <embree3/rtcore.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "kernel.h"
#include "stopwatch.h"

namespace trace::bench {
namespace {

class EmbreeKernel : public Kernel {
 public:
  EmbreeKernel(const MeshHandle& mesh, EmbreeMode mode, const std::string& config)
      : device_(rtcNewDevice(("threads=1," + config).c_str())) {
    if (!device_) throw std::runtime_error("Embree does not start");
    rtcSetDeviceMemoryMonitorFunction(
        device_,
        [](void* held, ssize_t change, bool) {
          return *static_cast<double*>(held) += static_cast<double>(change), true;
        },
        &held_);
    scene_ = rtcNewScene(device_);
    if (mode == EmbreeMode::robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);

    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    fill(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh->points);
    fill(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh->triangles);
    const double buffers = held_, begin = processSeconds();
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    buildSeconds = processSeconds() - begin;
    bytes = held_ - buffers;
    if (rtcGetDeviceError(device_) != RTC_ERROR_NONE)
      throw std::runtime_error("Embree cannot build this mesh");
  }
  EmbreeKernel(const EmbreeKernel&) = delete;
  EmbreeKernel& operator=(const EmbreeKernel&) = delete;
  ~EmbreeKernel() override {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  void closest(std::span<const BenchRay> rays, std::span<Answer> answers) const override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRayHit query;
      query.ray = record(rays[i]);
      query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene_, &context, &query);
      answers[i] =
          query.hit.geomID != RTC_INVALID_GEOMETRY_ID ? Answer{query.ray.tfar, query.hit.primID} : Answer{};
    }
  }

  void closestOfPackets(std::span<const BenchRay> rays, std::span<Answer> answers) const override {
    constexpr std::size_t kRays = 8;
    alignas(32) static constexpr int kAll[kRays] = {-1, -1, -1, -1, -1, -1, -1, -1};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t first = 0; first < rays.size(); first += kRays) {
      RTCRayHit8 query;
      for (std::size_t i = 0; i < kRays; ++i) {
        const RTCRay ray = record(rays[first + i]);
        query.ray.org_x[i] = ray.org_x, query.ray.org_y[i] = ray.org_y, query.ray.org_z[i] = ray.org_z;
        query.ray.dir_x[i] = ray.dir_x, query.ray.dir_y[i] = ray.dir_y, query.ray.dir_z[i] = ray.dir_z;
        query.ray.tnear[i] = ray.tnear, query.ray.tfar[i] = ray.tfar;
        query.ray.time[i] = 0, query.ray.mask[i] = ray.mask, query.ray.id[i] = 0, query.ray.flags[i] = 0;
        query.hit.geomID[i] = query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect8(kAll, scene_, &context, &query);
      for (std::size_t i = 0; i < kRays; ++i)
        answers[first + i] = query.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID
                                 ? Answer{query.ray.tfar[i], query.hit.primID[i]}
                                 : Answer{};
    }
  }

  void anyHit(std::span<const BenchRay> rays, std::span<Answer> answers) const override {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      RTCRay query = record(rays[i]);
      rtcOccluded1(scene_, &context, &query);
      answers[i] = query.tfar < 0 ? Answer{0, 0} : Answer{};
    }
  }

 private:
  static RTCRay record(const BenchRay& ray) {
    RTCRay r;
    r.org_x = ray.origin.x, r.org_y = ray.origin.y, r.org_z = ray.origin.z;
    r.dir_x = ray.direction.x, r.dir_y = ray.direction.y, r.dir_z = ray.direction.z;
    r.tnear = ray.tMin, r.tfar = ray.tMax;
    r.time = 0, r.mask = std::numeric_limits<unsigned>::max(), r.id = 0, r.flags = 0;
    return r;
  }

  template <class T>
  static void fill(RTCGeometry geometry, RTCBufferType type, RTCFormat format, const std::vector<T>& values) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), values.size());
    std::copy(values.begin(), values.end(), static_cast<T*>(buffer));
  }

  double held_ = 0;
  RTCDevice device_;
  RTCScene scene_ = nullptr;
};

}  // namespace

std::unique_ptr<Kernel> embreeKernel(const MeshHandle& mesh, EmbreeMode mode, const std::string& config) {
  return std::make_unique<EmbreeKernel>(mesh, mode, config);
}

}  // namespace trace::bench

// Builds every kernel over a mesh and measures them on the same rays, in turn, in one process: only ratios
// within one run mean something on a machine that others use too.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace trace::bench {

/// In the order of the columns. What is compared with: embree; what tells right from wrong: robust.
inline constexpr std::array<std::string_view, 3> kKernelNames{"world", "embree", "robust"};
enum KernelIndex { world, embree, robust };
template <class T>
using PerKernel = std::array<T, kKernelNames.size()>;

struct Samples {
  std::vector<double> values;
  double median() const;
  double largest() const;
  double spread() const;  ///< largest / smallest
};

struct KindReport {
  std::string_view kind;
  std::size_t rays = 0;
  double hitShare = 0;
  PerKernel<Samples> mrays;        ///< millions of rays per second of CPU time
  PerKernel<double> hitsDiffer{};  ///< share of rays that hit for one and miss for the other, against robust
  PerKernel<double> distancesDiffer{};  ///< share whose distance differs by more than 1e-4 of itself
};

struct MeshReport {
  std::string mesh;
  std::size_t triangles = 0;
  int size = 0;
  PerKernel<Samples> buildSeconds;
  PerKernel<double> bytesPerTriangle{};
  std::vector<KindReport> kinds;
};

struct Plan {
  int passes = 5;
  double scale = 1;  ///< scale of the mesh and its view
  int size = 0;      ///< pixels on a side; 0 takes the view's
  int builds = 3;
  std::string embree{};        ///< configuration of its device
  std::string instructions{};  ///< kernel for the mesh alone; empty: the World, by its best
};

/// Measures the mesh, resized to about so many triangles if that is not 0.
MeshReport measure(const std::string& path, const Plan& plan, std::size_t triangles = 0);

}  // namespace trace::bench

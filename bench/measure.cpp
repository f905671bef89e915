#include "measure.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "kernel.h"
#include "ply.h"
#include "resize.h"
#include "stopwatch.h"

namespace trace::bench {
namespace {

constexpr double kLeastSeconds = 0.03;  // a measurement repeats short ray sets until it has taken this long

using Kernels = PerKernel<std::unique_ptr<Kernel>>;

std::unique_ptr<Kernel> build(int index, const MeshHandle& mesh, const Plan& plan) {
  if (index == world)
    return plan.instructions.empty() ? worldKernel(mesh) : meshKernel(mesh, plan.instructions);
  return embreeKernel(mesh, index == robust ? EmbreeMode::robust : EmbreeMode::standard, plan.embree);
}

double mraysPerSecond(const Kernel& kernel, const RaySet& set, std::span<Answer> answers) {
  double spent = 0, rays = 0;
  while (spent < kLeastSeconds) {
    const double begin = threadSeconds();
    kernel.answer(set, answers);
    spent += threadSeconds() - begin, rays += static_cast<double>(set.rays.size());
  }
  return rays / spent / 1e6;
}

bool farApart(float a, float b) { return std::abs(a - b) > 1e-4f * std::max(a, b); }

KindReport measureKind(const Kernels& kernels, const RaySet& set, int passes) {
  KindReport report{.kind = set.kind, .rays = set.rays.size(), .mrays = {}};
  const double count = static_cast<double>(set.rays.size());
  PerKernel<std::vector<Answer>> answers;
  for (int k = robust; k >= 0; --k) {  // also warms caches and maps pages before anything is measured
    answers[k].resize(set.rays.size());
    kernels[k]->answer(set, answers[k]);
    double hits = 0, hitsDiffer = 0, distancesDiffer = 0;
    for (std::size_t i = 0; i < set.rays.size(); ++i) {
      const Answer &mine = answers[k][i], &right = answers[robust][i];
      hits += right.hit();
      if (mine.hit() != right.hit())
        ++hitsDiffer;
      else if (right.hit() && farApart(mine.t, right.t))
        ++distancesDiffer;
    }
    report.hitShare = hits / count;
    report.hitsDiffer[k] = hitsDiffer / count, report.distancesDiffer[k] = distancesDiffer / count;
  }
  for (int pass = 0; pass < passes; ++pass)
    for (int k = 0; k <= robust; ++k)
      report.mrays[k].values.push_back(mraysPerSecond(*kernels[k], set, answers[k]));
  return report;
}

}  // namespace

double Samples::median() const {
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  return n == 0 ? 0 : (sorted[(n - 1) / 2] + sorted[n / 2]) / 2;
}

double Samples::largest() const {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

double Samples::spread() const {
  if (values.empty()) return 0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high / *low;
}

MeshReport measure(const std::string& path, const Plan& plan, std::size_t triangles) {
  MeshData read = readPly(path, plan.scale);
  if (triangles > 0) read = resized(read, triangles);
  const auto mesh = std::make_shared<const MeshData>(std::move(read));
  MeshReport report;
  report.mesh = std::filesystem::path(path).stem().string();
  report.triangles = mesh->triangles.size();

  Kernels kernels;
  for (int pass = 0; pass < plan.builds; ++pass)
    for (int k = 0; k <= robust; ++k) {
      kernels[k].reset();
      kernels[k] = build(k, mesh, plan);
      report.buildSeconds[k].values.push_back(kernels[k]->buildSeconds);
      report.bytesPerTriangle[k] = kernels[k]->bytes / static_cast<double>(report.triangles);
    }

  View view = viewOf(report.mesh, bounds(*mesh), plan.scale);
  if (plan.size > 0) view.size = plan.size;
  report.size = view.size;
  const RaySet primary{"primary", false, primaryRays(view)};
  report.kinds.push_back(measureKind(kernels, primary, plan.passes));
  RaySet packets{"primary_packets", false, primary.rays, true};
  packets.rays.resize(packets.rays.size() / 8 * 8);
  report.kinds.push_back(measureKind(kernels, packets, plan.passes));
  std::vector<Answer> answers(primary.rays.size());
  kernels[robust]->closest(primary.rays, answers);
  for (const RaySet& set : secondaryRays(view, *mesh, primary.rays, answers))
    if (!set.rays.empty()) report.kinds.push_back(measureKind(kernels, set, plan.passes));
  return report;
}

}  // namespace trace::bench

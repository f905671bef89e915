// How good pictures of the integrators are for their time, on scenes where light is easy and hard to find:
// CPU seconds times the relative error, on one thread. Prints a Markdown table; `bench_paths FOLDER [WIDTH]`
// has the scenes of that folder, 96 pixels wide by default.
//
// The error is that against a picture by chains of very many samples, the mean of four seeds: of each pixel's
// luminance the square of the difference over reference^2 + 0.01 (mean of the reference)^2, averaged over the
// pixels; and over all but the hundredth that is worst, which is that of rare bright paths.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "image/srgb.h"

namespace trace {
namespace {

constexpr int kSeeds = 4;

struct Case {
  const char* scene;
  const char* depth;
  /// The samples are chosen so that all take about as long.
  std::vector<std::pair<const char*, int>> integrators;
};

const std::vector<Case> kCases{
    {"cornell.ray", "8", {{"path", 64}, {"bdpt", 24}, {"mlt", 48}, {"photon", 32}}},
    {"door.ray", "8", {{"path", 64}, {"bdpt", 24}, {"mlt", 48}, {"photon", 32}}},
    {"uplight.ray", "8", {{"path", 64}, {"bdpt", 24}, {"mlt", 48}, {"photon", 32}}},
};

struct Measured {
  double seconds = 0;  ///< seconds of a picture
  double error = 0, errorOfMost = 0, mean = 0;
};

Picture rendered(const std::string& file, const Case& c, const char* integrator, int samples, int width,
                 int seed, double& seconds) {
  Session session;
  session.open(file, std::vector<Choice>{{"integrator", integrator, {}},
                                         {"spp", std::to_string(samples), {}},
                                         {"width", std::to_string(width), {}},
                                         {"seed", std::to_string(seed), {}},
                                         {"depth", c.depth, {}},
                                         {"firefly-limit", "0", {}},
                                         {"threads", "1", {}}});
  const std::clock_t start = std::clock();
  session.build();
  session.renderPicture();
  seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return session.picture();
}

Measured measure(const std::string& file, const Case& c, const char* integrator, int samples, int width,
                 const Picture& reference) {
  Measured result;
  const std::size_t pixels = reference.pixels.size();
  double bright = 0;
  for (const Color& color : reference.pixels) bright += luminanceOf(color) / static_cast<double>(pixels);
  std::vector<double> errors(pixels);
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Picture picture = rendered(file, c, integrator, samples, width, seed, result.seconds);
    for (std::size_t i = 0; i < pixels; ++i) {
      const double wanted = luminanceOf(reference.pixels[i]), found = luminanceOf(picture.pixels[i]);
      result.mean += found / static_cast<double>(pixels * kSeeds);
      errors[i] += (found - wanted) * (found - wanted) / (wanted * wanted + 0.01 * bright * bright) / kSeeds;
    }
  }
  result.seconds /= kSeeds;
  std::sort(errors.begin(), errors.end());
  const std::size_t most = pixels - pixels / 100;
  for (std::size_t i = 0; i < pixels; ++i) {
    result.error += errors[i] / static_cast<double>(pixels);
    if (i < most) result.errorOfMost += errors[i] / static_cast<double>(most);
  }
  return result;
}

int run(const std::string& folder, int width) {
  std::printf("| scene | integrator | samples | mean | CPU s | error | s x error | of 99 %% |\n");
  std::printf("|---|---|--:|--:|--:|--:|--:|--:|\n");
  for (const Case& c : kCases) {
    const std::string file = folder + "/" + c.scene;
    constexpr int kMany = 2048, kOwnSeed = 99;
    double ignored = 0;
    const Picture reference = rendered(file, c, "mlt", kMany, width, kOwnSeed, ignored);
    for (const auto& [integrator, samples] : c.integrators) {
      const Measured m = measure(file, c, integrator, samples, width, reference);
      std::printf("| %s | %s | %d | %.4f | %.2f | %.4g | %.4g | %.4g |\n", c.scene, integrator, samples,
                  m.mean, m.seconds, m.error, m.seconds * m.error, m.seconds * m.errorOfMost);
      std::fflush(stdout);
    }
  }
  return 0;
}

}  // namespace
}  // namespace trace

int main(int count, char** arguments) {
  if (count < 2) {
    std::fprintf(stderr, "bench_paths: expected the folder of scenes\n");
    return 2;
  }
  return trace::run(arguments[1], count > 2 ? std::atoi(arguments[2]) : 96);
}

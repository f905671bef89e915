// Every scene that we ship, rendered very small by every integrator: nothing breaks, and no sample is other
// than finite. What the sanitizers look for stands in the ways that scenes take through the program.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/session/session.h"
#include "render/samples/integrator.h"
#include "support/opened.h"
#include "support/paths.h"

namespace trace::test {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> shippedScenes() {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(sourceFolder() + "/scenes"))
    // A million instances take seconds to read; city.ray has a hundred thousand.
    if (entry.is_regular_file() && entry.path().filename() != "forest.ray")
      files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

void renderByAll(const std::string& file) {
  Session read;
  read.open(file, {});
  std::unique_ptr<Session> before;  // whose world the next one shares
  for (const IntegratorRow& row : integrators()) {
    SCOPED_TRACE(file + " by " + std::string(row.name));
    const std::vector<Choice> choices{{"width", "16", {}},    {"height", "12", {}},
                                      {"spp", "1", {}},       {"threads", "2", {}},
                                      {"photons", "500", {}}, {"chain-starts", "200", {}},
                                      {"denoise", "off", {}}, {"integrator", std::string(row.name), {}}};
    auto session = std::make_unique<Session>();
    openAgain(*session, read, choices);
    session->build(before.get());
    const RenderResult result = session->renderPicture();
    EXPECT_EQ(result.end, End::finished) << result.failure;
    EXPECT_EQ(result.statistics.badSamples, 0u);
    before = std::move(session);
  }
}

constexpr std::size_t kParts = 8;

class EveryScene : public testing::TestWithParam<std::size_t> {};

TEST_P(EveryScene, IsRenderedByEveryIntegrator) {
  const std::vector<std::string> files = shippedScenes();
  ASSERT_GT(files.size(), 80u);
  for (std::size_t i = GetParam(); i < files.size(); i += kParts) renderByAll(files[i]);
}

INSTANTIATE_TEST_SUITE_P(Parts, EveryScene, testing::Range(std::size_t{0}, kParts));

/// For a short look: lights, media, glass, holes, subdivided and moving things, fractals, meshes and other
/// formats.
TEST(EverySceneOf, TenIsRenderedByEveryIntegrator) {
  for (const char* name : {"caustics.ray", "cloud.ray", "csg.ray", "fractals.ray", "holes.ray", "lights.ray",
                           "marbles.out", "mesh.ray", "motion.ray", "subsurface.ray"})
    renderByAll(sourceFolder() + "/scenes/" + name);
}

}  // namespace
}  // namespace trace::test

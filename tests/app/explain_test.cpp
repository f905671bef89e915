// The rays that are explained are the picture's: for every sample, in our scenes and the courses', under
// every option.
#include <gtest/gtest.h>

#include <cstring>

#include "app/explain/explained_rays.h"
#include "app/explain/ray_segments.h"
#include "app/session/session.h"
#include "app/view/drawing.h"
#include "app/view/ray_drawing.h"
#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "render/rays/visited_boxes.h"
#include "support/folder.h"
#include "support/paths.h"
#include "support/shared.h"

namespace trace::test {
namespace {

bool sameBits(const Color& a, const Color& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

/// Sums are held to the picture, however little light there is.
constexpr const char* kFewPhotons = "2000";

/// Renders a small picture and explains every sample of its pixels; returns the number of rays explained.
/// `before`, if any, is a build of the same scene: what is the same is shared.
std::size_t explainAll(const std::string& file, std::vector<Choice> choices, int width,
                       const Session* before = nullptr) {
  choices.insert(choices.begin(), {"width", std::to_string(width), {}});
  choices.insert(choices.begin(), {"depth", "4", {}});
  choices.insert(choices.begin(), {"photons", kFewPhotons, {}});
  std::optional<Session> opened(std::in_place);
  opened->open(file, choices);
  if (hasTrait(opened->settings(),
               Trait::byChains)) {  // whose pixels have no samples: the command explains path's
    choices.push_back({"integrator", "path", {}});
    opened.emplace().open(file, choices);
  }
  if (opened->settings().caustics > 0) {
    choices.push_back({"caustics", kFewPhotons, {}});
    opened.emplace().open(file, choices);
  }
  Session& session = *opened;
  session.build(before);
  session.renderPicture();
  const Film& film = session.film();
  std::size_t rays = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      for (int k = 0, all = 1; k < all; ++k) {
        const Explanation e = session.explain(x, y, k);
        all = static_cast<int>(e.samples.size());
        const Color& sample = e.samples[static_cast<std::size_t>(k)];
        if (!sameBits(e.pixel, film.ofSamples(x, y)) || !sameBits(e.tree.nodes[0].radiance, sample) ||
            !sumsUp(e.tree)) {
          ADD_FAILURE() << file << " pixel " << x << "," << y << " sample " << k;
          return rays;
        }
        if (e.corners.empty()) {  // else the pixel is the mean of its squares
          Color sum;
          for (std::size_t i = 0; i < e.samples.size(); ++i) sum += e.samples[i] * e.weights[i];
          EXPECT_TRUE(sameBits(sum / static_cast<double>(e.samples.size()), e.pixel)) << file;
        }
        rays += e.tree.nodes.size();
      }
  return rays;
}

/// In every format of which there are some.
std::vector<std::string> examples() {
  std::vector<std::string> files;
  for (const SceneFormat& format : sceneFormats())
    for (const std::string_view suffix : format.suffixes)
      for (const std::string& file : filesUnder(test::sourceFolder() + "/scenes", std::string(suffix)))
        if (file.find("/meshes/") == std::string::npos) files.push_back(file);
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

TEST(Explain, EverySampleOfOurScenesSumsToThePicture) {
  EXPECT_GT(examples().size(), 26u);
  for (const std::string& scene : examples())
    EXPECT_GT(explainAll(scene, {{"spp", "4", {}}}, 14), 400u) << scene;
}

/// A value for the option that is not its default, and that a small picture shows in a moment.
std::vector<std::string> valuesOf(const Option& option) {
  switch (option.kind) {
    case Option::Kind::boolean: return {"on", "off"};
    case Option::Kind::choice: return {option.choices.begin(), option.choices.end()};
    case Option::Kind::integer:
      return {std::to_string(static_cast<int>(std::clamp(3.0, option.least, option.most)))};
    case Option::Kind::real: return {std::to_string(std::clamp(0.25, option.least, option.most))};
    case Option::Kind::choices:
      return {std::string(option.choices.front()), std::string(option.choices.back())};
    case Option::Kind::color: return {"0.5,0.25,1"};
    case Option::Kind::region: return {};
    case Option::Kind::file: return {test::sourceFolder() + "/scenes/pictures/dusk.png"};
    case Option::Kind::place: return {"0,0,0"};
  }
  return {};
}

TEST(Explain, EverySampleSumsToThePictureUnderEveryOption) {
  for (const char* scene : {"conventions.ray", "glass.ray", "mesh.ray"}) {
    const std::string file = test::sourceFolder() + "/scenes/" + scene;
    Session before;
    before.open(file, {});
    before.build();
    for (const Option& option : options()) {
      if (option.name == "width" || option.name == "height" || option.name == "time-limit") continue;
      for (const std::string& value : valuesOf(option)) {
        SCOPED_TRACE(std::string(option.name) + " = " + value);
        EXPECT_GT(explainAll(file, {{std::string(option.name), value, {}}, {"spp", "1", {}}}, 14, &before),
                  80u);
      }
    }
  }
}

TEST(Explain, EverySampleOfTheCoursesScenesSumsToThePicture) {
  const ReadScope allowed({test::sharedFolder() + "/scenes"});
  TRACE_NEEDS_SHARED("scenes/uw");
  const std::vector<std::string> all = filesUnder(test::sharedFolder() + "/scenes/uw", ".ray");
  int explained = 0;
  for (std::size_t i = 0; i < all.size(); i += all.size() / 25 + 1) {
    try {
      explainAll(all[i], {}, 12);
      ++explained;
    } catch (const Error&) {  // a broken scene
    }
  }
  EXPECT_GT(explained, 10);
}

/// The middle of a ball of glass.
Explanation ofGlass(Session& session) {
  session.open(test::sourceFolder() + "/scenes/glass.ray", {});
  session.build();
  return session.explain(200, 120, 0);
}

TEST(Explain, SegmentsRunFromRayToHitAndObjHoldsThemAll) {
  Session session;
  const RayTree tree = ofGlass(session).tree;
  const std::vector<RaySegment> segments = raySegments(tree);
  ASSERT_EQ(segments.size(), tree.nodes.size());
  for (const RaySegment& segment : segments) {
    const RayNode& node = tree.nodes[static_cast<std::size_t>(segment.node)];
    EXPECT_EQ(segment.from, node.ray.origin);
    if (node.hit) {
      EXPECT_LT(length(segment.to - node.hit->surface.point), 1e-9);
    }
    EXPECT_EQ(segment.leaves, !node.hit && node.kind != RayKind::shadow);
  }
  const std::string obj = raysAsObj(tree, explainedRays(tree, session.scene()));
  const auto count = [&](const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = obj.find(what); at != std::string::npos; at = obj.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("\nl "), segments.size());
  EXPECT_EQ(count("\nv "), 2 * segments.size());
  for (const char* group : {"camera", "reflection", "refraction", "shadow-lit"})
    EXPECT_EQ(count(std::string("\ng ") + group + "\n"), 1u) << group;
}

TEST(Explain, TheDrawingShowsEveryColourOfItsRays) {
  Session session;
  const RayTree tree = ofGlass(session).tree;
  const Drawing drawing = drawRays(session.scene(), session.settings(), session.world(), tree);
  const Picture picture = toPicture(drawing);
  ASSERT_EQ(picture.width, drawing.width);
  for (const RaySegment& segment : raySegments(tree)) {
    const Color& color = look(segment.looks).color;
    const auto pixels = std::count(picture.pixels.begin(), picture.pixels.end(), color);
    EXPECT_GT(pixels, 150) << look(segment.looks).name;  // the legend has 90
  }
  std::string svg = toSvg(drawing);
  EXPECT_EQ(svg.find("<svg "), 0u);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
  for (std::size_t at; (at = svg.find("base64,")) != std::string::npos;)  // holds any three letters by chance
    svg.erase(at, svg.find('"', at) - at);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

// The views of a drawing are small renders of their own, with the settings of the picture: those that change
// what rays bring. Those of a wide picture have the fewest pixels.
TEST(Explain, EveryOptionHasADrawing) {
  const Folder folder;
  std::string scene = readFile(test::sourceFolder() + "/scenes/mesh.ray");
  scene.replace(scene.find("aspectratio = 2"), 15, "aspectratio = 20");
  writeFile(folder / "wide.ray", scene);
  Session before;
  before.open(folder / "wide.ray", {});
  before.build();
  for (const Option& option : options()) {
    if (option.name == "width" || option.name == "height" || option.repeats < Repeats::picture) continue;
    for (const std::string& value : valuesOf(option)) {
      SCOPED_TRACE(std::string(option.name) + " = " + value);
      const std::vector<Choice> choices{
          {"width", "40", {}}, {"photons", kFewPhotons, {}}, {std::string(option.name), value, {}}};
      Session session;
      session.open(folder / "wide.ray", choices);
      session.build(&before);
      const RayTree tree = session.explain(20, session.size().height / 2, 0).tree;
      EXPECT_GT(drawRays(session.scene(), session.settings(), session.world(), tree).things.size(), 10u);
    }
  }
}

TEST(Drawing, CoversPixelsByArea) {
  Drawing drawing{9, 9, {DrawnLine{{0, 4.5}, {9, 4.5}, Color(0), 1, false}}};
  const Picture line = toPicture(drawing);
  EXPECT_EQ(line.at(4, 4), Color(0));
  EXPECT_EQ(line.at(4, 3), Color(1));
  drawing.things = {DrawnFrame{{0, 0}, 4, 9}, DrawnDisk{{4, 4}, 2, Color(0)}};
  const Picture half = toPicture(drawing);
  EXPECT_EQ(half.at(3, 4), Color(0));
  EXPECT_EQ(half.at(4, 4), Color(1)) << "outside the frame";
  drawing.things = {DrawnWords{{0, 0}, "i", Color(0), 12}};
  const Picture words = toPicture(drawing);
  EXPECT_GT(std::count_if(words.pixels.begin(), words.pixels.end(), [](const Color& c) { return c.r < 0.6; }),
            3);
}

TEST(Drawing, SvgEscapesWords) {
  const Drawing drawing{9, 9, {DrawnWords{{0, 0}, "a<b & \"c\"\x01", Color(0)}}};
  EXPECT_NE(toSvg(drawing).find(">a&lt;b &amp; \"c\"_</text>"), std::string::npos);
}

}  // namespace
}  // namespace trace::test

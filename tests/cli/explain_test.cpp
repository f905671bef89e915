// ray explain and ray lint, as users meet them.
#include <gtest/gtest.h>

#include <array>
#include <list>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "app/explain/explain_json.h"
#include "app/explain/explain_text.h"
#include "app/explain/explained_rays.h"
#include "app/session/session.h"
#include "app/view/drawing.h"
#include "app/view/ray_drawing.h"
#include "base/files/file.h"
#include "base/sanitized.h"
#include "cli/program.h"
#include "image/codecs/codec.h"
#include "support/folder.h"
#include "support/opened.h"
#include "support/paths.h"
#include "support/shared.h"

namespace trace::test {
namespace {

using nlohmann::json;

const std::string kScenes = test::sourceFolder() + "/scenes/";
const std::string kLint = test::sourceFolder() + "/tests/corpus/lint/";

struct Explain : testing::Test {
  test::Folder folder;
  /// Runs `ray` with the words; fails the test on another exit code.
  std::string out(std::vector<std::string> words, int code = 0) {
    Program program(folder.path(), std::move(words));
    EXPECT_EQ(program.wait(), code) << program.err();
    return program.out();
  }
  std::string error(std::vector<std::string> words, int code) {
    Program program(folder.path(), std::move(words));
    EXPECT_EQ(program.wait(), code);
    return program.err();
  }
};

TEST_F(Explain, NamesTheCallsThatMadeAnObject) {
  writeFile(folder / "poles.ray",
            "Trace 1\ncamera { position = (1, 0, 9); look_at = (1, 0, 0); fov = 40 }\n"
            "define pole(high) { scale(0.4, high, 0.4) { box { } } }\n"
            "for i in 0..2 { translate(i, 0, 0) { pole(i + 1) } }\n");
  const std::vector<std::string> pixel{"--pixel", "20,15", "-w", "40", "--quality", "draft"};
  const auto of = [&](const char* scene) {
    std::vector<std::string> words{"explain", scene};
    words.insert(words.end(), pixel.begin(), pixel.end());
    return out(words);
  };
  const std::string one = of("poles.ray");
  EXPECT_NE(one.find("made in pole(high = 2) at poles.ray:4:38, in i = 1 at poles.ray:4:1"), one.npos) << one;
  std::vector<std::string> words{"explain", "poles.ray", "--format", "json"};
  words.insert(words.end(), pixel.begin(), pixel.end());
  EXPECT_EQ(nlohmann::json::parse(out(words)).at("made"),
            "in pole(high = 2) at poles.ray:4:38, in i = 1 at poles.ray:4:1");
  writeFile(folder / "pole.ray", "Trace 1\nlet high = 2\nscale(0.4, high, 0.4) { box { } }\n");
  EXPECT_EQ(of("pole.ray").find("made in"), std::string::npos);
}

TEST_F(Explain, NamesTheCallsThatPlacedAGroup) {
  writeFile(folder / "pair.ray",
            "Trace 1\ncamera { position = (1, 0, 9); look_at = (1, 0, 0); fov = 40 }\n"
            "define pair() { scale(0.4) { sphere { } } translate(0, 1, 0) { scale(0.2) { sphere { } } } }\n"
            "for i in 0..2 { translate(i, 0, 0) { pair() } }\n");
  for (const auto& [pixel, calls] :
       {std::pair{"20,15", "in i = 1 at pair.ray:4:1"}, std::pair{"25,15", "in i = 2 at pair.ray:4:1"}}) {
    const std::string text = out({"explain", "pair.ray", "--pixel", pixel, "-w", "40", "--quality", "draft"});
    EXPECT_NE(text.find(calls), text.npos) << text;
    const json all = json::parse(
        out({"explain", "pair.ray", "--pixel", pixel, "-w", "40", "--quality", "draft", "--format", "json"}));
    EXPECT_NE(all.at("made").get<std::string>().find(calls), std::string::npos) << all.at("made");
  }
}

TEST_F(Explain, TextTellsEveryRayAndThatTheSumIsThePicture) {
  const std::string text = out({"explain", kScenes + "glass.ray", "--pixel", "200,120", "--sample=3"});
  for (const char* words :
       {"pixel 200,120 of 400 x 250, sample 3 of 4", "#0 camera ray", "reflection ray", "refraction ray",
        "shadow ray to point_light (glass.ray:16)", "index 1.0003 -> 1.5", "depth limit 5 reached",
        "left the scene: background", "The rays above sum to the picture's pixel, bit for bit."})
    EXPECT_NE(text.find(words), std::string::npos) << words;
  EXPECT_EQ(text.find('\033'), std::string::npos) << "colours without a terminal";
  std::size_t longest = 0, begin = 0;  // without the margin
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    longest = std::max(longest, end - std::min(end, text.find_first_not_of("|+- ", begin)));
  EXPECT_LE(longest, 100u);
}

TEST_F(Explain, TermsStandInTheOrderOfTheirSize) {
  // Three lights: the second is the brightest; the highlight of the third is far away and its diffuse part 0.
  const std::string scene = folder / "terms.ray";
  writeFile(scene, R"(SBT-raytracer 1.0
camera { position = (0, 0, 5); viewdir = (0, 0, -1); updir = (0, 1, 0); }
ambient_light { color = (0.1, 0.1, 0.1); }
directional_light { name = "weak"; direction = (0, 0, -1); color = (0.2, 0.2, 0.2); }
directional_light { name = "strong"; direction = (0, 0, -1); color = (0.9, 0.9, 0.9); }
directional_light { name = "speck"; direction = (0, 0, -1); color = (1e-45, 1e-45, 1e-45); }
scale(9, square { material = { ambient = (1, 1, 1); diffuse = (0.5, 0.5, 0.5); } })
)");
  const std::vector<std::string> command{"explain", scene, "-w", "9", "--pixel", "4,4"};
  const std::string text = out(command);
  std::size_t last = 0;
  for (const char* words : {"+ strong 0.45", "+ ambient 0.1", "+ weak 0.1", "+ emissive 0",
                            "+ 1 term below the last digit of the sum, of #3", "= 0.65\n"}) {
    const std::size_t at = text.find(words);
    ASSERT_NE(at, std::string::npos) << words << "\n" << text;
    EXPECT_GT(at, last) << words << "\n" << text;
    last = at;
  }
  EXPECT_EQ(text.find("+ speck"), std::string::npos) << text;
  EXPECT_NE(text.find("#3 shadow ray to speck"), std::string::npos) << "its ray is listed";
  EXPECT_NE(text.find("sum to the picture's pixel, bit for bit"), std::string::npos);
  // JSON has every term, in the order of the equation.
  std::vector<std::string> words = command;
  words.insert(words.end(), {"--format", "json"});
  const json ray = json::parse(out(words))["rays"][0];
  std::vector<double> values;
  for (const json& term : ray["terms"]) values.push_back(term["factor"][0].get<double>());
  ASSERT_EQ(values.size(), 5u) << ray;
  EXPECT_EQ(ray["terms"][0]["kind"], "emissive");
  EXPECT_EQ(ray["terms"][1]["kind"], "ambient");
  EXPECT_LT(values[2], values[3]);
  EXPECT_NEAR(values[4], 0.5e-45, 1e-47);
}

TEST_F(Explain, ATermOfARayWithoutOthersStaysHoweverSmall) {
  const std::string scene = folder / "dim.ray";
  writeFile(scene, R"(SBT-raytracer 1.0
camera { position = (0, 0, 5); viewdir = (0, 0, -1); updir = (0, 1, 0); }
directional_light { name = "speck"; direction = (0, 0, -1); color = (1e-45, 1e-45, 1e-45); }
directional_light { name = "behind"; direction = (0, 0, 1); color = (1, 1, 1); }
scale(9, square { material = { diffuse = (0.5, 0.5, 0.5); } })
)");
  const std::string text = out({"explain", scene, "-w", "9", "--pixel", "4,4"});
  EXPECT_NE(text.find("+ speck 5e-46"), std::string::npos) << text;
  EXPECT_NE(text.find("+ behind 0; faces away"), std::string::npos) << "a zero with a reason stays\n" << text;
  EXPECT_EQ(text.find("below the last digit"), std::string::npos) << text;
}

TEST_F(Explain, DeepRaysStandAtOneMarginAndNameTheRayThatSentThem) {
  const std::string scene = folder / "milk.ray";
  writeFile(scene, R"(SBT-raytracer 1.0
settings { integrator = path; medium-depth = 200; width = 8; }
camera { position = (0, 0, 0); viewdir = (0, 0, -1); updir = (0, 1, 0); }
background { color = (1, 1, 1); }
scale(40, sphere { material = { opacity = 0; medium_density = 1 } })
)");
  const std::string text = out({"explain", scene, "--pixel", "4,4"});
  std::istringstream lines(text);
  std::size_t longest = 0, deep = 0;
  for (std::string line; std::getline(lines, line);) {
    longest = std::max(longest, std::min(line.size(), line.find_first_not_of("|+- ")));
    if (line.find("bounce ray of #") != std::string::npos) ++deep;
  }
  EXPECT_GT(deep, 20u) << "the scene scatters too little for this test";
  EXPECT_LE(longest, 60u);
  EXPECT_TRUE(contains(text, "#40 bounce ray of #39: depth 40,"));
  EXPECT_FALSE(contains(text, "#9 bounce ray of #"));
  EXPECT_FALSE(contains(text, " -0 ")) << "zero has no sign for the eye";
  EXPECT_TRUE(contains(text, "sum to the picture's pixel, bit for bit"));
}

TEST_F(Explain, TellsOfWaysAndOfAChain) {
  const std::vector<std::string> bdpt{
      "explain", kScenes + "uplight.ray", "--width", "40", "--spp", "4", "--pixel", "20,16"};
  EXPECT_NE(out(bdpt).find("The paths of the sample, s vertices from the light"), std::string::npos);
  std::vector<std::string> mlt{
      "explain", kScenes + "cornell.ray", "--width", "24", "--spp", "4", "--integrator", "mlt", "--pixel",
      "12,18",   "--chain-starts",        "2000"};
  const std::string text = out(mlt);
  EXPECT_NE(text.find("A chain of the picture ("), std::string::npos) << text;
  EXPECT_NE(text.find("  > "), std::string::npos);
  EXPECT_NE(text.find("s vertices from the light"), std::string::npos) << "they are of bdpt";
  EXPECT_NE(text.find("sum to the contribution of the pixel's own paths, bit for bit"), std::string::npos);
  EXPECT_FALSE(contains(error(mlt, 0), "changes nothing"));
  std::vector<std::string> veach = mlt;
  veach.insert(veach.end(), {"--chains", "veach"});
  EXPECT_NE(out(veach).find("sum to the pixel as it was traced, bit for bit"), std::string::npos);
  EXPECT_FALSE(contains(error(veach, 0), "--chains changes nothing")) << "for the paths that are shown";
  mlt.insert(mlt.end(), {"--format", "json"});
  const json chain = json::parse(out(mlt))["chain"];
  ASSERT_GT(chain["moves"].size(), 100u);
  EXPECT_EQ(chain["moves"][0]["number"], -1);
  const json& nearest = chain["moves"][chain["nearest"].get<std::size_t>()];
  EXPECT_TRUE(nearest["made"].get<bool>());
  mlt.insert(mlt.end(), {"--chains", "veach", "--firefly-limit", "0", "--strict"});
  EXPECT_EQ(error(mlt, 0).find("changes nothing"), std::string::npos) << "the picture's chains count";
}

TEST_F(Explain, FindsWhatTheLightImageBrings) {
  std::vector<std::string> words{"explain", kScenes + "uplight.ray", "--width", "40", "--spp", "4", "--pixel",
                                 "20,16"};
  EXPECT_NE(out(words).find("--light-image finds it"), std::string::npos);
  words.push_back("--light-image");
  const std::string text = out(words);
  EXPECT_NE(text.find("paths that landed here, of 4320"), std::string::npos) << text;
  EXPECT_NE(text.find("from a light by "), std::string::npos) << text;
  words.insert(words.end(), {"--format", "json"});
  const json all = json::parse(out(words));
  EXPECT_FALSE(all["lacksLightImage"].get<bool>());
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_EQ(all["lightImage"]["picture"][c].get<double>(),
              all["rendered"][c].get<double>() + all["lightImage"]["value"][c].get<double>());
  words.back() = "svg";
  EXPECT_NE(error(words, 2).find("--light-image: expected --format text or json"), std::string::npos);
  words.back() = "text";
  std::vector<std::string> others = words;
  others.insert(others.end(), {"--integrator", "path"});
  EXPECT_NE(error(others, 2).find("expected --integrator bdpt, which has one, found path"),
            std::string::npos);
  others.back() = "mlt";
  others.insert(others.end(), {"--chain-starts", "2000"});
  EXPECT_NE(out(others).find("\nby `bdpt`  "), std::string::npos) << "chains walk among its paths";
  others.insert(others.end(), {"--chains", "veach"});
  EXPECT_NE(error(others, 2).find("which has one, found mlt --chains veach"), std::string::npos);
}

/// What the schema promises: each ray's radiance follows from its terms, and so from the radiance of its
/// rays.
std::array<double, 3> sum(const json& rays, const json& ray) {
  std::array<double, 3> all{};
  for (std::size_t c = 0; c < 3; ++c) {
    if (ray["kind"] == "shadow") {
      all[c] = 1;
      for (const json& filter : ray["filters"]) all[c] *= filter["factor"][c].get<double>();
      if (ray["ends"][0]["why"] == "blocked") all[c] = 0;
      continue;
    }
    for (const json& term : ray["terms"]) {
      const auto radianceOf = [&](const json& next) {
        return next["radiance"][c].is_number() ? next["radiance"][c].get<double>() : sum(rays, next)[c];
      };
      const json& at = term["ray"];
      const double value =
          at.is_null() ? term["value"][c].get<double>() : radianceOf(rays[at.get<std::size_t>()]);
      all[c] += term["factor"][c].get<double>() * value;
    }
    all[c] *= ray["through"][c].get<double>();
  }
  return all;
}

TEST_F(Explain, JsonFollowsItsSchemaToTheLastBit) {
  const json all =
      json::parse(out({"explain", kScenes + "glass.ray", "--pixel", "200,120", "--format", "json"}));
  EXPECT_EQ(all["schema"], "trace-explain");
  EXPECT_EQ(all["version"], 1);
  EXPECT_EQ(all["agrees"], true);
  EXPECT_EQ(all["pixel"], all["rendered"]);
  const json& rays = all["rays"];
  ASSERT_GT(rays.size(), 10u);
  EXPECT_EQ(rays[0]["radiance"], all["samples"][0]);
  for (const json& ray : rays) {
    const auto expected = sum(rays, ray);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(ray["radiance"][c].get<double>(), expected[c]);
    EXPECT_FALSE(ray["sentence"].get<std::string>().empty());
  }
  const json& object = rays[0]["hit"]["object"];
  EXPECT_EQ(object["shape"], "sphere");
  EXPECT_EQ(object["place"]["line"], 46);
  EXPECT_EQ(rays[0]["hit"]["material"]["index"], 1.5);
}

/// How often `part` stands in the text.
std::size_t timesIn(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++times;
  return times;
}

/// Text, JSON, OBJ and drawing of a pixel: all are there, tell of the same rays, and sum to the picture.
void expectFormsAgree(Session& session, int x, int y, bool draws) {
  const Size size = session.size();
  const Explanation explanation = session.explain(x, y, 0);
  const Scene& scene = session.sceneOf(explanation.tree);  // particles are others at each moment
  const std::vector<ExplainedRay> rays = explainedRays(explanation.tree, scene);
  const PixelFacts facts{
      scene, explanation, rays, size.width, size.height, session.film().ofSamples(x, y), session.settings()};
  EXPECT_TRUE(facts.agrees());
  const json all = json::parse(explainJson(facts));
  ASSERT_EQ(all["rays"].size(), rays.size());
  for (const json& ray : all["rays"]) {
    if (ray["kind"] == "light") continue;  // brings nothing back
    const auto expected = sum(all["rays"], ray);
    for (std::size_t c = 0; c < 3; ++c)
      if (ray["radiance"][c].is_number()) {
        EXPECT_EQ(ray["radiance"][c].get<double>(), expected[c]) << ray["id"];
      }
  }
  const Color rendered = session.film().ofSamples(x, y);
  EXPECT_EQ(all["rays"][0]["radiance"], all["samples"][0]);
  if (all["samples"].size() == 1 && isFinite(rendered)) {
    EXPECT_EQ(all["rendered"], json({rendered.r, rendered.g, rendered.b}));
    EXPECT_EQ(all["rays"][0]["radiance"], all["rendered"]);
  }
  const std::string text = explainText(facts, false), obj = raysAsObj(explanation.tree, rays);
  EXPECT_EQ(timesIn(text, ": depth "), rays.size());
  EXPECT_EQ(timesIn(obj, "\nl "), rays.size());
  EXPECT_FALSE(contains(text, "do NOT sum"));
  std::size_t filters = 0, told = 0;
  for (const json& ray : all["rays"])
    if (ray["kind"] == "shadow")
      for (const json& filter : ray["filters"]) filters += filter["shadowless"] ? 0 : 1;  // told as passed by
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    told += line.find("* ") != line.npos && line.find(" through ") != line.npos;
  EXPECT_EQ(told, filters) << text;
  if (draws) {
    EXPECT_GT(toSvg(drawRays(scene, session.settings(), session.worldOf(explanation.tree), explanation.tree))
                  .size(),
              1000u);
  }
}

TEST_F(Explain, EveryFormOfEverySceneAndIntegratorIsThereAndAgrees) {
  constexpr std::size_t kStride = kSanitized ? 12 : 1;  // EveryScene goes the ways of all scenes there
  std::vector<std::string> files = filesUnder(kScenes, ".ray");
  std::erase_if(files, [](const std::string& file) { return contains(file, "/meshes/"); });
  std::size_t shown = 0;
  for (std::size_t at = 0; at < files.size(); at += kStride) {
    const std::string& file = files[at];
    Session read;
    read.open(file, {});
    std::list<Session> sessions;  // the first is kept: what is the same is shared with it
    for (const IntegratorRow& row : integrators()) {
      if (row.traits.has(Trait::byChains))
        continue;  // whose pixels have no samples: the command explains those of path
      SCOPED_TRACE(file + " " + std::string(row.name));
      std::vector<Choice> choices;
      for (const auto& [option, value] : {std::pair{"integrator", row.name},
                                          {"width", "8"},
                                          {"depth", "3"},
                                          {"spp", "1"},
                                          {"photons", "500"},
                                          {"photon-passes", "1"},
                                          {"denoise", "off"},
                                          {"subdivide", "0"},
                                          {"region", "0,0,0,0"},
                                          {"moments", "2"},
                                          {"medium-depth", "3"}})
        choices.push_back({std::string(option), std::string(value), {}});
      if (read.settings().caustics > 0) choices.push_back({"caustics", "500", {}});
      Session& session = sessions.emplace_back();
      openAgain(session, read, choices);
      session.build(sessions.size() > 1 ? &sessions.front() : nullptr);
      session.renderPicture();
      const std::string name = std::filesystem::path(file).stem().string();
      const Size size = session.size();
      const std::array<std::pair<int, int>, 3> pixels{
          // each integrator has one of them
          {{size.width / 2, size.height / 2}, {1, size.height - 2}, {size.width - 2, 1}}};
      const auto& [x, y] = pixels[static_cast<std::size_t>(row.kind) % pixels.size()];
      expectFormsAgree(session, x, y,
                       row.name == "whitted" && (name == "cloud" || name == "mist" || name == "underwater"));
      ++shown;
      if (sessions.size() > 1) sessions.pop_back();
    }
  }
  EXPECT_GT(shown, 300 / kStride);
}

TEST_F(Explain, AShadowRayThroughAMediumIsToldInJson) {
  const std::string scene = folder / "medium.ray";
  writeFile(scene, R"(SBT-raytracer 1.0
camera { position = (0,0,5); viewdir=(0,0,-1); updir=(0,1,0); }
point_light { position=(1,3,2); color=(2,2,2); }
sphere { name = puff; material={ opacity=0; medium_density=3; } }
)");
  const json all = json::parse(out({"explain", scene, "-w", "9", "--pixel", "4,4", "--format", "json"}));
  bool crosses = false;
  for (const json& ray : all["rays"])
    for (const json& filter : ray["filters"])
      crosses |= filter["object"]["name"] == "puff" && filter["object"]["shape"] == "sphere";
  EXPECT_TRUE(crosses) << all;
  // In fog no object is named.
  writeFile(scene, R"(SBT-raytracer 1.0
settings { fog = 0.2; fog-color = (1,1,1); integrator = path; }
camera { position = (0,0,5); viewdir=(0,0,-1); updir=(0,1,0); }
point_light { position=(1,3,2); color=(2,2,2); }
sphere { }
)");
  for (const char* integrator : {"path", "whitted", "bdpt", "photon", "direct"})
    EXPECT_EQ(json::parse(out({"explain", scene, "-w", "9", "--pixel", "4,4", "--format", "json",
                               "--integrator", integrator, "--photons", "1000"}))["agrees"],
              true)
        << integrator;
}

TEST_F(Explain, NamesTheMaterialThatIsThere) {
  const std::string scene = folder / "parts.ray";
  writeFile(scene, R"(SBT-raytracer 1.0
camera { position = (0, 0, 5); viewdir = (0, 0, -1); updir = (0, 1, 0); }
difference { name = "holed"; material = { name = "red"; diffuse = (1, 0, 0) };
  box { }
  translate(0, 0, 0.25, scale(0.25, 0.25, 9, cylinder { material = { name = "rust"; diffuse = (0.5, 0.2, 0) } })); }
translate(2, 0, 0, polymesh { name = "mixed"; points = ((-1,-1,0), (1,-1,0), (0,1,0)); faces = ((0,1,2));
  materials = ({ name = "a"; diffuse = 1 }, { name = "a"; diffuse = 1 }, { name = "b"; diffuse = 0.5 }); })
)");
  const std::vector<std::string> command{"explain", scene, "-w", "101", "--pixel"};
  const auto explain = [&](const char* pixel, const char* format) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {pixel, "--format", format});
    return out(words);
  };
  EXPECT_NE(explain("50,50", "text").find("made of rust, at distance"), std::string::npos);
  EXPECT_NE(explain("58,50", "text").find("made of red, at distance"), std::string::npos);
  const json object = json::parse(explain("90,52", "json"))["rays"][0]["hit"]["object"];
  EXPECT_EQ(object["name"], "mixed");
  ASSERT_GE(object["materials"].size(), 2u) << object;
  double sum = 0;
  for (const json& share : object["materials"]) sum += share["weight"].get<double>();
  EXPECT_NEAR(sum, 1, 1e-12);
  EXPECT_EQ(object["materials"].back()["name"], "b");
  EXPECT_EQ(object["material"], "a");
}

TEST_F(Explain, AMaterialWithoutANameIsCalledAlikeInTextAndJson) {
  const std::string scene = folder / "nameless.ray";
  writeFile(scene,
            "SBT-raytracer 1.0\ncamera { position = (0, 0, 5); viewdir = (0, 0, -1); updir = (0, 1, 0); }\n"
            "sphere { material = { name = \"red\"; diffuse = (1, 0, 0); } }\n"
            "scale(2, sphere { material = { diffuse = (0, 0, 1); } })\n");
  const std::vector<std::string> words{"explain", scene, "-w", "9", "--pixel", "4,4", "--format"};
  const auto explain = [&](const char* format) {
    std::vector<std::string> all = words;
    all.emplace_back(format);
    return out(all);
  };
  const json object = json::parse(explain("json"))["rays"][0]["hit"]["object"];
  const std::string name = "material " + std::to_string(object["materials"][0]["index"].get<int>() + 1);
  EXPECT_EQ(object["material"], name);
  EXPECT_EQ(object["materials"][0]["name"], name);
  EXPECT_NE(explain("text").find("made of " + name + ","), std::string::npos);
}

TEST_F(Explain, ThePageInTheDocsShowsTheRealOutput) {
  // The first block of docs/explain.md is what the command above it prints.
  const std::string page = readFile(test::sourceFolder() + "/docs/explain.md");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(page, match,
                                std::regex("\n    ray explain (scenes/[a-z]+\\.ray) --pixel ([0-9,]+)\n")));
  const std::string scene = match[1], pixel = match[2];
  std::filesystem::create_directory_symlink(kScenes, folder / "scenes");
  const std::string text = out({"explain", scene, "--pixel", pixel});
  std::string block;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    block += (end > begin ? "    " : "") + text.substr(begin, end - begin) + "\n";
  EXPECT_NE(page.find(block), std::string::npos) << block;
}

TEST_F(Explain, FilesGetTheFormatOfTheirName) {
  const std::vector<std::string> words{"explain", kScenes + "shapes.ray", "--pixel=150,100", "-o"};
  using Pair = std::pair<std::string, std::string>;
  const std::string text = words[1] + ", pixel 150,100";
  for (const auto& [name, begins] : {Pair{"a.json", "{\"schema\""}, Pair{"a.obj", "# rays of"},
                                     Pair{"a.svg", "<svg "}, Pair{"a.txt", text}, Pair{"a", text}}) {
    std::vector<std::string> with = words;
    with.push_back(name);
    EXPECT_EQ(out(with), "");
    EXPECT_EQ(readFile(folder / name).find(begins), 0u) << name;
  }
  std::vector<std::string> with = words;
  with.push_back("a.png");
  out(with);
  EXPECT_GT(readPicture(folder / "a.png").width, 1000);
}

// The scenes of British Columbia ask for the pass depth by themselves.
TEST_F(Explain, ScenesWithPassesAreDrawnToo) {
  for (const char* name : {"a.png", "a.svg"}) {
    out({"explain", kScenes + "cpsc314.ray", "--pixel=200,200", "-o", name});
    out({"explain", kScenes + "shapes.ray", "--pixel=150,100", "--passes=depth,normal,id", "-o", name});
  }
  EXPECT_GT(readPicture(folder / "a.png").width, 1000);
}

TEST_F(Explain, RefusesWithAReason) {
  const std::string scene = kScenes + "shapes.ray";
  EXPECT_NE(error({"explain", scene}, 2).find("--pixel"), std::string::npos);
  EXPECT_NE(error({"explain", "--pixel", "1,1"}, 2).find("scene file"), std::string::npos);
  for (const char* pixel : {"1", "1,2,3", "a,b", "-1,0", "1.5,2", "1,", ",1", "99999999999,0"})
    EXPECT_NE(error({"explain", scene, std::string("--pixel=") + pixel}, 2).find("--pixel"),
              std::string::npos)
        << pixel;
  EXPECT_NE(error({"explain", scene, "--pixel", "400,0"}, 2).find("--pixel X,Y: expected X from 0 to 399"),
            std::string::npos);
  EXPECT_NE(error({"explain", scene, "--pixel", "0,0", "--sample", "9999"}, 2).find("sample"),
            std::string::npos);
  EXPECT_NE(error({"explain", scene, "--pixel", "0,0", "--format", "png"}, 2).find("-o"), std::string::npos);
  EXPECT_NE(error({"explain", scene, "--pixel", "0,0", "-o", "a.jpg"}, 2).find(".svg"), std::string::npos);
  EXPECT_NE(error({"info", scene, "--format", "svg"}, 2).find("text | json"), std::string::npos);
  EXPECT_EQ(error({"explain", "none.ray", "--pixel", "0,0"}, 1).empty(), false);
}

TEST_F(Explain, OptionsCountAsInARender) {
  const std::string text =
      out({"explain", kScenes + "glass.ray", "--pixel", "50,30", "-w", "100", "-r", "0", "--spp", "1"});
  EXPECT_NE(text.find("pixel 50,30 of 100 x 63, sample 0 of 1"), std::string::npos) << text;
  EXPECT_NE(text.find("depth limit 0 reached: no reflection, no refraction"), std::string::npos) << text;
}

TEST_F(Explain, LintEndsWithSixWhenItFindsSomething) {
  const std::string bad = kLint + "light-inside.bad.ray", good = kLint + "light-inside.good.ray";
  const std::string text = out({"lint", bad}, 6);
  EXPECT_NE(text.find(bad + ":5:1: warning: the light is inside \"ball\""), std::string::npos) << text;
  EXPECT_NE(text.find("[light-inside]"), std::string::npos);
  EXPECT_NE(text.find("1 finding\n"), std::string::npos);
  EXPECT_NE(out({"lint", good}, 0).find("no problems found"), std::string::npos);
  const json all = json::parse(out({"lint", bad, "--format=json"}, 6));
  EXPECT_EQ(all["schema"], "trace-lint");
  ASSERT_EQ(all["findings"].size(), 1u);
  EXPECT_EQ(all["findings"][0]["check"], "light-inside");
  EXPECT_EQ(all["findings"][0]["line"], 5);
}

TEST_F(Explain, LintTellsWhatReadingRepaired) {
  const std::string scene = folder / "flat.ray";
  writeFile(scene,
            "SBT-raytracer 1.0\ndirectional_light { direction = (0, 0, -1); color = (1, 1, 1); }\n"
            "polymesh { points = ((0,0,-5), (1,0,-5), (0,1,-5)); faces = ((0,1,2), (0,0,1)); "
            "material = { diffuse = (1,1,1); } }\n");
  EXPECT_NE(out({"lint", scene}, 6).find("without area"), std::string::npos);
}

TEST_F(Explain, SaysWhatTheFileShowsOfTheLight) {
  const std::string scene = folder / "glow.ray";
  writeFile(scene, "SBT-raytracer 1.0\nscale(9, sphere { material = { emissive = (0.25, 0.5, 1); } })\n");
  const std::vector<std::string> words{"explain", scene, "--pixel", "4,3", "-w", "8"};
  EXPECT_EQ(out(words).find("the file"), std::string::npos);
  std::vector<std::string> developed = words;
  developed.insert(developed.end(), {"--exposure", "-1", "--transfer", "srgb", "--bloom", "0.1"});
  EXPECT_NE(
      out(developed).find("the file    99 136 187 of 255, by exposure -1, transfer srgb; without bloom 0.1"),
      std::string::npos)
      << out(developed);
}

TEST_F(Explain, NamesWhatBackFacesHides) {
  const std::string scene = folder / "away.ray";
  writeFile(scene,
            "SBT-raytracer 1.0\ncamera { position = (0, 0, 5); viewdir = (0, 0, -1); updir = (0, 1, 0); }\n"
            "directional_light { direction = (0, 0, -1); color = (1, 1, 1); }\n"
            "polymesh { name = sail; points = ((-9,-9,0), (9,-9,0), (0,9,0)); faces = ((0,2,1)); }\n");
  const std::vector<std::string> words{"explain", scene, "--pixel", "4,3", "-w", "8"};
  EXPECT_EQ(out(words).find("passed through"), std::string::npos);
  std::vector<std::string> culled = words;
  culled.insert(culled.end(), {"--back-faces", "cull-all"});
  const std::string text = out(culled);
  EXPECT_NE(text.find("passed through the back of sail at distance 5, which --back-faces hides: background"),
            std::string::npos)
      << text;
  culled.insert(culled.end(), {"--format", "json"});
  const json end = json::parse(out(culled))["rays"][0]["ends"][0];
  EXPECT_EQ(end["why"], "culled");
  EXPECT_EQ(end["object"]["name"], "sail");
}

TEST_F(Explain, NamesLightsThatGiveNothingAndThoseThatFogScatters) {
  const std::string scene = folder / "lights.ray";
  writeFile(scene, R"(SBT-raytracer 1.0
settings { fog = 0.1; fog-samples = 2; }
camera { position = (0, 0, 5); viewdir = (0, 0, -1); updir = (0, 1, 0); }
spot_light { name = "aside"; position = (0, 9, 0); direction = (1, 0, 0); angle = 20; color = (1, 1, 1); }
directional_light { name = "others"; direction = (0, 0, -1); color = (1, 1, 1); lights = ("wall"); }
directional_light { name = "sun"; direction = (0, 0, -1); color = (1, 1, 1); }
sphere { name = "ball"; material = { diffuse = (1, 1, 1); }; }
square { name = "wall"; }
)");
  const std::vector<std::string> words{"explain", scene, "-w", "20", "--pixel", "10,10"};
  const std::string text = out(words);
  EXPECT_TRUE(contains(text, "+ aside 0; it shines elsewhere (its cone, flaps, picture or back)"));
  EXPECT_TRUE(contains(text, "+ others 0; its links, or the object's, keep it off this object"));
  EXPECT_TRUE(contains(text, "light of sun"));
  EXPECT_TRUE(contains(text, "shadow ray to sun"));
  EXPECT_TRUE(contains(text, "sum to the picture's pixel, bit for bit"));
  std::vector<std::string> asJson = words;
  asJson.insert(asJson.end(), {"--format", "json"});
  const json all = json::parse(out(asJson));
  std::size_t dark = 0, scattered = 0;
  for (const json& term : all["rays"][0]["terms"]) {
    dark += term.contains("dark");
    scattered += term.contains("scattered");
  }
  EXPECT_EQ(dark, 2u);
  EXPECT_EQ(scattered, 4u) << "two places ask those two lights that shine there: fog is lit by all";
}

TEST_F(Explain, TellsThatTheFileIsDenoisedOrOfTwoEyes) {
  const std::vector<std::string> words{"explain", kScenes + "glass.ray", "-w",   "40",    "--pixel",
                                       "20,12",   "--transfer",          "srgb", "--spp", "8"};
  std::vector<std::string> clean = words, eyes = words;
  clean.emplace_back("--denoise");
  eyes.insert(eyes.end(), {"--stereo", "dubois"});
  EXPECT_FALSE(contains(out(words), "; without "));
  EXPECT_TRUE(contains(out(clean), "; without --denoise"));
  EXPECT_TRUE(contains(out(eyes), " of 255, of the left eye"));
}

TEST_F(Explain, APixelOutsideOfTheRegionIsRefused) {
  const std::string scene = kScenes + "shapes.ray";
  EXPECT_NE(error({"explain", scene, "--pixel", "9,9", "-w", "20", "--region", "0,0,9,9"}, 2)
                .find("--pixel 9,9 lies outside of --region 0,0,9,9"),
            std::string::npos);
  EXPECT_NE(out({"explain", scene, "--pixel", "8,8", "-w", "20", "--region", "0,0,9,9"}), "");
}

}  // namespace
}  // namespace trace::test

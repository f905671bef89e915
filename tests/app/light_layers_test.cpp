// Layers of light by its sources, mattes, alpha and motion, and the one file that holds all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/session/session.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "image/codecs/exr_layers.h"
#include "render/picture/passes.h"
#include "support/folder.h"
#include "support/paths.h"
#include "support/shared.h"
#include "support/small_renders.h"

namespace trace::test {
namespace {

const std::string kExamples = test::sourceFolder() + "/scenes";

std::unique_ptr<Session> rendered(const std::string& file, std::vector<Choice> choices) {
  auto session = std::make_unique<Session>();
  session->open(file, choices);
  session->build();
  session->renderPicture();
  return session;
}

const PassRow& row(Pass pass) { return passRows()[static_cast<std::size_t>(pass)]; }

Picture values(const Session& session, Pass pass) {
  return valuesOf(row(pass), session.film(), session.settings(), session.names(), session.picture());
}

/// The picture of one group of light, direct or indirect.
Picture group(const Session& session, Pass pass, const std::string& name) {
  const LightLayers layers = lightLayersOf(session.settings(), session.names().groups.size());
  const auto& groups = session.names().groups;
  const auto found = std::find(groups.begin(), groups.end(), name);
  EXPECT_NE(found, groups.end()) << name;
  const int first = pass == Pass::direct ? layers.direct : layers.indirect;
  return session.film().layer(static_cast<std::size_t>(first + (found - groups.begin())));
}

/// The largest difference of a channel, relative to one above 1.
double apart(const Picture& a, const Picture& b) {
  double most = 0;
  const auto of = [&](double x, double y) {
    most = std::max(most, std::abs(x - y) / std::max(1.0, std::abs(x)));
  };
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    of(a.pixels[i].r, b.pixels[i].r);
    of(a.pixels[i].g, b.pixels[i].g);
    of(a.pixels[i].b, b.pixels[i].b);
  }
  return most;
}

Picture sumOf(Picture a, const Picture& b) {
  for (std::size_t i = 0; i < a.pixels.size(); ++i) a.pixels[i] += b.pixels[i];
  return a;
}

double lightOf(const Picture& picture) {
  double sum = 0;
  for (const Color& c : picture.pixels) sum += luminanceOf(c);
  return sum;
}

/// Two lights of names, and one emissive object without.
constexpr const char* kTwoLights = R"(SBT-raytracer 1.0
settings { width = 24; height = 20; spp = 4; denoise = off; firefly-limit = 0; }
camera { position = (0, 0, 6); viewdir = (0, 0, -1); updir = (0, 1, 0); }
point_light { name = "key"; position = (3, 4, 5); color = (0.9, 0.5, 0.2); }
point_light { name = "fill light"; position = (-4, 1, 5); color = (0.1, 0.3, 0.8); }
ambient_light { color = (0.1, 0.2, 0.1); }
material = { name = "clay"; diffuse = (0.7, 0.7, 0.7); ambient = (1, 1, 1); }
sphere { name = "ball"; material = { name = "mirror"; diffuse = (0.2, 0.2, 0.2); reflective = (0.6, 0.6, 0.6); } }
translate(0, -3, 0, scale(20, 4, 20, box { name = "floor"; material = "clay"; }))
translate(2, 2, 0, scale(0.5, sphere { material = { emissive = (2, 1, 1); }; }))
)";

class LightLayers : public testing::Test {
 protected:
  std::string scene(const std::string& text = kTwoLights) {
    const std::string file = folder_ / "scene.ray";
    writeFile(file, text);
    return file;
  }
  const Folder folder_;
};

// The property: for every integrator that can split light, the layers sum to the picture.
TEST(LightLayersOfExamples, SumToThePictureForEveryIntegratorThatSplitsLight) {
  for (const char* name : {"cornell", "glass", "fog", "mist", "holes", "lamps", "jade", "environment", "ink",
                           "whitted", "lights", "antialias", "caustics", "motion"})
    for (const char* integrator : {"whitted", "path", "direct", "photon", "occlusion"}) {
      const std::string file = kExamples + "/" + name + ".ray";
      if (!isOrdinaryFile(file)) continue;
      const auto session = rendered(file, {{"width", "20", {}},
                                           {"height", "0", {}},
                                           {"spp", "4", {}},
                                           {"photons", "2000", {}},
                                           {"denoise", "off", {}},
                                           {"integrator", integrator, {}},
                                           {"passes", "direct,indirect", {}}});
      const Picture sum = sumOf(values(*session, Pass::direct), values(*session, Pass::indirect));
      EXPECT_LT(apart(session->picture(), sum), 1e-12) << name << " by " << integrator;
      EXPECT_GT(lightOf(sum), 0) << name << " by " << integrator;
    }
}

TEST_F(LightLayers, ChangeNothingInThePictureAndAreTheSameForAnyNumberOfThreads) {
  for (const char* integrator : {"whitted", "path", "photon"}) {
    const auto by = [&](const char* threads, const char* passes) {
      return rendered(scene(), {{"threads", threads, {}},
                                {"integrator", integrator, {}},
                                {"photons", "2000", {}},
                                {"passes", passes, {}}});
    };
    const auto one = by("1", "all"), plain = by("2", "none");
    EXPECT_EQ(one->picture(), plain->picture()) << integrator;
    for (const char* threads : {"2", "7"}) EXPECT_EQ(one->film().saved(), by(threads, "all")->film().saved());
  }
}

TEST_F(LightLayers, HoldTheLightOfTheirSourceAlone) {
  const auto all = rendered(scene(), {{"integrator", "whitted", {}}, {"passes", "direct,indirect", {}}});
  const std::string text = kTwoLights;
  const auto without = [&](const std::string& from) {  // a light of that start of its line
    std::string rest = text;
    const std::size_t begin = rest.find(from);
    rest.erase(begin, rest.find('\n', begin) + 1 - begin);
    return rest;
  };
  const auto unlit =
      rendered(scene(without("point_light { name = \"key\"")), {{"integrator", "whitted", {}}});
  const Picture key = sumOf(group(*all, Pass::direct, "key"), group(*all, Pass::indirect, "key"));
  EXPECT_LT(apart(all->picture(), sumOf(unlit->picture(), key)), 1e-12);
  EXPECT_GT(lightOf(group(*all, Pass::direct, "key")), 1);
  EXPECT_GT(lightOf(group(*all, Pass::indirect, "fill_light")), 0.01) << "the ball mirrors the floor";
  EXPECT_GT(lightOf(group(*all, Pass::direct, "ambient")), 0.01);
  EXPECT_GT(lightOf(group(*all, Pass::direct, "object3")), 0.1) << "the emissive ball is seen";
  EXPECT_EQ(lightOf(group(*all, Pass::indirect, "other")), 0);
  EXPECT_EQ(all->names().groups,
            (std::vector<std::string>{"key", "fill_light", "object3", "ambient", "background", "other"}));
}

// The reserved names stay those of Trace, and two names that look the same in a file are told apart.
TEST_F(LightLayers, HaveNamesThatDoNotCollide) {
  const auto session = rendered(scene(R"(SBT-raytracer 1.0
settings { width = 4; height = 4; passes = (direct, object); }
point_light { name = "other"; position = (0, 0, 5); color = (1, 1, 1); }
point_light { name = "a b"; position = (0, 1, 5); color = (1, 1, 1); }
point_light { name = "a.b"; position = (0, 2, 5); color = (1, 1, 1); }
point_light { name = "a b"; position = (0, 3, 5); color = (1, 1, 1); }
sphere { name = "x" }
sphere { name = "x" }
)"),
                                {});
  EXPECT_EQ(session->names().groups,
            (std::vector<std::string>{"other_2", "a_b", "a_b_2", "ambient", "background", "other"}));
  EXPECT_EQ(session->names().objects, (std::vector<std::string>{"x"})) << "one name is one matte";
}

TEST_F(LightLayers, AreLeftOutWithAWarningWhereTheIntegratorCannotSplitLight) {
  for (const char* integrator : {"bdpt", "mlt", "normals"}) {
    Session session;
    session.open(scene(),
                 std::vector<Choice>{{"integrator", integrator, {}}, {"passes", "direct,depth", {}}});
    session.build();
    std::string all;
    for (const Message& message : session.messages().all()) all += message.what;
    EXPECT_NE(all.find("cannot split the light by its sources"), std::string::npos) << integrator;
    EXPECT_EQ(passesOf(session.settings()).size(), 1u);
  }
}

TEST_F(LightLayers, ContinueFromWhatWasSaved) {
  const std::vector<Choice> choices{{"passes", "all", {}}, {"integrator", "path", {}}, {"alpha", "on", {}}};
  const auto whole = rendered(scene(), choices);
  Session again;
  again.open(scene(), choices);
  again.build();
  again.film().restore(whole->film().saved());
  EXPECT_EQ(again.film().saved(), whole->film().saved());
  const std::string saved = whole->film().saved();
  Film other = makeFilm(whole->settings(), 24, 20, whole->names());
  for (std::size_t length = 0; length < saved.size(); length += 997)
    EXPECT_THROW(other.restore(saved.substr(0, length)), std::exception) << length;
}

TEST_F(LightLayers, MergeToTheSameBits) {
  const std::vector<Choice> choices{{"width", "70", {}},
                                    {"height", "40", {}},
                                    {"spp", "2", {}},
                                    {"passes", "all", {}},
                                    {"integrator", "path", {}}};
  const auto whole = rendered(scene(), choices);
  Session merged;
  merged.open(scene(), choices);
  merged.buildToFinish();
  for (int part = 0; part < 3; ++part) {
    Session one;
    one.open(scene(), choices);
    one.build();
    one.film().limitTo({part, 3});
    one.renderPicture();
    merged.film().merge(one.film().saved(), {part, 3});
  }
  EXPECT_EQ(merged.film().saved(), whole->film().saved());
  PictureFiles mergedFiles = merged.filesFor(folder_ / "merged.exr"),
               files = whole->filesFor(folder_ / "whole.exr");
  Settings layers = whole->settings();
  layers.passFormat = PassFormat::layers;
  mergedFiles.write(merged.film(), layers, {});
  files.write(whole->film(), layers, {});
  EXPECT_EQ(readFile(folder_ / "merged.exr"), readFile(folder_ / "whole.exr"));
}

// --- mattes ---

TEST_F(LightLayers, MattesCoverWhatAlphaCovers) {
  const auto session = rendered(scene(), {{"spp", "16", {}},
                                          {"integrator", "path", {}},
                                          {"alpha", "on", {}},
                                          {"passes", "object,material", {}}});
  const Film& film = session->film();
  const Picture alpha = film.layer(static_cast<std::size_t>(lightLayersOf(session->settings(), 6).alpha));
  bool part = false;
  for (const Pass pass : {Pass::object, Pass::material}) {
    const auto shares = film.shares(static_cast<std::size_t>(layerOf(session->settings(), row(pass).name)));
    for (std::size_t i = 0; i < shares.size(); ++i) {
      double sum = 0, before = 1;
      for (const Film::Share& share : shares[i]) {
        EXPECT_LE(share.share, before);
        before = share.share;
        sum += share.share;
      }
      EXPECT_NEAR(sum, alpha.pixels[i].r, 1e-12);
      part |= shares[i].size() > 1;
    }
  }
  EXPECT_TRUE(part) << "a pixel on an edge has two";
}

TEST_F(LightLayers, AlphaTakesTheEnvironmentOutOfThePicture) {
  const std::string text = std::string(kTwoLights) + "background { color = (0.3, 0.4, 0.5); }\n";
  const auto opaque = rendered(scene(text), {{"integrator", "path", {}}, {"spp", "16", {}}});
  const auto clear =
      rendered(scene(text), {{"integrator", "path", {}}, {"spp", "16", {}}, {"alpha", "on", {}}});
  const Picture alpha = clear->film().layer(0), with = opaque->picture(), over = clear->picture();
  Picture composed = over;
  for (std::size_t i = 0; i < composed.pixels.size(); ++i)
    composed.pixels[i] += Color(0.3, 0.4, 0.5) * (1 - alpha.pixels[i].r);
  EXPECT_LT(apart(with, composed), 1e-12) << "what was cut out fits back";
}

TEST_F(LightLayers, PngStoresAlphaAndColoursThatAreNotMultiplied) {
  const auto session = rendered(scene(), {{"alpha", "on", {}}, {"integrator", "whitted", {}}});
  session->save(folder_ / "a.png");
  const std::string bytes = readFile(folder_ / "a.png");
  const Raster raster = decodeRaster(bytes, "a.png");
  ASSERT_EQ(raster.channels, 4);
  const auto& samples = std::get<std::vector<std::uint8_t>>(raster.samples);
  const Picture alpha = session->film().layer(0);
  for (std::size_t i = 0; i < alpha.pixels.size(); ++i)
    EXPECT_EQ(samples[4 * i + 3], toLevel(alpha.pixels[i].r, Rounding::nearest));
  EXPECT_FALSE(readMetadata(folder_ / "a.png").empty());
}

// --- motion ---

TEST_F(LightLayers, MotionIsThatOfThePixels) {
  const auto session = rendered(scene(R"(SBT-raytracer 1.0
settings { projection = orthographic; view-height = 2; width = 80; height = 40; spp = 1; passes = (motion); }
camera { position = (0, 0, 5); viewdir = (0, 0, -1); updir = (0, 1, 0); aspectratio = 2; }
translate(key((0, -1), (1, 1.4)), key((0, 0), (1, -0.6)), 0, scale(0.5, 0.5, 1, square { material = { emissive = (1, 1, 1); }; }))
)"),
                                {});
  const Picture motion = values(*session, Pass::motion);
  const Color moved = motion.at(20, 20);  // 20 pixels a unit, 24 frames a second
  EXPECT_NEAR(moved.r, 2.4 * 20 / 24, 1e-9);
  EXPECT_NEAR(moved.g, -0.6 * 20 / 24, 1e-9);
  EXPECT_EQ(motion.at(70, 5), Color(0)) << "nothing is there";
}

// --- the file ---

TEST_F(LightLayers, OneFileHoldsThemByTheNamesThatOtherProgramsKnow) {
  const auto session =
      rendered(scene(), {{"passes", "all", {}}, {"pass-format", "layers", {}}, {"integrator", "path", {}}});
  EXPECT_EQ(outputs(folder_ / "all.exr", session->settings()).size(), 1u);
  session->save(folder_ / "all.exr");
  const auto layer = [&](const std::string& name) { return readPicture(folder_ / "all.exr:" + name); };
  const auto close = [&](const Picture& a, const Picture& b) { return apart(a, b) < 1e-6; };
  EXPECT_TRUE(close(session->picture(), readPicture(folder_ / "all.exr")));
  EXPECT_TRUE(close(values(*session, Pass::normal), layer("N")));
  EXPECT_TRUE(close(values(*session, Pass::albedo), layer("albedo")));
  EXPECT_TRUE(close(values(*session, Pass::variance), layer("variance")));
  EXPECT_TRUE(close(group(*session, Pass::direct, "key"), layer("direct.key")));
  Picture sum(24, 20);
  for (const char* pass : {"direct", "indirect"})
    for (const std::string& name : session->names().groups)
      sum = sumOf(sum, layer(std::string(pass) + "." + name));
  EXPECT_LT(apart(readPicture(folder_ / "all.exr"), sum), 1e-6) << "the layers of light sum to the picture";
}

TEST_F(LightLayers, NeedAnExr) {
  Settings settings;
  settings.passFormat = PassFormat::layers;
  EXPECT_THROW(outputs("a.png", settings), Error);
  settings.stereo = Stereo::redCyan;
  EXPECT_THROW(outputs("a.exr", settings), Error);
}

// The whole picture is the display window; the region alone is stored.
TEST_F(LightLayers, ARegionIsTheDataWindow) {
  const auto whole = rendered(scene(), {});
  const auto part = rendered(scene(), {{"region", "3,4,15,11", {}}});
  part->save(folder_ / "part.exr");
  whole->save(folder_ / "whole.exr");
  const Picture is = readPicture(folder_ / "part.exr"), all = readPicture(folder_ / "whole.exr");
  ASSERT_EQ(is.width, 24);
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 24; ++x)
      EXPECT_EQ(is.at(x, y), x >= 3 && x < 15 && y >= 4 && y < 11 ? all.at(x, y) : Color(0));
  EXPECT_LT(readFile(folder_ / "part.exr").size(), readFile(folder_ / "whole.exr").size());
}

}  // namespace
}  // namespace trace::test

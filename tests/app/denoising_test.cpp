// --denoise from the scene to the picture.
#include "app/session/denoising.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/session/session.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "render/picture/passes.h"
#include "support/folder.h"
#include "support/paths.h"
#include "support/random.h"

namespace trace::test {
namespace {

const std::string kCornell = sourceFolder() + "/scenes/cornell.ray";

std::unique_ptr<Session> rendered(const std::string& file, const std::vector<Choice>& choices) {
  auto session = std::make_unique<Session>();
  session->open(file, choices);
  session->build();
  EXPECT_EQ(session->renderPicture().end, End::finished);
  return session;
}

double relativeError(const Picture& a, const Picture& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Color &p = a.pixels[i], &q = truth.pixels[i];
    for (const auto& [x, y] : {std::pair{p.r, q.r}, {p.g, q.g}, {p.b, q.b}})
      sum += (x - y) * (x - y) / (y * y + 0.01);
  }
  return sum / (3 * static_cast<double>(a.pixels.size()));
}

TEST(Denoising, CornellBecomesMoreExact) {
  const std::vector<Choice> small{{"width", "48", {}}, {"sampling", "sobol", {}}, {"depth", "5", {}}};
  const auto with = [&](const char* spp, bool denoise) {
    std::vector<Choice> choices = small;
    choices.push_back({"spp", spp, {}});
    if (denoise) choices.push_back({"denoise", "on", {}});
    return rendered(kCornell, choices);
  };
  const Picture truth = with(kSanitized ? "64" : "512", false)->picture();
  const auto session = with("16", true);
  const Picture noisy = session->film().picture(), clean = session->picture();
  const double before = relativeError(noisy, truth), after = relativeError(clean, truth);
  // In so small a picture edges are everywhere; docs/developers/methods.md has figures of larger ones.
  EXPECT_LT(after, before / (kSanitized ? 1.3 : 1.8)) << "before " << before << ", after " << after;
  EXPECT_EQ(noisy, with("16", false)->picture()) << "the film is that of the plain render";
  EXPECT_GT(meanChange(change(noisy, clean)), 0.5);
}

TEST(Denoising, EveryIntegratorThatTakesSamplesBecomesMoreExact) {
  for (const char* integrator : {"direct", "photon", "bdpt"}) {
    const auto with = [&](const char* spp) {
      return rendered(kCornell, {{"width", "32", {}},
                                 {"sampling", "sobol", {}},
                                 {"depth", "4", {}},
                                 {"integrator", integrator, {}},
                                 {"spp", spp, {}},
                                 {"denoise", "on", {}}});
    };
    const Picture truth = with(kSanitized ? "64" : "256")->film().picture();
    const auto session = with("16");
    const double before = relativeError(session->film().picture(), truth),
                 after = relativeError(session->picture(), truth);
    EXPECT_LT(after, before) << integrator;
    EXPECT_GT(after, 0) << integrator;
  }
}

/// Checks below a sky, as the camera sees them behind that object.
std::string checksBehind(const std::string& object) {
  return R"(SBT-raytracer 1.1
settings { integrator = path; depth = 6; width = 48; height = 48; sampling = sobol; }
camera { position = (0, 0, 4); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 0.6; }
background { gradient = ((0.1, 0.1, 0.1), (1.5, 1.5, 1.5)); }
material { name = "checks"; diffuse = checker { a = (0.8, 0.1, 0.1); b = (0.1, 0.1, 0.8); scale = (0.04, 0.04, 1); }; }
)" + object;
}

TEST(Denoising, WhatIsSeenBehindMirrorsAndGlassKeepsItsTexture) {
  const Folder folder;
  const std::string file = folder / "behind.ray";
  const char* const kWall = "translate(0, 0, -2, scale(8, 8, 1, square { material = \"checks\"; }))\n";
  const char* const kBehindUs =
      "translate(0, 0, 8, rotate(0, 1, 0, 3.14159265, scale(8, 8, 1, square { material = \"checks\"; })))\n";
  const std::string body = "scale(6, 6, 1, square { material = { ";
  const std::pair<const char*, std::string> scenes[] = {
      {"nothing", kWall},
      {"a pane", kWall + body + "model = thin_glass; }; })"},
      {"glass", kWall + std::string("scale(6, 6, 0.5, box { material = { transmissive = (0.9, 0.9, 0.9); "
                                    "specular = (0.3, 0.3, 0.3); index = 1.5; }; })")},
      {"a mirror", kBehindUs + body + "reflective = (0.9, 0.9, 0.9); }; })"}};
  for (const auto& [name, scene] : scenes) {
    SCOPED_TRACE(name);
    writeFile(file, checksBehind(scene));
    const auto with = [&](const char* spp) {
      return rendered(file, {{"spp", spp, {}}, {"denoise", "on", {}}});
    };
    const Picture truth = with(kSanitized ? "64" : "1024")->film().picture();
    const auto session = with("8");
    const double before = relativeError(session->film().picture(), truth),
                 after = relativeError(session->picture(), truth);
    EXPECT_LT(after, 0.5 * before);
    const Picture albedo =
        session->film().layer(static_cast<std::size_t>(layerOf(session->settings(), "guide albedo")));
    EXPECT_NEAR(albedo.at(24, 24).r + albedo.at(24, 24).b, 0.8, 0.15) << "one check, or the mean of two";
  }
}

/// The halves are those of the samples and of what they bring to other pixels: their mean is the picture.
TEST(Denoising, HalvesOfALightImageAreThePicture) {
  const auto session = rendered(kCornell, {{"width", "24", {}},
                                           {"spp", "16", {}},
                                           {"depth", "3", {}},
                                           {"integrator", "bdpt", {}},
                                           {"denoise", "on", {}}});
  const Halves halves = session->film().halves();
  const Picture picture = session->film().picture();
  Color apart;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    EXPECT_EQ(halves.share[i], 0.5);
    const Color mean = (halves.first.pixels[i] + halves.second.pixels[i]) * 0.5;
    EXPECT_NEAR(mean.g, picture.pixels[i].g, 1e-9 * (1 + picture.pixels[i].g));
    const Color d = halves.first.pixels[i] + halves.second.pixels[i] * -1;
    apart += Color(std::abs(d.r), std::abs(d.g), std::abs(d.b));
  }
  EXPECT_GT(apart.g, 0);
}

TEST(Denoising, ThePassChangeIsWhatIsAddedToThePicture) {
  const Folder folder;
  const auto session = rendered(kCornell, {{"width", "24", {}},
                                           {"spp", "8", {}},
                                           {"depth", "3", {}},
                                           {"denoise", "on", {}},
                                           {"passes", "change,albedo", {}}});
  PictureFiles files = session->filesFor(folder / "c.exr");
  session->save(files);
  const Picture clean = readPicture(folder / "c.exr"), by = readPicture(folder / "c.change.exr");
  const Picture noisy = session->film().picture();
  ASSERT_TRUE(files.denoiseChange());
  EXPECT_NEAR(*files.denoiseChange(), shownChange(noisy, clean, developmentOf(session->settings())), 1e-2);
  for (std::size_t i = 0; i < by.pixels.size(); ++i)
    EXPECT_NEAR(noisy.pixels[i].g + by.pixels[i].g, clean.pixels[i].g, 1e-5 * (1 + clean.pixels[i].g));
  EXPECT_GT(readPicture(folder / "c.albedo.exr").at(2, 12).r, 0.3) << "a wall";
}

TEST(Denoising, GoesOnFromWhatWasSaved) {
  for (const char* integrator : {"path", "bdpt"}) {
    const std::vector<Choice> choices{{"width", "40", {}},
                                      {"spp", "16", {}},
                                      {"depth", "3", {}},
                                      {"integrator", integrator, {}},
                                      {"denoise", "on", {}}};
    const auto whole = rendered(kCornell, choices);
    Session back;
    back.open(kCornell, choices);
    back.build();
    back.film().restore(whole->film().saved());
    EXPECT_EQ(back.picture(), whole->picture()) << integrator;
  }
}

TEST(Denoising, OnePixelPerSampleTellsNothing) {
  const auto session = rendered(kCornell, {{"width", "20", {}}, {"spp", "1", {}}, {"denoise", "on", {}}});
  EXPECT_FALSE(denoised(session->film(), session->settings()));
  EXPECT_EQ(session->picture(), session->film().picture());
}

}  // namespace
}  // namespace trace::test

// What students of the courses added to .ray, and what it stands for in the format: docs/ray-format.md.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "base/text.h"
#include "formats/ray/file/format.h"
#include "formats/ray/file/students.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/traced.h"
#include "ray_helpers.h"

namespace trace::ray_students_test {
namespace {

constexpr Vec3 kCorners[]{{}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// Do both texts make the same scene?
void expectSame(const std::string& theirs, const std::string& ours) {
  SCOPED_TRACE(theirs);
  const Scene a = load(theirs).scene, b = load(ours).scene;
  ASSERT_EQ(a.objects.size(), b.objects.size());
  EXPECT_TRUE(a.unrendered.empty());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_EQ(a.objects[i].shape, b.objects[i].shape);
    const Material &x = a.materials[a.objects[i].material], &y = b.materials[b.objects[i].material];
    EXPECT_EQ(x.model, y.model);
    EXPECT_EQ(x.bump, y.bump);
    ASSERT_EQ(x.textures.size(), y.textures.size());
    for (std::size_t k = 0; k < x.textures.size(); ++k)
      EXPECT_TRUE(x.textures[k].field == y.textures[k].field &&
                  summary(x.textures[k].texture) == summary(y.textures[k].texture));
    for (const Vec3& p : kCorners)
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR((a.objects[i].worldFromObject * p)[k], (b.objects[i].worldFromObject * p)[k], 1e-12);
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) EXPECT_EQ(a.lights[i].light, b.lights[i].light);
  EXPECT_EQ(a.background, b.background);
  ASSERT_EQ(a.choices.size(), b.choices.size());
  for (std::size_t i = 0; i < a.choices.size(); ++i) {
    EXPECT_EQ(a.choices[i].option, b.choices[i].option);
    EXPECT_EQ(a.choices[i].value, b.choices[i].value);
  }
}

const std::string kRed = "material = { diffuse = (1, 0, 0); }";

TEST(RayStudents, SolidsOfNamedParts) {
  expectSame("csg { primitives = (\"b\", \"s\"); b = rotate(1, 1, 1, 1, box { " + kRed +
                 "; }); s = scale(0.67, sphere { }); operation = (\"b\", \"sub\", \"s\"); }",
             "difference { rotate(1, 1, 1, 1, box { " + kRed + "; }) scale(0.67, sphere { }) }");
  expectSame(
      "translate(1, 2, 3, csg { a = sphere { }; b = box { }; c = cylinder { }; operation = (\"a\", \"or\", "
      "(\"b\", \"and\", \"c\")); })",
      "translate(1, 2, 3, union { sphere { } intersection { box { } cylinder { } } })");
  expectSame("csg { operation = subtract; box { " + kRed + "; } sphere { } }",
             "difference { box { " + kRed + "; } sphere { } }");
  expectSame(
      "material { name = \"#1\"; diffuse = (0, 1, 0); } csg { primitiveNumber = 3; queue0 = (\"scale\", "
      "\"box\"); scale0 = (1.5, 1.5, 1.5); primitive0 = \"box\"; materialID0 = \"#1\"; queue1 = "
      "(\"sphere\"); "
      "primitive1 = \"sphere\"; queue2 = (\"translate\", \"scale\", \"cylinder\"); translate2 = (0, 0, "
      "-0.5); scale2 = (0.5, 0.5, 3); primitive2 = \"cylinder\"; operator = ((0, \"intersect\", 1), "
      "\"minus\", "
      "2); }",
      "material { name = \"#1\"; diffuse = (0, 1, 0); } difference { intersection { scale(1.5, 1.5, 1.5, box "
      "{ "
      "material = \"#1\"; }) sphere { } } translate(0, 0, -0.5, scale(0.5, 0.5, 3, cylinder { })) }");
}

TEST(RayStudents, APartThatIsMissingIsReported) {
  const Loaded loaded = load("csg { a = sphere { }; operation = (\"a\", \"sub\", \"b\"); }");
  EXPECT_TRUE(loaded.scene.objects.empty());
  EXPECT_FALSE(loaded.scene.unrendered.empty());
}

TEST(RayStudents, PicturesBesideAMaterial) {
  expectSame(
      "sphere { material = { diffuse = (0.8, 0.3, 0.1); specular = (0.5, 0.5, 0.5); }; diffuse_map = "
      "\"a.png\"; }",
      "sphere { material = { specular = (0.5, 0.5, 0.5); diffuse = map(\"a.png\"); } }");
  expectSame("sphere { diffuse_map = \"a.png\"; }", "sphere { material = { diffuse = map(\"a.png\"); } }");
  expectSame("box { " + kRed + "; normal_map = \"n.png\"; }",
             "box { material = { diffuse = (1, 0, 0); normal_map = \"n.png\"; } }");
  expectSame(
      "box { " + kRed + "; bump_map = \"h.png\"; }",
      "box { material = { diffuse = (1, 0, 0); bump = texture(image { file = \"h.png\"; }, 0.02); } }");
  expectSame(
      "material { name = glass; transmissive = (0.9, 0.9, 0.9); index = 1.5; } box { material = glass; "
      "diffuse_map = \"a.png\"; }",
      "material { name = glass; transmissive = (0.9, 0.9, 0.9); index = 1.5; } { material = glass; box { "
      "material = { diffuse = map(\"a.png\"); } } }");
  expectSame("sphere { " + kRed + "; perlin_noise = { scale = 4; turbulence_depth = 5; } }",
             "sphere { material = { diffuse = texture(marble { a = (0, 0, 0); b = (1, 0, 0); frequency = " +
                 toText(4 / (2 * kPi)) + "; turbulence = " + toText(10 / (2 * kPi)) +
                 "; octaves = 5; rotate = (0, 90, 0); }); } }");
}

TEST(RayStudents, MaterialsOfTheirOwn) {
  expectSame(
      "sphere { material = { type = \"microfacet\"; albedo = (1, 0.6, 0); roughness = 0.7; metallic = 0.2; } "
      "}",
      "sphere { material = { model = principled; color = (1, 0.6, 0); roughness = 0.7; metallic = 0.2; } }");
  expectSame(
      "material { name = ink; transmissive = (0.8, 0.8, 0.8); absorb = (0, 8, 16); } box { material = ink; }",
      "material { name = ink; attenuation_color = (1, " + toText(std::exp(-8)) + ", " +
          toText(std::exp(-16)) +
          "); attenuation_distance = 1; transmissive = (0.8, 0.8, 0.8); } box { material = ink; }");
}

TEST(RayStudents, WhatShines) {
  const std::string half = toText(10 * kPi / 2);
  const std::string path = "settings { integrator = path; spp = 64; }";
  expectSame(
      "trimesh { " + kRed +
          "; emission = (40, 30, 20); points = ((0,0,0), (1,0,0), (0,1,0)); faces = ((0,1,2)); }",
      "trimesh { material = { diffuse = (1, 0, 0); emissive = (4, 3, 2); } points = ((0,0,0), (1,0,0), "
      "(0,1,0)); faces = ((0,1,2)); } " +
          path);
  expectSame(
      "translate(1, 2, 3, sphere_light { emission = (100, 50, 0); })",
      "translate(1, 2, 3, sphere { material = { emissive = (10, 5, 0); diffuse = (0, 0, 0); } }) " + path);
  expectSame("area_light { position = (0, 0, -4); u = (-1, 0, 0); v = (0, 2, 0); color = (1, 1, 1); }",
             "rectangle_light { position = (-0.5, 1, -4); u = (-1, 0, 0); v = (0, 2, 0); color = (" + half +
                 ", " + half + ", " + half + "); two_sided = true; }");
  expectSame(
      "spot_light { cutoff_distance = 500; penumbra = 10; cone_angle = 30; position = (0, 3, 6); target = "
      "(0, 0, 1); color "
      "= (1, 0, 0); }",
      "spot_light { position = (0, 3, 6); color = (1, 0, 0); direction = (0, -3, -5); angle = 30; full_angle "
      "= "
      "10; constant_attenuation_coeff = 1; linear_attenuation_coeff = 0.004; quadratic_attenuation_coeff = "
      "0.000012; }");
}

TEST(RayStudents, WhatMoves) {
  const std::string theirs =
      "camera { enable_motion_blur = true; time0 = 0; time1 = 1; fov = 50; } moving_sphere { radius = 0.3; "
      "start = "
      "(1, 0.4, 0); end = (1, 0.8, 0); time0 = 0; time1 = 0.5; " +
      kRed + "; }";
  expectSame(theirs,
             "camera { fov = 50; } settings { time = 0; shutter = 1; spp = 64; } translate(1, key((0, 0.4), "
             "(0.5, 0.8)), 0, scale(0.3, sphere { " +
                 kRed + "; }))");
  Messages messages;
  const Scene later = readRay("f.ray", "SBT-raytracer 1.0 " + theirs, messages, 0.25);
  EXPECT_NEAR((later.objects.at(0).worldFromObject * Vec3{}).y, 0.6, 1e-12);
}

TEST(RayStudents, Surroundings) {
  const std::string faces = "front = \"f.png\"; back = \"b.png\"; ";
  expectSame("skybox { " + faces + "}", "background { " + faces + "}");
  expectSame("translate(0, 1, 0, skybox { " + faces + "})", "background { " + faces + "}");
}

TEST(RayStudents, ShapesAndCrowds) {
  const Scene knot = load("torus_knot { " + kRed + "; radius = 1; tube = 0.15; p = 0.4; q = 3.5; }").scene;
  ASSERT_EQ(knot.objects.size(), 1u);
  const Box3 box = prepare(knot.objects[0].shape).bounds();
  EXPECT_NEAR(box.high.x, 1.5, 0.1);
  EXPECT_NEAR(box.high.y, 0.55, 0.05);
  EXPECT_EQ(load("torus_knot { q = 3; }").scene.objects.at(0).shape.operands().list().size(), 2u);
  EXPECT_EQ(load("hyperbolic { }").scene.objects.at(0).shape.keyword(), "quadric");
  EXPECT_EQ(load("metaball { size = 3; gridSize = 30; ball = ((0, 0, 0, 1), (1.5, -1.5, 1.5, 1)); }")
                .scene.objects.at(0)
                .shape.keyword(),
            "isosurface");
  EXPECT_EQ(load("fluid { size = 5; kernel_radius = 0.5; center = (0, 0, 0); tick = 40; initial_blocks = ({ "
                 "min = (-1, "
                 "-1, -1); max = (1, 1, 1); spacing = 0.5; }) }")
                .scene.objects.size(),
            64u);
  EXPECT_GT(
      load(
          "emitter { initial_material = { emissive = (0, 0, 1); }; end_material = { emissive = (1, 0, 0); }; "
          "emission_rate = 50; emission_cut = 4; initial_speed = 10; force = (0, -1, 0); drag = 0.2; tail = "
          "10; "
          "lifespan = 10; mass = 0.1; particle_radius = 0.01; source_position = (0, 2, 0); time_step = 0.01; "
          "tick "
          "= 100; }")
          .scene.objects.size(),
      1000u);
}

TEST(RayStudents, ANumberWithTwoPointsIsReadToTheSecond) {
  const Loaded loaded = load("translate(1, 0.3.0, 0, sphere { })");
  EXPECT_EQ((loaded.scene.objects.at(0).worldFromObject * Vec3{}).y, 0.3);
  EXPECT_NE(warningsOf("translate(1, 0.3.0, 0, sphere { })")
                .find("2:14: expected a number, found \"0.3.0\": it is read as 0.3"),
            std::string::npos);
}

TEST(RayStudents, MistakesInPartsKeepTheirPlaces) {
  try {
    load(
        "csg {\n  a = sphere { };\n  b = box { material = { diffuse = (1, 2); } };\n  operation = (\"a\", "
        "\"sub\", "
        "\"b\");\n}");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.messages().front().place.line, 4);
  }
}

TEST(RayStudents, ScenesOfTheFormatAreLeftAlone) {
  const std::string plain =
      "SBT-raytracer 1.0 spot_light { position = (0, 0, 1); direction = (0, 0, -1); color = (1, 1, 1); } "
      "sphere { }";
  EXPECT_FALSE(rayfile::speaksStudents(rayfile::Syntax("f.ray", plain)));
  EXPECT_TRUE(rayfile::speaksStudents(rayfile::Syntax("f.ray", "SBT-raytracer 1.0 hyperbolic { }")));
}

}  // namespace
}  // namespace trace::ray_students_test

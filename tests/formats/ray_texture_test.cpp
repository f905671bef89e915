// Textures in the text of .ray files.
#include <gtest/gtest.h>

#include "formats/ray/read/texture.h"
#include "formats/ray/write/writer.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/torus.h"
#include "ray_helpers.h"
#include "shading/texture_list.h"

namespace trace::ray_texture_test {
namespace {

std::vector<FieldTexture> texturesOf(const std::string& fields) {
  const Scene scene = load("sphere { material = { " + fields + " } }").scene;
  return scene.materials.at(scene.objects.at(0).material).textures;
}

const Texture kChecker = TextureNode{.model = Checker{.a = {1, 0, 0}}};

TEST(RayTexture, StandsInPlaceOfAConstant) {
  EXPECT_EQ(texturesOf("diffuse = checker { a = (1, 0, 0); };"),
            (std::vector<FieldTexture>{{"diffuse", kChecker}}));
  const Scene scene = load(
                          "sphere { material = { diffuse = texture(checker { a = (1, 0, 0); }, 0.5);"
                          "shininess = texture(checker { a = (1, 0, 0); }, 40); } }")
                          .scene;
  const Material& material = scene.materials.at(scene.objects.at(0).material);
  EXPECT_EQ(material.textures, (std::vector<FieldTexture>{{"diffuse", kChecker}, {"shininess", kChecker}}));
  EXPECT_EQ(phongOf(material).diffuse, Color(0.5));
  EXPECT_EQ(phongOf(material).shininess, 40);
}

TEST(RayTexture, PatternFieldsMoveAllPatternsOfAMaterial) {
  const std::string marble = "library = \"green marble\"; opacity = checker { }; ";
  const auto at = [&](const std::string& fields, const char* field, const Vec3& point) -> Real {
    TexturePlace place;
    place.point = point;
    const std::vector<FieldTexture> textures = texturesOf(marble + fields);
    const Texture* texture = textureOf(textures, field);
    return texture ? luminance(texture->at(place)) : -1;
  };
  const Vec3 point{0.3, 0.45, -0.2};
  for (const char* field : {"diffuse", "opacity"}) {
    EXPECT_NEAR(at("pattern_translate = (1, 2, 3)", field, point + Vec3{1, 2, 3}), at("", field, point),
                1e-9);
    EXPECT_NEAR(at("pattern_scale = 4", field, point * 4), at("", field, point), 1e-9);
    EXPECT_NEAR(at("pattern_translate = (8, 0, 0); pattern_scale = (2, 4, 8)", field,
                   Vec3{2 * point.x + 8, 4 * point.y, 8 * point.z}),
                at("", field, point), 1e-9)
        << "in the order of textures: scaled, then moved";
    EXPECT_EQ(at("pattern_rotate = (0, 0, 0)", field, point), at("", field, point));
    EXPECT_GE(at("", field, point), 0);
  }
  EXPECT_EQ(load("sphere { material = { library = gold; pattern_scale = 2 } }").warnings.at(0).what,
            "pattern_scale and the like: this material has no pattern");
  EXPECT_EQ(texturesOf("diffuse = map(\"a.png\"); pattern_scale = 2"), texturesOf("diffuse = map(\"a.png\")"))
      << "a picture lies in u and v";
  EXPECT_NE(errorsOf("sphere { material = { pattern_scale = big } }"), "");
  EXPECT_EQ(load("sphere { material = { library = oak; pattern_space = world } }")
                .scene.materials.back()
                .patternSpace,
            PatternSpace::world);
  EXPECT_NE(errorsOfFile("Trace 1\nsphere { material = { pattern_size = 2 } }"), "");
}

Real other(Real value) { return value / 2 + 0.125; }
int other(int value) { return value + 1; }
bool other(bool value) { return !value; }
Color other(const Color& c) { return {other(c.r), other(c.g), other(c.b)}; }
Vec3 other(const Vec3& v) { return {other(v.x), other(v.y), other(v.z)}; }
ColorRamp other(const ColorRamp&) { return {{0.25, 1, 0, 0}, {0.5, 0, 1, 0.5}}; }
std::array<Real, 6> other(const std::array<Real, 6>&) { return {1, 2, 3, 4, 5, 6}; }
Pixels other(const Pixels&) { return {"a.png", nullptr, {}}; }
FormulaText other(const FormulaText&) { return FormulaText("x + u"); }
template <class Enum>
requires std::is_enum_v<Enum> Enum other(Enum value) {
  EnumValue any(value);
  any.set(any.names().size() - 1);
  return value;
}

// Every field of every texture, and a placement.
TEST(RayTexture, OfEveryKindIsWrittenAsItIsRead) {
  forEachType<TextureList>([](auto* type) {
    using Model = std::remove_pointer_t<decltype(type)>;
    SCOPED_TRACE(std::string(Model::kKeyword));
    Model model;
    forEachField<Model>([&](const auto& f) { model.*f.member = other(model.*f.member); });
    Scene scene = load("sphere {}").scene;
    scene.materials.at(0).textures = {
        {"diffuse", TextureNode{.model = model, .placement = {.scale = {1, 2, 3}, .translate = {4, 5, 6}}}}};
    Messages messages;
    const std::string written = writeRay(scene, "b.ray", {}, messages).at(0).bytes;
    const Scene back = readScene("b.ray", written, messages);
    EXPECT_EQ(back.materials, scene.materials) << written;
  });
}

// color (l + (1 - l) sin(f (x + ...))): brightest where f x is a quarter of a turn, black where it is three.
TEST(RayTexture, ReadsTheMarbleOfStudents) {
  const auto textures = texturesOf(
      "diffuse = marble { color = (0.6, 0, 1); lightness = 0.5; contrast = 0; frequency = 25; scale = (1, 1, "
      "2);"
      " depth = 3; };");
  const TextureNode& node = *textures.at(0).texture;
  EXPECT_EQ(node.model.as<Marble>()->octaves, 3);
  EXPECT_EQ(node.model.as<Marble>()->grain, (Vec3{1, 1, 2}));
  const auto at = [&](Real turns) {
    TexturePlace place;
    place.point = {turns * 2 * kPi / 25, 3, 4};
    return textures.at(0).texture.at(place);
  };
  for (const Real turn : {0.0, 1.0, 7.0}) {
    EXPECT_NEAR(at(turn + 0.25).b, 1, 1e-9);
    EXPECT_NEAR(at(turn + 0.75).b, 0, 1e-9);
    EXPECT_NEAR(at(turn).b, 0.5, 1e-9);
    EXPECT_NEAR(at(turn).r, 0.3, 1e-9);
    EXPECT_EQ(at(turn).g, 0);
  }
  const auto dark = texturesOf("diffuse = marble { color = (1, 1, 1); lightness = 0.25; contrast = 0; };");
  TexturePlace place;
  place.point = {1.5 * kPi, 0, 0};
  EXPECT_EQ(dark.at(0).texture.at(place).r, 0) << "never below black";
}

TEST(RayTexture, KnowsOtherNamesOfKinds) {
  EXPECT_EQ(texturesOf("diffuse = checkerboard { a = (1, 0, 0); };"),
            (std::vector<FieldTexture>{{"diffuse", kChecker}}));
}

TEST(RayTexture, SaysWhereAFormulaIsWrong) {
  EXPECT_EQ(errorsOf("sphere { material = { diffuse = formula { red = \"x + w\"; } } }"),
            "2:49: red: formula: expected x, y, z, u, v, pi or a function at character 5, found \"w\"");
}

TEST(RayTexture, APictureStandsInATextureWithItsConstantToo) {
  const auto read = [](const std::string& value, const std::string& field) {
    const Scene scene = load("sphere { material = { " + field + " = " + value + "; } }").scene;
    return scene.materials.at(scene.objects.at(0).material);
  };
  const std::pair<const char*, const char*> kFields[] = {
      {"shininess", "60"}, {"diffuse", "(0.5, 0.25, 1)"}, {"specular", "0.5"},     {"ambient", "0.5"},
      {"emissive", "0.5"}, {"reflective", "0.5"},         {"transmissive", "0.5"}, {"bump", "0.1"},
      {"opacity", "0.5"}};
  for (const auto& [field, constant] : kFields) {
    const std::string with = std::string(", ") + constant + ")";
    EXPECT_EQ(read("texture(map(\"f.png\")" + with, field), read("map(\"f.png\"" + with, field)) << field;
    EXPECT_EQ(read("texture(map(\"f.png\"))", field), read("map(\"f.png\")", field)) << field;
    EXPECT_FALSE(read("texture(map(\"f.png\"))", field).textures.empty()) << field;
  }
  for (const char* field : {"normal", "normal_map"})
    EXPECT_EQ(read("texture(map(\"f.png\"))", field), read("map(\"f.png\")", field)) << field;
  EXPECT_EQ(read("checker { a = texture(map(\"f.png\"), 0.5); }", "diffuse"),
            read("checker { a = map(\"f.png\", 0.5); }", "diffuse"));
  EXPECT_NE(errorsOf("sphere { material = { shininess = texture(map(3), 60); } }"), "");
}

TEST(RayTexture, BendsNormalsByHeights) {
  const Scene scene = load(
                          "sphere { material = { bump = texture(checker { a = (1, 0, 0); }, 0.1); } }\n"
                          "sphere { material = { bump_mapping = bump(\"b.png\"); } }")
                          .scene;
  const auto material = [&](std::size_t i) { return scene.materials.at(scene.objects.at(i).material); };
  EXPECT_EQ(material(0).bump, 0.1);
  EXPECT_EQ(material(0).textures, (std::vector<FieldTexture>{{"bump", kChecker}}));
  EXPECT_GT(material(1).bump, 0);
  EXPECT_EQ(material(1).textures, (std::vector<FieldTexture>{{"bump", rayfile::mappedPicture("b.png")}}));
  Messages messages;
  const std::string written = writeRay(scene, "b.ray", {}, messages).at(0).bytes;
  EXPECT_EQ(readScene("b.ray", written, messages).materials, scene.materials) << written;
  EXPECT_NE(errorsOf("sphere { material = { bump = 0.5; } }"), "");
}

TEST(RayTexture, ReadsTheNormalMapsAndCoordinatesOfStudents) {
  const Scene scene = load(
                          "square { material = { normal = \"b.png\"; } }"
                          "square { material = { normal_map = map(\"b.png\"); } }"
                          "polymesh { points = ((0, 0, 0), (1, 0, 0), (0, 1, 0)); faces = ((0, 1, 2)); "
                          "map_points = ((0, 0), (0.5, 0), (0, 0.5)); }"
                          "torus { a = 2; b = 0.25; }")
                          .scene;
  for (const std::size_t i : {0u, 1u}) {
    const Material& material = scene.materials.at(scene.objects.at(i).material);
    const auto& map = *material.textures.at(0).texture->model.as<ImageMap>();
    EXPECT_EQ(material.textures.at(0).field, "bump");
    EXPECT_EQ(map.relief, Relief::normals);
    EXPECT_EQ(map.file.file, "b.png");
    EXPECT_EQ(material.bump, 1);
  }
  EXPECT_EQ(scene.objects.at(2).shape.as<Mesh>()->data->uvs, (std::vector<Vec2>{{0, 0}, {0.5, 0}, {0, 0.5}}));
  EXPECT_EQ(scene.objects.at(3).shape.as<Torus>()->majorRadius, 2);
  EXPECT_EQ(scene.objects.at(3).shape.as<Torus>()->minorRadius, 0.25);
}

TEST(RayTexture, DisplacesMeshes) {
  const Scene scene = load(
                          "sphere { material = { displacement = texture(checker { a = (1, 0, 0); }, -0.1); "
                          "displacement_levels = 3; } }\n"
                          "sphere { material = { displacement = 0.5; } }\n"
                          "union { sphere { material = { displacement_levels = 2; } } "
                          "box { material = { displacement = 0.2; } } }")
                          .scene;
  const auto material = [&](std::size_t i) { return scene.materials.at(scene.objects.at(i).material); };
  EXPECT_EQ(material(0).displacement, -0.1);
  EXPECT_EQ(material(0).displacementLevels, 3);
  EXPECT_EQ(material(0).textures, (std::vector<FieldTexture>{{"displacement", kChecker}}));
  EXPECT_EQ(material(1).displacement, 0.5) << "the same everywhere";
  EXPECT_EQ(material(1).displacementLevels, 0);
  Messages messages;
  const std::string written = writeRay(scene, "b.ray", {}, messages).at(0).bytes;
  EXPECT_EQ(readScene("b.ray", written, messages).materials, scene.materials) << written;
  EXPECT_NE(errorsOf("sphere { material = { displacement_levels = checker { }; } }"), "");
  EXPECT_FALSE(load("sphere { material = { displacement_levels = 40; } }").warnings.empty());
}

TEST(RayTexture, HasANameForOthers) {
  const Scene scene =
      load(
          "texture = checker { name = floor; a = (1, 0, 0); }\n"
          "sphere { material = { diffuse = texture(\"floor\"); } }\n"
          "box { material = { ambient = checker { a = texture(floor, 0.5); scale = (2, 2, 2); } } }")
          .scene;
  const auto textures = [&](std::size_t i) {
    return scene.materials.at(scene.objects.at(i).material).textures;
  };
  EXPECT_EQ(textures(0).at(0).texture->name, "floor");
  const TextureNode& outer = *textures(1).at(0).texture;
  EXPECT_EQ(outer.inputs.at(0).texture, textures(0).at(0).texture);
  EXPECT_EQ(outer.model.as<Checker>()->a, Color(0.5));
  EXPECT_EQ(outer.placement.scale, (Vec3{2, 2, 2}));
}

TEST(RayTexture, TellsWhatIsWrong) {
  EXPECT_NE(errorsOf("sphere { material = { diffuse = marbel { }; } }").find("did you mean \"marble\"?"),
            std::string::npos);
  EXPECT_EQ(errorsOf("sphere { material = { diffuse = texture(\"flor\"); } }"),
            "2:41: expected the name of a texture, found \"flor\" [a texture is named before its first use: "
            "texture "
            "= checker { name = floor; ... }]");
  EXPECT_EQ(
      errorsOf("texture = checker { name = floor; }\nsphere { material = { diffuse = texture(\"flor\"); } }"),
      "3:41: expected the name of a texture, found \"flor\" [did you mean \"floor\"?]");
  EXPECT_EQ(
      errorsOf("texture = cheker { name = floor; }"),
      "2:11: texture: expected a texture, as in checker { }, found cheker { name = floor; } [did you mean "
      "\"checker\"?]");
  EXPECT_EQ(errorsOf("sphere { material = { diffuse = checker { a = 1, 2; } } }"),
            "2:50: checker: expected a field, as in name = value, found 2");
  EXPECT_EQ(warningsOf("sphere { material = { diffuse = checker { c = 1; }; } }"),
            "2:43: unknown field \"c\" of checker is ignored [did you mean \"a\"?]");
}

TEST(RayTexture, WarnsOfWhatShowsNothing) {
  const auto warned = [](const std::string& texture) {
    return warningsOf("sphere { material = { diffuse = " + texture + "; } }");
  };
  EXPECT_NE(warned("checker { scale = (0, 1, 1); }").find("the scale of a texture has a 0"),
            std::string::npos);
  EXPECT_NE(warned("image { }").find("image: expected a file"), std::string::npos);
  EXPECT_NE(warned("formula { }").find("formula: expected value"), std::string::npos);
  EXPECT_EQ(warned("formula { value = \"u\"; }"), "");
}

TEST(RayTexture, HoldsOnlySoManyInOneAnother) {
  std::string text = "texture = checker { name = t0; }\n";
  for (int i = 1; i <= 40; ++i) {  // each has the one before it in two places
    const std::string n = std::to_string(i), before = "texture(\"t" + std::to_string(i - 1) + "\")";
    text += "texture = mix { name = t" + n + "; a = " + before + "; b = " + before + "; }\n";
  }
  const std::string errors = errorsOf(text);
  EXPECT_NE(errors.find("expected at most 1000 textures in one another, found 1023"), std::string::npos)
      << errors;
}

TEST(RayTexture, IsWrittenAsItIsRead) {
  Messages messages;
  const char* text =
      "texture = checker { name = floor; a = (1, 0, 0); scale = (2, 2, 2); rotate = (0, 0, 45); }\n"
      "sphere { material = { diffuse = texture(floor, 0.5); shininess = texture(floor, 3); "
      "specular = image { file = \"a.png\"; wrap_u = mirror; channel = alpha; transform = (2, 0, 0, 0, 2, "
      "0); };"
      "ambient = map(\"b.png\"); emissive = checker { b = map(\"c.png\", 0.25); }; } }";
  const Scene scene = load(text).scene;
  const std::string written = writeRay(scene, "b.ray", {}, messages).at(0).bytes;
  const Scene back = readScene("b.ray", written, messages);
  EXPECT_EQ(back.materials, scene.materials) << written;
  EXPECT_EQ(written.find("checker { name"), written.rfind("checker { name"))
      << "what has a name is said once";
}

}  // namespace
}  // namespace trace::ray_texture_test

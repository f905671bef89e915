// What extensions of glTF materials become.
#include "model_texture_helpers.h"
#include "shading/materials/principled.h"
#include "shading/materials/rough_glass.h"
#include "shading/materials/thin_glass.h"
#include "shading/textures/image_map.h"

namespace trace::gltf_extensions_test {
namespace {

using namespace test;

TEST(GltfExtensions, ClearCoat) {
  const Read read = extended("KHR_materials_clearcoat",
                             R"("clearcoatFactor": 0.8, "clearcoatTexture": {"index": 0},
"clearcoatRoughnessFactor": 0.3, "clearcoatRoughnessTexture": {"index": 0})");
  EXPECT_EQ(read.warnings(), "");
  EXPECT_EQ(principledOf(read).clearcoat, 0.8);
  EXPECT_EQ(principledOf(read).clearcoatRoughness, 0.3);
  EXPECT_EQ(read.at("clearcoat", kTopLeft), Color(1)) << "red";
  EXPECT_EQ(read.at("clearcoat", kTopRight), Color(0));
  EXPECT_EQ(read.at("clearcoat_roughness", kTopRight), Color(1)) << "green";
}

TEST(GltfExtensions, AClearCoatHasItsOwnNormals) {
  const Read bumpy = extended("KHR_materials_clearcoat", R"("clearcoatFactor": 1,
"clearcoatNormalTexture": {"index": 0, "scale": 0.25})");
  EXPECT_EQ(bumpy.warnings(), "");
  EXPECT_EQ(principledOf(bumpy).clearcoatBump, 0.25);
  EXPECT_TRUE(principledOf(bumpy).clearcoatApart);
  expectUpright(bumpy, "clearcoat_bump");
  EXPECT_EQ(bumpy.texture("clearcoat_bump")->model.as<ImageMap>()->relief, Relief::normals);

  const auto with = [](const char* extension) {
    return Read("a.gltf",
                gltf(std::string(R"("normalTexture": {"index": 0}, "extensions": {)") + extension + "}"));
  };
  const Read smooth = with(R"("KHR_materials_clearcoat": {"clearcoatFactor": 1})");
  EXPECT_TRUE(principledOf(smooth).clearcoatApart) << "the base's normals are not the coat's";
  EXPECT_EQ(textureOf(smooth.material().textures, "clearcoat_bump"), nullptr);
}

TEST(GltfExtensions, ASheetMayPassAPartOfTheLight) {
  const std::string part = R"("transmissionFactor": 0.25, "transmissionTexture": {"index": 0})",
                    maps = R"("baseColorFactor": [1, 0.5, 0.2, 1], "metallicFactor": 0.5,
"metallicRoughnessTexture": {"index": 0})";
  const Read sheet = extended("KHR_materials_transmission", part, maps);
  EXPECT_EQ(sheet.warnings(), "");
  EXPECT_EQ(principledOf(sheet).transmission, 0.25);
  EXPECT_EQ(principledOf(sheet).color, Color(1, 0.5, 0.2));
  EXPECT_EQ(sheet.at("transmission", kTopLeft), Color(1)) << "red";
  EXPECT_EQ(sheet.at("transmission", kTopRight), Color(0));
  EXPECT_EQ(sheet.at("metallic", kBottomLeft), Color(1)) << "blue";
  EXPECT_EQ(sheet.at("roughness", kTopRight), Color(1)) << "green";

  const Read body = extended("KHR_materials_transmission", part, maps, picture(),
                             R"(, "KHR_materials_volume": {"thicknessFactor": 2})");
  EXPECT_TRUE(body.material().model.is<Phong>()) << "it bends light";
  EXPECT_NE(body.warnings().find("is not rendered yet"), std::string::npos);
}

TEST(GltfExtensions, Sheen) {
  const Read read = extended("KHR_materials_sheen", R"("sheenColorFactor": [0.9, 0.5, 0.1],
"sheenColorTexture": {"index": 0}, "sheenRoughnessFactor": 0.4, "sheenRoughnessTexture": {"index": 0})",
                             "", picture(true));
  EXPECT_EQ(principledOf(read).sheen, Color(0.9, 0.5, 0.1));
  EXPECT_EQ(principledOf(read).sheenRoughness, 0.4);
  expectUpright(read, "sheen");
  EXPECT_EQ(read.at("sheen_roughness", kTopRight), Color(0)) << "its alpha";
}

TEST(GltfExtensions, AnisotropyDrawsTheHighlightOutAsFar) {
  const Read read = extended("KHR_materials_anisotropy",
                             R"("anisotropyStrength": 0.5, "anisotropyRotation": 1.5707963267948966)",
                             "\"roughnessFactor\": 0.6");
  EXPECT_NEAR(principledOf(read).angle, 90, 1e-9);
  // By the extension: 0.6^2 across the tangent, and along it a quarter of the way from there to 1.
  const Microfacets facets =
      Microfacets::of(Distribution::ggx, principledOf(read).roughness, principledOf(read).anisotropy);
  EXPECT_NEAR(facets.y, 0.36, 1e-9);
  EXPECT_NEAR(facets.x, 0.36 + 0.64 * 0.25, 1e-9);
}

TEST(GltfExtensions, Specular) {
  const Read read =
      extended("KHR_materials_specular", R"("specularFactor": 0.5, "specularTexture": {"index": 0},
"specularColorFactor": [1, 0.5, 0.2], "specularColorTexture": {"index": 0})",
               "\"metallicFactor\": 0", picture(true));
  EXPECT_EQ(principledOf(read).specularStrength, 0.5);
  EXPECT_EQ(principledOf(read).specularColor, Color(1, 0.5, 0.2));
  EXPECT_EQ(read.at("specular_strength", kTopRight), Color(0)) << "its alpha";
  expectUpright(read, "specular_color");
}

TEST(GltfExtensions, SpecularGlossiness) {
  const Read read = extended("KHR_materials_pbrSpecularGlossiness",
                             R"("diffuseFactor": [0.5, 0.4, 0.3, 1], "diffuseTexture": {"index": 0},
"specularFactor": [0.2, 0.1, 0.05], "glossinessFactor": 0.8, "specularGlossinessTexture": {"index": 0})",
                             "", picture(true));
  const Principled& model = principledOf(read);
  EXPECT_EQ(model.metallic, 0);
  EXPECT_EQ(model.color, Color(0.5, 0.4, 0.3));
  EXPECT_NEAR(model.plasticMirrors().r, 0.2, 1e-12);
  EXPECT_NEAR(model.plasticMirrors().b, 0.05, 1e-12);
  expectUpright(read, "color");
  expectUpright(read, "specular_color");
  EXPECT_NEAR(model.roughness * read.at("roughness", kTopLeft).r, 0.2, 1e-12) << "1 - 0.8 times alpha 1";
  EXPECT_NEAR(model.roughness * read.at("roughness", kTopRight).r, 1, 1e-12) << "alpha 0";
}

TEST(GltfExtensions, WhatAllLightPassesIsGlass) {
  const std::string all = "\"transmissionFactor\": 1", red = R"("baseColorFactor": [1, 0.5, 0.2, 1],
"metallicFactor": 0, "roughnessFactor": 0.3)";
  const auto read = [&](const std::string& base, const std::string& also) {
    return extended("KHR_materials_transmission", all, base, picture(), also);
  };
  const Read body = read(red, R"(, "KHR_materials_volume": {"thicknessFactor": 2, "attenuationDistance": 0.5,
"attenuationColor": [0.9, 0.8, 0.7]}, "KHR_materials_ior": {"ior": 1.7}, "KHR_materials_dispersion": {"dispersion": 0.5})");
  EXPECT_EQ(body.warnings(), "");
  const auto& glass = *body.material().model.as<RoughGlass>();
  EXPECT_EQ(glass.color, Color(1, 0.5, 0.2));
  EXPECT_EQ(glass.roughness, 0.3);
  EXPECT_EQ(glass.index, 1.7);
  EXPECT_EQ(glass.attenuationColor, Color(0.9, 0.8, 0.7));
  EXPECT_EQ(glass.attenuationDistance, 0.5);
  EXPECT_EQ(glass.abbe, 40) << "20 by the dispersion";

  const Read sheet = read("\"metallicFactor\": 0, \"roughnessFactor\": 0", "");
  EXPECT_TRUE(sheet.material().model.is<ThinGlass>());
  const Read frosted = read(red, "");
  EXPECT_EQ(frosted.material().model.as<Phong>()->index, 1) << "a sheet does not bend light";
}

TEST(GltfExtensions, APictureSaysWhereLightPasses) {
  const Read read =
      extended("KHR_materials_transmission",
               R"("transmissionFactor": 0.5, "transmissionTexture": {"index": 0})", "\"metallicFactor\": 0");
  EXPECT_EQ(read.warnings(), "");
  EXPECT_NEAR(read.phongAt(kTopLeft).transmissive.g, 0.5, 1e-12) << "red passes";
  EXPECT_NEAR(read.phongAt(kTopLeft).diffuse.g, 0.5, 1e-12) << "the rest is scattered";
  EXPECT_EQ(read.phongAt(kTopRight).transmissive, Color(0));
  EXPECT_NEAR(read.phongAt(kTopRight).diffuse.g, 1, 1e-12);
}

TEST(GltfExtensions, UnlitShowsItsColourInAnyLight) {
  const Read read = extended("KHR_materials_unlit", "", "\"baseColorTexture\": {\"index\": 0}");
  EXPECT_EQ(read.warnings(), "");
  expectUpright(read, "emissive");
  const Phong phong = phongOf(read.material().model);
  EXPECT_EQ(phong.emissive, kWhite);
  EXPECT_TRUE(isBlack(phong.diffuse) && isBlack(phong.ambient) && isBlack(phong.specular));
}

TEST(GltfExtensions, MeshesWithoutCoordinatesShowOneCorner) {
  std::string text = gltf(kBase);
  text.replace(text.find("TEXCOORD_0"), 10, "TEXCOORD_1");
  const Read read("a.gltf", text);
  EXPECT_EQ(read.mesh().uvs, (std::vector<Vec2>{{0, 1}, {0, 1}, {0, 1}}));
  EXPECT_NE(read.warnings().find("without the texture coordinates of their pictures"), std::string::npos);
}

}  // namespace
}  // namespace trace::gltf_extensions_test

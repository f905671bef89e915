// The parts of scenes that can be switched off.
#include "scene/scene_features.h"

#include <gtest/gtest.h>

#include <set>

#include "scene/options.h"
#include "shading/lights/goniometric_light.h"
#include "shading/lights/point_light.h"
#include "shading/lights/projector_light.h"
#include "shading/lights/spot_light.h"
#include "shading/lights/warn_light.h"

namespace trace::test {
namespace {

EnumSet<SceneFeature> only(std::string_view name) {
  Settings settings;
  findOption("switched-off").assign(settings, name);
  return settings.switchedOff;
}

TEST(SceneFeatures, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const SceneFeatureRow& row : sceneFeatures()) EXPECT_TRUE(names.insert(row.name).second) << row.name;
  EXPECT_TRUE(names.contains("medium"));
  EXPECT_TRUE(names.contains("ward"));
  EXPECT_FALSE(names.contains(Phong::kKeyword)) << "it is what takes their place";
}

TEST(SceneFeatures, ChangeTheirPartAlone) {
  Material material;
  material.bump = 0.1;
  material.displacement = 0.2;
  material.opacity = 0.5;
  material.castsShadow = false;
  material.mediumDensity = 3;
  Material expected = material;
  expected.bump = 0;
  EXPECT_EQ(withoutFeatures(material, only("bump")), expected);
  expected = material;
  expected.displacement = 0;
  EXPECT_EQ(withoutFeatures(material, only("displacement")), expected);
  expected = material;
  expected.opacity = 1;
  EXPECT_EQ(withoutFeatures(material, only("opacity")), expected);
  expected = material;
  expected.castsShadow = true;
  EXPECT_EQ(withoutFeatures(material, only("casts_shadow")), expected);
  EXPECT_TRUE(castsShadows({.name = {}, .castsShadows = false}, only("casts_shadow")));
  EXPECT_FALSE(castsShadows({.name = {}, .castsShadows = false}, only("opacity")));
  expected = material;
  expected.mediumDensity = 0;
  EXPECT_EQ(withoutFeatures(material, only("medium")), expected);
  for (const SceneFeatureRow& row : sceneFeatures())
    if (row.name.find("_light") != row.name.npos) {
      EXPECT_EQ(withoutFeatures(material, only(row.name)), material) << row.name;
    }
}

TEST(SceneFeatures, AModelThatIsOffIsPhong) {
  for (const ModelType& type : modelTypes()) {
    Material material;
    material.model = MaterialModel(type);
    EXPECT_EQ(withoutFeatures(material, only("medium")), material) << type.keyword;
    if (type.keyword == Phong::kKeyword) continue;
    EXPECT_TRUE(withoutFeatures(material, only(type.keyword)).model.is<Phong>()) << type.keyword;
    EXPECT_EQ(withoutFeatures(material, only(type.keyword == "ward" ? "velvet" : "ward")), material)
        << type.keyword << " stays if another is off";
  }
}

TEST(SceneFeatures, ALightThatIsOffIsAPointLightThere) {
  SpotLight spot;
  spot.position = {1, 2, 3};
  spot.color = Color(0.5, 0.6, 0.7);
  spot.constant = 0.1, spot.linear = 0.2, spot.quadratic = 0.3, spot.radius = 0.4;
  const auto light = lightWithout(spot, only("spot_light"));
  ASSERT_TRUE(light.has_value());
  const auto* point = light->as<PointLight>();
  ASSERT_NE(point, nullptr);
  EXPECT_EQ(point->position, spot.position);
  EXPECT_EQ(point->color, spot.color);
  EXPECT_EQ(point->constant, 0.1);
  EXPECT_EQ(point->linear, 0.2);
  EXPECT_EQ(point->quadratic, 0.3);
  EXPECT_EQ(point->radius, 0.4);
  EXPECT_FALSE(lightWithout(spot, only("warn_light")).has_value());
  EXPECT_FALSE(lightWithout(spot, {}).has_value());
  EXPECT_TRUE(lightWithout(WarnLight{}, only("warn_light")).has_value());
  EXPECT_TRUE(lightWithout(GoniometricLight{}, only("goniometric_light")).has_value());
  EXPECT_TRUE(lightWithout(ProjectorLight{}, only("projector_light")).has_value());
  EXPECT_FALSE(lightWithout(PointLight{}, only("spot_light")).has_value());
}

}  // namespace
}  // namespace trace::test

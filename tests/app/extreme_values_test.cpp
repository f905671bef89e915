// Numbers that nobody means: each field of each shape, light, camera, material and texture, and each operand
// of solids, at 0, below it, and far beyond what can be squared. Reading refuses with file, line and column,
// or the picture is finite, and comes after work that a count bounds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/lint/lint.h"
#include "app/session/session.h"
#include "app/view/space/scene_model.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/looks.h"
#include "formats/format.h"
#include "geometry/field_value.h"
#include "geometry/shape.h"
#include "shading/light_list.h"
#include "shading/material.h"
#include "shading/material_list.h"
#include "shading/texture.h"
#include "shading/texture_list.h"
#include "support/folder.h"
#include "support/shapes.h"

namespace trace::test::extreme_values_test {
namespace {

constexpr const char* kNumbers[] = {"0",    "-1",   "1e-300", "1e-38", "1e17",
                                    "1e38", "1e76", "-1e200", "1e200", "1e308"};

/// A ball on a floor under a sky and a light.
constexpr const char* kRoom = R"(SBT-raytracer 1.0
background { gradient = ((0.1,0.1,0.1),(0.9,0.9,1)); }
rotate(1,0,0,-1.5708, scale(10, square { material = { diffuse = (0.7,0.7,0.7); }; }))
translate(0,1,0, sphere { material = { diffuse = (0.7,0.3,0.3); }; })
)";
constexpr const char* kLight = "point_light { position = (-3,4,2); color = (1,1,1); }\n";
constexpr const char* kCamera =
    "camera { position = (0,1,6); viewdir = (0,0,-1); updir = (0,1,0); fov = 40; }\n";

class ExtremeValues : public testing::Test {
 protected:
  /// The scene of the room and `more` is refused where it stands, or seen.
  void expectRefusedOrSeen(const std::string& more,
                           std::initializer_list<const char*> integrators = {"whitted", "path"}) {
    SCOPED_TRACE(more);
    writeFile(folder_ / "a.ray", kRoom + more);
    constexpr std::int64_t kMostLooks = 100000;  // of a room and one thing more
    std::int64_t looks = 0;
    Budget budget([&] {
      if (++looks > kMostLooks) throw Error(Fault::limit, "too much work");
    });
    const BudgetScope scope(&budget);
    for (const char* integrator : integrators) {
      try {
        Session session;
        session.open(folder_ / "a.ray", std::vector<Choice>{{"integrator", integrator, {}},
                                                            {"width", "4", {}},
                                                            {"height", "4", {}},
                                                            {"depth", "3", {}},
                                                            {"photons", "500", {}},
                                                            {"threads", "1", {}}});
        session.build();
        looks = 0;
        session.renderPicture();
        const Picture picture = session.film().picture();
        for (int y = 0; y < picture.height; ++y)
          for (int x = 0; x < picture.width; ++x) {
            const Color c = picture.at(x, y);
            ASSERT_TRUE(std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b))
                << integrator << " " << x << "," << y << ": " << c.r << " " << c.g << " " << c.b;
          }
      } catch (const Error& error) {
        EXPECT_NE(error.fault(), Fault::limit) << error.what();
        for (const Message& m : error.messages())
          EXPECT_TRUE(m.place.line > 0 && m.place.column > 0 && m.place.file.str().ends_with("a.ray"))
              << toString(m);
      }
      if (HasFailure()) return;
    }
  }
  /// The forms that the value of a field of that type may have with such a number in it; none of what is no
  /// number.
  template <class Value>
  static std::vector<std::string> forms(const Value&, const std::string& number) {
    using Plain = std::remove_cvref_t<Value>;
    if constexpr (std::is_same_v<Plain, Real> || std::is_same_v<Plain, int>)
      return {number};
    else if constexpr (std::is_same_v<Plain, Vec3> || std::is_same_v<Plain, Color>)
      return {"(" + number + "," + number + "," + number + ")", "(0," + number + ",0.5)"};
    else if constexpr (std::is_same_v<Plain, std::array<Real, 4>>)
      return {"(" + number + ",0.5,0," + number + ")"};
    else
      return {};
  }
  /// Calls use(field, form) for each number in each field of the struct.
  template <class Struct, class Use>
  void inEachField(Use use) {
    const Struct usual{};
    trace::forEachField<Struct>([&](const auto& field) {
      for (const char* number : kNumbers)
        for (const std::string& form : forms(usual.*field.member, number))
          use(std::string(field.keyword), form);
    });
  }

  test::Folder folder_;
};

TEST_F(ExtremeValues, OfEachShape) {
  for (const ShapeType& type : shapeTypes()) {
    if (type.ofObjects) continue;
    const std::string keyword(type.keyword);
    forEachField(Shape(type), [&](const AnyField& field, const auto& value) {
      for (const char* number : kNumbers)
        for (const std::string& form : forms(value, number))
          expectRefusedOrSeen(std::string(kCamera) + kLight + "translate(1,1,1, " + keyword + " { " +
                                  std::string(field.keyword) + " = " + form + "; })",
                              {"whitted"});
    });
  }
}

TEST_F(ExtremeValues, OfThePlaceOfEachShape) {
  for (const ShapeType& type : shapeTypes()) {
    if (type.ofObjects) continue;
    for (const std::string number :
         {"1e17", "1e60", "1e100", "1e200", "1e308", "1e-60", "1e-100", "1e-300"}) {
      const std::string shape(std::string(type.keyword) + " { }");
      for (const std::string& place :
           {"translate(" + number + ",0,0, " + shape + ")", "scale(" + number + ", " + shape + ")",
            "scale(1," + number + ",1, " + shape + ")", "rotate(0," + number + ",0,1, " + shape + ")"})
        expectRefusedOrSeen(std::string(kCamera) + kLight + place, {"whitted"});
    }
  }
}

TEST_F(ExtremeValues, OfOperandsOfSolids) {
  for (const ShapeType& type : shapeTypes()) {
    if (!type.ofObjects) continue;
    for (const std::string number : {"1e17", "1e60", "1e100", "1e200", "1e308", "1e-60", "1e-100", "1e-300"})
      for (const std::string inner : {"sphere { }", "box { }", "torus { }", "mandelbulb { }", "plane { }"})
        for (const std::string& operand :
             {"translate(" + number + ",0,0, " + inner + ")", "scale(" + number + ", " + inner + ")",
              "scale(1," + number + ",1, " + inner + ")"})
          for (const std::string& solid :
               {std::string(type.keyword) + " { objects = { sphere { } " + operand + " }; }",
                std::string(type.keyword) + " { objects = { " + operand + " sphere { } }; }"})
            expectRefusedOrSeen(std::string(kCamera) + kLight + solid, {"whitted"});
  }
}

TEST_F(ExtremeValues, OfEachLight) {
  forEachType<LightList>([&]<class Kind>(Kind*) {
    inEachField<Kind>([&](const std::string& field, const std::string& form) {
      expectRefusedOrSeen(
          std::string(kCamera) + std::string(Kind::kKeyword) + " { " + field + " = " + form + "; }",
          {"whitted", "path", "photon"});
    });
  });
}

TEST_F(ExtremeValues, OfTheCamera) {
  inEachField<Camera>([&](const std::string& field, const std::string& form) {
    expectRefusedOrSeen(std::string("camera { ") + field + " = " + form + "; }\n" + kLight);
  });
}

TEST_F(ExtremeValues, OfEachMaterial) {
  forEachType<ModelList>([&]<class Kind>(Kind*) {
    inEachField<Kind>([&](const std::string& field, const std::string& form) {
      expectRefusedOrSeen(std::string(kCamera) + kLight + "translate(0,1,2, sphere { material = " +
                          std::string(Kind::kKeyword) + " { " + field + " = " + form + "; }; })");
    });
  });
}

TEST_F(ExtremeValues, OfEachTexture) {
  forEachType<TextureList>([&]<class Kind>(Kind*) {
    const auto expect = [&](const std::string& field, const std::string& form) {
      expectRefusedOrSeen(std::string(kCamera) + kLight +
                              "translate(0,1,2, sphere { material = { diffuse = " +
                              std::string(Kind::kKeyword) + " { " + field + " = " + form + "; }; }; })",
                          {"whitted"});
    };
    inEachField<Kind>(expect);
    inEachField<TexturePlacement>(expect);
  });
}

/// The shape with all its counts at their most, and so with each value of each choice that it has.
std::vector<Shape> atItsMost(const ShapeType& type) {
  Shape most = typical(type);
  for (AnyField& field : most.editFields())
    if (int* const* count = std::get_if<int*>(&field.value); count && field.most > field.least)
      **count = static_cast<int>(std::min<Real>(field.most, std::numeric_limits<int>::max()));
  std::vector<Shape> all{most};
  for (std::size_t field = 0; field < most.fields().size(); ++field)
    if (std::holds_alternative<EnumValue>(most.fields()[field].value))
      for (Shape& other : varied(most, field)) all.push_back(std::move(other));
  return all;
}

/// Every command ends once its budget is used up, whatever a shape's counts ask for: soon by looks at the
/// budget, not by a clock. Work that never looks would go on, and ctest would end the test.
TEST(Counts, OfEachShapeAtTheirMostEndWithTheBudget) {
  constexpr std::int64_t kMostLooks = 300, kFew = 20;  // some may look once more on their way out
  for (const ShapeType& type : shapeTypes())
    for (const Shape& shape : atItsMost(type)) {
      Scene scene;
      scene.file = "most.ray";
      scene.materials.emplace_back();
      scene.objects.push_back({"", shape, {}, 0, {}});
      scene.camera.position = {0, 0, 6};
      Settings settings;
      settings.width = settings.height = 8;
      settings.threads = 1;
      const auto ends = [&](const char* command, const auto& work) {
        std::int64_t looks = 0;
        Budget budget([&] {
          if (++looks > kMostLooks) throw Error(Fault::limit, "too much work");
        });
        const BudgetScope scope(&budget);
        try {
          work();
        } catch (const Error& error) {
          EXPECT_TRUE(error.fault() == Fault::limit || error.fault() == Fault::scene) << error.what();
        }
        EXPECT_LT(looks, kMostLooks + kFew) << type.keyword << " by " << command;
      };
      ends("render", [&] {
        Session session;
        session.open(Scene(scene), settings);
        session.build();
        session.renderPicture();
      });
      ends("lint", [&] {
        Messages messages;
        const World world = compile(scene, settings, messages);
        lint(scene, settings, world, messages.all());
      });
      ends("convert", [&] {
        Messages messages;
        writableFormatFor("most.obj").write(scene, "most.obj", {}, messages);
      });
      ends("the view in space", [&] { SceneModeler{}.model(scene); });
    }
}

}  // namespace
}  // namespace trace::test::extreme_values_test

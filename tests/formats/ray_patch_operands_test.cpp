// A scene that is saved after a part of a solid of solids was edited: the text of that part alone changes.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "formats/ray/syntax/syntax.h"
#include "formats/ray_patch_helpers.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/solids/sphere.h"
#include "geometry/shapes/solids/torus.h"

namespace trace::ray_patch_operands_test {
namespace {

using EditList = std::function<void(std::vector<Operand>&)>;

void editOperands(Shape& whole, const EditList& edit) {
  std::vector<Operand> list = whole.operands().list();
  edit(list);
  whole.setOperands(Operands(std::move(list)));
}

/// Edits the operands of the first object.
Edit operands(const EditList& edit) {
  return [edit](Scene& scene) { editOperands(scene.objects.at(0).shape, edit); };
}

/// Calls visit(path) for each operand of the shape, however deep: the numbers that lead there.
void forEachOperand(const Shape& shape, std::vector<std::size_t>& path,
                    const std::function<void(const std::vector<std::size_t>&)>& visit) {
  for (std::size_t i = 0; i < shape.operands().list().size(); ++i) {
    path.push_back(i);
    visit(path);
    forEachOperand(shape.operands().list()[i].shape, path, visit);
    path.pop_back();
  }
}

void move(Shape& shape, const std::vector<std::size_t>& path, std::size_t depth = 0) {
  editOperands(shape, [&](std::vector<Operand>& list) {
    Operand& part = list.at(path[depth]);
    if (depth + 1 == path.size())
      part.wholeFromOperand.offset.x += 0.0625;
    else
      move(part.shape, path, depth + 1);
  });
}

/// An operand that the text says as a group has no transform of its own there.
bool isGroup(const Operand& operand) {
  return operand.shape.is<Union>() && operand.wholeFromOperand == Affine{};
}

TEST(RayPatchOperands, AMovedOperandOfAnExampleChangesOnlyItsLines) {
  std::size_t moved = 0;
  for (const std::string& file : examples()) {
    const SceneText read = reading(file, readFile(file));
    if (changesWithTime(file, *read.bytes)) continue;
    if (rayfile::Syntax(file, *read.bytes).usesLanguage()) continue;  // written out where it was edited
    for (std::size_t i = 0; i < read.scene->objects.size(); ++i) {
      if (!standsAlone(read.scene->objects, i)) continue;  // a copy in rows has no text of its own
      std::vector<std::size_t> path;
      forEachOperand(read.scene->objects[i].shape, path, [&](const std::vector<std::size_t>& part) {
        const Operand* operand = nullptr;
        const Shape* shape = &read.scene->objects[i].shape;
        for (std::size_t step : part) operand = &shape->operands().list()[step], shape = &operand->shape;
        if (isGroup(*operand) || moved > 120) return;
        std::string what = "object " + std::to_string(i) + ", operand";
        for (std::size_t step : part) what += " " + std::to_string(step);
        expectSmall(
            read, what, [&](Scene& s) { move(s.objects[i].shape, part); }, 8);
        ++moved;
      });
    }
  }
  EXPECT_GE(moved, kSanitized ? 10u : 40u);
}

/// The same material said in each way that a text may share it.
TEST(RayPatchOperands, AMovedOperandKeepsWhatItSharesAMaterialWith) {
  const std::string gold = "{ name = gold; diffuse = (0.8, 0.6, 0.2); }";
  for (const std::string& text : {
           "material = " + gold +
               "\nsphere { }\nunion {\n  box { } // block\n  translate(1, 0, 0, cone { }) // tip\n}\n",
           "sphere { material = " + gold +
               " }\nunion { material = gold;\n  box { material = gold } // block\n  "
               "translate(1, 0, 0, cone { material = gold }) // tip\n}\n",
           "sphere { material = " + gold + " }\nunion { material = " + gold + ";\n  box { material = " +
               gold + " } // block\n  translate(1, 0, 0, cone { material = " + gold + " }) // tip\n}\n",
           "material = " + gold +
               "\nsphere { }\nunion(\n  box { }, // block\n  translate(1, 0, 0, cone { }) // tip\n)\n",
           "material = " + gold +
               "\nsphere { }\nunion { objects = {\n  box { } // block\n  { material = { specular = 1 } "
               "translate(1, 0, 0, cone { }) } // tip\n} }\n",
           "{ material = " + gold +
               "; // shared\n sphere { }\n scale(2, union {\n  box { material = gold } // block\n  "
               "difference { material = gold; translate(1, 0, 0, cone { }) sphere { material = { specular = "
               "1 } } }\n}) }\n",
       })
    for (std::size_t part : {0u, 1u})
      expectSmall(
          reading("test.ray", "SBT-raytracer 1.0\n" + text), text + std::to_string(part),
          [&](Scene& s) { move(s.objects.at(1).shape, {part}); }, 2);
}

constexpr const char* kDrilled = R"(material = { name = steel; diffuse = 0.5; } // shared
sphere { }
rotate(0, 1, 0, 0.5, difference {
  box { } // the block
  // the holes
  {
    material = { diffuse = (0.75, 0.5, 0.25); };
    translate(1, 0, 0, sphere { }) // right
    translate(-1, 0, 0, scale(0.5, sphere { material = steel })) // left
    cone { } // middle
  }
})
)";

std::string replaced(std::string text, const std::string& old, const std::string& now) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, text.npos) << old;
  return at == text.npos ? text : text.replace(at, old.size(), now);
}

/// Edits the objects of the group.
Edit holes(const EditList& edit) {
  return [edit](Scene& scene) {
    editOperands(scene.objects.at(1).shape,
                 [&](std::vector<Operand>& list) { editOperands(list.at(1).shape, edit); });
  };
}

TEST(RayPatchOperands, ObjectsOfAGroupAreChangedWhereTheyStand) {
  EXPECT_EQ(after(kDrilled, holes([](auto& list) { list[0].wholeFromOperand.offset.x = 1.25; })),
            replaced(kDrilled, "translate(1,", "translate(1.25,"));
  EXPECT_EQ(after(kDrilled, holes([](auto& list) { list[1].wholeFromOperand.offset.y = 0.25; })),
            replaced(kDrilled, "translate(-1, 0,", "translate(-1, 0.25,"));
  EXPECT_EQ(after(kDrilled, holes([](auto& list) { list[0].name = "hole"; })),
            replaced(kDrilled, "sphere { }) // right", "sphere { name = \"hole\"; }) // right"));
  EXPECT_EQ(after(kDrilled, holes([](auto& list) { list[0].material = 0; })),
            replaced(kDrilled, "sphere { }) // right", "sphere { material = \"steel\"; }) // right"));
  EXPECT_EQ(after(kDrilled, holes([](auto& list) { list.erase(list.begin()); })),
            replaced(kDrilled, "    translate(1, 0, 0, sphere { }) // right\n", "    // right\n"));
}

TEST(RayPatchOperands, AMaterialThatTheyShareIsChangedOnce) {
  EXPECT_EQ(
      after(kDrilled,
            [](Scene& s) {
              s.materials[0].model.edit<Phong>()->diffuse = Color(0.25);
              holes([](auto& list) { list[0].wholeFromOperand.offset.x = 1.25; })(s);
            }),
      replaced(replaced(kDrilled, "translate(1,", "translate(1.25,"), "diffuse = 0.5", "diffuse = 0.25"));
}

TEST(RayPatchOperands, WhatTheTextCannotSayIsWrittenAnewAloneInItsSolid) {
  const SceneText read = reading("test.ray", std::string("SBT-raytracer 1.0\n") + kDrilled);
  Scene scene = *read.scene;
  editOperands(scene.objects.at(1).shape, [](auto& list) { list[1].wholeFromOperand.offset.x = 2; });
  const Saved result = saved(read, scene);
  expectSays(read, result.text, scene, "a group that was moved as a whole");
  ASSERT_EQ(result.messages.size(), 1u);
  EXPECT_EQ(result.messages[0].place.line, 7);
  EXPECT_NE(result.text.find("  box { } // the block\n  // the holes\n"), std::string::npos) << result.text;
  EXPECT_EQ(result.text.find("// middle"), std::string::npos) << result.text;
}

TEST(RayPatchOperands, AreAddedAndTakenOut) {
  const std::string text = "difference {\n  box { } // the block\n  scale(0.5, sphere { }) // the hole\n}\n";
  EXPECT_EQ(after(text, operands([](auto& list) {
                    list[1].wholeFromOperand = Affine::scaling({0.75, 0.75, 0.75});
                  })),
            "difference {\n  box { } // the block\n  scale(0.75, sphere { }) // the hole\n}\n");
  EXPECT_EQ(after(text, operands([](auto& list) { list.pop_back(); })),
            "difference {\n  box { } // the block\n  // the hole\n}\n");
  const std::string more = after(text, operands([](auto& list) {
                                   list.push_back({"bite", Torus{}, {}, 0});
                                 }));
  EXPECT_TRUE(more.starts_with(text.substr(0, text.size() - 2))) << more;
}

}  // namespace
}  // namespace trace::ray_patch_operands_test

// A scene that is saved is the text that was read with as little changed as possible.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "formats/ray/syntax/syntax.h"
#include "formats/ray/write/patch.h"
#include "formats/ray/write/transform.h"
#include "formats/ray_patch_helpers.h"
#include "geometry/shapes/solids/cone.h"
#include "geometry/shapes/solids/sphere.h"
#include "shading/library.h"
#include "shading/lights/point_light.h"
#include "shading/textures/brick.h"
#include "shading/textures/checker.h"
#include "shading/textures/noise.h"
#include "shading/textures/wood.h"

namespace trace::ray_patch_test {
namespace {

Phong& phong(Scene& scene, std::size_t material) { return *scene.materials.at(material).model.edit<Phong>(); }
template <class S>
S& shape(Scene& scene, std::size_t object) {
  return *scene.objects.at(object).shape.edit<S>();
}
Affine& placed(Scene& scene, std::size_t object) { return scene.objects.at(object).worldFromObject; }

// --- every example --------------------------------------------------------------------------------------

TEST(RayPatch, WithoutAnEditEveryExampleStaysAsItIs) {
  ASSERT_GE(examples().size(), 25u);
  for (const std::string& file : examples()) {
    const std::string bytes = readFile(file);
    const SceneText read = reading(file, bytes);
    const Saved result = saved(read, *read.scene);
    EXPECT_TRUE(result.text == bytes) << file;
    EXPECT_TRUE(result.messages.empty()) << file << ": " << result.messages.at(0).what;
  }
}

TEST(RayPatch, OneChangedFieldOfAnExampleChangesOnlyItsLine) {
  std::size_t edits = 0;
  for (const std::string& file : examples()) {
    const SceneText read = reading(file, readFile(file));
    if (changesWithTime(file, *read.bytes)) continue;                 // below
    if (rayfile::Syntax(file, *read.bytes).usesLanguage()) continue;  // written anew, with a warning
    const Scene& scene = *read.scene;
    const auto expect = [&](const std::string& what, const Edit& edit, std::size_t lines = 1) {
      expectSmall(read, what, edit, lines);
      ++edits;
    };
    expect("camera", [](Scene& s) { s.camera.fov += 1.25; });
    expect("option", [](Scene& s) { s.choices.push_back({"depth", "17", {}}); });
    std::size_t last = scene.lights.size();  // of the lights that have a text of their own
    while (last > 0 && !standsAlone(scene.lights, last - 1)) --last;
    if (last > 0)
      expect("light", [&](Scene& s) {
        Light& light = s.lights[last - 1].light;
        if (Color* color = editableValue<Color>(light, "color"))
          *color = Color(0.25, 0.5, 0.75);
        else
          editableValue<Vec3>(light, "position")->x += 1;
      });
    std::set<std::size_t> kinds;
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      if (!standsAlone(scene.objects, i) || !kinds.insert(scene.objects[i].shape.type().index).second)
        continue;
      if (kinds.size() > 3) break;
      const std::string object = "object " + std::to_string(i);
      const std::string name = scene.objects[i].name + "x";
      expect(object + " name", [&](Scene& s) { s.objects[i].name = name; });
      expect(
          object + " move", [&](Scene& s) { placed(s, i).offset.x += 0.375; }, 12);
    }
  }
  EXPECT_GE(edits, 150u);
}

// --- single edits -----------------------------------------------------------------------------------------

TEST(RayPatch, NumbersChangeInTheirPlaceAndCommentsStay) {
  EXPECT_EQ(after("camera { position = (0, 0 ,10.0); /* far */ fov=45 } // end\nsphere { }",
                  [](Scene& s) { s.camera.position.z = 12, s.camera.fov = 30; }),
            "camera { position = (0, 0 ,12); /* far */ fov=30 } // end\nsphere { }");
  EXPECT_EQ(after("point_light {\n\tposition /* key */ = // value\n\t\t(1, 2, 3)\n\tcolour = 0.5 }\nsphere{}",
                  [](Scene& s) { s.lights[0].light.edit<PointLight>()->color = Color(0.75); }),
            "point_light {\n\tposition /* key */ = // value\n\t\t(1, 2, 3)\n\tcolour = 0.75 }\nsphere{}");
  EXPECT_EQ(after("cone { height = 1; height = 2; bottom_radius = 3; }",  // the last counts
                  [](Scene& s) { shape<Cone>(s, 0).height = 5; }),
            "cone { height = 1; height = 5; bottom_radius = 3; }");
}

TEST(RayPatch, FieldsThatWereAbsentAreAddedInTheStyleOfTheBlock) {
  const Edit edit = [](Scene& s) { shape<Cone>(s, 0).height = 2; };
  EXPECT_EQ(after("cone { }", edit), "cone { height = 2; }");
  EXPECT_EQ(after("cone {}", edit), "cone { height = 2; }");
  EXPECT_EQ(after("cone { capped = false }", edit), "cone { capped = false; height = 2; }");
  EXPECT_EQ(after("  cone {\n    capped = false; // open\n  }\n", edit),
            "  cone {\n    capped = false; // open\n    height = 2;\n  }\n");
  EXPECT_EQ(after("\r\n\r\ncone\r\n{\r\n\tcapped = false;\r\n}\r\n", edit),
            "\r\n\r\ncone\r\n{\r\n\tcapped = false;\r\n\theight = 2;\r\n}\r\n");
}

TEST(RayPatch, KeepsAByteOrderMarkAndQuotedNames) {
  const std::string text = "\xef\xbb\xbfSBT-raytracer 1.0 sphere { name = \"a b\"; } // no line break";
  const SceneText read = reading("test.ray", text);
  EXPECT_EQ(edited(read, [](Scene& s) { s.objects[0].name = "c \"d\""; }).text,
            "\xef\xbb\xbfSBT-raytracer 1.0 sphere { name = \"c 'd'\"; } // no line break");
  EXPECT_EQ(edited(read, [](Scene& s) { s.objects[0].name.clear(); }).text,
            "\xef\xbb\xbfSBT-raytracer 1.0 sphere { } // no line break");
}

TEST(RayPatch, SettingsAreChangedOrAdded) {
  const Edit depth = [](Scene& s) { s.choices.push_back({"depth", "9", {}}); };
  EXPECT_EQ(after("settings { depth = 3; width = 64 } sphere { }", depth),
            "settings { depth = 9; width = 64 } sphere { }");
  EXPECT_EQ(after("settings { width = 64; } sphere { }", depth),
            "settings { width = 64; depth = 9; } sphere { }");
  EXPECT_EQ(after("sphere { }", depth), "settings { depth = 9; }\nsphere { }");
  EXPECT_EQ(after("settings { like = ut; } sphere { }",
                  [](Scene& s) {
                    s.choices = {{"like", "uw2001", {}}, {"width", "7", {}}};
                  }),
            "settings { like = uw2001; width = 7; } sphere { }");
}

TEST(RayPatch, ANewObjectSaysOnlyWhatIsNotSoByDefault) {
  const auto with = [](const Cone& cone) {
    return after("sphere { }\n", [&](Scene& s) {
      s.objects.push_back({"", cone, {}, s.objects[0].material, {}});
    });
  };
  EXPECT_EQ(with({}), "sphere { }\n\ncone {\n  material = { };\n}\n");
  EXPECT_EQ(with({.height = 2}), "sphere { }\n\ncone {\n  height = 2;\n  material = { };\n}\n");
}

TEST(RayPatch, WhatIsAddedStandsBehindTheCommentAtTheHead) {
  const Edit depth = [](Scene& s) { s.choices.push_back({"depth", "9", {}}); };
  EXPECT_EQ(after("// A ball,\n// by me\n\nsphere { }\n", depth),
            "// A ball,\n// by me\n\nsettings { depth = 9; }\nsphere { }\n");
  EXPECT_EQ(after("\n// A ball\n\n\n// red\nsphere { }\n", depth),
            "\n// A ball\n\nsettings { depth = 9; }\n\n// red\nsphere { }\n");
  EXPECT_EQ(after("// the ball's own comment\nsphere { }\n", depth),
            "settings { depth = 9; }\n// the ball's own comment\nsphere { }\n");
  EXPECT_EQ(after("sphere { }\n\n// the end\n\n", depth),
            "settings { depth = 9; }\nsphere { }\n\n// the end\n\n");
  const SceneText dos = reading("test.ray", "SBT-raytracer 1.0\r\n// A ball\r\n\r\nsphere { }\r\n");
  EXPECT_EQ(edited(dos, depth).text,
            "SBT-raytracer 1.0\r\n// A ball\r\n\r\nsettings { depth = 9; }\r\nsphere { }\r\n");
}

TEST(RayPatch, FilesOfSettingsAreWrittenSoThatTheyAreFound) {
  const std::string sky =
      std::filesystem::absolute("/sky/a b.hdr").generic_string();  // with the drive, on Windows
  EXPECT_EQ(after("sphere { }",
                  [&](Scene& s) {
                    s.choices = {{"environment", sky, {}}};
                  }),
            "settings { environment = \"" + sky + "\"; }\nsphere { }");
  EXPECT_EQ(after("settings { backdrop = \"b.png\"; } sphere { }",
                  [](Scene& s) {
                    s.choices = {{"backdrop", "none", {}}};
                  }),
            "settings { backdrop = none; } sphere { }");
  // What lies below the scene's folder is named from there, so that both can be moved together.
  EXPECT_EQ(after("sphere { }",
                  [](Scene& s) {
                    const auto below = std::filesystem::absolute("test.ray").parent_path() / "sky" / "b.png";
                    s.choices = {{"backdrop", below.string(), {}}};
                  }),
            "settings { backdrop = \"sky/b.png\"; }\nsphere { }");
  // The same file by the name that the program has for it: the text stays.
  EXPECT_EQ(after("settings { backdrop = \"b.png\"; } sphere { }",
                  [](Scene& s) {
                    const std::string resolved = resolve({s.choices}).backdrop.path;
                    s.choices = {{"backdrop", resolved, {}}};
                  }),
            "settings { backdrop = \"b.png\"; } sphere { }");
}

TEST(RayPatch, DirectionsReplaceWhatSaidThemBefore) {
  const Edit turn = [](Scene& s) { s.camera.viewdir = {1, 0, 0}; };
  EXPECT_EQ(after("camera { position = (0,0,5); look_at = (0,0,0); } sphere { }", turn),
            "camera { position = (0,0,5); viewdir = (1, 0, 0); updir = (0, 1, 0); } sphere { }");
  EXPECT_EQ(after("camera { quaternian = (0,0,0,1); } sphere { }", turn),
            "camera { viewdir = (1, 0, 0); updir = (0, 1, 0); } sphere { }");
  EXPECT_EQ(after("camera { look_at = (0,0,-2); } sphere { }", [](Scene& s) { s.camera.position.z = 3; }),
            "camera { look_at = (0,0,-2); position = (0, 0, 3); } sphere { }");
  EXPECT_EQ(after("camera { horizontal_fov = 90; aspectratio = 1; } sphere { }",
                  [](Scene& s) { s.camera.fov = 40; }),
            "camera { fov = 40; aspectratio = 1; } sphere { }");
  EXPECT_EQ(after("sphere { }", [](Scene& s) { s.background.colors = {Color(0.5)}; }),
            "background { colors = ((0.5, 0.5, 0.5)); }\nsphere { }");
  EXPECT_EQ(
      after("background { color = (0, 0, 1); } sphere { }", [](Scene& s) { s.background.colors[0].r = 0.5; }),
      "background { color = (0.5, 0, 1); } sphere { }");
  EXPECT_EQ(after("sphere { }", [](Scene& s) { s.background.turbidity = 3; }),
            "background { turbidity = 3; }\nsphere { }");
  EXPECT_EQ(after("background { turbidity = 3; } sphere { }",
                  [](Scene& s) {
                    s.background.sun = {0, 1, 0};
                  }),
            "background { turbidity = 3; sun = (0, 1, 0); } sphere { }");
}

// --- transforms -------------------------------------------------------------------------------------------

TEST(RayPatch, AMoveChangesTheTranslation) {
  const Edit move = [](Scene& s) { placed(s, 0).offset = {4, 2, 3.5}; };
  EXPECT_EQ(after("translate(1, 2, 3, // here\n  rotate(0, 1, 0, 0.7, sphere { }))", move),
            "translate(4, 2, 3.5, // here\n  rotate(0, 1, 0, 0.7, sphere { }))");
  EXPECT_EQ(after("sphere { }", move), "translate(4, 2, 3.5, sphere { })");
  EXPECT_EQ(after("scale(2, sphere { });", move), "translate(4, 2, 3.5, scale(2, sphere { }));");
  EXPECT_EQ(after("transform((1,0,0,1), (0,1,0,2), (0,0,1,3), (0,0,0,1), sphere { })", move),
            "transform((1,0,0,4), (0,1,0,2), (0,0,1,3.5), (0,0,0,1), sphere { })");
}

TEST(RayPatch, ATurnOrStretchChangesTheNumbersThatSaidIt) {
  EXPECT_EQ(after("translate(1, 2, 3, rotate(0, 0, 2, 0.5, scale(2, sphere { })))",
                  [](Scene& s) {
                    const Vec3 at = placed(s, 0).offset;
                    placed(s, 0).offset = {};
                    placed(s, 0) = Affine::rotation({0, 0, 1}, 0.25) * placed(s, 0);
                    placed(s, 0).offset = at;
                  }),
            "translate(1, 2, 3, rotate(0, 0, 2, 0.75, scale(2, sphere { })))");
  EXPECT_EQ(after("translate(1, 2, 3, rotate(0, 0, 2, 0.5, scale(2, sphere { })))",
                  [](Scene& s) {
                    placed(s, 0) = placed(s, 0) * Affine::scaling({1.5, 1.5, 1.5});
                  }),
            "translate(1, 2, 3, rotate(0, 0, 2, 0.5, scale(3, sphere { })))");
  EXPECT_EQ(after("translate(1, 2, 3, scale(2, sphere { }))",
                  [](Scene& s) {
                    placed(s, 0) = placed(s, 0) * Affine::scaling({1, 1, 0.5});
                  }),
            "translate(1, 2, 3, scale(2, 2, 1, sphere { }))");
  EXPECT_EQ(after("translate(1, 2, 3, rotate(0, 0, 1, 0.5, scale(2, sphere { })))",  // all at once
                  [](Scene& s) {
                    placed(s, 0) = Affine::translation({7, 2, 3}) * Affine::rotation({0, 0, 1}, 0.75) *
                                   Affine::scaling({4, 4, 4});
                  }),
            "translate(7, 2, 3, rotate(0, 0, 1, 0.75, scale(4, sphere { })))");
}

TEST(RayPatch, ObjectsOfAGroupMoveAlone) {
  EXPECT_EQ(after("translate(0, 0, 1, { box { } /* two */ translate(1, 0, 0, sphere { }) })",
                  [](Scene& s) { placed(s, 1).offset.x = 2; }),
            "translate(0, 0, 1, { box { } /* two */ translate(2, 0, 0, sphere { }) })");
  EXPECT_EQ(after("scale(2, { box { } sphere { } })", [](Scene& s) { placed(s, 0).offset.y = 3; }),
            "scale(2, { translate(0, 1.5, 0, box { }) sphere { } })");
  EXPECT_EQ(after("translate(0, 0, 1, { material = { diffuse = 1; } box { } })",  // a group of one
                  [](Scene& s) { placed(s, 0).offset.z = 3; }),
            "translate(0, 0, 3, { material = { diffuse = 1; } box { } })");
}

TEST(RayPatch, AShearReplacesOnlyOneTransform) {
  const std::string text = after("translate(1, 2, 3, scale(2, sphere { name = kept; }))",
                                 [](Scene& s) { placed(s, 0).row[0].y = 0.5; });
  EXPECT_NE(text.find("scale(2, sphere { name = kept; }))"), text.npos) << text;
  EXPECT_TRUE(text.starts_with("transform((1, 0.25, 0, 1), ")) << text;
}

// --- materials --------------------------------------------------------------------------------------------

constexpr const char* kShared = R"(material = { name = gold; diffuse = (0.8, 0.6, 0.2); } // shared
sphere { } box { material = gold; }
cone { material = { specular = 0.5; }; }
)";

TEST(RayPatch, AMaterialThatIsSharedIsChangedOnceAndStaysShared) {
  EXPECT_EQ(after(kShared, [](Scene& s) { phong(s, 0).diffuse.r = 0.9; }),
            R"(material = { name = gold; diffuse = (0.9, 0.6, 0.2); } // shared
sphere { } box { material = gold; }
cone { material = { specular = 0.5; diffuse = (0.8, 0.6, 0.2); }; }
)");  // what inherits from it stays what it is
  EXPECT_EQ(after(kShared, [](Scene& s) { s.materials[0].name = "brass"; }),
            R"(material = { name = "brass"; diffuse = (0.8, 0.6, 0.2); } // shared
sphere { } box { material = "brass"; }
cone { material = { specular = 0.5; }; }
)");
  EXPECT_EQ(after(kShared, [](Scene& s) { phong(s, 1).shininess = 20; }),
            std::string(kShared).replace(std::string(kShared).find("0.5; }"), 6, "0.5; shininess = 20; }"));
}

TEST(RayPatch, EqualBlocksAreOneMaterialAndAreChangedTogether) {
  EXPECT_EQ(after("sphere { material = { diffuse = 0.5 } } box { material = { diffuse = (0.5, 0.5, 0.5) } }",
                  [](Scene& s) { phong(s, 0).diffuse = Color(0.75); }),
            "sphere { material = { diffuse = 0.75 } } box { material = { diffuse = (0.75, 0.75, 0.75) } }");
}

TEST(RayPatch, AnObjectThatGetsAnotherMaterialNamesItOrHasItsOwn) {
  EXPECT_EQ(after(kShared, [](Scene& s) { s.objects[2].material = 0; }),
            R"(material = { name = gold; diffuse = (0.8, 0.6, 0.2); } // shared
sphere { } box { material = gold; }
cone { material = "gold"; }
)");
  EXPECT_EQ(after(kShared, [](Scene& s) { s.objects[0].material = 1; }),
            R"(material = { name = gold; diffuse = (0.8, 0.6, 0.2); } // shared
sphere { material = { specular = (0.5, 0.5, 0.5); }; } box { material = gold; }
cone { material = { specular = 0.5; }; }
)");
}

TEST(RayPatch, HowASurfaceMirrorsIsKept) {
  const Edit shiny = [](Scene& s) { phong(s, 0).specular = Color(0.5); };
  // Without a mirror of its own, `specular` would make one.
  EXPECT_EQ(after("sphere { material = { diffuse = 1; } }", shiny),
            "sphere { material = { diffuse = 1; specular = (0.5, 0.5, 0.5); reflective = (0, 0, 0); } }");
  EXPECT_EQ(after("sphere { material = { specular = 1; } }", shiny),
            "sphere { material = { specular = 0.5; } }");
  EXPECT_EQ(
      after("sphere { material = { specular = 1; } }",
            [](Scene& s) { phong(s, 0).reflective = Color(0.25), phong(s, 0).mirrorsSpecular = false; }),
      "sphere { material = { specular = 1; reflective = (0.25, 0.25, 0.25); } }");
  EXPECT_EQ(after("sphere { material = { diffuse = map(\"wood.png\", (1, 0, 0)); } }",
                  [](Scene& s) { phong(s, 0).diffuse.g = 1; }),
            "sphere { material = { diffuse = map(\"wood.png\", (1, 1, 0)); } }");
}

TEST(RayPatch, AMaterialOutlivesTheObjectThatSaidIt) {
  EXPECT_EQ(
      after("sphere { material = { name = red; diffuse = (1, 0, 0); } }\n"
            "box { material = red; } cone { material = red; }",
            [](Scene& s) { s.objects.erase(s.objects.begin()); }),
      "box { material = { name = \"red\"; emissive = (0, 0, 0); ambient = (0, 0, 0); diffuse = (1, 0, 0); "
      "specular = (0, 0, 0);\n"
      "    reflective = (0, 0, 0); grazing = (0, 0, 0); transmissive = (0, 0, 0); shininess = 0; brilliance "
      "= 1;\n"
      "    grazing_exponent = 5; index = 1; shadow = 1; priority = 0; attenuation_color = (1, 1, 1);\n"
      "    attenuation_distance = 1; dispersion = abbe; abbe = 0; }; } cone { material = red; }");
}

// --- deleting and adding ----------------------------------------------------------------------------------

TEST(RayPatch, DeletedThingsTakeTheirTransformsAndLinesAlong) {
  EXPECT_EQ(
      after("box { }\ntranslate(1, 0, 0, scale(2, sphere { })); // ball\npoint_light { position = (0,0,1); "
            "color = 1; }\ncone { }\n",
            [](Scene& s) { s.objects.erase(s.objects.begin() + 1), s.lights.clear(); }),
      "box { }\n// ball\ncone { }\n");
  EXPECT_EQ(after("sphere { } box { } cone { }", [](Scene& s) { s.objects.erase(s.objects.begin() + 1); }),
            "sphere { } cone { }");
  EXPECT_EQ(after("translate(1, 0, 0, { sphere { } box { } })", [](Scene& s) { s.objects.clear(); }),
            "translate(1, 0, 0, { })");
}

TEST(RayPatch, NewThingsStandAtTheEnd) {
  EXPECT_EQ(
      after("sphere { } // last",
            [](Scene& s) {
              PointLight light;
              light.color = Color(1);
              s.lights.push_back({light, {}});
              s.objects.push_back({"copy", Sphere{}, Affine::translation({1, 0, 0}), 0, {}});
            }),
      "sphere { } // last\n"
      "\npoint_light {\n  position = (0, 0, 0);\n  color = (1, 1, 1);\n  constant_attenuation_coeff = 0;\n"
      "  linear_attenuation_coeff = 0;\n  quadratic_attenuation_coeff = 1;\n  extra_highlight = (0, 0, "
      "0);\n  radius = 0;\n  visible = false;\n}\n"
      "\ntranslate(1, 0, 0, sphere {\n  name = \"copy\";\n  material = { };\n})\n");
}

TEST(RayPatch, ADuplicateOfAMeshCopiesItsTextOrNamesIt) {
  const std::string mesh =
      "polymesh { points = ((0,0,0), (1,0,0), (0,1,0)); faces = ((0,1,2)); } // inline\n";
  const Edit duplicate = [](Scene& s) {
    Object copy = s.objects[0];
    copy.place = {}, copy.worldFromObject.offset = {0, 0, 2};
    s.objects.push_back(copy);
  };
  EXPECT_EQ(after(mesh, duplicate),
            mesh +
                "\ntranslate(0, 0, 2, polymesh { points = ((0,0,0), (1,0,0), (0,1,0)); faces = ((0,1,2)); "
                "material = { }; })\n");
  const std::string shared =
      "polymesh { shared = tri; points = ((0,0,0), (1,0,0), (0,1,0)); faces = ((0,1,2)); }\n";
  EXPECT_EQ(after(shared, duplicate),
            shared + "\ntranslate(0, 0, 2, polymesh { shared = tri; material = { }; })\n");
}

// --- what cannot be kept ----------------------------------------------------------------------------------

TEST(RayPatch, KeysStayUnlessTheirValueWasEdited) {
  const std::string text =
      "SBT-raytracer 1.0\ntranslate(key((0, 0), (2, 1)), 5, 0, sphere { name = ball; })\n"
      "cone { height = key((0, 1), (2, 3)); }\n";
  const SceneText read = reading("test.ray", text, 1);
  const Saved named = edited(read, [](Scene& s) { s.objects[0].name = "moon"; });
  EXPECT_TRUE(named.messages.empty());
  EXPECT_EQ(named.text, std::string(text).replace(text.find("ball"), 4, "\"moon\""));
  const Saved moved = edited(read, [](Scene& s) { placed(s, 0).offset.y = 6; });
  EXPECT_TRUE(moved.messages.empty());
  EXPECT_EQ(moved.text, std::string(text).replace(text.find("5, 0"), 1, "6"));
  const Saved high = edited(read, [](Scene& s) { shape<Cone>(s, 1).height = 7; });
  EXPECT_EQ(high.text, std::string(text).replace(text.find("key((0, 1), (2, 3))"), 19, "7"));
  ASSERT_EQ(high.messages.size(), 1u);
  EXPECT_EQ(high.messages[0].place.line, 3);
}

TEST(RayPatch, ParticlesThatAreEditedBecomeObjects) {
  const std::string text =
      "SBT-raytracer 1.0\nparticles { rate = 3; lifetime = 5; } // dust\nsphere { name = other; }\n";
  const SceneText read = reading("test.ray", text, 1);
  ASSERT_GE(read.scene->objects.size(), 3u);
  const Saved other = edited(read, [](Scene& s) { s.objects.back().name = "else"; });
  EXPECT_TRUE(other.messages.empty());
  EXPECT_EQ(other.text, std::string(text).replace(text.find("other"), 5, "\"else\""));
  const Saved fewer = edited(read, [](Scene& s) { s.objects.erase(s.objects.begin()); });
  ASSERT_EQ(fewer.messages.size(), 1u);
  EXPECT_EQ(fewer.messages[0].place.line, 2);
  EXPECT_EQ(reading("test.ray", fewer.text).scene->objects.size(), read.scene->objects.size() - 1);
  EXPECT_NE(fewer.text.find("\n// dust\nsphere { name = other; }\n"), fewer.text.npos) << fewer.text;
}

// --- rows -------------------------------------------------------------------------------------------------

constexpr const char* kRows = R"(SBT-raytracer 1.0
material { name = wood; diffuse = (0.2, 0.1, 0.05); }
translate(0, 0, 5, rows { // shelves
  count = (3, 2, 1); step = (2, 1, 0); spread = (0.1, 0.2, 0.3); size_spread = 0.5;
  box { name = shelf; material = wood; }
  rows { material = { diffuse = 0.75; }; scale(0.5, sphere { }) }
})
cone { material = wood; } // other
)";

/// Whatever their order.
void expectSameObjects(const Scene& is, const Scene& wanted, const std::string& what) {
  ASSERT_EQ(is.objects.size(), wanted.objects.size()) << what;
  std::vector<bool> found(is.objects.size(), false);
  for (const Object& object : wanted.objects) {
    std::size_t i = 0;
    while (i < found.size() && (found[i] || !rayfile::sameObject(is, is.objects[i], wanted, object))) ++i;
    ASSERT_LT(i, found.size()) << what << ": " << object.name << " is lost";
    found[i] = true;
  }
}

TEST(RayPatch, CopiesThatAreEditedBecomeObjects) {
  const SceneText read = reading("test.ray", kRows);
  ASSERT_EQ(read.scene->objects.size(), 19u);
  const std::vector<std::pair<std::string, Edit>> edits{
      {"name", [](Scene& s) { s.objects[4].name = "mine"; }},
      {"move", [](Scene& s) { placed(s, 7).offset.x += 2; }},
      {"other material", [](Scene& s) { s.objects[3].material = s.objects[1].material; }},
      {"shape", [](Scene& s) { s.objects[2].shape = Cone{}; }},
      {"fewer", [](Scene& s) { s.objects.erase(s.objects.begin() + 5); }}};
  for (const auto& [what, edit] : edits) {
    Scene scene = *read.scene;
    edit(scene);
    const Saved result = saved(read, scene);
    ASSERT_EQ(result.messages.size(), 1u) << what;
    EXPECT_EQ(result.messages[0].place.line, 3) << what;
    EXPECT_EQ(result.text.find("rows"), result.text.npos) << what;
    EXPECT_NE(result.text.find("\ncone { material = wood; } // other\n"), result.text.npos) << what;
    expectSameObjects(*reading("test.ray", result.text).scene, scene, what);
  }
}

TEST(RayPatch, RowsStayWhereOthersAreEdited) {
  const SceneText read = reading("test.ray", kRows);
  expectSmall(
      read, "other", [](Scene& s) { placed(s, 18).offset.x = 2; }, 1);
  const Saved without =
      edited(read, [](Scene& s) { s.objects.erase(s.objects.begin(), s.objects.end() - 1); });
  EXPECT_TRUE(without.messages.empty());
  EXPECT_EQ(reading("test.ray", without.text).scene->objects.size(), 1u) << without.text;
}

TEST(RayPatch, AMaterialOfCopiesIsChangedWhereItIsSaid) {
  const SceneText read = reading("test.ray", kRows);
  for (const std::size_t object : {0u, 1u})
    expectSmall(
        read, "material of object " + std::to_string(object),
        [&](Scene& s) { phong(s, s.objects[object].material).diffuse = Color(0.5); }, 1);
  const SceneText library = reading("library", readFile(test::sourceFolder() + "/scenes/library.ray"));
  expectSmall(
      library, "wood",
      [](Scene& s) {
        for (Material& m : s.materials)
          if (m.name == "wood") m.model.edit<Phong>()->diffuse.r = 0.5;
      },
      1);
}

TEST(RayPatch, ATurnedObjectIsWrittenWithItsTurn) {
  for (const char* box :
       {"translate(-0.79124, 0.43561, 3.065, scale(0.43561, box {}))",
        "translate(1, 2, 3, scale(0.5, 2, 1, box {}))", "translate(1, 2, 3, box {})", "box {}"})
    for (const Real degrees : {28, -90, 5}) {
      const SceneText read = reading("test.ray", std::string("SBT-raytracer 1.0\n") + box + "\n");
      const Saved result = edited(read, [&](Scene& s) {
        Affine& placed = s.objects[0].worldFromObject;
        const Vec3 middle = placed.offset;
        placed = rayfile::inShortNumbers(Affine::translation(middle) *
                                             Affine::rotation({0, 1, 0}, degrees * kPi / 180) *
                                             Affine::translation(-middle) * placed,
                                         9);
      });
      EXPECT_EQ(result.text.find("transform"), std::string::npos) << result.text;
      EXPECT_NE(result.text.find("rotate"), std::string::npos) << result.text;
      EXPECT_LT(result.text.size(), 160u) << result.text;
    }
}

TEST(RayPatch, AMaterialOfTheLibraryIsWrittenByItsName) {
  for (const char* header : {"SBT-raytracer 1.0\n", "Trace 1\n"}) {
    const SceneText read = reading("test.ray", std::string(header) + "sphere { }\nbox { }\n");
    for (const std::string_view name : libraryNames()) {
      for (const bool changed : {false, true}) {
        const auto give = [&](Scene& s) {
          Material material = *libraryMaterial(name);
          material.name = std::string(name);
          if (changed) material.opacity = 0.5;
          s.materials.push_back(material);
          s.objects[0].material = static_cast<std::uint32_t>(s.materials.size() - 1);
        };
        const Saved result = edited(read, give);
        EXPECT_NE(result.text.find("library = \"" + std::string(name)), std::string::npos) << result.text;
        Scene wanted = *read.scene;
        give(wanted);
        const auto again = reading("test.ray", result.text);
        EXPECT_TRUE(rayfile::sameObject(*again.scene, again.scene->objects[0], wanted, wanted.objects[0]))
            << result.text;
      }
    }
  }
}

constexpr const char* kLamps = R"(SBT-raytracer 1.0
rows { count = (1, 3, 1); step = (0, 2, 0); // lamps
  point_light { position = (1, 1, 1); color = (1, 1, 1); }
  point_light { position = (5, 1, 1); color = (1, 1, 1); } }
sphere { material = { diffuse = 0.5; specular = 0; }; }
box { material = { diffuse = 0.25; }; }
)";

TEST(RayPatch, LightsThatAreCopiesAreChangedTogetherOrTheSceneIsWrittenAnew) {
  const SceneText read = reading("test.ray", kLamps);
  ASSERT_EQ(read.scene->lights.size(), 6u);
  const auto set = [](Scene& s, std::size_t i) -> PointLight& {
    return *s.lights[i].light.edit<PointLight>();
  };
  expectSmall(
      read, "all",
      [&](Scene& s) {
        for (std::size_t i : {0u, 2u, 4u}) set(s, i).color = Color(0.5), set(s, i).radius = 0.25;
      },
      1);
  const std::vector<std::pair<std::string, Edit>> edits{
      {"first", [&](Scene& s) { set(s, 0).color = Color(0.5); }},
      {"last", [&](Scene& s) { set(s, 2).radius = 0.5; }},
      {"moved", [&](Scene& s) { set(s, 1).position.x = 3; }},
      {"fewer", [](Scene& s) { s.lights.erase(s.lights.begin() + 1); }}};
  for (const auto& [what, edit] : edits) {
    Scene scene = *read.scene;
    edit(scene);
    const Saved result = saved(read, scene);
    ASSERT_EQ(result.messages.size(), 1u) << what;
    EXPECT_TRUE(result.messages[0].what.starts_with("the text could not be kept")) << what;
    expectSays(read, result.text, scene, what);
  }
}

/// Materials that several objects have are named then, since the text of one stands for all.
TEST(RayPatch, LanternsThatAreWrittenAnewAreTheSame) {
  const std::string file = test::sourceFolder() + "/scenes/lanterns.ray";
  const SceneText read = reading(file, readFile(file));
  Scene scene = *read.scene;
  scene.lights.back().light.edit<PointLight>()->color = Color(0.25, 0.5, 0.75);
  const Saved result = saved(read, scene);
  EXPECT_EQ(result.messages.size(), 1u);
  const SceneText again = reading(file, result.text);
  Scene is = *again.scene;
  ASSERT_EQ(is.objects.size(), scene.objects.size());
  std::size_t named = 0;
  for (std::size_t i = 0; i < is.objects.size(); ++i) {
    const Material& wanted = scene.materials.at(scene.objects[i].material);
    Material& material = is.materials.at(is.objects[i].material);
    if (wanted.name.empty() && !material.name.empty()) ++named, material.name.clear();
    EXPECT_TRUE(rayfile::sameObject(is, is.objects[i], scene, scene.objects[i])) << i;
  }
  EXPECT_EQ(named, 3u);
  ASSERT_EQ(is.lights.size(), scene.lights.size());
  for (std::size_t i = 0; i < is.lights.size(); ++i)
    EXPECT_EQ(is.lights[i].light, scene.lights[i].light) << i;
}

/// Changes the texture of a field of the first object's material: change(TextureNode&).
template <class Change>
Edit textureEdit(const std::string& field, Change&& change) {
  return [=](Scene& s) {
    Material& material = s.materials.at(s.objects[0].material);
    TextureNode node = **textureOf(material.textures, field);
    change(node);
    setTexture(material.textures, field, node);
  };
}

TEST(RayPatch, AChangedTextureKeepsTheLinesOfWhatWasNotChanged) {
  const std::string text = R"(material = { ambient = 0.5; diffuse = brick { size = (0.9, 0.3, 0.45); // wide
      mortar = 0.035;
      a = noise { octaves = 4; a = (0.62, 0.24, 0.17);  // red
        scale = (0.35, 0.2, 0.35); };
      b = texture(checker { }, (0.5, 0.5, 0.5)); }; }
sphere { }
)";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    return changed.replace(changed.find(from), from.size(), to);
  };
  EXPECT_EQ(after(text, textureEdit("diffuse", [](TextureNode& n) { n.model.edit<Brick>()->mortar = 0.05; })),
            with("0.035", "0.05"));
  EXPECT_EQ(after(text, textureEdit("diffuse", [](TextureNode& n) { n.placement.rotate.y = 30; })),
            with("(0.5, 0.5, 0.5)); }", "(0.5, 0.5, 0.5)); rotate = (0, 30, 0); }"));
  EXPECT_EQ(after(text, textureEdit("diffuse",
                                    [](TextureNode& n) {
                                      TextureNode noise = **textureOf(n.inputs, "a");
                                      noise.model.edit<Noise>()->octaves = 2;
                                      noise.placement.scale = {1, 1, 1};
                                      setTexture(n.inputs, "a", noise);
                                    })),
            with("octaves = 4", "octaves = 2")
                .replace(with("octaves = 4", "octaves = 2").find("(0.35, 0.2"), 17, "(1, 1, 1)"));
  EXPECT_EQ(after(text, textureEdit("diffuse",
                                    [](TextureNode& n) {
                                      n.model.edit<Brick>()->b = Color(0.25);
                                      setTexture(n.inputs, "b",
                                                 TextureNode{.model = Checker{.a = Color(0.1)}});
                                    })),
            with("checker { }, (0.5, 0.5, 0.5)", "checker { a = (0.1, 0.1, 0.1); }, (0.25, 0.25, 0.25)"));
  EXPECT_EQ(after(text, textureEdit("diffuse", [](TextureNode& n) { n.inputs.clear(); }))
                .substr(0, text.find("a = noise")),
            text.substr(0, text.find("a = noise")));
  EXPECT_EQ(after(text,
                  [](Scene& s) {
                    s.materials.at(s.objects[0].material).model.edit<Phong>()->diffuse = Color(0.5);
                  }),
            with("diffuse = brick", "diffuse = texture(brick")
                .replace(with("diffuse = brick", "diffuse = texture(brick").rfind("; }; }") + 3, 0,
                         ", (0.5, 0.5, 0.5))"));
}

TEST(RayPatch, ANamedTextureThatIsChangedBecomesAnotherAndTheOthersKeepTheirs) {
  const std::string text = R"(sphere { material = { diffuse = wood { name = oak; // the tree
    frequency = 5; }; } }
box { material = { diffuse = texture("oak"); } }
)";
  const SceneText read = reading("test.ray", "SBT-raytracer 1.0\n" + text);
  Scene wanted = *read.scene;
  textureEdit("diffuse", [](TextureNode& n) {
    n.name.clear();
    n.model.edit<Wood>()->frequency = 7;
  })(wanted);
  const Saved result = saved(read, wanted);
  EXPECT_TRUE(result.messages.empty()) << result.messages.front().what;
  expectSays(read, result.text, wanted, "named texture");
  EXPECT_NE(result.text.find("// the tree"), std::string::npos) << result.text;
}

TEST(RayPatch, ALongTextureThatIsNewStandsOnSeveralLines) {
  const std::string text = after("sphere { material = { diffuse = 1 } }", [](Scene& s) {
    Brick brick{.a = Color(0.125), .b = Color(0.25), .size = {2, 3, 4}, .mortar = 0.25};
    TextureNode node{.model = brick, .placement = {.scale = {2, 3, 4}, .rotate = {5, 6, 7}}};
    Noise noise{};
    noise.octaves = 3;
    setTexture(node.inputs, "a", TextureNode{.model = noise, .placement = {.translate = {0.5, 0.25, 0.75}}});
    setTexture(s.materials.at(s.objects[0].material).textures, "diffuse", node);
  });
  constexpr std::size_t kBefore = 32;  // what stands before the value
  for (const std::string& line : linesOf(text)) EXPECT_LE(line.size(), 110 + kBefore) << line;
  EXPECT_GE(linesOf(text).size(), 2u) << text;
}

TEST(RayPatch, ATextureOfAFieldThatKeepsItsValueIsChanged) {
  const std::string text =
      after("sphere { material = { diffuse = checker { }; opacity = checker { } } } // two", [](Scene& s) {
        setTexture(s.materials.at(s.objects[0].material).textures, "diffuse", TextureNode{.model = Brick{}});
        s.materials.at(s.objects[0].material).textures.pop_back();
      });
  EXPECT_EQ(text, "sphere { material = { diffuse = brick { }; opacity = 1 } } // two");
}

TEST(RayPatch, LinksOfAnObjectAreChangedInItsText) {
  const std::string text = after("sphere { lit_by = (\"sun\"); /* warm */ } // one", [](Scene& s) {
    s.objects[0].links = {{}, {"moon"}};
  });
  EXPECT_NE(text.find("/* warm */"), std::string::npos) << text;
  EXPECT_NE(text.find("not_lit_by = (\"moon\")"), std::string::npos) << text;
}

TEST(RayPatch, WhatTheReaderRepairsIsSettledInALaterRound) {
  // A cone that would be a cylinder widens by 0.001: the other radius has to be said.
  const std::string text = after("cone { bottom_radius = 1; top_radius = 1; } // pipe",
                                 [](Scene& s) { shape<Cone>(s, 0).bottomRadius = 2; });
  EXPECT_EQ(text, "cone { bottom_radius = 2; top_radius = 1.001; } // pipe");
}

TEST(RayPatch, WhatCannotBeSaidInTheTextIsWrittenAnewWithAWarning) {
  const SceneText read = reading("test.ray", "SBT-raytracer 1.0\n// old\nsphere { name = a; } box { }\n");
  const Saved result = edited(read, [](Scene& s) {
    s.objects[0].worldFromObject = Affine::scaling({1, 1, 0});
  });
  EXPECT_FALSE(result.messages.empty());
}

}  // namespace
}  // namespace trace::ray_patch_test

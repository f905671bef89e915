// Binary Inventor files are the scenes of the text that they stand for, and damaged ones cost nothing else.
#include "formats/inventor/syntax/inventor_binary.h"

#include <gtest/gtest.h>

#include "formats/format.h"
#include "geometry/mesh/mesh.h"
#include "inventor_bytes.h"

namespace trace::inventor_binary_test {
namespace {

using test::InventorBytes;

/// All kinds of values that a scene may have.
std::string scene(bool old) {
  const InventorBytes b{old};
  const auto number = [](std::uint64_t n) { return InventorBytes::number(n); };
  const auto floats = [](const std::vector<double>& values) { return InventorBytes::numbers(values); };
  const auto text = [](const std::string& words) { return InventorBytes::text(words); };
  const auto field = [](const std::string& name, const std::string& value, std::uint32_t flags = 0) {
    return InventorBytes::field(name, value, flags);
  };
  // Of version 2.0 each pixel takes 4 bytes.
  const std::string pixels =
      old ? number(0xff0000) + number(0x00ff00) : std::string("\xff\0\0\0\xff\0", 6) + std::string(2, '\0');
  const std::string triangle =
      text("DEF") + text("a b") +
      b.group(
          "Separator",
          {b.node("ShapeHints", {field("vertexOrdering", text("COUNTERCLOCKWISE"))}),
           b.node("Material", {field("diffuseColor", number(2) + floats({1, 0.5, 0, 0, 0, 1})),
                               field("transparency", number(1) + floats({0.25}))}),
           b.node("MaterialBinding", {field("value", text("PER_FACE"))}),
           b.node("Coordinate3", {field("point", number(4) + floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}))}),
           b.node("IndexedFaceSet",
                  {field("coordIndex", number(8) + number(0) + number(1) + number(2) + number(~0u) +
                                           number(1) + number(3) + number(2) + number(~0u))})});
  return b.file(b.group(
      "Group",
      {b.node("Complexity", {field("value", floats({0.5}))}),
       b.node("PerspectiveCamera",
              {field("position", floats({0, 0, 5})), field("orientation", floats({0, 1, 0, 0.25}))}),
       triangle, b.node("Translation", {field("translation", floats({3, 0, 0}))}), text("USE") + text("a b"),
       b.node("Texture2", {field("image", number(2) + number(1) + number(3) + pixels)}),
       b.node("Cone", {field("parts", text("SIDES") + text("")), field("height", floats({7}), 1)}),
       b.node("Font", {field("name", text("Times-Roman"))}),
       b.node("Info", {field("string", text("said \"so\""))}),
       b.node("DirectionalLight", {field("on", number(0))}),
       b.node("Sphere", {field("radius", floats({2}), 2) + b.node("ElapsedTime", {}) + text("timeOut")})}));
}
const char* const kText =
    "#Inventor V2.1 ascii\n Group { Complexity { value 0.5 } "
    "PerspectiveCamera { position 0 0 5 orientation 0 1 0 0.25 } "
    "DEF ab Separator { ShapeHints { vertexOrdering COUNTERCLOCKWISE } Material { "
    "diffuseColor [ 1 0.5 0, 0 0 1 ] transparency 0.25 } MaterialBinding { value PER_FACE } "
    "Coordinate3 { point [ 0 0 0, 1 0 0, 0 1 0, 1 1 0 ] } IndexedFaceSet { coordIndex [ 0, 1, 2, -1, 1, 3, "
    "2, -1 ] } "
    "} Translation { translation 3 0 0 } USE ab Texture2 { image 2 1 3 0xff0000 0x00ff00 } "
    "Cone { parts (SIDES) height 7 ~ } Font { name Times-Roman } Info { string \"said \\\"so\\\"\" } "
    "DirectionalLight { on FALSE } Sphere { radius 2 = ElapsedTime { } . timeOut } }";

/// The scene, and what is said of it but for the places.
std::pair<Scene, std::vector<std::string>> readBytes(const std::string& bytes) {
  Messages messages;
  Scene read = readScene("a.iv", bytes, messages);
  std::vector<std::string> told;
  for (const Message& message : messages.all()) told.push_back(message.what);
  return {std::move(read), told};
}

TEST(InventorBinary, IsTheTextThatItStandsFor) {
  const auto [expected, expectedWords] = readBytes(kText);
  for (const bool old : {false, true}) {
    const auto [found, words] = readBytes(scene(old));
    EXPECT_EQ(words, expectedWords);
    ASSERT_EQ(found.objects.size(), 4u);
    ASSERT_EQ(found.materials.size(), expected.materials.size());
    for (std::size_t i = 0; i < found.objects.size(); ++i) {
      EXPECT_EQ(found.objects[i].worldFromObject, expected.objects[i].worldFromObject) << i;
      EXPECT_EQ(found.objects[i].material, expected.objects[i].material) << i;
      const Mesh *mesh = found.objects[i].shape.as<Mesh>(), *same = expected.objects[i].shape.as<Mesh>();
      ASSERT_EQ(mesh != nullptr, same != nullptr) << i;
      if (!mesh) continue;
      EXPECT_EQ(mesh->data->points, same->data->points);
      EXPECT_EQ(mesh->data->triangles, same->data->triangles);
      EXPECT_EQ(mesh->data->materials, same->data->materials);
    }
    for (std::size_t i = 0; i < found.materials.size(); ++i) {
      EXPECT_EQ(found.materials[i].model, expected.materials[i].model) << i;
      EXPECT_EQ(found.materials[i].textures.size(), expected.materials[i].textures.size()) << i;
    }
    EXPECT_EQ(found.camera, expected.camera);
    EXPECT_EQ(found.lights.size(), expected.lights.size());
  }
}

TEST(InventorBinary, NodesOfOtherProgramsSayTheTypesOfTheirFields) {
  const InventorBytes b;
  const auto text = [](const std::string& words) { return InventorBytes::text(words); };
  const std::string own = text("Wobble") + InventorBytes::number(0) + InventorBytes::number(0x101) +
                          text("SFVec2f") + text("shake") +
                          InventorBytes::field("shake", InventorBytes::numbers({1, 2}));
  Messages messages;
  const Scene scene = readScene("a.iv", b.file(own + b.node("Sphere", {})), messages);
  EXPECT_EQ(scene.objects.size(), 1u);
  ASSERT_FALSE(messages.all().empty());
  EXPECT_NE(messages.all()[0].what.find("\"Wobble\" is not rendered"), std::string::npos);
  EXPECT_EQ(messages.all()[0].place.line, 0) << "nobody sees the text";
}

TEST(InventorBinary, DamageIsAnErrorThatSaysWhere) {
  const std::string whole = scene(false);
  for (std::size_t length = 30; length < whole.size(); ++length) {
    try {
      inventor::textOfBinary("a.iv", whole.substr(0, length));
      ADD_FAILURE() << length;
    } catch (const Error& error) {
      EXPECT_TRUE(error.messages().front().what.starts_with("byte ")) << error.what();
    }
  }
  const InventorBytes b;
  std::string deep;
  for (int i = 0; i < 1000; ++i)
    deep += InventorBytes::text("Group") + InventorBytes::number(2) + InventorBytes::number(0) +
            InventorBytes::number(1);
  EXPECT_THROW(inventor::textOfBinary("a.iv", b.file(deep)), Error);
  std::uint32_t state = 3;
  const auto random = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
  std::size_t refused = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::string damaged = scene(trial % 2 == 0);
    for (std::uint32_t changes = 1 + random() % 3; changes > 0; --changes)
      damaged[24 + random() % (damaged.size() - 24)] = static_cast<char>(random());
    try {
      Messages messages;
      const Scene read = readScene("a.iv", damaged, messages);
    } catch (const Error& error) {
      EXPECT_FALSE(error.messages().empty());
      ++refused;
    }
  }
  EXPECT_GT(refused, 200u);
  EXPECT_LT(refused, 2000u);
}

}  // namespace
}  // namespace trace::inventor_binary_test

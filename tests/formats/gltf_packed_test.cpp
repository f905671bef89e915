// Compressed meshes of glTF are those that were compressed, and damaged ones cost themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "formats/format.h"
#include "geometry/mesh/mesh.h"
#include "packed_gltf.h"

namespace trace::gltf_packed_test {
namespace {

using namespace test;

struct ReadFile {
  Scene scene;
  std::string told;  ///< a warning a line
};
ReadFile readPacked(const std::string& bytes) {
  Messages messages;
  ReadFile read{readScene("a.gltf", bytes, messages), {}};
  for (const Message& message : messages.all())
    if (!message.what.starts_with("no light")) read.told += message.what + "\n";
  return read;
}
const MeshData& patchOf(const ReadFile& read, std::size_t object = 0) {
  return *read.scene.objects.at(object).shape.as<Mesh>()->data;
}
std::string errorOf(const std::string& bytes) {
  try {
    return "no error; told " + readPacked(bytes).told;
  } catch (const Error& error) {
    return error.messages().front().what;
  }
}

/// The triangles, each from its smallest corner on, in order.
std::vector<std::array<std::uint32_t, 3>> sortedTriangles(const MeshData& mesh,
                                                          const std::vector<std::uint32_t>& number = {}) {
  std::vector<std::array<std::uint32_t, 3>> all;
  for (const auto& t : mesh.triangles) {
    std::array<std::uint32_t, 3> corners{t[0], t[1], t[2]};
    if (!number.empty())
      for (std::uint32_t& corner : corners) corner = number.at(corner);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

double distance(const Vec3f& a, const Vec3f& b) { return length(Vec3(a) - Vec3(b)); }

/// The mesh is the other one, whose points may have another order, but for these errors.
void expectSame(const ReadFile& found, const ReadFile& expected, double place, double normal, double uv) {
  const MeshData &is = patchOf(found), &was = patchOf(expected);
  ASSERT_EQ(is.points.size(), was.points.size());
  ASSERT_EQ(is.normals.size(), was.normals.size());
  ASSERT_EQ(is.uvs.size(), was.uvs.size());
  ASSERT_EQ(is.materials.size(), was.materials.size());
  std::vector<std::uint32_t> number;  // of the same point in the other
  for (std::size_t i = 0; i < is.points.size(); ++i) {
    const auto nearest = std::min_element(was.points.begin(), was.points.end(), [&](auto& a, auto& b) {
      return distance(a, is.points[i]) < distance(b, is.points[i]);
    });
    const auto k = static_cast<std::size_t>(nearest - was.points.begin());
    number.push_back(static_cast<std::uint32_t>(k));
    EXPECT_LE(distance(is.points[i], was.points[k]), place) << i;
    EXPECT_LE(distance(is.normals[i], was.normals[k]), normal) << i;
    EXPECT_LE(std::abs(is.uvs[i].x - was.uvs[k].x), uv) << i;
    EXPECT_LE(std::abs(is.uvs[i].y - was.uvs[k].y), uv) << i;
    if (!is.materials.empty()) {
      const auto model = [](const ReadFile& read, const MeshData& mesh, std::size_t point) {
        return read.scene.materials.at(mesh.materials.at(point)).model;
      };
      EXPECT_EQ(model(found, is, i), model(expected, was, k)) << i;
    }
  }
  EXPECT_EQ(std::set<std::uint32_t>(number.begin(), number.end()).size(), number.size());
  EXPECT_EQ(sortedTriangles(is, number), sortedTriangles(was));
}

/// With two joints, of which the second lifts the points by their weight.
Square& withJoints(Square& square) {
  square.root["nodes"] = {{{"mesh", 0}, {"skin", 0}}, json::object(), {{"translation", {0, 0, 1}}}};
  square.root["scenes"] = {{{"nodes", {0, 1, 2}}}};
  square.root["skins"] = {{{"joints", {1, 2}}}};
  return square;
}

ReadFile plainRead(const Patch& patch) {
  Square square = plainPatch(patch);
  return readPacked(withJoints(square).text());
}

// --- Draco -------------------------------------------------------------------------------------------------

TEST(GltfDraco, AllAttributesComeBackAsExactAsTheyWereKept) {
  const Patch patch(9);
  const ReadFile plain = plainRead(patch);
  ASSERT_EQ(plain.told, "");
  ASSERT_EQ(patchOf(plain).triangles.size(), 128u);
  EXPECT_NEAR(patchOf(plain).points.at(8).z, 1 + patchOf(plain).points.at(0).z, 1e-6) << "it is bent";
  for (const bool edgebreaker : {true, false})
    for (const int bits : {0, 12}) {
      SCOPED_TRACE(std::to_string(edgebreaker) + " " + std::to_string(bits));
      Square square = dracoPatch(patch, dracoOf(patch, edgebreaker, bits));
      const ReadFile read = readPacked(withJoints(square).text());
      EXPECT_EQ(read.told, "");
      const double step = bits == 0 ? 1e-6 : 1.0 / (1 << bits);  // of places, and of weights
      expectSame(read, plain, 3 * step, 4 * step, step);
      if (!edgebreaker) {
        EXPECT_EQ(patchOf(read).triangles, patchOf(plain).triangles);
      }
    }
}

TEST(GltfDraco, NumbersBecomeThoseOfTheAccessor) {
  Patch patch;
  std::vector<std::uint8_t> uvs;
  for (std::size_t i = 0; i < 2 * patch.points(); ++i) uvs.push_back(static_cast<std::uint8_t>(2 * i));
  patch.add("TEXCOORD_0", 5121, 2, true, bytesOf(uvs));
  const Dracoed draco = dracoOf(patch, false, 0);
  const auto uvOf = [&](int componentType, bool normalized) {
    Square square = dracoPatch(patch, draco);
    accessorOf(square, "TEXCOORD_0")["componentType"] = componentType;
    accessorOf(square, "TEXCOORD_0")["normalized"] = normalized;
    return patchOf(readPacked(square.text())).uvs.at(2).x;
  };
  EXPECT_NEAR(uvOf(5121, true), 8 / 255.0, 1e-12);
  EXPECT_NEAR(uvOf(5126, false), 8 / 255.0, 1e-6);
  EXPECT_EQ(uvOf(5123, false), 8);
  EXPECT_EQ(uvOf(5120, false), 8);
  EXPECT_EQ(uvOf(5125, false), 8);
}

TEST(GltfDraco, WhatIsThereASecondTimeIsReadAsItIs) {
  const Patch patch;
  Square square = plainPatch(patch);
  square.primitive()["extensions"][kDracoName] = {{"bufferView", addView(square, "no Draco")},
                                                  {"attributes", {{"POSITION", 0}}}};
  const ReadFile read = readPacked(square.text());
  EXPECT_EQ(read.told, "");
  EXPECT_EQ(patchOf(read).triangles.size(), 32u);
}

TEST(GltfDraco, AttributesThatAreNotCompressedStandBesideThem) {
  Patch patch;
  const Patch whole;
  patch.attributes.erase("COLOR_0");
  const Dracoed draco = dracoOf(patch, false, 0);
  Square square = dracoPatch(whole, draco);
  accessorOf(square, "COLOR_0")["bufferView"] = addView(square, whole.attributes.at("COLOR_0").bytes);
  Square plain = plainPatch(whole);
  expectSame(readPacked(square.text()), readPacked(plain.text()), 0, 0, 0);
}

/// Two primitives: one as `square` has it, and a sound one.
Square besideASoundOne(Square square) {
  const Patch patch;
  const Dracoed sound = dracoOf(patch, true, 10);
  json primitive = square.primitive();
  primitive["extensions"][kDracoName] = {{"bufferView", addView(square, sound.bytes)},
                                         {"attributes", sound.ids}};
  for (auto& [name, accessor] : primitive["attributes"].items()) {
    square.root["accessors"].push_back(square.root["accessors"][accessor.get<std::size_t>()]);
    square.root["accessors"].back().erase("bufferView");
    accessor = square.root["accessors"].size() - 1;
  }
  square.root["meshes"][0]["primitives"].push_back(primitive);
  return square;
}

TEST(GltfDraco, DamageCostsTheMeshAndIsTold) {
  const Patch patch;
  const Dracoed draco = dracoOf(patch, true, 10);
  struct Row {
    Dracoed draco;
    const char* told;
  };
  const auto head = [](const std::string& rest) {
    return Dracoed{std::string("DRACO\2\2", 7) + rest, {{"POSITION", 0}}};
  };
  auto ids = draco.ids;
  ids["NORMAL"] = 77;
  auto few = draco.ids;
  few["POSITION"] = draco.ids.at("TEXCOORD_0");
  for (const Row& row : {Row{{draco.bytes.substr(0, draco.bytes.size() / 2), draco.ids}, "are damaged"},
                         Row{{draco.bytes.substr(0, 9), draco.ids}, "end too early"},
                         Row{{"no Draco at all", draco.ids}, "do not begin as Draco's do"},
                         Row{{draco.bytes, ids}, "no attribute of the number 77"},
                         Row{{draco.bytes, few}, "has 2 components, and its accessor 3"},
                         Row{head(std::string("\0\0\0\0", 4)), "a cloud of points"},
                         // Edgebreaker, of 3 points and 2^32 - 1 triangles; sequential, of as many points.
                         Row{head(std::string("\1\1\0\0\0\3\xff\xff\xff\xff\x0f\0\1\0", 14)),
                             "4294967295 triangles of 3 points are not believable"},
                         Row{head(std::string("\1\0\0\0\1\xff\xff\xff\xff\x0f\1", 11)),
                             "1 triangles of 4294967295 points are not believable"},
                         // 4000 triangles, with 255 attributes that have seams of their own.
                         Row{head(std::string("\1\1\0\0\0\3\xa0\x1f\xff\1\0", 11)), "not believable"}}) {
    const Square alone = dracoPatch(patch, row.draco);
    const std::string error = errorOf(alone.text());
    EXPECT_NE(error.find("meshes[0].primitives[0]: cannot be decompressed (KHR_draco_mesh_compression)"),
              error.npos)
        << error;
    EXPECT_NE(error.find(row.told), error.npos) << error;
    const ReadFile read = readPacked(besideASoundOne(alone).text());
    ASSERT_EQ(read.scene.objects.size(), 1u);
    EXPECT_EQ(patchOf(read).triangles.size(), 32u);
    EXPECT_NE(read.told.find(row.told), read.told.npos) << read.told;
    EXPECT_EQ(std::count(read.told.begin(), read.told.end(), '\n'), 1) << read.told;
  }
}

TEST(GltfDraco, MoreValuesThanTheBytesCanHoldAreRefused) {
  Patch bomb(63);
  const std::string places = bomb.attributes.at("POSITION").bytes;
  bomb.attributes.clear();
  bomb.add("POSITION", 5126, 3, false, places);
  for (int i = 0; i < 10; ++i)
    bomb.add("_" + std::to_string(i), 5121, 120, false, std::string(120 * bomb.points(), '\0'));
  const Dracoed draco = dracoOf(bomb, true, 8);
  EXPECT_LT(draco.bytes.size(), 10000u);
  Patch visible(63);
  visible.attributes = {{"POSITION", bomb.attributes.at("POSITION")}};
  const std::string error =
      errorOf(dracoPatch(visible, {draco.bytes, {{"POSITION", draco.ids.at("POSITION")}}}).text());
  EXPECT_NE(error.find("11 attributes of 3969 points are not believable in"), error.npos) << error;
}

TEST(GltfDraco, AMeshIsNotDecompressedAgainAndAgain) {
  Square square = dracoPatch(Patch(), dracoOf(Patch(20), true, 8));
  for (int i = 0; i < 9; ++i) square.root["meshes"].push_back(square.root["meshes"][0]);
  for (json& mesh : square.root["meshes"])
    for (int i = 0; i < 400; ++i) mesh["primitives"].push_back(mesh["primitives"][0]);
  const std::string error = errorOf(square.text());
  EXPECT_NE(error.find("compressed data are used too often"), error.npos) << error;
}

// --- meshoptimizer -----------------------------------------------------------------------------------------

TEST(GltfMeshopt, EachModeIsExact) {
  const Patch patch(9);
  const ReadFile plain = plainRead(patch);
  for (const char* mode : {"TRIANGLES", "INDICES"})
    for (const std::size_t indexBytes : {2, 4}) {
      SCOPED_TRACE(std::string(mode) + std::to_string(indexBytes));
      Square square = meshoptPatch(patch, mode, indexBytes);
      const ReadFile read = readPacked(withJoints(square).text());
      EXPECT_EQ(read.told, "");
      expectSame(read, plain, 0, 0, 0);
      EXPECT_EQ(patchOf(read).points, patchOf(plain).points);
    }
}

TEST(GltfMeshopt, ABinaryFileHasItsBytesInItself) {
  const Patch patch;
  Square square = meshoptPatch(patch, "TRIANGLES", 2);
  // glb() writes the first buffer; views of the second are of the first, which has other bytes there.
  for (json& view : square.root["bufferViews"]) view["buffer"] = 0;
  square.root.erase("buffers");
  const ReadFile read = readPacked(square.glb());
  EXPECT_EQ(read.told, "");
  expectSame(read, readPacked(plainPatch(patch).text()), 0, 0, 0);
}

std::vector<float> floatsIn(const Patch& patch, const char* name) {
  const std::string& bytes = patch.attributes.at(name).bytes;
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

TEST(GltfMeshopt, OctahedralNormals) {
  const Patch patch(9);
  std::vector<float> four;
  const std::vector<float> normals = floatsIn(patch, "NORMAL");
  for (std::size_t i = 0; i < normals.size(); i += 3)
    four.insert(four.end(), {normals[i], normals[i + 1], normals[i + 2], 0});
  const ReadFile plain = plainRead(patch);
  for (const auto& [stride, bits, error] : {std::tuple(4, 8, 0.02), std::tuple(8, 12, 0.002)}) {
    std::string filtered(patch.points() * static_cast<std::size_t>(stride), '\0');
    meshopt_encodeFilterOct(filtered.data(), patch.points(), static_cast<std::size_t>(stride), bits,
                            four.data());
    Square square = meshoptPatch(patch, "TRIANGLES", 2);
    const std::size_t view =
        addMeshoptView(square, meshoptVertices(filtered, static_cast<std::size_t>(stride)), "ATTRIBUTES",
                       patch.points(), static_cast<std::size_t>(stride), "OCTAHEDRAL");
    accessorOf(square, "NORMAL")
        .update({{"bufferView", view}, {"componentType", stride == 4 ? 5120 : 5122}, {"normalized", true}});
    withFallback(square);
    const ReadFile read = readPacked(withJoints(square).text());
    EXPECT_EQ(read.told, "");
    expectSame(read, plain, 0, error, 0);
  }
}

TEST(GltfMeshopt, ExponentialPlacesAndCoordinates) {
  const Patch patch(9);
  Square square = meshoptPatch(patch, "TRIANGLES", 2);
  for (const char* name : {"POSITION", "TEXCOORD_0"}) {
    const std::vector<float> values = floatsIn(patch, name);
    const std::size_t stride = patch.attributes.at(name).size();
    std::string filtered(values.size() * sizeof(float), '\0');
    meshopt_encodeFilterExp(filtered.data(), patch.points(), stride, 15, values.data());
    accessorOf(square, name)["bufferView"] = addMeshoptView(
        square, meshoptVertices(filtered, stride), "ATTRIBUTES", patch.points(), stride, "EXPONENTIAL");
  }
  withFallback(square);
  const ReadFile read = readPacked(withJoints(square).text());
  EXPECT_EQ(read.told, "");
  expectSame(read, plainRead(patch), 1e-3, 1e-6, 1e-3);
  EXPECT_NE(patchOf(read).points, patchOf(plainRead(patch)).points) << "some bits are lost";
}

/// Two copies, the second turned by a quarter about z.
Square copiesByQuaternions(const std::string& packed) {
  Square square;
  const std::size_t view = addMeshoptView(square, packed, "ATTRIBUTES", 2, 8, "QUATERNION");
  square.root["accessors"].push_back(
      {{"bufferView", view}, {"componentType", 5122}, {"normalized", true}, {"count", 2}, {"type", "VEC4"}});
  square.node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] =
      square.root["accessors"].size() - 1;
  return withFallback(square);
}
std::string quarterTurn() {
  const float half = std::sqrt(0.5f), turns[] = {0, 0, 0, 1, 0, 0, half, half};
  std::string filtered(16, '\0');
  meshopt_encodeFilterQuat(filtered.data(), 2, 8, 14, turns);
  return meshoptVertices(filtered, 8);
}

TEST(GltfMeshopt, QuaternionsOfCopies) {
  const ReadFile read = readPacked(copiesByQuaternions(quarterTurn()).text());
  EXPECT_EQ(read.told, "");
  ASSERT_EQ(read.scene.objects.size(), 2u);
  const Vec3 x = read.scene.objects[1].worldFromObject * Vec3{1, 0, 0};
  EXPECT_LT(length(x - Vec3{0, 1, 0}), 1e-3);
}

TEST(GltfMeshopt, DamageCostsTheMeshesThatUseItAndIsTold) {
  const Patch patch;
  struct Row {
    const char* of;  ///< the accessor whose view is changed
    const char* key;
    json value;
    const char* told;
  };
  const auto damaged = [&](const Row& row) {
    Square square = meshoptPatch(patch, "TRIANGLES", 2);
    const auto view = accessorOf(square, row.of)["bufferView"].get<std::size_t>();
    square.root["bufferViews"][view]["extensions"][kMeshoptName][row.key] = row.value;
    return square;
  };
  for (const Row& row :
       {Row{"POSITION", "count", 2000000000, "2000000000 elements of 12 bytes do not fit into"},
        Row{"POSITION", "byteLength", 40, "the data are damaged"},
        Row{"POSITION", "byteLength", 2000000000, "end behind their buffer"},
        Row{"POSITION", "byteOffset", 2000000000, "end behind their buffer"},
        Row{"POSITION", "byteStride", 7, "a byteStride of 4, 8, 12 ... 256, found 7"},
        Row{"POSITION", "byteStride", 260, "a byteStride of 4, 8, 12 ... 256, found 260"},
        Row{"POSITION", "filter", "OCTAHEDRAL", "4 or 8 for the filter OCTAHEDRAL, found 12"},
        Row{"POSITION", "filter", "QUATERNION", "8 for the filter QUATERNION, found 12"},
        Row{"POSITION", "mode", "TRIANGLES", "a byteStride of 2 or 4, found 12"},
        Row{"indices", "count", 95, "three indices for each triangle, found a count of 95"},
        Row{"indices", "count", 3000000, "do not fit into"},
        Row{"indices", "filter", "EXPONENTIAL", "only a view of the mode ATTRIBUTES has a filter"},
        Row{"indices", "byteStride", 1, "a byteStride of 2 or 4, found 1"},
        Row{"indices", "mode", "INDICES", "do not fit into"},
        Row{"indices", "byteLength", 40, "the data are damaged, or of a newer version"}}) {
    Square alone = damaged(row);
    const std::string error = errorOf(alone.text());
    EXPECT_NE(error.find("]: cannot be decompressed (EXT_meshopt_compression): "), error.npos) << error;
    EXPECT_TRUE(error.starts_with("bufferViews[")) << error;
    EXPECT_NE(error.find(row.told), error.npos) << row.told << "\n" << error;

    alone.root["meshes"].push_back({{"primitives", {json::object()}}});
    json& sound = alone.root["meshes"][1]["primitives"][0];
    const Patch small(3);
    sound["attributes"]["POSITION"] = alone.root["accessors"].size();
    const std::size_t places = addMeshoptView(
        alone, meshoptVertices(small.attributes.at("POSITION").bytes, 12), "ATTRIBUTES", small.points(), 12);
    alone.root["accessors"].push_back(
        {{"bufferView", places}, {"componentType", 5126}, {"count", small.points()}, {"type", "VEC3"}});
    alone.root["nodes"].push_back({{"mesh", 1}});
    alone.root["scenes"][0]["nodes"] = {0, 1};
    const ReadFile read = readPacked(withFallback(alone).text());
    ASSERT_EQ(read.scene.objects.size(), 1u);
    EXPECT_EQ(patchOf(read).triangles.size(), 2u) << "one of the three is no more than an edge";
    EXPECT_NE(read.told.find(row.told), read.told.npos) << read.told;
  }
}

TEST(GltfMeshopt, WhatIsMissingOrAbsurdInTheFileIsAnError) {
  const Patch patch;
  for (const char* key : {"buffer", "byteLength", "byteStride", "count", "mode"}) {
    Square square = meshoptPatch(patch, "TRIANGLES", 2);
    square.root["bufferViews"].back()["extensions"][kMeshoptName].erase(key);
    const std::string error = errorOf(square.text());
    EXPECT_NE(error.find(std::string("EXT_meshopt_compression.") + key), error.npos) << error;
  }
  for (const char* key : {"byteOffset", "byteLength", "count"})
    for (const std::uint64_t number : {std::uint64_t{1} << 31, ~std::uint64_t{0}}) {
      Square square = meshoptPatch(patch, "TRIANGLES", 2);
      square.root["bufferViews"].back()["extensions"][kMeshoptName][key] = number;
      const std::string error = errorOf(square.text());
      EXPECT_NE(error.find("expected at most 2147483647"), error.npos) << error;
    }
  Square square = meshoptPatch(patch, "TRIANGLES", 2);
  square.root["bufferViews"].back()["extensions"][kMeshoptName]["filter"] = "COLOR";
  EXPECT_NE(errorOf(square.text()).find("NONE, OCTAHEDRAL, QUATERNION, EXPONENTIAL"), std::string::npos);
}

TEST(GltfMeshopt, LostTurnsOfCopiesCostTheCopies) {
  Square square = copiesByQuaternions(quarterTurn().substr(0, 20));
  EXPECT_NE(errorOf(square.text()).find("the data are damaged"), std::string::npos);
  square.root["nodes"].push_back({{"mesh", 0}});
  square.root["scenes"][0]["nodes"] = {0, 1};
  const ReadFile read = readPacked(square.text());
  EXPECT_EQ(read.scene.objects.size(), 1u);
  EXPECT_NE(read.told.find("meshes that use it are left out"), read.told.npos) << read.told;
}

TEST(GltfMeshopt, TheSameBytesAreNotDecompressedAgainAndAgain) {
  Square square = meshoptPatch(Patch(40), "TRIANGLES", 4);
  json& views = square.root["bufferViews"];
  const json view = views.back();
  for (int i = 0; i < 6000; ++i) views.push_back(view);
  const std::string error = errorOf(square.text());
  EXPECT_NE(error.find("compressed data are used too often"), error.npos) << error;
}

// --- untrusted bytes ---------------------------------------------------------------------------------------

/// Nothing but Error escapes, whatever the compressed bytes are.
TEST(GltfPacked, SurvivesMutation) {
  const Patch patch(4);
  std::vector<std::pair<Square, std::string>> files;  // and the compressed bytes
  for (const bool edgebreaker : {true, false}) {
    const Dracoed draco = dracoOf(patch, edgebreaker, 8);
    files.emplace_back(dracoPatch(patch, draco), draco.bytes);
  }
  Square meshopt = meshoptPatch(patch, "TRIANGLES", 2);
  files.emplace_back(meshopt, meshopt.data());
  std::uint32_t state = 5;
  const auto random = [&] { return (state = state * 1664525u + 1013904223u) >> 8; };
  std::size_t read = 0, refused = 0;
  for (const auto& [square, packed] : files)
    for (int trial = 0; trial < 400; ++trial) {
      std::string bytes = square.glb();
      const std::size_t start = bytes.find(packed.substr(0, 8));
      ASSERT_NE(start, bytes.npos);
      const std::size_t reach = trial % 2 == 0 ? packed.size() : std::min<std::size_t>(packed.size(), 40);
      for (std::uint32_t changes = 1 + random() % 3; changes > 0; --changes)
        bytes[start + random() % reach] = static_cast<char>(random());
      try {
        Messages messages;
        const Scene scene = readScene("a.glb", bytes, messages);
        EXPECT_EQ(scene, scene) << "a NaN got in";
        ++read;
      } catch (const Error& error) {
        EXPECT_FALSE(error.messages().empty());
        ++refused;
      }
    }
  EXPECT_GT(read, 100u);
  EXPECT_GT(refused, 100u);
}

}  // namespace
}  // namespace trace::gltf_packed_test

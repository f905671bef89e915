// Probes of glTF and of its extensions: a square with one field more or less.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "gltf_square.h"
#include "packed_gltf.h"
#include "scene_probes.h"
#include "support/webp.h"

namespace trace::probes_gltf_test {
namespace {

using nlohmann::json;
using test::Square;

/// Probes of one field of the square.
class Probes {
 public:
  /// The field set in the square as `before` makes it.
  Probes& set(const std::string& field, const std::string& at, json value, const std::string& told = {},
              Square before = {}) {
    const std::string without = before.text();
    all.push_back({field, without, before.set(at, std::move(value)).text(), told});
    return *this;
  }
  Probes& add(const std::string& field, const Square& without, const Square& with,
              const std::string& told = {}) {
    all.push_back({field, without.text(), with.text(), told});
    return *this;
  }
  std::vector<Probe> all;
};

Square with(const std::string& at, json value) { return Square().set(at, std::move(value)); }

TEST(Probes, OfGltf) {
  Probes p;
  const std::string pbr = "/materials/0/pbrMetallicRoughness/", primitive = "/meshes/0/primitives/0/";
  const json texture = {{"index", 0}};
  p.set("asset.version", "/asset/version", "3.0", "version 3");
  p.set("asset.minVersion", "/asset/minVersion", "2.2", "version 2.2");
  p.set("asset.generator", "/asset/generator", "a program");
  p.set("asset.copyright", "/asset/copyright", "somebody");
  p.set("extensionsUsed", "/extensionsUsed", {"EXT_nobody"}, "\"EXT_nobody\"");
  p.set("extensionsRequired", "/extensionsRequired", {"EXT_nobody"}, "\"EXT_nobody\"");
  p.set("extras", "/nodes/0/extras", {{"a", 1}});
  p.set("unknown properties", "/nodes/0/colour", 1, "unknown property \"colour\"");
  const Square two = with("/scenes", {{{"nodes", {0}}}, {{"nodes", json::array()}}});
  p.set("scene", "/scene", 1, "",
        Square(two).set("/nodes/1", {{"mesh", 0}, {"name", "b"}}).set("/scenes/1/nodes", {1}));
  p.add("scenes", Square(), two, "one scene is shown");
  p.set("scene.nodes", "/scenes/0/nodes", {1}, "", with("/nodes/1", {{"mesh", 0}, {"name", "b"}}));
  p.set("node.children", "/nodes/0/children", {1}, "", with("/nodes/1", {{"mesh", 0}, {"name", "b"}}));
  p.set("node.matrix", "/nodes/0/matrix", {2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
  p.set("node.translation", "/nodes/0/translation", {1, 2, 3});
  p.set("node.rotation", "/nodes/0/rotation", {1, 0, 0, 0});
  p.set("node.scale", "/nodes/0/scale", {1, 2, 3});
  p.set("node.name", "/nodes/0/name", "table");
  p.add("node.mesh", with("/nodes/1", json::object()).set("/scenes/0/nodes", {0, 1}),
        with("/nodes/1", {{"mesh", 0}}).set("/scenes/0/nodes", {0, 1}));
  const json view = {{"yfov", 0.8}, {"znear", 0.1}};
  Square seen;
  seen.camera("perspective", view);
  p.add("node.camera", Square(), seen);
  p.add("node.camera of a second node", seen,
        Square(seen).set("/nodes/1", {{"camera", 0}}).set("/scenes/0/nodes", {0, 1}), "the first camera");
  p.set("mesh.name", "/meshes/0/name", "table");
  p.add("primitive.indices", Square().erase(primitive + "indices"), Square());
  p.add("primitive.material", Square().erase(primitive + "material"), Square());
  const Square plain = with("/nodes/1", {{"mesh", 1}})
                           .set("/scenes/0/nodes", {0, 1})
                           .set("/meshes/1", {{"primitives", json::array()}});
  const auto mode = [&](int number) {
    Square square = plain;
    square.root["meshes"][1]["primitives"] = json::array({square.primitive()});
    square.root["meshes"][1]["primitives"][0]["mode"] = number;
    return square;
  };
  for (int number : {0, 1, 2, 3})
    p.add("primitive.mode " + std::to_string(number), plain, mode(number), "points and lines are left out");
  p.add("primitive.mode 4", plain, mode(4));
  p.add("primitive.mode 5", mode(4), mode(5));
  p.add("primitive.mode 6", mode(5), mode(6));
  p.add("POSITION", Square(), Square().attribute("POSITION", {0, 0, 0, 2, 0, 0, 1, 1, 0, 0, 1, 0}, 3));
  p.add("NORMAL", Square().erase(primitive + "attributes/NORMAL"),
        Square().attribute("NORMAL", {1, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, 3));
  const Square mapped = with("/materials/0/normalTexture", texture);
  p.add("TANGENT", mapped,
        Square(mapped).attribute("TANGENT", {0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1}, 4));
  p.add("TEXCOORD_0", Square(), Square().attribute("TEXCOORD_0", {0, 0, 2, 0, 2, 2, 0, 2}, 2));
  const Square set1 = with(pbr + "baseColorTexture", {{"index", 0}, {"texCoord", 1}})
                          .attribute("TEXCOORD_1", {0, 0, 1, 0, 1, 1, 0, 1}, 2);
  p.add("TEXCOORD_1", set1, Square(set1).attribute("TEXCOORD_1", {0, 0, 2, 0, 2, 2, 0, 2}, 2));
  const std::vector<float> colors{1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1},
      clear{1, 0, 0, 0.5, 0, 1, 0, 1, 0, 0, 1, 1, 1, 1, 1, 1};
  p.add("COLOR_0", Square(), Square().attribute("COLOR_0", colors, 3));
  const Square blend = with("/materials/0/alphaMode", "BLEND");
  p.add("COLOR_0 with alpha", Square(blend).attribute("COLOR_0", colors, 3),
        Square(blend).attribute("COLOR_0", clear, 4), "transparency of COLOR_0");
  p.add("COLOR_1", Square(), Square().attribute("COLOR_1", colors, 3), "COLOR_1 is not shown");
  p.add("_attributes of programs", Square(), Square().attribute("_BATCH", colors, 3));
  p.add("unknown attributes", Square(), Square().attribute("COLOUR", colors, 3),
        "unknown attribute \"COLOUR\"");

  Square morphed;
  const int moved = morphed.floats({0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 3);
  morphed.primitive()["targets"] = {{{"POSITION", moved}}};
  const Square heavy = Square(morphed).set("/meshes/0/weights", {1});
  p.add("primitive.targets", with("/meshes/0/weights", {1}), heavy);
  p.add("primitive.targets of other attributes", heavy,
        Square(heavy).set(primitive + "targets/0/TEXCOORD_0", moved), "morph targets of \"TEXCOORD_0\"");
  p.add("mesh.weights", morphed, heavy);
  p.add("node.weights", heavy, Square(heavy).set("/nodes/0/weights", {0.5}));

  Square skinned = with("/nodes/0", {{"mesh", 0}, {"children", {1}}});
  skinned.attribute("JOINTS_0", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 4)
      .attribute("WEIGHTS_0", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, 4)
      .set("/nodes/1", {{"translation", {0, 0, 2}}})
      .set("/skins", {{{"joints", {1}}}});
  const Square bent = Square(skinned).set("/nodes/0/skin", 0);
  p.add("node.skin", skinned, bent);
  p.add("skin.joints", bent, Square(bent).set("/skins/0/joints", {0}));
  Square bound = bent;
  const int undo = bound.matrices({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -1, 1});
  p.add("skin.inverseBindMatrices", bent, bound.set("/skins/0/inverseBindMatrices", undo));
  p.set("skin.skeleton", "/skins/0/skeleton", 1, "", bent);
  p.add("JOINTS_0", Square(bent).erase(primitive + "attributes/JOINTS_0"), bent);
  p.add("WEIGHTS_0", Square(bent).erase(primitive + "attributes/WEIGHTS_0"), bent);

  Square moves = heavy;
  const auto sampler = [&](const std::vector<float>& values, int each) {
    return json{{"input", moves.floats({0}, 1)}, {"output", moves.floats(values, each)}};
  };
  const json played = {{"samplers", {sampler({1, 2, 3}, 3), sampler({0, 0, 1, 0}, 4), sampler({0.5}, 1)}},
                       {"channels", json::array()}};
  moves.set("/animations", json::array({played}));
  const auto channel = [](int of, const char* path) {
    return json::array({{{"sampler", of}, {"target", {{"node", 0}, {"path", path}}}}});
  };
  p.set("animations", "/animations/0/channels", channel(0, "translation"), "", moves);
  p.set("animation of rotation", "/animations/0/channels", channel(1, "rotation"), "", moves);
  p.set("animation of scale", "/animations/0/channels", channel(0, "scale"), "", moves);
  p.set("animation of weights", "/animations/0/channels", channel(2, "weights"), "", moves);
  p.set("animations behind the first", "/animations/1", played, "others are left out: 1", moves);
  Square between = moves;
  const json keys = {{"input", between.floats({-1, 1}, 1)},
                     {"output", between.floats({0, 0, 0, 2, 2, 2}, 3)}};
  between.set("/animations/0/samplers/0", keys).set("/animations/0/channels", channel(0, "translation"));
  p.set("animation.sampler.interpolation", "/animations/0/samplers/0/interpolation", "STEP", "", between);

  Square zeros;
  zeros.primitive()["attributes"]["TEXCOORD_0"] = zeros.root["accessors"].size();
  zeros.root["accessors"].push_back({{"componentType", 5126}, {"count", 4}, {"type", "VEC2"}});
  p.add("accessor.bufferView", zeros, Square());
  p.set("accessor.byteOffset", "/accessors/2/byteOffset", 8, "",
        with("/accessors/2/count", 3)
            .erase(primitive + "indices")
            .set("/accessors/0/count", 3)
            .set("/accessors/1/count", 3));
  Square quantised = with("/extensionsUsed", {"KHR_mesh_quantization"});
  quantised.primitive()["attributes"]["TEXCOORD_0"] =
      quantised.bytes(std::string("\0\0\x7f\0\x7f\x7f\0\x7f", 8), 5121, 4, "VEC2");
  p.set("accessor.componentType", "/accessors/4/componentType", 5120, "",
        Square(quantised).set("/accessors/4/normalized", true));
  p.set("accessor.normalized", "/accessors/4/normalized", true, "", quantised);
  p.set("accessor.count", "/accessors/3/count", 3);
  p.set("accessor.min", "/accessors/0/min", {0, 0, 0});
  p.set("accessor.max", "/accessors/0/max", {1, 1, 0});
  Square sparse;
  const int index = sparse.bytes(std::string("\1", 1), 5121, 1, "SCALAR"),
            value = sparse.floats({3, 0, 0}, 3);
  sparse.root["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices",
       {{"bufferView", sparse.root["accessors"][static_cast<std::size_t>(index)]["bufferView"]},
        {"componentType", 5121}}},
      {"values", {{"bufferView", sparse.root["accessors"][static_cast<std::size_t>(value)]["bufferView"]}}}};
  p.add("accessor.sparse", Square(), sparse);
  Square wide;
  wide.primitive()["attributes"]["TEXCOORD_0"] =
      wide.floats({0, 0, 1, 0, 1, 1, 0, 1, .5, .5, .5, .5, 0, 0, 0, 0}, 2);
  wide.set("/accessors/4/count", 4);
  p.set("bufferView.byteStride", "/bufferViews/4/byteStride", 16, "", wide);
  p.set("bufferView.byteOffset", "/bufferViews/2/byteOffset", 0);
  p.set("bufferView.target", "/bufferViews/0/target", 34962);
  const Square file = with("/buffers", {{{"byteLength", Square().data().size()}, {"uri", "probe.bin"}}});
  p.set("buffer.uri", "/buffers/0/uri", "other.bin", "", file);
  const Square textured = with(pbr + "baseColorTexture", texture);
  p.set("image.uri", "/images/0/uri", "p.png", "", textured);
  Square inside = textured;
  inside.bytes(test::smallPng(0, 255, 0), 5121, 4, "SCALAR");
  inside.set("/images/2", {{"bufferView", 4}, {"mimeType", "image/png"}, {"name", "green"}});
  inside.root["accessors"].erase(4);
  p.set("image.bufferView", "/textures/0/source", 2, "", inside);
  p.set("image.mimeType", "/images/0/mimeType", "image/png", "", textured);
  p.set("texture.source", "/textures/0/source", 1, "", textured);
  Square sampled = textured;
  sampled.set("/samplers", {json::object(), {{"wrapS", 33071}}}).set("/textures/0/sampler", 0);
  p.set("texture.sampler", "/textures/0/sampler", 1, "", sampled);
  p.set("sampler.magFilter", "/samplers/0/magFilter", 9728, "", sampled);
  p.set("sampler.minFilter", "/samplers/0/minFilter", 9729, "", sampled);
  p.set("sampler.wrapS", "/samplers/0/wrapS", 33648, "", sampled);
  p.set("sampler.wrapT", "/samplers/0/wrapT", 33071, "", sampled);

  p.set("material.name", "/materials/0/name", "oak");
  p.set("material.pbrMetallicRoughness.baseColorFactor", pbr + "baseColorFactor", {1, 0, 0, 1});
  p.set("material.pbrMetallicRoughness.baseColorTexture", pbr + "baseColorTexture", texture);
  p.set("material.pbrMetallicRoughness.metallicFactor", pbr + "metallicFactor", 0.2);
  p.set("material.pbrMetallicRoughness.roughnessFactor", pbr + "roughnessFactor", 0.2);
  p.set("material.pbrMetallicRoughness.metallicRoughnessTexture", pbr + "metallicRoughnessTexture", texture);
  p.set("material.normalTexture", "/materials/0/normalTexture", texture);
  p.set("material.normalTexture.scale", "/materials/0/normalTexture/scale", 0.5, "", mapped);
  p.set("material.occlusionTexture", "/materials/0/occlusionTexture", texture);
  p.set("material.occlusionTexture.strength", "/materials/0/occlusionTexture/strength", 0.5, "",
        with("/materials/0/occlusionTexture", texture));
  p.set("material.emissiveTexture", "/materials/0/emissiveTexture", texture, "",
        with("/materials/0/emissiveFactor", {1, 1, 1}));
  p.set("material.emissiveFactor", "/materials/0/emissiveFactor", {1, 0, 0});
  const Square half = with(pbr + "baseColorFactor", {1, 1, 1, 0.4});
  p.set("material.alphaMode MASK", "/materials/0/alphaMode", "MASK", "", half);
  p.set("material.alphaMode BLEND", "/materials/0/alphaMode", "BLEND", "", half);
  p.set("material.alphaCutoff", "/materials/0/alphaCutoff", 0.3, "",
        Square(half).set("/materials/0/alphaMode", "MASK"));
  p.set("material.doubleSided", "/materials/0/doubleSided", true);
  p.set("texCoord", pbr + "baseColorTexture/texCoord", 1, "",
        Square(textured).attribute("TEXCOORD_1", {0, 0, 2, 0, 2, 2, 0, 2}, 2));
  for (const char* key : {"yfov", "aspectRatio"})
    p.set(std::string("camera.perspective.") + key, std::string("/cameras/0/perspective/") + key, 1.1, "",
          seen);
  for (const char* key : {"znear", "zfar"})
    p.set(std::string("camera.perspective.") + key, std::string("/cameras/0/perspective/") + key, 3, "",
          seen);
  Square parallel;
  parallel.camera("orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.1}, {"zfar", 10}});
  for (const char* key : {"xmag", "ymag", "znear", "zfar"})
    p.set(std::string("camera.orthographic.") + key, std::string("/cameras/0/orthographic/") + key, 3, "",
          parallel);
  p.all.push_back({"binary (.glb)",
                   Square().attribute("POSITION", {0, 0, 0, 2, 0, 0, 1, 1, 0, 0, 1, 0}, 3).text(),
                   Square().glb()});
  std::string other = Square().data();
  other[16] = '\x10';
  const SceneProbes read(
      "probe.gltf",
      {{"probe.bin", Square().data()}, {"other.bin", other}, {"p.png", test::smallPng(0, 0, 255)}});
  expectProbes(knownGltfFields(), p.all, false, read);
}

// --- extensions --------------------------------------------------------------------------------------------

/// Compressed meshes; of what a mode or a filter packs, other values make another picture.
void addPacked(Probes& p) {
  const test::Patch patch, larger(6);
  const auto draco = [](const test::Patch& of) { return test::dracoPatch(of, test::dracoOf(of, true, 0)); };
  p.add("KHR_draco_mesh_compression", draco(larger), draco(patch));
  // With a second mesh, of one triangle.
  const auto besideATriangle = [](const Square& mesh) {
    Square both = mesh;
    both.set("/nodes/1", {{"mesh", 1}}).set("/scenes/0/nodes", {0, 1});
    const std::size_t points = both.root["accessors"].size();
    both.floats({0, 0, 0, 1, 0, 0, 1, 1, 0}, 3);
    both.set("/meshes/1", {{"primitives", {{{"attributes", {{"POSITION", points}}}}}}});
    return both;
  };
  test::Dracoed half = test::dracoOf(patch, true, 0);
  half.bytes.resize(half.bytes.size() / 2);
  p.add("KHR_draco_mesh_compression that is damaged", besideATriangle(draco(patch)),
        besideATriangle(test::dracoPatch(patch, half)), "it is left out");

  const auto meshopt = [](const test::Patch& of, const char* mode) {
    return test::meshoptPatch(of, mode, 2);
  };
  const std::string name = "EXT_meshopt_compression ";
  p.add(name + "mode ATTRIBUTES", meshopt(larger, "TRIANGLES"), meshopt(patch, "TRIANGLES"));
  test::Patch turned = patch;
  std::swap(turned.corners[0], turned.corners[1]);
  for (const char* mode : {"TRIANGLES", "INDICES"})
    p.add(name + "mode " + mode, meshopt(turned, mode), meshopt(patch, mode));
  /// A new view of the same values, with a filter, in place of that of the attribute.
  const auto filtered = [&](const char* attribute, const std::string& bytes, std::size_t stride,
                            const char* filter, json accessor) {
    Square square = meshopt(patch, "TRIANGLES");
    accessor["bufferView"] = test::addMeshoptView(square, test::meshoptVertices(bytes, stride), "ATTRIBUTES",
                                                  bytes.size() / stride, stride, filter);
    accessor["count"] = bytes.size() / stride;
    test::accessorOf(square, attribute).update(accessor);
    return test::withFallback(square);
  };
  const std::string octahedral(4 * patch.points(), '\x7f'), exponents(8 * patch.points(), '\1');
  const json bytes = {{"componentType", 5120}, {"normalized", true}, {"type", "VEC3"}};
  p.add(name + "filter OCTAHEDRAL", filtered("NORMAL", octahedral, 4, "NONE", bytes),
        filtered("NORMAL", octahedral, 4, "OCTAHEDRAL", bytes));
  p.add(name + "filter EXPONENTIAL", filtered("TEXCOORD_0", exponents, 8, "NONE", json::object()),
        filtered("TEXCOORD_0", exponents, 8, "EXPONENTIAL", json::object()));
  const auto copies = [&](const char* filter) {
    Square square;
    const float half = std::sqrt(0.5f), quarter[] = {0, 0, half, half};
    std::string turn(8, '\0');
    meshopt_encodeFilterQuat(turn.data(), 1, 8, 14, quarter);
    const std::size_t view =
        test::addMeshoptView(square, test::meshoptVertices(turn, 8), "ATTRIBUTES", 1, 8, filter);
    square.set("/accessors/4", {{"bufferView", view},
                                {"componentType", 5122},
                                {"normalized", true},
                                {"count", 1},
                                {"type", "VEC4"}});
    square.set("/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/ROTATION", 4);
    return test::withFallback(square);
  };
  p.add(name + "filter QUATERNION", copies("NONE"), copies("QUATERNION"));
  Square broken = meshopt(patch, "TRIANGLES");
  broken = besideATriangle(broken);
  test::withFallback(broken);
  Square cut = broken;
  const std::string view = test::accessorOf(cut, "POSITION")["bufferView"].dump();
  cut.set("/bufferViews/" + view + "/extensions/EXT_meshopt_compression/byteLength", 9);
  p.add(name + "that is damaged", broken, cut, "are left out");
}

TEST(Probes, OfGltfExtensions) {
  Probes p;
  const json texture = {{"index", 0}};
  const auto material = [](const std::string& extension, json values, Square square = {}) {
    square.root["extensionsUsed"].push_back(extension);
    return square.set("/materials/0/extensions/" + extension, std::move(values));
  };
  /// One field of an extension of the material more than in the square that has the rest.
  const auto field = [&](const std::string& extension, const std::string& key, json value, json rest,
                         const std::string& told = {}, Square square = {}) {
    p.set(extension + "." + key, "/materials/0/extensions/" + extension + "/" + key, std::move(value), told,
          material(extension, std::move(rest), std::move(square)));
  };

  const auto light = [](json values) {
    return with("/extensionsUsed", {"KHR_lights_punctual"})
        .set("/extensions/KHR_lights_punctual/lights", json::array({std::move(values)}))
        .set("/nodes/0/extensions/KHR_lights_punctual/light", 0);
  };
  const std::string lights = "/extensions/KHR_lights_punctual/lights/0/";
  const Square point = light({{"type", "point"}}), spot = light({{"type", "spot"}, {"spot", json::object()}});
  p.set("KHR_lights_punctual.color", lights + "color", {1, 0, 0}, "", point);
  p.set("KHR_lights_punctual.intensity", lights + "intensity", 3, "", point);
  p.set("KHR_lights_punctual.type", lights + "type", "directional", "", point);
  p.set("KHR_lights_punctual.range", lights + "range", 3, "range is ignored", point);
  p.set("KHR_lights_punctual.spot.innerConeAngle", lights + "spot/innerConeAngle", 0.3, "", spot);
  p.set("KHR_lights_punctual.spot.outerConeAngle", lights + "spot/outerConeAngle", 0.3, "", spot);

  const std::string transmission = "KHR_materials_transmission", volume = "KHR_materials_volume";
  const Square clear = material(transmission, {{"transmissionFactor", 1}},
                                with("/materials/0/pbrMetallicRoughness/metallicFactor", 0));
  const Square thick = material(volume, {{"thicknessFactor", 1}}, clear);
  field("KHR_materials_ior", "ior", 1.3, json::object(), "", thick);
  field(transmission, "transmissionFactor", 0.5, json::object());
  field(transmission, "transmissionTexture", texture, {{"transmissionFactor", 0.5}});
  field(volume, "thicknessFactor", 1, json::object(), "", clear);
  field(volume, "thicknessTexture", texture, {{"thicknessFactor", 1}}, "texture 0", clear);
  field(volume, "attenuationDistance", 2, {{"thicknessFactor", 1}, {"attenuationColor", {1, 0, 0}}}, "",
        clear);
  field(volume, "attenuationColor", {1, 0, 0}, {{"thicknessFactor", 1}, {"attenuationDistance", 2}}, "",
        clear);
  field("KHR_materials_dispersion", "dispersion", 0.5, json::object(), "", thick);

  const std::string film = "KHR_materials_iridescence";
  const json filmOn = {{"iridescenceFactor", 1}};
  field(film, "iridescenceFactor", 1, json::object());
  field(film, "iridescenceTexture", texture, filmOn);
  field(film, "iridescenceIor", 1.5, filmOn);
  field(film, "iridescenceThicknessMinimum", 50,
        {{"iridescenceFactor", 1}, {"iridescenceThicknessTexture", texture}});
  field(film, "iridescenceThicknessMaximum", 500, filmOn);
  field(film, "iridescenceThicknessTexture", texture, filmOn);
  field("KHR_materials_emissive_strength", "emissiveStrength", 3, json::object(), "",
        with("/materials/0/emissiveFactor", {1, 0, 0}));

  const std::string coat = "KHR_materials_clearcoat", sheen = "KHR_materials_sheen";
  const json coatOn = {{"clearcoatFactor", 1}, {"clearcoatRoughnessFactor", 0.5}},
             sheenOn = {{"sheenColorFactor", {1, 0, 0}}, {"sheenRoughnessFactor", 0.5}};
  field(coat, "clearcoatFactor", 1, json::object());
  field(coat, "clearcoatTexture", texture, coatOn);
  field(coat, "clearcoatRoughnessFactor", 0.2, coatOn);
  field(coat, "clearcoatRoughnessTexture", texture, coatOn);
  field(coat, "clearcoatNormalTexture", texture, coatOn);
  field(sheen, "sheenColorFactor", {0, 1, 0}, json::object());
  field(sheen, "sheenColorTexture", texture, sheenOn);
  field(sheen, "sheenRoughnessFactor", 0.2, sheenOn);
  field(sheen, "sheenRoughnessTexture", texture, sheenOn);
  field("KHR_materials_anisotropy", "anisotropyStrength", 0.5, json::object());
  field("KHR_materials_anisotropy", "anisotropyRotation", 0.5, {{"anisotropyStrength", 0.5}});
  field("KHR_materials_anisotropy", "anisotropyTexture", texture, {{"anisotropyStrength", 0.5}}, "texture 0");
  field("KHR_materials_specular", "specularFactor", 0.5, json::object());
  field("KHR_materials_specular", "specularTexture", texture, {{"specularFactor", 0.5}});
  field("KHR_materials_specular", "specularColorFactor", {1, 0, 0}, json::object());
  field("KHR_materials_specular", "specularColorTexture", texture, {{"specularFactor", 0.5}});
  p.add("KHR_materials_unlit", Square(), material("KHR_materials_unlit", json::object()));

  const std::string glossy = "KHR_materials_pbrSpecularGlossiness";
  field(glossy, "diffuseFactor", {1, 0, 0, 1}, json::object());
  field(glossy, "diffuseTexture", texture, json::object());
  field(glossy, "specularFactor", {1, 0, 0}, json::object());
  field(glossy, "glossinessFactor", 0.2, json::object());
  field(glossy, "specularGlossinessTexture", texture, json::object());

  Square quantised = with("/extensionsUsed", {"KHR_mesh_quantization"})
                         .set("/extensionsRequired", {"KHR_mesh_quantization"});
  quantised.primitive()["attributes"]["POSITION"] =
      quantised.bytes(std::string("\0\0\0\0\2\0\0\0\2\2\0\0\0\2\0\0", 16), 5121, 4, "VEC3");
  quantised.root["bufferViews"][4]["byteStride"] = 4;
  p.add("KHR_mesh_quantization", Square(), quantised);
  const std::string base = "/materials/0/pbrMetallicRoughness/baseColorTexture";
  const Square textured = with(base, texture).set("/extensionsUsed", {"KHR_texture_transform"});
  const std::string moved = base + "/extensions/KHR_texture_transform/";
  p.set("KHR_texture_transform.offset", moved + "offset", {0.5, 0}, "", textured);
  p.set("KHR_texture_transform.rotation", moved + "rotation", 0.5, "", textured);
  p.set("KHR_texture_transform.scale", moved + "scale", {2, 2}, "", textured);
  p.set("KHR_texture_transform.texCoord", moved + "texCoord", 1, "",
        Square(textured).attribute("TEXCOORD_1", {0, 0, 2, 0, 2, 2, 0, 2}, 2));

  // A picture that nothing else names: the magenta checker and a warning.
  for (const char* other : {"KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"}) {
    Square square = textured;
    square.set("/images/0/uri", "data:image/ktx2;base64,AAAA")
        .set("/textures/0", {{"extensions", {{other, {{"source", 0}}}}}});
    square.root["extensionsUsed"].push_back(other);
    p.add(other, textured, square, "images[0]");
  }
  // One that the texture names beside a picture that every program reads.
  Raster green(2, 2, 3, 255);
  green.samples = std::vector<std::uint8_t>{0, 255, 0, 0, 255, 0, 0, 255, 0, 0, 255, 0};
  Square webp = textured;
  webp.set("/images/2", {{"uri", "data:image/webp;base64," + toBase64(test::webpOf(green))}})
      .set("/extensionsRequired", {"EXT_texture_webp"});
  p.set("EXT_texture_webp", "/textures/0/extensions", {{"EXT_texture_webp", {{"source", 2}}}}, "", webp);

  addPacked(p);
  Square copied;
  copied.set("/extensionsUsed", {"EXT_mesh_gpu_instancing"});
  const std::string copies = "/nodes/0/extensions/EXT_mesh_gpu_instancing/attributes/";
  const int steps = copied.floats({0, 0, 0, 2, 0, 0}, 3), turns = copied.floats({0, 0, 1, 0, 0, 1, 0, 0}, 4);
  p.set("EXT_mesh_gpu_instancing.TRANSLATION", copies + "TRANSLATION", steps, "", copied);
  p.set("EXT_mesh_gpu_instancing.ROTATION", copies + "ROTATION", turns, "", copied);
  const Square apart = Square(copied).set(copies + "TRANSLATION", steps);
  const int sizes = copied.floats({1, 1, 1, 2, 2, 2}, 3);
  p.add("EXT_mesh_gpu_instancing.SCALE", apart,
        Square(copied).set(copies + "TRANSLATION", steps).set(copies + "SCALE", sizes));
  for (const char* name :
       {"KHR_materials_variants", "KHR_materials_diffuse_transmission", "KHR_node_visibility",
        "KHR_animation_pointer", "KHR_xmp_json_ld", "EXT_lights_image_based", "MSFT_lod"})
    p.set(name, "/extensionsUsed", {name}, name);
  expectProbes(knownGltfExtensionFields(), p.all, false, SceneProbes("probe.gltf"));
}

TEST(GltfTangents, AreThoseOfTheFileForNormalMaps) {
  Square square;
  square.attribute("TANGENT", {1, 0, 0, -1, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 4);
  const auto read = [](const Square& from, Messages& messages) {
    const Scene scene = readScene("a.gltf", from.text(), messages);
    return scene.objects.at(0).shape.as<Mesh>()->data->tangents;
  };
  Messages messages;
  EXPECT_TRUE(read(square, messages).empty()) << "nothing uses them";
  square.material()["normalTexture"] = {{"index", 0}};
  const auto tangents = read(square, messages);
  ASSERT_EQ(tangents.size(), 4u);
  EXPECT_EQ(tangents[0], (MeshTangent{{1, 0, 0}, -1}));
  EXPECT_EQ(tangents[1], (MeshTangent{{0, 1, 0}, 1}));
  EXPECT_TRUE(messages.all().empty());
  square.primitive()["attributes"].erase("NORMAL");
  EXPECT_TRUE(read(square, messages).empty()) << "the specification lets them be ignored";
  ASSERT_EQ(messages.all().size(), 1u);
  EXPECT_EQ(
      messages.all()[0].what,
      "meshes have TANGENT but no NORMAL; their tangents are ignored: 1, first at meshes[0].primitives[0]");
}

}  // namespace
}  // namespace trace::probes_gltf_test

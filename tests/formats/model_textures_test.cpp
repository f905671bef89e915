// What the textures of other models than glTF become: exact texels, by the texture coordinates of their
// meshes.
#include "formats/model_textures.h"

#include <filesystem>

#include "model_texture_helpers.h"
#include "shading/materials/principled.h"
#include "shading/materials/rough_glass.h"
#include "shading/textures/image_map.h"
#include "support/webp.h"

namespace trace::model_textures_test {
namespace {

using namespace test;

// --- OBJ ----------------------------------------------------------------------------------------------

struct ObjTextures : testing::Test {
  test::Folder folder;
  Read read(const std::string& mtl, const std::string& picture_ = picture()) {
    writeFile(folder / "a.tga", picture_);
    writeFile(folder / "a.mtl", "newmtl m\n" + mtl + "\n");
    return {folder / "a.obj",
            "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\n"
            "f 1/1 2/2 3/3\n"};
  }
};

TEST_F(ObjTextures, PicturesStandUprightAndAreScaledByTheirConstant) {
  const Read plain = read("map_Kd a.tga");
  EXPECT_EQ(plain.warnings(), "");
  expectUpright(plain, "diffuse");
  EXPECT_EQ(plain.phongAt(kTopLeft).diffuse, kRed) << "white without Kd";
  EXPECT_EQ(read("map_Kd a.tga\nKd 0.5 0.5 0.5").phongAt(kTopLeft).diffuse, kRed * 0.5);
  EXPECT_EQ(read("Kd 0.5\nmap_Kd a.tga").phongAt(kTopLeft).diffuse, kRed * 0.5);
  EXPECT_EQ(read("map_Ke a.tga\nmap_Ks a.tga\nillum 3").phongAt(kTopRight).reflective, kGreen);
  EXPECT_EQ(read("Ka 1 1 1\nmap_Kd a.tga").phongAt(kTopRight).ambient, kGreen) << "paint in any light";
}

TEST_F(ObjTextures, OptionsPlaceThePicture) {
  EXPECT_EQ(read("map_Kd -s 2 2 a.tga").at("diffuse", {0.375, 0.375}), kGreen);
  EXPECT_EQ(read("map_Kd -o 0.5 a.tga").at("diffuse", kTopLeft), kGreen);
  EXPECT_EQ(read("map_Kd -o 0 0.5 0 -s 1 1 1 a.tga").at("diffuse", kTopLeft), kBlue);
  EXPECT_EQ(read("map_Kd -clamp on a.tga").at("diffuse", {1.25, 0.75}), kGreen);
  EXPECT_EQ(read("map_Ks -imfchan g a.tga").at("specular", kTopRight), kWhite);
  EXPECT_NE(read("map_Kd -mm 0 2 a.tga").warnings().find("the option \"-mm\" of a texture is ignored"),
            std::string::npos);
}

TEST_F(ObjTextures, BumpsAreHeightsByTheModelsSize) {
  const Read heights = read("map_Bump -bm 2 a.tga");
  EXPECT_EQ(heights.warnings(), "");
  EXPECT_EQ(heights.texture("bump")->model.as<ImageMap>()->relief, Relief::heights);
  EXPECT_NEAR(heights.material().bump, 2.0 / 200, 1e-7) << "of a triangle with sides of 1";
  EXPECT_NEAR(read("bump a.tga").material().bump, 1.0 / 200, 1e-7);
  const Read normals = read("bump a.tga\nnorm a.tga");
  EXPECT_EQ(normals.texture("bump")->model.as<ImageMap>()->relief, Relief::normals);
  EXPECT_EQ(normals.material().bump, 1);
}

TEST_F(ObjTextures, DisplacementIsHeightsUnlessOthersAreGiven) {
  for (const char* statement : {"disp", "map_disp", "map_Disp"}) {
    const Read alone = read(std::string(statement) + " -bm 3 a.tga");
    EXPECT_EQ(alone.warnings(), "") << statement;
    EXPECT_EQ(alone.texture("bump")->model.as<ImageMap>()->relief, Relief::heights);
    EXPECT_NEAR(alone.material().bump, 3.0 / 200, 1e-7);
  }
  for (const char* other : {"bump", "norm"}) {
    const Read both = read(std::string(other) + " a.tga\ndisp b.tga");
    EXPECT_NE(both.warnings().find("the texture \"b.tga\" of disp is not rendered yet"), std::string::npos)
        << other;
    EXPECT_EQ(both.texture("bump")->model.as<ImageMap>()->file.file.find("a.tga"), 0u);
  }
}

TEST_F(ObjTextures, OnePictureIsNamedForEachKeyword) {
  EXPECT_NE(
      read("map_Tr a.tga\nrefl a.tga\ndecal a.tga\nrefl a.tga")
          .warnings()
          .find(
              "the textures \"a.tga\" of map_Tr, \"a.tga\" of refl and \"a.tga\" of decal are not rendered"),
      std::string::npos);
  const Read both = read("norm a.tga\nmap_Bump a.tga");
  EXPECT_EQ(both.warnings(), "the texture \"a.tga\" of map_Bump is not rendered yet\n");
  EXPECT_EQ(both.messages.all().at(0).place.line, 3);
}

TEST_F(ObjTextures, NamesOfOtherMachines) {
  expectUpright(read("map_Kd C:\\Users\\somebody\\maps\\a.tga"), "diffuse");
  expectUpright(read("map_Kd .\\a.tga"), "diffuse");
  expectUpright(read("map_Kd /home/somebody/a.tga"), "diffuse");
  EXPECT_NE(read("map_Kd maps\\gone.tga").warnings().find("cannot be read"), std::string::npos);
  if (!std::filesystem::path("C:\\gone.tga").is_absolute()) {  // elsewhere the scene may not look there
    EXPECT_NE(read("map_Kd C:\\gone.tga").warnings().find("cannot be read"), std::string::npos);
  }
}

TEST_F(ObjTextures, TransparencyCutsHoles) {
  const Read byAlpha = read("map_Kd a.tga", picture(true));
  EXPECT_EQ(byAlpha.opacityAt(kTopLeft), 1);
  EXPECT_EQ(byAlpha.opacityAt(kTopRight), 0);
  EXPECT_NEAR(byAlpha.opacityAt(kBottomRight), 0.2, 1e-9);
  EXPECT_EQ(byAlpha.phongAt(kBottomRight).diffuse, kWhite) << "a hole takes nothing from the colours";
  const Read byMap = read("Kd 1 1 1\nmap_d a.tga");
  EXPECT_NEAR(byMap.opacityAt(kTopLeft), luminance(kRed), 1e-9);
  EXPECT_EQ(byMap.opacityAt(kBottomRight), 1);
  EXPECT_EQ(read("map_Kd a.tga").material().textures.size(), 1u) << "an opaque picture makes none";
}

TEST_F(ObjTextures, PhysicalMaterialsArePrincipled) {
  const Read numbers =
      read("Kd 0.5 0.4 0.3\nPr 0.25\nPm 1\nPs 0.5\nPc 0.75\nPcr 0.125\naniso 0.5\nanisor 0.25\nd 0.5");
  EXPECT_EQ(numbers.warnings(), "");
  const auto& model = *numbers.material().model.as<Principled>();
  EXPECT_EQ(model.color, Color(Real(0.5f), Real(0.4f), Real(0.3f)));
  EXPECT_EQ(model.roughness, 0.25);
  EXPECT_EQ(model.metallic, 1);
  EXPECT_EQ(model.sheen, Color(0.5));
  EXPECT_EQ(model.clearcoat, 0.75);
  EXPECT_EQ(model.clearcoatRoughness, 0.125);
  EXPECT_EQ(model.anisotropy, 0.5);
  EXPECT_EQ(model.angle, 90);
  EXPECT_EQ(numbers.material().opacity, 0.5);
  const Read maps = read("map_Kd a.tga\nmap_Pr a.tga\nmap_Pm -imfchan b a.tga", picture(true));
  EXPECT_EQ(maps.warnings(), "");
  expectUpright(maps, "color");
  EXPECT_EQ(maps.material().model.as<Principled>()->roughness, 1) << "where only the picture says it";
  expectUpright(maps, "roughness");
  EXPECT_EQ(maps.at("metallic", kBottomLeft), Color(1));
  EXPECT_EQ(maps.at("opacity", kTopRight), Color(0)) << "its alpha";
  EXPECT_NE(read("Pr 3").warnings().find("Pr: expected 0 to 1"), std::string::npos);
  EXPECT_NE(
      read("Pr 0.3\nmap_Ns a.tga").warnings().find("the texture \"a.tga\" of map_Ns is not rendered yet"),
      std::string::npos)
      << "it has a roughness, and no exponent";
  EXPECT_EQ(read("Ns 30\nmap_Ns a.tga").warnings(), "");
  const Read pane = read("illum 6\nTf 1 0.5 1\nNi 1.45\nPr 0.25");
  const auto& glass = *pane.material().model.as<RoughGlass>();
  EXPECT_EQ(glass.color, Color(1, 0.5, 1)) << "what says glass is not lost beside a roughness";
  EXPECT_EQ(glass.index, Real(1.45f));
  EXPECT_EQ(glass.roughness, 0.25);
  EXPECT_TRUE(read("illum 6\nTf 1 1 1\nPr 0.25\nPm 1").material().model.is<Principled>());
}

// --- PLY ----------------------------------------------------------------------------------------------

TEST(PlyTextures, AreSeen) {
  const test::Folder folder;
  writeFile(folder / "a.tga", picture());
  const auto file = [](const std::string& uv) {
    return "ply\nformat ascii 1.0\ncomment TextureFile a.tga\nelement vertex 3\nproperty float x\nproperty "
           "float "
           "y\nproperty float z\nproperty float " +
           uv +
           "\nproperty float t\nelement face 1\nproperty list uchar "
           "int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n";
  };
  const Read read(folder / "a.ply", file("s"));
  EXPECT_EQ(read.warnings(), "");
  expectUpright(read, "diffuse");
  EXPECT_NE(Read(folder / "b.ply", file("q")).warnings().find("not rendered"), std::string::npos)
      << "without texture coordinates";
}

// --- Inventor and VRML --------------------------------------------------------------------------------

const std::string kVrml = "#VRML V2.0 utf8\n", kOld = "#Inventor V2.1 ascii\n";
/// As in a file, from the bottom left: blue, white; red, green.
const std::string kImage = "image 2 2 3 0x0000FF 0xFFFFFF 0xFF0000 0x00FF00 ";

std::string shape(const std::string& texture, const std::string& geometry = "Sphere { }",
                  const std::string& material = "Material { diffuseColor 0.5 0.5 0.5 }") {
  return kVrml + "Shape { appearance Appearance { material " + material + " " + texture + " } geometry " +
         geometry + " }\n";
}

TEST(VrmlTextures, PixelsStandUpright) {
  const Read read("a.wrl", shape("texture PixelTexture { " + kImage + "}"));
  EXPECT_EQ(read.warnings(), "");
  expectUpright(read, "diffuse");
  EXPECT_EQ(read.phongAt(kTopLeft).diffuse, kRed) << "a coloured picture takes the place of the colour";
  const Read grey("a.wrl", shape("texture PixelTexture { image 1 2 2 0x80FF 0xFF00 }"));
  EXPECT_NEAR(grey.phongAt({0.5, 0.25}).diffuse.r, 0.5 * 128 / 255, 1e-9) << "a grey one is multiplied";
  EXPECT_EQ(grey.opacityAt({0.5, 0.75}), 0) << "its alpha cuts holes";
  EXPECT_EQ(Read("a.wrl", shape("texture PixelTexture { " + kImage + " repeatS FALSE }"))
                .at("diffuse", {1.25, 0.75}),
            kGreen);
  const Read unlit("a.wrl", kVrml + "Shape { appearance Appearance { texture PixelTexture { " + kImage +
                                "} } geometry Sphere { } }");
  expectUpright(unlit, "emissive");
  const Read broken("a.wrl", shape("texture PixelTexture { image 20000 20000 3 1 2 }"));
  EXPECT_NE(broken.warnings().find("image of PixelTexture: expected"), std::string::npos);
}

TEST(VrmlTextures, TransformsAreThoseOfTheSpecifications) {
  const auto at = [](const std::string& transform, const Vec2& uv) {
    return Read("a.wrl", shape("texture PixelTexture { " + kImage + "} textureTransform TextureTransform { " +
                               transform + " }"))
        .at("diffuse", uv);
  };
  EXPECT_EQ(at("translation 0.5 0", kTopLeft), kGreen);
  EXPECT_EQ(at("scale 2 2", {0.375, 0.375}), kGreen);
  EXPECT_EQ(at("rotation 1.5707963267948966", kBottomLeft), kWhite) << "(0.25, 0.25) becomes (-0.25, 0.25)";
  EXPECT_EQ(at("center 0.5 0.5 scale 2 1", {0.125, 0.25}), kWhite) << "2 (0.125 + 0.5) - 0.5 = 0.75";
  const auto old = [](const std::string& transforms, const Vec2& uv) {
    return Read("a.iv", kOld + "Texture2 { " + kImage + "} " + transforms + " Sphere { }").at("diffuse", uv);
  };
  EXPECT_EQ(old("Texture2Transform { translation 0.5 0 }", kTopLeft), kGreen);
  EXPECT_EQ(old("Texture2Transform { translation 0.5 0 } Texture2Transform { translation 0 0.5 }", kTopLeft),
            kWhite)
      << "they add up";
  const Color turned = old("Texture2Transform { center 0.5 0.5 rotation 3.141592653589793 }", kTopLeft);
  EXPECT_NEAR(min(turned.r, min(turned.g, turned.b)), 1, 1e-12) << "about the centre";
}

TEST(VrmlTextures, ModelsOfInventor) {
  const auto with = [](const std::string& model) {
    return Read("a.iv", kOld + "Material { diffuseColor 0.5 0.5 0.5 specularColor 1 1 1 } Texture2 { " +
                            kImage + model + " } Sphere { }");
  };
  EXPECT_EQ(with("").phongAt(kTopLeft).diffuse, kRed * 0.5) << "multiplied";
  const Phong decal = with("model DECAL").phongAt(kTopLeft);
  EXPECT_EQ(decal.emissive, kRed);
  EXPECT_TRUE(isBlack(decal.diffuse) && isBlack(decal.specular));
  const Phong blend = with("model BLEND blendColor 1 1 0").phongAt(kBottomRight);
  EXPECT_EQ(blend.emissive, Color(1, 1, 0));
  EXPECT_TRUE(isBlack(blend.diffuse));
  EXPECT_EQ(with("wrapS CLAMP").at("diffuse", {1.25, 0.75}), kGreen);
}

/// Where on the mesh the texture coordinates are (u, v), on a face that looks along `normal`.
Vec3 pointOf(const MeshData& mesh, const Vec2& uv, const Vec3& normal) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t corner : mesh.triangles[t])
      if (mesh.uvs[corner] == uv && dot(faceNormal(mesh, t), normal) > 0)
        return {mesh.points[corner].x, mesh.points[corner].y, mesh.points[corner].z};
  return {99, 99, 99};
}

TEST(VrmlTextures, BoxesHaveAPictureOnEachSide) {
  const Read read("a.wrl", shape("texture PixelTexture { " + kImage + "}", "Box { size 2 4 6 }"));
  const MeshData& box = read.mesh();
  EXPECT_EQ(box.triangles.size(), 12u);
  EXPECT_EQ(pointOf(box, {0, 0}, {0, 0, 1}), (Vec3{-1, -2, 3})) << "front";
  EXPECT_EQ(pointOf(box, {1, 0}, {0, 0, -1}), (Vec3{-1, -2, -3})) << "back";
  EXPECT_EQ(pointOf(box, {1, 0}, {1, 0, 0}), (Vec3{1, -2, -3})) << "right";
  EXPECT_EQ(pointOf(box, {1, 1}, {-1, 0, 0}), (Vec3{-1, 2, 3})) << "left";
  EXPECT_EQ(pointOf(box, {0, 0}, {0, 1, 0}), (Vec3{-1, 2, 3})) << "top, tilted to the eye";
  EXPECT_EQ(pointOf(box, {0, 1}, {0, -1, 0}), (Vec3{-1, -2, 3})) << "bottom";
  EXPECT_FALSE(Read("a.wrl", shape("", "Box { }")).scene.objects.at(0).shape.as<Mesh>())
      << "others stay boxes";
}

TEST(VrmlTextures, FacesWithoutCoordinatesTakeThemFromTheirBox) {
  const Read read("a.wrl", shape("texture PixelTexture { " + kImage + "}",
                                 "IndexedFaceSet { coord Coordinate { point [ 1 0 0, 1 2 0, 1 2 4, 1 0 4 ] } "
                                 "coordIndex [ 0 1 2 3 -1 ] }"));
  EXPECT_EQ(read.mesh().uvs, (std::vector<Vec2>{{0, 0}, {0, 0.5}, {1, 0.5}, {1, 0}}));
}

TEST(VrmlTextures, FilesOfAListAndMissingOnes) {
  const test::Folder folder;
  writeFile(folder / "a.tga", picture());
  const Read read(folder / "a.wrl",
                  shape("texture ImageTexture { url [ \"gone.tga\", \"maps\\\\a.tga\" ] }"));
  expectUpright(read, "diffuse");
  const Read gone(folder / "b.wrl", shape("texture ImageTexture { url \"gone.tga\" }"));
  ASSERT_EQ(gone.messages.all().size(), 1u);
  EXPECT_EQ(gone.messages.all()[0].place.line, 2) << "where the file names it";
}

// --- heads of pictures --------------------------------------------------------------------------------

TEST(PictureKinds, FollowFromTheHead) {
  EXPECT_TRUE(kindOfPicture(picture(true)).transparent);
  EXPECT_FALSE(kindOfPicture(picture()).transparent);
  const std::string png =
      std::string("\x89PNG\r\n\x1a\n", 8) + std::string("\0\0\0\rIHDR", 8) + std::string(8, '\1');
  EXPECT_TRUE(kindOfPicture(png + std::string("\x8\x6\0\0\0", 5) + "crc.").transparent);
  EXPECT_FALSE(kindOfPicture(png + std::string("\x8\0\0\0\0", 5) + "crc.").colored);
  const std::string chunk("\0\0\0\1tRNSxcrc.", 13);
  EXPECT_TRUE(kindOfPicture(png + std::string("\x8\x3\0\0\0", 5) + "crc." + chunk).transparent);
  for (std::size_t length : {0, 3, 17})
    EXPECT_FALSE(kindOfPicture(picture(true).substr(0, length)).transparent);
  for (const bool lossless : {true, false})
    for (const int channels : {3, 4}) {
      Raster raster(2, 2, channels, 255);
      raster.samples = std::vector<std::uint8_t>(raster.count(), 100);
      EXPECT_EQ(kindOfPicture(test::webpOf(raster, lossless)).transparent, channels == 4);
    }
}

}  // namespace
}  // namespace trace::model_textures_test

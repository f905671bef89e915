// Scenes of British Columbia from 2010 to 2013: blocks of numbers in a fixed order, objects in world space.
//
// Reflection blends there, (1 - reflect) own colour + reflect mirrored: the weight goes into the material.
#include <map>

#include "formats/tokens.h"
#include "formats/ubc/ubc_format.h"
#include "formats/ubc/ubc_scene.h"
#include "geometry/shapes/solids/plane.h"
#include "geometry/shapes/solids/sphere.h"
#include "math/perpendicular.h"

namespace trace::ubc {
namespace {

class OldReader {
 public:
  OldReader(const std::string& file, std::string_view bytes, Messages& messages)
      : tokens_(file, bytes, {.marks = "", .comment = '#'}), messages_(messages) {
    scene_.file = file;
    scene_.format = "ubc";
  }

  Scene read() {
    int width = 640, height = 480;
    View view;
    SourcePlace viewPlace{scene_.file, 0, 0, {}};
    while (!tokens_.atEnd()) {
      const Token name = tokens_.word("scene");
      if (name.text == "Resolution") {
        width = pixels();
        height = pixels();
      } else if (name.text == "Camera") {
        viewPlace = tokens_.place(name);
        view.eye = vector("Camera");
        view.center = vector("Camera");
        view.up = vector("Camera");
        view.fovy = tokens_.number("Camera");
        view.aspect = tokens_.number("Camera");
        view.near = tokens_.number("Camera");
        view.far = tokens_.number("Camera");
      } else if (name.text == "Material") {
        material();
      } else if (name.text == "Sphere") {
        sphere(name);
      } else if (name.text == "Plane") {
        plane(name);
      } else if (name.text == "PointLight") {
        const Vec3 position = vector("PointLight");
        const Color ambient = color("PointLight"), diffuse = color("PointLight");
        const Color specular = color("PointLight");
        addLamp(scene_, {position, ambient, diffuse, specular, vector("PointLight")}, tokens_.place(name));
      } else {
        tokens_.fail(name, "expected Resolution, Camera, Material, Sphere, Plane or PointLight, found " +
                               describe(name));
      }
    }
    warnings_.report(messages_);
    warnOfNothing(scene_, view, viewPlace, messages_);
    scene_.camera = ubc::camera(view, viewPlace);
    addChoices(scene_, width, height, view);
    return std::move(scene_);
  }

 private:
  int pixels() {
    const Token token = tokens_.peek();
    const double n = tokens_.number("Resolution");
    if (!(n >= 1 && n <= 100000)) tokens_.fail(token, "Resolution: expected 1 to 100000 pixels");
    return static_cast<int>(n);
  }
  Vec3 vector(std::string_view what) {
    const double x = tokens_.number(what), y = tokens_.number(what);
    return {x, y, tokens_.number(what)};
  }
  Color color(std::string_view what) {
    const Vec3 v = vector(what);
    return {v.x, v.y, v.z};
  }
  /// Materials have numbers or words for names.
  std::string id(std::string_view what) {
    if (!tokens_.peek().is(Token::Kind::number) && !tokens_.peek().is(Token::Kind::word))
      tokens_.expected(what, "the name of a material");
    return std::string(tokens_.next().text);
  }

  void material() {
    const SourcePlace place = tokens_.place(tokens_.peek());
    const std::string name = id("Material");
    Surface s;
    s.ambient = color("Material");
    s.diffuse = color("Material");
    s.specular = color("Material");
    s.emission = color("Material");
    s.shininess = tokens_.number("Material");
    s.shadow = tokens_.number("Material");
    s.reflect = tokens_.number("Material");
    for (Color* own : {&s.ambient, &s.diffuse, &s.specular, &s.emission}) *own *= Color(1 - s.reflect);
    materials_.insert_or_assign(name, static_cast<std::uint32_t>(scene_.materials.size()));
    scene_.materials.push_back({name, phong(s), {}});
    warnOfRanges(scene_.materials.back(), place, warnings_);
  }

  std::uint32_t materialNamed() {
    const Token token = tokens_.peek();
    const auto found = materials_.find(id("object"));
    if (found == materials_.end())
      tokens_.fail(token, "expected the name of a material, found " + describe(token));
    return found->second;
  }

  void sphere(const Token& token) {
    const Real radius = std::abs(tokens_.number("Sphere"));
    const Vec3 center = vector("Sphere");
    add(token, Sphere{}, Affine::translation(center) * Affine::scaling({radius, radius, radius}));
  }

  /// a x + b y + c z + d = 0.
  void plane(const Token& token) {
    const Vec3 n = vector("Plane");
    const Real d = tokens_.number("Plane"), l = length(n);
    if (!(l > 0)) tokens_.fail(token, "Plane: expected a normal that is not zero");
    const Vec3 up = n / l, side = perpendicularTo(-up);
    const Vec3 other = cross(up, side);
    Affine m = Affine::translation(up * (-d / l));
    for (int i = 0; i < 3; ++i) m.row[i] = {side[i], other[i], up[i]};
    add(token, Plane{}, m);
  }

  void add(const Token& token, Shape shape, const Affine& worldFromObject) {
    const std::uint32_t material = materialNamed();
    if (!invertible(worldFromObject))
      return messages_.warn(tokens_.place(token), "an object without size is left out");
    scene_.objects.push_back({"", std::move(shape), worldFromObject, material, tokens_.place(token)});
  }

  Tokens tokens_;
  Messages& messages_;
  Scene scene_;
  WarningsByKind warnings_;
  std::map<std::string, std::uint32_t, std::less<>> materials_;
};

}  // namespace

Scene readOld(const std::string& file, std::string_view bytes, Messages& messages) {
  return OldReader(file, bytes, messages).read();
}

}  // namespace trace::ubc

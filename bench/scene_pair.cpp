#include "scene_pair.h"

#include <ostream>
#include <sstream>

#include "base/error.h"

namespace trace::bench {
namespace {

constexpr int kShininess = 40;
constexpr int kDigits = 9;  // digits of every float

std::ostream& operator<<(std::ostream& out, const Vec3& v) { return out << v.x << ',' << v.y << ',' << v.z; }

std::string rayMaterial(const Look& look) {
  std::ostringstream out;
  out << "material={ diffuse=(" << (look.through > 0 ? Vec3{} : look.color) << "); ";
  if (look.phong > 0)
    out << "specular=(" << Vec3{1, 1, 1} * look.phong << "); shininess=" << kShininess << "; ";
  out << "reflective=(" << Vec3{1, 1, 1} * look.mirror << "); ";
  if (look.through > 0)
    out << "transmissive=(" << Vec3{1, 1, 1} * look.through << "); index=" << look.index << "; ";
  out << '}';
  return out.str();
}

std::string povTexture(const Look& look) {
  std::ostringstream out;
  if (look.through > 0)
    out << "texture { pigment { rgbt <0,0,0," << look.through << "> } ";
  else
    out << "texture { pigment { rgb <" << look.color << "> } ";
  out << "finish { ambient 0 diffuse 1 phong " << look.phong << " phong_size " << kShininess << " reflection "
      << look.mirror << " } }";
  if (look.through > 0) out << " interior { ior " << look.index << " }";
  return out.str();
}

/// "OPEN a CLOSE,OPEN b CLOSE,..." in lines of a bearable length.
template <class Range, class Print>
void list(std::ostream& out, const Range& range, char open, char close, Print&& print) {
  std::size_t i = 0;
  for (const auto& value : range) {
    if (i > 0) out << (i % 4 ? "," : ",\n");
    out << open;
    print(value);
    out << close;
    ++i;
  }
}

}  // namespace

ScenePair::ScenePair(const std::string& base) : base_(base), ray_(base + ".ray"), pov_(base + ".pov") {
  ray_.precision(kDigits), pov_.precision(kDigits);
  ray_ << "SBT-raytracer 1.0\n";
  pov_ << "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 5 adc_bailout 0 }\n";
}

void ScenePair::finish() {
  if (!ray_.flush() || !pov_.flush()) throw Error(Fault::io, "could not write " + base_ + ".ray and .pov");
}

void ScenePair::camera(const View& view) {
  const Vec3 forward = view.forward();
  pov_.precision(17);  // POV-Ray warns of axes that are not perpendicular to the last digit
  ray_ << "camera { position=(" << view.eye << "); viewdir=(" << forward << "); updir=("
       << normalize(view.up()) << "); fov=" << view.fov << "; }\n";
  pov_ << "camera { location <" << view.eye << "> right <" << view.right() << "> up <" << view.up()
       << "> direction <" << forward / 2 << "> }\n";  // right and up are half the picture's size
  pov_.precision(kDigits);
}

void ScenePair::lamp(const Vec3& position, double brightness) {
  const Vec3 color = Vec3{1, 1, 1} * brightness;
  ray_ << "point_light { position=(" << position << "); color=(" << color
       << "); constant_attenuation_coeff=1; linear_attenuation_coeff=0; quadratic_attenuation_coeff=0; }\n";
  pov_ << "light_source { <" << position << "> rgb <" << color << "> }\n";
}

void ScenePair::sphere(const Vec3& center, double radius, const Look& look) {
  ray_ << "translate(" << center << ", scale(" << radius << ", sphere { " << rayMaterial(look) << " }))\n";
  pov_ << "sphere { <" << center << ">, " << radius << ' ' << povTexture(look) << " }\n";
}

void ScenePair::box(const Vec3& low, const Vec3& high, const Look& look) {
  ray_ << "translate(" << (low + high) / 2 << ", scale(" << high - low << ", box { " << rayMaterial(look)
       << " }))\n";
  pov_ << "box { <" << low << ">, <" << high << "> " << povTexture(look) << " }\n";
}

void ScenePair::cone(const Vec3& base, double height, double bottomRadius, double topRadius,
                     const Look& look) {
  ray_ << "translate(" << base << ", rotate(1,0,0,-1.57079632679, cone { height=" << height
       << "; bottom_radius=" << bottomRadius << "; top_radius=" << topRadius << "; " << rayMaterial(look)
       << " }))\n";
  pov_ << "cone { <" << base << ">, " << bottomRadius << ", <" << base + Vec3{0, height, 0} << ">, "
       << topRadius << ' ' << povTexture(look) << " }\n";
}

void ScenePair::mesh(const MeshData& data, const Look& look) {
  const auto corners = [](std::ostream& out) {
    return [&out](const Triangle& t) { out << t[0] << ',' << t[1] << ',' << t[2]; };
  };
  const auto point = [](std::ostream& out) { return [&out](const Vec3f& p) { out << Vec3(p); }; };
  ray_ << "polymesh { " << rayMaterial(look) << "\npoints=(";
  list(ray_, data.points, '(', ')', point(ray_));
  ray_ << ");\nfaces=(";
  list(ray_, data.triangles, '(', ')', corners(ray_));
  ray_ << "); }\n";
  pov_ << "mesh2 { vertex_vectors { " << data.points.size() << ",\n";
  list(pov_, data.points, '<', '>', point(pov_));
  pov_ << " }\nface_indices { " << data.triangles.size() << ",\n";
  list(pov_, data.triangles, '<', '>', corners(pov_));
  pov_ << " }\n" << povTexture(look) << " }\n";
}

}  // namespace trace::bench

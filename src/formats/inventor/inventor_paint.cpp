#include "formats/inventor/inventor_paint.h"

namespace trace::inventor {
namespace {

template <class T>
T pick(const std::vector<T>& list, std::size_t i, const T& otherwise) {
  return list.empty() ? otherwise : list[std::min(i, list.size() - 1)];
}

}  // namespace

Material Paint::material(std::size_t i) const {
  Painted painted{pick(diffuse, i, Color(0.8)), std::clamp(pick(transparency, i, 0.0), 0.0, 1.0)};
  if (picture) painted = under(*picture, painted);
  const auto& [base, through] = painted;
  Phong phong;
  if (unlit) {
    phong.emissive = base * (1 - through);
  } else {
    const Color around = pick(ambient, i, Color(0.2));
    const Color own = base * (1 - through);
    phong.ambient = ambientOfDiffuse ? own * around : around * (1 - through);
    phong.diffuse = own;
    phong.specular = pick(specular, i, Color(0));
    phong.emissive = pick(emissive, i, Color(0));
    phong.shininess = std::max(0.0, pick(shininess, i, 0.2));
    phong.reflective = Color(std::max(0.0, pick(mirror, i, 0.0)));
  }
  phong.transmissive = Color(through);
  Material result{"", phong, {}};
  if (picture) paint(result, *picture, textureTransform);
  return result;
}

Paint paintOf(const Values& m, bool vrml2) {
  Paint paint;
  paint.diffuse = m.colors("diffuseColor");
  paint.specular = m.colors("specularColor");
  paint.emissive = m.colors("emissiveColor");
  paint.shininess = m.numbers("shininess");
  paint.transparency = m.numbers("transparency");
  paint.mirror = m.numbers("mirror");  // an extension of the castle engine
  paint.ambientOfDiffuse = vrml2;
  if (vrml2)
    paint.ambient = {Color(m.number("ambientIntensity", 0.2))};
  else
    paint.ambient = m.colors("ambientColor");
  return paint;
}

}  // namespace trace::inventor

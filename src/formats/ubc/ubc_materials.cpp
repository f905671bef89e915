#include "formats/ubc/ubc_materials.h"

#include <optional>
#include <utility>

#include "formats/ubc/ubc_scene.h"

namespace trace::ubc {

void MaterialReader::material() {
  const Token name = values_.tokens.string("Material");
  Surface surface;
  std::optional<Real> refract, transparency, eta;
  Material result{std::string(name.text), {}, {}};
  for (const Parameter& p : values_.parameters()) {
    const std::string_view key = values_.canonical(p.key.text);
    if (key == "ambient")
      surface.ambient = values_.color(p);
    else if (key == "diffuse")
      surface.diffuse = values_.color(p);
    else if (key == "specular")
      surface.specular = values_.color(p);
    else if (key == "emission")
      surface.emission = values_.color(p);
    else if (key == "shininess")
      surface.shininess = values_.single(p);
    else if (key == "shadow") {
      givesShadow_ = true;
      surface.shadow = values_.single(p);
    } else if (key == "reflect")
      surface.reflect = values_.single(p);
    else if (key == "refract")
      refract = values_.single(p);
    else if (key == "transparency")
      transparency = values_.single(p);
    else if (key == "eta")
      eta = values_.single(p);
    else if (key == "texture")
      texture(p, result);
    else
      values_.ignored(p, "material");
  }
  Phong phong = ubc::phong(surface);
  // With an index or a transparency beside it, "refract" is the other of the two.
  phong.transmissive = Color(transparency ? *transparency : eta ? refract.value_or(0) : 0);
  phong.index = eta ? *eta : transparency && refract.value_or(0) > 0 ? *refract : 1;
  result.model = phong;
  warnOfRanges(result, values_.tokens.place(name), values_.warnings);
  if (eta && !(*eta > 0))
    values_.warnings.warn(values_.tokens.place(name),
                          "rfrIndex: expected a number above 0, found " + toText(*eta));
  numbers_.insert_or_assign(result.name, static_cast<std::uint32_t>(scene_.materials.size()));
  scene_.materials.push_back(std::move(result));
}

void MaterialReader::texture(const Parameter& p, Material& material) {
  if (!p.text) values_.tokens.fail(p.key, "texture: expected the name of a picture in quotes");
  if (p.text->empty()) return;
  setTexture(material.textures, "diffuse", pictureTexture(std::string(*p.text), values_.tokens.place(p.key)));
}

std::uint32_t MaterialReader::named() {
  const Token token = values_.tokens.string("material");
  const auto found = numbers_.find(token.text);
  if (found != numbers_.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& [name, index] : numbers_) names.push_back(name);
  values_.tokens.fail(token, "expected the name of a material, found " + describe(token),
                      didYouMean(token.text, names));
}

}  // namespace trace::ubc

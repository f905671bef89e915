// Source: Inventor's node reference (SoTexture2, SoTexture2Transform), the specifications of VRML 1.0 and
// VRML97.
#include "formats/inventor/inventor_picture.h"

#include <utility>

#include "math/elementary.h"
#include "shading/textures/image_map.h"
#include "shading/textures/mix.h"

namespace trace::inventor {
namespace {

using Model = PaintedPicture::Model;

TextureTransform placementMoved(const Vec2& by) { return {1, 0, by.x, 0, 1, by.y}; }
TextureTransform turned(Real angle) {
  if (angle == 0) return kUnmoved;
  const Real c = math::cos(angle), s = math::sin(angle);
  return {c, 0 - s, 0, s, c, 0};
}
TextureTransform scaled(const Vec2& by) { return {by.x, 0, 0, 0, by.y, 0}; }

Vec2 pair(const Values& v, std::string_view name, const Vec2& otherwise) {
  const std::vector<double>& n = v.numbers(name);
  return n.size() < 2 ? otherwise : Vec2{n[0], n[1]};
}

Texture channelOf(ImageMap map, Channel channel) {
  map.channel = channel;
  return TextureNode{.model = std::move(map)};
}

/// The lit surface where `amount` is 0, and `color`, times the texture if there is one, where it is 1.
void cover(Material& material, const Color& color, const Texture* own, const Texture* amount) {
  auto& phong = *material.model.edit<Phong>();
  TextureNode shown{.model = Mix{.a = phong.emissive, .b = color, .amount = 1}};
  if (own) setTexture(shown.inputs, "b", *own);
  if (amount) setTexture(shown.inputs, "amount", *amount);
  setTexture(material.textures, "emissive", std::move(shown));
  phong.emissive = Color(1);
  TextureNode left{.model = Mix{.a = Color(1), .b = Color(0), .amount = 1}};
  if (amount) setTexture(left.inputs, "amount", *amount);
  const Texture rest(std::move(left));
  for (const auto& [field, value] : {std::pair{"ambient", &phong.ambient},
                                     {"diffuse", &phong.diffuse},
                                     {"reflective", &phong.reflective},
                                     {"specular", &phong.specular}}) {
    if (!amount) *value = Color(0);
    if (!isBlack(*value)) setTexture(material.textures, field, rest);
  }
}

}  // namespace

Painted under(const PaintedPicture& picture, const Painted& painted) {
  if (picture.model != Model::replace) return painted;
  return {picture.kind.colored ? Color(1) : painted.base, picture.kind.transparent ? 0 : painted.through};
}

void paint(Material& material, const PaintedPicture& picture, const TextureTransform& transform) {
  ImageMap map = picture.map;
  map.transform = transform;
  const Texture whole = TextureNode{.model = map}, alpha = channelOf(map, Channel::alpha);
  const bool transparent = picture.kind.transparent;
  if (picture.model == Model::decal) return cover(material, Color(1), &whole, transparent ? &alpha : nullptr);
  if (picture.model == Model::blend) {
    cover(material, picture.blend, nullptr, &whole);
  } else {
    const auto& phong = *material.model.as<Phong>();
    const bool unlit = isBlack(phong.diffuse) && isBlack(phong.ambient);
    if (!isBlack(phong.ambient)) setTexture(material.textures, "ambient", whole);
    setTexture(material.textures, unlit ? "emissive" : "diffuse", whole);
  }
  if (transparent) cutOut(material, alpha);
}

std::optional<Raster> inlineImage(const std::vector<double>& n) {
  constexpr double kMostSide = 1 << 16;
  if (n.size() < 4) return {};
  for (int i = 0; i < 3; ++i)
    if (!(n[static_cast<std::size_t>(i)] >= 1 && n[static_cast<std::size_t>(i)] <= (i < 2 ? kMostSide : 4)))
      return {};
  Raster raster(static_cast<int>(n[0]), static_cast<int>(n[1]), static_cast<int>(n[2]), 255);
  const auto width = static_cast<std::size_t>(raster.width), height = static_cast<std::size_t>(raster.height),
             channels = static_cast<std::size_t>(raster.channels);
  if ((n.size() - 3) / width < height) return {};
  std::vector<std::uint8_t> samples(raster.count());
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) {
      const double number = n[3 + (height - 1 - y) * width + x];
      const auto bits = number >= 0 && number <= 4294967295.0 ? static_cast<std::uint32_t>(number) : 0u;
      for (std::size_t c = 0; c < channels; ++c)
        samples[(y * width + x) * channels + c] =
            static_cast<std::uint8_t>(bits >> (8 * (channels - 1 - c)) & 255);
    }
  raster.samples = std::move(samples);
  return raster;
}

TextureTransform product(const TextureTransform& a, const TextureTransform& b) {
  return {a[0] * b[0] + a[1] * b[3], a[0] * b[1] + a[1] * b[4], a[0] * b[2] + a[1] * b[5] + a[2],
          a[3] * b[0] + a[4] * b[3], a[3] * b[1] + a[4] * b[4], a[3] * b[2] + a[4] * b[5] + a[5]};
}

TextureTransform textureTransform(const Values& v) {
  const Vec2 center = pair(v, "center", {0, 0});
  const TextureTransform shape = product(scaled(pair(v, "scale", {1, 1})), turned(v.number("rotation", 0)));
  return product(product(placementMoved({-center.x, -center.y}), shape),
                 product(placementMoved(center), placementMoved(pair(v, "translation", {0, 0}))));
}

TextureTransform texture2Transform(const Values& v) {
  const Vec2 center = pair(v, "center", {0, 0});
  const TextureTransform shape =
      product(turned(v.number("rotation", 0)), scaled(pair(v, "scaleFactor", {1, 1})));
  return product(product(placementMoved(pair(v, "translation", {0, 0})), placementMoved(center)),
                 product(shape, placementMoved({-center.x, -center.y})));
}

}  // namespace trace::inventor

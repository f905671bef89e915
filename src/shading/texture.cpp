#include "shading/texture.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "math/elementary.h"
#include "shading/textures/image_map.h"

namespace trace {

struct Texture::Data {
  TextureNode node;
  bool moved = false, inUv = false;  ///< inUv: it or one in it looks at u and v
  Affine patternFromObject;          ///< the identity where it is flat
  double size = 1;
};

namespace {

Affine patternFromObject(const TexturePlacement& p) {
  const auto turn = [&](const Vec3& axis, Real degrees) {
    return Affine::rotation(axis, degrees * kPi / 180);
  };
  const Affine placed = Affine::translation(p.translate) * turn({0, 0, 1}, p.rotate.z) *
                        turn({0, 1, 0}, p.rotate.y) * turn({1, 0, 0}, p.rotate.x) * Affine::scaling(p.scale);
  return invertible(placed) ? inverse(placed) : Affine{};
}

/// u and v where they are looked at.
TexturePlace moved(const TexturePlace& p, const Affine& m, bool inUv) {
  TexturePlace to{.point = m * p.point,
                  .uv = {},
                  .uvX = {},
                  .uvY = {},
                  .pointX = linear(m, p.pointX),
                  .pointY = linear(m, p.pointY)};
  if (!inUv) return to;
  const auto flat = [](const Vec3& v) { return Vec2{v.x, v.y}; };
  const auto step = [&](const Vec2& v) { return flat(linear(m, Vec3{v.x, v.y, 0})); };
  to.uv = flat(m * Vec3{p.uv.x, p.uv.y, 0});
  to.uvX = step(p.uvX);
  to.uvY = step(p.uvY);
  to.secondUv = flat(m * Vec3{p.secondUv.x, p.secondUv.y, 0});
  to.secondUvX = step(p.secondUvX);
  to.secondUvY = step(p.secondUvY);
  return to;
}

}  // namespace

const Texture* textureOf(const std::vector<FieldTexture>& textures, std::string_view field) {
  for (const FieldTexture& t : textures)
    if (t.field == field) return &t.texture;
  return nullptr;
}

void setTexture(std::vector<FieldTexture>& textures, std::string_view field, Texture texture) {
  const auto at =
      std::find_if(textures.begin(), textures.end(), [&](const FieldTexture& t) { return t.field >= field; });
  if (at != textures.end() && at->field == field)
    at->texture = std::move(texture);
  else
    textures.insert(at, {std::string(field), std::move(texture)});
}

Texture pictureTexture(std::string file, SourcePlace place) {
  return TextureNode{.model = ImageMap{.file = {std::move(file), nullptr, std::move(place)}}};
}

Texture::Texture(TextureNode node) {
  auto data = std::make_shared<Data>(Data{std::move(node), false, false, {}, 1});
  data->moved = !(data->node.placement == TexturePlacement{});
  if (data->moved) data->patternFromObject = patternFromObject(data->node.placement);
  data->inUv = data->node.model.wantsUv();
  for (const FieldTexture& input : data->node.inputs) {
    data->size += input.texture.size();
    data->inUv |= input.texture.data_->inUv;
  }
  data_ = std::move(data);
}

double Texture::size() const { return data_->size; }

const TextureNode& Texture::operator*() const { return data_->node; }

bool Texture::operator==(const Texture& other) const {
  return data_ == other.data_ || data_->node == other.data_->node;
}

Color Texture::at(const TexturePlace& place) const {
  return data_->moved ? at(data_->node, moved(place, data_->patternFromObject, data_->inUv))
                      : at(data_->node, place);
}

Color Texture::at(const TextureNode& node, const TexturePlace& place) {
  return node.model.at(node.inputs, place);
}

namespace {

/// Whether asks(model) of the texture or of one in it.
bool anyModel(const Texture& texture, bool (TextureModel::*asks)() const) {
  return (texture->model.*asks)() ||
         std::any_of(texture->inputs.begin(), texture->inputs.end(),
                     [&](const FieldTexture& input) { return anyModel(input.texture, asks); });
}

}  // namespace

bool wantsFootprint(const Texture& texture) { return anyModel(texture, &TextureModel::wantsFootprint); }
bool wantsUv(const Texture& texture) { return anyModel(texture, &TextureModel::wantsUv); }
bool wantsSecondUv(const Texture& texture) { return anyModel(texture, &TextureModel::wantsSecondUv); }

std::string summary(const Texture& texture) {
  if (!texture->name.empty()) return texture->name;
  std::string kind(texture->model.keyword());
  forEachField(texture->model, [&]<class Value>(const TextureField&, const Value& value) {
    if constexpr (std::is_same_v<Value, Pixels>) kind += " " + value.file;
  });
  return kind;
}

namespace {

/// Texture coordinates of a point.
Vec2 mapped(Mapping mapping, const Vec3& p) {
  if (mapping == Mapping::plane) return {p.x, p.y};
  const Real turn = math::atan2(p.z, p.x) / (2 * kPi), around = turn < 0 ? turn + 1 : turn;
  if (mapping == Mapping::cylinder) return {around, p.y};
  return {around, 0.5 + math::atan2(p.y, math::hypot(p.x, p.z)) / kPi};
}

}  // namespace

Texel ImageMap::texelAt(const TexturePlace& place) const {
  if (!file.map) return {};
  const auto& m = transform;
  const Vec2 at =
      mapping == Mapping::uv ? secondUv ? place.secondUv : place.uv : mapped(mapping, place.point);
  const Vec2 uv{m[0] * at.x + m[1] * at.y + m[2], m[3] * at.x + m[4] * at.y + m[5]};
  if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) return {};
  const auto step = [&](const Vec2& d) { return Vec2{m[0] * d.x + m[1] * d.y, m[3] * d.x + m[4] * d.y}; };
  return file.map->at(
      uv, {wrapU, wrapV, filter, centersAtEnds, srgb, step(secondUv ? place.secondUvX : place.uvX),
           step(secondUv ? place.secondUvY : place.uvY)});
}

Color ImageMap::at(const TexturePlace& place) const {
  const Texel texel = texelAt(place);
  switch (channel) {
    case Channel::color: break;
    case Channel::red: return Color(texel.color.r);
    case Channel::green: return Color(texel.color.g);
    case Channel::blue: return Color(texel.color.b);
    case Channel::alpha: return Color(texel.alpha);
  }
  return texel.color;
}

}  // namespace trace

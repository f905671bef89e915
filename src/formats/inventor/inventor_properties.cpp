// Nodes that move what follows them, or say how it looks.
#include <algorithm>
#include <filesystem>
#include <memory>

#include "base/files/named_file.h"
#include "formats/inventor/inventor_reader.h"
#include "formats/inventor/inventor_transform.h"

namespace trace::inventor {

// --- transforms ---

void Reader::move(State& state, const Affine& own) { state.worldFromObject = state.worldFromObject * own; }

void Reader::transform(const Values& v, State& state) {
  const Affine own = transformOf(v, vrml2_ ? "scale" : "scaleFactor");
  if (!vrml2_) return move(state, own);
  State inside = state;
  move(inside, own);
  children(v, inside);
}

void Reader::translation(const Values& v, State& s) {
  move(s, Affine::translation(v.vector("translation", {})));
}

void Reader::rotation(const Values& v, State& s) { move(s, turn(v.numbers("rotation"))); }

void Reader::rotationXyz(const Values& v, State& s) {
  const std::string_view axis = v.word("axis", "X");
  const Vec3 a = axis == "Y" ? Vec3{0, 1, 0} : axis == "Z" ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  move(s, Affine::rotation(a, v.number("angle", 0)));
}

void Reader::scale(const Values& v, State& s) {
  move(s, Affine::scaling(v.vector("scaleFactor", {1, 1, 1})));
}

void Reader::matrix(const Values& v, State& s) {
  const std::vector<double>& n = v.numbers("matrix");
  if (n.size() >= 16) move(s, rowMatrix(n.data()));
}

void Reader::resetTransform(const Values&, State& s) { s.worldFromObject = {}; }

void Reader::units(const Values& v, State& s) {
  const Real unit = metres(v.word("units", "METERS"));
  if (unit == 0) return;
  const Real factor = unit / std::exchange(s.unit, unit);
  move(s, Affine::scaling({factor, factor, factor}));
}

// --- properties ---

template <class List, class Make>
std::shared_ptr<const List> Reader::listOf(std::map<const Field*, std::shared_ptr<const List>>& known,
                                           const Values& v, std::string_view name, Make&& make) {
  auto& list = known[v.field(name)];
  if (!list) list = std::make_shared<const List>(make());
  return list;
}

std::shared_ptr<const std::vector<Vec3>> Reader::vectors(const Values& v, std::string_view name) {
  return listOf(vectors_, v, name, [&] { return v.vectors(name); });
}

std::shared_ptr<const std::vector<Vec2>> Reader::pairs(const Values& v, std::string_view name) {
  return listOf(pairs_, v, name, [&] { return v.pairs(name); });
}

void Reader::material(const Values& v, State& state) {
  repaint(v, state, [&](Paint& p) {
    const Paint before = p;
    p = paintOf(v, vrml2_);
    p.picture = before.picture;
    p.textureTransform = before.textureTransform;
    p.unlit = !vrml2_ && before.unlit;
  });
}

void Reader::baseColor(const Values& v, State& state) {
  repaint(v, state, [&](Paint& p) { p.diffuse = v.colors("rgb"); });
}

void Reader::packedColor(const Values& v, State& state) {
  const std::vector<double>& n = v.numbers(v.has("rgba") ? "rgba" : "orderedRGBA");
  repaint(v, state, [&](Paint& p) { unpack(n, p); });
}

void Reader::unpack(const std::vector<double>& n, Paint& paint) {
  paint.diffuse.clear();
  paint.transparency.clear();
  for (double number : n) {
    const auto bits = static_cast<std::uint32_t>(std::clamp(number, 0.0, 4294967295.0));
    const auto byte = [&](int i) { return (bits >> (8 * i) & 255) / 255.0; };
    paint.diffuse.emplace_back(byte(3), byte(2), byte(1));
    paint.transparency.push_back(1 - byte(0));
  }
}

void Reader::materialBinding(const Values& v, State& s) { s.materialBinding = v.word("value", "DEFAULT"); }

void Reader::normalBinding(const Values& v, State& s) { s.normalBinding = v.word("value", "DEFAULT"); }

void Reader::lightModel(const Values& v, State& s) {
  repaint(v, s, [&](Paint& p) { p.unlit = v.word("model", "PHONG") == "BASE_COLOR"; });
}

void Reader::shapeHints(const Values& v, State& s) {
  const std::string_view order = v.word("vertexOrdering", "UNKNOWN_ORDERING");
  s.ordered = order != "UNKNOWN_ORDERING";
  s.counterClockwise = order != "CLOCKWISE";
  s.solid = v.word("shapeType", "UNKNOWN_SHAPE_TYPE") == "SOLID";
  s.creaseAngle = v.number("creaseAngle", document_.oldCrease() ? 0.5 : 0);
}

void Reader::coordinates(const Values& v, State& s) { s.points = vectors(v, "point"); }

void Reader::normals(const Values& v, State& s) { s.normals = vectors(v, "vector"); }

void Reader::textureCoordinates(const Values& v, State& s) { s.uvs = pairs(v, "point"); }

void Reader::textureCoordinateBinding(const Values& v, State& s) {
  s.uvBinding = v.word("value", "PER_VERTEX_INDEXED");
}

void Reader::texture(const Values& v, State& s) {
  repaint(v, s, [&](Paint& p) { p.picture = pictureOf(v); });
}

void Reader::texture2Transform(const Values& v, State& s) {
  repaint(v, s, [&](Paint& p) {
    p.textureTransform = product(p.textureTransform, inventor::texture2Transform(v));
  });
}

std::optional<PaintedPicture> Reader::pictureOf(const Values& v) {
  const std::string_view type = v.node().type;
  if (type == "MultiTexture") {
    std::optional<PaintedPicture> first;
    for (std::string_view several : {"texture", "textures"})
      for (const NodeIn& one : v.nodes(several))
        if (const NodeIn at = resolved(one); at.node && !first)
          first = pictureOf(Values(*at.node, at.env));
        else if (at.node)
          textures_.note(nameOf(Values(*at.node, at.env)), document_.place(at.node->token));
    return first;
  }
  const SourcePlace place = document_.place(v.node().token);
  if (type == "MovieTexture") {
    textures_.note(nameOf(v), place);
    return std::nullopt;
  }

  PaintedPicture picture;
  if (const std::string name = nameOf(v); !name.empty()) {
    picture.map = modelPicture(name, place);
    picture.kind = kindOfPicture(document_.file(), name);
  } else if (const auto image = inlineImage(v.numbers("image"))) {
    picture.kind = {.colored = image->channels > 2, .transparent = image->hasAlpha()};
    const auto line = std::to_string(place.line) + ":" + std::to_string(place.column);
    const std::string file = std::filesystem::path(document_.file()).filename().generic_string();
    picture.map = modelPicture({file + "#" + line, std::make_shared<const MipMap>(*image), place,
                                std::make_shared<const InsideFile>(InsideFile{"", encodePng(*image)})});
    if (image->width == 1 || image->height == 1) picture.map.filter = TexelFilter::bilinear;
  } else {
    if (v.numbers("image").size() > 3)
      warn(v.node().token,
           "image of " + std::string(type) + ": expected width, height, 1 to 4 and the pixels", "image",
           "nothing is painted");
    return {};
  }
  const auto clamps = [&](std::string_view word, std::string_view flag) {
    return vrml2_ ? !v.flag(flag, true) : v.word(word, "REPEAT") == "CLAMP";
  };
  if (clamps("wrapS", "repeatS")) picture.map.wrapU = Wrap::clamp;
  if (clamps("wrapT", "repeatT")) picture.map.wrapV = Wrap::clamp;
  const std::string_view model = v.word("model", "MODULATE");
  picture.model = vrml2_             ? PaintedPicture::Model::replace
                  : model == "DECAL" ? PaintedPicture::Model::decal
                  : model == "BLEND" ? PaintedPicture::Model::blend
                                     : PaintedPicture::Model::modulate;
  picture.blend = v.color("blendColor", Color(0));
  return picture;
}

std::string Reader::nameOf(const Values& v) const { return fileOf(v, v.has("url") ? "url" : "filename"); }

std::string Reader::fileOf(const Values& v, std::string_view field) const {
  const auto& names = v.words(field);
  for (std::string_view name : names)
    if (!name.empty() && namesFile(document_.file(), std::string(name))) return std::string(name);
  return names.empty() ? std::string() : std::string(names[0]);
}

void Reader::vertexProperty(const Values& v, State& s) {
  if (v.has("vertex")) s.points = vectors(v, "vertex");
  if (v.has("normal")) s.normals = vectors(v, "normal");
  if (v.has("texCoord")) s.uvs = pairs(v, "texCoord");
  if (v.has("orderedRGBA")) packedColor(v, s);
  s.materialBinding = v.word("materialBinding", s.materialBinding);
  s.normalBinding = v.word("normalBinding", s.normalBinding);
}

}  // namespace trace::inventor

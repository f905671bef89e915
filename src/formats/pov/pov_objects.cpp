// Objects: their blocks, transforms and modifiers, solids of solids, and the statements of a scene.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/budget.h"
#include "base/nesting.h"
#include "formats/pov/pov_reader.h"

namespace trace::pov {
namespace {

constexpr std::string_view kShapes[]{
    "sphere",     "box",           "cylinder",       "cone",          "torus",           "plane",
    "disc",       "triangle",      "mesh",           "mesh2",         "prism",           "lathe",
    "sor",        "sphere_sweep",  "blob",           "quadric",       "cubic",           "quartic",
    "poly",       "polynomial",    "superellipsoid", "julia_fractal", "height_field",    "isosurface",
    "parametric", "bicubic_patch", "polygon",        "text",          "smooth_triangle", "ovus",
    "lemon"};

bool isShape(std::string_view w) {
  return std::find(std::begin(kShapes), std::end(kShapes), w) != std::end(kShapes);
}
bool isCsg(std::string_view w) {
  return w == "union" || w == "merge" || w == "intersection" || w == "difference";
}

struct Nested {
  int& depth;
  ~Nested() { --depth; }
};

}  // namespace

bool Reader::startsObject() {
  const Token& t = peek();
  if (!t.is(Token::Kind::name)) return false;
  if (const Value* value = valueOf(t)) {
    if (value->as<Ref<Node>>()) return true;
    return false;
  }
  return isShape(t.text) || isCsg(t.text) || t.text == "object" || t.text == "light_source" ||
         t.text == "light_group";
}

void Reader::statement() {
  const Token t = peek();
  if (t.isMark(";")) {
    next();
    return;
  }
  if (startsObject()) {
    world_.objects.push_back(object());
    return;
  }
  if (!t.is(Token::Kind::name))
    fail(t, "expected an object or a statement, found " + describe(t),
         t.isMark("}") ? "there is one bracket too many, or an #end too few" : "");
  const std::string_view w = t.text;
  if (const Value* value = valueOf(t)) {
    // A name by itself, as a macro may leave one.
    if (value->as<Numbers>() || value->as<std::string>() || value->as<std::shared_ptr<Array>>()) {
      const Token name = next();
      const Slot slot = namedSlot(name);
      if (const auto* node = slot ? slot->as<Ref<Node>>() : nullptr) world_.objects.push_back(*node);
      return;
    }
    fail(t,
         "expected an object, found " + std::string(kindOf(*value)) + " called \"" + std::string(w) + "\"");
  }
  if (w == "camera") {
    next();
    world_.camera = camera();
  } else if (w == "default") {  // as some scenes write it
    next();
    setDefault();
  } else if (w == "global_settings") {
    next();
    globalSettings();
  } else if (w == "background") {
    next();
    expectMark("{", "after background");
    world_.background = plainColor();
    expectMark("}", "after the colour");
  } else if (w == "fog") {
    next();
    world_.fogs.push_back(fog());
  } else if (w == "sky_sphere") {
    next();
    world_.sky = skySphere();
  } else if (w == "rainbow" || w == "media") {
    leaveOut(t, w == "media" ? "media that fills the whole scene" : "a rainbow");
    next();
    omitBlock();
  } else {
    fail(t, "expected an object or a statement, found \"" + std::string(w) + "\"",
         "a name has to be declared, with an #include perhaps, before it is used");
  }
}

/// After a keyword: reads over its block.
void Reader::omitBlock() {
  if (!takesMark("{")) return;
  int depth = 1;
  while (depth > 0) {
    const Token t = next();
    if (t.is(Token::Kind::end)) fail(t, "expected \"}\", found the end of the file");
    depth += t.isMark("{") ? 1 : t.isMark("}") ? -1 : 0;
  }
}

std::shared_ptr<Node> Reader::object() {
  constexpr std::int64_t kMostObjects = 20'000'000;
  const Token t = next();
  if (++depth_ > kMostNesting) {
    depth_ = 0;
    fail(t, "objects within each other more than " + std::to_string(kMostNesting) + " deep");
  }
  const Nested nested{depth_};
  if (++madeObjects_ > kMostObjects)
    throw Error(Fault::limit, place(t), "more than 20 million objects, the last by a loop or macro here");
  auto node = std::make_shared<Node>();
  node->place = place(t);
  const std::string_view w = t.text;
  if (const Value* value = valueOf(t)) {  // a name without object { }
    const Ref<Node> other = *value->as<Ref<Node>>();
    *node = *other;
    return node;
  }
  if (w == "object") {
    expectMark("{", "after object");
    const Token name = peek();
    const Value* value = name.is(Token::Kind::name) ? valueOf(name) : nullptr;
    if (value && !value->as<Ref<Node>>()) {
      const Token at = next();
      const Slot slot = namedSlot(at);
      const auto* held = slot ? slot->as<Ref<Node>>() : nullptr;
      if (!held) fail(at, "expected an object, found " + std::string(slot ? kindOf(*slot) : "nothing"));
      *node = **held;
    } else if (startsObject()) {
      node = object();
    } else if (!peek().isMark("}")) {
      // The name may stand for something that Trace leaves out.
      fail(name, "expected an object, found " + describe(name));
    }
    node->place = place(t);
    modifiers(*node);
    return node;
  }
  if (w == "light_source") return lightSource();
  if (w == "light_group") {
    leaveOut(t, "that the lights of a light_group shine only on its objects");
    expectMark("{", "after light_group");
    node->kind = Node::Kind::unite;
    for (;;) {
      if (takesMark("}")) return node;
      if (peek().isName("global_lights")) {
        next();
        flag();
        continue;
      }
      if (startsObject())
        node->parts.push_back(object());
      else if (!modifier(*node))
        expected("an object, or \"}\"");
    }
  }
  if (isCsg(w)) {
    const Node::Kind kind = w == "union"          ? Node::Kind::unite
                            : w == "merge"        ? Node::Kind::merge
                            : w == "intersection" ? Node::Kind::intersect
                                                  : Node::Kind::subtract;
    return csg(t, kind);
  }
  expectMark("{", "after " + std::string(w));
  node->kind = Node::Kind::shape;
  if (const Value* value = peek().is(Token::Kind::name) ? valueOf(peek()) : nullptr;
      value && value->as<Ref<Node>>() && w != "mesh") {
    const Ref<Node> other = *value->as<Ref<Node>>();  // sphere { Name ... }
    next();
    *node = *other;
  } else if (!shape(t, *node)) {
    node->kind = Node::Kind::nothing;
    leaveOut(t, std::string(w));
    int depth = 0;
    while (depth > 0 || !peek().isMark("}")) {
      const Token skipped = next();
      if (skipped.is(Token::Kind::end)) fail(skipped, "expected \"}\", found the end of the file");
      depth += skipped.isMark("{") ? 1 : skipped.isMark("}") ? -1 : 0;
    }
  }
  modifiers(*node);
  return node;
}

std::shared_ptr<Node> Reader::csg(const Token& at, Node::Kind kind) {
  expectMark("{", "after " + std::string(at.text));
  auto node = std::make_shared<Node>();
  node->place = place(at);
  node->kind = kind;
  if (const Value* value = peek().is(Token::Kind::name) ? valueOf(peek()) : nullptr;
      value && value->as<Ref<Node>>() && (*value->as<Ref<Node>>())->kind == kind) {
    const Ref<Node> other = *value->as<Ref<Node>>();
    next();
    if (takesMark("}")) {
      *node = *other;
      return node;
    }
    if (!startsObject()) {  // union { Name translate x }
      *node = *other;
      modifiers(*node);
      return node;
    }
    node->parts.push_back(other);
  }
  while (startsObject()) node->parts.push_back(object());
  for (;;) {
    if (takesMark("}")) return node;
    if (startsObject())
      node->parts.push_back(object());
    else if (!modifier(*node))
      expected("an object, a modifier or \"}\" in " + std::string(at.text));
  }
}

void Reader::modifiers(Node& node) {
  while (!takesMark("}"))
    if (!modifier(node)) expected("a modifier such as texture or translate, or \"}\"");
}

void Reader::move(Node& node, const Affine& by) { node.at = by * node.at; }

bool Reader::transform(Affine& by) {
  const Token t = peek();
  if (!t.is(Token::Kind::name)) return false;
  if (const Value* value = valueOf(t)) {
    if (const auto* held = value->as<Affine>()) {  // a name by itself, in a transform block
      by = *held;
      next();
      return true;
    }
    return false;
  }
  if (t.text == "translate") {
    next();
    by = Affine::translation(vector());
    return true;
  }
  if (t.text == "scale") {
    next();
    Vec3 s = vector();
    for (int i = 0; i < 3; ++i)
      if (s[i] == 0) {
        if (!warnings_.again("scale 0"))
          warnings_.warn(place(t), "a scale of 0 is taken as 1", {}, "scale 0");
        s[i] = 1;
      }
    by = Affine::scaling(s);
    return true;
  }
  if (t.text == "rotate") {
    next();
    const Vec3 r = vector();
    by = Affine();
    for (int i = 0; i < 3; ++i) {
      Vec3 axis;
      axis[i] = 1;
      by = Affine::rotation(axis, r[i] * kPi / 180) * by;
    }
    return true;
  }
  if (t.text == "matrix") {
    next();
    expectMark("<", "after matrix");
    Real m[12];
    for (Real& e : m) {
      e = number();
      comma();
    }
    expectMark(">", "after twelve numbers");
    for (int i = 0; i < 3; ++i) {
      by.row[i] = {m[i], m[3 + i], m[6 + i]};
      by.offset[i] = m[9 + i];
    }
    return true;
  }
  if (t.text == "transform") {
    next();
    by = transformBlock();
    return true;
  }
  return false;
}

Affine Reader::transformBlock() {
  if (!peek().isMark("{")) {  // transform Name
    const Token name = next();
    const Slot slot = namedSlot(name);
    const auto* held = slot ? slot->as<Affine>() : nullptr;
    if (!held) fail(name, "expected a transform, found " + describe(name));
    return *held;
  }
  next();
  Affine all;
  bool inverts = false;
  while (!takesMark("}")) {
    Affine one;
    const Token t = peek();
    if (takesName("inverse")) {
      inverts = true;
    } else if (transform(one)) {
      all = one * all;
    } else if (const Value* value = t.is(Token::Kind::name) ? valueOf(t) : nullptr;
               value && value->as<std::shared_ptr<Array>>()) {
      next();
      const Slot slot = namedSlot(t);
      const auto* held = slot ? slot->as<Affine>() : nullptr;
      if (!held) fail(t, "expected a transform, found " + describe(t));
      all = *held * all;
    } else {
      expected("translate, rotate, scale, matrix or \"}\"");
    }
  }
  if (inverts && invertible(all)) all = inverse(all);
  return all;
}

std::vector<Ref<Node>> Reader::objectsIn() {
  expectMark("{", "before the objects");
  std::vector<Ref<Node>> objects;
  Affine all;
  bool moved = false;
  while (!takesMark("}")) {
    Affine by;
    if (startsObject())
      objects.push_back(object());
    else if (transform(by))
      all = by * all, moved = true;
    else
      expected("an object or \"}\"");
  }
  if (moved)
    for (Ref<Node>& o : objects) {
      auto copy = std::make_shared<Node>(*o);
      copy->at = all * copy->at;
      o = copy;
    }
  return objects;
}

bool Reader::modifier(Node& node) {
  const Token t = peek();
  if (t.isMark(";")) return next(), true;
  if (!t.is(Token::Kind::name)) return false;
  Affine by;
  if (transform(by)) {
    move(node, by);
    return true;
  }
  const std::string_view w = t.text;
  const auto paint = [&](Ref<TextureNode> with, bool over) {
    if (over && node.texture) {  // a further layer, in the space of the first
      auto both = std::make_shared<TextureNode>(*node.texture);
      for (TextureNode::Layer layer : with->layers) {
        const Affine here = invertible(node.at) ? inverse(node.at) : Affine();
        const Affine first = invertible(node.textureAt) ? inverse(node.textureAt) : Affine();
        layer.at = first * here * layer.at;
        both->layers.push_back(layer);
      }
      node.texture = both;
      return;
    }
    node.texture = std::move(with);
    node.textureAt = invertible(node.at) ? inverse(node.at) : Affine();
  };
  const auto changed = [&](auto&& change) {
    auto own = std::make_shared<TextureNode>(node.texture ? *node.texture : *world_.defaultTexture);
    if (!node.texture) node.textureAt = invertible(node.at) ? inverse(node.at) : Affine();
    change(own->layers.back());
    node.texture = own;
  };
  if (const Value* value = valueOf(t)) {  // a texture's name by itself
    if (const auto* held = value->as<Ref<TextureNode>>()) {
      paint(*held, true);
      next();
      return true;
    }
    if (const auto* held = value->as<Ref<MaterialNode>>()) {
      if ((*held)->texture) paint((*held)->texture, false);
      if ((*held)->interior) node.interior = (*held)->interior;
      next();
      return true;
    }
    return false;
  }
  if (w == "texture") {
    next();
    paint(texture(), true);
  } else if (w == "pigment") {
    next();
    const Ref<PigmentNode> p = pigment();
    changed([&](TextureNode::Layer& layer) { layer.pigment = p; });
  } else if (w == "normal") {
    next();
    const Ref<NormalNode> n = normal();
    changed([&](TextureNode::Layer& layer) { layer.normal = n; });
  } else if (w == "finish") {
    next();
    const Ref<FinishNode> f = finish();
    changed([&](TextureNode::Layer& layer) { layer.finish = f; });
  } else if (w == "material") {
    next();
    const Ref<MaterialNode> m = material();
    if (m->texture) paint(m->texture, false);
    if (m->interior) node.interior = m->interior;
  } else if (w == "interior") {
    next();
    node.interior = interior();
  } else if (w == "interior_texture") {
    leaveOut(t, "interior_texture");
    next();
    texture();
  } else if (w == "color" || w == "colour" || w == "rgb" || w == "rgbf" || w == "rgbt") {
    color();
  } else if (w == "hollow" || w == "sturm" || w == "hierarchy" || w == "double_illuminate" ||
             w == "no_bump_scale") {
    next();
    flag();
  } else if (w == "no_shadow") {
    next();
    node.noShadow = flag();
  } else if (w == "no_image" || w == "no_reflection" || w == "no_radiosity") {
    next();
    if (flag() && w != "no_radiosity") leaveOut(t, std::string(w));
  } else if (w == "inverse") {
    next();
    node.inverse = !node.inverse;
  } else if (w == "uv_mapping") {
    next();
    node.uv = true;
  } else if (w == "uv_vectors") {
    next();
    for (int i = 0; i < 4 && peek().isMark("<"); ++i) vector(), comma();
  } else if (w == "split_union") {
    next();
    flag();
  } else if (w == "clipped_by" || w == "bounded_by") {
    next();
    if (rawPeek().isMark("{") || peek().isMark("{")) {
      std::vector<Ref<Node>> parts;
      expectMark("{", "after " + std::string(w));
      if (takesName("bounded_by") || takesName("clipped_by")) {
        if (w == "clipped_by") node.clippedByBound = true;
        expectMark("}", "");
        return true;
      }
      Affine all;
      while (!takesMark("}")) {
        Affine one;
        if (startsObject())
          parts.push_back(object());
        else if (transform(one))
          all = one * all;
        else
          expected("an object or \"}\"");
      }
      if (w == "clipped_by") {
        const Affine here = invertible(node.at) ? inverse(node.at) : Affine();
        for (const Ref<Node>& part : parts) {
          auto copy = std::make_shared<Node>(*part);
          copy->at = here * all * copy->at;
          node.clips.push_back(copy);
        }
      }
    }
  } else if (w == "photons") {
    next();
    omitBlock();
  } else if (w == "radiosity") {
    next();
    omitBlock();
  } else if (w == "cutaway_textures") {
    next();
    flag();
  } else if (w == "open") {
    next();
    flag();
  } else {
    return false;
  }
  return true;
}

}  // namespace trace::pov

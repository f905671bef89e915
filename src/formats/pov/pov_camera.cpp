// The camera, the lights and what surrounds a scene. Source: the POV-Ray 3.7 reference, sections 2.3 and 2.7.
#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/pov/pov_reader.h"
#include "math/elementary.h"

namespace trace::pov {

CameraNode Reader::camera() {
  CameraNode c;
  c.place = place(peek());
  expectMark("{", "after camera");
  const auto moved = [&](const Affine& by) {
    c.location = by * c.location;
    c.direction = linear(by, c.direction);
    c.right = linear(by, c.right);
    c.up = linear(by, c.up);
    c.sky = linear(by, c.sky);
  };
  const auto look = [&](const Vec3& at) {
    c.lookAt = at;
    Vec3 d = at - c.location;
    const Real away = length(d);
    if (!(away > 0)) return;
    d = d / away;
    const Real direction = length(c.direction), right = length(c.right), up = length(c.up);
    const Real hand = dot(cross(c.up, c.direction), c.right) > 0 ? 1 : -1;
    Vec3 r = cross(c.sky, d);
    if (!(length(r) > 1e-9)) r = std::abs(d.y) > 0.9 ? Vec3{1, 0, 0} : cross(Vec3{0, 1, 0}, d);
    r = normalize(r);
    const Vec3 u = cross(d, r);
    c.direction = d * direction;
    c.right = r * (hand * right);
    c.up = u * up;
  };
  while (!takesMark("}")) {
    const Token t = peek();
    if (takesMark(",") || takesMark(";")) continue;
    if (const Value* value = t.is(Token::Kind::name) ? valueOf(t) : nullptr)
      if (const auto* held = value->as<Ref<CameraNode>>()) {
        c = **held;
        next();
        continue;
      }
    Affine by;
    if (transform(by)) {
      moved(by);
      continue;
    }
    next();
    const std::string_view w = t.text;
    if (w == "perspective" || w == "orthographic" || w == "fisheye" || w == "panoramic" || w == "spherical" ||
        w == "ultra_wide_angle" || w == "omnimax" || w == "cylinder" || w == "mesh_camera") {
      c.kind = std::string(w);
      if (w == "cylinder") number();
      if (w == "mesh_camera") omitBlock();
    } else if (w == "location") {
      c.location = vector();
    } else if (w == "direction") {
      c.direction = vector();
    } else if (w == "right") {
      c.right = vector();
    } else if (w == "up") {
      c.up = vector();
    } else if (w == "sky") {
      c.sky = vector();
    } else if (w == "look_at") {
      look(vector());
    } else if (w == "angle") {
      c.angle = number();
      comma();
      if (startsNumber()) number();
    } else if (w == "focal_point") {
      c.focalPoint = vector();
    } else if (w == "aperture") {
      c.aperture = number();
    } else if (w == "blur_samples") {
      number();
      if (takesMark(",")) number();
    } else if (w == "confidence" || w == "variance") {
      number();
    } else if (w == "bokeh") {
      pigment();
    } else if (w == "normal") {
      leaveOut(t, "the normal of a camera");
      normal();
    } else if (w == "sturm" || w == "smooth") {
    } else {
      fail(t, "expected a word of a camera or \"}\", found " + describe(t),
           "such words are location, look_at, angle, right, up, sky, direction");
    }
  }
  // The angle is that between the sides, whatever the order of the words.
  if (c.angle > 0 && c.angle < 180 && (c.kind == "perspective" || c.kind == "orthographic") &&
      length(c.direction) > 0)
    c.direction = normalize(c.direction) * (length(c.right) / 2 / math::tan(c.angle * kPi / 360));
  return c;
}

std::shared_ptr<Node> Reader::lightSource() {
  auto node = std::make_shared<Node>();
  const Token at = peek();
  node->place = place(at);
  node->kind = Node::Kind::light;
  expectMark("{", "after light_source");
  LightNode& light = node->light;
  if (const Value* value = peek().is(Token::Kind::name) ? valueOf(peek()) : nullptr;
      value && value->as<Ref<Node>>()) {
    *node = **value->as<Ref<Node>>();
    next();
  } else {
    light.position = vector();
    comma();
    light.color = plainColor();
  }
  while (!takesMark("}")) {
    const Token t = peek();
    if (takesMark(",") || takesMark(";")) continue;
    if (!t.is(Token::Kind::name)) expected("a word of a light or \"}\"");
    Affine by;
    if (transform(by)) {
      node->at = by * node->at;
      continue;
    }
    next();
    const std::string_view w = t.text;
    if (w == "spotlight") {
      light.kind = LightNode::Kind::spot;
    } else if (w == "cylinder") {
      light.kind = LightNode::Kind::cylinder;
    } else if (w == "parallel") {
      light.parallel = true;
    } else if (w == "shadowless") {
      light.shadowless = true;
    } else if (w == "point_at") {
      light.pointAt = vector();
    } else if (w == "radius") {
      light.radius = number();
    } else if (w == "falloff") {
      light.falloff = number();
    } else if (w == "tightness") {
      light.tightness = number();
    } else if (w == "fade_distance") {
      light.fadeDistance = number();
    } else if (w == "fade_power") {
      light.fadePower = number();
    } else if (w == "area_light") {
      light.area = true;
      light.axis1 = vector();
      comma();
      light.axis2 = vector();
      comma();
      light.across = whole();
      comma();
      light.along = whole();
    } else if (w == "jitter" || w == "circular" || w == "orient" || w == "area_illumination" ||
               w == "media_attenuation" || w == "media_interaction") {
      flag();
    } else if (w == "adaptive") {
      number();
    } else if (w == "looks_like") {
      const std::vector<Ref<Node>> looks = objectsIn();
      node->parts.insert(node->parts.end(), looks.begin(), looks.end());
    } else if (w == "projected_through") {
      leaveOut(t, "projected_through");
      objectsIn();
    } else if (w == "color" || w == "colour" || w == "rgb") {
      light.color = plainColor();
    } else if (w == "photons") {
      omitBlock();
    } else {
      fail(t, "expected a word of a light or \"}\", found " + describe(t));
    }
  }
  return node;
}

void Reader::globalSettings() {
  expectMark("{", "after global_settings");
  while (!takesMark("}")) {
    const Token t = peek();
    if (takesMark(",") || takesMark(";")) continue;
    next();
    const std::string_view w = t.text;
    if (w == "assumed_gamma") {
      if (takesName("srgb"))
        world_.gamma = 2.2;
      else
        world_.gamma = number();
    } else if (w == "ambient_light") {
      world_.ambientLight = plainColor();
    } else if (w == "max_trace_level") {
      world_.depth = std::clamp(whole(), 1, 256);
    } else if (w == "radiosity") {
      world_.radiosity = true;
      omitBlock();
    } else if (w == "photons") {
      world_.photons = true;
      omitBlock();
    } else if (w == "subsurface") {
      omitBlock();
    } else if (w == "irid_wavelength") {
      color();
    } else if (w == "charset") {
      next();
    } else if (w == "hf_gray_16") {
      flag();
    } else if (w == "adc_bailout" || w == "max_intersections" || w == "noise_generator" ||
               w == "number_of_waves" || w == "mm_per_unit") {
      number();
    } else {
      fail(t, "expected a word of global_settings or \"}\", found " + describe(t));
    }
  }
}

FogNode Reader::fog() {
  FogNode f;
  f.place = place(peek());
  expectMark("{", "after fog");
  while (!takesMark("}")) {
    const Token t = peek();
    if (takesMark(",") || takesMark(";")) continue;
    if (const Value* value = t.is(Token::Kind::name) ? valueOf(t) : nullptr)
      if (const auto* held = value->as<Ref<FogNode>>()) {
        f = **held;
        next();
        continue;
      }
    Affine by;
    if (transform(by)) {
      f.moved = true;
      continue;
    }
    if (takesName("distance")) {
      f.distance = number();
    } else if (takesName("fog_type")) {
      f.type = whole();
    } else if (takesName("fog_offset")) {
      f.offset = number();
    } else if (takesName("fog_alt")) {
      f.height = number();
    } else if (takesName("turbulence")) {
      if (!(vector() == Vec3{})) leaveOut(t, "the turbulence of a fog");
    } else if (t.isName("octaves") || t.isName("omega") || t.isName("lambda") || t.isName("turb_depth")) {
      next();
      number();
    } else if (takesName("up")) {
      vector();
    } else {
      const Numbers c = color();
      f.color = {c[0], c[1], c[2]};
      if (c[3] > 0 || c[4] > 0) leaveOut(t, "the filter or transmit of a fog's colour");
    }
  }
  return f;
}

SkyNode Reader::skySphere() {
  SkyNode s;
  s.place = place(peek());
  if (!peek().isMark("{")) {
    const Token name = next();
    const Slot slot = namedSlot(name);
    const auto* held = slot ? slot->as<Ref<SkyNode>>() : nullptr;
    if (!held) fail(name, "expected a sky_sphere, found " + describe(name));
    return **held;
  }
  next();
  while (!takesMark("}")) {
    const Token t = peek();
    if (takesMark(",")) continue;
    if (const Value* value = t.is(Token::Kind::name) ? valueOf(t) : nullptr) {
      if (const auto* held = value->as<Ref<SkyNode>>()) {
        s = **held;
        next();
        continue;
      }
      if (const auto* held = value->as<Ref<PigmentNode>>()) {
        s.pigments.push_back(*held);
        next();
        continue;
      }
    }
    Affine by;
    if (takesName("pigment")) {
      s.pigments.push_back(pigment());
    } else if (takesName("emission")) {
      plainColor();
    } else if (transform(by)) {
      s.at = by * s.at;
    } else {
      expected("pigment, a transform or \"}\" in the sky_sphere");
    }
  }
  return s;
}

}  // namespace trace::pov

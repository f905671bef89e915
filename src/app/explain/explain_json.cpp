#include "app/explain/explain_json.h"

#include <array>
#include <string_view>

#include "app/explain/light_shares.h"
#include "app/explain/path_ways.h"
#include "app/session/json.h"
#include "base/match.h"
#include "formats/ray/file/made_by.h"
#include "geometry/materials.h"
#include "scene/integrators.h"

namespace trace {
namespace {

// Numbers have all their digits; what is not finite becomes null.
Json toJson(const Vec3& v) { return Json::list({v.x, v.y, v.z}); }
Json toJson(const Color& c) { return Json::list({c.r, c.g, c.b}); }
Json toJson(Real x) { return x; }
Json toJson(int number) { return number; }
Json toJson(const EnumValue& value) { return value.name(); }

Json toJson(const SourcePlace& place) {
  if (place.file.empty()) return nullptr;
  return {{"file", place.file.str()}, {"line", place.line}, {"column", place.column}};
}

Json toJson(const ColorRamp& ramp) {
  Json json = Json::list();
  for (const auto& [position, red, green, blue] : ramp) json.add(Json::list({position, red, green, blue}));
  return json;
}

/// The model and its values at the place; of a mixture of models what they have in common.
Json material(const Bsdf& bsdf) {
  Json json = Json::object();
  for (const ModelField& field : bsdf.said())
    visitValueOf(field, [&](const auto& value) { json[field.keyword] = toJson(value); });
  json["model"] = bsdf.row().keyword;
  return json;
}

class RayWriter {
 public:
  static Json ray(const ExplainedRay& ray, int index) {
    const RayNode& node = *ray.node;
    Json json;
    json["id"] = index;
    json["kind"] = name(node.kind);
    json["parent"] = node.parent < 0 ? Json(nullptr) : Json(node.parent);
    json["depth"] = node.depth;
    json["origin"] = toJson(node.ray.origin);
    json["direction"] = toJson(node.ray.direction);
    json["distance"] = node.hit ? node.hit->t : node.tMost;
    if (node.wavelength != 0) json["wavelength"] = node.wavelength;
    if (!node.ignored.empty()) {
      json["ignored"] = Json::list();
      for (std::size_t k = 0; k < node.ignored.size(); ++k) {
        const Ignored& i = node.ignored[k];
        json["ignored"].add({{"object", i.object},
                             {"part", i.part},
                             {"distance", i.t},
                             {"leaving", i.leaving},
                             {"opacity", i.opacity},
                             {"priority", i.body.priority},
                             {"around", body(i.around.object)},
                             {"aroundPriority", i.around.priority},
                             {"sentence", ray.ignored[k]}});
      }
    }
    json["hit"] = node.hit ? hit(ray) : Json(nullptr);
    json["terms"] = Json::list();
    for (std::size_t k = 0; k < node.terms.size(); ++k) json["terms"].add(term(node.terms[k], ray.terms[k]));
    json["through"] = toJson(node.through);
    json["filters"] = Json::list();
    for (std::size_t k = 0; k < node.filters.size(); ++k) {
      const Filter& filter = node.filters[k];
      json["filters"].add({{"object", object(ray.filters[k])},
                           {"part", filter.part},
                           {"distance", filter.t},
                           {"factor", toJson(filter.factor)},
                           {"shadowless", filter.shadowless}});
    }
    json["ends"] = Json::list();
    for (std::size_t k = 0; k < node.ends.size(); ++k)
      json["ends"].add(end(node.ends[k], ray.ends[k] ? object(*ray.ends[k]) : Json(nullptr)));
    json["sentence"] = ray.sentence;
    if (node.outside) json["outside"] = outside(*node.outside);
    json["radiance"] = toJson(node.radiance);
    json["weight"] = toJson(node.weight);
    json["nodes"] = node.nodes;
    json["tests"] = node.tests;
    return json;
  }

 private:
  /// Null for air.
  static Json object(const NamedBody& body) {
    if (!body.object) return nullptr;
    Json shares = Json::list();
    for (const NamedBody::Share& share : body.materials)
      shares.add({{"index", share.material ? Json(*share.material) : Json()},
                  {"name", share.name},
                  {"weight", share.weight}});
    return {{"index", *body.object},       {"name", body.ownName},      {"shape", body.shape},
            {"place", toJson(body.place)}, {"material", body.material}, {"materials", shares}};
  }

  /// The number of an object, null for air.
  static Json body(std::uint32_t object) { return object == Filling::kAir ? Json(nullptr) : Json(object); }

  static Json hit(const ExplainedRay& ray) {
    const RayNode& node = *ray.node;
    const Hit& h = *node.hit;
    const Vec2 uv = h.surface.uv;
    Json json{{"object", object(*ray.hit)},
              {"part", h.part},
              {"point", toJson(h.surface.point)},
              {"error", toJson(h.surface.error)},
              {"normal", toJson(h.surface.normal)},
              {"shading", toJson(h.surface.shading)},
              {"uv", Json::list({uv.x, uv.y})},
              {"leaving", h.leaving},
              {"twoSided", h.twoSided},
              {"indexBefore", node.indices.before},
              {"indexBehind", node.indices.behind},
              {"material", material(*node.bsdf)}};
    if (h.opacity < 1) json["opacity"] = h.opacity;
    if (node.raised) json["raised"] = toJson(*node.raised);
    if (node.indices.nested) {
      json["bodyBefore"] = body(node.indices.objectBefore);
      json["bodyBehind"] = body(node.indices.objectBehind);
    }
    return json;
  }

  static Json term(const Term& t, const ExplainedTerm& named) {
    Json json;
    json["kind"] = Term::kNames[static_cast<std::size_t>(t.kind)];
    json["factor"] = toJson(t.factor);
    json["value"] = toJson(t.value);
    json["ray"] = t.ray < 0 ? Json(nullptr) : Json(t.ray);
    if (t.chance)
      json["chance"] = {
          {"density", t.chance->density}, {"other", t.chance->other}, {"share", t.chance->share}};
    if (t.connection)
      json["connection"] = {
          {"s", t.connection->light}, {"t", t.connection->camera}, {"share", t.connection->share}};
    if (t.photons) {
      json["photons"] = {{"count", t.photons->count}, {"radius", t.photons->radius}};
      json["photons"]["each"] = Json::list();
      for (const Photon& p : t.photons->photons)
        json["photons"]["each"].add(
            {{"point", toJson(p.point)}, {"direction", toJson(p.direction)}, {"power", toJson(p.power)}});
    }
    if (t.cache) json["cache"] = {{"records", t.cache->records}};
    if (t.medium) {
      constexpr std::array<std::string_view, 4> kWhat{"covers", "glows", "scatters", "follows"};
      json["medium"] = {{"what", kWhat[static_cast<std::size_t>(t.medium->what)]},
                        {"object", body(t.medium->object)},
                        {"distance", t.medium->t},
                        {"forward", t.medium->forward}};
    }
    if (t.dark)
      json["dark"] = {
          {"index", t.dark->light}, {"place", toJson(named.lightPlace)}, {"why", sentence(*t.dark)}};
    if (t.scattered) json["scattered"] = {{"index", *t.scattered}, {"place", toJson(named.lightPlace)}};
    if (t.body) json["body"] = {{"distance", t.body->distance}, {"steps", t.body->steps}};
    if (t.light) {
      const LightTerm& l = *t.light;
      json["light"] = {{"index", l.light},
                       {"type", named.lightKind},
                       {"place", toJson(named.lightPlace)},
                       {"toLight", toJson(l.arriving.toLight)},
                       {"distance", l.arriving.distance},
                       {"color", toJson(l.arriving.color)},
                       {"attenuation", l.arriving.attenuation},
                       {"diffuse", toJson(l.scatter.diffuse)},
                       {"specular", toJson(l.scatter.specular)},
                       {"extraHighlight", toJson(l.arriving.extraHighlight)},
                       {"share", l.share},
                       {"probability", l.probability}};
    }
    return json;
  }

  static Json outside(const Outside::View& view) {
    Json json;
    json["source"] = Outside::kNames[static_cast<std::size_t>(view.source)];
    json["direction"] = toJson(view.direction);
    json["place"] = Json::list({view.place.x, view.place.y});
    json["face"] =
        view.face < 0 ? Json(nullptr) : Json(EnvironmentMap::kFaceNames[static_cast<std::size_t>(view.face)]);
    json["color"] = toJson(view.color);
    return json;
  }

  /// `object`: what it names, if it does.
  static Json end(const RayEnd& why, const Json& object) {
    Json json;
    json["why"] = match(why, [](const auto& w) { return w.kName; });
    const auto kind = [](RayKind k) { return name(k); };
    match(why, Overloaded{[&](const DepthLimit& w) {
                            json["unsent"] = kind(w.unsent);
                            json["limit"] = w.limit;
                          },
                          [&](const BelowThreshold& w) {
                            json["unsent"] = kind(w.unsent);
                            json["contribution"] = w.contribution;
                            json["threshold"] = w.threshold;
                          },
                          [&](const Roulette& w) {
                            json["unsent"] = kind(w.unsent);
                            json["chance"] = w.chance;
                          },
                          [&](const CutOff& w) {
                            json["object"] = object;
                            json["distance"] = w.t;
                            json["limit"] = w.limit;
                          },
                          [&](const Culled& w) {
                            json["object"] = object;
                            json["distance"] = w.t;
                          },
                          [&](const Blocked& w) {
                            json["object"] = object;
                            json["part"] = w.part;
                            json["distance"] = w.t;
                          },
                          [&](const MetLight& w) {
                            json["light"] = w.light;
                            json["distance"] = w.t;
                          },
                          [](const auto&) {}});
    return json;
  }
};

}  // namespace

std::string explainJson(const PixelFacts& facts) {
  const Explanation& e = facts.explanation;
  Json json;
  json["schema"] = "trace-explain";
  json["version"] = kExplainVersion;
  json["scene"] = facts.scene.file;
  json["picture"] = {{"width", facts.width}, {"height", facts.height}};
  json["x"] = e.tree.x;
  json["y"] = e.tree.y;
  json["sample"] = e.tree.sample;
  if (e.tree.moment >= 0)
    json["moment"] = {{"number", e.tree.moment}, {"time", timeOfMoment(facts.settings, e.tree.moment)}};
  json["samples"] = Json::list();
  for (const Color& c : e.samples) json["samples"].add(toJson(c));
  json["sampleWeights"] = Json::list();
  for (const Real weight : e.weights) json["sampleWeights"].add(weight);
  if (!e.corners.empty()) json["corners"] = Json::list();
  for (const Vec2& corner : e.corners) json["corners"].add(Json::list({corner.x, corner.y}));
  json["settled"] = e.settled;
  json["pixel"] = toJson(e.pixel);
  json["rendered"] = toJson(facts.rendered);
  json["agrees"] = facts.agrees();
  json["shares"] = Json::list();
  for (const LightShare& share : lightShares(e.tree, facts.scene))
    json["shares"].add({{"from", share.from}, {"brings", toJson(share.brings)}, {"share", share.share}});
  if (!facts.rays.empty() && facts.rays.front().node->hit)
    if (const std::string calls =
            callsThatMade(facts.scene, facts.rays.front().node->hit->object, facts.settings.time);
        !calls.empty())
      json["made"] = calls;
  json["lacksLightImage"] = hasLightImage(facts.settings) && !facts.light;
  if (facts.light) {
    const LightImagePixel& image = facts.light->image;
    json["lightImage"] = {{"value", toJson(image.value)},
                          {"picture", toJson(facts.rendered + image.value)},
                          {"paths", image.paths},
                          {"landed", image.landed},
                          {"brightest", Json::list()}};
    for (std::size_t i = 0; i < image.brightest.size(); ++i) {
      const Landing& l = image.brightest[i];
      json["lightImage"]["brightest"].add({{"x", l.x},
                                           {"y", l.y},
                                           {"sample", l.sample},
                                           {"s", l.light},
                                           {"brings", toJson(l.brings)},
                                           {"route", facts.light->routes[i]}});
    }
  }
  if (const std::vector<PathWay> ways = pathWays(e.tree); !ways.empty()) {
    json["ways"] = Json::list();
    for (const PathWay& way : ways)
      json["ways"].add({{"s", way.light},
                        {"t", way.camera},
                        {"share", way.share},
                        {"brings", toJson(way.brings)},
                        {"end", way.end < 0 ? Json(nullptr) : Json(way.end)},
                        {"start", way.start < 0 ? Json(nullptr) : Json(way.start)},
                        {"between", way.between < 0 ? Json(nullptr) : Json(way.between)},
                        {"sentence", sentence(way, e.tree, facts.scene)}});
  }
  if (facts.chain) {
    json["chain"] = {{"nearest", facts.chain->nearest}, {"moves", Json::list()}};
    for (const ChainMove& m : facts.chain->moves)
      json["chain"]["moves"].add({{"number", m.number},
                                  {"kind", look(m.kind).name},
                                  {"x", m.x},
                                  {"y", m.y},
                                  {"light", m.light},
                                  {"before", m.before},
                                  {"chance", m.chance},
                                  {"made", m.made}});
  }
  // One ray a line.
  std::string all = json.text();
  all.pop_back();  // the closing brace
  all += ",\"rays\":[";
  for (std::size_t i = 0; i < facts.rays.size(); ++i)
    all += (i > 0 ? ",\n" : "\n") + RayWriter::ray(facts.rays[i], static_cast<int>(i)).text();
  return all + "\n]}\n";
}

}  // namespace trace

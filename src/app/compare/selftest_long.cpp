// Checks of `ray selftest` that take seconds each: whole light transport by every integrator that has it.
#include <array>
#include <cmath>

#include "app/compare/selftest.h"
#include "formats/format.h"
#include "render/picture/agreement.h"
#include "scene/picture_size.h"

namespace trace {
namespace {

/// A room of coloured walls with an open lamp, 32 pixels wide: with two boxes, a ball that mirrors or one of
/// glass; and one whose light comes through a door that stands ajar. And floors whose light is easily lost or
/// counted twice: one without an end under a sun; below a panel that is seen behind a pane, or in a mirror;
/// below a narrow projector behind a pane; in fog; in light that polished metal throws; below a lamp in rough
/// glass.
enum class Room { diffuse, mirror, glass, door, sun, window, panel, projector, fog, metal, roughGlass };

/// The object on such a floor, if there is one.
const char* floorText(Room room) {
  switch (room) {
    case Room::sun:
      return R"(
directional_light { direction = (0.2, -1, -0.1); color = (0.5, 0.5, 0.5); }
translate(0, 0.3, 0.5, scale(0.3, sphere { material = "white"; }))
rotate(1, 0, 0, -1.5707963267948966, plane { material = "white"; })
)";
    case Room::window:
      return R"(
rectangle_light { position = (0, 1.5, 0); u = (1, 0, 0); v = (0, 0, 1); color = (1.2, 1.2, 1.2); visible = true; }
rotate(1, 0, 0, -1.5707963267948966, scale(8, 8, 1, square { material = "white"; }))
translate(0, 1.2, 0, rotate(1, 0, 0, -1.5707963267948966, scale(3, 3, 1, square { material = { diffuse = (0, 0, 0); transmissive = (1, 1, 1); index = 1; }; })))
)";
    case Room::panel:
      return R"(
rectangle_light { position = (0, 0.9, 0); u = (1, 0, 0); v = (0, 0, -1); color = (1.2, 1.2, 1.2); visible = true; }
rotate(1, 0, 0, -1.5707963267948966, scale(8, 8, 1, square { material = "white"; }))
translate(0, 2, 0, rotate(1, 0, 0, 1.5707963267948966, scale(3, 3, 1, square { material = { diffuse = (0, 0, 0); reflective = (1, 1, 1); }; })))
)";
    case Room::projector:
      return R"(
projector_light { position = (0, 3, 0); direction = (0, -1, 0); up = (0, 0, -1); fov = 8; color = (4, 4, 4); constant_attenuation_coeff = 0; quadratic_attenuation_coeff = 1; }
rotate(1, 0, 0, -1.5707963267948966, scale(8, 8, 1, square { material = "white"; }))
translate(0, 2, 0, rotate(1, 0, 0, -1.5707963267948966, scale(3, 3, 1, square { material = { diffuse = (0, 0, 0); transmissive = (1, 1, 1); index = 1; }; })))
)";
    case Room::fog:
      return R"(
settings { fog = 0.4; fog-color = (0.9, 0.8, 0.7); fog-forward = 0.3; medium-depth = 6; }
point_light { position = (0, 1.2, 0); color = (1, 1, 1); }
rotate(1, 0, 0, -1.5707963267948966, scale(8, 8, 1, square { material = "white"; }))
)";
    case Room::metal:
      return R"(
rotate(1, 0, 0, -1.5707963267948966, scale(8, 8, 1, square { material = "white"; }))
translate(0, 2.5, 0, rotate(1, 0, 0, 1.5707963267948966, scale(4, 4, 1, square { material = { model = conductor; color = (0.9, 0.9, 0.9); roughness = 0.05; }; })))
translate(0, 1.7, 0, rotate(1, 0, 0, -1.5707963267948966, square { material = { diffuse = (0, 0, 0); }; }))
translate(0, 1.75, 0, rotate(1, 0, 0, -1.5707963267948966, scale(0.5, 0.5, 1, square { material = { diffuse = (0, 0, 0); emissive = (12, 12, 12); }; })))
)";
    case Room::roughGlass:
      return R"(
rotate(1, 0, 0, -1.5707963267948966, scale(8, 8, 1, square { material = "white"; }))
translate(0, 1, 0, scale(0.6, sphere { material = { model = rough_glass; roughness = 0.1; index = 1.5; compensated = true; }; }))
translate(0, 1, 0, scale(0.2, sphere { material = { diffuse = (0, 0, 0); emissive = (12, 12, 12); }; }))
)";
    default: return nullptr;
  }
}

std::string roomText(Room room) {
  const bool door = room == Room::door;
  std::string text = R"(
settings { width = 32; height = 32; depth = 4; sampling = random; fresnel = exact; air-index = 1; integrator = path; }
camera { position = (0, 1, 3.8); viewdir = (0, 0, -1); updir = (0, 1, 0); fov = 36; }
material = { name = "white"; diffuse = (0.7, 0.7, 0.7); };
rotate(1, 0, 0, -1.5707963267948966, scale(2, 2, 1, square { material = "white"; }))
translate(0, 2, 0, rotate(1, 0, 0, 1.5707963267948966, scale(2, 2, 1, square { material = "white"; })))
translate(0, 1, -1, scale(2, 2, 1, square { material = "white"; }))
translate(-1, 1, 0, rotate(0, 1, 0, 1.5707963267948966, scale(2, 2, 1, square { material = { diffuse = (0.6, 0.1, 0.1); } })))
translate(1, 1, 0, rotate(0, 1, 0, -1.5707963267948966, scale(2, 2, 1, square { material = { diffuse = (0.1, 0.5, 0.1); } })))
)";
  if (const char* floor = floorText(room)) return text.substr(0, text.find("rotate(")) + floor;
  text += door ? R"(
translate(-0.5, 1, 0.2, rotate(0, 1, 0, 1.3, scale(0.05, 1.99, 1.2, box { material = "white"; })))
translate(-0.75, 1.9, -0.6, rotate(1, 0, 0, 1.5707963267948966, scale(0.4, 0.4, 1, square { material = { emissive = (60, 60, 60); diffuse = (0.5, 0.5, 0.5); } })))
)"
               : R"(
translate(0, 1.99, 0, rotate(1, 0, 0, 1.5707963267948966, scale(0.7, 0.7, 1, square { material = { emissive = (8, 8, 8); diffuse = (0.5, 0.5, 0.5); } })))
translate(-0.4, 0.45, -0.4, rotate(0, 1, 0, 0.3, scale(0.5, 0.9, 0.5, box { material = "white"; })))
)";
  if (room == Room::diffuse)
    text +=
        "translate(0.4, 0.3, 0.3, rotate(0, 1, 0, -0.3, scale(0.5, 0.6, 0.5, box { material = \"white\"; "
        "})))\n";
  else if (room == Room::mirror)
    text +=
        "translate(0.4, 0.36, 0.3, scale(0.35, sphere { material = { diffuse = (0, 0, 0); reflective = "
        "(0.9, 0.9, 0.9); } }))\n";
  else if (room == Room::glass)
    text +=
        "translate(0.4, 0.36, 0.3, scale(0.35, sphere { material = { diffuse = (0, 0, 0); transmissive = "
        "(1, 1, 1); reflective = (1, 1, 1); index = 1.5; } }))\n";
  return text;
}

using Choices = std::vector<Choice>;

constexpr int kTile = 8;  // pixels

Agreement agreementOf(Room room, const Choices& a, const Choices& b, int seeds, double bias = 0,
                      int tile = kTile) {
  Messages messages;
  const Scene scene = readScene("room.ray", "SBT-raytracer 1.0\n" + roomText(room), messages, 0);
  messages.throwIfFailed();
  const auto settings = [&](const Choices& choices) {
    return settingsFor(scene.camera, {scene.choices, choices});
  };
  return agreement(scene, settings(a), settings(b), seeds, tile, bias);
}

Choices choices(std::initializer_list<std::pair<const char*, const char*>> pairs) {
  Choices list;
  for (const auto& [name, value] : pairs) list.push_back({name, value, {}});
  return list;
}

const Choices kPath = choices({{"integrator", "path"}, {"spp", "96"}});
const Choices kBdpt = choices({{"integrator", "bdpt"}, {"spp", "32"}});
const Choices kMlt =
    choices({{"integrator", "mlt"}, {"chains", "path"}, {"spp", "96"}, {"chain-starts", "200000"}});
const Choices kMltBdpt =
    choices({{"integrator", "mlt"}, {"chains", "bdpt"}, {"spp", "192"}, {"chain-starts", "200000"}});
const Choices kMltVeach =
    choices({{"integrator", "mlt"}, {"chains", "veach"}, {"spp", "192"}, {"chain-starts", "20000"}});
// Photons have bounces of their own: only without an end are both the same.
const Choices kPathDeep = choices({{"integrator", "path"}, {"spp", "96"}, {"depth", "20"}});
const Choices kBdptDeep = choices({{"integrator", "bdpt"}, {"spp", "64"}, {"depth", "20"}});
const Choices kPhotonDeep = choices({{"integrator", "photon"},
                                     {"photons", "100000"},
                                     {"photon-passes", "4"},
                                     {"spp", "16"},
                                     {"depth", "20"}});
// Fewer photons blur the narrow light that metal reflects, and few rays hit its lamp at random.
const Choices kPhotonSharp = choices({{"integrator", "photon"},
                                      {"photons", "1000000"},
                                      {"photon-passes", "4"},
                                      {"spp", "128"},
                                      {"depth", "20"}});
const Choices kPhotonGather = choices({{"integrator", "photon"},
                                       {"final-gather", "on"},
                                       {"photons", "100000"},
                                       {"photon-passes", "4"},
                                       {"spp", "16"},
                                       {"depth", "20"}});
constexpr int kSeeds = 8;

/// The p-value of all tiles' p-values together.
double alike(Room room, const Choices& other) { return agreementOf(room, kPath, other, kSeeds).uniform; }
/// Photons blur light, however many passes they have: of a tile of 8 by 8 pixels they may change this part,
/// where rays gather them and where they are seen at once.
constexpr double kBias = 0.01, kSeenBias = 0.02;
/// The p-value of all tiles' differing by no more than that.
double alikeWithin(Room room, const Choices& other, double bias = kBias) {
  return agreementOf(room, kPathDeep, other, kSeeds, bias).least;
}
/// Compares tiles so small that some lie along the room's edges alone.
double edgesAlike(const Choices& other) {
  constexpr int kEdge = 4;
  constexpr double kEdgeBias = 0.03;
  return agreementOf(Room::diffuse, kPathDeep, other, kSeeds, kEdgeBias, kEdge).least;
}
/// How much brighter the picture is, relative to path's, in standard errors of the difference.
double brighter(Room room, const Choices& other) {
  const Agreement a = agreementOf(room, kPath, other, kSeeds);
  return (a.meanB - a.meanA) / a.error;
}
/// ... as a fraction of it, without an end of the bounces.
double ratio(Room room, const Choices& other) {
  const Agreement a = agreementOf(room, kPathDeep, other, kSeeds);
  return a.meanB / a.meanA;
}

/// By photons, in parts of bdpt's.
double ratioToBdpt(Room room, const Choices& photons) {
  const Agreement a = agreementOf(room, kBdptDeep, photons, kSeeds);
  return a.meanB / a.meanA;
}

constexpr const char* kWelch = "Welch's test, 16 tiles, 8 seeds";
constexpr const char* kWithin = "Welch's test, 16 tiles, 8 seeds, within 1 %";
constexpr const char* kSeen = "Welch's test, 16 tiles, 8 seeds, within 2 %";
constexpr const char* kEdges = "Welch's test, 64 tiles, 8 seeds, within 3 %";
constexpr const char* kMeans = "both means, in standard errors";
constexpr const char* kBlur = "the light of path";

/// A p-value above 0.01.
constexpr double kMiddle = 0.505, kAround = 0.495;
/// As rare as that.
constexpr double kErrors = 2.8;

constexpr std::array kLongChecks{
    SelfCheck{"bdpt and path: a room", kWelch, kMiddle, kAround, [] { return alike(Room::diffuse, kBdpt); }},
    SelfCheck{"bdpt and path: with a mirror", kWelch, kMiddle, kAround,
              [] { return alike(Room::mirror, kBdpt); }},
    SelfCheck{"bdpt and path: with a ball of glass", kWelch, kMiddle, kAround,
              [] { return alike(Room::glass, kBdpt); }},
    SelfCheck{"bdpt and path: a door ajar", kWelch, kMiddle, kAround,
              [] { return alike(Room::door, kBdpt); }},
    SelfCheck{"bdpt and path: a plane under a sun", kMeans, 0, kErrors,
              [] { return brighter(Room::sun, kBdpt); }},
    SelfCheck{"bdpt and path: a panel behind a pane", kMeans, 0, kErrors,
              [] { return brighter(Room::window, kBdpt); }},
    SelfCheck{"bdpt and path: a panel in a mirror", kMeans, 0, kErrors,
              [] { return brighter(Room::panel, kBdpt); }},
    SelfCheck{"bdpt and path: a projector behind a pane", kMeans, 0, kErrors,
              [] { return brighter(Room::projector, kBdpt); }},
    SelfCheck{"bdpt and path: in fog", kMeans, 0, kErrors, [] { return brighter(Room::fog, kBdpt); }},
    SelfCheck{"mlt and path: a room", kMeans, 0, kErrors, [] { return brighter(Room::diffuse, kMlt); }},
    SelfCheck{"mlt and path: with a mirror", kMeans, 0, kErrors, [] { return brighter(Room::mirror, kMlt); }},
    SelfCheck{"mlt and path: with a ball of glass", kMeans, 0, kErrors,
              [] { return brighter(Room::glass, kMlt); }},
    SelfCheck{"mlt and path: a door ajar", kMeans, 0, kErrors, [] { return brighter(Room::door, kMlt); }},
    SelfCheck{"mlt over bdpt and path: a room", kMeans, 0, kErrors,
              [] { return brighter(Room::diffuse, kMltBdpt); }},
    SelfCheck{"mlt over bdpt and path: with a mirror", kMeans, 0, kErrors,
              [] { return brighter(Room::mirror, kMltBdpt); }},
    SelfCheck{"mlt over bdpt and path: with a ball of glass", kMeans, 0, kErrors,
              [] { return brighter(Room::glass, kMltBdpt); }},
    SelfCheck{"mlt over bdpt and path: a door ajar", kMeans, 0, kErrors,
              [] { return brighter(Room::door, kMltBdpt); }},
    SelfCheck{"mlt veach and path: a room", kMeans, 0, kErrors,
              [] { return brighter(Room::diffuse, kMltVeach); }},
    SelfCheck{"mlt veach and path: with a mirror", kMeans, 0, kErrors,
              [] { return brighter(Room::mirror, kMltVeach); }},
    SelfCheck{"mlt veach and path: with a ball of glass", kMeans, 0, kErrors,
              [] { return brighter(Room::glass, kMltVeach); }},
    SelfCheck{"mlt veach and path: a door ajar", kMeans, 0, kErrors,
              [] { return brighter(Room::door, kMltVeach); }},
    SelfCheck{"mlt and path: a panel behind a pane", kMeans, 0, kErrors,
              [] { return brighter(Room::window, kMlt); }},
    SelfCheck{"photon and path: a panel behind a pane", kBlur, 1, 0.02,
              [] { return ratio(Room::window, kPhotonDeep); }},
    // By Welch's test the bias of photons would show in the end: it counts within a bound.
    SelfCheck{"photons seen at once and path: a room", kSeen, kMiddle, kAround,
              [] { return alikeWithin(Room::diffuse, kPhotonDeep, kSeenBias); }},
    SelfCheck{"photon and path: a room, tile by tile", kWithin, kMiddle, kAround,
              [] { return alikeWithin(Room::diffuse, kPhotonGather); }},
    SelfCheck{"photon and path: with a mirror, tile by tile", kWithin, kMiddle, kAround,
              [] { return alikeWithin(Room::mirror, kPhotonGather); }},
    SelfCheck{"photon and path: with a ball of glass, tile by tile", kWithin, kMiddle, kAround,
              [] { return alikeWithin(Room::glass, kPhotonGather); }},
    SelfCheck{"photons seen at once and path: the edges of a room", kEdges, kMiddle, kAround,
              [] { return edgesAlike(kPhotonDeep); }},
    SelfCheck{"photon and bdpt: off polished metal", "the light of bdpt", 1, 0.02,
              [] { return ratioToBdpt(Room::metal, kPhotonSharp); }},
    SelfCheck{"photon and bdpt: an emitter in rough glass", "the light of bdpt", 1, 0.02,
              [] { return ratioToBdpt(Room::roughGlass, kPhotonDeep); }},
    SelfCheck{"photon and path: a door ajar", kBlur, 1, 0.03, [] { return ratio(Room::door, kPhotonDeep); }},
};

}  // namespace

std::span<const SelfCheck> longSelfChecks() { return kLongChecks; }

}  // namespace trace

// Checks of `ray selftest` that take seconds each: whole light transport by every integrator that has it.
#include <array>
#include <cmath>

#include "app/agreement.h"
#include "app/selftest.h"

namespace trace {
namespace {

std::vector<Choice> choices(std::initializer_list<std::pair<const char*, const char*>> pairs) {
  std::vector<Choice> list;
  for (const auto& [name, value] : pairs) list.push_back({name, value, {}});
  return list;
}

const std::vector<Choice> kPath = choices({{"integrator", "path"}, {"spp", "96"}}),
                          kBdpt = choices({{"integrator", "bdpt"}, {"spp", "32"}}),
                          kMlt = choices({{"integrator", "mlt"}, {"spp", "96"}, {"chain-starts", "400000"}}),
                          kMltBdpt = choices({{"integrator", "mlt"},
                                              {"chains", "bdpt"},
                                              {"spp", "192"},
                                              {"chain-starts", "400000"}}),
                          kPhoton = choices({{"integrator", "photon"},
                                             {"photons", "200000"},
                                             {"photon-passes", "8"},
                                             {"spp", "16"}});
constexpr int kSeeds = 8, kTile = 8;

/// The p-value of all tiles' p-values together.
double alike(Room room, const std::vector<Choice>& other) {
  return agreement(roomText(room), kPath, other, kSeeds, kTile).uniform;
}
/// How much brighter the picture is, relative to path's, in standard errors of the difference.
double brighter(Room room, const std::vector<Choice>& other) {
  const Agreement a = agreement(roomText(room), kPath, other, kSeeds, kTile);
  return (a.meanB - a.meanA) / a.error;
}
/// ... in parts of it.
double ratio(Room room, const std::vector<Choice>& other) {
  constexpr int kFew = 2;
  const Agreement a = agreement(roomText(room), kPath, other, kFew, kTile);
  return a.meanB / a.meanA;
}

constexpr const char* kWelch = "Welch's test, 16 tiles, 8 seeds";
constexpr const char* kMeans = "both means, in standard errors";
constexpr const char* kBlur = "the light of path";

/// A p-value above 0.01.
constexpr double kMiddle = 0.505, kAround = 0.495;
/// As rare as that.
constexpr double kErrors = 2.8;

constexpr std::array kTable{
    SelfCheck{"bdpt and path: a room", kWelch, kMiddle, kAround,
              [] { return alike(Room::diffuse, kBdpt); }},
    SelfCheck{"bdpt and path: with a mirror", kWelch, kMiddle, kAround,
              [] { return alike(Room::mirror, kBdpt); }},
    SelfCheck{"bdpt and path: with a ball of glass", kWelch, kMiddle, kAround,
              [] { return alike(Room::glass, kBdpt); }},
    SelfCheck{"bdpt and path: a door ajar", kWelch, kMiddle, kAround, [] { return alike(Room::door, kBdpt); }},
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
    SelfCheck{"photon and path: a room", kBlur, 1, 0.02, [] { return ratio(Room::diffuse, kPhoton); }},
    SelfCheck{"photon and path: with a mirror", kBlur, 1, 0.02, [] { return ratio(Room::mirror, kPhoton); }},
    SelfCheck{"photon and path: with a ball of glass", kBlur, 1, 0.02,
              [] { return ratio(Room::glass, kPhoton); }},
    SelfCheck{"photon and path: a door ajar", kBlur, 1, 0.03, [] { return ratio(Room::door, kPhoton); }},
};

}  // namespace

std::span<const SelfCheck> longSelfChecks() { return kTable; }

}  // namespace trace

// THE table of branches: sets of random numbers of their own, one for each decision at a vertex of a path
// (Sampler::branch). Decisions that one integrator takes at one vertex have different values. The values are
// part of every picture: with another one its noise is other noise.
#pragma once

#include <cstdint>

namespace trace {

enum class Branch : std::uint32_t {
  // From 0 on: the lights of the scene, by their number.
  lightMedia = 0x40000000u,   ///< media in front of a light, plus the number of the light
  lightChoice = 0x7ffffff0u,  ///< which lights, where not all are sampled

  // Ambient occlusion.
  occlusionHoles = 0x7ffffffcu,  ///< which holes its rays pass
  occlusion = 0x7ffffffeu,       ///< their directions

  // Whitted's tracer.
  whittedToLamp = 0x7ffffff8u,    ///< media in front of an emitter
  whittedBody = 0x7ffffff9u,      ///< where light entered a translucent object
  whittedLamps = 0x7ffffffau,     ///< points on emitters
  whittedStraight = 0x7ffffffbu,  ///< the ray that continues through a partly open surface
  whittedFog = 0x7ffffffdu,       ///< fog and media along the ray
  whittedLobe = 0x7fffffffu,      ///< the direction in a glossy lobe
  mirrored = 0x80000000u,         ///< the mirrored ray
  refracted = 0x80000001u,        ///< the refracted rays, plus their number in the fan

  // A point in fog or a medium that scatters light to the ray.
  scatteredLamp = 0x80000000u,    ///< a point on an emitter
  scatteredToLamp = 0x80000001u,  ///< media in front of it

  // A vertex of path, photon or bdpt.
  lamp = 0x80000000u,    ///< a point on an emitter
  choice = 0x80000001u,  ///< mirror, glass or lobe
  lobe = 0x80000002u,    ///< the direction in the lobe
  next = 0x80000003u,    ///< the next vertex
  medium = 0x80000004u,  ///< how far the ray gets in fog and media
  hole = 0x80000005u,    ///< which holes the next ray passes

  // A vertex of path or photon.
  pathBody = 0x80000006u,    ///< where light entered a translucent object
  pathToLamp = 0x80000007u,  ///< media in front of the emitter
  roulette = 0x80000008u,    ///< Russian roulette
  photonDisk = 0x80000009u,  ///< whether the surface fills the disk of the photons
  caustics = 0x8000000au,    ///< the same for photons of caustics

  // A sample of bdpt, and its vertices.
  lightPath = 0x80000006u,   ///< the path from a light
  spectrum = 0x80000007u,    ///< the wavelength, if the path is split
  lightLens = 0x80000008u,   ///< the point of the lens where the path from the light arrives
  strategy = 0x80000009u,    ///< the one that a multiplexed sample shows
  bdptToLamp = 0x8000000au,  ///< media in front of a light or emitter
  join = 0x8000000bu,        ///< media between two vertices
  land = 0x8000000cu,        ///< media in front of the camera
  bdptBody = 0x8000000du,    ///< where light entered a translucent object

  // The camera ray.
  film = 0xf0000000u,        ///< the point of the picture
  lens = 0xf0000001u,        ///< the point of the lens
  time = 0xf0000002u,        ///< the time while the shutter is open
  cameraHole = 0xf0000003u,  ///< which holes it passes
  arrival = film,  ///< the numbers that led a path to a vertex; at the first, its point of the picture
};

}  // namespace trace

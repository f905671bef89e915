// Particle systems (Reeves, Particle Systems: A Technique for Modeling a Class of Fuzzy Objects, 1983):
// fountains, sparks, smoke. A reader asks for the particles at the moment of its frame and makes an object of
// each.
//
// Every particle has random numbers of its own and is followed by itself from its birth: so the same scene
// and moment give the same particles, whatever was asked before.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "base/field.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace {

struct Particles {
  static constexpr std::string_view kKeyword = "particles";
  static constexpr std::string_view kHelp =
      "particles: objects that are emitted, move by gravity, drag and wind, and bounce";
  static constexpr int kMostAlive = 100'000;
  static constexpr double kMostSteps = 1e8;  ///< most steps of all particles together

  int seed = 1;
  Real rate = 50, begin = 0, duration = kNoLimit, lifetime = 2, lifetimeSpread = 0.2;
  Vec3 position, spread{0.05, 0.05, 0}, velocity{0, 0, 4};
  Real velocitySpread = 0.5;
  Vec3 gravity{0, 0, -9.81}, wind;
  Real drag = 0;
  std::vector<std::array<Real, 4>> planes, spheres;
  Real bounce = 0.5, friction = 0.1, size = 0.05, endSize = 0.05;
  Color color{1, 1, 1}, endColor{1, 1, 1};
  Real step = 0.01;

  static constexpr auto fields() {
    return Fields{
        Field{"seed", &Particles::seed, "", 0, kNoLimit, "another number, other particles"},
        Field{"rate", &Particles::rate, "", 0, kNoLimit, "particles a second"},
        Field{"begin", &Particles::begin, "seconds", -kNoLimit, kNoLimit, "start of the emission"},
        Field{"duration", &Particles::duration, "seconds", 0, kNoLimit, "duration of the emission"},
        Field{"lifetime", &Particles::lifetime, "seconds", 0, kNoLimit, "lifetime of a particle"},
        Field{"lifetime_spread", &Particles::lifetimeSpread, "", 0, 1, "random variation, as a fraction"},
        Field{"position", &Particles::position, "", -kNoLimit, kNoLimit, "where they are emitted"},
        Field{"spread", &Particles::spread, "", 0, kNoLimit, "largest offset from there in x, y and z"},
        Field{"velocity", &Particles::velocity, "", -kNoLimit, kNoLimit, "initial velocity"},
        Field{"velocity_spread", &Particles::velocitySpread, "", 0, kNoLimit,
              "its largest deviation, in any direction"},
        Field{"gravity", &Particles::gravity, "", -kNoLimit, kNoLimit, "acceleration"},
        Field{"wind", &Particles::wind, "", -kNoLimit, kNoLimit, "velocity of the air"},
        Field{"drag", &Particles::drag, "", 0, kNoLimit,
              "fraction of the speed through the air that is lost in a second"},
        Field{"planes", &Particles::planes, "", -kNoLimit, kNoLimit,
              "list of (x, y, z, d): they bounce where the dot product of (x, y, z) and the position falls "
              "to d"},
        Field{"spheres", &Particles::spheres, "", -kNoLimit, kNoLimit,
              "list of (x, y, z, radius) that they bounce from"},
        Field{"bounce", &Particles::bounce, "", 0, 1, "fraction of the normal speed kept at a bounce"},
        Field{"friction", &Particles::friction, "", 0, 1,
              "fraction of the tangential speed lost at a bounce"},
        Field{"size", &Particles::size, "", 0, kNoLimit, "scale of the object at birth"},
        Field{"end_size", &Particles::endSize, "", 0, kNoLimit, "scale of the object at the end of its life"},
        Field{"color", &Particles::color, "", 0, kNoLimit,
              "factor on the material's emissive, ambient and diffuse at birth"},
        Field{"end_color", &Particles::endColor, "", 0, kNoLimit, "the factor at the end of its life"},
        Field{"step", &Particles::step, "seconds", 1e-4, 1, "time step of the simulation"}};
  }
  bool operator==(const Particles&) const = default;
};

/// One that is alive.
struct Particle {
  Vec3 place;
  Real age = 0;  ///< from 0 at birth to 1 at the end
};

/// The particles alive at that time, oldest first. Throws Error if there are more than can be followed.
std::vector<Particle> particlesAt(const Particles& system, Real time);

}  // namespace trace

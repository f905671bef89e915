// Path tracing (Kajiya, The Rendering Equation, 1986): all light, however often it is scattered.
//
//   L = Le + sum over lights + lamp + weight * L(one ray, chosen at random)
//
// Lights of the scene are asked one by one, as Whitted's tracer does. One place on the emissive objects is
// chosen at random; a bounced ray may also hit them, and the two are weighed by the power heuristic (Veach
// 1997, section 9.2.4). One of a surface's mirrored, refracted and scattered rays is followed.
// A ray that was bounced as often as the depth allows sends one more, which sees only emitters: so the
// last surface is lit in both ways, too. The ambient light is left out: what it stands for is traced.
//
// Use path first: for lights in the open, and a sky that is the light. Not for lights behind glass or walls,
// or that shine at the ceiling: its rays rarely hit them, and a light without a size never.
// Use direct to see what indirect light adds, or as a fast preview. Not where light has to bounce.
#pragma once

#include "render/integrators/terminator.h"
#include "render/lights/lamps.h"
#include "render/paths/arrival.h"
#include "render/samples/integrator.h"

namespace trace {

class PathTracer : public Integrator {
 public:
  /// Without bounces there is only what comes from lights and lamps straight: integrator direct.
  explicit PathTracer(bool bounces = true) : bounces_(bounces) {}
  void prepare(const World& world, const Settings& settings, Job& job) override;
  Color radiance(Tracer& tracer, Sampler sampler, const CameraRay& camera) const override;

 protected:
  struct Path : Leg {
    int depth = 0;      ///< bounces, and rays of mirrors and glass
    int scattered = 0;  ///< number of times, by media
    Real density = 0;   ///< density of its direction, among lobes; 0 where there was one only
    Vec3 from{};        ///< place for which that holds: panes may lie between it and the ray
    Terminator::Told told{};
    std::optional<Vec2> second{};  ///< second2() of the numbers that led here, if it was drawn already
    auto roulette() const {
      return [this] { return numbers.branch(Branch::roulette).next(); };
    }
  };
  /// The radiance along the ray of the path, which was cast last and ends at `hit`.
  Color along(Tracer& tracer, Path& path, const std::optional<Hit>& hit) const;

  Lamps lamps_;
  int depth_ = 0;          ///< the most bounces
  int mostScattered_ = 1;  ///< the most times that media scatter
  const Terminator* terminator_ = nullptr;

 private:
  std::optional<Color> arrive(Tracer& tracer, Path& path, const std::optional<Hit>& hit, Turns& turns) const;
  std::optional<Color> scatter(Tracer& tracer, Path& path, const LegMedia& media, Turns& turns) const;
  std::optional<Color> turnAt(Tracer& tracer, Path& path, const Hit& hit, bool known, bool last,
                              Turns& turns) const;
  std::optional<Color> turnEvenly(Tracer& tracer, Path& path, const Hit& hit, const PhongBsdf& bsdf,
                                  bool last, Turns& turns) const;
  void addEmission(Gather& sum, const Path& path, const Hit& hit, const Color& emissive) const;
  /// The light of one point on the emitters; `shareOfLobe` is how often a ray into the lobe is followed.
  template <class Point>
  void addLamp(Gather& sum, const Point& at, Real shareOfLobe, const Path& path) const;
  /// Straight behind the surface the path still meets the lamps for which the place before it was asked.
  static bool meetsBehind(const Path& path, const Interaction& at) {
    return path.density > 0 && at.tracer.isPane(at.bsdf());
  }
  static void follow(Path& path, Turn& turn, const Arrival& arrival, const Onward::Ray& next,
                     const Color& factor);

  bool bounces_;
  bool knowsEvenPoints_ = false;  ///< what EvenPoint says holds
};

}  // namespace trace

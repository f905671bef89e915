// The camera rays of a pixel and what they bring: the same for a render, for one pixel again, and for its
// explanation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "image/film/film.h"
#include "render/samples/integrator.h"
#include "render/samples/outline.h"
#include "render/world/footprint.h"

namespace trace {

/// Takes a picture's samples, one at a time, by one worker.
class PixelTracer {
 public:
  /// `tree`, if any, records the rays. The moments' worlds and integrators must outlive it.
  PixelTracer(std::span<const Moment> moments, const Settings& settings, const Size& size,
              RayTree* tree = nullptr)
      : moments_(moments.begin(), moments.end()), tree_(tree), rules_(settings, size) {
    tracers_.reserve(moments.size());
    for (const Moment& moment : moments) tracers_.emplace_back(*moment.world, settings, tree);
  }
  PixelTracer(const World& world, const Integrator& integrator, const Settings& settings, const Size& size,
              RayTree* tree = nullptr)
      : PixelTracer(std::array{Moment{&world, &integrator}}, settings, size, tree) {}

  /// From now on what samples throw at other places of the picture is left there; null: nowhere.
  void collect(std::vector<Splat>* splats) { splats_ = splats; }
  /// The splats of the last sample, if they are collected.
  const std::vector<Thrown>& thrown() const { return thrown_; }
  /// Calls use(Splat) for each pixel that sees it.
  template <class Use>
  void spread(const Thrown& t, const Use& use) const {
    rules_.spread(t.place, [&](int x, int y, Real share) { use(Splat{x, y, t.color * share}); });
  }

  /// How many a pixel has.
  int samples() const { return rules_.samples(); }

  /// Sample k of a pixel.
  struct Name {
    int x, y, k;
    bool operator==(const Name&) const = default;
  };
  /// Traces the camera rays of samples together, at most RayPacket::kRays, which sample() is then asked for
  /// in this order. Rays of neighbouring pixels and of one pixel hit what they hit alone, in less time.
  void lookAhead(std::span<const Name> names) {
    ahead_.clear();
    next_ = 0;
    if (moments_.size() > 1 || tree_) return;
    ahead_.reserve(names.size());  // each stays where it is
    std::array<const Ray*, RayPacket::kRays> rays;
    std::array<Found*, RayPacket::kRays> found;
    for (std::size_t i = 0; i < names.size(); ++i) {
      Ahead& ahead = ahead_.emplace_back(*this, names[i]);
      rays[i] = &ahead.aimed.ray;
      found[i] = &ahead.found;
    }
    tracer(0).lookAhead(std::span(rays).first(names.size()), RayKind::camera, found);
  }

  /// The radiance of the camera ray of sample 0 <= k < samples(); may be NaN or infinite. Row y = 0 is the
  /// top.
  Color sample(int x, int y, int k) {
    return sample(x, y, k, [](const CameraRay&, const Sampler&) {});
  }
  /// The same; look(CameraRay, Sampler) sees the ray after it was followed.
  template <class Look>
  Color sample(int x, int y, int k, Look&& look) {
    if (next_ < ahead_.size() && ahead_[next_].name == Name{x, y, k}) {
      const Ahead& ahead = ahead_[next_++];
      return follow(ahead.aimed, &ahead.found, look);
    }
    return follow(aim(Name{x, y, k}), nullptr, look);
  }
  /// The radiance at a corner, likewise.
  template <class Look>
  Color corner(const CornerPlace& place, Look&& look) {
    const Sampler sampler(rules_, place);
    return follow(aim(sampler, rules_.middle(place.x, place.y), {rules_.corner(place), 1}), nullptr, look);
  }
  /// Collects what sample k throws at other places, and takes nothing else of it.
  void throwLight(int x, int y, int k) {
    const Sampler sampler(rules_, x, y, k);
    Tracer& tracer = this->tracer(momentOf(sampler));
    thrown_.clear();
    moments_[now_].integrator->throwLight(tracer, sampler, thrown_);
    spreadThrown(k);
  }
  /// The camera ray alone.
  template <class Look>
  void look(int x, int y, int k, Look&& look) {
    const Sampler sampler(rules_, x, y, k);
    withCamera(aim(sampler, rules_.middle(x, y), sampler.film()), nullptr,
               [&](const CameraRay& camera) { look(camera, sampler); });
  }
  /// The contribution of a sample with these numbers, times what it counts, and where. The numbers choose its
  /// place in the area of the picture, too.
  Splat sample(SampleNumbers& numbers, const Tile& area) {
    const Sampler sampler(rules_, numbers);
    const auto split = [](Real u, int first, int end) {  // into a pixel and a place in it
      const Real at = u * (end - first);
      const int pixel = std::min(static_cast<int>(at), end - first - 1);
      return std::pair(first + pixel, at - pixel);
    };
    const Vec2 u = sampler.branch(Branch::film).next2();
    const auto [x, withinX] = split(u.x, area.x0, area.x1);
    const auto [y, withinY] = split(u.y, area.y0, area.y1);
    const FilmSample place = rules_.film(x, y, 0, {withinX, withinY});
    const auto splat = [&, x = x, y = y](const CameraRay& camera) {
      return Splat{x, y, radiance(sampler, camera) * (camera.weight * rules_.filterWeight())};
    };
    return withCamera(aim(sampler, rules_.middle(x, y), place), nullptr, splat);
  }

  /// The tracer of the moment of the last sample.
  Tracer& tracer() { return tracers_[now_]; }
  /// The number of that moment.
  std::size_t moment() const { return now_; }
  /// That of a moment.
  Tracer& tracer(std::size_t moment) {
    now_ = moment;
    if (tree_ && moments_.size() > 1) tree_->moment = static_cast<int>(now_);
    return tracers_[moment];
  }
  /// The statistics of all samples.
  Statistics statistics() const {
    Statistics sum;
    for (const Tracer& tracer : tracers_) sum += tracer.statistics();
    return sum;
  }

 private:
  /// The camera ray of a sample, before it is cast.
  struct Aimed {
    /// The sampler is made of the rest; `choose` places the sample by it. All is made where it stays.
    template <class Choose, class... Own>
    Aimed(const PixelTracer& pixels, const Vec2& middle, const Choose& choose, const Own&... own)
        : sampler(own...),
          moment(pixels.momentOf(sampler)),
          drawn(choose(sampler)),
          place(pixels.frameOf(moment).inEyeOf(middle, drawn.place)),
          lens(pixels.frameOf(moment).optics.lens.radius > 0 ? sampler.branch(Branch::lens).next2()
                                                             : kCenter),
          ray(pixels.frameOf(moment).ray(place, lens)) {}

    Sampler sampler;
    std::size_t moment;
    FilmSample drawn;
    Vec2 place, lens;
    Ray ray;
  };
  /// One whose ray was cast, by lookAhead().
  struct Ahead {
    Name name;
    Aimed aimed;
    Found found;

    Ahead(const PixelTracer& pixels, const Name& own) : name(own), aimed(pixels.aim(own)) {}
  };

  /// The ray of a place of the picture, which counts for the pixel of that middle.
  Aimed aim(const Sampler& sampler, const Vec2& middle, const FilmSample& drawn) const {
    return Aimed(
        *this, middle, [&](const Sampler&) { return drawn; }, sampler);
  }
  const CameraFrame& frameOf(std::size_t moment) const { return moments_[moment].world->camera(); }
  Aimed aim(const Name& name) const {
    const auto choose = [](const Sampler& sampler) { return sampler.film(); };
    return Aimed(*this, rules_.middle(name.x, name.y), choose, rules_, name.x, name.y, name.k);
  }
  template <class Look>
  Color follow(const Aimed& aimed, const Found* first, const Look& look) {
    return withCamera(aimed, first, [&](const CameraRay& camera) {
      const Color color = radiance(aimed.sampler, camera);
      look(camera, aimed.sampler);
      return color;
    });
  }
  /// Calls use(CameraRay) for the ray; `first` is what it hits first, if that is known.
  template <class Use>
  std::invoke_result_t<const Use&, const CameraRay&> withCamera(const Aimed& aimed, const Found* first,
                                                                const Use& use) {
    const auto& [sampler, moment, drawn, place, lens, ray] = aimed;
    Tracer& tracer = this->tracer(moment);
    const World& world = tracer.world();
    Footprint differentials;
    if (world.wantsFootprints()) differentials = differentialsAt(world.camera(), place, lens, ray);
    const bool weighs = moments_[now_].integrator->weighsHoles();
    const Real chance = weighs || !world.hasHoles() ? 0 : sampler.branch(Branch::cameraHole).next();
    CameraRay camera(ray, tracer.interfacesAt(ray.origin), [&](Interfaces& inside) {
      return tracer.cast(aimed.ray, RayKind::camera, inside, chance, {}, first);
    });
    camera.weight = drawn.weight;
    camera.differentials = differentials.get();
    if (tracer.settings().outlines > 0) camera.ink = inkAt(tracer, camera.hit, place, lens, rules_.size());
    if (splats_) camera.thrown = &thrown_;
    return use(camera);
  }
  Color radiance(const Sampler& sampler, const CameraRay& camera) {
    thrown_.clear();
    Color radiance = moments_[now_].integrator->radiance(tracers_[now_], sampler, camera);
    if (!spreadThrown(sampler.sample())) radiance = Color(std::numeric_limits<Real>::quiet_NaN());
    return radiance;
  }
  /// False if something that the sample has thrown is not finite: it is a part of the sample, which is as bad
  /// as that.
  bool spreadThrown(int sample) {
    for (const Thrown& t : thrown_)
      if (!isFinite(t.color) || !std::isfinite(t.place.x) || !std::isfinite(t.place.y)) return false;
    for (const Thrown& t : thrown_)
      spread(t, [&](const Splat& splat) { splats_->push_back({splat.x, splat.y, splat.value, sample}); });
    return true;
  }

  /// The moment that a sample sees.
  std::size_t momentOf(const Sampler& sampler) const {
    if (moments_.size() == 1) return 0;
    const Real chosen = sampler.branch(Branch::time).next() * static_cast<Real>(moments_.size());
    return std::min(static_cast<std::size_t>(chosen), moments_.size() - 1);
  }

  /// To the rays of the samples beside this one, whatever the camera is.
  [[gnu::noinline]] Footprint differentialsAt(const CameraFrame& camera, const Vec2& film, const Vec2& lens,
                                              const Ray& ray) const {
    const Vec2 step = rules_.spacing();
    const Ray x = camera.ray({film.x + step.x, film.y}, lens),
              y = camera.ray({film.x, film.y + step.y}, lens);
    return Differentials{x.origin - ray.origin, y.origin - ray.origin, x.direction - ray.direction,
                         y.direction - ray.direction};
  }

  std::vector<Moment> moments_;
  std::vector<Tracer> tracers_;  ///< one for each
  RayTree* tree_;
  std::vector<Splat>* splats_ = nullptr;
  std::vector<Thrown> thrown_;  ///< by the sample
  std::size_t now_ = 0;
  SampleRules rules_;
  std::vector<Ahead> ahead_;
  std::size_t next_ = 0;  ///< index into them
};

/// Adds the samples of the wave; calls see(color, weight) for each.
template <class See>
void addWave(PixelTracer& tracer, int x, int y, const Wave& wave, PixelSum& sum, const See& see) {
  for (int k = wave.first; k < wave.end; ++k) {
    Real weight = 1;
    const Color color =
        tracer.sample(x, y, k, [&](const CameraRay& ray, const Sampler&) { weight = ray.weight; });
    see(color, weight);
    sum.add(color, weight);
  }
}

/// PixelSum::firstErrorFor() of that white, after so many samples.
inline float firstErrorOf(PixelTracer& tracer, int x, int y, int samples, double white) {
  PixelSum sum;
  addWave(tracer, x, y, {0, samples}, sum, [](const Color&, Real) {});
  return sum.firstErrorFor(white);
}

}  // namespace trace

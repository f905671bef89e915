// The one door for rays. Integrators ask the Tracer, never the World: here every ray is counted, the
// conventions that decide what a kind of ray sees are applied, and, when a RayTree is attached, every ray is
// recorded.
#pragma once

#include <optional>
#include <span>
#include <utility>

#include "render/rays/ray_tree.h"
#include "render/world/hit.h"
#include "render/world/world.h"
#include "scene/integrators.h"

namespace trace {

class Tracer {
 public:
  /// `tree`, if any, takes every ray from now on.
  Tracer(const World& world, const Settings& settings, RayTree* tree = nullptr)
      : world_(world), settings_(settings), traits_(traitsOf(settings)), tree_(tree) {}

  /// The first surface that a ray of this kind hits. `inside` is what the ray starts in, and becomes what it
  /// is in when it gets there: with nested glass a ray walks on through surfaces at which nothing changes.
  ///
  /// It walks on through holes, too. What is there in part is hit with this chance, if `chance` is a number
  /// drawn from 0 up to 1, and counts as a whole; where that is 0 it is hit, and Hit::opacity says its share.
  ///
  /// A ray with an `aim` samples the light of that object, or of kSky: it passes all else that casts no
  /// shadow, and panes, which filter it.
  ///
  /// `first` is what lookAhead() found for the ray, if that was asked. (The aim is a reference, since an
  /// empty optional number that is passed by value waits for its flag to reach memory.)
  std::optional<Hit> cast(const Ray& ray, RayKind kind, Interfaces& inside, Real chance = 0,
                          const std::optional<std::uint32_t>& aim = {}, const Found* first = nullptr);
  /// The first crossings of rays that will be cast, at most RayPacket::kRays.
  void lookAhead(std::span<const Ray* const> rays, RayKind kind, std::span<Found* const> found) {
    world_.closest(rays, facesSeenBy(kind), statistics_, found);
  }
  static constexpr std::uint32_t kSky = 0xffffffffu;
  /// Such a number, drawn only where something has holes.
  template <class Numbers>
  Real chance(Numbers&& numbers) const {
    return world_.hasHoles() ? numbers.next() : 0;
  }

  /// How much of each colour passes along a ray of unit direction that leaves what was hit toward a light at
  /// `distance` (may be infinite): 0 behind anything opaque, filtered by what is transmissive. `inside` is
  /// what the ray that hit it is in.
  Color visible(const Hit& from, const Ray& ray, Real distance, const Interfaces& inside);
  /// Casts a ray from a point in the open, in what is `inside`.
  Color visible(const Vec3& from, const Vec3& toLight, Real distance, const Interfaces& inside);
  /// The last shadow ray or ray with an aim passed something that casts no shadow. No ray that bounces brings
  /// that light, so this sample of it has the MIS weight 1.
  bool passedShadowless() const { return passedShadowless_; }
  /// The transmittance of the panes that the last ray with an aim passed.
  const Color& passedPanes() const { return passedPanes_; }
  /// The first hit of a ray, except for holes; counted as of that kind, and not recorded.
  std::optional<Found> look(const Ray& ray, RayKind kind) {
    count(kind);
    return behindHoles(ray, kind, statistics_);
  }

  /// The first hit before tMost of a ray that is not recorded, in a scene without holes and nested glass.
  std::optional<Found> nearest(const Ray& ray, RayKind kind, Real tMost) {
    count(kind);
    return world_.closest(ray, facesSeenBy(kind), statistics_, tMost);
  }

  /// Where it hits that object nearest to t, whatever lies before; counted and not recorded, likewise.
  std::optional<Found> lookAt(const Ray& ray, RayKind kind, std::uint32_t object, Real t);

  /// The ray hit that place, which was found otherwise: it is recorded as one that was cast.
  Hit meet(const Ray& ray, RayKind kind, const Found& found);
  /// The ray recorded last is drawn from one place to the other.
  void drawFrom(const Vec3& from, const Vec3& to);
  /// Applies the media's transmittance `passes` to the last shadow ray, which `passed`.
  Color veiled(const Color& passed, const Color& passes, std::uint32_t medium, Real distance);

  /// The media that a ray from the point starts in.
  const Interfaces& interfacesAt(const Vec3& point);
  /// While it lives, rays are roots of the tree, one after the other; then things are as before.
  class Aside {
   public:
    explicit Aside(Tracer& tracer)
        : tracer_(tracer),
          current_(std::exchange(tracer.current_, kNoNode)),
          last_(std::exchange(tracer.last_, kNoNode)) {}
    ~Aside() {
      tracer_.current_ = current_;
      tracer_.last_ = last_;
    }
    Aside(const Aside&) = delete;
    Aside& operator=(const Aside&) = delete;
    /// The next ray is a child of the one cast last.
    void goOn() { tracer_.enter(); }

   private:
    Tracer& tracer_;
    int current_, last_;
  };

  /// While it lives, rays to lights join two paths: a pane between their ends is a vertex of its own.
  class Joining {
   public:
    explicit Joining(Tracer& tracer) : tracer_(tracer) { tracer.joins_ = true; }
    ~Joining() { tracer_.joins_ = false; }
    Joining(const Joining&) = delete;
    Joining& operator=(const Joining&) = delete;

   private:
    Tracer& tracer_;
  };

  /// A RayTree takes the rays.
  bool records() const { return kRecords && tree_; }
  /// Whether shadow rays pass such a surface. Panes bend nothing, and so none is lost there.
  bool lightPasses(const Bsdf& bsdf) const {
    const WhittedTerms& terms = whitted(bsdf);
    return terms.transmits() && !gathers(bsdf) &&
           (terms.passage == Passage::straight || settings_.glassShadows != GlassShadows::black);
  }
  /// Whether rays with an aim pass such a surface. A path that comes straight through it from where it was
  /// scattered meets the same light: the two are weighed.
  bool isPane(const Bsdf& bsdf) const {
    const WhittedTerms& terms = whitted(bsdf);
    return terms.passage == Passage::straight && lightPasses(bsdf) && isBlack(terms.emissive);
  }
  /// The interior of the object that was hit, where its surface looks like `terms`.
  Filling filling(const Hit& hit, const WhittedTerms& terms) const {
    return world_.filling(hit, terms, settings_);
  }

  /// Does the camera ray hit something nearer than the camera sees?
  bool tooNear(const Ray& ray) const;

  /// The query of a recorded ray once more, for someone who watches it.
  void retrace(const RayNode& node, const NodeWatch& watch);

  const World& world() const { return world_; }
  const Settings& settings() const { return settings_; }
  Statistics& statistics() { return statistics_; }
  const Statistics& statistics() const { return statistics_; }

 private:
  friend class Gather;
  static constexpr int kNoNode = -1;  ///< nothing is recorded
#ifdef TRACE_NO_RECORDING
  static constexpr bool kRecords = false;  ///< as bench/recording.sh has it, to see what the tests below cost
#else
  static constexpr bool kRecords = true;
#endif
  static bool recorded(int node) { return kRecords && node != kNoNode; }

  void count(RayKind kind) { ++statistics_.rays[static_cast<std::size_t>(kind)]; }

  /// Rays from now on are children of the one cast last; returns its node.
  int enter() { return records() ? current_ = std::exchange(last_, kNoNode) : kNoNode; }
  void leave(int node) {
    if (recorded(node)) {
      current_ = tree_->nodes[static_cast<std::size_t>(node)].parent;
      last_ = node;
    }
  }
  void record(int node, Term term);
  void record(int node, const RayEnd& why);
  void record(int node, const Indices& indices);
  void record(int node, const Bsdf& bsdf);
  void record(int node, const std::optional<Vec3>& raised);
  void record(int node, const Color& through, const Color& radiance);
  /// A new node for a ray about to be traced; when it was, what it cost.
  void begin(const Ray& ray, RayKind kind, Real tMost, Real wavelength);
  RayNode& finish();
  std::uint64_t testsSoFar() const;

  Faces facesSeenBy(RayKind kind) const;
  /// Why a ray of the kind hit nothing: there is nothing, or only what --back-faces hides from it.
  RayEnd hiddenFrom(const Ray& ray, RayKind kind) const;
  std::optional<Found> behindHoles(const Ray& ray, RayKind kind, Statistics& statistics) const;
  template <class Nodes>
  void collect(const Ray& ray, Real tMost, Faces faces, QueryCounts<Nodes>& counts);
  template <class Nodes>
  bool occluded(const Ray& ray, Real tMost, QueryCounts<Nodes>& counts);
  void sortCrossed();
  std::optional<Found> walk(const Ray& ray, RayKind kind, Found found, Interfaces& inside, Real chance,
                            const std::optional<std::uint32_t>& aim);
  bool ignored(const Ray& ray, const Found& found, Interfaces& inside, Real& chance);
  bool passesShadowless(const Found& found, std::uint32_t aim);
  bool passesPane(const Ray& ray, const Found& found);
  /// Rays to lights pass the place. Those that join two paths do not: it is a vertex of its own.
  bool isShadowless(const Found& found) const { return !joins_ && !world_.castsShadow(found); }
  Interfaces startOn(const Hit& from, const Ray& ray, const Interfaces& inside);
  Color visibleAlong(const Ray& ray, Real distance, Interfaces* inside, Real wavelength);
  /// Photons, or paths from lights, bring the light that the glass bends: to surfaces only, where light is
  /// not traced in media. Rays that bounce sample the lobe of rough glass, and lights where they hit
  /// something: a shadow ray through it would count these twice.
  bool gathers(const Bsdf& bsdf) const {
    if (joins_ || (traits_.has(Trait::bounces) && isGlossy(bsdf))) return true;
    if (whitted(bsdf).passage == Passage::straight) return false;
    return traits_.has(Trait::bringsCaustics) && (traits_.has(Trait::scattersInMedia) || !midair_);
  }
  Color passed(const Ray& ray, Real distance, Interfaces* inside);
  [[gnu::noinline]] Color filtered(const Ray& ray, Real distance, Interfaces* inside);
  std::optional<Blocked> nearestBlocker(const Ray& ray, Real distance) const;

  const World& world_;
  const Settings& settings_;
  Traits traits_;
  RayTree* tree_;
  int current_ = kNoNode;  ///< the ray being followed
  int last_ = kNoNode;     ///< the one cast or left last, until a term takes it
  Statistics statistics_;
  bool midair_ = false;  // the shadow ray starts where no surface is
  bool joins_ = false;   // it ends at a vertex of another path
  bool passedShadowless_ = false;
  Color passedPanes_{1};
  std::vector<Found> crossed_;                        // crossings of one ray; kept to save allocations
  std::optional<std::pair<Vec3, Interfaces>> start_;  // start at the last point that was asked for
};

}  // namespace trace

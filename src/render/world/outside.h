// The environment: the colour of rays that hit nothing. What lies nearer hides what lies behind it:
//
//   camera rays: the backdrop, the environment, the panorama, the daylight sky, the gradient, the bands
//   other rays:               the environment, the panorama, the daylight sky, the gradient; or nothing:
//   black
//
// The panorama is the six pictures of the scene's background; where there is none, and through their
// transparency, what lies behind is seen.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "render/world/ray_kind.h"
#include "render/world/sky_sums.h"
#include "scene/scene.h"
#include "shading/optics/daylight.h"

namespace trace {

class Outside {
 public:
  enum class Source { nothing, backdrop, environment, panorama, sky, gradient, bands };
  static constexpr std::array<std::string_view, 7> kNames{"nothing", "backdrop", "environment", "panorama",
                                                          "sky",     "gradient", "bands"};
  /// The result for one ray.
  struct View {
    Source source = Source::nothing;
    /// An environment: the place in its picture, (0, 0) at the top left of it or of the face. A backdrop or
    /// bands: the place in the picture that is rendered, from the top left. The rest: the elevation in
    /// degrees, as y.
    Vec2 place;
    int face = -1;  ///< face of a cube: index into EnvironmentMap::kFaceNames
    Vec3 direction;
    Color color;
  };

  Outside() = default;
  /// Holds what the scene's surroundings hold.
  Outside(const Scene& scene, const Settings& settings, const CameraFrame& camera);

  /// Rays of the kind see something there, though it may be black.
  bool isSeenBy(RayKind kind) const {
    return kind == RayKind::camera ? !transparent_ : panorama_ || sky_ != Source::nothing;
  }
  /// Rays other than the camera's surely see one colour in all directions.
  bool isEven() const;
  /// Where they see a gradient alone: an upper bound, to about 1 %, of the luminance of its brightest colour
  /// over the mean of all directions. Infinite for other sources.
  Real unevennessOfGradient() const;
  /// The sums of what they see, made when this is first called.
  std::shared_ptr<const SkySums> skySums(int threads) const;
  /// Shares the sums of the other, an earlier environment, if they are equal.
  void shareSkySums(const Outside& other);
  /// Its direction has length 1.
  View view(const Ray& ray, RayKind kind) const;

 private:
  /// The colour that the ray sees of that source.
  View seen(Source source, const Ray& ray) const;
  /// Against the rotation.
  Vec3 turnedBack(const Vec3& direction) const;

  CameraFrame camera_{};
  Background background_;
  std::shared_ptr<const Picture> backdrop_;
  std::shared_ptr<const EnvironmentMap> environment_;
  std::optional<Daylight> daylight_;
  bool transparent_ = false;      ///< camera rays see nothing: the picture is transparent there
  bool panorama_ = false;         ///< there is one, and no environment before it
  Source sky_ = Source::nothing;  ///< what else is all around: at most one of the rest
  Vec2 turn_{1, 0};               ///< cosine and sine of the rotation
  Real brightness_ = 1;
  std::shared_ptr<LazySkySums> skySums_ = std::make_shared<LazySkySums>();
};

/// In words: "environment, face right at (0.25, 0.5)", for a message of a ray that left the scene.
std::string sentence(const Outside::View& view);

}  // namespace trace

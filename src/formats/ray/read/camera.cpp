#include "formats/ray/read/camera.h"

#include <cmath>
#include <optional>

#include "base/text.h"
#include "formats/directions.h"
#include "formats/ray/read/fields.h"
#include "math/elementary.h"

namespace trace::rayfile {
namespace {

class CameraReader {
 public:
  explicit CameraReader(Findings& findings) : findings_(findings) {}

  Camera read(const Item& block) {
    const std::size_t before = findings_.errors();
    RepeatedFields repeats(findings_, Camera::kKeyword);
    for (const Item item : block) {
      if (item.keyed()) repeats.note(item);
      field(item);
    }
    if (!aspect_ && findings_.isOfKind()) camera_.aspectratio = kUsualAspect;
    if (findings_.errors() == before) direct();
    KindGiven& given = findings_.given();
    given.cameraPosition = position_;
    given.cameraDirection = viewdir_ || lookAt_ || turned_;
    given.aspect = aspect_;
    given.horizontalFov = horizontalFov_ > 0;
    if (lookAt_) given.lookAt = target_;
    if (!(camera_.near < camera_.far))
      findings_.warn(block, "camera: expected near to be less than far, found " + toText(camera_.near) +
                                " and " + toText(camera_.far) + ": nothing is seen");
    if (horizontalFov_ > 0 && findings_.errors() == before)
      camera_.fov = math::atan(math::tan(horizontalFov_ * kPi / 360) / camera_.aspectratio) * 360 / kPi;
    return camera_;
  }

 private:
  void field(const Item& item) {
    if (!item.keyed()) return findings_.expected(item, Camera::kKeyword, "a field, as in fov = 45");
    const std::string_view key = canonical(item.key());
    if (key == "quaternian") return quaternion(item);
    if (key == "horizontal_fov") {
      if (rayfile::read(findings_, key, item.value(), horizontalFov_) &&
          !(horizontalFov_ > 0 && horizontalFov_ < 180))
        findings_.expected(item.value(), key, "an angle between 0 and 180 degrees");
      if (hasFov_) findings_.warn(item, "fov is ignored, since horizontal_fov is given");
      return;
    }
    if (key == "look_at") {
      rayfile::read(findings_, key, item.value(), target_);
      lookAt_ = item;
      return;
    }
    if (!assignField(findings_, camera_, item)) return unknown(item);
    checkRange(findings_, camera_, item);
    if (key == "fov") {
      hasFov_ = true;
      if (horizontalFov_ > 0) findings_.warn(item, "fov is ignored, since horizontal_fov is given");
    }
    if (key == "position" && !isShorter(camera_.position))
      findings_.expected(item.value(), key, "a place at most 1e75 from the origin");
    if ((key == "viewdir" && !isLength(camera_.viewdir)) || (key == "updir" && !isLength(camera_.updir)))
      findings_.expected(item.value(), key, "a direction between 1e-75 and 1e75 long");
    if (key == "position") position_ = true;
    if (key == "aspectratio") aspect_ = true;
    if (key == "viewdir") viewdir_ = item;
    if (key == "updir") updir_ = item;
    if (key == "fov" && item.value().is(Kind::number) && !(camera_.fov > 0 && camera_.fov < 180))
      findings_.expected(item.value(), key, "an angle between 0 and 180 degrees");
    if (key == "aspectratio" && item.value().is(Kind::number) && !(camera_.aspectratio > 0))
      findings_.expected(item.value(), key, "a number above 0, width / height");
  }

  // Numbers of a World can be squared (render/world/number_range.h). They are checked here, where the place
  // is known.
  static bool isShorter(const Vec3& v) { return maxComponent(abs(v)) <= 1e75; }
  static bool isLength(const Vec3& v) {
    return v == Vec3{} || (isShorter(v) && maxComponent(abs(v)) >= 1e-75);  // 0 is refused as no direction
  }

  void unknown(const Item& item) {
    if (item.key() == "focaldistance") {
      findings_.signOf2001(item);
      return findings_.warn(item, "focaldistance of camera is ignored: everything is in focus");
    }
    findings_.unknownField(Camera::kKeyword, item,
                           keywords<Camera>({"horizontal_fov", "look_at", "quaternian"}));
  }

  /// (x, y, z, w), the real part last: turns the default camera. viewdir and updir override it.
  void quaternion(const Item& item) {
    if (item.key() == "quaternion")
      findings_.signOf2001(item);
    else
      findings_.sureSignOf2005();
    Real q[4];
    if (!numbers(item.value(), q, 4)) return findings_.expected(item.value(), item.key(), "(x, y, z, w)");
    const Vec3 axis{q[0], q[1], q[2]};
    const Real sine = math::hypot(axis.x, axis.y, axis.z), norm = math::hypot(sine, q[3]);
    if (!(norm > 0 && std::isfinite(norm)))
      return findings_.expected(item.value(), item.key(), "a quaternion that is not zero");
    Affine turn;
    if (sine > 0) turn = Affine::rotation(axis / sine, 2 * math::atan2(sine, q[3]));
    turned_ = true;
    if (!viewdir_) camera_.viewdir = linear(turn, {0, 0, -1});
    if (!updir_) camera_.updir = linear(turn, {0, 1, 0});
  }

  /// Settles viewdir and updir from all that was given.
  void direct() {
    if (lookAt_) {
      if (viewdir_) findings_.warn(*viewdir_, "viewdir is ignored, since look_at is given");
      if (findings_.isOfKind() && !position_) return;  // the place follows (formats/kind_defaults.h)
      camera_.viewdir = target_ - camera_.position;
      if (!hasDirection(camera_.viewdir))
        return findings_.expected(lookAt_->value(), "look_at", "a point other than the camera's position");
      camera_.viewdir =
          normalize(camera_.viewdir);  // where axes are used raw, its length is not the distance
      const bool vertical = camera_.viewdir.x == 0 && camera_.viewdir.z == 0;
      if (!updir_) camera_.updir = vertical ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    } else if (viewdir_ && !updir_ && findings_.isOfKind()) {
      const bool vertical = camera_.viewdir.x == 0 && camera_.viewdir.z == 0;
      camera_.updir = vertical ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    } else if (viewdir_.has_value() != updir_.has_value()) {
      findings_.error(viewdir_ ? *viewdir_ : *updir_,
                      viewdir_ ? "viewdir: expected updir as well" : "updir: expected viewdir as well",
                      viewdir_ ? "add the up direction, as in updir = (0, 1, 0)" : "");
      return;
    }
    if (viewdir_ && !hasDirection(camera_.viewdir))
      return findings_.expected(viewdir_->value(), "viewdir", "a direction");
    if (updir_ && !hasDirection(camera_.updir))
      return findings_.expected(updir_->value(), "updir", "a direction");
    if (updir_ && parallel(camera_.viewdir, camera_.updir))
      findings_.expected(updir_->value(), "updir", "a direction that is not parallel to the view");
  }

  Findings& findings_;
  Camera camera_;
  Vec3 target_;
  Real horizontalFov_ = 0;  ///< degrees; 0: not given
  bool hasFov_ = false, position_ = false, aspect_ = false, turned_ = false;
  std::optional<Item> viewdir_, updir_, lookAt_;
};

}  // namespace

Camera readCamera(Findings& findings, const Item& block) { return CameraReader(findings).read(block); }

}  // namespace trace::rayfile

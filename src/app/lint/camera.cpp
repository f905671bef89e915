// The checks of the camera, and of mirrors and glass that show it black.
#include <algorithm>
#include <iterator>
#include <string>

#include "app/lint/checks.h"
#include "base/text.h"
#include "math/box.h"

namespace trace::lint_checks {
namespace {

/// Some side of the picture, or the plane of the eye, has the whole box beyond it.
bool isOutside(const CameraFrame& camera, const Box3& box) {
  if (camera.optics.projection != Projection::perspective) return false;
  const Vec3 forward = cross(camera.right, camera.up);
  const Vec3 ahead = dot(forward, camera.look) < 0 ? -forward : forward;
  const Vec3 left = camera.look - camera.right * 0.5, right = camera.look + camera.right * 0.5;
  const Vec3 below = camera.look - camera.up * 0.5, above = camera.look + camera.up * 0.5;
  const auto inward = [&](const Vec3& normal) { return dot(normal, camera.look) < 0 ? -normal : normal; };
  const Vec3 sides[] = {ahead, inward(cross(left, camera.up)), inward(cross(right, camera.up)),
                        inward(cross(below, camera.right)), inward(cross(above, camera.right))};
  return std::any_of(std::begin(sides), std::end(sides), [&](const Vec3& side) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 at{corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                    corner & 4 ? box.high.z : box.low.z};
      if (dot(at - camera.eye, side) >= 0) return false;
    }
    return true;
  });
}

}  // namespace

void cameraInside(const LintScene& s, Findings& findings) {
  const auto others = [&](std::uint32_t object) {
    int places = 0;
    for (std::uint32_t i = 0; i < s.survey.objects.size(); ++i)
      if (i != object) places += s.survey.objects[i].places;
    return places;
  };
  for (std::uint32_t object : s.aroundCamera) {
    const bool glass = !s.world.opaque(object);
    const Survey::Seen& seen = s.survey.objects[object];
    if (!glass && seen.lit > 0 && seen.direct == 0 && seen.facesAway >= seen.places && seen.couldBeLit > 0 &&
        isBlack(s.world.termsOf(object).emissive))
      warn(findings, "unlit", placeOf(s, object),
           "the camera is inside " + quoted(s, object) +
               ", whose faces look outward: lights in it do not light its walls, which have ambient light "
               "alone",
           "build a room of squares, or of a mesh whose faces look inward, or cut it out of a larger solid "
           "by a difference");
    if (!glass && (seen.lit > 0 || others(object) > 0)) continue;  // a room
    warn(findings, "camera-inside", placeOf(s, object),
         "the camera is inside " + quoted(s, object) +
             (glass ? ": it sees everything through the surface"
                    : ": it sees only the inside, which no light reaches"),
         "move the camera's position out of it");
  }
}

void cameraLooksAway(const LintScene& s, Findings& findings) {
  if (s.scene.objects.empty() || s.survey.met > 0) return;
  const SourcePlace& place = s.remarks.camera;
  const CameraFrame& camera = s.world.camera();
  if (s.survey.cutOff > 0) {
    warn(findings, "camera-looks-away", place,
         "nothing is visible: the objects in front of the camera are not between its near and far, " +
             toText(camera.near) + " and " + toText(camera.far),
         "`near` and `far` of the camera limit its range; without them it sees all");
    return;
  }
  Box3 all;
  for (const Object& object : s.scene.objects) {
    const Box3 box = boxAround(object);
    if (box.empty() || box.unbounded()) continue;  // what has no end is hit if it is in sight
    if (!isOutside(camera, box)) return;           // it may be small
    all.extend(box);
  }
  const Vec3 middle = all.center();
  const bool known = !all.empty() && s.scene.format == "ray";
  warn(findings, "camera-looks-away", place,
       "the camera faces away from everything: nothing is in the picture",
       known ? "look_at = (" + toText(roundedTo(middle.x)) + ", " + toText(roundedTo(middle.y)) + ", " +
                   toText(roundedTo(middle.z)) + "); in place of viewdir points it at the middle of the scene"
             : "turn it, or move it back");
}

void blackReflection(const LintScene& s, Findings& findings) {
  constexpr int kFew = 20;
  for (std::uint32_t object = 0; object < s.survey.objects.size(); ++object) {
    const Survey::Seen& seen = s.survey.objects[object];
    if (seen.leftScene < kFew || 2 * seen.leftScene < seen.sent) continue;
    const bool mirrors = 2 * seen.mirroredAway >= seen.leftScene;
    warn(findings, "black-reflection", placeOf(s, object),
         quoted(s, object) + (mirrors ? " reflects black" : " shows black") +
             " where it should show the background: only camera rays see that",
         "every ray sees a `gradient` in `background`, a daylight sky and the picture of --environment; or "
         "put objects where it " +
             std::string(mirrors ? "mirrors" : "shows") + " nothing");
  }
}

}  // namespace trace::lint_checks

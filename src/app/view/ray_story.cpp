#include "app/view/ray_story.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/explain/ray_segments.h"
#include "app/explain/ray_view.h"
#include "app/view/panel.h"
#include "app/view/room.h"
#include "app/view/scene_model.h"
#include "image/codecs/animated_png.h"
#include "image/development/development.h"
#include "math/elementary.h"

namespace trace {
namespace {

constexpr double kWide = 760, kHigh = 540, kMargin = 16, kRowHigh = 20, kTree = 440;
constexpr double kLetter = 7.6;  // width of a letter, about, in words of the usual height

/// As much of the words as has room.
std::string cut(const std::string& words, double room) {
  const auto most = static_cast<std::size_t>(std::max(room / kLetter, 3.0));
  return words.size() <= most ? words : words.substr(0, most - 2) + "..";
}

DrawnPicture swatch(const Point2& at, const Color& color) {
  constexpr int kSide = 14;
  Picture square(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool rim = x == 0 || y == 0 || x == kSide - 1 || y == kSide - 1;
      square.at(x, y) = rim ? Color(0.5) : color;
    }
  return {at, std::move(square)};
}

World worldFrom(const TracedPixel& pixel, const Camera& view) {
  Scene scene = pixel.scene();
  scene.camera = view;
  const Settings& settings = pixel.session->settings();
  Messages ignored;  // said before, of the same scene
  const Compiled here{pixel.scene(), settings, pixel.session->worldOf(pixel.tree())};
  return compile(scene, plainView(settings), ignored, &here);
}

}  // namespace

Camera cameraOf(const CameraFrame& frame, Real aspect) {
  Camera camera;
  camera.position = frame.eye;
  camera.viewdir = normalize(frame.look);
  camera.updir = normalize(frame.up);
  camera.fov = 2 * math::atan(length(frame.up) / (2 * length(frame.look))) * 180 / kPi;
  camera.aspectratio = aspect;
  return camera;
}

Color shownColour(const Color& light, const Settings& settings) {
  return clamp01(developed(light, developmentOf(settings)));
}

RayStory::RayStory(const TracedPixel& pixel, const Camera& view) : pixel_(pixel) {
  Camera camera = view;
  camera.aspectratio = kWide / kHigh;
  const World world = worldFrom(pixel, camera);
  const Vec3& inside = pixel.scene().camera.position;
  frame_ = world.camera();
  surfaces_ = sketch(world, wallsAround(world, inside, frameOf(pixel.scene())), inside,
                     {kMargin, kMargin + 1.5 * kRowHigh}, kWide, kHigh);
}

Drawing RayStory::after(int rays) const {
  Drawing drawing;
  drawing.width = static_cast<int>(kWide + kTree + 3 * kMargin);
  drawing.height = static_cast<int>(kHigh + 2 * kMargin + 5 * kRowHigh);
  drawing.things.push_back(DrawnWords{{kMargin, kMargin},
                                      "pixel " + std::to_string(pixel_.x) + "," + std::to_string(pixel_.y) +
                                          ", " + std::to_string(std::min(rays, this->rays())) + " of " +
                                          std::to_string(this->rays()) + " rays",
                                      kInk});
  addSpace(drawing, rays);
  addTree(drawing, rays);
  addSum(drawing, rays);
  return drawing;
}

void RayStory::addSpace(Drawing& drawing, int rays) const {
  const Panel panel(frame_, surfaces_.at, kWide, kHigh);
  const RayTree& tree = pixel_.tree();
  const Real whole = std::max(maxComponent(tree.nodes.front().weight), 1e-30);
  drawing.things.push_back(panel.frame());
  drawing.things.push_back(surfaces_);
  for (const bool shadows : {true, false})  // below, so that they hide no others
    for (const RaySegment& segment : pixel_.segments) {
      const RayNode& node = rayAt(tree, segment.node);
      if (segment.node >= rays || (node.kind == RayKind::shadow) != shadows) continue;
      const Real share = std::clamp(maxComponent(node.weight) / whole, 0.0, 1.0);
      const double width = 1.5 + 3.5 * std::sqrt(share) + (segment.node == rays - 1 ? 1.5 : 0);
      panel.line(drawing, segment.from, segment.to, look(segment.looks).color, width, segment.leaves);
      if (node.hit) panel.disk(drawing, node.hit->surface.point, 4, look(segment.looks).color);
    }
  panel.disk(drawing, tree.nodes.front().ray.origin, 5, kInk);
  drawing.things.push_back(
      DrawnFrame{{0, 0}, static_cast<double>(drawing.width), static_cast<double>(drawing.height)});
}

void RayStory::addTree(Drawing& drawing, int rays) const {
  constexpr double kIndent = 14, kShare = 60;
  constexpr int kMostLevels = 10;
  const double left = kWide + 2 * kMargin, top = kMargin + 1.5 * kRowHigh;
  const int rows = static_cast<int>(kHigh / kRowHigh), last = std::min(rays, this->rays());
  const int first = std::max(0, last - rows);  // the latest
  for (int i = first; i < last; ++i) {
    const RayLook& looks = look(pixel_.looks(i));
    const double y = top + kRowHigh * (i - first),
                 x = left + kIndent * std::min(pixel_.level[static_cast<std::size_t>(i)], kMostLevels);
    drawing.things.push_back(DrawnLine{{x, y + 7}, {x + 12, y + 7}, looks.color, 4});
    const std::string met = metBy(pixel_.tree(), pixel_.scene(), i);
    const double room = left + kTree - kShare - x - 20;
    drawing.things.push_back(
        DrawnWords{{x + 20, y}, cut(std::string(looks.name) + (met.empty() ? "" : ": " + met), room), kInk});
    const RayNode& node = rayAt(pixel_.tree(), i);
    if (node.kind == RayKind::shadow || node.kind == RayKind::light) continue;
    char text[24];
    std::snprintf(text, sizeof text, "%.4f", share(node));
    drawing.things.push_back(DrawnWords{{left + kTree - kShare, y}, text, kInk});
  }
}

void RayStory::addSum(Drawing& drawing, int rays) const {
  const Session& session = *pixel_.session;
  const bool all = rays >= this->rays();
  double x = kMargin, y = kMargin + 2 * kRowHigh + kHigh;
  const double most = drawing.width - kMargin;
  const std::string last = rays < 1 ? "" : sentence(rayAt(pixel_.tree(), rays - 1), pixel_.scene());
  const std::string said = all ? pixel_.why.sentence : last;
  drawing.things.push_back(DrawnWords{{x, y}, cut(said, most - x), kInk});
  y += 1.2 * kRowHigh;
  const auto add = [&](const Color& light, const std::string& words) {
    const double wide = 24 + kLetter * static_cast<double>(words.size() + 2);
    if (x + wide > most && x > kMargin) x = kMargin, y += kRowHigh;
    drawing.things.push_back(swatch({x, y}, shownColour(light, session.settings())));
    drawing.things.push_back(DrawnWords{{x + 20, y}, cut(words, most - x - 20), kInk});
    x += wide;
  };
  const std::vector<WhySummand>& sum = pixel_.why.sum;
  const Color whole = all ? pixel_.tree().nodes.front().radiance : sumAfter(sum, rays);
  add(whole, channels(whole) + (sum.empty() ? "" : "  ="));
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (all || sum[i].last < rays)
      add(sum[i].color, sum[i].name + " " + channels(sum[i].color) + (i + 1 < sum.size() ? "  +" : ""));
}

std::string filmOf(const RayStory& story) {
  constexpr int kMostPictures = 60;
  constexpr double kEach = 0.7, kLast = 4;  // seconds
  AnimatedPng film;
  const int step = std::max(1, (story.rays() + kMostPictures - 1) / kMostPictures);
  for (int rays = step; rays < story.rays(); rays += step)
    film.add(toBytes(toPicture(story.after(rays)), Rounding::nearest), kEach);
  film.add(toBytes(toPicture(story.after(story.rays())), Rounding::nearest), kLast);
  return film.finish();
}

}  // namespace trace

#include "app/view/ray_story.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/editing/folder.h"
#include "app/explain/ray_segments.h"
#include "app/explain/ray_view.h"
#include "app/explain/ray_words.h"
#include "app/view/panel.h"
#include "app/view/space/room.h"
#include "app/view/space/scene_model.h"
#include "base/error.h"
#include "base/files/file.h"
#include "image/codecs/animated_png.h"
#include "image/development/development.h"
#include "image/letters.h"
#include "math/elementary.h"

namespace trace {
namespace {

constexpr double kHigh = 600, kSheetMargin = 16, kRowHigh = 24, kLetters = 17;
constexpr double kAdds = 74, kEnded = 190, kTree = 620;    // widths of two columns, and of the whole tree
constexpr int kRows = static_cast<int>(kHigh / kRowHigh);  // rows of the tree next to the view
constexpr int kMostRows = 400;                             // rows of the tree in a drawing of all rays

/// A program that ignores the length of an SVG's text may show letters a little wider than ours.
double wideOf(const std::string& words) { return 1.1 * lettersWidth(words, kLetters); }

/// As much of the words as has room.
std::string cut(const std::string& words, double room) {
  if (wideOf(words) <= room) return words;
  std::string some = words;
  while (some.size() > 1 && wideOf(some + "..") > room) some.pop_back();
  return some + "..";
}

DrawnWords wordsAt(const Point2& at, const std::string& words) { return {at, words, kInk, kLetters}; }

/// The colour of a light, dark enough to be seen on white.
Color inkOf(const Light& light) {
  const Color* color = light.color();
  return color ? clamp01(*color / std::max(maxComponent(*color), 1e-9)) * 0.8 : Color(0.5);
}

DrawnPicture swatch(const Point2& at, const Color& color) {
  constexpr int kSide = 17;
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
  constexpr Real kNarrowest = 0.8, kWidest = 2.2;
  Camera camera = view;
  camera.aspectratio = std::clamp(view.aspectratio, kNarrowest, kWidest);
  wide_ = std::round(kHigh * camera.aspectratio);
  const World world = worldFrom(pixel, camera);
  const Vec3& inside = pixel.scene().camera.position;
  frame_ = world.camera();
  surfaces_ = colouredSketch(world, pixel.scene(), wallsAround(world, inside, frameOf(pixel.scene())), inside,
                             {kSheetMargin, kSheetMargin + 1.5 * kRowHigh}, wide_, kHigh);
}

Drawing RayStory::after(int rays, double grown) const {
  return drawn(std::clamp(rays, 0, this->rays()), kRows, grown);
}

Drawing RayStory::whole() const { return drawn(rays(), std::clamp(rays(), kRows, kMostRows), 1); }

Drawing RayStory::drawn(int rays, int rows, double grown) const {
  Drawing drawing;
  drawing.width = static_cast<int>(wide_ + kTree + 3 * kSheetMargin);
  drawing.height =
      static_cast<int>(std::max(kHigh + 5 * kRowHigh, (rows + 2.5) * kRowHigh) + 2 * kSheetMargin);
  const std::string sample = sampleText(pixel_);
  drawing.things.push_back(wordsAt({kSheetMargin, kSheetMargin},
                                   "pixel " + std::to_string(pixel_.x) + "," + std::to_string(pixel_.y) +
                                       (sample.empty() ? "" : ", " + sample) + ", " + std::to_string(rays) +
                                       " of " + std::to_string(this->rays()) + " rays"));
  const int known = grown < 1 ? rays - 1 : rays;  // a ray that grows has come to nothing yet
  const bool beside = rows > kRows;  // the tree is longer than the view, and the sum is beside it
  const double end =
      addSum(drawing, known, beside ? wide_ + kSheetMargin : drawing.width - kSheetMargin) + kSheetMargin;
  if (beside) drawing.height = std::max(drawing.height, static_cast<int>(end));
  addSpace(drawing, rays, grown);
  addTree(drawing, rays, rows, known);
  return drawing;
}

void RayStory::addSpace(Drawing& drawing, int rays, double grown) const {
  const Panel panel(frame_, surfaces_.at, wide_, kHigh);
  const RayTree& tree = pixel_.tree();
  const Real whole = std::max(maxComponent(tree.nodes.front().weight), 1e-30);
  drawing.things.push_back(panel.frame());
  drawing.things.push_back(surfaces_);
  addLights(drawing, panel);
  addCamera(drawing, panel);
  for (const bool shadows : {true, false})  // below, so that they hide no others
    for (RaySegment segment : pixel_.segments) {
      const RayNode& node = rayAt(tree, segment.node);
      if (segment.node >= rays || (node.kind == RayKind::shadow) != shadows) continue;
      const bool grows = segment.node == rays - 1 && grown < 1;
      if (grows) segment.to = segment.from + (segment.to - segment.from) * grown;
      const Real share = std::clamp(maxComponent(node.weight) / whole, 0.0, 1.0);
      const double width = 1.5 + 3.5 * std::sqrt(share) + (segment.node == rays - 1 ? 1.5 : 0);
      if (node.kind == RayKind::camera)  // a rim, so that it is seen on dark surfaces, too
        panel.line(drawing, segment.from, segment.to, Color(1), width + 3, segment.leaves);
      panel.line(drawing, segment.from, segment.to, look(segment.looks).color, width, segment.leaves);
      panel.arrowHead(drawing, segment.from, segment.to, look(segment.looks).color, 8 + 2 * width,
                      node.kind == RayKind::camera ? 1.5 : 0);
      if (node.hit && !grows) panel.disk(drawing, node.hit->surface.point, 4, look(segment.looks).color);
    }
  panel.disk(drawing, tree.nodes.front().ray.origin, 5, kInk);
  drawing.things.push_back(
      DrawnFrame{{0, 0}, static_cast<double>(drawing.width), static_cast<double>(drawing.height)});
}

namespace {

/// The mark of a light that lies beyond the view.
void addBeyond(Drawing& drawing, const Panel& panel, const Point2& toward, const Color& color) {
  constexpr double kSide = 9;  // pixels
  const Point2 at = panel.edgeAt(toward, 2 * kSide);
  const double x = toward.x * kSide, y = toward.y * kSide;
  const auto head = [&](double size, const Color& tint) {
    drawing.things.push_back(DrawnTriangle{{at.x + 1.6 * size * x, at.y + 1.6 * size * y},
                                           {at.x - 0.7 * size * y, at.y + 0.7 * size * x},
                                           {at.x + 0.7 * size * y, at.y - 0.7 * size * x},
                                           tint});
    drawing.things.push_back(DrawnDisk{at, 0.5 * size * kSide, tint});
  };
  head(1.2, kInk);
  head(1, color);
}

/// The star of a light at that place.
void addStar(Drawing& drawing, const Point2& at, const Color& color) {
  constexpr int kBeams = 8;
  constexpr double kInner = 7, kOuter = 15;  // pixels
  for (int i = 0; i < kBeams; ++i) {
    const double x = math::cos(2 * kPi * i / kBeams), y = math::sin(2 * kPi * i / kBeams);
    const Point2 from{at.x + x * kInner, at.y + y * kInner}, to{at.x + x * kOuter, at.y + y * kOuter};
    drawing.things.push_back(DrawnLine{from, to, kInk, 4});
    drawing.things.push_back(DrawnLine{from, to, color, 2});
  }
  drawing.things.push_back(DrawnDisk{at, 5, kInk});
  drawing.things.push_back(DrawnDisk{at, 4, color});
}

/// Three arrows side by side, along the light; false if they do not lie in the view.
bool addArrows(Drawing& drawing, const Panel& panel, const Vec3& from, const Vec3& to, const Vec3& side,
               const Color& color) {
  constexpr double kHead = 11;  // pixels
  std::array<std::array<Point2, 2>, 3> arrows;
  for (std::size_t i = 0; i < arrows.size(); ++i) {
    const Vec3 aside = side * (static_cast<Real>(i) - 1);
    const auto tail = panel.placeOf(from + aside), tip = panel.placeOf(to + aside);
    if (!tail || !tip) return false;
    arrows[i] = {*tail, *tip};
  }
  for (const auto& [tail, tip] : arrows) {
    const double far = std::max(math::hypot(tip.x - tail.x, tip.y - tail.y), 1e-6);
    const double x = (tip.x - tail.x) / far * kHead, y = (tip.y - tail.y) / far * kHead;
    drawing.things.push_back(DrawnLine{tail, tip, kInk, 4});
    drawing.things.push_back(DrawnLine{tail, tip, color, 2});
    drawing.things.push_back(DrawnTriangle{{tip.x + 0.5 * x, tip.y + 0.5 * y},
                                           {tip.x - x - y / 2, tip.y - y + x / 2},
                                           {tip.x - x + y / 2, tip.y - y - x / 2},
                                           color});
  }
  return true;
}

}  // namespace

/// Lights that have a place or a direction: their symbols, or marks at the edge of the view.
void RayStory::addLights(Drawing& drawing, const Panel& panel) const {
  constexpr std::size_t kMostBeyond = 16;  // more would be a frame of marks
  const Scene& scene = pixel_.scene();
  const RayNode& first = pixel_.tree().nodes.front();
  const Vec3 target =
      first.hit ? first.hit->surface.point : frame_.eye + frame_.look * length(first.ray.origin - frame_.eye);
  for (const LightSource& source : scene.lights) {
    const Vec3 *position = source.light.position(), *direction = source.light.direction();
    const Color color = inkOf(source.light);
    const Real far = length(target - frame_.eye);
    if (!position && !direction) continue;
    if (const auto at = position ? panel.placeOf(*position) : std::nullopt) {
      addStar(drawing, *at, color);
      continue;
    }
    if (!position) {
      const Vec3 ahead = normalize(*direction), across = cross(ahead, target - frame_.eye);
      const Vec3 side = length(across) > 1e-6 * far ? normalize(across) : normalize(frame_.right);
      bool shown = false;
      for (const Real share : {0.4, 0.25, 0.15, 0.08})
        if (!shown)
          shown = addArrows(drawing, panel, target - ahead * (share * far),
                            target - ahead * (0.5 * share * far), side * (0.15 * share * far), color);
      if (shown) continue;
    }
    const auto toward = panel.toward(position ? *position : target - normalize(*direction) * far);
    if (toward && scene.lights.size() <= kMostBeyond) addBeyond(drawing, panel, *toward, color);
  }
}

void RayStory::addCamera(Drawing& drawing, const Panel& panel) const {
  const RayNode& first = pixel_.tree().nodes.front();
  const CameraFrame own = frame(pixel_.scene().camera, pixel_.session->settings().cameraAxes);
  const Real far = first.hit ? length(first.hit->surface.point - own.eye) : length(frame_.eye - own.eye);
  const Real reach = 0.25 * far / std::max(length(own.look), 1e-30);
  std::array<Vec3, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    const Real x = i == 0 || i == 3 ? -0.5 : 0.5, y = i < 2 ? -0.5 : 0.5;
    corners[i] = own.eye + (own.look + own.right * x + own.up * y) * reach;
  }
  for (const bool rim : {true, false})  // seen on dark surfaces, too
    for (std::size_t i = 0; i < 4; ++i) {
      const Color color = rim ? Color(1) : kInk;
      const double width = rim ? 3.5 : 1.5;
      panel.line(drawing, own.eye, corners[i], color, width, false);
      panel.line(drawing, corners[i], corners[(i + 1) % 4], color, width, false);
    }
}

void RayStory::addTree(Drawing& drawing, int rays, int rows, int known) const {
  constexpr double kIndent = 14;
  constexpr int kMostLevels = 10;
  const double left = wide_ + 2 * kSheetMargin, top = kSheetMargin + 1.5 * kRowHigh;
  const double adds = left + kTree - kAdds - kEnded, ended = left + kTree - kEnded;
  const bool all = rays == this->rays() && rows > kRows;
  const int first = all ? 0 : std::max(0, rays - rows);  // the latest
  const int last = std::min(rays, first + rows);
  if (last < rays)
    drawing.things.push_back(
        wordsAt({left, top + kRowHigh * rows}, "and " + std::to_string(rays - last) + " more"));
  drawing.things.push_back(wordsAt({left, kSheetMargin}, "ray: what it hit"));
  drawing.things.push_back(wordsAt({adds, kSheetMargin}, "adds"));
  drawing.things.push_back(wordsAt({ended, kSheetMargin}, "ended"));
  for (int i = first; i < last; ++i) {
    const RayLook& looks = look(pixel_.looks(i));
    const double y = top + kRowHigh * (i - first),
                 x = left + kIndent * std::min(pixel_.level[static_cast<std::size_t>(i)], kMostLevels);
    drawing.things.push_back(DrawnLine{{x, y + 9}, {x + 12, y + 9}, looks.color, 4});
    const std::string met = i < known ? metBy(pixel_.tree(), pixel_.scene(), i) : "";
    drawing.things.push_back(
        wordsAt({x + 20, y}, cut(std::string(looks.name) + (met.empty() ? "" : ": " + met), adds - x - 28)));
    const RayNode& node = rayAt(pixel_.tree(), i);
    if (i >= known) continue;
    drawing.things.push_back(wordsAt({ended, y}, cut(shortEnd(node), kEnded)));
    if (node.kind == RayKind::light || !pixel_.isKnown(i, known)) continue;
    char text[24];
    std::snprintf(text, sizeof text, "%.4f", share(pixel_.tree(), i));
    drawing.things.push_back(wordsAt({adds, y}, text));
  }
}

double RayStory::addSum(Drawing& drawing, int rays, double most) const {
  const Session& session = *pixel_.session;
  const bool all = rays >= this->rays();
  double x = kSheetMargin, y = kSheetMargin + 2 * kRowHigh + kHigh;
  const std::string last = rays < 1 ? "" : stepOf(pixel_.tree(), pixel_.scene(), rays - 1);
  const std::string said = all ? pixel_.why.sentence : last;
  drawing.things.push_back(wordsAt({x, y}, cut(said, most - x)));
  y += 1.2 * kRowHigh;
  const auto add = [&](const Color& light, const std::string& words) {
    const double wide = 36 + wideOf(words);
    if (x + wide > most && x > kSheetMargin) x = kSheetMargin, y += kRowHigh;
    drawing.things.push_back(swatch({x, y}, shownColour(light, session.settings())));
    drawing.things.push_back(wordsAt({x + 24, y}, cut(words, most - x - 24)));
    x += wide;
  };
  const std::vector<WhySummand>& sum = pixel_.why.sum;
  std::vector<WhySummand> there;  // so far
  for (const WhySummand& each : sum)
    if (all || each.last < rays) there.push_back(each);
  const Color whole = all ? pixel_.tree().nodes.front().radiance : sumAfter(sum, rays);
  add(whole, channels(whole) + (there.empty() ? "" : "  ="));
  for (std::size_t i = 0; i < there.size(); ++i)
    add(there[i].color, there[i].name + " " + channels(there[i].color) + (i + 1 < there.size() ? "  +" : ""));
  return y + kRowHigh;
}

std::string filmOf(const RayStory& story, const Advance& advance) {
  constexpr int kMostPictures = 60, kGrowth = 4;            // kGrowth: pictures of one ray
  constexpr double kEach = 1.7, kGrowing = 0.1, kLast = 8;  // seconds: time to speak
  AnimatedPng film;
  const auto add = [&](const Drawing& drawing, double seconds) {
    film.add(toBytes(toPicture(drawing), Rounding::nearest), seconds);
  };
  const int step = std::max(1, (story.rays() + kMostPictures - 1) / kMostPictures);
  for (int rays = std::min(step, story.rays());; rays = std::min(rays + step, story.rays())) {
    for (int part = 1; part < kGrowth && step == 1; ++part)
      add(story.after(rays, part / double{kGrowth}), kGrowing);
    add(story.after(rays), rays < story.rays() ? kEach : kLast);
    if (advance && !advance(static_cast<double>(rays) / story.rays())) return "";
    if (rays == story.rays()) return film.finish();
  }
}

void writeStory(const std::string& file, const RayStory& story, const Advance& advance) {
  if (const std::string problem = endingProblem(file, kStorySuffixes); !problem.empty())
    throw Error(Fault::usage, problem);
  if (endingProblem(file, {".apng"}).empty()) {
    if (const std::string film = filmOf(story, advance); !film.empty()) writeFile(file, film);
    return;
  }
  writeDrawing(file, story.whole());
}

}  // namespace trace

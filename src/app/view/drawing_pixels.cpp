// A Drawing as pixels. Lines and disks cover a pixel by the distance of its centre from their edge.
#include <algorithm>
#include <cmath>

#include "app/view/drawing.h"
#include "base/match.h"
#include "image/letters.h"
#include "math/elementary.h"

namespace trace {
namespace {

class Canvas {
 public:
  Canvas(int width, int height) : picture_(width, height), right_(width), bottom_(height) {
    std::fill(picture_.pixels.begin(), picture_.pixels.end(), Color(1));
  }

  void draw(const DrawnFrame& f) {
    left_ = f.at.x;
    top_ = f.at.y;
    right_ = f.at.x + f.width;
    bottom_ = f.at.y + f.height;
  }

  void draw(const DrawnLine& l) {
    constexpr double kDash = 6, kGap = 4;
    const double dx = l.to.x - l.from.x, dy = l.to.y - l.from.y, length = math::hypot(dx, dy);
    const double reach = l.width / 2 + 1;
    const double left = std::min(l.from.x, l.to.x) - reach, right = std::max(l.from.x, l.to.x) + reach;
    const auto coverage = [&](double x, double y) {
      const double along = length > 0 ? ((x - l.from.x) * dx + (y - l.from.y) * dy) / length : 0;
      if (l.dashed && std::fmod(std::max(along, 0.0), kDash + kGap) > kDash) return 0.0;
      const double f = length > 0 ? std::clamp(along, 0.0, length) / length : 0;
      return l.width / 2 + 0.5 - math::hypot(x - l.from.x - dx * f, y - l.from.y - dy * f);
    };
    // Row by row, only as far as the line is near.
    const double first = std::max(std::floor(std::min(l.from.y, l.to.y) - reach), top_);
    const double last = std::min(std::max(l.from.y, l.to.y) + reach, bottom_);
    for (double y = first; y < last; ++y) {
      double x0 = left, x1 = right;
      if (std::abs(dy) > 1) {
        const double a = l.from.x + (y - reach - l.from.y) / dy * dx;
        const double b = l.from.x + (y + 1 + reach - l.from.y) / dy * dx;
        x0 = std::max(x0, std::min(a, b) - reach);
        x1 = std::min(x1, std::max(a, b) + reach);
      }
      cover(x0, y, x1, y + 1, l.color, coverage);
    }
  }

  void draw(const DrawnDisk& d) {
    const double reach = d.radius + 1;
    cover(d.center.x - reach, d.center.y - reach, d.center.x + reach, d.center.y + reach, d.color,
          [&](double x, double y) { return d.radius + 0.5 - math::hypot(x - d.center.x, y - d.center.y); });
  }

  void draw(const DrawnTriangle& t) {
    const auto doubleArea = [](const Point2& p, const Point2& q, const Point2& r) {
      return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    };
    const double sign = doubleArea(t.a, t.b, t.c) < 0 ? -1 : 1;
    const auto inside = [&](const Point2& p, const Point2& q, const Point2& at) {
      const double side = math::hypot(q.x - p.x, q.y - p.y);
      return side > 0 ? sign * doubleArea(p, q, at) / side : 0;
    };
    const auto [left, right] = std::minmax({t.a.x, t.b.x, t.c.x});
    const auto [top, bottom] = std::minmax({t.a.y, t.b.y, t.c.y});
    cover(left, top, right + 1, bottom + 1, t.color, [&](double x, double y) {
      const Point2 at{x, y};
      return 0.5 + std::min({inside(t.a, t.b, at), inside(t.b, t.c, at), inside(t.c, t.a, at)});
    });
  }

  void draw(const DrawnWords& w) {
    const double width = std::max(1.0, w.height / 12);
    for (const LetterStroke& stroke : letterStrokes(w.words, w.height))
      draw(DrawnLine{{w.at.x + stroke.from.x, w.at.y + stroke.from.y},
                     {w.at.x + stroke.to.x, w.at.y + stroke.to.y},
                     w.color,
                     width});
  }

  void draw(const DrawnPicture& p) {
    const int x0 = static_cast<int>(p.at.x), y0 = static_cast<int>(p.at.y);
    for (int y = 0; y < p.picture.height; ++y)
      for (int x = 0; x < p.picture.width; ++x)
        if (inside(x0 + x, y0 + y)) picture_.at(x0 + x, y0 + y) = clamp01(p.picture.at(x, y));
  }

  Picture take() { return std::move(picture_); }

 private:
  bool inside(int x, int y) const {
    return x >= std::max(left_, 0.0) && y >= std::max(top_, 0.0) &&
           x < std::min(right_, 1.0 * picture_.width) && y < std::min(bottom_, 1.0 * picture_.height);
  }

  /// Mixes the colour into the pixels of a rectangle by coverage(x, y), clamped to 0..1, at their centres.
  template <class Coverage>
  void cover(double x0, double y0, double x1, double y1, const Color& color, Coverage&& coverage) {
    const auto first = [](double v, double least) {
      return static_cast<int>(std::floor(std::max(v, least)));
    };
    const auto last = [](double v, double most) { return static_cast<int>(std::ceil(std::min(v, most))); };
    for (int y = first(y0, top_); y < last(y1, bottom_); ++y)
      for (int x = first(x0, left_); x < last(x1, right_); ++x) {
        if (!inside(x, y)) continue;
        const double share = std::clamp(coverage(x + 0.5, y + 0.5), 0.0, 1.0);
        if (share > 0) picture_.at(x, y) = lerp(share, picture_.at(x, y), color);
      }
  }

  Picture picture_;
  double left_ = 0, top_ = 0, right_, bottom_;
};

}  // namespace

Picture toPicture(const Drawing& drawing) {
  Canvas canvas(drawing.width, drawing.height);
  for (const Drawn& thing : drawing.things) match(thing, [&](const auto& t) { canvas.draw(t); });
  return canvas.take();
}

}  // namespace trace

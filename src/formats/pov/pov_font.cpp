#include "formats/pov/pov_font.h"

#include <algorithm>

#include "base/budget.h"
#include "base/error.h"
#include "base/text.h"
#include "formats/pov/pov_reader.h"
#include "geometry/shapes/surfaces/prism.h"

namespace trace::pov {

std::uint32_t Font::number(std::size_t at, int bytes) const {
  const auto size = static_cast<std::size_t>(bytes);
  if (at > bytes_.size() || bytes_.size() - at < size) throw Error(Fault::scene, "the font is cut off");
  std::uint32_t n = 0;
  for (std::size_t i = 0; i < size; ++i) n = n << 8 | static_cast<unsigned char>(bytes_[at + i]);
  return n;
}

int Font::signedNumber(std::size_t at) const { return static_cast<std::int16_t>(number(at, 2)); }

std::size_t Font::offset(std::string_view name) const {
  const std::uint32_t count = number(4, 2);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t row = 12 + 16 * static_cast<std::size_t>(i);
    number(row, 4);
    if (bytes_.substr(row, 4) == name) return number(row + 8, 4);
  }
  throw Error(Fault::scene, "the font has no table " + std::string(name), "a TrueType font has one");
}

Font::Font(std::string_view bytes) : bytes_(bytes) {
  const std::size_t head = offset("head");
  em_ = std::max<Real>(number(head + 18, 2), 1);
  longOffsets_ = number(head + 50, 2) != 0;
  metrics_ = std::max<std::uint32_t>(number(offset("hhea") + 34, 2), 1);
  cmap_ = offset("cmap");
  glyf_ = offset("glyf");
  loca_ = offset("loca");
  hmtx_ = offset("hmtx");
  try {
    kern_ = offset("kern");
  } catch (const Error&) {  // it has none
  }
}

Real Font::kerning(std::uint32_t left, std::uint32_t right) const {
  if (kern_ == 0 || number(kern_, 2) != 0 || number(kern_ + 2, 2) == 0) return 0;
  const std::uint32_t coverage = number(kern_ + 8, 2);
  if ((coverage & 1) == 0 || coverage >> 8 != 0) return 0;  // not horizontal, or of another format
  const std::uint32_t pairs = number(kern_ + 10, 2), wanted = indexOf(left) << 16 | indexOf(right);
  for (std::uint32_t i = 0; i < pairs; ++i) {
    const std::size_t at = kern_ + 18 + 6 * static_cast<std::size_t>(i);
    if (number(at, 4) == wanted) return signedNumber(at + 4) / em_;
  }
  return 0;
}

std::uint32_t Font::indexOf(std::uint32_t character) const {
  const std::uint32_t tables = number(cmap_ + 2, 2);
  for (std::uint32_t i = 0; i < tables; ++i) {
    const std::size_t map = cmap_ + number(cmap_ + 8 + 8 * static_cast<std::size_t>(i), 4);
    const std::uint32_t format = number(map, 2);
    if (format == 0 && character < 256) {
      if (const std::uint32_t found = number(map + 6 + character, 1)) return found;
    } else if (format == 6) {
      const std::uint32_t first = number(map + 6, 2), count = number(map + 8, 2);
      if (character >= first && character < first + count)
        return number(map + 10 + 2 * static_cast<std::size_t>(character - first), 2);
    } else if (format == 4) {
      const std::size_t segments = number(map + 6, 2) / 2;
      const std::size_t ends = map + 14, starts = ends + 2 * segments + 2, deltas = starts + 2 * segments,
                        ranges = deltas + 2 * segments;
      for (const std::uint32_t wanted : {character, character | 0xf000u})  // signs of a symbol font
        for (std::size_t s = 0; s < segments; ++s) {
          if (number(ends + 2 * s, 2) < wanted || number(starts + 2 * s, 2) > wanted) continue;
          const std::uint32_t delta = number(deltas + 2 * s, 2), range = number(ranges + 2 * s, 2);
          std::uint32_t found = wanted;
          if (range != 0)
            found = number(
                ranges + 2 * s + range + 2 * static_cast<std::size_t>(wanted - number(starts + 2 * s, 2)), 2);
          if (range != 0 && found == 0) break;
          return (found + delta) & 0xffffu;
        }
    }
  }
  return 0;
}

void Font::corners(std::uint32_t glyph, std::vector<Corner>& to, int depth) const {
  constexpr int kMostDepth = 6;
  constexpr std::size_t kMostCorners = 20000;
  if (depth > kMostDepth || to.size() > kMostCorners) return;
  checkBudget();
  const std::size_t entry = longOffsets_ ? 4 : 2, at = loca_ + entry * glyph;
  const std::size_t scale = longOffsets_ ? 1 : 2;
  const std::size_t begin = number(at, static_cast<int>(entry)) * scale,
                    end = number(at + entry, static_cast<int>(entry)) * scale;
  if (end <= begin) return;  // a blank
  std::size_t p = glyf_ + begin;
  const int outlines = signedNumber(p);
  p += 10;
  if (outlines < 0) {  // made of others
    std::uint32_t flags = 0;
    do {
      flags = number(p, 2);
      const std::uint32_t part = number(p + 2, 2);
      p += 4;
      Real dx = 0, dy = 0;
      if (flags & 1) {
        dx = signedNumber(p), dy = signedNumber(p + 2);
        p += 4;
      } else {
        dx = static_cast<std::int8_t>(number(p, 1)), dy = static_cast<std::int8_t>(number(p + 1, 1));
        p += 2;
      }
      const auto fraction = [&](std::size_t where) { return signedNumber(where) / 16384.0; };
      Real a = 1, b = 0, c = 0, d = 1;
      if (flags & 8) {
        a = d = fraction(p);
        p += 2;
      } else if (flags & 64) {
        a = fraction(p), d = fraction(p + 2);
        p += 4;
      } else if (flags & 128) {
        a = fraction(p), b = fraction(p + 2), c = fraction(p + 4), d = fraction(p + 6);
        p += 8;
      }
      const std::size_t first = to.size();
      corners(part, to, depth + 1);
      for (std::size_t i = first; i < to.size(); ++i) {
        const Real x = to[i].x, y = to[i].y;
        to[i].x = a * x + c * y + dx;
        to[i].y = b * x + d * y + dy;
      }
    } while ((flags & 32) && to.size() <= kMostCorners);
    return;
  }
  std::vector<std::size_t> lasts;
  for (int i = 0; i < outlines; ++i, p += 2) lasts.push_back(number(p, 2));
  if (lasts.empty()) return;
  const std::size_t count = lasts.back() + 1;
  if (count > kMostCorners) return;
  p += 2 + number(p, 2);
  std::vector<std::uint32_t> flags;
  while (flags.size() < count) {
    const std::uint32_t f = number(p++, 1);
    flags.push_back(f);
    if (f & 8)
      for (std::uint32_t again = number(p++, 1); again > 0 && flags.size() < count; --again)
        flags.push_back(f);
  }
  const std::size_t first = to.size();
  Real value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (flags[i] & 2) {
      const Real step = number(p++, 1);
      value += flags[i] & 16 ? step : -step;
    } else if (!(flags[i] & 16)) {
      value += signedNumber(p);
      p += 2;
    }
    to.push_back({value, 0, (flags[i] & 1) != 0, false});
  }
  value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (flags[i] & 4) {
      const Real step = number(p++, 1);
      value += flags[i] & 32 ? step : -step;
    } else if (!(flags[i] & 32)) {
      value += signedNumber(p);
      p += 2;
    }
    to[first + i].y = value;
  }
  for (const std::size_t last : lasts)
    if (last < count) to[first + last].last = true;
}

Font::Glyph Font::glyph(std::uint32_t character) const {
  Glyph result;
  const std::uint32_t index = indexOf(character);
  result.advance = number(hmtx_ + 4 * static_cast<std::size_t>(std::min(index, metrics_ - 1)), 2) / em_;
  std::vector<Corner> all;
  corners(index, all, 0);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].last) continue;
    const std::vector<Corner> loop(all.begin() + static_cast<std::ptrdiff_t>(begin),
                                   all.begin() + static_cast<std::ptrdiff_t>(i) + 1);
    begin = i + 1;
    const std::size_t n = loop.size();
    if (n < 2) continue;
    const auto point = [&](const Corner& c) { return Point{c.x / em_, c.y / em_}; };
    const auto middle = [](const Point& a, const Point& b) {
      return Point{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2};
    };
    const auto between = [](const Point& a, const Point& b, Real t) {
      return Point{a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t};
    };
    // It begins on the curve: at a corner, or half way between two handles.
    std::size_t start = 0;
    while (start < n && !loop[start].on) ++start;
    Point from = start < n ? point(loop[start]) : middle(point(loop[n - 1]), point(loop[0]));
    if (start == n) start = n - 1;
    std::vector<Point> outline{from};
    const Point first = from;
    const auto line = [&](const Point& to) {
      outline.insert(outline.end(), {between(from, to, 1.0 / 3), between(from, to, 2.0 / 3), to});
      from = to;
    };
    const auto arc = [&](const Point& handle, const Point& to) {
      outline.insert(outline.end(), {between(from, handle, 2.0 / 3), between(to, handle, 2.0 / 3), to});
      from = to;
    };
    for (std::size_t k = 1; k <= n; ++k) {
      const Corner& c = loop[(start + k) % n];
      if (c.on) {
        if (k < n || !(point(c) == from)) line(k == n ? first : point(c));
        continue;
      }
      if (k == n) break;
      const Corner& after = loop[(start + k + 1) % n];
      const Point handle = point(c);
      if (k + 1 >= n) {
        arc(handle, first);
        break;
      }
      if (after.on) {
        arc(handle, point(after));
        ++k;
        if (k == n) break;
      } else {
        arc(handle, middle(handle, point(after)));
      }
    }
    if (!(outline.back() == first)) line(first);
    if (outline.size() >= 4) result.outlines.push_back(std::move(outline));
  }
  return result;
}

Real Font::Glyph::left() const {
  Real least = kInfinity;
  for (const auto& outline : outlines)
    for (const auto& p : outline) least = std::min(least, p[0]);
  return outlines.empty() ? 0 : least;
}

// --- text { ttf "FONT" "TEXT" THICKNESS, OFFSET } ---

void Reader::textShape(Node& node, const Token& at) {
  constexpr std::size_t kMostLetters = 10000;
  std::string file;
  if (takesName("internal_font") || takesName("internal")) {
    constexpr const char* kFonts[]{"timrom.ttf", "cyrvetic.ttf", "crystal.ttf", "povlogo.ttf"};
    file = kFonts[std::clamp(whole(), 1, 4) - 1];
  } else {
    takesName("ttf");
    file = text();
  }
  comma();
  const std::string said = text();
  comma();
  const Real thickness = number();
  comma();
  const Vec3 gap = startsNumber() ? vector() : Vec3{};
  node.kind = Node::Kind::unite;
  if (said.size() > kMostLetters) fail(at, "a text of more than 10 000 letters");
  if (!(thickness > 0)) {
    node.kind = Node::Kind::nothing;
    return;
  }
  std::string bytes;
  try {
    bytes = readNamed(at, file);
  } catch (const Error& first) {
    if (first.fault() == Fault::limit) throw;
    try {
      bytes = readNamed(at, file + ".ttf");
    } catch (const Error& error) {
      if (error.fault() == Fault::limit) throw;
      node.kind = Node::Kind::nothing;
      return leaveOut(at, "text whose font cannot be read", first.messages().front().what);
    }
  }
  try {
    const Font font(bytes);
    Vec3 pen{};
    for (std::size_t i = 0; i < said.size(); ++i) {
      checkBudget();
      const auto c = static_cast<unsigned char>(said[i]);
      if (i > 0) pen.x += font.kerning(static_cast<unsigned char>(said[i - 1]), c);
      const Font::Glyph glyph = font.glyph(c);
      if (i == 0) pen.x = -glyph.left();
      if (!glyph.outlines.empty()) {
        Prism shape;
        shape.spline = Spline::bezier;
        shape.outline = glyph.outlines.front();
        shape.holes.assign(glyph.outlines.begin() + 1, glyph.outlines.end());
        shape.height = thickness;
        auto letter = std::make_shared<Node>();
        letter->kind = Node::Kind::shape;
        letter->place = node.place;
        letter->shape = std::move(shape);
        letter->shapeAt = Affine::translation(pen);
        node.parts.push_back(letter);
      }
      pen += Vec3{glyph.advance, 0, 0} + gap;
    }
  } catch (const Error& error) {
    if (error.fault() == Fault::limit) throw;
    node.kind = Node::Kind::nothing;
    leaveOut(at, "text whose font cannot be read", error.messages().front().what);
  }
}

}  // namespace trace::pov

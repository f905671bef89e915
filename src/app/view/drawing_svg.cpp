#include <cstdint>
#include <cstdio>

#include "app/view/drawing.h"
#include "base/match.h"
#include "base/names.h"
#include "image/codecs/codec.h"
#include "image/letters.h"

namespace trace {
namespace {

/// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63];
  }
  return text;
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", x);
  return text;
}
std::string attribute(const char* name, double x) {
  return std::string(" ") + name + "=\"" + number(x) + "\"";
}
std::string colorOf(const char* name, const Color& c) {
  char text[64];
  std::snprintf(text, sizeof text, " %s=\"#%02x%02x%02x\"", name, toLevel(c.r, Rounding::nearest),
                toLevel(c.g, Rounding::nearest), toLevel(c.b, Rounding::nearest));
  return text;
}

std::string xmlText(const std::string& words) {
  std::string text;
  for (char c : onOneLine(words)) {  // XML allows neither control characters nor bytes that are no letters
    if (c == '&')
      text += "&amp;";
    else if (c == '<')
      text += "&lt;";
    else
      text += c;
  }
  return text;
}

}  // namespace

std::string toSvg(const Drawing& drawing) {
  const std::string size = attribute("width", drawing.width) + attribute("height", drawing.height);
  std::string text =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\"" + size +
      " viewBox=\"0 0 " + number(drawing.width) + " " + number(drawing.height) + "\">\n<rect" + size +
      " fill=\"#ffffff\"/>\n";
  int frames = 0;
  for (const Drawn& thing : drawing.things) {
    match(thing,
          Overloaded{
              [&](const DrawnLine& l) {
                text += "<line" + attribute("x1", l.from.x) + attribute("y1", l.from.y) +
                        attribute("x2", l.to.x) + attribute("y2", l.to.y) + colorOf("stroke", l.color) +
                        attribute("stroke-width", l.width) + (l.dashed ? " stroke-dasharray=\"6 4\"" : "") +
                        " stroke-linecap=\"round\"/>\n";
              },
              [&](const DrawnTriangle& t) {
                text += "<polygon points=\"";
                for (const Point2& p : {t.a, t.b, t.c}) text += number(p.x) + "," + number(p.y) + " ";
                text.back() = '"';
                text += colorOf("fill", t.color) + "/>\n";
              },
              [&](const DrawnDisk& d) {
                text += "<circle" + attribute("cx", d.center.x) + attribute("cy", d.center.y) +
                        attribute("r", d.radius) + colorOf("fill", d.color) + "/>\n";
              },
              [&](const DrawnWords& w) {  // as wide as our letters, in whatever font
                text += "<text" + attribute("x", w.at.x) + attribute("y", w.at.y + 0.8 * w.height) +
                        attribute("font-size", w.height) +
                        attribute("textLength", lettersWidth(w.words, w.height)) +
                        " lengthAdjust=\"spacingAndGlyphs\" font-family=\"Arial, Helvetica, sans-serif\"" +
                        colorOf("fill", w.color) + ">" + xmlText(w.words) + "</text>\n";
              },
              [&](const DrawnPicture& p) {
                const std::string png = encodePicture(pictureFormatFor(".png"), p.picture, Rounding::nearest);
                text += "<image" + attribute("x", p.at.x) + attribute("y", p.at.y) +
                        attribute("width", p.picture.width) + attribute("height", p.picture.height) +
                        " xlink:href=\"data:image/png;base64," + base64(png) + "\"/>\n";
              },
              [&](const DrawnFrame& f) {
                const std::string name = "frame" + std::to_string(++frames);
                if (frames > 1) text += "</g>\n";
                text += "<clipPath id=\"" + name + "\"><rect" + attribute("x", f.at.x) +
                        attribute("y", f.at.y) + attribute("width", f.width) + attribute("height", f.height) +
                        "/></clipPath>\n<g clip-path=\"url(#" + name + ")\">\n";
              }});
  }
  if (frames > 0) text += "</g>\n";
  return text + "</svg>\n";
}

}  // namespace trace

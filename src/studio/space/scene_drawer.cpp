#include "studio/space/scene_drawer.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

#include "app/view/screen/dither.h"
#include "studio/space/see_through.h"
#include "studio/space/shader.h"
#include "studio/widgets/gl.h"

namespace trace::studio {
namespace {

/// Places in a pixel, one for each step towards the smooth picture: its rows and columns each have one.
constexpr std::array<std::array<double, 2>, 8> kPlaces{{{0.5625, 0.4375},
                                                        {0.0625, 0.9375},
                                                        {0.8125, 0.1875},
                                                        {0.3125, 0.6875},
                                                        {0.9375, 0.8125},
                                                        {0.1875, 0.3125},
                                                        {0.4375, 0.0625},
                                                        {0.6875, 0.5625}}};

constexpr const char* kSurfaceVertex = R"(layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 matrix;
out vec3 place, facing;
void main() {
  place = position;
  facing = normal;
  gl_Position = matrix * vec4(position, 1);
})";

/// A number in the text of a shader.
std::string precise(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9f", number);
  return text;
}

// Part of a level of 255, so that slow changes of shade do not end in bands: ditherAt() for shaders.
const std::string kDither = R"(
uniform float ditherStep;
float dither() {
  vec2 p = gl_FragCoord.xy + )" +
                            precise(Dither::kApart) + R"( * ditherStep;
  return (fract()" + precise(Dither::kTurns) +
                            " * fract(dot(p, vec2(" + precise(Dither::kAcross) + ", " +
                            precise(Dither::kDown) +
                            R"()))) - 0.5) / 255.0;
}
)";

// Lit from the eye and a little from above, or by the scene's lights; on both sides.
const std::string kSurfaceFragment = SeeThrough::kDeclarations + kDither + R"(
in vec3 place, facing;
uniform vec3 eye, inside;
uniform bool wall;
uniform vec4 colour;
uniform bool flatly, unlit;
uniform int lamps;
uniform vec4 lampPlaces[8];  // w is 0 for a direction
uniform vec3 lampColours[8];
out vec4 result;
void main() {
  vec3 across = cross(dFdx(place), dFdy(place));  // as app/view/space/room.h has it
  if (wall && dot(across, eye - place) * dot(across, inside - place) < 0.0) discard;
  peel();
  vec3 n = normalize(flatly ? across : facing), v = normalize(eye - place);
  if (dot(n, v) < 0.0) n = -n;
  vec3 light = vec3(0.3 + 0.6 * dot(n, v) + 0.1 * n.y);
  if (lamps > 0) light = vec3(0.15);
  for (int i = 0; i < lamps; ++i)
    light += lampColours[i] * max(0.0, dot(n, normalize(lampPlaces[i].xyz - lampPlaces[i].w * place)));
  if (unlit) light = vec3(1);
  float edge = pow(1.0 - dot(n, v), 3.0);
  result = vec4(colour.rgb * min(light, vec3(1)) + dither(), mix(colour.a, 1.0, colour.a < 1.0 ? 0.5 * edge : 0.0));
})";

// A line is a quad that faces the eye: both ends come with every corner.
constexpr const char* kLineVertex = R"(layout(location = 0) in vec3 start;
layout(location = 1) in vec3 finish;
layout(location = 2) in vec4 tint;
layout(location = 3) in vec4 shape;  // which end, which side, width, dash
uniform mat4 matrix;
uniform vec2 size;
out vec4 colour;
out vec2 along;  // in pixels, and 1, both times w: divided they are linear on the screen
flat out float dash;
void main() {
  vec4 a = matrix * vec4(start, 1), b = matrix * vec4(finish, 1);
  float least = 1e-4;
  if (a.w < least && b.w >= least) a = mix(a, b, (least - a.w) / (b.w - a.w));
  if (b.w < least && a.w >= least) b = mix(b, a, (least - b.w) / (a.w - b.w));
  vec2 p = a.xy / a.w * size * 0.5, q = b.xy / b.w * size * 0.5;
  vec2 way = q - p;
  float far = length(way);
  vec2 side = far > 0.0 ? vec2(-way.y, way.x) / far : vec2(1, 0);
  vec4 here = shape.x < 0.5 ? a : b;
  here.xy += side * shape.y * shape.z / size * here.w;
  colour = tint;
  along = vec2(shape.x < 0.5 ? 0.0 : far, 1) * here.w;
  dash = shape.w;
  gl_Position = here;
})";

constexpr const char* kLineFragment = R"(in vec4 colour;
in vec2 along;
flat in float dash;
uniform float opacity;
out vec4 result;
void main() {
  if (dash > 0.0 && mod(along.x / along.y, 2.0 * dash) > dash) discard;
  result = vec4(colour.rgb, colour.a * opacity);
})";

constexpr const char* kPictureVertex = R"(layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
uniform mat4 matrix;
out vec2 at;
void main() {
  at = uv;
  gl_Position = matrix * vec4(position, 1);
})";

constexpr const char* kPictureFragment = R"(in vec2 at;
uniform sampler2D picture;
uniform float opacity;
out vec4 result;
void main() { result = vec4(texture(picture, at).rgb, opacity); })";

/// One triangle over everything.
constexpr const char* kCopyVertex =
    R"(void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0, 1); })";

const std::string kCopyFragment = kDither + R"(uniform sampler2D picture;
uniform bool rounded;  // to bytes
out vec4 result;
void main() {
  vec3 colour = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
  result = vec4(rounded ? colour + dither() : colour, 1);
})";

void attribute(unsigned index, int count, std::size_t stride, std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, count, GL_FLOAT, GL_FALSE, static_cast<int>(stride),
                        reinterpret_cast<const void*>(offset));
}

struct LineCorner {
  Point3 from, to;
  std::array<float, 4> colour;
  float end, side, width, dash;
};

struct PictureCorner {
  Point3 position;
  float u, v;
};

}  // namespace

struct SceneDrawer::State {
  unsigned surface = 0, line = 0, pictures = 0, copy = 0;  // programs
  unsigned surfaceArray = 0, lineArray = 0, pictureArray = 0, nothing = 0;
  unsigned surfaceBuffer = 0, triangleBuffer = 0, edgeBuffer = 0, lineBuffer = 0, pictureBuffer = 0;
  unsigned plain = 0, texture = 0, depth = 0;  // drawn into, one sample a pixel
  unsigned smooth = 0, mean = 0;               // the mean of several
  int width = 0, height = 0;
  std::array<float, 16> matrix{};
  Vec3 eye, inside;
  bool flat = false;
  std::vector<DrawLight> lights;
  std::vector<std::uint32_t> indices;  // corners of triangles
  SeeThrough seeThrough;
  std::optional<SpaceDrawing> shown;
  std::size_t steps = 0;  // number of kPlaces that are in the mean
  std::uint64_t drawn = 0;

  void resize(int w, int h) {
    if (w == width && h == height) return;
    width = w;
    height = h;
    const auto make = [&](unsigned name, int format, unsigned content, unsigned type) {
      glBindTexture(GL_TEXTURE_2D, name);
      glTexImage2D(GL_TEXTURE_2D, 0, format, w, h, 0, content, type, nullptr);
      glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
      glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, name == texture ? GL_LINEAR : GL_NEAREST);
    };
    make(texture, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE);
    make(mean, kFineFormat, GL_RGBA, kFineType);
    make(depth, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT);
    glBindFramebuffer(GL_FRAMEBUFFER, plain);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, smooth);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, mean, 0);
  }

  void drawPlain(const SpaceDrawing& drawing);
  void drawStep(const SpaceDrawing& drawing);
  void begin(const SpaceDrawing& drawing, double x, double y);
  void overlay(const SpaceDrawing& drawing);
  void copyOver(unsigned frame, unsigned picture, bool rounded) const;
  static void leave();
  void surfaces(const std::vector<DrawSurface>& parts);
  void wires(const std::vector<DrawSurface>& parts);
  void draw(const std::vector<DrawSurface>& parts, bool asWires);
  void shineOn() const;
  void edges(const DrawSurface& part) const;
  void picture(const DrawPicture& picture);
  void lines(const std::vector<DrawLine>& lines, float hidden);

  void use(unsigned program) const {
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "matrix"), 1, GL_TRUE, matrix.data());
  }
};

SceneDrawer::SceneDrawer() : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.surface = linkProgram(kSurfaceVertex, kSurfaceFragment.c_str());
  s.line = linkProgram(kLineVertex, kLineFragment);
  s.pictures = linkProgram(kPictureVertex, kPictureFragment);
  s.copy = linkProgram(kCopyVertex, kCopyFragment.c_str());
  for (unsigned* array : {&s.surfaceArray, &s.lineArray, &s.pictureArray, &s.nothing})
    glGenVertexArrays(1, array);
  for (unsigned* buffer :
       {&s.surfaceBuffer, &s.triangleBuffer, &s.edgeBuffer, &s.lineBuffer, &s.pictureBuffer})
    glGenBuffers(1, buffer);
  for (unsigned* frame : {&s.smooth, &s.plain}) glGenFramebuffers(1, frame);
  for (unsigned* picture : {&s.texture, &s.mean, &s.depth}) glGenTextures(1, picture);

  glBindVertexArray(s.surfaceArray);
  glBindBuffer(GL_ARRAY_BUFFER, s.surfaceBuffer);
  attribute(0, 3, 6 * sizeof(float), 0);
  attribute(1, 3, 6 * sizeof(float), 3 * sizeof(float));
  glBindVertexArray(s.lineArray);
  glBindBuffer(GL_ARRAY_BUFFER, s.lineBuffer);
  attribute(0, 3, sizeof(LineCorner), offsetof(LineCorner, from));
  attribute(1, 3, sizeof(LineCorner), offsetof(LineCorner, to));
  attribute(2, 4, sizeof(LineCorner), offsetof(LineCorner, colour));
  attribute(3, 4, sizeof(LineCorner), offsetof(LineCorner, end));
  glBindVertexArray(s.pictureArray);
  glBindBuffer(GL_ARRAY_BUFFER, s.pictureBuffer);
  attribute(0, 3, sizeof(PictureCorner), 0);
  attribute(1, 2, sizeof(PictureCorner), offsetof(PictureCorner, u));
  glBindVertexArray(0);
}

SceneDrawer::~SceneDrawer() {
  State& s = *state_;
  for (unsigned program : {s.surface, s.line, s.pictures, s.copy}) glDeleteProgram(program);
  for (unsigned* array : {&s.surfaceArray, &s.lineArray, &s.pictureArray, &s.nothing})
    glDeleteVertexArrays(1, array);
  for (unsigned* buffer :
       {&s.surfaceBuffer, &s.triangleBuffer, &s.edgeBuffer, &s.lineBuffer, &s.pictureBuffer})
    glDeleteBuffers(1, buffer);
  for (unsigned* frame : {&s.smooth, &s.plain}) glDeleteFramebuffers(1, frame);
  for (unsigned* picture : {&s.texture, &s.mean, &s.depth}) glDeleteTextures(1, picture);
}

void SceneDrawer::setCorners(const SharedCorners& shared) {
  State& s = *state_;
  const auto fill = [](unsigned kind, unsigned buffer, const auto& values) {
    glBindBuffer(kind, buffer);
    glBufferData(kind, static_cast<std::ptrdiff_t>(values.size() * sizeof(values[0])), values.data(),
                 GL_STATIC_DRAW);
  };
  glBindVertexArray(s.surfaceArray);
  fill(GL_ARRAY_BUFFER, s.surfaceBuffer, shared.corners);
  fill(GL_ELEMENT_ARRAY_BUFFER, s.triangleBuffer, shared.indices);
  glBindVertexArray(0);
  s.indices = shared.indices;
  s.shown.reset();
}

std::uint64_t SceneDrawer::drawn() const { return state_->drawn; }

bool SceneDrawer::coarse() const { return state_->shown && state_->steps < kPlaces.size(); }

ImTextureID SceneDrawer::show(SpaceDrawing drawing, bool rests) {
  State& s = *state_;
  if (s.shown != drawing) {
    s.steps = 0;
    s.drawPlain(drawing);
    s.shown = std::move(drawing);
    ++s.drawn;
  } else if (rests && coarse()) {
    s.drawStep(*s.shown);
  }
  const bool between = s.steps > 0 && s.steps < kPlaces.size();
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(between ? s.mean : s.texture));
}

/// Draws solid surfaces, seen through that place of each pixel.
void SceneDrawer::State::begin(const SpaceDrawing& d, double x, double y) {
  resize(d.width, d.height);
  const std::array<double, 2> aside{(2 * x - 1) / width, (2 * y - 1) / height};
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t i = 0; i < 4; ++i)
      matrix[4 * row + i] =
          static_cast<float>(d.matrix[row][i] + (row < 2 ? aside[row] * d.matrix[3][i] : 0));
  eye = d.eye;
  inside = d.inside;
  flat = d.flat;
  lights = d.lights;
  glBindFramebuffer(GL_FRAMEBUFFER, plain);
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glClearColor(d.background[0], d.background[1], d.background[2], 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glDisable(GL_BLEND);
  surfaces(d.solid);
  glEnable(GL_BLEND);
  if (d.picture) picture(*d.picture);
}

/// Draws lines over surfaces.
void SceneDrawer::State::overlay(const SpaceDrawing& d) {
  glDepthMask(GL_FALSE);
  wires(d.wires);
  lines(d.lines, d.hidden);
  glDepthMask(GL_TRUE);
}

void SceneDrawer::State::drawPlain(const SpaceDrawing& d) {
  begin(d, 0.5, 0.5);
  seeThrough.end();
  glDepthMask(GL_FALSE);
  surfaces(d.clear);
  overlay(d);
  leave();
}

void SceneDrawer::State::drawStep(const SpaceDrawing& d) {
  begin(d, kPlaces[steps][0], kPlaces[steps][1]);
  if (!d.clear.empty()) {
    seeThrough.begin(width, height, depth);
    while (seeThrough.nextLayer()) surfaces(d.clear);
    seeThrough.layOver(plain);
  }
  overlay(d);
  ++steps;
  glBlendColor(0, 0, 0, 1.0f / static_cast<float>(steps));
  glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
  copyOver(smooth, texture, false);
  if (steps == kPlaces.size()) {  // as bytes it is shown faster
    glDisable(GL_BLEND);
    copyOver(plain, mean, true);
  }
  leave();
}

void SceneDrawer::State::copyOver(unsigned frame, unsigned picture, bool rounded) const {
  glBindFramebuffer(GL_FRAMEBUFFER, frame);
  glDisable(GL_DEPTH_TEST);
  glUseProgram(copy);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, picture);
  glUniform1i(glGetUniformLocation(copy, "picture"), 0);
  glUniform1i(glGetUniformLocation(copy, "rounded"), rounded);
  glUniform1f(glGetUniformLocation(copy, "ditherStep"), 0);
  glBindVertexArray(nothing);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

/// As Dear ImGui expects it.
void SceneDrawer::State::leave() {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glBindVertexArray(0);
  glUseProgram(0);
  glDepthMask(GL_TRUE);
  glDisable(GL_DEPTH_TEST);
}

void SceneDrawer::State::draw(const std::vector<DrawSurface>& parts, bool asWires) {
  if (parts.empty()) return;
  use(surface);
  seeThrough.useIn(surface);
  const auto place = [&](const char* name, const Vec3& p) {
    glUniform3f(glGetUniformLocation(surface, name), static_cast<float>(p.x), static_cast<float>(p.y),
                static_cast<float>(p.z));
  };
  place("eye", eye);
  place("inside", inside);
  glUniform1i(glGetUniformLocation(surface, "flatly"), flat);
  glUniform1i(glGetUniformLocation(surface, "unlit"), asWires);
  glUniform1f(glGetUniformLocation(surface, "ditherStep"), static_cast<float>(steps % kPlaces.size()));
  shineOn();
  glBindVertexArray(surfaceArray);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangleBuffer);
  const int colour = glGetUniformLocation(surface, "colour"), wall = glGetUniformLocation(surface, "wall");
  for (const DrawSurface& part : parts) {
    glUniform4f(colour, static_cast<float>(part.colour.r), static_cast<float>(part.colour.g),
                static_cast<float>(part.colour.b), part.opacity);
    glUniform1i(wall, part.wall);
    if (asWires)
      edges(part);
    else
      glDrawElements(GL_TRIANGLES, static_cast<int>(part.count), GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(part.first * sizeof(std::uint32_t)));
  }
}

/// Hands the lights to the program of surfaces.
void SceneDrawer::State::shineOn() const {
  std::vector<float> places, colours;
  const std::size_t count = std::min(lights.size(), SpaceDrawing::kMostLights);
  for (std::size_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis) places.push_back(static_cast<float>(lights[i].place[axis]));
    places.push_back(lights[i].far ? 0.0f : 1.0f);
    for (const Real c : {lights[i].colour.r, lights[i].colour.g, lights[i].colour.b})
      colours.push_back(static_cast<float>(c));
  }
  glUniform1i(glGetUniformLocation(surface, "lamps"), static_cast<int>(count));
  if (count == 0) return;
  glUniform4fv(glGetUniformLocation(surface, "lampPlaces"), static_cast<int>(count), places.data());
  glUniform3fv(glGetUniformLocation(surface, "lampColours"), static_cast<int>(count), colours.data());
}

void SceneDrawer::State::surfaces(const std::vector<DrawSurface>& parts) { draw(parts, false); }
void SceneDrawer::State::wires(const std::vector<DrawSurface>& parts) { draw(parts, true); }

/// The edges of triangles as lines: ES cannot draw triangles so.
void SceneDrawer::State::edges(const DrawSurface& part) const {
  std::vector<unsigned> ends;
  ends.reserve(part.count * 2);
  for (std::size_t i = part.first; i < part.first + part.count; i += 3) {
    const unsigned a = indices[i], b = indices[i + 1], c = indices[i + 2];
    ends.insert(ends.end(), {a, b, b, c, c, a});
  }
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, edgeBuffer);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(ends.size() * sizeof(unsigned)),
               ends.data(), GL_STREAM_DRAW);
  glDrawElements(GL_LINES, static_cast<int>(ends.size()), GL_UNSIGNED_INT, nullptr);
}

void SceneDrawer::State::lines(const std::vector<DrawLine>& all, float hidden) {
  if (all.empty()) return;
  std::vector<LineCorner> corners;
  corners.reserve(all.size() * 6);
  for (const DrawLine& each : all) {
    const auto corner = [&](float end, float side) {
      return LineCorner{each.from, each.to, each.colour, end, side, each.width, each.dash};
    };
    const LineCorner a = corner(0, -1), b = corner(0, 1), c = corner(1, 1), d = corner(1, -1);
    corners.insert(corners.end(), {a, b, c, a, c, d});
  }
  glBindVertexArray(lineArray);
  glBindBuffer(GL_ARRAY_BUFFER, lineBuffer);
  glBufferData(GL_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(corners.size() * sizeof(LineCorner)),
               corners.data(), GL_STREAM_DRAW);
  use(line);
  glUniform2f(glGetUniformLocation(line, "size"), static_cast<float>(width), static_cast<float>(height));
  const int opacity = glGetUniformLocation(line, "opacity");
  if (hidden > 0) {
    glDepthFunc(GL_GREATER);
    glUniform1f(opacity, hidden);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<int>(corners.size()));
  }
  glDepthFunc(GL_LEQUAL);
  glUniform1f(opacity, 1);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<int>(corners.size()));
  glDepthFunc(GL_LESS);
}

void SceneDrawer::State::picture(const DrawPicture& p) {
  const PictureCorner a{p.corners[0], 0, 0}, b{p.corners[1], 1, 0}, c{p.corners[2], 1, 1},
      d{p.corners[3], 0, 1};
  const PictureCorner quad[] = {a, b, c, a, c, d};
  glBindVertexArray(pictureArray);
  glBindBuffer(GL_ARRAY_BUFFER, pictureBuffer);
  glBufferData(GL_ARRAY_BUFFER, sizeof quad, quad, GL_STREAM_DRAW);
  use(pictures);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, p.texture);
  glUniform1i(glGetUniformLocation(pictures, "picture"), 0);
  glUniform1f(glGetUniformLocation(pictures, "opacity"), p.opacity);
  glDrawArrays(GL_TRIANGLES, 0, 6);
}

}  // namespace trace::studio

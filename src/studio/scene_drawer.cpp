#include "studio/scene_drawer.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <cstddef>
#include <string>

#include "base/error.h"

namespace trace::studio {
namespace {

constexpr int kSamples = 4;  // per pixel, for smooth edges

constexpr const char* kSurfaceVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 matrix;
out vec3 place, facing;
void main() {
  place = position;
  facing = normal;
  gl_Position = matrix * vec4(position, 1);
})";

// Lit from the eye and a little from above, on both sides.
constexpr const char* kSurfaceFragment = R"(#version 330 core
in vec3 place, facing;
uniform vec3 eye;
uniform vec4 colour;
out vec4 result;
void main() {
  vec3 n = normalize(facing), v = normalize(eye - place);
  if (dot(n, v) < 0) n = -n;
  float light = 0.3 + 0.6 * dot(n, v) + 0.1 * n.y;
  float edge = pow(1 - dot(n, v), 3);
  result = vec4(colour.rgb * light, mix(colour.a, 1, colour.a < 1 ? 0.5 * edge : 0));
})";

// A line is a quad that faces the eye: both ends come with every corner.
constexpr const char* kLineVertex = R"(#version 330 core
layout(location = 0) in vec3 start;
layout(location = 1) in vec3 finish;
layout(location = 2) in vec4 tint;
layout(location = 3) in vec4 shape;  // which end, which side, width, dash
uniform mat4 matrix;
uniform vec2 size;
out vec4 colour;
noperspective out float along;
flat out float dash;
void main() {
  vec4 a = matrix * vec4(start, 1), b = matrix * vec4(finish, 1);
  float least = 1e-4;
  if (a.w < least && b.w >= least) a = mix(a, b, (least - a.w) / (b.w - a.w));
  if (b.w < least && a.w >= least) b = mix(b, a, (least - b.w) / (a.w - b.w));
  vec2 p = a.xy / a.w * size * 0.5, q = b.xy / b.w * size * 0.5;
  vec2 way = q - p;
  float far = length(way);
  vec2 side = far > 0 ? vec2(-way.y, way.x) / far : vec2(1, 0);
  vec4 here = shape.x < 0.5 ? a : b;
  here.xy += side * shape.y * shape.z / size * here.w;
  colour = tint;
  along = shape.x < 0.5 ? 0 : far;
  dash = shape.w;
  gl_Position = here;
})";

constexpr const char* kLineFragment = R"(#version 330 core
in vec4 colour;
noperspective in float along;
flat in float dash;
uniform float opacity;
out vec4 result;
void main() {
  if (dash > 0 && mod(along, 2 * dash) > dash) discard;
  result = vec4(colour.rgb, colour.a * opacity);
})";

constexpr const char* kPictureVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
uniform mat4 matrix;
out vec2 at;
void main() {
  at = uv;
  gl_Position = matrix * vec4(position, 1);
})";

constexpr const char* kPictureFragment = R"(#version 330 core
in vec2 at;
uniform sampler2D picture;
uniform float opacity;
out vec4 result;
void main() { result = vec4(texture(picture, at).rgb, opacity); })";

unsigned compileShader(unsigned kind, const char* text) {
  const unsigned shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  int good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  char reason[1000] = "";
  glGetShaderInfoLog(shader, sizeof reason, nullptr, reason);
  throw Error(Fault::io, std::string("the graphics driver refuses a shader: ") + reason);
}

unsigned link(const char* vertex, const char* fragment) {
  const unsigned program = glCreateProgram();
  const unsigned parts[] = {compileShader(GL_VERTEX_SHADER, vertex),
                            compileShader(GL_FRAGMENT_SHADER, fragment)};
  for (unsigned part : parts) glAttachShader(program, part);
  glLinkProgram(program);
  for (unsigned part : parts) glDeleteShader(part);
  return program;
}

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
  unsigned surface = 0, line = 0, pictures = 0;  // programs
  unsigned surfaceArray = 0, lineArray = 0, pictureArray = 0;
  unsigned surfaceBuffer = 0, lineBuffer = 0, pictureBuffer = 0;
  unsigned smooth = 0, colourBuffer = 0, depthBuffer = 0;  // drawn into, several samples a pixel
  unsigned plain = 0, texture = 0;                         // the result
  int width = 0, height = 0;
  std::array<float, 16> matrix{};
  Vec3 eye;

  void resize(int w, int h) {
    if (w == width && h == height) return;
    width = w, height = h;
    glBindRenderbuffer(GL_RENDERBUFFER, colourBuffer);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, kSamples, GL_RGB8, w, h);
    glBindRenderbuffer(GL_RENDERBUFFER, depthBuffer);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, kSamples, GL_DEPTH_COMPONENT24, w, h);
    glBindFramebuffer(GL_FRAMEBUFFER, smooth);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colourBuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depthBuffer);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, w, h, 0, GL_RGB, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, plain);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  }

  void use(unsigned program) const {
    glUseProgram(program);
    glUniformMatrix4fv(glGetUniformLocation(program, "matrix"), 1, GL_TRUE, matrix.data());
  }
};

SceneDrawer::SceneDrawer() : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.surface = link(kSurfaceVertex, kSurfaceFragment);
  s.line = link(kLineVertex, kLineFragment);
  s.pictures = link(kPictureVertex, kPictureFragment);
  for (unsigned* array : {&s.surfaceArray, &s.lineArray, &s.pictureArray}) glGenVertexArrays(1, array);
  for (unsigned* buffer : {&s.surfaceBuffer, &s.lineBuffer, &s.pictureBuffer}) glGenBuffers(1, buffer);
  for (unsigned* frame : {&s.smooth, &s.plain}) glGenFramebuffers(1, frame);
  for (unsigned* buffer : {&s.colourBuffer, &s.depthBuffer}) glGenRenderbuffers(1, buffer);
  glGenTextures(1, &s.texture);

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
  for (unsigned program : {s.surface, s.line, s.pictures}) glDeleteProgram(program);
  for (unsigned* array : {&s.surfaceArray, &s.lineArray, &s.pictureArray}) glDeleteVertexArrays(1, array);
  for (unsigned* buffer : {&s.surfaceBuffer, &s.lineBuffer, &s.pictureBuffer}) glDeleteBuffers(1, buffer);
  for (unsigned* frame : {&s.smooth, &s.plain}) glDeleteFramebuffers(1, frame);
  for (unsigned* buffer : {&s.colourBuffer, &s.depthBuffer}) glDeleteRenderbuffers(1, buffer);
  glDeleteTextures(1, &s.texture);
}

void SceneDrawer::setCorners(const std::vector<float>& corners) {
  glBindBuffer(GL_ARRAY_BUFFER, state_->surfaceBuffer);
  glBufferData(GL_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(corners.size() * sizeof(float)), corners.data(),
               GL_STATIC_DRAW);
}

void SceneDrawer::begin(int width, int height, const ImVec4& background, const Matrix4& matrix,
                        const Vec3& eye) {
  State& s = *state_;
  s.resize(width, height);
  for (std::size_t i = 0; i < 16; ++i) s.matrix[i] = static_cast<float>(matrix[i / 4][i % 4]);
  s.eye = eye;
  glBindFramebuffer(GL_FRAMEBUFFER, s.smooth);
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glClearColor(background.x, background.y, background.z, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void SceneDrawer::triangles(std::size_t first, std::size_t count, const Color& colour, float opacity,
                            bool wire) {
  State& s = *state_;
  s.use(s.surface);
  glUniform3f(glGetUniformLocation(s.surface, "eye"), static_cast<float>(s.eye.x),
              static_cast<float>(s.eye.y), static_cast<float>(s.eye.z));
  glUniform4f(glGetUniformLocation(s.surface, "colour"), static_cast<float>(colour.r),
              static_cast<float>(colour.g), static_cast<float>(colour.b), opacity);
  glDepthMask(opacity < 1 ? GL_FALSE : GL_TRUE);
  glPolygonMode(GL_FRONT_AND_BACK, wire ? GL_LINE : GL_FILL);
  glBindVertexArray(s.surfaceArray);
  glDrawArrays(GL_TRIANGLES, static_cast<int>(first), static_cast<int>(count));
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDepthMask(GL_TRUE);
}

void SceneDrawer::lines(const std::vector<DrawLine>& lines, float hidden) {
  if (lines.empty()) return;
  State& s = *state_;
  std::vector<LineCorner> corners;
  corners.reserve(lines.size() * 6);
  for (const DrawLine& line : lines) {
    const auto corner = [&](float end, float side) {
      return LineCorner{line.from, line.to, line.colour, end, side, line.width, line.dash};
    };
    const LineCorner a = corner(0, -1), b = corner(0, 1), c = corner(1, 1), d = corner(1, -1);
    corners.insert(corners.end(), {a, b, c, a, c, d});
  }
  glBindVertexArray(s.lineArray);
  glBindBuffer(GL_ARRAY_BUFFER, s.lineBuffer);
  glBufferData(GL_ARRAY_BUFFER, static_cast<std::ptrdiff_t>(corners.size() * sizeof(LineCorner)),
               corners.data(), GL_STREAM_DRAW);
  s.use(s.line);
  glUniform2f(glGetUniformLocation(s.line, "size"), static_cast<float>(s.width),
              static_cast<float>(s.height));
  glDepthMask(GL_FALSE);
  const int opacity = glGetUniformLocation(s.line, "opacity");
  if (hidden > 0) {
    glDepthFunc(GL_GREATER);
    glUniform1f(opacity, hidden);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<int>(corners.size()));
  }
  glDepthFunc(GL_LEQUAL);
  glUniform1f(opacity, 1);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<int>(corners.size()));
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
}

void SceneDrawer::picture(const std::array<Point3, 4>& corners, unsigned texture, float opacity) {
  State& s = *state_;
  const PictureCorner a{corners[0], 0, 0}, b{corners[1], 1, 0}, c{corners[2], 1, 1}, d{corners[3], 0, 1};
  const PictureCorner quad[] = {a, b, c, a, c, d};
  glBindVertexArray(s.pictureArray);
  glBindBuffer(GL_ARRAY_BUFFER, s.pictureBuffer);
  glBufferData(GL_ARRAY_BUFFER, sizeof quad, quad, GL_STREAM_DRAW);
  s.use(s.pictures);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, texture);
  glUniform1i(glGetUniformLocation(s.pictures, "picture"), 0);
  glUniform1f(glGetUniformLocation(s.pictures, "opacity"), opacity);
  glDrawArrays(GL_TRIANGLES, 0, 6);
}

ImTextureID SceneDrawer::end() {
  State& s = *state_;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, s.smooth);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, s.plain);
  glBlitFramebuffer(0, 0, s.width, s.height, 0, 0, s.width, s.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_DEPTH_TEST);
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(s.texture));
}

}  // namespace trace::studio

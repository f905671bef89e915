#include "studio/space/see_through.h"

#include <initializer_list>

#include "studio/space/shader.h"
#include "studio/widgets/gl.h"

namespace trace::studio {
namespace {

// Surfaces behind so many are not seen. Where a layer cannot tell that it is empty, all are drawn.
constexpr int kMostLayers = kQueriesAnswer ? 16 : 6;
constexpr int kSolidUnit = 1, kBeforeUnit = 2;  // units of textures

/// One triangle over everything.
constexpr const char* kOverVertex = R"(out vec2 at;
void main() {
  at = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
  gl_Position = vec4(2.0 * at - 1.0, 0, 1);
})";

constexpr const char* kOverFragment = R"(in vec2 at;
uniform sampler2D layer;
uniform bool weighted;
out vec4 result;
void main() {
  vec4 c = texture(layer, at);
  result = weighted ? c : vec4(c.rgb * c.a, c.a);
})";

}  // namespace

struct SeeThrough::State {
  unsigned over = 0, nothing = 0;  // the program, and a vertex array without attributes
  unsigned solid = 0;              // texture, of whoever draws
  unsigned before[2] = {}, colour = 0,
           sum = 0;  // textures; of `sum` colours are times their opacity
  unsigned layerFrames[2] = {}, sumFrame = 0;
  unsigned query = 0;
  int width = 0, height = 0, layers = 0;

  void texture(unsigned name, int format, unsigned content, unsigned type, int filter) const {
    glBindTexture(GL_TEXTURE_2D, name);
    glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, content, type, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  }

  void resize(int w, int h) {
    if (w == width && h == height) return;
    width = w;
    height = h;
    // Depths as they are: rounded ones would let a surface show through itself.
    for (const unsigned depth : {before[0], before[1]})
      texture(depth, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT, GL_NEAREST);
    for (const unsigned picture : {colour, sum})
      texture(picture, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, GL_NEAREST);
    const auto attach = [](unsigned frame, unsigned depth, unsigned picture) {
      glBindFramebuffer(GL_FRAMEBUFFER, frame);
      if (depth) glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth, 0);
      glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture, 0);
    };
    for (int i = 0; i < 2; ++i) attach(layerFrames[i], before[i], colour);
    attach(sumFrame, 0, sum);
  }

  /// Lays a texture over the frame buffer that is bound.
  void lay(unsigned picture, bool weighted) const {
    glUseProgram(over);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, picture);
    glUniform1i(glGetUniformLocation(over, "layer"), 0);
    glUniform1i(glGetUniformLocation(over, "weighted"), weighted);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBindVertexArray(nothing);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
  }
};

SeeThrough::SeeThrough() : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.over = linkProgram(kOverVertex, kOverFragment);
  glGenVertexArrays(1, &s.nothing);
  for (unsigned* name : {&s.before[0], &s.before[1], &s.colour, &s.sum}) glGenTextures(1, name);
  for (unsigned* name : {&s.layerFrames[0], &s.layerFrames[1], &s.sumFrame}) glGenFramebuffers(1, name);
  glGenQueries(1, &s.query);
}

SeeThrough::~SeeThrough() {
  State& s = *state_;
  glDeleteProgram(s.over);
  glDeleteVertexArrays(1, &s.nothing);
  for (unsigned* name : {&s.before[0], &s.before[1], &s.colour, &s.sum}) glDeleteTextures(1, name);
  for (unsigned* name : {&s.layerFrames[0], &s.layerFrames[1], &s.sumFrame}) glDeleteFramebuffers(1, name);
  glDeleteQueries(1, &s.query);
}

void SeeThrough::begin(int width, int height, unsigned solidDepth) {
  State& s = *state_;
  s.resize(width, height);
  s.solid = solidDepth;
  s.layers = 0;
  glViewport(0, 0, width, height);
  glClearColor(0, 0, 0, 0);
  glBindFramebuffer(GL_FRAMEBUFFER, s.sumFrame);
  glClear(GL_COLOR_BUFFER_BIT);
  glBindFramebuffer(GL_FRAMEBUFFER, s.layerFrames[1]);  // that the first layer takes for the one before
  clearDepthTo(0);
  glClear(GL_DEPTH_BUFFER_BIT);
  clearDepthTo(1);
}

bool SeeThrough::nextLayer() {
  State& s = *state_;
  if (s.layers > 0) {
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    unsigned any = 1;
    if (kQueriesAnswer) glGetQueryObjectuiv(s.query, GL_QUERY_RESULT, &any);
    if (any) {  // under what is there
      glBindFramebuffer(GL_FRAMEBUFFER, s.sumFrame);
      glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
      s.lay(s.colour, false);
      glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    }
    if (!any || s.layers == kMostLayers) return false;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, s.layerFrames[s.layers % 2]);
  glDisable(GL_BLEND);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glActiveTexture(GL_TEXTURE0 + kSolidUnit);
  glBindTexture(GL_TEXTURE_2D, s.solid);
  glActiveTexture(GL_TEXTURE0 + kBeforeUnit);
  glBindTexture(GL_TEXTURE_2D, s.before[(s.layers + 1) % 2]);
  glActiveTexture(GL_TEXTURE0);
  ++s.layers;
  glBeginQuery(GL_ANY_SAMPLES_PASSED, s.query);
  return true;
}

void SeeThrough::end() { state_->layers = 0; }

void SeeThrough::useIn(unsigned program) const {
  glUniform1i(glGetUniformLocation(program, "solidDepth"), kSolidUnit);
  glUniform1i(glGetUniformLocation(program, "depthBefore"), kBeforeUnit);
  glUniform1i(glGetUniformLocation(program, "peels"), state_->layers > 0);
}

void SeeThrough::layOver(unsigned frameBuffer) {
  State& s = *state_;
  glBindFramebuffer(GL_FRAMEBUFFER, frameBuffer);
  glViewport(0, 0, s.width, s.height);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  s.lay(s.sum, true);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glActiveTexture(GL_TEXTURE0 + kSolidUnit);  // which is drawn into next
  glBindTexture(GL_TEXTURE_2D, 0);
  glActiveTexture(GL_TEXTURE0);
  s.layers = 0;
}

}  // namespace trace::studio

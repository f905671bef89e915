// Surfaces that let others show through, each pixel of them from the nearest to the farthest: depth peeling
// (Everitt, "Interactive Order-Independent Transparency", 2001). Layer after layer the nearest surface behind
// the layer before is drawn, so neither the order of objects and triangles matters nor where they intersect.
#pragma once

#include <memory>

namespace trace::studio {

class SeeThrough {
 public:
  SeeThrough();  ///< an OpenGL context must be current
  ~SeeThrough();
  SeeThrough(const SeeThrough&) = delete;
  SeeThrough& operator=(const SeeThrough&) = delete;

  /// Before the first layer. The texture has the depth of what is solid.
  void begin(int width, int height, unsigned solidDepth);
  /// From now on what lets others show through is to be drawn, with the uniforms of useIn(); false if there
  /// was nothing left in the layer before.
  bool nextLayer();
  /// For a program whose fragment shader begins with kDeclarations and calls peel() first; also before
  /// begin().
  void useIn(unsigned program) const;
  /// From now on all is drawn that useIn() is called for.
  void end();
  /// Lays the layers over the frame buffer of the size given to begin().
  void layOver(unsigned frameBuffer);

  /// peel() discards what is not of this layer.
  static constexpr const char* kDeclarations = R"(
uniform sampler2D solidDepth, depthBefore;
uniform bool peels;
void peel() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  if (peels && (gl_FragCoord.z >= texelFetch(solidDepth, at, 0).r ||
                gl_FragCoord.z <= texelFetch(depthBefore, at, 0).r)) discard;
}
)";

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trace::studio

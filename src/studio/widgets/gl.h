// OpenGL: 3.3 on the desktop, ES 3.0 in a browser (WebGL 2), and how the two differ.
#pragma once

#if defined(__EMSCRIPTEN__)
#include <GLES3/gl3.h>
#else
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#endif

namespace trace::studio {

#if defined(__EMSCRIPTEN__)
/// The first lines of each shader. ES makes no float of a whole number: shaders write 2.0.
inline constexpr const char* kShaderHead =
    "#version 300 es\nprecision highp float;\nprecision highp sampler2D;\n";
inline constexpr const char* kShaderVersion = "#version 300 es";
/// A query can be read in the frame that asks it.
inline constexpr bool kQueriesAnswer = false;
/// A sum of pictures, more exact than bytes.
inline constexpr int kFineFormat = GL_RGBA16F;
inline constexpr unsigned kFineType = GL_FLOAT;
inline void clearDepthTo(float depth) { glClearDepthf(depth); }
#else
inline constexpr const char* kShaderHead = "#version 330 core\n";
inline constexpr const char* kShaderVersion = "#version 330 core";
inline constexpr bool kQueriesAnswer = true;
inline constexpr int kFineFormat = GL_RGBA16;
inline constexpr unsigned kFineType = GL_UNSIGNED_SHORT;
inline void clearDepthTo(float depth) { glClearDepth(depth); }
#endif

}  // namespace trace::studio

// OpenGL: 3.3 on the desktop, ES 3.0 in a browser (WebGL 2), and how the two differ.
#pragma once

#if defined(__EMSCRIPTEN__)
#include <GLES3/gl3.h>
#else
#define GLFW_INCLUDE_GLCOREARB  // the types of OpenGL's functions; whoever needs GLFW includes this file
#include <GLFW/glfw3.h>
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
/// The browser has the functions of OpenGL.
inline void loadGl() {}
#else
/// The functions of OpenGL that the studio calls: its type and its name.
// clang-format off
#define TRACE_GL_FUNCTIONS(F) \
  F(ACTIVETEXTURE, ActiveTexture) F(ATTACHSHADER, AttachShader) F(BEGINQUERY, BeginQuery) \
  F(BINDBUFFER, BindBuffer) F(BINDFRAMEBUFFER, BindFramebuffer) F(BINDTEXTURE, BindTexture) \
  F(BINDVERTEXARRAY, BindVertexArray) F(BLENDCOLOR, BlendColor) F(BLENDFUNC, BlendFunc) \
  F(BUFFERDATA, BufferData) F(CLEAR, Clear) F(CLEARCOLOR, ClearColor) F(CLEARDEPTH, ClearDepth) \
  F(COMPILESHADER, CompileShader) F(CREATEPROGRAM, CreateProgram) F(CREATESHADER, CreateShader) \
  F(DELETEBUFFERS, DeleteBuffers) F(DELETEFRAMEBUFFERS, DeleteFramebuffers) \
  F(DELETEPROGRAM, DeleteProgram) F(DELETEQUERIES, DeleteQueries) F(DELETESHADER, DeleteShader) \
  F(DELETETEXTURES, DeleteTextures) F(DELETEVERTEXARRAYS, DeleteVertexArrays) F(DEPTHFUNC, DepthFunc) \
  F(DEPTHMASK, DepthMask) F(DISABLE, Disable) F(DRAWARRAYS, DrawArrays) F(DRAWELEMENTS, DrawElements) \
  F(ENABLE, Enable) F(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray) F(ENDQUERY, EndQuery) \
  F(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D) F(GENBUFFERS, GenBuffers) \
  F(GENFRAMEBUFFERS, GenFramebuffers) F(GENQUERIES, GenQueries) F(GENTEXTURES, GenTextures) \
  F(GENVERTEXARRAYS, GenVertexArrays) F(GENERATEMIPMAP, GenerateMipmap) F(GETINTEGERV, GetIntegerv) \
  F(GETQUERYOBJECTUIV, GetQueryObjectuiv) F(GETSHADERINFOLOG, GetShaderInfoLog) \
  F(GETSHADERIV, GetShaderiv) F(GETUNIFORMLOCATION, GetUniformLocation) F(LINKPROGRAM, LinkProgram) \
  F(PIXELSTOREI, PixelStorei) F(READBUFFER, ReadBuffer) F(READPIXELS, ReadPixels) \
  F(SHADERSOURCE, ShaderSource) F(TEXIMAGE2D, TexImage2D) F(TEXPARAMETERI, TexParameteri) \
  F(UNIFORM1F, Uniform1f) F(UNIFORM1I, Uniform1i) F(UNIFORM2F, Uniform2f) F(UNIFORM3F, Uniform3f) \
  F(UNIFORM3FV, Uniform3fv) F(UNIFORM4F, Uniform4f) F(UNIFORM4FV, Uniform4fv) \
  F(UNIFORMMATRIX4FV, UniformMatrix4fv) F(USEPROGRAM, UseProgram) \
  F(VERTEXATTRIBPOINTER, VertexAttribPointer) F(VIEWPORT, Viewport)
// clang-format on
#define TRACE_GL_POINTER(TYPE, NAME) inline PFNGL##TYPE##PROC gl##NAME = nullptr;
TRACE_GL_FUNCTIONS(TRACE_GL_POINTER)
#undef TRACE_GL_POINTER
/// Asks the driver of the current context for these functions: not every system links them. Throws
/// Error(Fault::io) if it lacks one.
void loadGl();
inline constexpr const char* kShaderHead = "#version 330 core\n";
inline constexpr const char* kShaderVersion = "#version 330 core";
inline constexpr bool kQueriesAnswer = true;
inline constexpr int kFineFormat = GL_RGBA16;
inline constexpr unsigned kFineType = GL_UNSIGNED_SHORT;
inline void clearDepthTo(float depth) { glClearDepth(depth); }
#endif

}  // namespace trace::studio

#include "studio/space/shader.h"

#include <string>

#include "base/error.h"
#include "studio/widgets/gl.h"

namespace trace::studio {
namespace {

unsigned compileShader(unsigned kind, const char* text) {
  const unsigned shader = glCreateShader(kind);
  const char* parts[] = {kShaderHead, text};
  glShaderSource(shader, 2, parts, nullptr);
  glCompileShader(shader);
  int good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  char reason[1000] = "";
  glGetShaderInfoLog(shader, sizeof reason, nullptr, reason);
  throw Error(Fault::io, std::string("the graphics driver refuses a shader: ") + reason);
}

}  // namespace

unsigned linkProgram(const char* vertex, const char* fragment) {
  const unsigned program = glCreateProgram();
  const unsigned parts[] = {compileShader(GL_VERTEX_SHADER, vertex),
                            compileShader(GL_FRAGMENT_SHADER, fragment)};
  for (unsigned part : parts) glAttachShader(program, part);
  glLinkProgram(program);
  for (unsigned part : parts) glDeleteShader(part);
  return program;
}

}  // namespace trace::studio

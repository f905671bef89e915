#include "studio/widgets/gl.h"

#if !defined(__EMSCRIPTEN__)
#include <string>

#include "base/error.h"

namespace trace::studio {
namespace {

template <class Function>
void load(Function& function, const char* name) {
  function = reinterpret_cast<Function>(glfwGetProcAddress(name));
  if (!function)
    throw Error(Fault::io, "OpenGL has no function " + std::string(name),
                "the studio needs OpenGL 3.3; \"ray SCENE\" renders without it");
}

}  // namespace

void loadGl() {
#define TRACE_GL_LOAD(TYPE, NAME) load(gl##NAME, "gl" #NAME);
  TRACE_GL_FUNCTIONS(TRACE_GL_LOAD)
#undef TRACE_GL_LOAD
}

}  // namespace trace::studio
#endif

// Programs of OpenGL out of the text of their shaders.
#pragma once

namespace trace::studio {

/// Throws Error(Fault::io) with the driver's reason.
unsigned linkProgram(const char* vertex, const char* fragment);

}  // namespace trace::studio

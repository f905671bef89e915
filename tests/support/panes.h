// A scene of which any part can take for ever: two panes of glass split each ray as often as the depth
// allows.
#pragma once

namespace trace::test {

inline constexpr const char* kPanes = R"(SBT-raytracer 1.0
camera { position=(0,0,9); viewdir=(0,0,-1); updir=(0,1,0); }
point_light { position=(0,0,5); color=(1,1,1); }
material = { reflective=(1,1,1); transmissive=(1,1,1); index=1; }
scale(99,99,1, box {})
translate(0,0,-2, scale(99,99,1, box {}))
)";

}  // namespace trace::test

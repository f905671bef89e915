// Builds a scene of three things; what it leaves out, Trace completes. Usage: build_a_scene PICTURE
#include <traceray/traceray.h>

int main(int, char** arguments) {
  using traceray::Node;
  traceray::Scene scene;
  scene.add(Node("plane", {{"translate", {0, -1, 0}}})).set("material", "red granite");
  scene.add(Node("sphere", {{"material", Node("phong", {{"diffuse", {0.8, 0.1, 0.1}}})}}));
  scene.add(Node("point_light", {{"position", {3, 4, 5}}, {"color", {1, 1, 1}}}));
  scene.render({{"width", 64}, {"quality", "draft"}}).write(arguments[1]);
}

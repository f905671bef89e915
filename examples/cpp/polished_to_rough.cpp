// Renders a ball of gold three times, each rougher than before. Usage: polished_to_rough
#include <traceray/traceray.h>

#include <iostream>

int main() try {
  using traceray::Node;
  traceray::Scene scene;
  scene.add(Node("plane", {{"translate", {0, -1, 0}}, {"material", "slate"}}));
  traceray::Part ball = scene.add(Node("sphere", {{"material", Node("conductor", {{"metal", "gold"}})}}));

  for (int percent : {5, 20, 60}) {
    ball.material().set("roughness", percent / 100.0);
    traceray::Render picture = scene.render({{"width", 160}, {"quality", "draft"}});
    std::cout << picture.write("gold-" + std::to_string(percent) + ".png") << "\n";
  }
} catch (const traceray::Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}

// Renders a scene file. Usage: open_and_render SCENE PICTURE
#include <traceray/traceray.h>

#include <iostream>

int main(int count, char** arguments) try {
  if (count != 3) return std::cerr << "Usage: open_and_render SCENE PICTURE\n", 2;
  const traceray::Scene scene = traceray::Scene::open(arguments[1]);
  std::cout << scene.render({{"width", 64}, {"spp", 1}}).write(arguments[2]) << "\n";
} catch (const traceray::Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}

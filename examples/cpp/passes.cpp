// The depth in the middle of a picture. Usage: passes SCENE
#include <traceray/traceray.h>

#include <iostream>

int main(int count, char** arguments) try {
  if (count != 2) return std::cerr << "Usage: passes SCENE\n", 2;
  const traceray::Scene scene = traceray::Scene::open(arguments[1]);
  const traceray::Render picture = scene.render({{"width", 64}, {"spp", 1}, {"passes", {"depth", "normal"}}});
  const int x = picture.width() / 2, y = picture.height() / 2;
  std::cout << "depth " << picture.pass("depth").pixel(x, y)[0] << ", red " << picture.image().pixel(x, y)[0]
            << "\n";
} catch (const traceray::Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}

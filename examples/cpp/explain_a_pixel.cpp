// Tells why a pixel has its colour. Usage: explain_a_pixel SCENE X Y
#include <traceray/traceray.h>

#include <cstdlib>
#include <iostream>

int main(int count, char** arguments) try {
  if (count != 4) return std::cerr << "Usage: explain_a_pixel SCENE X Y\n", 2;
  const traceray::Scene scene = traceray::Scene::open(arguments[1], {{"width", 64}});
  const auto why = scene.explain(std::atoi(arguments[2]), std::atoi(arguments[3]));
  std::cout << why.text();
  return why.agrees() ? 0 : 1;
} catch (const traceray::Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}

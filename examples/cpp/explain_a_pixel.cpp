// Tells why a pixel has its colour. Usage: explain_a_pixel SCENE X Y
#include <traceray/traceray.h>

#include <cstdlib>
#include <iostream>

int main(int, char** arguments) {
  const traceray::Scene scene = traceray::Scene::open(arguments[1], {{"width", 64}});
  const auto why = scene.explain(std::atoi(arguments[2]), std::atoi(arguments[3]));
  std::cout << why.text();
  return why.agrees() ? 0 : 1;
}

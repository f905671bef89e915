// Stops a long render after a tenth of a second, and keeps what was traced. Usage: progress_and_cancel SCENE
// PICTURE
#include <traceray/traceray.h>

#include <iostream>

int main(int, char** arguments) {
  const traceray::Scene scene = traceray::Scene::open(arguments[1]);
  traceray::Render picture =
      scene.render({{"width", 64}, {"spp", 65536}}, [](const traceray::Progress& progress) {
        std::cout << 100 * progress.fraction << " %\n";
        return progress.fraction == 0;  // false stops
      });
  std::cout << picture.end() << ", written to " << picture.write(arguments[2]) << "\n";
}

// bench_recording[_never] SCENE WIDTH: the CPU seconds of rendering the scene once, on one thread, without
// reading and building it. Built twice: as the programs are, where rays can be recorded but are not, and from
// a render floor whose code to record is gone. recording.sh runs the two in turn.
#include <cstdio>
#include <cstdlib>

#include "base/error.h"
#include "formats/format.h"
#include "render/picture/passes.h"
#include "render/picture/render.h"
#include "scene/options.h"
#include "stopwatch.h"

int main(int argc, char** argv) {
  using namespace trace;
  if (argc != 3) return std::fputs("expected a scene and a width\n", stderr), 2;
  try {
    Messages messages;
    const Scene scene = readScene(argv[1], messages);
    const Settings settings = resolve(
        {scene.choices, std::vector<Choice>{{"width", argv[2], {}}, {"spp", "1", {}}, {"threads", "1", {}}}});
    const World world = compile(scene, settings, messages);
    const Size size = pictureSize(settings, scene.camera);
    Film film = makeFilm(settings, size.width, size.height);
    Job job;
    const double before = bench::processSeconds();
    render(world, settings, film, job);
    std::printf("%.6f\n", bench::processSeconds() - before);
    return 0;
  } catch (const Error& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
}

// ray stereogram SCENE -o OUT: the distances that the camera sees, hidden in a picture of dots.
#include <chrono>
#include <limits>
#include <optional>
#include <string>

#include "app/session/remaining_time.h"
#include "app/session/session.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/parallel.h"
#include "cli/commands/commands.h"
#include "cli/render_steps.h"
#include "image/codecs/codec.h"
#include "image/development/stereogram.h"

namespace trace::cli {
namespace {

/// Along the view, of the first surface in the middle of each pixel; infinite where there is none.
Picture distancesSeen(const World& world, const Size& size, int threads) {
  Picture distances(size.width, size.height);
  const CameraFrame& camera = world.camera();
  const Work work("measuring distances", size.height);
  Job job;
  parallelChunks(size.height, threads, job, [&](std::int64_t row, int) {
    const int y = static_cast<int>(row);
    Statistics uncounted;
    for (int x = 0; x < size.width; ++x) {
      const Ray ray = camera.ray({(x + 0.5) / size.width, 1 - (y + 0.5) / size.height});
      const auto found = world.closest(ray, Faces::both, uncounted);
      const bool seen = found && camera.sees(found->t);
      distances.at(x, y) =
          Color(seen ? found->t * dot(ray.direction, camera.ahead) : std::numeric_limits<Real>::infinity());
    }
  });
  return distances;
}

}  // namespace

int stereogramCommand(const Arguments& arguments, const Console& console) {
  const auto start = std::chrono::steady_clock::now();
  if (arguments.files.size() != 1)
    throw Error(Fault::usage,
                "ray stereogram: expected one scene, found " + std::to_string(arguments.files.size()));
  if (arguments.output.empty())
    throw Error(Fault::usage, "ray stereogram: expected a picture to write", "-o dots.png");
  pictureFormatFor(arguments.output);
  checkDistinct(arguments.files[0], arguments.output);
  checkWritable(arguments.output);
  std::optional<Picture> pattern;
  StereogramRules rules;
  rules.eyes = 2.5 * arguments.dotsPerInch;
  rules.depth = arguments.stereoDepth;
  rules.guides = arguments.guides;
  if (!arguments.pattern.empty()) {
    checkDistinct(arguments.pattern, arguments.output);
    pattern = readPicture(arguments.pattern);
    rules.pattern = &*pattern;
  }
  Session session;
  session.open(arguments.files[0], arguments.choices, arguments.strict);
  session.build();
  console.warnings(session.messages().all());
  const Settings& settings = session.settings();
  rules.nearest = settings.passNear;
  rules.farthest = settings.passFar;
  rules.seed = static_cast<std::uint64_t>(settings.seed);
  const Size size = session.size();
  checkIsNoInput(arguments.output, session.scene().inputs);
  checkEncodable(pictureFormatFor(arguments.output), size.width, size.height);
  if (size.width < 2 * rules.eyes)
    console.line(LogLevel::warning,
                 "warning: the picture is less than four repeats wide, so little of its depth can be seen; a "
                 "larger -w or a smaller --dpi helps");
  const Picture picture = stereogram(distancesSeen(session.world(), size, settings.threads), rules);
  writePicture(arguments.output, picture, Rounding::nearest);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  console.last(true, "wrote " + arguments.output + " (" + std::to_string(size.width) + "x" +
                         std::to_string(size.height) + ", a stereogram) in " + durationText(elapsed.count()));
  return kDone;
}

}  // namespace trace::cli

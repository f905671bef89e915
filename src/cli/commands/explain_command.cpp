// ray explain SCENE --pixel X,Y: why a pixel has its colour.
//
// The pixel is rendered as a render does it and, apart from that, traced with a record of every ray; the two
// must agree bit for bit.
#include <array>
#include <filesystem>

#include "app/explain/explain_json.h"
#include "app/explain/explain_text.h"
#include "app/explain/explained_rays.h"
#include "app/session/session.h"
#include "app/view/ray_drawing.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/render_steps.h"
#include "cli/terminal/terminal.h"
#include "image/codecs/codec.h"
#include "scene/integrators.h"

namespace trace::cli {
namespace {

constexpr std::array<std::string_view, 5> kExplainFormats{"text", "json", "obj", "svg", "png"};

/// Whole numbers with commas between, as many as asked. Throws Error(Fault::usage).
template <std::size_t N>
std::array<int, N> wholeNumbers(const std::string& flag, const std::string& text, const char* expected,
                                const char* hint) {
  std::array<int, N> numbers{};
  std::string_view rest = text;
  for (std::size_t i = 0; i < N; ++i) {
    const auto number = parseNumber(rest);
    const bool good = number && number->value >= 0 && number->value < 1e6 &&
                      number->value == static_cast<int>(number->value) &&
                      (number->length < rest.size() ? i + 1 < N && rest[number->length] == ',' : i + 1 == N);
    if (!good) throw Error(Fault::usage, flag + ": expected " + expected + ", found \"" + text + "\"", hint);
    numbers[i] = static_cast<int>(number->value);
    rest.remove_prefix(std::min(number->length + 1, rest.size()));
  }
  return numbers;
}

/// As chosen, or by the suffix of the file to write. Throws Error(Fault::usage) for one that promises
/// something else, such as .jpg.
std::string_view formatOf(const Arguments& arguments) {
  if (arguments.format) return chosenFormat(arguments, "explain", kExplainFormats);
  const std::string suffix = std::filesystem::path(arguments.output).extension().generic_string();
  for (std::string_view format : kExplainFormats)
    if (suffix == "." + std::string(format)) return format;
  if (suffix.empty() || suffix == ".txt" || suffix == ".log") return "text";
  throw Error(
      Fault::usage,
      "expected a name that ends in .txt, .json, .obj, .svg or .png, found \"" + arguments.output + "\"",
      "--format text writes text to a file of any name");
}

}  // namespace

int explainCommand(const Arguments& arguments, const Console& console) {
  if (arguments.files.size() != 1)
    throw Error(Fault::usage,
                "ray explain: expected the name of one scene file, found " +
                    (arguments.files.empty() ? "none" : std::to_string(arguments.files.size())),
                "ray explain SCENE --pixel X,Y");
  if (arguments.pixel.empty())
    throw Error(Fault::usage, "ray explain: expected --pixel X,Y, found none",
                "--pixel 0,0 is at the top left of the picture");
  const auto [x, y] = wholeNumbers<2>("--pixel", arguments.pixel, "two whole numbers X,Y from 0 on",
                                      "--pixel 0,0 is at the top left of the picture");
  const int sample = arguments.sample.empty()
                         ? 0
                         : wholeNumbers<1>("--sample", arguments.sample, "a whole number",
                                           "--sample 0 is the first; the answer lists the colours of all")[0];
  for (const Choice& choice : arguments.choices) {
    if (choice.option != "region") continue;
    Settings given;
    findOption("region").assign(given, choice.value);
    const Region& r = given.region;
    if (!r.whole() && !(r.x0 <= x && x < r.x1 && r.y0 <= y && y < r.y1))
      throw Error(Fault::usage, "--pixel " + arguments.pixel + " lies outside of --region " + choice.value,
                  "pixels are counted from the top left of the whole picture");
  }
  const std::string_view format = formatOf(arguments);
  if (arguments.lightImage && format != "text" && format != "json")
    throw Error(Fault::usage, "--light-image: expected --format text or json, found " + std::string(format),
                "a drawing shows the rays of one sample; the text names samples whose paths landed here");
  if (format == "png" && arguments.output.empty())
    throw Error(Fault::usage, "ray explain --format png: expected the name of a file, found none",
                "-o rays.png");
  checkDistinct(arguments.files[0], arguments.output);
  if (!arguments.output.empty()) checkWritable(arguments.output);

  std::optional<Session> opened(std::in_place);
  std::vector<Choice> choices = arguments.choices;
  const auto corner = [](int u, int v) { return std::to_string(u) + "," + std::to_string(v); };
  choices.push_back({"region", corner(x, y) + "," + corner(x + 1, y + 1), {}});
  opened->open(arguments.files[0], choices, arguments.strict);
  const std::string asked(rowOf(opened->settings()).name);
  const bool byChains = hasTrait(opened->settings(), Trait::byChains);
  const bool bothWays = byChains && hasTrait(opened->settings(), Trait::joinsEnds);
  if (arguments.lightImage && !bothWays && !hasLightImage(opened->settings()))
    throw Error(Fault::usage,
                "--light-image: expected --integrator bdpt, which has one, found " + asked +
                    (byChains ? " --chains " + findOption("chains").get(opened->settings()) : ""));
  if (byChains) {
    const std::string shown = bothWays ? "bdpt" : "path";
    console.line(LogLevel::info,
                 "note: chains make this picture, in no order of pixels; shown are paths of --integrator " +
                     shown + ", whose mean they converge to, and a chain that visits the pixel");
    const auto ofChains = integratorsWith(Trait::byChains);
    std::erase_if(choices,
                  [&](const Choice& choice) { return findOption(choice.option).integrators == ofChains; });
    choices.push_back({"integrator", shown, {}});
    opened.emplace().open(arguments.files[0], choices, arguments.strict);
  }
  Session& session = *opened;
  if (!arguments.output.empty()) checkIsNoInput(arguments.output, session.scene().inputs);
  session.build();
  std::optional<ChainWalk> chain;
  if (byChains) {  // chains belong to the whole picture, with the options that were chosen for it
    const auto whole = std::make_shared<Session>();
    whole->open(arguments.files[0], arguments.choices, arguments.strict);
    whole->build();
    console.warnings(whole->messages().all());
    chain = ChainWalker(whole, {}).near(x, y, {});
  } else {
    console.warnings(session.messages().all());
  }
  const Work work("explaining the pixel");
  const Explanation explanation = session.explain(x, y, sample);
  if (const RenderResult result = session.renderPicture();
      result.end != End::finished)  // not the whole pixel
    throw Error(Fault::limit, "the pixel was not finished: " + whyStopped(result));
  std::optional<LightLandings> light;
  if (arguments.lightImage) {
    Session whole;  // not built: of its settings the region counts
    whole.open(arguments.files[0], arguments.choices, arguments.strict);
    Job job;
    light = lightLandings(session, whole.settings().region, x, y, job);
  }
  const Size size = session.size();
  const Scene& scene = session.sceneOf(explanation.tree);
  const std::vector<ExplainedRay> rays = explainedRays(explanation.tree, scene);
  const PixelFacts facts{scene,
                         explanation,
                         rays,
                         size.width,
                         size.height,
                         session.film().ofSamples(x, y),
                         session.settings(),
                         chain ? &*chain : nullptr,
                         light ? &*light : nullptr};
  const int code = facts.agrees() ? kDone : kFailed;

  const auto drawing = [&] {
    return drawRays(session.sceneOf(explanation.tree), session.settings(), session.worldOf(explanation.tree),
                    explanation.tree);
  };
  if (format == "png") {
    writePicture(arguments.output, toPicture(drawing()), Rounding::nearest);
    console.line(LogLevel::info, "wrote " + arguments.output);
    return code;
  }
  const std::string text = format == "json"  ? explainJson(facts)
                           : format == "obj" ? raysAsObj(explanation.tree, rays)
                           : format == "svg"
                               ? toSvg(drawing())
                               : explainText(facts, arguments.output.empty() && canColorResult());
  if (arguments.output.empty()) {
    printResult(text, format == "text" ? Paint::colors : Paint::none);
  } else {
    writeFile(arguments.output, text);
    console.line(LogLevel::info, "wrote " + arguments.output);
  }
  if (code != kDone)
    console.line(LogLevel::error, "the rays do not sum to the picture's pixel: please report this");
  return code;
}

}  // namespace trace::cli

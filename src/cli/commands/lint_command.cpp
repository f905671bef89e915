// ray lint SCENE: what is likely a mistake, for people or as JSON. Schema: docs/lint.md.
#include <algorithm>
#include <array>

#include "app/advice/auto_exposure.h"
#include "app/lint/lint.h"
#include "app/session/json.h"
#include "app/session/render_warnings.h"
#include "app/session/session.h"
#include "base/files/file.h"
#include "base/printable.h"
#include "cli/commands/commands.h"
#include "cli/text/scene_facts.h"

namespace trace::cli {
namespace {

std::string lintText(const std::string& scene, std::span<const LintFinding> findings) {
  std::string text;
  for (const LintFinding& finding : findings) {
    std::string message = toString(finding.message);
    const std::size_t end = message.find('\n');  // end of the first line
    text += message.insert(end, " [" + std::string(finding.check) + "]");
  }
  return text + printable(scene) + ": " +
         (findings.empty() ? "no problems found" : counted(findings.size(), "finding")) + "\n";
}

std::string lintJson(const std::string& scene, std::span<const LintFinding> findings) {
  Json json;
  json["schema"] = "trace-lint";
  json["version"] = 1;
  json["scene"] = scene;
  json["findings"] = Json::list();
  for (const LintFinding& finding : findings) {
    const SourcePlace& place = finding.message.place;
    json["findings"].add({{"check", finding.check},
                          {"file", place.file.str()},
                          {"line", place.line},
                          {"column", place.column},
                          {"what", finding.message.what},
                          {"hint", finding.message.hint}});
  }
  return json.text(2) + "\n";
}

}  // namespace

int lintCommand(const Arguments& arguments, const Console& console) {
  if (arguments.files.size() != 1)
    throw Error(Fault::usage,
                "ray lint: expected the name of one scene file, found " +
                    (arguments.files.empty() ? "none" : std::to_string(arguments.files.size())));
  const bool json = chosenFormat(arguments, "lint", kTextOrJson) == "json";
  checkDistinct(arguments.files[0], arguments.output);
  if (!arguments.output.empty()) checkWritable(arguments.output);
  Session session;
  session.open(arguments.files[0], arguments.choices, arguments.strict);
  if (!arguments.output.empty()) checkIsNoInput(arguments.output, session.scene().inputs);
  Messages messages = session.messages();
  const World world = compile(session.scene(), session.settings(), messages);
  warnOfSettings(session.scene(), session.settings(), world, messages);
  Settings settings = session.settings();
  const std::optional<Real> exposure = settleExposure(world, settings);
  const std::vector<LintFinding> findings = lint(session.scene(), settings, world, messages.all(), exposure);
  const std::string& scene = session.scene().file;
  const std::string text = json ? lintJson(scene, findings) : lintText(scene, findings);
  const bool choosesQuality = std::any_of(arguments.choices.begin(), arguments.choices.end(),
                                          [](const Choice& choice) { return choice.option == "quality"; });
  if (const std::string chosen = chosenText(session.scene(), settings, exposure.value_or(0)); !chosen.empty())
    console.line(LogLevel::info,
                 "note: " + chosen +
                     (choosesQuality || settings.quality == Quality::none
                          ? ""
                          : "; checked for this quality, and with --quality draft for a draft"));
  if (arguments.output.empty()) {
    printResult(text);
  } else {
    writeFile(arguments.output, text);
    console.line(LogLevel::info, "wrote " + arguments.output);
  }
  return findings.empty() ? kDone : kFound;
}

}  // namespace trace::cli

// ray features: what this program can do, from its tables.
#include <string>

#include "app/compare/extensions.h"
#include "base/files/file.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/flags.h"
#include "cli/text/completion.h"
#include "cli/text/help.h"
#include "cli/text/manual.h"
#include "formats/format.h"
#include "image/codecs/codec.h"
#include "render/picture/passes.h"
#include "scene/integrators.h"
#include "scene/scene_features.h"
#include "shading/library.h"
#include "shading/material.h"
#include "shading/optics/substances.h"

namespace trace::cli {
namespace {

std::string featureRow(std::string_view name, std::string_view help) {
  std::string text = "  " + std::string(name);
  text.resize(std::max<size_t>(text.size() + 2, 20), ' ');
  return text + std::string(help) + "\n";
}

std::string featuresText() {
  std::string text = "extras (off by default; --enable NAME)\n";
  for (const Option& option : options())
    if (option.extra)
      text += featureRow(option.name,
                         std::string(option.help) + "; enabled: " + std::string(enabledValue(option)));
  text += "extensions, with their examples (docs/features shows each off and on; --without NAME)\n";
  for (const Extension& e : extensions()) {
    std::string words(e.adds);
    words += "; scenes/" + std::string(e.scene);
    if (!e.off.empty()) words += "; off: " + std::string(e.off);
    if (!e.on.empty()) words += "; on: " + std::string(e.on);
    text += featureRow(e.name, words);
  }
  text += "parts of scenes (--without NAME shows the scene without them)\n";
  for (const SceneFeatureRow& part : sceneFeatures())
    if (!part.scene.empty())
      text += featureRow(part.name,
                         "without it: " + std::string(part.without) + "; scenes/" + std::string(part.scene));
  text += "integrators\n";
  for (const IntegratorRow& integrator : integrators()) text += featureRow(integrator.name, integrator.help);
  text += "passes (--passes NAME,NAME)\n";
  for (const PassRow& pass : passRows()) text += featureRow(pass.name, pass.help);
  text += "shading models (material = { model = NAME; ... })\n";
  for (const ModelType& type : modelTypes()) text += featureRow(type.keyword, type.help);
  text += "materials of the library (material = { library = NAME; })\n";
  for (const Finish& finish : finishes())
    text += featureRow(finish.name, std::string(finish.group) + ", " + std::string(finish.looks));
  for (const Substance& substance : substances())
    text += featureRow(substance.name, std::string(substance.group) + ", index " + toText(substance.index));
  text += "scene formats\n";
  for (const SceneFormat& format : sceneFormats())
    text +=
        featureRow(format.name, std::string(format.help) + (format.write ? "; read and written" : "; read"));
  text += "picture formats\n";
  for (const PictureFormat& format : pictureFormats()) {
    std::string suffixes;
    for (std::string_view suffix : format.suffixes)
      suffixes += (suffixes.empty() ? "" : " ") + std::string(suffix);
    text += featureRow(suffixes, format.help);
  }
  return text;
}

}  // namespace

int featuresCommand(const Arguments& arguments, const Console& console) {
  if (!arguments.files.empty())
    throw Error(Fault::usage, "ray features: expected no file, found \"" + arguments.files.front() + "\"");
  if (!arguments.examples.empty()) {
    if (arguments.output.empty())
      throw Error(Fault::usage,
                  "ray features --examples: expected a folder for the page, as in -o docs/features");
    writeExtensionPictures(arguments.examples, arguments.output, [&](std::string_view name) {
      console.line(LogLevel::info, "the pictures of " + std::string(name));
    });
    writeFile(arguments.output + "/README.md", extensionsMarkdown());
    return kDone;
  }
  const std::string text = !arguments.completion.empty() ? completionScript(arguments.completion)
                           : !arguments.manual.empty()   ? manualPage(arguments.manual)
                           : arguments.markdown          ? optionsMarkdown()
                                                         : featuresText();
  if (arguments.output.empty())
    printResult(text);
  else
    writeFile(arguments.output, text);
  return kDone;
}

}  // namespace trace::cli

// Names and contents of the files a render writes: see output.h. The end of a picture's life: Film, tone,
// file.
#include "app/session/output.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>

#include "app/session/denoising.h"
#include "app/session/picture_layers.h"
#include "app/session/version.h"
#include "base/budget.h"
#include "base/error.h"
#include "base/files/file.h"
#include "image/codecs/codec.h"
#include "image/development/anaglyph.h"
#include "render/picture/passes.h"

namespace trace {
namespace {

namespace fs = std::filesystem;

constexpr const char *kSettings = "Settings", *kProgramWord = "Program", *kDefaults = "defaults",
                     *kPass = "Pass", *kIncomplete = "Incomplete", *kPartial = ".partial";
/// The group of options that say how a picture is computed, and nothing of what it shows.
constexpr std::string_view kResources = "Resources";
/// The group of options that say which pictures lie beside it, and nothing of itself.
constexpr std::string_view kPasses = "Passes";

std::string passFile(const fs::path& picture, std::string_view pass, PassFormat format, PassName name) {
  const std::string suffix = format == PassFormat::exr   ? ".exr"
                             : format == PassFormat::png ? ".png"
                                                         : picture.extension().generic_string();
  const char* between = name == PassName::dot ? "." : "_";
  return (picture.parent_path() / picture.stem()).generic_string() + between + std::string(pass) + suffix;
}

/// The words, with only those options that change what is rendered, and are not of the group `without`.
std::map<std::string, std::string> whatCounts(const Metadata& metadata, std::string_view without = {}) {
  std::map<std::string, std::string> words;
  for (const auto& [key, text] : metadata) words[key] = text;
  std::istringstream options(words[kSettings]);
  std::string kept, one;
  while (options >> one) {
    const std::string_view name = std::string_view(one).substr(0, one.find('='));
    const auto all = trace::options();
    const auto row = std::find_if(all.begin(), all.end(), [&](const Option& o) { return o.name == name; });
    const bool counts = row == all.end() || (row->repeats != Repeats::nothing && row->group != without);
    if (counts) kept += one + " ";
  }
  words[kSettings] = kept == std::string(kDefaults) + " " ? "" : kept;
  return words;
}

/// The settings without the steps between film and file that may take long.
Settings plainOf(Settings settings) {
  settings.denoise = false;
  settings.bloom = 0;
  settings.passes = {};
  return settings;
}

/// A device or a pipe holds nothing: it takes what comes.
bool holdsSomething(const std::string& path) {
  std::error_code error;
  return isOrdinaryFile(path) ? fs::file_size(path, error) > 0 : fs::is_directory(path, error);
}

/// The words of the picture or the pass.
Metadata wordsOf(const Output& output, const Metadata& metadata) {
  Metadata words = metadata;
  if (!output.pass.empty()) words.emplace_back(kPass, output.pass);
  return words;
}

/// The name of a fragment beside the picture; there may be several, numbered from 1.
std::string besidePicture(const fs::path& picture, int number) {
  const std::string name = picture.stem().generic_string() + kPartial +
                           (number == 1 ? "" : "-" + std::to_string(number)) +
                           picture.extension().generic_string();
  return (picture.parent_path() / name).generic_string();
}

/// Whether the words of the file say that it is a part of the picture, or pass, with these words, whatever
/// passes either has beside it.
bool isFragmentOf(const Output& output, const Metadata& metadata) {
  if (!isOrdinaryFile(output.path)) return false;
  try {
    Metadata stored = readMetadata(output.path);
    const bool incomplete = std::erase_if(stored, [](const auto& word) { return word.first == kIncomplete; });
    Metadata words = wordsOf(output, metadata);
    for (Metadata* of : {&stored, &words})  // another build's part is one of the picture all the same
      std::erase_if(*of, [](const auto& word) { return word.first == kProgramWord; });
    return incomplete && whatCounts(stored, kPasses) == whatCounts(words, kPasses);
  } catch (const std::exception&) {  // whatever it is, it is not ours
    return false;
  }
}

/// The picture and the passes that a render of any settings writes beside it.
std::vector<Output> possibleOutputs(const std::string& picture) {
  std::vector<Output> all{{picture, -1, ""}};
  for (const PassRow& pass : passRows())
    for (const PassFormat format : {PassFormat::exr, PassFormat::png, PassFormat::same})
      for (const PassName name : {PassName::dot, PassName::underscore})
        all.push_back({passFile(picture, pass.name, format, name), -1, pass.name});
  return all;
}

/// Whether the file is a picture of which a part was never rendered.
bool isFragment(const std::string& path) {
  try {
    for (const auto& [key, text] : readMetadata(path))
      if (key == kIncomplete) return true;
    return !keepsWords(path) &&
           fs::path(path).filename().generic_string().find(kPartial) != std::string::npos;
  } catch (const std::exception&) {  // whatever it is, it is not ours
    return false;
  }
}

}  // namespace

bool keepsWords(const std::string& path) {
  const PictureFormat& format = pictureFormatFor(path);
  return !format.metadata(format.encode(Picture(1, 1), Rounding::truncate, {{"Word", "kept"}})).empty();
}

std::vector<Output> outputs(const std::string& path, const Settings& settings) {
  std::vector<Output> all{{path, -1, ""}};
  checkHoldsLayers(path, settings);
  if (settings.passFormat == PassFormat::layers) return all;
  for (const PassRow* pass : passesOf(settings))
    all.push_back({passFile(path, pass->name, settings.passFormat, settings.passName),
                   layerOf(settings, pass->name), pass->name});
  return all;
}

bool isRendered(const Output& output, const Size& size, const Metadata& metadata) {
  if (!isOrdinaryFile(output.path)) return false;
  try {
    const std::string bytes = readFile(output.path);
    const Metadata stored = pictureFormatOf(bytes, output.path).metadata(bytes);
    if (stored.empty() || whatCounts(stored) != whatCounts(wordsOf(output, metadata))) return false;
    const Picture picture = decodePicture(bytes, output.path);  // a part of a file may have all its words
    return picture.width == size.width && picture.height == size.height;
  } catch (const std::exception&) {  // not a sound picture
    return false;
  }
}

Metadata describe(const Scene& scene, const Settings& settings) {
  std::string changed;
  for (const Choice& choice : changedOptions(settings))
    if (findOption(choice.option).group != kResources)
      changed += (changed.empty() ? "" : " ") + choice.option + "=" + choice.value;
  return {{"Software", "Trace " TRACE_VERSION},
          {"Title", fs::path(scene.file).filename().generic_string()},
          {kSettings, changed.empty() ? kDefaults : changed},
          {kProgramWord, programText()}};
}

Picture finished(Picture rendered, const Settings& settings) {
  switch (settings.stereo) {
    case Stereo::redCyan: return anaglyph(rendered, kRedCyan);
    case Stereo::halfColor: return anaglyph(rendered, kHalfColor);
    case Stereo::grey: return anaglyph(rendered, kGrey);
    case Stereo::dubois: return anaglyph(rendered, kDubois);
    default: return rendered;
  }
}

Size finished(const Size& rendered, const Settings& settings) {
  return isAnaglyph(settings.stereo) ? Size{rendered.width / 2, rendered.height} : rendered;
}

void checkIsNoInput(const std::string& path, const InputFiles& inputs) {
  for (const InputFile& file : inputs.all())
    if (sameFile(path, file.path))
      throw Error(Fault::usage,
                  "\"" + path + "\" is " +
                      (file.read ? "a file that is read" : "a file that the scene names") +
                      (path == file.path ? "" : ", \"" + file.path + "\"") + ": it is not written over",
                  "name another file for the output, as in -o out.png");
}

bool PictureFiles::isInput(const std::string& path) const {
  return std::any_of(inputs_.all().begin(), inputs_.all().end(),
                     [&](const InputFile& input) { return sameFile(path, input.path); });
}

bool PictureFiles::isFree(const std::string& path, const Settings& settings) const {
  for (const Output& output : outputs(path, settings))
    if (isInput(output.path) || (holdsSomething(output.path) && !isFragment(output.path))) return false;
  return true;
}

std::string PictureFiles::placeOfFragment(const Settings& settings) const {
  constexpr int kMost = 1000;
  if (!fragment_.empty()) return fragment_;
  if (isFree(path_, settings)) return path_;
  for (int i = 1; i <= kMost; ++i)
    if (std::string beside = besidePicture(path_, i); isFree(beside, settings)) return beside;
  throw Error(Fault::io, "cannot write \"" + path_ + "\": it holds a picture that is whole, and so do " +
                             std::to_string(kMost) + " files beside it");
}

void PictureFiles::removeFragments(const Settings& settings, const Metadata& metadata) {
  const auto remove = [&](const std::string& path) {
    std::error_code ignored;
    if (!isInput(path) && fs::remove(path, ignored)) removed_.push_back(path);
  };
  if (!fragment_.empty() && fragment_ != path_)
    for (const Output& output : outputs(fragment_, settings)) remove(output.path);
  fragment_.clear();
  const auto removeParts = [&](const std::string& picture) {
    for (const Output& output : possibleOutputs(picture))
      if (isFragmentOf(output, metadata)) remove(output.path);
  };
  removeParts(path_);  // passes of a part that lay there itself
  std::error_code ignored;
  for (int i = 1; fs::exists(besidePicture(path_, i), ignored); ++i) removeParts(besidePicture(path_, i));
}

std::string PictureFiles::write(const Film& film, const Settings& wanted, const Metadata& metadata,
                                LastSteps finish) {
  const bool whole = film.complete() && finish == LastSteps::all;
  const Settings settings = finish == LastSteps::all ? wanted : plainOf(wanted);
  written_.clear();
  const std::string place = whole ? path_ : placeOfFragment(settings);
  if (!whole) fragment_ = place;
  const Picture rendered = film.picture();
  const std::optional<Picture> without = denoised(film, settings);
  const Picture& shown = without ? *without : rendered;
  change_ = without ? std::optional(shownChange(rendered, shown, developmentOf(settings))) : std::nullopt;
  for (const Output& output : outputs(place, settings)) {
    Metadata words = wordsOf(output, metadata);
    if (!whole)
      words.emplace_back(kIncomplete, finish == LastSteps::all ? "the render was stopped"
                                                               : "the last steps of the render were stopped");
    std::string bytes;
    {
      const Work work(output.pass.empty() ? "developing the picture" : "making the passes");
      bytes = encodedOutput(output, {film, shown, settings, wanted, names_}, words);
    }
    const Work work("writing the picture");
    writeFile(output.path, bytes);
    written_.push_back(output.path);
  }
  const BudgetScope unlimited(nullptr);  // all is there
  if (whole) removeFragments(settings, metadata);
  return place;
}

}  // namespace trace

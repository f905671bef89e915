#include "app/document.h"

#include <algorithm>

#include "app/output.h"
#include "base/file.h"
#include "base/text.h"
#include "formats/format.h"
#include "formats/ray_format.h"

namespace trace {
namespace {

std::filesystem::file_time_type timeOf(const std::string& file) {
  std::error_code ignored;
  return std::filesystem::last_write_time(file, ignored);
}

std::string placeText(const Place& place) {
  std::string text = std::filesystem::path(place.file).filename().string();
  if (place.line > 0) text += ":" + std::to_string(place.line);
  return text.empty() ? "scene file" : text;
}

bool isConvention(const Option& option) { return option.group == "Conventions" && option.name != "like"; }

}  // namespace

Document::Reading Document::read(const std::string& file, const std::vector<Choice>& commandLine,
                                 const std::vector<Choice>& choices) {
  Reading reading;
  reading.written = timeOf(file);
  const std::string bytes = readFile(file);
  const auto readAt = [&](Real time) {
    reading.messages = {};
    reading.scene = std::make_shared<const Scene>(readScene(file, bytes, reading.messages, time));
    reading.messages.throwIfFailed();
    return resolve({reading.scene->choices, commandLine, choices}).time;
  };
  const Real time = resolve({commandLine, choices}).time;
  if (const Real chosen = readAt(time); chosen != time) readAt(chosen);  // the file chooses the moment
  reading.fingerprint = fingerprint(bytes, *reading.scene);
  return reading;
}

void Document::take(const Reading& reading, bool anew) {
  if (anew) moments_.clear();
  moments_.insert(reading.scene);
  onDisk_ = reading.scene, written_ = reading.written;
  messages_ = reading.messages, fingerprint_ = reading.fingerprint;
  ++readings_;
}

void Document::open(const std::string& file, std::vector<Choice> commandLine) {
  const Reading reading = read(file, commandLine, {});
  take(reading, true);
  file_ = file, commandLine_ = std::move(commandLine);
  editions_ = {{"", reading.scene, {}}};
  current_ = 0;
  settle();
}

void Document::settle() {
  const Edition& edition = editions_[current_];
  settings_ = resolve({edition.scene->choices, commandLine_, edition.choices});
  ++revision_;
}

void Document::push(Edition edition, bool continues) {
  if (continues && current_ > 0 && editions_[current_].what == edition.what) {
    editions_.resize(current_ + 1);
    editions_[current_] = std::move(edition);
  } else {
    editions_.resize(current_ + 1);
    editions_.push_back(std::move(edition));
    if (editions_.size() > kMostEditions) editions_.erase(editions_.begin());
    current_ = editions_.size() - 1;
  }
  settle();
}

void Document::edit(const std::string& what, Scene scene, bool continues) {
  push({what, std::make_shared<const Scene>(std::move(scene)), editions_[current_].choices}, continues);
}

void Document::choose(const std::string& option, const std::string& value, bool continues) {
  Settings scratch;
  findOption(option).assign(scratch, value);
  Edition next{option, editions_[current_].scene, editions_[current_].choices};
  std::erase_if(next.choices, [&](const Choice& choice) {  // `like` sets every convention anew
    return choice.option == option || (option == "like" && isConvention(findOption(choice.option)));
  });
  next.choices.push_back({option, value, {}});
  pushChoice(std::move(next), option, continues);
}

void Document::pushChoice(Edition edition, const std::string& option, bool continues) {
  if (findOption(option).repeats == Repeats::scene) {  // the file says something else now
    const bool wasEdited = edited();
    const std::shared_ptr<const Scene> before = onDisk_;
    const Reading reading = read(file_, commandLine_, edition.choices);
    if (*reading.scene == *before) return push(std::move(edition), continues);  // and keep what was edited
    take(reading, false);
    edition.scene = reading.scene;
    if (wasEdited)
      messages_.warn(Place{.file = file_}, option + " read the file again, without what was edited here",
                     "undo brings it back");
  }
  push(std::move(edition), continues);
}

void Document::reset(const std::string& option) {
  Edition next{"reset " + option, editions_[current_].scene, editions_[current_].choices};
  std::erase_if(next.choices, [&](const Choice& choice) { return choice.option == option; });
  pushChoice(std::move(next), option, false);
}

std::string Document::chooser(const Option& option) const {
  std::string from = "default";
  const auto look = [&](const std::vector<Choice>& layer, const std::string& name) {
    for (const bool byName : {false, true})
      for (const Choice& choice : layer) {
        if (byName ? choice.option != option.name : choice.option != "like" || !isConvention(option))
          continue;
        from = (name.empty() ? placeText(choice.place) : name) + (byName ? "" : ", by like");
      }
  };
  look(scene().choices, "");
  look(commandLine_, "command line");
  look(editions_[current_].choices, "studio");
  return from;
}

bool Document::chosenHere(const std::string& option) const {
  const std::vector<Choice>& choices = editions_[current_].choices;
  return std::any_of(choices.begin(), choices.end(),
                     [&](const Choice& choice) { return choice.option == option; });
}

void Document::undo() {
  if (!canUndo()) return;
  --current_;
  settle();
}

void Document::redo() {
  if (!canRedo()) return;
  ++current_;
  settle();
}

bool Document::changedOnDisk() const {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file_, error);
  return isOpen() && !error && written != written_;
}

void Document::reload() {
  written_ = timeOf(file_);
  const Reading reading = read(file_, commandLine_, editions_[current_].choices);
  take(reading, true);
  push({"reload", reading.scene, editions_[current_].choices}, false);
}

bool Document::changesWithTime() const {
  try {
    return trace::changesWithTime(file_, readFile(file_));
  } catch (const Error&) {  // no longer what it was
    return false;
  }
}

std::vector<Message> Document::save(const std::string& file) {
  Scene scene = this->scene();
  scene.choices = changedOptions(settings_);
  std::erase_if(scene.choices, [](const Choice& choice) {  // of this machine, not of the scene
    return findOption(choice.option).repeats == Repeats::nothing;
  });
  Messages messages;
  if (changesWithTime())
    messages.warn(Place{.file = file},
                  "the keys of " + std::filesystem::path(file_).filename().string() +
                      " are not kept: the scene is written as it is at " + toText(settings_.time) + " s",
                  "what changes with time is edited in the file itself");
  for (const NamedBytes& part : writableFormatFor(file).write(scene, file, {}, messages))
    writeFile(part.file, part.bytes);
  file_ = file, written_ = timeOf(file), onDisk_ = sharedScene();
  moments_ = {onDisk_};
  fingerprint_ = fingerprint(readFile(file), *onDisk_);
  return messages.all();
}

}  // namespace trace

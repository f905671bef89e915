#include "app/editing/document.h"

#include <algorithm>

#include "app/editing/read_back.h"
#include "app/session/output.h"
#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "base/text.h"
#include "formats/format.h"
#include "formats/kind_defaults.h"
#include "formats/ray/file/format.h"
#include "formats/ray/write/patch.h"
#include "scene/quality.h"

namespace trace {
namespace {

std::filesystem::file_time_type timeOf(const std::string& file) {
  std::error_code ignored;
  return std::filesystem::last_write_time(file, ignored);
}

std::string briefPlace(const SourcePlace& place) {
  std::string text = std::filesystem::path(place.file.str()).filename().generic_string();
  if (place.line > 0) text += ":" + std::to_string(place.line);
  return text;
}

/// Are scenes of the format saved as their text with the edits in it?
bool keepsText(std::string_view format) {
  return std::any_of(sceneFormats().begin(), sceneFormats().end(),
                     [&](const SceneFormat& row) { return row.name == format && row.rewrite != nullptr; });
}

/// The choices that a saved scene makes: not those of this machine, nor those that follow from the others, as
/// from its quality.
std::vector<Choice> ofTheScene(const Scene& scene, const Settings& settings) {
  const auto differ = [&](const std::vector<Choice>& choices) {
    std::vector<Choice> others;
    const Settings given = settingsFor(scene, {choices});
    for (const Option& option : options())
      if (const std::string value = option.get(settings);
          option.repeats != Repeats::nothing && value != option.get(given))
        others.push_back({std::string(option.name), value, {}});
    return others;
  };
  std::vector<Choice> choices;
  if (settings.quality != Quality::none)
    choices.push_back({"quality", findOption("quality").get(settings), {}});
  for (Choice& choice : differ(choices)) choices.push_back(std::move(choice));
  if (settings.quality == Quality::none) return choices;
  for (std::size_t i = choices.size(); i-- > 1;) {
    std::vector<Choice> fewer = choices;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    if (differ(fewer).empty()) choices = std::move(fewer);
  }
  return choices;
}

std::optional<std::string> bytesOf(const std::string& file) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored) ? std::optional(readFile(file)) : std::nullopt;
}

/// Before `file` loses something that a person wrote into it: what it says goes into a file beside it, of
/// which none is replaced that says something else.
void keepAside(const std::string& file, const std::string& says, Messages& messages) {
  std::string aside = file + ".bak";
  std::optional<std::string> there = bytesOf(aside);
  for (int i = 2; there && *there != says; ++i) {
    aside = file + ".bak" + std::to_string(i);
    there = bytesOf(aside);
  }
  if (!there) writeFile(aside, says);
  messages.warn(SourcePlace{.file = file},
                "the old file is kept as " + std::filesystem::path(aside).filename().generic_string());
}

/// Is it one text, though perhaps read at two moments?
bool sameText(const SceneText& a, const SceneText& b) {
  return a.bytes == b.bytes || (a.bytes && b.bytes && *a.bytes == *b.bytes);
}

}  // namespace

Document::Reading Document::read(const Source& source) {
  Reading reading;
  reading.source = source;
  reading.written = timeOf(source.file);
  const auto read = std::make_shared<const std::string>(readFile(source.file));
  const std::string& bytes = *read;
  SceneText text{source.file, read, 0, {}};
  const auto readAt = [&](Real time) {
    reading.messages = {};
    text.time = time;
    SceneTime moment(time);
    Scene scene = readScene(source.file, bytes, reading.messages, moment);
    completeBareMesh(scene);
    reading.scene = std::make_shared<const Scene>(std::move(scene));
    reading.changesWithTime = moment.changesScene();
    reading.messages.throwIfFailed();
    return resolve({reading.scene->choices, source.commandLine, source.choices}).time;
  };
  const Real time = source.time();
  if (const Real chosen = readAt(time); chosen != time) readAt(chosen);  // the file chooses the moment
  text.scene = reading.scene;
  if (keepsText(reading.scene->format))
    text.lookAt = lookAtIn(source.file, bytes, text.time);
  else
    text.bytes.reset();
  reading.text = std::make_shared<const SceneText>(text);
  reading.fingerprint = reading.scene->inputs.fingerprint();
  return reading;
}

void Document::take(const Reading& reading, bool anew) {
  if (anew) {
    moments_.clear();
    choicesOnDisk_ = ofTheScene(*reading.scene, settingsFor(*reading.scene, {reading.scene->choices}));
  }
  moments_.insert(reading.scene);
  onDisk_ = reading.scene;
  origin_ = {reading.text, true};
  written_ = noticed_ = reading.written;
  messages_ = reading.messages;
  fingerprint_ = reading.fingerprint;
  changesWithTime_ = reading.changesWithTime;
  ++readings_;
}

void Document::open(const std::string& file, std::vector<Choice> commandLine) {
  const Reading reading = read({file, commandLine, {}});
  take(reading, true);
  file_ = file;
  commandLine_ = std::move(commandLine);
  ownFile_ = keepsText(reading.scene->format) ? file : "";
  editions_ = {{"", reading.scene, reading.text, {}}};
  current_ = 0;
  settle();
}

void Document::settle() {
  const Edition& edition = editions_[current_];
  settings_ = settingsFor(*edition.scene, {edition.scene->choices, commandLine_, edition.choices});
  choices_ =
      ofTheScene(*edition.scene, settingsFor(*edition.scene, {edition.scene->choices, edition.choices}));
  ++revision_;
}

void Document::push(Edition edition, bool continues) {
  edition.step = ++steps_;
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

void Document::dropSince(std::uint64_t step) {
  std::size_t earlier = current_;
  while (earlier > 0 && editions_[earlier].step != step) --earlier;
  if (earlier == current_ || editions_[earlier].step != step) return;
  current_ = earlier;
  editions_.resize(current_ + 1);
  settle();
}

void Document::edit(const std::string& what, Scene scene, bool continues) {
  const Edition& now = editions_[current_];
  push({what, std::make_shared<const Scene>(std::move(scene)), now.text, now.choices}, continues);
}

void Document::choose(const std::string& option, const std::string& value, bool continues) {
  Settings scratch;
  findOption(option).assign(scratch, value);
  make({option, value, continues});
}

void Document::reset(const std::string& option) { make({option}); }

bool Document::readsFile(const std::string& option) { return findOption(option).repeats == Repeats::scene; }

Document::Edition Document::with(const Change& change) const {
  const Edition& now = editions_[current_];
  if (change.option.empty()) return {"reload", now.scene, now.text, now.choices};
  Edition next{(change.value ? "" : "reset ") + change.option, now.scene, now.text, now.choices};
  std::erase_if(next.choices, [&](const Choice& choice) {  // `like` sets every convention anew
    return choice.option == change.option ||
           (change.value && change.option == "like" && isConvention(findOption(choice.option)));
  });
  if (change.value) next.choices.push_back({change.option, *change.value, {}});
  return next;
}

void Document::make(const Change& change) {
  if (change.anew || readsFile(change.option))
    apply(change, read(source(change)));
  else
    push(with(change), change.continues);
}

Document::Source Document::source(const Change& change) const {
  return {file_, commandLine_, with(change).choices};
}

bool Document::apply(const Change& change, const Reading& reading) {
  if (reading.source.file != file_ || reading.source.time() != source(change).time()) return false;
  Edition next = with(change);
  const bool wasEdited = sceneEdited();
  if (change.anew) {
    take(reading, true);
    next.scene = reading.scene;
    next.text = reading.text;
  } else if (*reading.scene != *onDisk_) {  // else what was edited is kept
    take(reading, false);
    next.scene = reading.scene;
    next.text = reading.text;
    if (wasEdited)
      messages_.warn(SourcePlace{.file = file_}, change.option + " read the file again, without your edits",
                     "undo brings it back");
  }
  push(std::move(next), change.continues);
  return true;
}

std::string Document::chooser(const Option& option) const {
  return chooserOf(option, {scene().choices, commandLine_, editions_[current_].choices}, briefPlace);
}

bool Document::chosenHere(const std::string& option) const {
  const std::vector<Choice>& choices = editions_[current_].choices;
  return std::any_of(choices.begin(), choices.end(),
                     [&](const Choice& choice) { return choice.option == option; });
}

SceneAt Document::sceneAt() const {
  if (!changesWithTime_) return nullptr;
  const Edition& now = editions_[current_];
  return [text = now.text, scene = now.scene, edited = std::string(),
          rules = ReadScope::current()](Real time) mutable {
    const ReadScope scope(rules);
    Messages known;  // reported when the scene was read
    if (edited.empty() && !(*scene == *text->scene))
      edited = writeEdited(*text, *scene, text->file, known).files.front().bytes;
    return readScene(text->file, edited.empty() ? *text->bytes : edited, known, time);
  };
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

std::optional<Vec3> Document::lookAt() const {
  const Camera& camera = scene().camera;
  const std::optional<Vec3>& said = editions_[current_].text->lookAt;
  const bool looks = said && normalize(*said - camera.position) == camera.viewdir;
  return looks ? said : std::nullopt;
}

bool Document::savesOverItsFile() const { return isOpen() && file_ == ownFile_; }

bool Document::sceneEdited() const {
  return isOpen() && !moments_.contains(sharedScene()) && !(scene() == *onDisk_);
}

bool Document::edited() const { return isOpen() && (sceneEdited() || choices_ != choicesOnDisk_); }

bool Document::writtenSince(std::filesystem::file_time_type time) const {
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file_, error);
  return isOpen() && !error && written != time;
}

bool Document::changedOnDisk() const { return writtenSince(noticed_); }

bool Document::othersOnDisk() const { return writtenSince(written_); }

void Document::noticeDisk() { noticed_ = timeOf(file_); }

void Document::reload() {
  noticeDisk();
  make({.anew = true});
}

std::vector<Message> Document::save(const std::string& file) {
  const Saved saved = write(saving(file));
  noteSaved(saved);
  return saved.what.messages.all();
}

Document::Saving Document::saving(const std::string& file) const {
  return {file,
          sharedScene(),
          editions_[current_].text,
          choices_,
          sameFile(file, file_) ? std::optional(origin_) : std::nullopt,
          {}};
}

Document::Saved Document::write(Saving what) {
  Scene scene = *what.scene;
  scene.choices = what.choices;
  const Rewritten rewritten = writeEdited(*what.text, scene, what.file, what.messages);
  const std::vector<NamedBytes>& parts = rewritten.files;
  InputFiles others;  // the scene's own file may be replaced, and nothing else that it is made of
  for (const InputFile& input : scene.inputs.all())
    if (!sameFile(input.path, scene.file)) others.noteNamed(input.path);
  for (const NamedBytes& part : parts) checkIsNoInput(part.file, others);
  Saved saved{std::move(what), rewritten.keepsAll, {}, false, {}};
  const NamedBytes& own = parts.front();
  // A picture of the scene has to say what the file is made of. Other formats keep a part of it, and warn.
  if (keepsText(writableFormatFor(own.file).name))
    saved.fingerprint = readBack(parts, scene, saved.what.text->time).inputs.fingerprint();
  if (const std::optional<Origin>& before = saved.what.before) {
    const bool loses = !sameText(*before->text, *saved.what.text) || (before->whole && !rewritten.keepsAll);
    const std::optional<std::string> says = bytesOf(own.file);
    if (loses && says && *says != own.bytes) keepAside(own.file, *says, saved.what.messages);
  }
  for (const NamedBytes& part : parts) writeFile(part.file, part.bytes);
  if (parts.size() > 1 && !saved.fingerprint.empty())  // what lies beside it can be read now
    saved.fingerprint = readBack(parts, scene, saved.what.text->time).inputs.fingerprint();
  saved.written = timeOf(saved.what.file);
  saved.changesWithTime = trace::changesWithTime(own.file, own.bytes);
  return saved;
}

void Document::noteSaved(const Saved& saved) {
  const bool ours = std::any_of(editions_.begin(), editions_.end(),
                                [&](const Edition& edition) { return edition.scene == saved.what.scene; });
  if (!ours) return;
  file_ = saved.what.file;
  ownFile_ = keepsText(writableFormatFor(file_).name) ? file_ : "";
  written_ = noticed_ = saved.written;
  onDisk_ = saved.what.scene;
  origin_ = {saved.what.text, saved.keepsAll};
  moments_ = {onDisk_};
  choicesOnDisk_ = saved.what.choices;
  fingerprint_ = saved.fingerprint;
  changesWithTime_ = saved.changesWithTime;
}

}  // namespace trace

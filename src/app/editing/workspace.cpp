#include "app/editing/workspace.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <utility>

#include "app/compare/difference.h"
#include "app/editing/scene_changes.h"
#include "app/editing/texture_edits.h"
#include "app/session/output.h"
#include "app/session/render_warnings.h"
#include "base/files/file.h"
#include "base/text.h"
#include "formats/ray/syntax/names.h"
#include "image/codecs/codec.h"
#include "scene/quality.h"

namespace trace {
namespace {

namespace fs = std::filesystem;
using Level = Workspace::LogEntry::Level;

constexpr std::chrono::milliseconds kLookInterval(500);  // for changes on disk

std::string absolute(const std::string& file) {
  std::error_code error;
  const fs::path path = fs::absolute(file, error);
  return error ? file : path.lexically_normal().generic_string();
}

/// The earliest time if there is no such file.
fs::file_time_type writtenAt(const std::string& file) {
  std::error_code error;
  const auto time = fs::last_write_time(file, error);
  return error ? fs::file_time_type::min() : time;
}

/// As a person would say it: from the current folder, if the file lies in it.
std::string shown(const std::string& file) {
  const std::string near = fs::path(absolute(file)).lexically_relative(absolute(".")).generic_string();
  return near.empty() || near.starts_with("..") ? absolute(file) : near;
}

}  // namespace

bool differInPicture(const Settings& a, const Settings& b) {
  Settings same = b;
  for (const Option& option : options())
    if (option.repeats == Repeats::nothing || option.repeats == Repeats::tone)
      option.assign(same, option.get(a));
  return !(a == same);
}

void Workspace::report(const std::vector<Message>& messages) {
  for (const Message& message : messages) {
    const Level level = message.severity == Message::Severity::error ? Level::error : Level::warning;
    SourcePlace place = message.place;
    if (!place.file.empty()) place.file = shown(place.file);
    log_.push_back({level, message.what, message.hint, std::move(place)});
  }
}

// --- work in the background ---------------------------------------------------------------------------

template <class Work>
auto Workspace::outcomeOf(const std::string& file, Work&& work) {
  Outcome<decltype(work())> outcome;
  try {
    outcome.value = work();
  } catch (const Error& error) {
    outcome.errors = error.messages();
  } catch (const std::bad_alloc&) {
    outcome.errors = {{.place = {.file = file}, .what = "out of memory"}};
  } catch (const std::exception& error) {
    outcome.errors = {{.place = {.file = file}, .what = error.what()}};
  }
  return outcome;
}

template <class Value>
std::optional<Value> Workspace::taken(BackgroundTask<Outcome<Value>>& task) {
  std::optional<Outcome<Value>> outcome = task.take();
  if (!outcome) return {};
  if (!outcome->value) fail(outcome->errors);
  return std::move(outcome->value);
}

void Workspace::fail(const std::vector<Message>& errors) {
  report(errors);
  ++failures_;
}

void Workspace::open(const std::string& file) {
  asked_ = {absolute(file), writtenAt(file)};
  openFrom(asked_->file, {});
}

void Workspace::startScene(const std::string& file, std::string_view text) {
  asked_.reset();
  openFrom(absolute(file), [path = absolute(file), text] {
    if (fs::exists(path))
      throw Error(Fault::usage, SourcePlace{.file = path}, "not written: there is such a file",
                  "a new scene overwrites nothing; choose another name");
    writeFile(path, sceneNamed(text, fs::path(path).filename().generic_string()));
  });
}

fs::path Workspace::folderForFiles() const {
  const fs::path folder = document.isOpen() ? fs::path(document.file()).parent_path() : fs::current_path();
  const fs::path own(examples);
  const bool ofExamples =
      !own.empty() && std::mismatch(own.begin(), own.end(), folder.begin(), folder.end()).first == own.end();
  return ofExamples ? fs::current_path() : folder;
}

std::string Workspace::newSceneFile() const {
  const fs::path folder = folderForFiles();
  fs::path file = folder / "scene.ray";
  for (int i = 2; fs::exists(file); ++i) file = folder / ("scene-" + std::to_string(i) + ".ray");
  return file.generic_string();
}

void Workspace::openFrom(const std::string& path, const std::function<void()>& first) {
  opening_.start([path, first, choices = commandLine](const Cancelled&) {
    return outcomeOf(path, [&] {
      if (first) first();
      Document opened;
      opened.open(path, choices);
      return opened;
    });
  });
}

void Workspace::takeOpened() {
  if (std::optional<Document> opened = taken(opening_)) {
    asked_.reset();
    adopt(std::move(*opened));
  }
  if (!document.isOpen() && asked_ && !opening_.pending()) openIfMended();
}

void Workspace::openIfMended() {
  if (!lookNow() || writtenAt(asked_->file) == asked_->written) return;
  const std::string again = asked_->file;
  note(shown(again) + " changed on disk and is read again");
  open(again);
}

bool Workspace::lookNow() {
  const auto now = std::chrono::steady_clock::now();
  if (now - looked_ < kLookInterval) return false;
  looked_ = now;
  return true;
}

void Workspace::adopt(Document opened) {
  const bool another = !document.isOpen() || document.scene().file != opened.scene().file;
  document = std::move(opened);
  reading_ = 0;
  gone_ = false;
  if (another) inspector.forget();
  giveUpWanted();
  putFirst(document.file());
  note("opened " + shown(document.file()));
  reportReading();
  seen_ = document.revision();
  startRender();
}

void Workspace::putFirst(const std::string& file) {
  std::erase(recent_, file);
  recent_.insert(recent_.begin(), file);
  recent_.resize(std::min(recent_.size(), kMostRecent));
}

void Workspace::choose(const std::string& option, const std::string& value, bool continues) {
  if (document.isOpen() && !Document::readsFile(option)) return document.choose(option, value, continues);
  Settings scratch;
  findOption(option).assign(scratch, value);
  if (!document.isOpen()) return commandLine.push_back({option, value, {}});
  want({option, value, continues});
}

void Workspace::reset(const std::string& option) {
  if (Document::readsFile(option))
    want({.option = option});
  else
    document.reset(option);
}

/// One change after the other, of which the last counts: a time that is dragged, the file that changes.
void Workspace::want(Document::Change change) {
  if (wanted_) {
    const bool anew = change.anew || wanted_->anew;
    const bool continues = change.continues && wanted_->continues;
    if (change.option.empty()) {
      change.option = wanted_->option;
      change.value = wanted_->value;
    }
    change.continues = continues;
    change.anew = anew;
  }
  wanted_ = change;
  rereading_.start([change, number = ++wantedNumber_, source = document.source(change)](const Cancelled&) {
    return Reread{change, number, outcomeOf(source.file, [&] { return Document::read(source); })};
  });
}

void Workspace::giveUpWanted() {
  wanted_.reset();
  givenUp_ = wantedNumber_;
}

void Workspace::takeReread() {
  const std::optional<Reread> reread = rereading_.take();
  if (!reread || !wanted_ || reread->number <= givenUp_) return;
  const bool last = reread->number == wantedNumber_;
  Document::Change change = reread->change;  // a change that may partly be in the document by now
  if (change.option == wanted_->option) change.continues = change.continues || wanted_->continues;
  change.anew = change.anew && wanted_->anew;
  if (!reread->reading.value) {
    fail(reread->reading.errors);
    if (last) wanted_.reset();
  } else if (!document.apply(change, *reread->reading.value)) {
    if (last) want(*std::exchange(wanted_, std::nullopt));
  } else {
    if (change.anew)
      note(shown(document.file()) + " changed on disk and was read again; undo takes that back");
    if (last)
      wanted_.reset();
    else {
      // the drag continues
      wanted_->continues = wanted_->option == change.option;
      wanted_->anew = false;
    }
  }
}

Settings Workspace::chosenSettings() const {
  if (!wanted_) return document.settings();
  const Document::Source source = document.source(*wanted_);
  return settingsFor(document.scene(), {document.scene().choices, source.commandLine, source.choices});
}

void Workspace::dropSince(std::uint64_t step) {
  if (wanted_ && !wanted_->option.empty()) undo();
  document.dropSince(step);
}

void Workspace::undo() {
  if (!wanted_ || wanted_->option.empty()) return document.undo();
  const bool anew = wanted_->anew;
  giveUpWanted();
  if (anew) want({.anew = true});
}

void Workspace::refuse(const std::string& what, const std::string& why, const std::string& hint) {
  ++refusals_;
  log_.push_back({Level::warning, what + " was not taken: " + why, hint, {}});
}

void Workspace::edit(const std::string& what, Scene scene, bool continues) {
  if (const auto name = unsayableIn(scene); name && !unsayableIn(document.scene()))
    return refuse(what, name->why(), name->hint());
  followNames(document.scene(), scene);
  if (const std::string name = sharedName(document.scene(), scene); !name.empty())
    log_.push_back({Level::warning,
                    "another one is called \"" + name + "\", too: links by that name mean both",
                    "links are lights, excludes, lit_by and not_lit_by",
                    {}});
  if (!lacksFiles(scene) || lacksFiles(document.scene()))
    return document.edit(what, std::move(scene), continues);
  completing_.start([what, of = document.sharedScene(), scene = std::move(scene)](const Cancelled&) mutable {
    Completed completed{what, of, nullptr, {}, {}};
    Messages messages;
    Outcome<bool> outcome = outcomeOf(scene.file, [&] {
      readLackingFiles(scene, messages);
      return true;
    });
    completed.remarks = messages.all();
    completed.errors = std::move(outcome.errors);
    completed.scene = std::make_shared<const Scene>(std::move(scene));
    return completed;
  });
}

void Workspace::takeCompleted() {
  const std::optional<Completed> completed = completing_.take();
  if (!completed) return;
  if (completed->errors.empty() && completed->of == document.sharedScene()) {
    report(completed->remarks);
    return document.edit(completed->what, *completed->scene);
  }
  refuse(completed->what,
         completed->errors.empty() ? "the scene was edited meanwhile" : completed->errors.front().what);
}

void Workspace::openReference(const std::string& file) {
  loading_.start([path = absolute(file)](const Cancelled&) {
    return outcomeOf(path, [&] {
      LoadedPicture loaded = loadPicture(path);
      return Reference{path, std::move(loaded.picture), !loaded.levels};
    });
  });
}

void Workspace::takeReference() {
  std::optional<Reference> loaded = taken(loading_);
  if (!loaded) return;
  reference_ = std::move(loaded->picture);
  referenceIsLinear_ = loaded->linear;
  referenceFile_ = loaded->file;
  ++referenceVersion_;
  note("comparing with " + shown(referenceFile_));
}

void Workspace::savePicture(const std::string& file) {
  const auto session = render.session();
  if (!session) return fail({{.place = {.file = file}, .what = "not written: there is no picture yet"}});
  Settings settings = session->settings();  // but what comes after the film is as it is now
  for (const Option& option : options())
    if (option.repeats == Repeats::tone) option.assign(settings, option.get(document.settings()));
  settings.autoExposure = document.settings().autoExposure;
  settings = withExposureMeasured(std::move(settings));
  Metadata words = describe(session->scene(), settings);
  if (const std::string print = document.fileFingerprint(); !stale() && !print.empty())
    words.emplace_back("Scene", print);
  saving_.start([file, session, settings, words](const Cancelled&) {
    return outcomeOf(file, [&] {
      const InputFiles& inputs = session->scene().inputs;
      for (const Output& output : outputs(file, settings)) checkIsNoInput(output.path, inputs);
      Saved saved;
      const std::string place = PictureFiles(file, inputs).write(session->film(), settings, words);
      for (const Output& output : outputs(place, settings)) saved.files.push_back(output.path);
      return saved;
    });
  });
}

void Workspace::saveBy(const std::string& file, std::function<void(const Advance&)> write) {
  saving_.start([file, inputs = document.scene().inputs, write = std::move(write), share = savingShare_,
                 stopped = savingStopped_](const Cancelled&) {
    *stopped = false;
    const auto outcome = outcomeOf(file, [&] {
      checkIsNoInput(file, inputs);
      bool givenUp = false;  // what was whole before somebody said so is written
      write([&](double part) {
        *share = part;
        return !(givenUp = *stopped);
      });
      return givenUp ? Saved{.files = {}, .stopped = file} : Saved{{file}};
    });
    *share = 0;
    return outcome;
  });
}

void Workspace::saveScene(const std::string& file) {
  if (!document.isOpen()) return fail({{.place = {.file = file}, .what = "not written: no scene is open"}});
  const bool ours = absolute(file) == document.file();
  saving_.start([what = document.saving(absolute(file)), ours](const Cancelled&) {
    return outcomeOf(what.file, [&] {
      const bool anew = ours && !fs::exists(what.file);
      return Saved{{what.file}, Document::write(what), anew};
    });
  });
}

void Workspace::saveSceneOver() {
  const bool toBeRead = document.changedOnDisk() || (wanted_ && wanted_->anew);
  if (saving() || !(toBeRead || document.othersOnDisk())) return saveScene(document.file());
  fail({{.place = {.file = document.file()},
         .what = std::string("not saved: the file was changed by another program") +
                 (toBeRead ? "" : ", and its new contents could not be read"),
         .hint = toBeRead ? "it is read again now; undo restores your edits, which can be saved then"
                          : "mend it there, and it is read again; or File, Save scene as... writes another "
                            "file, and replaces this one if you say so"}});
}

void Workspace::takeSaved() {
  while (const std::optional<Outcome<Saved>> outcome = saving_.take()) {
    if (!outcome->value) {
      fail(outcome->errors);
      continue;
    }
    for (const std::string& file : outcome->value->files) {
      note("wrote " + shown(file) + (outcome->value->anew ? " anew: it was no longer on the disk" : ""));
      written_.push_back(file);
    }
    if (!outcome->value->stopped.empty())
      note("stopped: " + shown(outcome->value->stopped) + " was not written");
    if (!outcome->value->scene) continue;
    document.noteSaved(*outcome->value->scene);
    gone_ = false;
    putFirst(outcome->value->scene->what.file);
    report(outcome->value->scene->what.messages.all());
  }
}

// --- the picture and the log ----------------------------------------------------------------------------

void Workspace::startRender() {
  if (!document.isOpen()) return;
  rendered_ = document.sharedScene();
  renderedSettings_ = document.settings();
  render.start(rendered_, renderedSettings_, document.sceneAt());
}

Settings Workspace::shownSettings() const {
  const auto session = render.session();
  if (!document.isOpen()) return session ? session->settings() : Settings{};
  const bool others = session && session->scene().file != document.scene().file;
  return others ? session->settings() : document.settings();
}

Settings Workspace::withExposureMeasured(Settings settings) const {
  if (const auto session = render.session(); session && settings.autoExposure) {
    settings.exposure += session->measuredExposure();
    settings.autoExposure = false;
  }
  return settings;
}

bool Workspace::stale() const {
  return document.isOpen() &&
         (rendered_ != document.sharedScene() || differInPicture(renderedSettings_, document.settings()));
}

void Workspace::update() {
  // The file that is being written may be the document's own.
  const bool looks = !saving() && !rereading_.pending();
  takeSaved();
  takeOpened();
  takeReference();
  if (document.isOpen()) {
    takeReread();
    takeCompleted();
    if (looks) reloadIfChanged();
    reportReading();
    if (seen_ != document.revision()) {
      seen_ = document.revision();
      if (automatic && stale()) startRender();
    }
  }
  render.advance();
  report(render.takeMessages());
  noteEnd();
}

Workspace::Pulse Workspace::pulse() {
  const BackgroundRender::State state = render.state();
  return {document.isOpen() ? document.sharedScene() : nullptr,
          document.revision(),
          render.version(),
          referenceVersion_,
          failures_,
          log_.size(),
          state.phase,
          state.working() ? static_cast<int>(10 * state.elapsed) : 0,
          reading(),
          saving(),
          inspector.busy()};
}

void Workspace::reportReading() {
  if (reading_ == document.readings()) return;
  reading_ = document.readings();
  report(document.messages().all());
}

void Workspace::reloadIfChanged() {
  if (!lookNow()) return;
  std::error_code error;
  const bool gone = !fs::exists(document.file(), error) && !error;
  if (gone && !gone_)
    log_.push_back({Level::warning,
                    shown(document.file()) + " is no longer on the disk",
                    "the scene stays; File, Save scene writes it again",
                    {}});
  gone_ = gone;
  if (!document.changedOnDisk()) return;
  document.noticeDisk();
  want({.anew = true});
}

void Workspace::noteEnvironment(const Session& session) {
  const Surroundings& now = session.scene().surroundings;
  const std::string file = now.sharpEnvironment ? now.environmentFile.path : "";
  if (std::exchange(environment_, file) == file || file.empty()) return;
  const EnvironmentKind kind = now.sharpEnvironment->kind();
  note(shown(file) + ": the environment is " +
       (kind == EnvironmentKind::angular   ? "an angular map"
        : kind == EnvironmentKind::latLong ? "a lat-long map"
                                           : "a cube of six faces"));
}

void Workspace::noteEnd() {
  const BackgroundRender::State state = render.state();
  if (state.working() || state.number == reported_) return;
  reported_ = state.number;
  if (state.phase != BackgroundRender::Phase::finished) return;
  noteEnvironment(*render.session());
  const Size size = render.session()->size();
  const RenderResult result = render.result();
  note("rendered " + std::to_string(size.width) + " x " + std::to_string(size.height) + " in " +
       durationText(state.elapsed) + ", " + counted(result.statistics.allRays(), "ray"));
  if (std::string doubt = brightnessDoubt(render.session()->settings(), result.brightnessError);
      !doubt.empty())
    log_.push_back({Level::warning, std::move(doubt), {}, {}});
  if (const auto bad = result.statistics.badSamples; bad > 0)
    log_.push_back(
        {Level::warning,
         counted(bad, "sample") + (bad == 1 ? " was" : " were") + " not finite and left out of the picture",
         "the panel Bad samples lists them",
         {}});
}

std::string Workspace::defaultPictureFile() const {
  if (!document.isOpen()) return "picture.png";
  const fs::path name = fs::path(document.file()).filename();
  return (folderForFiles() / name).replace_extension(".png").generic_string();
}

std::string Workspace::defaultSceneFile() const {
  if (!document.isOpen()) return document.file();
  const fs::path beside = folderForFiles() / fs::path(document.file()).filename();
  if (document.savesOverItsFile()) return beside.generic_string();
  const std::string stem = fs::path(beside).replace_extension().generic_string();
  std::string file = stem + ".ray";
  for (int i = 1; fs::exists(file); ++i) file = stem + "-trace" + (i > 1 ? std::to_string(i) : "") + ".ray";
  return file;
}

}  // namespace trace

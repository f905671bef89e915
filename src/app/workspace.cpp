#include "app/workspace.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/output.h"
#include "image/codec.h"

namespace trace {
namespace {

namespace fs = std::filesystem;
using Level = Workspace::LogEntry::Level;

constexpr std::chrono::milliseconds kLookInterval(500);  // for changes on disk

std::string absolute(const std::string& file) {
  std::error_code error;
  const fs::path path = fs::absolute(file, error);
  return error ? file : path.lexically_normal().string();
}

/// As a person would say it: from the current folder, if the file lies in it.
std::string shown(const std::string& file) {
  const std::string near = fs::path(absolute(file)).lexically_relative(absolute(".")).string();
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
    log_.push_back({level, message.what, message.hint, message.place});
  }
}

Workspace::Opened Workspace::read(const std::string& path, std::vector<Choice> commandLine) {
  Opened opened;
  try {
    opened.document.emplace().open(path, std::move(commandLine));
    return opened;
  } catch (const Error& error) {
    opened.errors = error.messages();
  } catch (const std::exception& error) {
    opened.errors = {{.place = {.file = path}, .what = error.what()}};
  }
  opened.document.reset();
  return opened;
}

bool Workspace::open(const std::string& file, std::vector<Choice> commandLine) {
  return adopt(read(absolute(file), std::move(commandLine)));
}

void Workspace::openLater(const std::string& file) {
  opening_.start([path = absolute(file)](const Cancelled&) { return read(path, {}); });
}

bool Workspace::adopt(Opened opened) {
  if (!opened.document) return report(opened.errors), false;
  document = std::move(*opened.document), reading_ = 0;
  const std::string path = document.file();
  std::erase(recent_, path);
  recent_.insert(recent_.begin(), path);
  recent_.resize(std::min(recent_.size(), kMostRecent));
  note("opened " + shown(path));
  reportReading();
  seen_ = document.revision();
  startRender();
  return true;
}

void Workspace::startRender() {
  if (!document.isOpen()) return;
  rendered_ = document.sharedScene(), renderedSettings_ = document.settings();
  render.start(rendered_, renderedSettings_);
}

bool Workspace::stale() const {
  return document.isOpen() &&
         (rendered_ != document.sharedScene() || differInPicture(renderedSettings_, document.settings()));
}

void Workspace::update() {
  if (std::optional<Opened> opened = opening_.take()) adopt(std::move(*opened));
  if (document.isOpen()) {
    reloadIfChanged();
    reportReading();
    if (seen_ != document.revision()) {
      seen_ = document.revision();
      if (automatic && stale()) startRender();
    }
  }
  report(render.takeMessages());
  noteEnd();
}

void Workspace::reportReading() {
  if (reading_ == document.readings()) return;
  reading_ = document.readings();
  report(document.messages().all());
}

void Workspace::reloadIfChanged() {
  const auto now = std::chrono::steady_clock::now();
  if (now - looked_ < kLookInterval) return;
  looked_ = now;
  if (!document.changedOnDisk()) return;
  try {
    document.reload();
    note(document.file() + " changed on disk and was read again; undo takes that back");
  } catch (const Error& error) {
    report(error.messages());
  }
}

void Workspace::noteEnd() {
  const BackgroundRender::State state = render.state();
  if (state.working() || state.number == reported_) return;
  reported_ = state.number;
  if (state.phase != BackgroundRender::Phase::finished) return;
  const Size size = render.session()->size();
  const RenderResult result = render.result();
  note("rendered " + std::to_string(size.width) + " x " + std::to_string(size.height) + " in " +
       durationText(state.elapsed) + ", " + std::to_string(result.statistics.allRays()) + " rays");
  if (const auto bad = result.statistics.badSamples; bad > 0)
    log_.push_back({Level::warning,
                    std::to_string(bad) + " samples were not finite and left out of the picture",
                    "the panel Bad samples lists them",
                    {}});
}

bool Workspace::openReference(const std::string& file) {
  try {
    reference_ = readPicture(file);
    referenceIsLinear_ = pictureFormatFor(file).keepsBright;
  } catch (const Error& error) {
    report(error.messages());
    return false;
  }
  referenceFile_ = absolute(file);
  ++referenceVersion_;
  note("comparing with " + referenceFile_);
  return true;
}

std::string Workspace::defaultPictureFile() const {
  return document.isOpen() ? fs::path(document.file()).replace_extension(".png").string() : "picture.png";
}

bool Workspace::saveScene(const std::string& file) {
  try {
    report(document.save(absolute(file)));
  } catch (const Error& error) {
    report(error.messages());
    return false;
  }
  note("wrote " + document.file());
  return true;
}

bool Workspace::savePicture(const std::string& file) {
  const auto session = render.session();
  if (!session) return false;
  Settings settings = session->settings();  // but what comes after the film is as it is now
  for (const Option& option : options())
    if (option.repeats == Repeats::tone) option.assign(settings, option.get(document.settings()));
  Metadata words = describe(session->scene(), settings);
  if (const std::string print = document.fileFingerprint(); !stale() && !print.empty())
    words.emplace_back("Scene", print);
  try {
    for (const Output& output : outputs(file, settings)) {
      write(output, session->film(), settings, words);
      note("wrote " + shown(output.path));
    }
  } catch (const Error& error) {
    report(error.messages());
    return false;
  }
  return true;
}

}  // namespace trace

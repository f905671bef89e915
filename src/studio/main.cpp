// ray-studio: the window of Trace. The logic is in app/Workspace; panels and actions are tables.
#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "app/session/version.h"
#include "app/view/magnifier.h"
#include "base/error.h"
#include "base/files/read_scope.h"
#include "base/os/process.h"
#include "base/printable.h"
#include "image/codecs/codec.h"
#include "studio/actions.h"
#include "studio/arguments.h"
#include "studio/host.h"
#include "studio/script.h"
#include "studio/script_state.h"
#include "studio/studio.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

constexpr int kWidth = 1280, kHeight = 800;  // width and height of the window, at first, on a plain monitor
// A page begins smaller than any screen: Emscripten would fill one of exactly that size.
constexpr int kSmall = 320;
constexpr double kSoon = 0.004;               // seconds until the next step of a view that is made smooth
constexpr double kIdle = 0.25, kBusy = 0.03;  // seconds between two looks at what continues in the background

const char* variable(const char* name) { return std::getenv(name); }

bool isPicture(const std::string& file) { return pictureFormatNamed(file) != nullptr; }

void openDropped(Studio& studio, const std::string& file) {
  if (isPicture(file))
    studio.workspace.openReference(file);
  else
    leaveToOpen(studio, file);
}

/// Tasks in the background, and scripts, bring news without an event.
bool isBusy(Studio& studio) {
  Workspace& workspace = studio.workspace;
  return workspace.render.state().working() || workspace.reading() || workspace.saving() ||
         workspace.inspector.busy() || studio.rays.modelTask.busy() || studio.rays.chains.busy() ||
         studio.rays.pyramid.busy() || studio.previews.busy() || studio.picture.cost.busy() ||
         (!workspace.document.isOpen() && studio.start.task.pending());
}

/// The last error of the log, over the panels.
void showError(Studio& studio) {
  const auto& log = studio.workspace.log();
  const auto error = std::find_if(log.rbegin(), log.rend(), [](const Workspace::LogEntry& entry) {
    return entry.level == Workspace::LogEntry::Level::error;
  });
  if (error == log.rend()) return;
  const SourcePlace& place = error->place;
  std::string where = std::filesystem::path(place.file.str()).filename().generic_string();
  if (place.line > 0) where += ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
  studio.banner.text = (where.empty() ? "" : where + ": ") + error->text;
  const Document& document = studio.workspace.document;
  studio.banner.scene = document.isOpen() ? document.sharedScene() : nullptr;
}

/// True if there is something new to see. Waits for it, but not longer than so many seconds.
bool update(Studio& studio, double longest) {
  Workspace& workspace = studio.workspace;
  const auto smooths = [&] { return studio.rays.coarse && studio.window.rested() > RaysView::kRest; };
  bool due = studio.window.wait(
      std::min(longest, smooths()                                                          ? kSoon
                        : isBusy(studio) || studio.rays.coarse || studio.rays.playsAt >= 0 ? kBusy
                                                                                           : kIdle));
  for (const std::string& file : studio.window.takeDropped()) openDropped(studio, file);
  for (const std::string& file : host::takeOpened()) openDropped(studio, file);
  const std::uint64_t failures = workspace.failures(), refusals = workspace.refusals();
  workspace.update();
  for (const std::string& file : workspace.takeWritten()) host::handOver(file);
  if (workspace.failures() > failures) {
    showError(studio);
    studio.quit = false;
  }
  if (workspace.refusals() > refusals) studio.mention("Log");
  const Workspace::Pulse pulse = workspace.pulse();
  const bool modelling =
      studio.rays.modelTask.busy() || studio.rays.chains.busy() || studio.rays.pyramid.busy();
  due = due || smooths() || studio.rays.playsAt >= 0 || studio.start.news(workspace.document.isOpen()) ||
        studio.previews.news() || studio.picture.cost.news() || studio.pulse != pulse ||
        modelling != studio.modelling || studio.themeChanged ||
        ImGui::GetIO().WantTextInput;  // its cursor blinks
  studio.pulse = pulse;
  studio.modelling = modelling;
  return due;
}

/// How much larger everything is than at first.
float scaleOf(const Studio& studio) {
  const float own = studio.window.contentScale() * studio.userScale;
  if (!studio.stage) return own;
  int width = 0, height = 0;
  studio.window.size(width, height);
  return studio.userScale * static_cast<float>(std::max<Real>(studio.window.contentScale(), 1) *
                                               stageScale(height / studio.window.contentScale()));
}

void frame(Studio& studio) {
  if (studio.themeChanged || (studio.stage && studio.theme.scale != scaleOf(studio))) {
    studio.theme.scale = scaleOf(studio);
    apply(studio.theme);
    studio.window.fontsChanged();
    studio.themeChanged = false;
  }
  studio.window.beginFrame();
  studio.keys = studio.window.keys();
  drawStudio(studio);
  studio.window.endFrame(studio.magnification);
  ++studio.frames;
}

/// As asked, or as it was last; at first as suits the monitor.
void sizeWindow(Studio& studio, const Arguments& arguments) {
  if (host::isPage()) return;  // which has its size of its own accord
  const double width = studio.preferences.number("width", 0), height = studio.preferences.number("height", 0);
  const float scale = studio.window.contentScale();
  if (arguments.width > 0)
    studio.window.setSize(arguments.width, arguments.height);
  else if (width >= 320 && height >= 240)
    studio.window.setSize(static_cast<int>(width), static_cast<int>(height));
  else
    studio.window.setSize(static_cast<int>(kWidth * scale), static_cast<int>(kHeight * scale));
}

std::vector<std::string> allowedToRead(const Arguments& arguments) {
  std::vector<std::string> allowed = arguments.allowRead;
  for (const Choice& choice : arguments.choices)
    if (findOption(choice.option).kind == Option::Kind::file) allowed.push_back(choice.value);
  return allowed;
}

/// The studio from its first frame to its last.
class Program {
 public:
  explicit Program(const Arguments& arguments)
      : reading_(allowedToRead(arguments)),
        script_(arguments.script.empty()
                    ? nullptr
                    : std::make_unique<Script>(arguments.script, resolve({arguments.choices}).timeLimit)),
        folder_(script_ ? "" : configFolder(variable)),
        window_("Trace", host::isPage() ? kSmall : kWidth, host::isPage() ? kSmall : kHeight),
        studio_(window_) {
    if (script_) keepLandmarks();
    host::answerWith([this] {
      keepLandmarks();
      return state(studio_);
    });
    host::keepWith([this] { return keptScene(studio_); });
    studio_.workspace.examples = studio_.start.folder = host::examples();
    studio_.configFolder = folder_;
    ImGui::GetIO().IniFilename = folder_.empty() ? nullptr : ini_.c_str();
    if (!folder_.empty()) restore(studio_);
    sizeWindow(studio_, arguments);
    studio_.workspace.commandLine = arguments.choices;
    if (!arguments.scene.empty()) studio_.workspace.open(arguments.scene);
    pixel_ = arguments.pixel;
    if (!arguments.reference.empty()) studio_.workspace.openReference(arguments.reference);
  }

  ~Program() {
    remember(studio_);
    window_.hide();  // what still runs has to be waited for
  }

  /// Takes in events, and draws a frame if there is news. False at the end.
  bool step() {
    if (studio_.quit && !studio_.workspace.saving()) return false;
    const bool scripted = script_ && !script_->waits();
    if (update(studio_, scripted ? 0 : script_ ? kBusy : kIdle) || scripted) frame(studio_);
    clickPixel();
    if (window_.closing()) {
      window_.keepOpen();
      studio_.leave([this] { studio_.quit = true; }, "to quit");
    }
    if (script_ && !script_->step(studio_)) return false;
    nameWindow();
    return true;
  }

 private:
  /// As soon as there is a picture that has it.
  void clickPixel() {
    const auto& shown = studio_.picture.shown;
    if (!pixel_ || shown.width == 0) return;
    const auto [x, y] = *std::exchange(pixel_, {});
    if (x < shown.width && y < shown.height)
      studio_.picture.goTo(x, y);
    else
      studio_.workspace.note("--pixel: the picture has " + std::to_string(shown.width) + " x " +
                             std::to_string(shown.height) + " pixels");
  }

  void nameWindow() {
    const std::string& file = studio_.workspace.document.file();
    const std::string now =
        file.empty() ? "Trace" : std::filesystem::path(file).filename().generic_string() + " - Trace";
    if (now == title_) return;
    window_.setTitle(title_ = now);
    remember(studio_);  // what was opened, should the window not come to its end
  }

  const ReadScope reading_;
  std::unique_ptr<Script> script_;
  const std::string folder_,
      ini_ = folder_ + "/imgui.ini";  // widths of columns; written when the window goes
  Window window_;
  Studio studio_;
  std::string title_;
  std::optional<std::array<int, 2>> pixel_;  // that is still to be clicked
};

int run(const Arguments& arguments) {
  host::eachFrame([program = std::make_shared<Program>(arguments)] { return program->step(); });
  return 0;
}

}  // namespace
}  // namespace trace::studio

int main(int argc, char** argv) {
  using namespace trace;
  os::guardStreams();
  try {
    const studio::Arguments arguments = studio::parse(os::arguments(argc, argv));
    if (arguments.help) {
      std::fputs(studio::helpText().c_str(), stdout);
      return 0;
    }
    if (arguments.version) {
      std::printf("%s\n", versionText().c_str());
      return 0;
    }
    return studio::run(arguments);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.fault());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ray-studio: error: %s\n", printable(error.what()).c_str());
    return static_cast<int>(Fault::io);
  }
}

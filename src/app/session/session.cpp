#include "app/session/session.h"

#include <algorithm>
#include <chrono>
#include <iterator>

#include "app/advice/auto_exposure.h"
#include "app/session/render_warnings.h"
#include "base/budget.h"
#include "base/files/file.h"
#include "base/files/read_scope.h"
#include "base/os/memory.h"
#include "base/os/process.h"
#include "base/text.h"
#include "formats/kind_defaults.h"
#include "image/development/denoise.h"
#include "render/integrators/make_integrator.h"
#include "render/maps/photon_map.h"
#include "render/picture/passes.h"
#include "scene/integrators.h"
#include "scene/picture_size.h"
#include "scene/quality.h"

namespace trace {

/// Measures a step from its construction to stop().
class Stopwatch {
 public:
  Phase stop(std::string name) const {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_;
    return {std::move(name), wall.count(), os::cpuSeconds() - cpu_};
  }

 private:
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  double cpu_ = os::cpuSeconds();
};

namespace {

/// While rendering and saving, a pixel lives in the film, in a copy of one of its pictures, toned or not, and
/// in the encoder's buffers.
std::uint64_t bytesPerPixel(const Settings& settings, const PassNames& names) {
  const std::uint64_t planesOfSplats = !hasTrait(settings, Trait::splats) ? 0 : settings.denoise ? 2 : 1;
  const std::uint64_t splats = planesOfSplats * SplatPlane::bytesPerPixel();
  // Two corners and their keys, as many as a picture with edges has.
  const std::size_t ofPasses = layersOf(settings).size();
  const auto all = static_cast<std::size_t>(lightLayersOf(settings, names.groups.size()).end);
  const std::size_t layers = ofPasses + 2 * (all - ofPasses);  // Keep::weighted has two pictures
  const std::uint64_t corners = subdivides(settings) ? 2 * ((layers + 1) * sizeof(Color) + 16) : 0;
  const std::uint64_t planes = settings.denoise ? denoisingBytesPerPixel() : 0;
  const bool stops = settings.noiseTarget > 0;
  return Film::bytesPerPixel(layers, settings.denoise, stops) + splats + corners + planes +
         2 * sizeof(Color) + 16;
}

/// The bytes of the photons that stay until the picture is made, if each comes to rest once.
std::uint64_t photonBytes(const Settings& settings) {
  const std::int64_t moments = settings.shutter > 0 ? settings.moments : 1;
  const int passes =
      std::max(1, static_cast<int>(std::min(settings.photonPasses, samplesOf(settings)) / moments));
  const std::int64_t photons = hasTrait(settings, Trait::photons) ? std::int64_t{settings.photons} * passes
                               : findOption("caustics").concerns(settings) ? settings.caustics
                                                                           : 0;
  return static_cast<std::uint64_t>(moments * photons) * sizeof(Photon);
}

/// The geometry is the same in both.
bool isSameAs(const Scene& a, const Scene& b) {
  return a.camera == b.camera && a.objects == b.objects && a.lights == b.lights &&
         a.materials == b.materials && a.background == b.background;
}

/// Whether a pass tells parts of the scene apart by their names, or by where they move.
bool namesItsParts(const Settings& settings) {
  constexpr Pass kNaming[] = {Pass::object, Pass::material, Pass::direct, Pass::indirect, Pass::motion};
  return std::any_of(std::begin(kNaming), std::end(kNaming),
                     [&](Pass pass) { return settings.passes.has(pass); });
}

PictureLimits pictureLimits(const Settings& settings) { return {.memory = allowedMemory(settings)}; }

}  // namespace

std::uint64_t allowedMemory(const Settings& settings) {
  return settings.maxMemory > 0 ? static_cast<std::uint64_t>(settings.maxMemory) << 20
                                : os::machineMemory() / 2;
}

void checkMemory(const std::string& what, const Size& size, std::uint64_t bytesPerPixel,
                 const Settings& settings, std::uint64_t photons) {
  const std::uint64_t needed =
      static_cast<std::uint64_t>(size.width) * static_cast<std::uint64_t>(size.height) * bytesPerPixel +
      photons;
  const std::uint64_t allowed = allowedMemory(settings);
  if (needed > allowed)
    throw Error(Fault::limit,
                what + (photons > 0 ? " with its photons, of " : " of ") + std::to_string(size.width) +
                    " x " + std::to_string(size.height) + " pixels needs " + std::to_string(needed >> 20) +
                    " MiB of memory; allowed are " + std::to_string(allowed >> 20),
                photons > needed / 2 ? "choose fewer photons or passes of them, or a larger --max-memory"
                                     : "choose a smaller --width, or a larger --max-memory");
}

SceneAtMoment readSceneAtItsMoment(const std::string& file, std::string_view bytes,
                                   std::span<const Choice> choices, Messages& messages) {
  const auto readAt = [&](Real seconds) {
    messages = {};
    SceneTime time(seconds);
    Scene scene = readScene(file, bytes, messages, time);
    return SceneAtMoment{std::move(scene), seconds, time.changesScene()};
  };
  SceneAtMoment read = readAt(resolve({choices}).time);
  if (const Real chosen = resolve({read.scene.choices, choices}).time; chosen != read.time)
    read = readAt(chosen);
  return read;
}

void Session::open(const std::string& file, std::span<const Choice> choices, bool strict) {
  const Stopwatch watch;
  const Work work("reading the scene");
  lookAtBudget();  // so that a late one ends with a message before anybody ends it by force
  if (budgetOfThread.budget) budgetOfThread.budget->letFinish(false);
  strict_ = strict;
  messages_ = {};
  const std::string bytes = readInput(file);
  SceneAtMoment read = readSceneAtItsMoment(file, bytes, choices, messages_);
  scene_ = std::move(read.scene);
  completeBareMesh(scene_);
  settings_ = settingsFor(scene_, {scene_.choices, choices});
  readSurroundings(scene_, settings_, pictureLimits(settings_), messages_);
  sceneAt_ = nullptr;
  if (read.changesWithTime)
    sceneAt_ = [file, bytes, rules = ReadScope::current()](Real moment) {
      const ReadScope scope(rules);
      Messages known;  // reported for the scene
      return readScene(file, bytes, known, moment);
    };
  fingerprint_ = scene_.inputs.fingerprint();
  messages_.throwIfFailed(strict_);
  if (budgetOfThread.budget) budgetOfThread.budget->limitTime(settings_.timeLimit);  // also the file's own
  phases_ = {watch.stop("read")};
}

void Session::open(Scene scene, const Settings& settings, SceneAt sceneAt) {
  strict_ = false;
  messages_ = {};
  phases_ = {};
  scene_ = std::move(scene);
  sceneAt_ = std::move(sceneAt);
  settings_ = settings;
  fingerprint_.clear();
}

void Session::compileWorld(const Session* before) {
  names_ = namesItsParts(settings_) ? passNames(scene_) : PassNames{};
  const Size picture = size();
  checkMemory("a picture", picture, bytesPerPixel(settings_, names_), settings_, photonBytes(settings_));
  readSurroundings(scene_, settings_, pictureLimits(settings_), messages_,
                   before ? &before->scene_.surroundings : nullptr);
  if (before) {
    const Compiled earlier{before->scene_, before->settings_, *before->world_};
    world_.emplace(compile(scene_, settings_, messages_, &earlier));
  } else {
    world_.emplace(compile(scene_, settings_, messages_));
  }
}

const PassFacts* Session::factsOf(const Scene& scene, Real time) {
  if (names_.empty()) return nullptr;
  PassFacts& facts = facts_.emplace_back(passFacts(scene, names_));
  if (!settings_.passes.has(Pass::motion) || !sceneAt_) return &facts;
  const Scene later = sceneAt_(time + 1 / framesPerSecond_);
  const CameraFrame camera = frame(cameraFor(later, settings_), settings_.cameraAxes, opticsOf(settings_));
  facts.motion = std::make_shared<const Motion>(motionBetween(scene, later, camera));
  return &facts;
}

void Session::prepareFilm() {
  messages_.throwIfFailed(strict_);
  measuredExposure_ = settleExposure(*world_, settings_);
  const Size picture = size();
  film_ = std::make_unique<Film>(makeFilm(settings_, picture.width, picture.height, names_));
}

void Session::build(const Session* before, const std::function<void()>& compiled) {
  const Stopwatch watch;
  compileWorld(before);
  if (compiled) compiled();
  buildMoments();
  warnOfSettings(scene_, settings_, *world_, messages_);
  warnOfEmptyMedia(scene_, messages_);
  warnOfWrongLinks(scene_, messages_);
  warnOfMissingCaustics(scene_, settings_, *world_, messages_);
  prepareFilm();
  phases_.push_back(watch.stop("build"));
}

void Session::buildToFinish() {
  const Stopwatch watch;
  compileWorld(nullptr);
  prepareFilm();
  phases_.push_back(watch.stop("build"));
}

void Session::buildMoments() {
  moments_.clear();
  scenes_.clear();
  worlds_.clear();
  integrators_.clear();
  facts_.clear();
  const auto add = [&](const World& world, const Settings& settings, const Scene& scene, Real time) {
    integrators_.push_back(makeIntegrator(world, settings, job_));
    moments_.push_back({&world, integrators_.back().get(), factsOf(scene, time)});
  };
  if (settings_.shutter > 0 && !sceneAt_)
    messages_.warn(SourcePlace{.file = scene_.file},
                   "nothing in the scene changes with time: --shutter blurs nothing",
                   "docs/animation.md describes animation");
  if (!(settings_.shutter > 0) || !sceneAt_) return add(*world_, settings_, scene_, settings_.time);
  Work work("building the moments of the shutter", settings_.moments);
  const Scene* before = &scene_;
  const World* built = &*world_;
  bool moves = false;
  Settings own = settings_;  // each moment has a part of the passes of photons, and sends others
  own.photonPasses = std::max(1, own.photonPasses / own.moments);
  for (int moment = 0; moment < settings_.moments; ++moment) {
    Scene& scene = scenes_.emplace_back(sceneAt_(timeOfMoment(settings_, moment)));
    moves = moves || !isSameAs(scene, scene_);
    Messages known;
    readSurroundings(scene, settings_, pictureLimits(settings_), known, &scene_.surroundings);
    const Compiled earlier{*before, settings_, *built};
    worlds_.push_back(compile(scene, settings_, known, &earlier));
    built = &worlds_.back();
    before = &scene;
    own.seed = settings_.seed ^ (moment << 16);
    add(*built, own, scene, timeOfMoment(settings_, moment));
    work.reached(moment + 1);
  }
  if (!moves)
    messages_.warn(SourcePlace{.file = scene_.file},
                   "nothing moves while the shutter is open, from " + toText(settings_.time) + " to " +
                       toText(settings_.time + settings_.shutter) + " seconds: --shutter blurs nothing",
                   "--time chooses another moment");
}

struct Session::Tracing {
  const Stopwatch watch;
  RenderInParts render;
};

Session::Session() = default;
Session::~Session() = default;

RenderResult Session::renderPicture() { return *renderPart(kInfinity); }

std::optional<RenderResult> Session::renderPart(double seconds) {
  if (budgetOfThread.budget) budgetOfThread.budget->letFinish();
  if (!tracing_) tracing_.reset(new Tracing{{}, {moments_, settings_, *film_, job_}});
  std::optional<RenderResult> result = tracing_->render.next(seconds);
  if (!result) return {};
  phases_.push_back(tracing_->watch.stop("trace"));
  tracing_.reset();
  return result;
}

Metadata Session::metadata() const {
  Metadata words = describe(scene_, settings_);
  words.emplace_back("Scene", fingerprint_);
  return words;
}

std::string Session::save(PictureFiles& files, LastSteps finish) {
  const Stopwatch watch;
  std::string written = files.write(*film_, settings_, metadata(), finish);
  phases_.push_back(watch.stop("write"));
  return written;
}

std::string Session::save(const std::string& path) {
  const BudgetScope unlimited(nullptr);
  PictureFiles files = filesFor(path);
  return save(files);
}

}  // namespace trace

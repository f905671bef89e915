#include "app/session/background_render.h"

#include <algorithm>

#include "render/integrators/make_integrator.h"
#include "render/picture/passes.h"
#include "scene/integrators.h"
#include "scene/options.h"

namespace trace {
namespace {

/// How much smaller the coarse pictures are: together they cost a twelfth of the real one.
constexpr int kCoarse[] = {16, 8, 4};
/// Seconds of tracing between two frames, where there is no thread.
constexpr double kPart = 0.03;
/// Smaller pictures than this show nothing.
constexpr int kLeastPreview = 16;

Settings reduced(const Settings& settings, Size whole, int factor) {
  Settings small = settings;
  small.width = std::max(1, whole.width / factor);
  small.height = std::max(1, whole.height / factor);
  small.spp = 1;
  small.subdivide = 0;
  small.denoise = false;
  small.timeLimit = 0;
  if (!settings.region.whole()) {
    const auto up = [&](int x) { return (x + factor - 1) / factor; };
    const Region& r = settings.region;
    small.region = {r.x0 / factor, r.y0 / factor, up(r.x1), up(r.y1)};
  }
  return small;
}

/// Settings of the direct light, if the integrator prepares something before it traces; none if it does not.
std::optional<Settings> directLightOf(const Settings& settings) {
  const bool photons = hasTrait(settings, Trait::photons);
  const bool caustics = settings.caustics > 0 && findOption("caustics").concerns(settings);
  const bool cache = settings.irradianceCache > 0 && findOption("irradiance-cache").concerns(settings);
  if (!photons && !caustics && !cache) return {};
  Settings direct = settings;
  if (photons || cache) direct.integrator = IntegratorKind::direct;
  direct.caustics = 0;
  direct.irradianceCache = 0;
  return direct;
}

}  // namespace

struct BackgroundRender::Run {
  enum class Stage { build, coarse, trace, denoise };

  Request request;
  double part = 0;  ///< seconds of tracing in a step
  Stage stage = Stage::build;
  std::shared_ptr<Session> session{};
  std::size_t coarse = 0;  ///< small pictures that were made
  std::optional<RenderResult> result{};
};

Picture enlarged(const Picture& small, Size size) {
  Picture large(size.width, size.height);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      large.at(x, y) = small.at(static_cast<int>(std::int64_t{x} * small.width / size.width),
                                static_cast<int>(std::int64_t{y} * small.height / size.height));
  return large;
}

BackgroundRender::BackgroundRender(Threads threads) {
  coarseJob_.patience = {};
  thread_ = ownThread(threads, [this] { work(); });
}

BackgroundRender::~BackgroundRender() {
  stop();
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void BackgroundRender::start(std::shared_ptr<const Scene> scene, const Settings& settings, SceneAt sceneAt) {
  stop();
  {
    const std::lock_guard lock(mutex_);
    request_ = Request{std::move(scene), settings, std::move(sceneAt), state_.number + 1};
    state_ = {Phase::building, 0, 0, {}, request_->number};
    if (session_ && session_->scene().file != request_->scene->file) {  // nobody should take it for this one
      session_.reset();
      coarse_ = {};
      denoised_.reset();
    }
    begin_ = std::chrono::steady_clock::now();
    remaining_ = {};
  }
  wake_.notify_all();
}

void BackgroundRender::stop() {
  const std::lock_guard lock(mutex_);
  request_.reset();
  if (!state_.working()) return;
  state_.phase = Phase::stopped;
  coarseJob_.cancel = true;
  early_ = {};
  if (building_) building_->job().cancel = true;
  if (session_) session_->job().cancel = true;
}

BackgroundRender::State BackgroundRender::state() {
  const std::lock_guard lock(mutex_);
  if (state_.working()) {
    state_.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    if (state_.phase == Phase::building && building_) state_.fraction = building_->job().fraction();
    if (state_.phase == Phase::tracing) {
      const Film& film = session_->film();
      state_.fraction =
          film.noiseTarget() > 0 ? std::max(state_.fraction, film.shareDone()) : session_->job().fraction();
      state_.remaining = remaining_.update(state_.elapsed - tracingBegan_, state_.fraction);
    }
  }
  return state_;
}

std::shared_ptr<const Session> BackgroundRender::session() const {
  const std::lock_guard lock(mutex_);
  return session_;
}

Picture BackgroundRender::picture() const {
  Picture picture;
  std::shared_ptr<Session> session;
  {
    const std::lock_guard lock(mutex_);
    if (early_.width > 0) return early_;
    if (!session_) return {};
    if (denoised_) return *denoised_;
    picture = coarse_;
    session = session_;
  }
  const Size size = session->size();
  if (picture.width != size.width || picture.height != size.height)
    picture = Picture(size.width, size.height);
  session->film().copyDone(picture);
  return picture;
}

std::uint64_t BackgroundRender::version() const {
  const std::lock_guard lock(mutex_);
  const auto done = session_ ? static_cast<std::uint64_t>(session_->job().done.load()) : 0;
  return (state_.number << 40) + (coarseVersion_ << 32) + done + (denoised_ ? 1 : 0);
}

RenderResult BackgroundRender::result() const {
  const std::lock_guard lock(mutex_);
  return result_;
}

std::vector<Message> BackgroundRender::takeMessages() {
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

void BackgroundRender::work() {
  for (;;) {
    Run run;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return quit_ || request_; });
      if (quit_) return;
      run.request = *std::exchange(request_, {});
      run.part = kInfinity;
      coarseJob_.cancel = false;
    }
    while (step(run)) {
    }
  }
}

void BackgroundRender::advance() {
  if (thread_.joinable()) return;
  if (request_) {
    run_ = std::make_unique<Run>();
    run_->request = *std::exchange(request_, {});
    run_->part = kPart;
    coarseJob_.cancel = false;
  }
  if (run_ && !step(*run_)) run_.reset();
}

bool BackgroundRender::isCurrent(const Run& run) const {
  return state_.number == run.request.number && state_.working();
}

void BackgroundRender::fail(const Run& run, const std::vector<Message>& messages) {
  const std::lock_guard lock(mutex_);
  messages_.insert(messages_.end(), messages.begin(), messages.end());
  if (state_.number == run.request.number) state_.phase = Phase::failed;
}

bool BackgroundRender::step(Run& run) {
  try {
    return doStep(run);
  } catch (const Error& error) {
    fail(run, error.messages());
  } catch (const std::bad_alloc&) {
    fail(run, {{.what = "out of memory", .hint = "choose a smaller width or a simpler scene"}});
  } catch (const std::exception& error) {
    fail(run, {{.what = error.what()}});
  }
  return false;
}

bool BackgroundRender::doStep(Run& run) {
  using Stage = Run::Stage;
  switch (run.stage) {
    case Stage::build: run.stage = Stage::coarse; return build(run);
    case Stage::coarse:
      if (coarsePass(run)) return true;
      run.stage = Stage::trace;
      return beginTracing(run);
    case Stage::trace:
      run.result = run.session->renderPart(run.part);
      if (run.result) run.stage = Stage::denoise;
      return true;
    case Stage::denoise: denoise(run); return false;
  }
  return false;
}

bool BackgroundRender::build(Run& run) {
  const Request& request = run.request;
  const auto session = std::make_shared<Session>();
  session->job().patience = {};  // who stops it wants to see something else
  session->open(*request.scene, request.settings, request.sceneAt);
  {
    const std::lock_guard lock(mutex_);
    if (!isCurrent(run)) return false;
    building_ = session;
  }
  const auto noLonger = [this](const void*) {
    const std::lock_guard lock(mutex_);
    building_.reset();
    early_ = {};
  };
  const std::unique_ptr<const void, decltype(noLonger)> scope(this, noLonger);
  session->build(built_.get(), [&] {
    if (run.part == kInfinity) showDirectLight(*session, request.number);  // else nobody would see it in time
  });
  built_ = session;
  const std::lock_guard lock(mutex_);
  const std::vector<Message>& warnings = session->messages().all();
  messages_.insert(messages_.end(), warnings.begin(), warnings.end());
  if (!isCurrent(run)) return false;
  // Until the first coarse pass is done the picture before shows through, if it fits and is of the same
  // scene.
  const Size size = session->size();
  const bool another = session_ && session_->scene().file != session->scene().file;
  if (another || coarse_.width != size.width || coarse_.height != size.height)
    coarse_ = {};
  else if (session_)
    session_->film().copyDone(coarse_);
  if (early_.width == size.width && early_.height == size.height) coarse_ = std::move(early_);
  session_ = run.session = session;
  denoised_.reset();
  state_.phase = Phase::coarse;
  state_.fraction = 0;
  return true;
}

/// False after the last.
bool BackgroundRender::coarsePass(Run& run) {
  const Session& session = *run.session;
  return coarsePass(run.coarse++, session.moments(), session.settings(), session.size(),
                    [&](Picture picture) {
                      const std::lock_guard lock(mutex_);
                      coarse_ = std::move(picture);
                      ++coarseVersion_;
                      return true;
                    });
}

bool BackgroundRender::beginTracing(const Run& run) {
  const std::lock_guard lock(mutex_);
  if (!isCurrent(run)) return false;
  state_.phase = Phase::tracing;
  tracingBegan_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  return true;
}

void BackgroundRender::denoise(Run& run) {
  const std::shared_ptr<Session>& session = run.session;
  RenderResult& result = *run.result;
  std::optional<Picture> without;
  if (result.failure.empty() && run.request.settings.denoise) {
    {
      const std::lock_guard lock(mutex_);
      if (isCurrent(run)) state_.phase = Phase::denoising;
    }
    without = denoised(session->film(), session->settings(), coarseJob_);
  }
  const std::lock_guard lock(mutex_);
  if (!result.failure.empty()) messages_.push_back({.what = result.failure});
  if (state_.number == run.request.number && session_ == session) {
    state_.elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    state_.fraction = session->job().fraction();
    state_.phase = result.end == End::finished ? Phase::finished
                   : result.failure.empty()    ? Phase::stopped
                                               : Phase::failed;
    denoised_ = std::move(without);
    result_ = std::move(result);
  }
}

bool BackgroundRender::coarsePass(std::size_t index, std::span<const Moment> moments,
                                  const Settings& settings, Size size,
                                  const std::function<bool(Picture)>& show) {
  if (index >= std::size(kCoarse)) return false;
  const int factor = kCoarse[index];
  if (size.width / factor < kLeastPreview) return true;
  const Settings small = reduced(settings, size, factor);
  Film film = makeFilm(small, small.width, small.height);
  coarseJob_.done = 0;
  coarseJob_.total = 0;
  if (trace::render(moments, small, film, coarseJob_).end != End::finished) return false;
  return show(enlarged(film.picture(), size));
}

void BackgroundRender::showDirectLight(const Session& session, std::uint64_t number) {
  const std::optional<Settings> settings = directLightOf(session.settings());
  if (!settings) return;
  const std::unique_ptr<const Integrator> integrator = makeIntegrator(session.world(), *settings, coarseJob_);
  const Moment moment{&session.world(), integrator.get()};
  const Size size = session.size();
  const auto show = [&](Picture picture) {
    const std::lock_guard lock(mutex_);
    if (state_.number != number || !state_.working()) return false;
    const bool fits =
        !session_ || (session_->size().width == size.width && session_->size().height == size.height);
    if (!fits) return false;  // what is shown besides, such as samples, is of another size
    early_ = std::move(picture);
    ++coarseVersion_;
    return true;
  };
  for (std::size_t i = 0; coarsePass(i, {&moment, 1}, *settings, size, show); ++i) {
  }
}

}  // namespace trace

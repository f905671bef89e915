// A scene and its render: what the command line and the studio do with the floors below.
// No printing, no signals, no windows.
#pragma once

#include <functional>
#include <iterator>
#include <list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/advice/first_aid.h"
#include "app/session/denoising.h"
#include "app/session/output.h"
#include "base/error.h"
#include "formats/format.h"
#include "render/picture/explain.h"
#include "render/picture/render.h"
#include "render/samples/integrator.h"
#include "scene/options.h"
#include "scene/scene.h"

namespace trace {

/// How long a step took: seconds on the clock and of processor time, all threads together.
struct Phase {
  std::string name;  ///< "read", "build", "trace", "write"
  double wall = 0, cpu = 0;
};

struct SceneAtMoment {
  Scene scene;
  Real time = 0;                 ///< the moment, in seconds
  bool changesWithTime = false;  ///< at another one it may be another scene
};
/// The scene at the moment that the choices name, or else its own settings: it is read again if these choose
/// another one than it was first read at. Throws as readScene().
SceneAtMoment readSceneAtItsMoment(const std::string& file, std::string_view bytes,
                                   std::span<const Choice> choices, Messages& messages);

/// Reads the scene once more, as it is at a time.
using SceneAt = std::function<Scene(Real time)>;

class Session {
 public:
  Session();
  ~Session();

  /// Reads the scene and settles the settings: defaults < file < choices.
  /// Throws Error; with `strict`, warnings are errors too.
  void open(const std::string& file, std::span<const Choice> choices, bool strict = false);

  /// Takes a scene that was read before, and settled settings: what the studio renders.
  /// `sceneAt` reads it at other times, if it changes with time.
  void open(Scene scene, const Settings& settings, SceneAt sceneAt = {});

  const Scene& scene() const { return scene_; }
  const SceneAt& sceneAt() const { return sceneAt_; }  ///< null for a scene that does not change with time
  const Settings& settings() const { return settings_; }
  const Messages& messages() const { return messages_; }  ///< warnings of reading and building
  Size size() const { return pictureSize(settings_, scene_.camera); }

  /// Builds the World and makes the film. Throws Error; Error(Fault::limit) if memory will not do. What has
  /// not changed since a session built before is shared with it. `compiled` is called once the World is
  /// there, before what the integrator prepares, such as photons.
  void build(const Session* before = nullptr, const std::function<void()>& compiled = {});
  /// Makes what turns samples that others took into the picture: as build(), but nothing that traces it, such
  /// as photons.
  void buildToFinish();
  const World& world() const { return *world_; }
  /// While the shutter is open; one where it is not. After build().
  std::span<const Moment> moments() const { return moments_; }
  /// The world of the moment that a tree of rays was traced at.
  const World& worldOf(const RayTree& tree) const {
    return tree.moment < 0 ? *world_ : *moments_[static_cast<std::size_t>(tree.moment)].world;
  }
  /// The scene of that moment: it may have other objects than scene().
  const Scene& sceneOf(const RayTree& tree) const {
    return tree.moment < 0 ? scene_ : *std::next(scenes_.begin(), tree.moment);
  }

  /// Traces the picture; blocks. Others may watch and stop it through job() and picture().
  RenderResult renderPicture();
  /// Traces a part of it, for about so many seconds; nothing until it ends.
  std::optional<RenderResult> renderPart(double seconds);
  Job& job() { return job_; }
  const Job& job() const { return job_; }

  /// The rays of one sample of the pixel (x, y), y = 0 at the top, and the pixel's value. After build(); also
  /// while renderPicture() runs. Throws Error(Fault::usage) outside the picture.
  Explanation explain(int x, int y, int sample, const std::function<bool()>& cancelled = {}) const {
    return trace::explain(moments_, settings_, size(), x, y, sample, cancelled);
  }

  /// The picture rendered so far. May be asked from other threads while renderPicture() runs.
  /// There is one from build() on.
  bool hasFilm() const { return film_ != nullptr; }
  const Film& film() const { return *film_; }
  Film& film() { return *film_; }  ///< to fill with what was rendered before
  Picture picture() const { return pictureOfFilm(*film_, settings_); }
  /// How the picture is made, in words: those of describe(), and Scene, the fingerprint of the files read.
  Metadata metadata() const;
  /// The files of a picture of that name, for save().
  PictureFiles filesFor(const std::string& path) const { return {path, scene_.inputs, names_}; }
  /// The frame after this one is shown so much later: for the pass `motion`. Before build().
  void setFramesPerSecond(Real rate) { framesPerSecond_ = rate; }
  const PassNames& names() const { return names_; }
  /// Writes them, and returns the picture's name; not while renderPicture() runs, since both note their time.
  /// Throws Error(Fault::io), Error(Fault::usage), and what the budget of the thread throws.
  std::string save(PictureFiles& files, LastSteps finish = LastSteps::all);
  /// The same, however long it takes.
  std::string save(const std::string& path);

  /// A warning if the finished picture is not worth looking at, with a cure (app/advice/first_aid.h).
  /// `whyUnlit` is asked where no light reaches what is seen.
  std::optional<Message> firstAid(std::function<std::optional<Message>()> whyUnlit = {}) const {
    return trace::firstAid(scene_, settings_, *world_, *film_, {measuredExposure_, std::move(whyUnlit)});
  }

  const std::vector<Phase>& phases() const { return phases_; }

  /// The exposure that automatic exposure added to the settings' own, in stops; after build().
  Real measuredExposure() const { return measuredExposure_.value_or(0); }

 private:
  void compileWorld(const Session* before);
  void prepareFilm();
  void buildMoments();
  const PassFacts* factsOf(const Scene& scene, Real time);

  Scene scene_;
  SceneAt sceneAt_;  // null of a scene that does not change
  Settings settings_;
  std::string fingerprint_;  // "" of a scene that was not read here
  Messages messages_;
  bool strict_ = false;
  std::optional<World> world_;
  std::vector<Moment> moments_;
  std::list<Scene> scenes_;  // the scenes of the moments, if there are several
  std::list<World> worlds_;
  PassNames names_;             // empty unless a pass wants them
  std::list<PassFacts> facts_;  // facts of the moments, likewise
  Real framesPerSecond_ = 24;
  std::list<std::unique_ptr<const Integrator>> integrators_;
  std::unique_ptr<Film> film_;
  Job job_;
  struct Tracing;
  std::unique_ptr<Tracing> tracing_;  // begun, and not at its end
  std::vector<Phase> phases_;
  std::optional<Real> measuredExposure_;  // nothing unless the settings asked
};

/// Bytes of memory that a scene may take: what --max-memory says, or half of what the machine has.
std::uint64_t allowedMemory(const Settings& settings);

/// Throws Error(Fault::limit) if `what`, such as "a picture", of this size needs more memory than allowed,
/// with the bytes that its photons take.
void checkMemory(const std::string& what, const Size& size, std::uint64_t bytesPerPixel,
                 const Settings& settings, std::uint64_t photons = 0);

}  // namespace trace

// Everything a render can be told. Each field has one row in the options table (options.cpp), which makes
// it a flag, a scene-file keyword, a control of the studio, a line of docs/options.md and an entry of the
// picture's metadata. A field without a row does not compile.
#pragma once

#include <optional>
#include <string>

#include "base/enum_set.h"
#include "image/development/development.h"
#include "image/development/tone.h"
#include "image/film/pixel_filter.h"
#include "math/elementary.h"
#include "shading/cameras/camera.h"
#include "shading/environment_map.h"
#include "shading/rules.h"

namespace trace {

enum class Accel { bvh, none };
/// The integrator: a row of integrators.cpp.
enum class IntegratorKind { whitted, path, direct, bdpt, mlt, photon, occlusion, normals, cost };
/// The state space of the chains of mlt: an integrator's samples, or paths, whose vertices are mutated.
enum class Chains { bdpt, path, veach };
/// How paths are changed place by place.
enum class Mutation { bidirectional, lens, caustic, multiChain };
/// How the samples of a pixel are spread: a row of render/samples/sampler.cpp.
enum class SampleKind { grid, random, jittered, stratified, halton, sobol, blue };

/// Whose rules hold where the courses and years differ: a row of conventions.cpp.
enum class Like { uw, uw2009, uw2001, ut, ubc, uw1998, usc };

enum class Glass { perCrossing, perDistance };
/// How much glass mirrors: what its material says, or by the angle.
enum class Fresnel { constant, schlick, exact };
/// Whether nested glass objects are distinguished: where materials say `priority`, or always, or
/// never.
enum class NestedGlass { byPriority, on, off };
enum class GlassShadows { filtered, black };
/// Which shading models hold: what materials say, or the nearest to Blinn and Phong.
enum class Models { asSaid, phong };
enum class BackFaces { both, cullSeen, cullAll };
enum class PixelPosition { corner, center, border };
enum class VertexNormals { unit, mean };

/// How much work a picture is worth: a row of quality.cpp.
enum class Quality { none, draft, good, final };

/// A type of the list of shapes, by its number there.
enum class ShapeKind {};

/// A part of scenes that can be switched off, by its number in the table of scene_features.h.
enum class SceneFeature {};

/// A picture beside the picture: a row of render/picture/passes.cpp.
enum class Pass {
  depth,
  normal,
  id,
  uv,
  position,
  samples,
  albedo,
  occlusion,
  change,
  object,
  material,
  direct,
  indirect,
  motion,
  variance
};
/// The distance in the pass "depth": along the view direction, or along the ray.
enum class PassDepth { view, ray };
/// How files of passes are called: NAME.PASS.exr or NAME_PASS.exr.
enum class PassName { dot, underscore };
/// The look of levels of passes that are numbers.
enum class PassColors { grey, heat };
/// The file format of passes; same: that of the picture; layers: in the file of the picture.
enum class PassFormat { exr, png, same, layers };

/// Pixels x0 <= x < x1, y0 <= y < y1, counted from the top left; empty means the whole picture.
struct Region {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool whole() const { return x0 >= x1 || y0 >= y1; }
  bool operator==(const Region&) const = default;
};

/// A file, or a folder of files, as the program opens it; "" for none.
struct FilePath {
  std::string path;
  bool operator==(const FilePath&) const = default;
};

/// A place of the scene: a point, or an object by its name; none if it is neither.
struct ScenePlace {
  std::string object;
  std::optional<Vec3> point{};
  bool none() const { return object.empty() && !point; }
  bool operator==(const ScenePlace&) const = default;
};

struct Settings {
  // Picture
  int width = 400;
  int height = 0;
  Region region{};
  Quality quality = Quality::none;
  int spp = 1;
  Real noiseTarget = 0;
  int subdivide = 0;
  Real subdivideThreshold = 0.003;
  bool denoise = false;
  int jpegQuality = 95;
  Real time = 0;
  Real shutter = 0;
  int moments = 16;
  // Sampling
  SampleKind sampling = SampleKind::grid;
  int seed = 0;
  FilterKind filter = FilterKind::box;
  Real filterRadius = 0;
  int lightSamples = 1;
  int lightChoices = 0;
  // Camera
  Projection projection = Projection::perspective;
  Real viewHeight = 0;
  Real fisheyeAngle = 180;
  Real shiftX = 0, shiftY = 0;
  Real distortion = 0;
  Stereo stereo = Stereo::off;
  Real eyeSeparation = 0;
  Real zeroParallax = 0;
  // Lens
  Real aperture = 0;
  Real focus = 0;
  ScenePlace focusOn{};
  int blades = 0;
  Real bladeAngle = 0;
  FilePath aperturePicture{};
  Real tilt = 0;
  // Tracing
  IntegratorKind integrator = IntegratorKind::whitted;
  int depth = 5;
  Real threshold = 0;
  Real fireflyLimit = 0;
  int lightVertices = -1, cameraVertices = -1;
  bool unweighted = false;
  Chains chains = Chains::bdpt;
  EnumSet<Mutation> mutations{Mutation::bidirectional, Mutation::lens, Mutation::caustic,
                              Mutation::multiChain};
  int chainStarts = 100000;
  Real moveAnywhere = 0.3;
  Real moveSize = 0.01;
  int lampSamples = 0;
  int ambientOcclusion = 0;
  Real occlusionReach = 0;
  int photons = 200000;
  int photonPasses = 8;
  Real photonShare = 1;
  bool finalGather = false;
  Real irradianceCache = 0;
  int irradianceRays = 400;
  bool smoothTerminator = false;
  int caustics = 0;
  Real causticRadius = 0;
  int causticTexels = 0;
  NestedGlass nestedGlass = NestedGlass::byPriority;
  int wavelengths = 1;
  bool varnish = false;
  bool glossy = false;
  Models models = Models::asSaid;
  bool textures = true;
  Real outlines = 0;
  EnumSet<ShapeKind> omit{};
  EnumSet<SceneFeature> switchedOff{};
  // Background
  FilePath backdrop{};
  FilePath environment{};
  EnvironmentKind environmentKind = EnvironmentKind::automatic;
  Real environmentRotation = 0;
  Real environmentBrightness = 1;
  Real environmentBlur = 0;
  // Fog
  Real fog = 0;
  Color fogColor{1};
  Real fogHeight = 0;
  Real fogForward = 0;
  int fogSamples = 8;
  int mediumDepth = 100;
  int subsurfaceSamples = 4;
  // Conventions
  Like like = Like::uw;
  Highlight highlight = Highlight::blinn;
  Real shininessScale = 1;
  Real ambientScale = 1;
  MirrorDefault mirrorDefault = MirrorDefault::specular;
  DiffuseSides diffuseSides = DiffuseSides::front;
  bool limitAttenuation = true;
  Glass glass = Glass::perCrossing;
  Real airIndex = 1.0003;
  Fresnel fresnel = Fresnel::constant;
  GlassShadows glassShadows = GlassShadows::filtered;
  BackFaces backFaces = BackFaces::both;
  VertexNormals vertexNormals = VertexNormals::unit;
  bool roundSpheres = false;
  bool roundMaps = true;
  CameraAxes cameraAxes = CameraAxes::orthonormal;
  PixelPosition pixelPosition = PixelPosition::corner;
  Tone tone = Tone::clamp;
  Rounding rounding = Rounding::truncate;
  // Tone
  Real exposure = 0;
  bool autoExposure = false;
  Real whiteBalance = 0;
  Transfer transfer = Transfer::linear;
  Real workingGamma = 1;
  Real bloom = 0;
  bool dither = false;
  // Passes
  bool alpha = false;
  EnumSet<Pass> passes{};
  PassFormat passFormat = PassFormat::exr;
  PassName passName = PassName::dot;
  PassColors passColors = PassColors::grey;
  PassDepth passDepth = PassDepth::view;
  Real passNear = 0;
  Real passFar = 0;
  // Resources
  int threads = 0;
  Accel accel = Accel::bvh;
  Real timeLimit = 0;
  Real checkpointEvery = 30;
  int maxMemory = 0;

  bool operator==(const Settings&) const = default;
};

/// When the moment of that number is, in seconds: while the shutter is open they lie evenly.
inline Real timeOfMoment(const Settings& s, int moment) {
  return s.time + s.shutter * (moment + 0.5) / s.moments;
}

inline Optics opticsOf(const Settings& s) {
  constexpr Real kDegree = kPi / 180;
  return {.projection = s.projection,
          .viewHeight = s.viewHeight,
          .fisheyeAngle = s.fisheyeAngle * kDegree,
          .shift = {s.shiftX, s.shiftY},
          .distortion = s.distortion,
          .tilt = s.tilt * kDegree,
          .lens = {s.aperture / 2, s.focus, s.blades, s.bladeAngle * kDegree},
          .stereo = s.stereo,
          .eyeSeparation = s.eyeSeparation,
          .zeroParallax = s.zeroParallax};
}

inline Development developmentOf(const Settings& s) {
  return {s.bloom, s.exposure, s.whiteBalance, s.tone, s.workingGamma, s.transfer, s.dither};
}

/// The luminance that shows as white.
inline double whiteOf(const Settings& s) { return math::exp2(-s.exposure); }

inline Rules rulesOf(const Settings& s) {
  return {s.highlight,    s.shininessScale,   s.mirrorDefault,
          s.diffuseSides, s.limitAttenuation, s.fresnel == Fresnel::exact};
}

}  // namespace trace

#include "app/session/render_warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <span>
#include <string>
#include <type_traits>

#include "app/advice/missing_caustic.h"
#include "base/text.h"
#include "math/elementary.h"
#include "math/low_discrepancy.h"
#include "math/warp.h"
#include "render/lights/lamps.h"
#include "render/picture/passes.h"
#include "render/picture/render.h"
#include "scene/groups.h"
#include "scene/integrators.h"
#include "scene/options.h"
#include "scene/quality.h"
#include "scene/scene_features.h"

namespace trace {
namespace {

constexpr Real kCoolestWhite = 1667;  // kelvin, the least of --white-balance but for 0

template <class Is>
bool anyObject(const World& world, Is&& is) {
  for (const std::uint32_t object : world.kindsOfObjects())
    if (!world.shapeOf(object).empty() && is(world.termsOf(object))) return true;
  return false;
}

/// Nothing in the scene or around it gives light.
bool isDark(const Scene& scene, const World& world) {
  const bool glow = std::any_of(scene.materials.begin(), scene.materials.end(), glows);
  return scene.lights.empty() && !glow && !world.outside().isSeenBy(RayKind::reflection) &&
         world.media().empty();
}

bool hasSun(const Scene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const LightSource& l) { return l.light.type().starts == LightOrigin::parallel; });
}

/// Some rays of the camera hit nothing, or some that continue from where they end, in any direction: in a
/// room with a window the air outside is lit, too.
bool seesBeyond(const World& world) {
  constexpr int kAcross = 16, kPlaces = 6;
  Statistics uncounted;
  std::uint32_t number = 0;
  for (int i = 0; i < kAcross * kAcross; ++i) {
    Ray ray = world.camera().ray({(i % kAcross + 0.5) / kAcross, (i / kAcross + 0.5) / kAcross});
    for (int place = 0; place < kPlaces; ++place) {
      const auto found = world.closest(ray, Faces::both, uncounted);
      if (!found) return true;
      constexpr Real kBefore = 0.999;  // air, where fog scatters
      ray = {ray.at(found->t * kBefore), toCone(sobolPoint(++number), {0, 0, 1}, -1)};
    }
  }
  return false;
}

/// The first object whose material is so; null if none is.
template <class Is>
const Object* firstWith(const Scene& scene, Is&& is) {
  const auto found = std::find_if(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
    return is(scene.materials[object.material].model);
  });
  return found == scene.objects.end() ? nullptr : &*found;
}

/// A drawing, made for the light of lamps alone.
bool draws(const MaterialModel& model) {
  return !model.is<Phong>() && !model.type().reciprocal && !model.type().keepsEnergy;
}

/// Phong's model lets it surely give back more light than it gets.
bool gainsLight(const MaterialModel& model) {
  constexpr Real kMuch = 1.25;  // less is lost again in most scenes
  const auto* phong = model.as<Phong>();
  if (!phong) return false;
  return maxComponent(phong->diffuse + (phong->transmits() ? phong->transmissive : phong->reflective)) >
         kMuch;
}

/// Its colour is one of which the reader of the file warned.
bool isTooBright(const Scene& scene, const MaterialModel& model) {
  const auto* phong = model.as<Phong>();
  return phong && scene.format == "ray" && maxComponent(phong->diffuse) > 1;
}

/// So far away for its size that it cannot be seen, and that rounding moves its points.
bool isLost(const Affine& placed) {
  constexpr Real kMostSizes = 1e12;
  const Vec3 size = abs(placed.row[0]) + abs(placed.row[1]) + abs(placed.row[2]);
  return maxComponent(abs(placed.offset)) > kMostSizes * maxComponent(size);
}

/// A band of the background, which lights nothing, is not black.
bool hasBands(const Scene& scene) {
  const std::vector<Color>& bands = scene.background.colors;
  return std::any_of(bands.begin(), bands.end(), [](const Color& c) { return !isBlack(c); });
}

/// To what is farthest from the camera, of objects that have an end; 0 where none has.
Real distanceAcross(const World& world) {
  const Box3& box = world.bounds();
  if (box.empty() || !isFinite(box.low) || !isFinite(box.high)) return 0;
  const Vec3 eye = world.camera().eye;
  const auto far = [](Real at, Real low, Real high) {
    return std::max(std::abs(at - low), std::abs(high - at));
  };
  return length(Vec3{far(eye.x, box.low.x, box.high.x), far(eye.y, box.low.y, box.high.y),
                     far(eye.z, box.low.z, box.high.z)});
}

/// The names of what is switched off and is not there, "spot_light and ward"; "" if everything is switched
/// off.
std::string switchedOffForNothing(const Scene& scene, const Settings& settings) {
  std::string names;
  std::size_t off = 0;
  for (std::size_t i = 0; i < sceneFeatures().size(); ++i) {
    const auto feature = static_cast<SceneFeature>(i);
    if (!settings.switchedOff.has(feature)) continue;
    ++off;
    if (!hasFeature(scene, feature))
      names += (names.empty() ? "" : " and ") + std::string(sceneFeatureNames()[i]);
  }
  return off == sceneFeatures().size() ? "" : names;
}

/// Options that say something of what another one switches on.
struct Serves {
  std::string_view option, needed;
  std::string_view hint;  ///< a value of that
};
constexpr std::array kServes{
    Serves{"moments", "shutter", "0.04"},
    Serves{"fog-color", "fog", "0.05"},
    Serves{"fog-height", "fog", "0.05"},
    Serves{"fog-forward", "fog", "0.05"},
    Serves{"fog-samples", "fog", "0.05"},
    Serves{"subdivide-threshold", "subdivide", "3"},
    Serves{"caustic-radius", "caustics", "200000"},
    Serves{"irradiance-rays", "irradiance-cache", "0.2"},
    Serves{"focus", "aperture", "0.1"},
    Serves{"focus-on", "aperture", "0.1"},
    Serves{"blades", "aperture", "0.1"},
    Serves{"blade-angle", "aperture", "0.1"},
    Serves{"eye-separation", "stereo", "side-by-side"},
    Serves{"zero-parallax", "stereo", "side-by-side"},
};

}  // namespace

void warnOfSettings(const Scene& scene, const Settings& s, const World& world, Messages& messages) {
  const auto warn = [&](const std::string& what, const std::string& hint = {}) {
    messages.warn(SourcePlace{.file = scene.file}, what, hint);
  };
  const std::string integrator = findOption("integrator").get(s);
  const Traits traits = traitsOf(s);
  const auto isConcerned = [&](std::string_view option) { return findOption(option).concerns(s); };
  std::string meant = findOption("integrator").get({});  // the integrator that the scene is made for
  for (const Choice& choice : scene.choices)
    if (choice.option == "integrator") meant = choice.value;
  for (const Option& option : options()) {
    const bool ofScene = std::any_of(scene.choices.begin(), scene.choices.end(),
                                     [&](const Choice& choice) { return choice.option == option.name; });
    const auto isOf = [&](std::span<const Choice> chosen) {
      return std::any_of(chosen.begin(), chosen.end(), [&](const Choice& choice) {
        return choice.option == option.name && choice.value == option.get(s);
      });
    };
    const bool ofBundle = isOf(choicesOf(s.quality)) || isOf(quickChoices());
    const bool told = !ofBundle && (ofScene ? option.extra && integrator == meant : true);
    if (told && !option.concerns(s) && option.get(s) != option.get({}))
      warn("--" + std::string(option.name) + " changes nothing: it concerns " +
           namesOfIntegrators(option.integrators) + ", and --integrator is " + integrator);
  }

  if ((s.passes.has(Pass::direct) || s.passes.has(Pass::indirect)) && !splitsLight(s))
    warn("--integrator " + integrator +
             " cannot split the light by its sources: the passes direct and indirect are left out",
         "--integrator path, photon and whitted can");
  for (const Serves& row : kServes) {  // but not where the scene has both, and somebody switched one off
    const bool given = findOption(row.option).get(s) != findOption(row.option).get({});
    const bool otherwise = (row.needed == "caustics" && traits.has(Trait::photons)) ||
                           (row.option == "fog-samples" && !world.media().empty());
    const bool switchedOff = std::any_of(scene.choices.begin(), scene.choices.end(),
                                         [&](const Choice& choice) { return choice.option == row.needed; });
    if (given && isConcerned(row.option) && !otherwise && !switchedOff &&
        findOption(row.needed).get(s) == findOption(row.needed).get({}))
      warn("--" + std::string(row.option) + " changes nothing without --" + std::string(row.needed),
           "for example --" + std::string(row.needed) + " " + std::string(row.hint));
  }

  if (s.whiteBalance > 0 && s.whiteBalance < kCoolestWhite)
    warn("--white-balance " + toText(s.whiteBalance) + " counts as " + toText(kCoolestWhite) +
             " kelvin: cooler light is too red for a screen",
         "0 leaves colours as they are");
  if (const std::string names = switchedOffForNothing(scene, s); !names.empty())
    warn("--without " + names + " changes nothing: the scene has none");

  const bool chains = traits.has(Trait::byChains);
  const bool splats = traits.has(Trait::splats);
  if (s.subdivide > 0 && chains) warn("--subdivide changes nothing: chains of mlt choose where samples lie");
  if (s.subdivide > 0 && splats && !chains)
    warn("--subdivide changes nothing: paths from lights fall anywhere in the picture");
  if (subdivides(s)) {
    const auto scenes = [&](std::string_view option) {  // which would have it without --subdivide
      return std::any_of(scene.choices.begin(), scene.choices.end(), [&](const Choice& choice) {
        return choice.option == option && choice.value == findOption(option).get(s);
      });
    };
    for (const std::string_view option : {"spp", "noise-target", "filter", "denoise"})
      if (findOption(option).get(s) != findOption(option).get({}) && !scenes(option))
        warn("--" + std::string(option) +
             " changes nothing with --subdivide: a pixel is the mean of its squares");
  } else if (s.denoise && chains) {
    warn("--denoise changes nothing: the noise of a picture by chains is not known");
  } else if (s.denoise && samplesOf(s) < 8) {
    warn(
        "--denoise changes nothing: it compares two halves of a pixel's samples, from 8 on, and --spp "
        "gives " +
            std::to_string(samplesOf(s)),
        "choose a larger --spp, such as 16");
  }
  if (s.passes.has(Pass::change) && !s.denoise) warn("the pass change is black without --denoise");

  const bool aims = s.noiseTarget > 0 && !subdivides(s);
  if (aims && chains)
    warn("--noise-target changes nothing: chains of mlt do not know the error of a pixel");
  else if (aims && s.quality == Quality::none &&
           samplesOf(s) <= PixelSum::kFewest)  // else nobody asked for it
    warn("--noise-target changes nothing: it looks at a pixel from " + std::to_string(PixelSum::kFewest) +
             " samples on, and --spp gives " + std::to_string(samplesOf(s)),
         "choose a larger --spp, such as 256");

  if (!s.aperturePicture.path.empty() && !(s.aperture > 0))
    warn("--aperture-picture changes nothing: --aperture 0 is a pinhole", "--aperture 0.1 opens the lens");
  if (!s.aperturePicture.path.empty() && s.blades > 0)
    warn("--blades changes nothing: --aperture-picture is the shape of the lens opening");
  if (const Real reach = 2 * distanceAcross(world); reach > 0) {
    if (s.stereo != Stereo::off && s.eyeSeparation > reach)
      warn("--eye-separation " + toText(s.eyeSeparation) +
               ": the eyes stand so far apart that each looks past the scene",
           "without it they stand a thirtieth of the distance to the scene apart");
    if (s.aperture > reach)
      warn("--aperture " + toText(s.aperture) + ": the lens is wider than the scene, so nothing is in focus");
  }
  if (!s.focusOn.none() && s.focus > 0) warn("--focus changes nothing: --focus-on sets the focus");
  if (s.lightChoices > 0 && world.lights().size() < 2)
    warn("--light-choices changes nothing: the scene has fewer than two lights");

  if (!traits.has(Trait::meetsLamps) && isConcerned("caustics") && s.caustics > 0) {
    if (world.lights().empty())
      warn("--caustics changes nothing: the scene has no light that sends photons",
           "emissive objects emit none; --integrator path traces their light");
    else if (!anyObject(world,
                        [](const WhittedTerms& terms) { return terms.mirrors() || terms.transmits(); }))
      warn("--caustics changes nothing: nothing in the scene mirrors or refracts");
  }
  const auto hasNormals = [&](std::uint32_t object) {
    const MeshTree* mesh = world.meshTree(object);
    return mesh && !mesh->data().normals.empty();
  };
  if (s.smoothTerminator && isConcerned("smooth-terminator")) {
    const std::vector<std::uint32_t> all = world.kindsOfObjects();
    if (std::none_of(all.begin(), all.end(), hasNormals))
      warn("--smooth-terminator changes nothing: no mesh of the scene has normals at its points",
           "gennormals or crease in a mesh makes them");
  }
  if (isConcerned("caustic-texels") && s.caustics == 0 && s.causticTexels > 0)
    warn("--caustic-texels changes nothing: there are no photons to gather", "--caustics 200000 sends some");
  if (isConcerned("lamp-samples") && s.lampSamples > 0 && Lamps(world, s.threads, true).empty())
    warn(
        "--lamp-samples changes nothing: no object that is sampled as a light is emissive, and its sky is "
        "uniform",
        "give an object an emissive color; other emissive shapes light nothing");
  if (isConcerned("ambient-occlusion") && s.ambientOcclusion > 0 && isBlack(world.ambient()))
    warn("--ambient-occlusion changes nothing: the scene has no ambient light");

  if (isConcerned("lamp-samples") && s.lampSamples == 0 && world.lights().empty() &&
      !Lamps(world, s.threads).empty() &&
      anyObject(world, [](const WhittedTerms& terms) { return isBlack(terms.emissive); }))
    warn(anyObject(world, [](const WhittedTerms& terms) { return !isBlack(terms.emissive); })
             ? "only emissive objects light the scene, and for --integrator " + integrator +
                   " they light nothing"
             : "only the environment lights the scene, and for --integrator " + integrator +
                   " it lights nothing",
         "--lamp-samples 4 samples it; --integrator path traces the light further");

  if (traits.has(Trait::photons) && s.photonPasses > samplesOf(s) &&
      s.photonPasses != Settings{}.photonPasses)
    warn("--photon-passes " + std::to_string(s.photonPasses) +
             ": each sample of a pixel takes one map, and --spp gives " + std::to_string(samplesOf(s)),
         "choose --spp at least as large: no other maps are made");
  if (isConcerned("unweighted") && s.unweighted && s.lightVertices < 0 && s.cameraVertices < 0)
    warn("--unweighted: all light counts once for each strategy",
         "--light-vertices S or --camera-vertices T shows one of the strategies");

  if (isConcerned("camera-vertices") && s.cameraVertices == 0)
    warn("--camera-vertices 0 shows nothing: the camera is a vertex of every path",
         "--camera-vertices 1 shows the light image");
  if (isConcerned("light-vertices") && world.media().empty() && !(s.fog > 0) &&
      s.lightVertices + std::max(s.cameraVertices, 1) > s.depth + 3)
    warn("--light-vertices and --camera-vertices show nothing: with --depth " + std::to_string(s.depth) +
             " a path has " + std::to_string(s.depth + 3) + " vertices at most",
         "choose a larger --depth, or fewer vertices");
  if (chains && !changesPaths(s) && !(s.mutations == Settings{}.mutations))
    warn("--mutations changes nothing: the chains change random numbers",
         "--chains veach mutates the vertices of paths");
  if (changesPaths(s) && s.fireflyLimit > 0)
    warn("--firefly-limit changes nothing: chains of --chains veach stay longer at a brighter path",
         "more samples (--spp) spread them");
  if (changesPaths(s) && (s.lightSamples > 1 || s.lightChoices > 0))
    warn("--light-samples and --light-choices change nothing: a path of --chains veach ends at one light");
  constexpr int kFewStarts = 1000;
  if (chains && s.chainStarts < kFewStarts)
    warn("--chain-starts " + std::to_string(s.chainStarts) +
             ": how bright the picture is follows from so few samples",
         "choose " + std::to_string(kFewStarts) + " at least");

  if (s.subsurfaceSamples != Settings{}.subsurfaceSamples && isConcerned("subsurface-samples") &&
      !world.hasSubsurface())
    warn("--subsurface-samples changes nothing: no object of the scene has subsurface scattering",
         "library = marble and millimetres = 10 in a material add it");

  const auto glows = [](const World::MediumBody& body) { return !isBlack(body.model.most().glows); };
  if (traits.has(Trait::photons) && std::any_of(world.media().begin(), world.media().end(), glows))
    warn("--integrator photon shows emissive media, but they emit no photons",
         "--integrator path traces that light");

  const bool paths = traits.has(Trait::meetsLamps), bounces = traits.has(Trait::bounces);
  const bool lastingFog = s.fog > 0 && s.fogHeight == 0 && s.mediumDepth > 1 && !isBlack(s.fogColor);
  if (bounces && lastingFog && hasSun(scene) && seesBeyond(world))
    warn("the sun lights infinite fog: with --integrator " + integrator +
             " its brightness depends on --medium-depth and the size of the scene",
         "--fog-height thins it out above; --medium-depth 1 scatters light once, as whitted does");
  if (bounces)
    if (const Object* gains = firstWith(scene, [&](const MaterialModel& model) {
          return gainsLight(model) && !isTooBright(scene, model);
        }))
      messages.warn(gains->place,
                    "its material reflects more light than it receives (diffuse together with transmissive "
                    "or reflective, perhaps inherited from the material before): with --integrator " +
                        integrator + " it and its surroundings grow brighter with --depth",
                    "diffuse = 0 makes clear glass and plain mirrors");
  const auto lost = std::find_if(scene.objects.begin(), scene.objects.end(),
                                 [](const Object& object) { return isLost(object.worldFromObject); });
  if (lost != scene.objects.end())
    messages.warn(
        lost->place,
        "the " + std::string(lost->shape.keyword()) + " is " +
            toText(maxComponent(abs(lost->worldFromObject.offset))) +
            " away, more than 1e12 times its size: it cannot be seen, and rounding moves its points",
        "place it nearer, or make it larger");
  if (paths)
    if (const Object* drawn = firstWith(scene, draws))
      messages.warn(
          drawn->place,
          std::string(scene.materials[drawn->material].model.keyword()) +
              " is not photorealistic and may reflect more light than it receives: with --integrator " +
              integrator + " its surroundings grow brighter with --depth",
          "--integrator whitted is meant for it");
  if (paths && world.lights().empty() && !world.outside().isSeenBy(RayKind::bounce) &&
      !anyObject(world, [](const WhittedTerms& terms) { return !isBlack(terms.emissive); })) {
    const std::string hint = "add a light, an object with emissive, or a background with a gradient";
    if (!isBlack(world.ambient()))
      warn("--integrator " + integrator +
               " finds no light in the scene: ambient light stands for light that bounces, "
               "and is left out",
           hint);
    else if (hasBands(scene))  // app/advice/darkness.h reports a picture that is black all over
      warn("--integrator " + integrator + " finds no light in the scene, which the background does not light",
           hint);
  }
  if (!paths && traits.has(Trait::addsAmbient) && !(scene.objects.empty() && scene.uses.empty()) &&
      isDark(scene, world))
    warn("no light: everything will be black",
         "add one, as in point_light { position = (0, 0, 5); color = (1, 1, 1); }");
}

void warnOfEmptyMedia(const Scene& scene, Messages& messages) {
  const Material usual;
  for (const Object& object : scene.objects) {
    const Material& material = scene.materials[object.material];
    const bool says = material.mediumScatters != usual.mediumScatters ||
                      material.mediumAbsorbs != usual.mediumAbsorbs ||
                      material.mediumGlows != usual.mediumGlows;
    if (!says || material.mediumDensity > 0) continue;
    messages.warn(object.place, "its material has fields of a medium, but medium_density is 0: there is none",
                  "medium_density = 1 takes the other fields as they are");
    return;
  }
}

namespace {

/// Names in the links of a light or an object that none of the others has, of which `kind` they are: each is
/// told once.
class LinkCheck {
 public:
  LinkCheck(std::string_view kind, std::string_view example) : kind_(kind), example_(example) {}
  void know(const std::string& name) {
    if (!name.empty()) known_.insert(name);
  }
  template <class Links>
  void look(const Links& links, const SourcePlace& place, Messages& messages) {
    forEachField<Links>([&](const auto& field) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(links.*field.member)>,
                                   std::vector<std::string>>)
        for (const std::string& name : links.*field.member)
          if (!known_.contains(name) && told_.insert(name).second)
            messages.warn(
                place,
                std::string(field.keyword) + " names \"" + name + "\", and no " + kind_ + " is called so",
                hint(name));
    });
  }

 private:
  std::string hint(const std::string& name) const {
    if (known_.empty()) return "give " + kind_ + "s names, as in " + example_;
    return didYouMean(name, std::vector<std::string_view>(known_.begin(), known_.end()));
  }

  std::string kind_, example_;
  std::set<std::string_view> known_, told_;
};

}  // namespace

void warnOfWrongLinks(const Scene& scene, Messages& messages) {
  LinkCheck objects("object", "sphere { name = \"ball\"; }"),
      lights("light", "point_light { name = \"key\"; ... }");
  for (const Object* object : allObjects(scene)) objects.know(object->name);
  for (const LightSource& source : scene.lights) lights.know(source.links.name);
  for (const LightSource& source : scene.lights) objects.look(source.links, source.place, messages);
  for (const Object& object : scene.objects) lights.look(object.links, object.place, messages);
}

void warnOfMissingCaustics(const Scene& scene, const Settings& settings, const World& world,
                           Messages& messages) {
  const auto missing =
      missingCaustic(scene, settings, world, true, [&](std::uint32_t light, std::uint32_t object) {
        return !world.shapeOf(object).empty() && shinesOn(scene, world, light, object);
      });
  if (!missing) return;
  const SourcePlace& place = scene.lights[missing->light].place;
  messages.warn(place,
                objectName(scene, missing->object) + " has no caustics " +
                    (place.line > 0 ? "of this light: " : "of the light that Trace chose: ") + missing->why,
                missing->hint);
}

std::string brightnessDoubt(const Settings& settings, Real error) {
  constexpr Real kLarge = 0.03, kWanted = 0.02;
  if (!(error > kLarge)) return {};
  if (!std::isfinite(error))
    return "none of the first " + counted(static_cast<std::uint64_t>(settings.chainStarts), "sample") +
           " found light, and so the picture is black; a larger --chain-starts looks longer";
  const Real enough = settings.chainStarts * (error / kWanted) * (error / kWanted);
  const Real digit = math::pow(10, std::floor(math::log10(enough)));
  char percent[16];
  std::snprintf(percent, sizeof percent, "%.2g", 100 * error);
  return "how bright the whole picture is, is known to " + std::string(percent) +
         " % only (one standard error); --chain-starts " +
         std::to_string(static_cast<std::int64_t>(std::ceil(enough / digit) * digit)) + " makes that 2 %";
}

}  // namespace trace

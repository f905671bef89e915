#include "app/compare/extensions.h"

#include <algorithm>
#include <array>

#include "app/compare/difference.h"
#include "app/compare/grade_files.h"
#include "app/session/session.h"
#include "base/files/file.h"
#include "base/text.h"
#include "image/codecs/codec.h"
#include "image/comparison/flip.h"
#include "scene/scene_features.h"

namespace trace {
namespace {

/// One ball of scenes/materials-models.ray: columns and rows from 0.
#define BALL(left, top, right, bottom) "--width 1116 --region " #left "," #top "," #right "," #bottom
constexpr std::string_view kModels = "materials-models.ray", kPhong = "--models phong";

constexpr std::array kExtensions{
    Extension{"spp", "several rays a pixel for smooth edges", "antialias.ray", "--spp 1", "--spp 9", "",
              "--spp 1"},
    Extension{"noise-target", "adaptive sampling: nearly the same picture with fewer samples",
              "antialias.ray", "--spp 64 --sampling sobol", "--spp 64 --noise-target 0.01", ""},
    Extension{"subdivide",
              "recursive subdivision of pixels whose corners differ, as in 1980, so that edges get the rays",
              "antialias.ray", "--spp 1", "--subdivide 3", ""},
    Extension{"denoise", "noise is removed from the finished picture, guided by surface features",
              "cornell.ray", "--spp 16", "--spp 16 --denoise on", ""},
    Extension{"sampling", "stratified random samples: slightly noisy edges in place of steps",
              "antialias.ray", "--spp 4", "--spp 4 --sampling stratified", ""},
    Extension{"filter", "samples are weighted by their distance from the middle of the pixel",
              "antialias.ray", "--spp 9", "--spp 9 --filter gaussian", ""},
    Extension{"light-samples", "soft shadows of lights that have a size", "soft-shadows.ray",
              "--spp 1 --light-samples 1", "--spp 1 --light-samples 32", ""},
    Extension{"light-choices", "each hit point samples some of many lights, chosen by a light tree",
              "lanterns.ray", "--spp 1 --light-choices 0", "", "--width 200"},
    Extension{"lamp-samples", "emissive objects light others", "glow.ray", "--lamp-samples 0", "", ""},
    Extension{"aperture", "depth of field: objects out of focus blur", "lens.ray", "--aperture 0", "", ""},
    Extension{"aperture-picture", "a lens opening of any shape", "hearts.ray", "--aperture-picture none", "",
              ""},
    Extension{"projection", "other cameras than the pinhole: panoramas, fisheyes, orthographic views",
              "room.ray", "--projection perspective", "--projection panorama", ""},
    Extension{"distortion", "barrel and pincushion distortion of real lenses", "room.ray", "--distortion 0",
              "--distortion 0.3", ""},
    Extension{"shutter", "motion blur while the shutter is open", "motion.ray", "--shutter 0", "", ""},
    Extension{"stereo", "a stereo pair in one picture, here for red and cyan glasses", "room.ray",
              "--stereo off", "--stereo red-cyan", ""},
    Extension{"exposure", "brighter or darker, after the render", "lamps.ray", "--exposure 0", "--exposure 1",
              ""},
    Extension{"white-balance", "the yellow light of lamps is shown as white", "lamps.ray",
              "--white-balance 0", "--white-balance 3200", ""},
    Extension{"transfer", "sRGB levels, as screens expect them", "lamps.ray", "--transfer linear",
              "--transfer srgb", ""},
    Extension{"tone", "a film's curve: bright colours fade to white", "lamps.ray",
              "--transfer srgb --tone clamp", "--transfer srgb --tone agx", ""},
    Extension{"bloom", "light that lens and eye scatter around bright lights", "lamps.ray", "--bloom 0",
              "--bloom 0.15", ""},
    Extension{"dither", "noise of one level hides the steps of faint gradients", "lamps.ray", "--dither off",
              "--dither on", ""},
    Extension{"integrator", "global illumination: every wall lights the others", "cornell.ray",
              "--spp 36 --integrator whitted", "--spp 36", ""},
    Extension{"bdpt", "bidirectional path tracing: lamps in bowls and shades light the room", "uplight.ray",
              "--integrator path --spp 36", "--spp 36", "", "--integrator path"},
    Extension{"light-vertices", "the contribution of light sampling, one of the strategies of bdpt",
              "uplight.ray", "--spp 16", "--spp 16 --light-vertices 1", ""},
    Extension{"camera-vertices", "the contribution of light paths that are connected with the camera",
              "uplight.ray", "--spp 16", "--spp 16 --camera-vertices 1", ""},
    Extension{"unweighted", "a single strategy without its MIS weights", "uplight.ray",
              "--spp 16 --camera-vertices 1", "--spp 16 --camera-vertices 1 --unweighted on", ""},
    Extension{"mlt", "Metropolis light transport: Markov chains mutate paths that found light", "door.ray",
              "--integrator path --spp 36", "--spp 36", "", "--integrator path"},
    Extension{"chains", "Veach's mutations, which move the vertices of a path", "door.ray",
              "--chains bdpt --spp 36", "--chains veach --spp 36", ""},
    Extension{"photon", "photon maps: caustics of glass, and light between walls", "photons.ray",
              "--integrator path --spp 16", "--spp 16 --photons 300000", "", "--integrator path"},
    Extension{"final-gather", "final gathering: rays estimate indirect light from the photon map",
              "cornell.ray", "--integrator photon --spp 16 --photons 20000",
              "--integrator photon --spp 16 --photons 20000 --final-gather on", ""},
    Extension{"irradiance-cache", "indirect light is computed at few points and interpolated", "cornell.ray",
              "--integrator photon --final-gather on --spp 16",
              "--integrator photon --spp 16 --irradiance-cache 0.2", ""},
    Extension{"firefly-limit", "bright dots of rare paths are clamped, and the lost light is reported",
              "cornell.ray", "--spp 36 --firefly-limit 0", "--spp 36 --firefly-limit 2", ""},
    Extension{"ambient-occlusion", "corners and creases get less of the ambient light", "occlusion.ray",
              "--ambient-occlusion 0", "", ""},
    Extension{"smooth-terminator", "coarse meshes without hard edges where light grazes them",
              "smooth-terminator.ray", "--smooth-terminator off", "", ""},
    Extension{"caustics", "caustics: light focused by mirrors and glass", "caustics.ray", "--caustics 0", "",
              ""},
    Extension{"caustic-texels", "caustics in texture maps of surfaces, as in Arvo's method of 1986",
              "caustics.ray", "--caustics 0", "--caustic-texels 1500", ""},
    Extension{"fog", "air that scatters light: beams from a window", "fog.ray", "--fog 0", "", ""},
    Extension{"medium", "media of mist, smoke, clouds and fire: beams of the sun", "mist.ray", "--omit box",
              "", ""},
    Extension{"threshold",
              "rays with small contributions are not traced: nearly the same picture in less time",
              "threshold.ray", "--threshold 0", "--threshold 0.3", ""},
    Extension{"fresnel", "glass reflects more at grazing angles", "coloured-glass.ray", "--fresnel constant",
              "--fresnel exact", ""},
    Extension{"nested-glass", "glass objects inside and across one another", "nested-glass.ray",
              "--nested-glass off", "--nested-glass on", "", "--nested-glass off"},
    Extension{"wavelengths", "dispersion: glass refracts colours differently", "prism.ray", "--wavelengths 1",
              "", ""},
    Extension{"varnish", "opaque surfaces reflect like a clear coat", "coloured-glass.ray", "--varnish off",
              "--varnish on", ""},
    Extension{"textures", "patterns and pictures on and in objects", "textures.ray", "--textures off", "",
              ""},
    Extension{"bumps", "normals perturbed by a texture", "bumps.ray", "--textures off", "", "",
              "--switched-off bump"},
    Extension{"displacement", "points of meshes moved by a texture, which changes outlines and shadows",
              "displacement.ray", "--textures off", "", ""},
    Extension{"backdrop", "a picture behind the scene", "backdrop.ray", "--backdrop none", "", ""},
    Extension{"environment", "an environment map", "environment.ray", "--environment none", "", ""},
    Extension{"glossy", "blurred reflection and refraction of rough metal and glass", "frosted-glass.ray",
              "--glossy off", "", ""},
    Extension{"outlines", "lines around objects and along their edges", "ink.ray", "--outlines 0", "", ""},
    Extension{"thin film", "colours of soap bubbles, by the thickness of their film", "bubbles.ray",
              "--models phong", "", "", "--models phong"},
    Extension{"film on metal", "colours of anodised titanium and tempered steel", "oxide.ray",
              "--models phong", "", "", "--models phong"},
    Extension{"opacity", "holes in any material, and veils", "holes.ray", "--textures off", "", ""},
    Extension{"casts_shadow", "objects and lights that cast no shadow", "shadowless.ray",
              "--switched-off casts_shadow", "", ""},
    Extension{"frost", "a pane roughened by frost", "frost.ray", "--textures off", "", "", "--textures off"},
    Extension{"rain", "drops, and oil on a wet street", "rain.ray", "--models phong", "", "",
              "--models phong"},
    Extension{"lambert", "perfectly diffuse light, and no highlight", kModels, kPhong, "",
              BALL(258, 60, 458, 260)},
    Extension{"oren_nayar", "clay and the moon: flat, with a bright rim towards the light", kModels, kPhong,
              "", BALL(458, 60, 658, 260)},
    Extension{"cook_torrance", "highlights that move off the mirror direction at grazing angles", kModels,
              kPhong, "", BALL(658, 60, 858, 260)},
    Extension{"ward", "highlights drawn out across brushed grain", "grain.ray", kPhong, "", ""},
    Extension{"schlick", "from mirror to chalk in one number, with grain", kModels, kPhong, "",
              BALL(58, 260, 258, 460)},
    Extension{"ashikhmin_shirley", "grain, and a base that fades below the highlight", kModels, kPhong, "",
              BALL(258, 260, 458, 460)},
    Extension{"coated", "plastic: the reflection grows towards the edge", kModels, kPhong, "",
              BALL(458, 260, 658, 460)},
    Extension{"principled", "metalness, clear coat, sheen and iridescence, as in glTF", kModels, kPhong, "",
              BALL(658, 260, 858, 460)},
    Extension{"layers",
              "clear coat, sheen, grain, tint and iridescence of the principled model, and its coloured, "
              "dispersive glass",
              "principled.ray", kPhong, "", "", "--models phong"},
    Extension{"conductor", "metal in the colour of its measured indices", kModels, kPhong, "",
              BALL(858, 260, 1058, 460)},
    Extension{"velvet", "cloth with bright edges", kModels, kPhong, "", BALL(58, 460, 258, 660)},
    Extension{"hair", "highlights across strands that lie on a surface", kModels, kPhong, "",
              BALL(258, 460, 458, 660)},
    Extension{"cel", "flat steps of light with hard edges", kModels, kPhong, "", BALL(458, 460, 658, 660)},
    Extension{"gooch", "warm towards the light, cool away from it", kModels, kPhong, "",
              BALL(658, 460, 858, 660)},
    Extension{"marschner", "strands that reflect and transmit light", "strands.ray", kPhong, "", ""},
    Extension{"rough_glass", "glass whose surface blurs what is behind it", "frosted-glass.ray", kPhong, "",
              ""},
    Extension{"subsurface", "light that spreads in marble, milk, skin and jade", "subsurface.ray", kPhong, "",
              ""},
    Extension{"thin_glass", "panes that reflect more at grazing angles and do not refract", "rain.ray",
              kPhong, "", ""},
    Extension{"hatching", "strokes and dots that grow in the shade", "ink.ray", kPhong, "", ""},
};
#undef BALL

/// Names are compared in small letters, with a dash for a space or an underline.
std::string dashed(std::string_view name) {
  std::string text = lowerCase(std::string(name));
  for (char& c : text)
    if (c == ' ' || c == '_') c = '-';
  return text;
}

/// Short names of parts of scenes.
constexpr std::pair<std::string_view, std::string_view> kShortNames[] = {{"media", "medium"},
                                                                         {"spot", "spot_light"},
                                                                         {"warn", "warn_light"},
                                                                         {"ies", "goniometric_light"},
                                                                         {"projector", "projector_light"}};

/// The option of that name at its value for off; none if there is no such option.
std::vector<Choice> optionOff(std::string_view name) {
  for (const Option& option : options())
    if (option.name == name)
      return {{std::string(name), option.kind == Option::Kind::boolean ? "off" : option.get(Settings{}), {}}};
  return {};
}

std::string commandOf(const Extension& extension, std::string_view words) {
  std::string command = "ray scenes/" + std::string(extension.scene);
  if (!words.empty()) command += " " + std::string(words);
  return command;
}

std::string fileName(const Extension& extension, std::string_view which) {
  std::string name(extension.name);
  for (char& c : name)
    if (c == ' ' || c == '_') c = '-';
  return name + "-" + std::string(which) + ".jpg";
}

Picture cut(const Picture& whole, const Region& part) {
  if (part.whole()) return whole;
  Picture picture(part.x1 - part.x0, part.y1 - part.y0);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) picture.at(x, y) = whole.at(part.x0 + x, part.y0 + y);
  return picture;
}

}  // namespace

std::span<const Extension> extensions() { return kExtensions; }

std::vector<Choice> choicesIn(std::string_view words) {
  std::vector<Choice> choices;
  while (!words.empty()) {
    const std::size_t space = words.find(' '), end = words.find(' ', space + 1);
    choices.push_back(
        {std::string(words.substr(2, space - 2)), std::string(words.substr(space + 1, end - space - 1)), {}});
    words = end == words.npos ? "" : words.substr(end + 1);
  }
  return choices;
}

std::vector<std::string> namesToSwitchOff() {
  std::vector<std::string> names;
  for (const Extension& e : kExtensions) names.push_back(dashed(e.name));
  for (const std::string_view name : sceneFeatureNames()) names.push_back(dashed(name));
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<Choice> choicesWithout(std::string_view name) {
  std::string wanted = dashed(name);
  for (const auto& [brief, whole] : kShortNames)
    if (wanted == brief) wanted = dashed(whole);
  for (const Extension& e : kExtensions)
    if (dashed(e.name) == wanted && !e.switchOff.empty()) return choicesIn(e.switchOff);
  for (const std::string_view feature : sceneFeatureNames())
    if (dashed(feature) == wanted) return {{"switched-off", std::string(feature), {}}};
  for (const Extension& e : kExtensions)
    if (dashed(e.name) == wanted) return optionOff(e.name);
  const std::vector<std::string> all = namesToSwitchOff();
  const std::vector<std::string_view> names(all.begin(), all.end());
  const std::string hint = didYouMean(wanted, names);
  throw Error(Fault::usage, "expected the name of an extension, found \"" + std::string(name) + "\"",
              hint.empty() ? "ray features lists them" : hint);
}

Picture pictureOf(const Extension& extension, bool on, const std::string& scenes,
                  std::span<const Choice> more) {
  std::vector<Choice> choices = choicesIn(extension.view.empty() ? "--width 240" : extension.view);
  for (const Choice& choice : choicesIn(on ? extension.on : extension.off)) choices.push_back(choice);
  choices.insert(choices.end(), more.begin(), more.end());
  Session session;
  session.open(scenes + "/" + std::string(extension.scene), choices);
  session.build();
  session.renderPicture();
  const Settings& settings = session.settings();
  const Picture shown = developed(finished(session.picture(), settings), developmentOf(settings));
  return cut(shown, settings.region);
}

std::string extensionsMarkdown() {
  std::string text =
      "# Extensions\n\nMade by `./dev features` from the table in src/app/compare/extensions.cpp; do not "
      "edit.\n\nThis page shows the extensions of Trace beyond the ray tracer of the courses: each example "
      "without it, with it, and the difference of the two pictures. In `SBT-raytracer` files all are off "
      "unless "
      "the scene or the command line asks for them; `Trace 1` files use some by default. Shading models are "
      "compared with the closest Blinn-Phong approximation "
      "(`--models phong`).\n\n`--without NAME` switches any of them off, also one that the scene asks for: "
      "`--without aperture`, `--without thin-film`. Parts of scenes have names, too: `--without media`, "
      "`spot`, `warn`, "
      "`ies`, `projector`, `bump`, `displacement`, `opacity` and `casts_shadow`, and each shading model "
      "alone. The lights "
      "become point lights at "
      "their place, the shading models Phong's closest approximation.\n";
  for (const Extension& e : kExtensions) {
    text += "\n## " + std::string(e.name) + "\n\n" + std::string(e.adds) + ".\n\n";
    for (const std::string_view which : {"off", "on", "difference"})
      text += "![" + std::string(which) + "](" + fileName(e, which) + ")\n";
    text += "\n    " + commandOf(e, e.off) + "\n    " + commandOf(e, e.on) + "\n";
  }
  return text;
}

void writeExtensionPictures(const std::string& scenes, const std::string& folder,
                            const std::function<void(std::string_view)>& told) {
  for (const Extension& e : kExtensions) {
    if (told) told(e.name);
    const auto write = [&](std::string_view which, const Picture& picture) {
      writePicture(folder + "/" + fileName(e, which), picture);
    };
    const auto levels = [](const Picture& picture) {
      return LoadedPicture{fromBytes(toBytes(picture, Rounding::truncate))};
    };
    const Picture off = pictureOf(e, false, scenes), on = pictureOf(e, true, scenes);
    const PictureDifference d =
        difference(levels(off), levels(on), {.pixelsPerDegree = usualPixelsPerDegree()});
    write("off", off);
    write("on", on);
    write("difference", shows().front().picture(d.pictures(), 2));
  }
}

}  // namespace trace

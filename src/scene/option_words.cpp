#include "scene/option_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <string>

#include "base/field.h"
#include "shading/cameras/camera.h"

namespace trace {
namespace {

struct Row {
  std::string_view option, words;
};

/// In small letters, each once.
constexpr std::array kWordRows{
    Row{"width", "size resolution"},
    Row{"height", "size resolution"},
    Row{"region", "crop part window rectangle"},
    Row{"spp",
        "antialias antialiasing aliasing samples sampling supersampling jaggies smooth quality aa rays"},
    Row{"time", "animation frame"},
    Row{"sampling", "noise random jitter stochastic distribution montecarlo sampler"},
    Row{"integrator", "path tracing global illumination bounced indirect radiosity light transport kajiya"},
    Row{"firefly-limit", "clamp fireflies dots noise hot pixels indirect"},
    Row{"noise-target", "adaptive supersampling error grain variance threshold"},
    Row{"subdivide", "adaptive supersampling antialias antialiasing recursive whitted corners jaggies"},
    Row{"subdivide-threshold", "adaptive supersampling antialias antialiasing contrast"},
    Row{"jpeg-quality", "jpg compression compress size file"},
    Row{"denoise", "noise grain filter smooth clean denoiser denoising"},
    Row{"shutter", "motion blur moving speed exposure time streak"},
    Row{"moments", "motion blur steps time"},
    Row{"lamp-samples", "emissive area light soft shadows glow luminous mesh image based lighting"},
    Row{"ambient-occlusion", "ao corners creases dirt soft sky dome ambient"},
    Row{"occlusion-reach", "ao distance"},
    Row{"smooth-terminator", "shadow facets polygons low poly lowpoly coarse mesh normals artifact"},
    Row{"irradiance-cache", "photon map interpolation radiance ward noise blotches smooth faster"},
    Row{"caustics", "photon map mapping glass light focus concentrated"},
    Row{"caustic-texels", "illumination map backward ray tracing light texture arvo"},
    Row{"caustic-radius", "photon map gather blur"},
    Row{"fog", "mist haze smoke dust volume volumetric god rays beams medium atmosphere"},
    Row{"fog-color", "mist haze smoke albedo colour"},
    Row{"fog-height", "mist ground layer"},
    Row{"fog-forward", "phase anisotropy henyey greenstein"},
    Row{"fog-samples", "noise steps march volume"},
    Row{"medium-depth", "volume volumetric scattering bounces cloud smoke"},
    Row{"subsurface-samples", "sss skin marble milk wax translucent noise"},
    Row{"seed", "noise random"},
    Row{"filter", "reconstruction sharp"},
    Row{"filter-radius", "reconstruction"},
    Row{"light-samples", "soft shadow shadows noise area penumbra"},
    Row{"light-choices", "many lights tree noise speed importance"},
    Row{"aperture", "lens dof depth of field bokeh blur fstop pinhole"},
    Row{"focus", "lens dof depth of field focal sharp distance"},
    Row{"focus-on", "lens dof focal sharp object target point name"},
    Row{"blades", "lens bokeh"},
    Row{"blade-angle", "lens bokeh"},
    Row{"aperture-picture", "lens bokeh shape image heart star"},
    Row{"depth", "bounce bounces recursion reflections levels black glass dark"},
    Row{"transfer", "gamma srgb"},
    Row{"quality", "preview fast draft final preset"},
    Row{"threshold", "adaptive cutoff speed"},
    Row{"glossy", "blurry rough frosted reflection noise"},
    Row{"models", "shading brdf bsdf material blinn"},
    Row{"textures", "pictures bump pattern"},
    Row{"outlines", "cartoon cel toon silhouette edges lines ink"},
    Row{"omit", "hide exclude"},
    Row{"switched-off", "without extension"},
    Row{"backdrop", "background image plate picture wallpaper"},
    Row{"environment", "background image sky skybox cubemap hdri panorama reflection map"},
    Row{"environment-kind", "cubemap equirectangular probe cross"},
    Row{"environment-rotation", "turn rotate"},
    Row{"environment-brightness", "exposure intensity"},
    Row{"environment-blur", "filter rough"},
    Row{"like", "course university dialect compatibility year"},
    Row{"highlight", "specular shiny"},
    Row{"shininess-scale", "exponent"},
    Row{"mirror-default", "reflection"},
    Row{"limit-attenuation", "falloff"},
    Row{"glass", "transparency beer"},
    Row{"air-index", "ior vacuum"},
    Row{"glass-shadows", "shadow shadows transparency"},
    Row{"back-faces", "backface culling"},
    Row{"vertex-normals", "smooth interpolation"},
    Row{"pixel-position", "centre jitter offset"},
    Row{"tone", "exposure brightness"},
    Row{"rounding", "quantize"},
    Row{"alpha", "transparent transparency background compositing"},
    Row{"passes", "aov layers buffers exr cryptomatte mattes light groups motion vectors"},
    Row{"threads", "cores processors parallel speed"},
    Row{"accel", "acceleration speed"},
    Row{"time-limit", "timeout seconds"},
    Row{"max-memory", "ram"},
};

/// Least values that are no quantity.
constexpr std::array kLeastWordRows{
    Row{"height", "auto"},           Row{"noise-target", "off"},    Row{"subdivide", "off"},
    Row{"filter-radius", "auto"},    Row{"light-choices", "auto"},  Row{"threshold", "off"},
    Row{"firefly-limit", "off"},     Row{"light-vertices", "all"},  Row{"camera-vertices", "all"},
    Row{"ambient-occlusion", "off"}, Row{"occlusion-reach", "any"}, Row{"irradiance-cache", "off"},
    Row{"caustics", "off"},          Row{"caustic-radius", "auto"}, Row{"caustic-texels", "off"},
    Row{"outlines", "off"},          Row{"view-height", "auto"},    Row{"eye-separation", "auto"},
    Row{"zero-parallax", "auto"},    Row{"focus", "auto"},          Row{"white-balance", "off"},
    Row{"pass-far", "auto"},         Row{"threads", "all"},         Row{"time-limit", "none"},
    Row{"checkpoint-every", "off"},  Row{"max-memory", "auto"},     Row{"bloom", "off"},
};

/// In small letters, with spaces for hyphens.
std::string plain(std::string_view text) {
  std::string all(text);
  for (char& c : all) c = c == '-' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return all;
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (end > 0) words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

}  // namespace

std::string_view wordsFor(const Option& option) {
  for (const Row& row : kWordRows)
    if (row.option == option.name) return row.words;
  return "";
}

std::string_view leastWordFor(const Option& option) {
  for (const Row& row : kLeastWordRows)
    if (row.option == option.name) return row.words;
  return "";
}

std::string_view cameraFieldMeant(std::string_view words) {
  constexpr std::string_view kZoom[] = {"zoom", "field of view", "angle", "view angle", "focal length"};
  const std::string wanted = plain(words);
  if (std::find(std::begin(kZoom), std::end(kZoom), wanted) != std::end(kZoom)) return "fov";
  std::string_view found;
  forEachField<Camera>([&](const auto& field) {
    if (field.keyword == wanted) found = field.keyword;
  });
  return found;
}

bool isAbout(const Option& option, std::string_view text) {
  std::string all;
  for (const std::string_view part : {option.name, option.group, option.help, wordsFor(option)})
    all += std::string(part) + " ";
  for (const std::string_view choice : option.choices) all += std::string(choice) + " ";
  all = plain(all);
  const std::string wanted = plain(text);
  const std::vector<std::string_view> words = split(wanted);
  return std::all_of(words.begin(), words.end(),
                     [&](std::string_view word) { return all.find(word) != std::string::npos; });
}

int relevance(const Option& option, std::string_view text) {
  const std::string name = plain(option.name), wanted = plain(text), others = plain(wordsFor(option));
  const auto holds = [](const std::vector<std::string_view>& all, std::string_view word) {
    return std::find(all.begin(), all.end(), word) != all.end();
  };
  const std::vector<std::string_view> meant = split(others), named = split(name);
  int least = 3;
  for (const std::string_view word : split(wanted)) {
    const bool chosen = std::find(option.choices.begin(), option.choices.end(), word) != option.choices.end();
    const bool best = name.starts_with(word) || holds(meant, word);
    least = std::min(least, best ? 3 : chosen || holds(named, word) ? 2 : 1);
  }
  return least;
}

std::vector<std::string_view> optionsMeant(std::string_view word) {
  std::vector<std::string_view> names;
  const std::string wanted = plain(word);
  for (const Option& option : options()) {
    const std::vector<std::string_view> words = split(wordsFor(option));
    if (std::find(words.begin(), words.end(), wanted) != words.end()) names.push_back(option.name);
  }
  return names;
}

}  // namespace trace

// Metals by measured indices, or, where there are none, by what they mirror along the normal: titanium,
// chromium, iron and platinum as in Akenine-Moller and others, Real-Time Rendering, 4th ed., table 9.2. All
// other colours were chosen by eye.
#include "shading/library.h"

#include <array>
#include <string>
#include <utility>

#include "base/text.h"
#include "shading/materials/coated.h"
#include "shading/materials/conductor.h"
#include "shading/materials/oren_nayar.h"
#include "shading/materials/principled.h"
#include "shading/materials/subsurface.h"
#include "shading/materials/velvet.h"
#include "shading/optics/substances.h"
#include "shading/textures/brick.h"
#include "shading/textures/clouds.h"
#include "shading/textures/granite.h"
#include "shading/textures/marble.h"
#include "shading/textures/mix.h"
#include "shading/textures/noise.h"
#include "shading/textures/wood.h"

namespace trace {
namespace {

constexpr Real kPolished = 0.15, kSatin = 0.35, kRough = 0.6;

// --- parts --------------------------------------------------------------------------------------------

Material metal(Metal kind, Real roughness, Real anisotropy = 0) {
  Conductor model;
  model.metal = kind;
  model.color = Color(1);
  model.roughness = roughness;
  model.anisotropy = anisotropy;
  return {"", model, {}};
}
Material metal(const Color& color, Real roughness, Real anisotropy = 0) {
  Conductor model;
  model.color = color;
  model.roughness = roughness;
  model.anisotropy = anisotropy;
  return {"", model, {}};
}

/// Below a clear layer.
Material glazed(const Color& color, Real roughness, Real index = 1.5) {
  Coated model;
  model.diffuse = model.ambient = color;
  model.roughness = roughness;
  model.index = index;
  return {"", model, {}};
}
Material matt(const Color& color, Real roughness) {
  OrenNayar model;
  model.diffuse = model.ambient = color;
  model.roughness = roughness;
  return {"", model, {}};
}

/// The colours are those of the texture.
Material with(Material material, TextureNode texture) {
  bool isDiffuse = false;
  forEachField(material.model, [&](const ModelField& f, const auto&) { isDiffuse |= f.keyword == kDiffuse; });
  if (isDiffuse) changeColors(material.model, {kDiffuse, kAmbient}, [](const Color&) { return Color(1); });
  const Texture shared = std::move(texture);
  setTexture(material.textures, kDiffuse, shared);
  setTexture(material.textures, kAmbient, shared);
  return material;
}

TextureNode placed(TextureModel model, const Vec3& scale, const Vec3& rotate = {},
                   const Vec3& translate = {}) {
  return {.model = std::move(model), .placement = {.scale = scale, .rotate = rotate, .translate = translate}};
}

template <class Pattern>
Pattern from(const Color& a, const Color& b) {
  Pattern pattern;
  pattern.a = a;
  pattern.b = b;
  return pattern;
}

TextureNode veins(const Color& stone, const Color& vein, Real bent = 1.5) {
  Marble marble;
  marble.ramp = {{0, stone.r, stone.g, stone.b},
                 {0.62, stone.r, stone.g, stone.b},
                 {0.93, vein.r, vein.g, vein.b},
                 {1, vein.r, vein.g, vein.b}};
  marble.turbulence = bent;
  return placed(std::move(marble), Vec3{1.3, 1.3, 1.3}, {20, 30, 40});
}
TextureNode grains(const Color& dark, const Color& light, Real contrast = 2) {
  Granite granite = from<Granite>(dark, light);
  granite.contrast = contrast;
  return placed(std::move(granite), Vec3{0.35, 0.35, 0.35});
}
TextureNode layers(const Color& a, const Color& b, Real frequency) {
  Marble marble = from<Marble>(a, b);
  marble.frequency = frequency;
  marble.turbulence = 1;
  marble.sum = SumKind::fractal;
  return placed(std::move(marble), Vec3{1, 1, 1}, {0, 0, 90});
}
/// A board cut along the grain, beside the axis of the tree.
TextureNode board(const Color& early, const Color& late, Real frequency, Real fibres, Real bent = 0.6) {
  Wood wood = from<Wood>(early, late);
  wood.frequency = frequency;
  wood.fibres = fibres;
  wood.turbulence = bent;
  return placed(std::move(wood), Vec3{1, 1, 1}, {4, 87, 0}, {0, -0.35, 0.5});
}

/// Iron whose rust is no metal.
Material rusty() {
  Principled model;
  model.metallic = model.roughness = 1;
  model.color = Color(1);
  model.ambient = Color(0.4);
  Material material{"", model, {}};
  Noise patches;
  patches.octaves = 6;
  patches.ramp = {{0, 1, 1, 1}, {0.45, 1, 1, 1}, {0.55, 0, 0, 0}, {1, 0, 0, 0}};
  const Texture bare = placed(patches, Vec3{0.5, 0.5, 0.5});
  Noise rust = from<Noise>({0.32, 0.11, 0.04}, {0.55, 0.25, 0.09});
  rust.octaves = 5;
  TextureNode color{.model = Mix{.a = Color(1), .b = Color(0.56, 0.57, 0.58), .amount = 1}};
  setTexture(color.inputs, "a", placed(std::move(rust), Vec3{0.12, 0.12, 0.12}));
  setTexture(color.inputs, "amount", bare);
  const Texture colors = std::move(color);
  TextureNode roughness{.model = Mix{.a = Color(0.9), .b = Color(0.4), .amount = 1}};
  setTexture(roughness.inputs, "amount", bare);
  setTexture(material.textures, kColor, colors);
  setTexture(material.textures, kAmbient, colors);
  setTexture(material.textures, "metallic", bare);
  setTexture(material.textures, "roughness", std::move(roughness));
  return material;
}

Material masonry() {
  Brick brick;
  return with(matt(Color(1), 0.5), placed(std::move(brick), Vec3{0.6, 0.6, 0.6}, {}, {0, 0, 0.1}));
}

Material cloth(const Color& base, const Color& sheen, Real roughness) {
  Velvet model;
  model.diffuse = model.ambient = base;
  model.sheen = sheen;
  model.roughness = roughness;
  return {"", model, {}};
}

// --- the table ----------------------------------------------------------------------------------------

constexpr std::array kFinishes{
    Finish{"silver", "metal", "polished", [] { return metal(Metal::silver, kPolished); }},
    Finish{"gold", "metal", "polished", [] { return metal(Metal::gold, kPolished); }},
    Finish{"copper", "metal", "polished", [] { return metal(Metal::copper, kPolished); }},
    Finish{"brass", "metal", "polished", [] { return metal(Metal::brass, kPolished); }},
    Finish{"aluminium", "metal", "satin", [] { return metal(Metal::aluminium, kSatin); }},
    Finish{"brushed aluminium", "metal", "brushed along u",
           [] { return metal(Metal::aluminium, kSatin, 0.9); }},
    Finish{"brushed brass", "metal", "brushed along u", [] { return metal(Metal::brass, kSatin, 0.9); }},
    Finish{"old copper", "metal", "rough", [] { return metal(Metal::copper, kRough); }},
    Finish{"chromium", "metal", "a mirror", [] { return metal(Color(0.549, 0.556, 0.554), 0); }},
    Finish{"platinum", "metal", "polished", [] { return metal(Color(0.673, 0.637, 0.585), kPolished); }},
    Finish{"titanium", "metal", "satin", [] { return metal(Color(0.542, 0.497, 0.449), kSatin); }},
    Finish{"iron", "metal", "cast", [] { return metal(Color(0.562, 0.565, 0.578), kRough); }},
    Finish{"steel", "metal", "satin", [] { return metal(Color(0.6, 0.6, 0.6), kSatin); }},
    Finish{"bronze", "metal", "satin", [] { return metal(Color(0.714, 0.428, 0.181), kSatin); }},
    Finish{"lead", "metal", "dull", [] { return metal(Color(0.43, 0.43, 0.45), kRough); }},
    Finish{"rusty iron", "metal", "bare metal and rust in patches", rusty},

    Finish{"white marble", "stone", "polished, grey veins",
           [] {
             return with(glazed(Color(1), 0.1), veins({0.93, 0.92, 0.9}, {0.42, 0.42, 0.46}));
           }},
    Finish{"black marble", "stone", "polished, white veins",
           [] {
             return with(glazed(Color(1), 0.1), veins({0.03, 0.03, 0.035}, {0.75, 0.73, 0.7}, 2));
           }},
    Finish{"green marble", "stone", "polished, pale veins",
           [] {
             return with(glazed(Color(1), 0.1), veins({0.06, 0.2, 0.12}, {0.5, 0.68, 0.55}, 2));
           }},
    Finish{"red marble", "stone", "polished, white veins",
           [] {
             return with(glazed(Color(1), 0.1), veins({0.45, 0.13, 0.09}, {0.85, 0.72, 0.66}, 2));
           }},
    Finish{"grey granite", "stone", "polished",
           [] {
             return with(glazed(Color(1), 0.12), grains({0.12, 0.12, 0.13}, {0.78, 0.77, 0.76}));
           }},
    Finish{"red granite", "stone", "polished",
           [] {
             return with(glazed(Color(1), 0.12), grains({0.1, 0.06, 0.06}, {0.76, 0.42, 0.36}));
           }},
    Finish{"black granite", "stone", "polished",
           [] {
             return with(glazed(Color(1), 0.12), grains({0.015, 0.015, 0.02}, {0.28, 0.28, 0.3}, 2.5));
           }},
    Finish{"malachite", "stone", "polished, bands of green",
           [] {
             return with(glazed(Color(1), 0.1), layers({0.02, 0.22, 0.13}, {0.2, 0.62, 0.42}, 4));
           }},
    Finish{"lapis lazuli", "stone", "polished, blue with light flecks",
           [] {
             return with(glazed(Color(1), 0.1), grains({0.02, 0.05, 0.28}, {0.3, 0.4, 0.72}, 1.6));
           }},
    Finish{"nephrite", "stone", "polished, clouded green",
           [] {
             return with(glazed(Color(1), 0.2, 1.66),
                         placed(from<Clouds>({0.12, 0.42, 0.26}, {0.45, 0.68, 0.5}), Vec3{0.6, 0.6, 0.6}));
           }},
    Finish{"sandstone", "stone", "rough, in layers",
           [] {
             return with(matt(Color(1), 0.6), layers({0.76, 0.6, 0.42}, {0.62, 0.42, 0.26}, 3));
           }},
    Finish{"slate", "stone", "rough, dark",
           [] {
             return with(matt(Color(1), 0.5), layers({0.16, 0.18, 0.2}, {0.24, 0.26, 0.28}, 7));
           }},
    Finish{"limestone", "stone", "rough, pale",
           [] {
             return with(matt(Color(1), 0.6), grains({0.66, 0.62, 0.54}, {0.84, 0.81, 0.74}, 1));
           }},
    Finish{"concrete", "stone", "rough, grey",
           [] {
             return with(matt(Color(1), 0.6), grains({0.38, 0.38, 0.37}, {0.58, 0.58, 0.56}, 1));
           }},
    Finish{"brickwork", "stone", "bricks and mortar", masonry},

    Finish{"oak", "wood", "varnished, coarse rings",
           [] {
             return with(glazed(Color(1), 0.3), board({0.66, 0.45, 0.24}, {0.4, 0.22, 0.09}, 9, 0.35));
           }},
    Finish{"pine", "wood", "varnished, pale",
           [] {
             return with(glazed(Color(1), 0.3), board({0.86, 0.68, 0.42}, {0.62, 0.38, 0.16}, 7, 0.12));
           }},
    Finish{"beech", "wood", "varnished, even",
           [] {
             return with(glazed(Color(1), 0.3), board({0.78, 0.55, 0.36}, {0.66, 0.42, 0.25}, 16, 0.3));
           }},
    Finish{"cherry", "wood", "varnished, reddish",
           [] {
             return with(glazed(Color(1), 0.25), board({0.55, 0.27, 0.14}, {0.36, 0.14, 0.06}, 10, 0.2));
           }},
    Finish{"walnut", "wood", "varnished, dark",
           [] {
             return with(glazed(Color(1), 0.25), board({0.22, 0.125, 0.07}, {0.08, 0.042, 0.025}, 9, 0.3, 1));
           }},
    Finish{"mahogany", "wood", "polished, red-brown",
           [] {
             return with(glazed(Color(1), 0.1), board({0.23, 0.08, 0.04}, {0.11, 0.032, 0.016}, 8, 0.5, 1.4));
           }},
    Finish{"ebony", "wood", "polished, nearly black",
           [] {
             return with(glazed(Color(1), 0.1), board({0.05, 0.04, 0.035}, {0.015, 0.012, 0.01}, 14, 0.4));
           }},
    Finish{"raw pine", "wood", "unvarnished",
           [] {
             return with(matt(Color(1), 0.4), board({0.88, 0.72, 0.48}, {0.66, 0.43, 0.21}, 7, 0.15));
           }},

    Finish{"white plastic", "plastic", "shiny", [] { return glazed(Color(0.85), 0.2); }},
    Finish{"black plastic", "plastic", "shiny", [] { return glazed(Color(0.02), 0.2); }},
    Finish{"red plastic", "plastic", "shiny", [] { return glazed(Color(0.65, 0.03, 0.02), 0.2); }},
    Finish{"green plastic", "plastic", "shiny", [] { return glazed(Color(0.05, 0.42, 0.08), 0.2); }},
    Finish{"blue plastic", "plastic", "shiny", [] { return glazed(Color(0.03, 0.1, 0.55), 0.2); }},
    Finish{"yellow plastic", "plastic", "shiny", [] { return glazed(Color(0.85, 0.6, 0.03), 0.2); }},
    Finish{"bakelite", "plastic", "brown, polished",
           [] { return glazed(Color(0.13, 0.04, 0.015), 0.1, 1.63); }},
    Finish{"rubber", "plastic", "black, dull", [] { return glazed(Color(0.03), 0.7, 1.52); }},
    Finish{"porcelain", "plastic", "white, glazed", [] { return glazed(Color(0.88, 0.87, 0.84), 0, 1.5); }},

    Finish{"red velvet", "cloth", "dark, with bright edges",
           [] {
             return cloth({0.18, 0.005, 0.01}, {0.85, 0.15, 0.15}, 0.4);
           }},
    Finish{"blue velvet", "cloth", "dark, with bright edges",
           [] {
             return cloth({0.005, 0.01, 0.14}, {0.2, 0.3, 0.85}, 0.4);
           }},
    Finish{"felt", "cloth", "grey",
           [] {
             return cloth({0.3, 0.3, 0.31}, {0.35, 0.35, 0.35}, 0.7);
           }},

    Finish{"chalk", "matt", "white", [] { return matt(Color(0.92, 0.92, 0.9), 0.4); }},
    Finish{"plaster", "matt", "white", [] { return matt(Color(0.82, 0.8, 0.76), 0.5); }},
    Finish{"clay", "matt", "reddish", [] { return matt(Color(0.6, 0.31, 0.19), 0.6); }},
    Finish{"paper", "matt", "white", [] { return matt(Color(0.86, 0.86, 0.84), 0.2); }},
    Finish{"soot", "matt", "as black as it gets", [] { return matt(Color(0.03), 0.3); }},
};

/// Clear, polished, with a highlight.
Material clear(const Substance& substance) {
  Phong model;
  model.specular = Color(0.5);
  model.shininess = 300;
  model.transmissive = Color(1);
  model.index = substance.index;
  model.dispersion = substance.dispersion;
  model.abbe = substance.abbe;
  model.attenuationColor = substance.color;
  return {"", model, {}};
}

/// Light spreads in it.
Material body(const Translucent& translucent) {
  Subsurface model;
  model.scatters = translucent.scatters;
  model.absorbs = translucent.absorbs;
  model.index = translucent.index;
  model.roughness = translucent.roughness;
  return {"", model, {}};
}

}  // namespace

std::span<const Finish> finishes() { return kFinishes; }

std::optional<Material> libraryMaterial(std::string_view name) {
  const auto named = [&](Material material) {
    material.name = name;
    return material;
  };
  for (const Substance& substance : substances())
    if (substance.name == name) return named(clear(substance));
  for (const Translucent& translucent : translucents())
    if (translucent.name == name) return named(body(translucent));
  for (const Finish& finish : kFinishes)
    if (finish.name == name) return named(finish.make());
  return {};
}

std::vector<std::string_view> libraryNames() {
  std::vector<std::string_view> names;
  for (const Substance& substance : substances()) names.push_back(substance.name);
  for (const Translucent& translucent : translucents()) names.push_back(translucent.name);
  for (const Finish& finish : kFinishes) names.push_back(finish.name);
  return names;
}

std::string nearInLibrary(std::string_view name) {
  constexpr int kMost = 5;
  const std::vector<std::string_view> names = libraryNames();
  if (std::string meant = didYouMean(name, names); !meant.empty()) return meant;
  const std::string_view word = name.substr(name.rfind(' ') + 1);  // "marble" of "carrara marble"
  std::string hint;
  int found = 0;
  for (const std::string_view other : names)
    if (other.substr(other.rfind(' ') + 1) == word && found++ < kMost)
      hint += (hint.empty() ? "it has \"" : ", \"") + std::string(other) + "\"";
  return hint;
}

}  // namespace trace

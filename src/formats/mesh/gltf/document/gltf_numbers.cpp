// Sources: Khronos Group, glTF 2.0 Specification, section 3.9, and its extensions.
#include "formats/mesh/gltf/document/gltf_numbers.h"

#include <algorithm>
#include <cmath>

namespace trace {
namespace {

using namespace gltf_extension;

struct GltfNumbers {
  /// From 0 to 1.
  static double share(double x) { return x >= 0 ? std::min(x, 1.0) : 0.0; }

  /// A number of an extension that is finite and at least `least`.
  static double number(const tinygltf::Material& from, const char* name, const char* field, double otherwise,
                       double least = 0) {
    const double x = extension(from.extensions, name, field, otherwise);
    return std::isfinite(x) && x >= least ? x : otherwise;
  }
  static Color color(const tinygltf::Material& from, const char* name, const char* field,
                     const Color& otherwise) {
    return colorOf(extensionList(from.extensions, name, field, 3), otherwise);
  }

  static void readBase(const tinygltf::Material& from, MetallicRoughness& m) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    m.baseColor = colorOf(pbr.baseColorFactor, Color(1));
    if (pbr.baseColorFactor.size() == 4) m.opacity = share(pbr.baseColorFactor[3]);
    m.metallic = share(pbr.metallicFactor);
    m.roughness = share(pbr.roughnessFactor);
    if (from.extensions.contains(kGlossiness)) {
      m.baseColor = color(from, kGlossiness, "diffuseFactor", Color(1));
      const std::vector<double> diffuse = extensionList(from.extensions, kGlossiness, "diffuseFactor", 4);
      m.opacity = diffuse.empty() ? 1 : share(diffuse[3]);
      m.metallic = 0;
      m.roughness = 1 - share(number(from, kGlossiness, "glossinessFactor", 1));
      m.glossy = color(from, kGlossiness, "specularFactor", Color(1));
    }
    m.emissive = colorOf(from.emissiveFactor, Color()) *
                 number(from, "KHR_materials_emissive_strength", "emissiveStrength", 1);
    m.alpha = from.alphaMode == "BLEND"  ? MetallicRoughness::Alpha::blend
              : from.alphaMode == "MASK" ? MetallicRoughness::Alpha::mask
                                         : MetallicRoughness::Alpha::opaque;
    m.cutoff = from.alphaCutoff;
  }

  static void readLayers(const tinygltf::Material& from, MetallicRoughness& m) {
    m.iridescence = share(number(from, kIridescence, "iridescenceFactor", 0));
    m.filmIndex = number(from, kIridescence, "iridescenceIor", 1.3, 1);
    m.filmMost = std::min(5000.0, number(from, kIridescence, "iridescenceThicknessMaximum", 400));
    m.filmLeast = std::min(m.filmMost, number(from, kIridescence, "iridescenceThicknessMinimum", 100));
    m.clearcoat = share(number(from, kClearcoat, "clearcoatFactor", 0));
    m.clearcoatRoughness = share(number(from, kClearcoat, "clearcoatRoughnessFactor", 0));
    m.sheen = color(from, kSheen, "sheenColorFactor", Color());
    m.sheenRoughness = share(number(from, kSheen, "sheenRoughnessFactor", 0));
    m.anisotropy = share(number(from, kAnisotropy, "anisotropyStrength", 0));
    m.anisotropyAngle = number(from, kAnisotropy, "anisotropyRotation", 0, -kNoLimit);
    m.specular = share(number(from, kSpecular, "specularFactor", 1));
    m.specularColor = color(from, kSpecular, "specularColorFactor", Color(1));
  }

  static void readPassage(const tinygltf::Material& from, MetallicRoughness& m) {
    m.transmission = share(number(from, kTransmission, "transmissionFactor", 0));
    m.index = number(from, "KHR_materials_ior", "ior", 1.5);
    if (m.index == 0) m.index = 1.5;
    m.solid = number(from, kVolume, "thicknessFactor", 0) > 0;
    m.attenuationColor = color(from, kVolume, "attenuationColor", Color(1));
    m.attenuationDistance = number(from, kVolume, "attenuationDistance", 0);
    const double dispersion = number(from, "KHR_materials_dispersion", "dispersion", 0);
    m.abbe = dispersion > 0 ? 20 / dispersion : 0;
  }
};

}  // namespace

void readNumbers(const tinygltf::Material& from, MetallicRoughness& m) {
  GltfNumbers::readBase(from, m);
  GltfNumbers::readLayers(from, m);
  GltfNumbers::readPassage(from, m);
  m.doubleSided = from.doubleSided;
  m.unlit = from.extensions.contains("KHR_materials_unlit");
}

}  // namespace trace

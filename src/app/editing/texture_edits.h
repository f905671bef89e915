// Edits by hand of the texture of a field, in the studio.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"
#include "shading/texture.h"

namespace trace {

/// A row of the list of textures, as a menu shows it.
struct TextureKind {
  std::string_view keyword, help;
};
std::vector<TextureKind> textureKindsToChoose();

/// A texture of that kind. What `before` is, if any, it keeps as far as it has such fields: numbers, textures
/// in them, and how it lies. Precondition: there is such a kind.
Texture textureOfKind(std::string_view keyword, const Texture* before = nullptr);

/// The field is a plain value again.
void removeTexture(std::vector<FieldTexture>& textures, std::string_view field);

/// Why a field of the texture changes nothing as things are; "" if it counts.
std::string whyIdle(const TextureModel& model, std::string_view field);

/// Has the scene files named since it was read, pictures or photometries?
bool lacksFiles(const Scene& scene);

/// Reads them. Throws Error(Fault::scene) if one cannot be read; `messages` gets what is odd about the
/// others.
void readLackingFiles(Scene& scene, Messages& messages);

}  // namespace trace

// Widgets for a field that a texture may stand in: the field, a button that gives it a texture, and the
// texture below it, with its kind, its fields and the textures in them, however deep.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "shading/texture.h"
#include "studio/widgets/field_editor.h"

namespace trace::studio {

using TextureChanged = std::function<void(const std::string& what)>;

/// The button, and the rows of the texture if the field has one; calls changed(what) after a change.
void editTextureOf(std::string_view field, std::vector<FieldTexture>& textures,
                   const TextureChanged& changed);

/// A row of a table with buttons: the field, which scales its texture. Calls changed(what).
template <class Field, class Value>
void editTexturedField(const Field& field, Value& value, std::vector<FieldTexture>& textures,
                       const TextureChanged& changed) {
  editField(field, value, [&](std::string_view keyword) { changed(std::string(keyword)); });
  if constexpr (std::is_same_v<Value, Real> || std::is_same_v<Value, Color>) {
    const bool had = textureOf(textures, field.keyword) != nullptr;
    editTextureOf(field.keyword, textures, [&](const std::string& what) {
      if (!had && value == Value{}) value = Value(1);  // else nothing would be seen of it
      changed(what);
    });
  }
}

}  // namespace trace::studio

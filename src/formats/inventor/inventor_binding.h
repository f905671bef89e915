// Which normal, material and texture coordinate of a list belongs to a corner of a face.
#pragma once

#include <string_view>
#include <vector>

#include "formats/inventor/inventor_shapes.h"

namespace trace::inventor {

struct Binding {
  enum class By { nothing, all, part, face, order, point, slot } by = By::nothing;
  const std::vector<double>* indices = nullptr;  ///< if given, the place in the list is looked up here

  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  /// The place in the list, for a corner of a face; kNowhere if it has none.
  std::size_t operator()(const Outline& outline, std::size_t face, std::size_t corner) const;
};

struct Bindings {
  Binding normal, material, uv;
};

/// By a word of Inventor and VRML 1.0 such as PER_FACE_INDEXED. `own` is the shape's list of indices for it,
/// which must outlive the binding; `otherwise` holds without a word.
Binding bindingOf(std::string_view word, Binding::By otherwise, const std::vector<double>& own, bool indexed);

/// VRML97: by corner or by face, through a list of indices or without.
Binding bindingOf(bool byCorner, const std::vector<double>& own);

}  // namespace trace::inventor

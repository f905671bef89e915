// A picture with a title, to be clicked: on the start page, and among the things that a scene may get.
#pragma once

#include <imgui.h>

#include <string>

#include "studio/widgets/texture.h"

namespace trace::studio {

/// Draws one whose picture has that size, as much of it as fills the card; true when it is pressed. `id` is
/// its own in the window.
bool drawCard(const std::string& id, const std::string& title, const Texture* picture, ImVec2 size);
/// The height of a card whose picture is so high.
float cardHeight(float picture);

/// How many cards, each at least so wide, stand side by side, and how wide each is.
struct CardRow {
  int count = 1;
  float width = 1;
};
CardRow cardsAcross(float least, int most);

}  // namespace trace::studio

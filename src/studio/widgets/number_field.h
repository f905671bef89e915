// Numbers and text that a person drags or types. What is dragged shows at once; what is typed counts on
// Enter, or when the field is left, and Esc restores the old one (app/editing/typed_value.h).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/editing/short_number.h"

namespace trace::studio {

struct NumberLook {
  double least, most;        ///< bounds of dragging; of typing too, if it is `clamped`
  std::string format;        ///< format of printf for double: "%.0f" and so on for whole numbers
  float speed = 0;           ///< for each pixel that it is dragged; 0: a slider
  bool logarithmic = false;  ///< the slider
  bool clamped = true;
  std::string_view name{};  ///< for remarks
  NumberWords words{};      ///< shown, and accepted, in place of numbers
  bool counted = false;     ///< buttons for one more and one less, where they have room
};

/// The text after the number: " rays", of one " ray"; "" without a unit.
std::string unitAfter(std::string_view unit, double number);

// Each draws the widget, as wide as ImGui::SetNextItemWidth() says, and returns true when the value has
// changed.
bool editNumber(const char* id, double& value, const NumberLook& look);
bool editNumber(const char* id, int& value, const NumberLook& look);
/// Several in a row, over the rest of the line.
bool editNumbersInRow(double* values, int count, const NumberLook& look);
/// Typed text that was not taken as it is, since the last call: `depth: expected 0 to 100, found 500`.
std::vector<std::string> takeRemarks();
/// One more.
void remarkOn(std::string what);
/// `hint` is shown where there is no text.
bool editText(const char* id, std::string& value, const char* hint = "");

}  // namespace trace::studio

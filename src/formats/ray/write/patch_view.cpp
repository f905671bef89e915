#include "formats/ray/write/patch_view.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "formats/ray/language/language.h"
#include "formats/ray/read/settings.h"
#include "formats/ray/write/patch.h"
#include "formats/ray/write/same.h"
#include "formats/text_front.h"

namespace trace::rayfile {
namespace {

/// The blocks `name { ... }` at the top of the file.
std::vector<Item> blocksOf(const Syntax& syntax, std::string_view name) {
  std::vector<Item> blocks;
  for (const Item item : syntax.root())
    if (item.is(Kind::call) && item.key() == name && item.value().is(Kind::block))
      blocks.push_back(item.value());
  return blocks;
}

std::string fieldText(std::string_view key, const std::string& value) {
  return std::string(key) + " = " + value;
}

// --- camera ---------------------------------------------------------------------------------------------

/// As it is if it looks at the point, which `look_at` says.
bool looksAt(const Camera& camera, const Item& target) {
  Real n[3];
  return numbers(target, n, 3) && normalize(Vec3{n[0], n[1], n[2]} - camera.position) == camera.viewdir;
}

/// From now on viewdir and updir give the view instead of `look_at` and `quaternian`.
void changeDirections(TextEdits& edits, const Item& block, const Camera& from, const Camera& to) {
  const std::optional<Item> target = fieldOf(block, "look_at"), turn = fieldOf(block, "quaternian");
  const bool targetStays = target && looksAt(to, target->value());
  const bool turns = !(from.viewdir == to.viewdir) && !targetStays, tilts = !(from.updir == to.updir);
  if (!turns && !(tilts && !targetStays) && !tilts) return;
  std::vector<std::string> more;
  const auto say = [&](std::string_view key, const Vec3& value) {
    if (const std::optional<Item> field = fieldOf(block, key))
      edits.change(field->value(), written(value, 0));
    else
      more.push_back(fieldText(key, written(value, 0)));
  };
  if (!targetStays) say("viewdir", to.viewdir);
  say("updir", to.updir);
  std::string joined;
  for (const std::string& field : more) joined += (joined.empty() ? "" : "; ") + field;
  const std::optional<Item>& replaced = target && !targetStays ? target : turn;
  if (replaced && !joined.empty()) return edits.replace(*replaced, joined);
  if (target && !targetStays) edits.erase(*target);
  for (const std::string& field : more) edits.addField(block, field);
}

void changeCamera(TextEdits& edits, const Camera& from, const Camera& to) {
  if (from == to) return;
  const std::vector<Item> blocks = blocksOf(edits.syntax(), Camera::kKeyword);
  if (blocks.empty()) {
    std::string text = std::string(Camera::kKeyword) + " {";
    forEachField<Camera>([&](const auto& f) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(to.*f.member)>, Real>)
        if (to.*f.member == kNoLimit) return;
      text += " " + fieldText(f.keyword, written(to.*f.member, 0)) + ";";
    });
    return edits.addOnTop(text + " }");
  }
  const Item& block = blocks.back();  // the last counts
  changeDirections(edits, block, from, to);
  Camera was = from;
  was.viewdir = to.viewdir;
  was.updir = to.updir;  // they are settled
  if (const std::optional<Item> wide = fieldOf(block, "horizontal_fov"); wide && was.fov != to.fov) {
    was.fov = to.fov;
    edits.replace(*wide, fieldText("fov", written(to.fov, 0)));
  }
  changeFields(edits, block, was, to);
}

// --- background -----------------------------------------------------------------------------------------

void changeBackground(TextEdits& edits, const Background& from, const Background& to) {
  if (from == to) return;
  const std::vector<Item> blocks = blocksOf(edits.syntax(), Background::kKeyword);
  if (blocks.empty()) {
    std::string text = std::string(Background::kKeyword) + " {";
    forEachField<Background>([&](const auto& f) {
      if (to.*f.member != Background{}.*f.member)
        text += " " + fieldText(f.keyword, written(to.*f.member, 0)) + ";";
    });
    return edits.addOnTop(text + " }");
  }
  const Item& block = blocks.back();
  std::vector<Item> single;  // colours of bands of one colour each
  bool list = false;
  for (const Item item : block) {
    if (!item.keyed()) continue;
    if (canonical(item.key()) == "color") single.push_back(item);
    if (item.key() == "colors") list = true;
  }
  if (from.colors != to.colors && !single.empty()) {
    if (!list && single.size() == to.colors.size()) {
      for (std::size_t i = 0; i < single.size(); ++i)
        edits.change(single[i].value(), written(to.colors[i], 0));
    } else {
      for (const Item& item : single) edits.erase(item);
      if (list) edits.change(fieldOf(block, "colors")->value(), written(to.colors, 0));
      if (!list && !to.colors.empty()) edits.addField(block, fieldText("colors", written(to.colors, 0)));
    }
    Background colored = from;
    colored.colors = to.colors;
    return changeFields(edits, block, colored, to);
  }
  changeFields(edits, block, from, to);
}

// --- settings -------------------------------------------------------------------------------------------

class SettingsChange {
 public:
  SettingsChange(TextEdits& edits, const Scene& from, const Scene& to)
      : edits_(edits),
        folder_(std::filesystem::absolute(from.file.empty() ? "." : from.file).parent_path()),
        blocks_(blocksOf(edits.syntax(), kSettings)),
        choices_(from.choices),
        wanted_(to.choices),
        to_(resolve({to.choices})) {}

  void run() {
    change(findOption("like"));
    for (const Option& option : options())
      if (option.repeats != Repeats::nothing) change(option);
    if (!lines_.empty()) edits_.addOnTop(std::string(kSettings) + " {" + lines_ + " }");
  }

 private:
  /// A file below the scene's folder goes where that goes.
  std::string seenFromScene(const std::string& file) const {
    const std::filesystem::path below =
        std::filesystem::path(file).lexically_relative(folder_.lexically_normal());
    return below.empty() || *below.begin() == ".." ? file : below.generic_string();
  }
  void change(const Option& option) {
    const bool isNamedAnew =
        to_.quality != Quality::none && names(wanted_, option.name) && !names(choices_, option.name);
    if (!isNamedAnew && sameValue(option, resolve({choices_}), to_)) return;
    std::string value = option.get(to_);
    if (option.kind == Option::Kind::file && value != "none")
      value = std::filesystem::absolute(value).lexically_normal().generic_string();
    choices_.push_back({std::string(option.name), value, {}});
    if (option.kind == Option::Kind::file && value != "none") value = seenFromScene(value);
    std::optional<Item> field;
    for (const Item& block : blocks_)
      for (const Item item : block)
        if (item.keyed() && item.key() == option.name) field.emplace(item);
    if (field)
      edits_.replace(field->value(), writtenChoice(value));
    else if (!blocks_.empty())
      edits_.addField(blocks_.back(), fieldText(option.name, writtenChoice(value)));
    else
      lines_ += " " + fieldText(option.name, writtenChoice(value)) + ";";
  }

  TextEdits& edits_;
  std::filesystem::path folder_;  // folder of the scene
  std::vector<Item> blocks_;
  std::vector<Choice> choices_;  ///< choices in the text so far
  const std::vector<Choice>& wanted_;
  Settings to_;
  std::string lines_;
};

}  // namespace

void changeView(TextEdits& edits, const Scene& from, const Scene& to) {
  changeCamera(edits, from.camera, to.camera);
  changeBackground(edits, from.background, to.background);
  SettingsChange(edits, from, to).run();
}

}  // namespace trace::rayfile

namespace trace {

std::optional<Vec3> lookAtIn(const std::string& file, std::string_view bytes, Real time) {
  const TextFront front(file, bytes);
  if (front.text().find("look_at") == std::string_view::npos) return {};  // the look is cheap, the syntax not
  rayfile::Syntax syntax(file, front.text());
  SceneTime moment(time);
  InputFiles inputs;
  rayfile::settle(syntax, moment, inputs);
  syntax.throwMistakes();
  const std::vector<rayfile::Item> blocks = rayfile::blocksOf(syntax, Camera::kKeyword);
  if (blocks.empty()) return {};
  const std::optional<rayfile::Item> field = rayfile::fieldOf(blocks.back(), "look_at");
  Real n[3];
  if (!field || !rayfile::numbers(field->value(), n, 3)) return {};
  return Vec3{n[0], n[1], n[2]};
}

}  // namespace trace

#include "studio/scene/additions_popup.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "app/editing/placing.h"
#include "app/editing/scene_changes.h"
#include "app/editing/texture_edits.h"
#include "app/view/space/scene_model.h"
#include "formats/ray/write/transform.h"
#include "geometry/mesh/tessellate.h"
#include "render/world/hit.h"
#include "scene/picture_size.h"
#include "shading/library.h"
#include "studio/scene/selection.h"
#include "studio/studio.h"
#include "studio/widgets/card.h"
#include "studio/widgets/field_editor.h"
#include "studio/widgets/landmarks.h"

namespace trace::studio {
namespace {

constexpr int kSide = 120;  // pixels of a preview

using Selected = Studio::Selected;

Material newMaterial() {
  Phong grey;
  grey.diffuse = grey.ambient = Color(0.7);
  return {"", grey, {}};
}

/// The surface in the middle of the picture.
struct Middle {
  CameraFrame camera;
  std::optional<SurfacePoint> there;
  Real ahead;  ///< the distance to the middle of all, for where nothing is
};
Middle middleOf(const Session& session) {
  const World& world = session.world();
  const Ray ray = world.camera().ray({0.5, 0.5});
  Middle middle{frame(cameraFor(session.scene(), session.settings()), session.settings().cameraAxes), {}, 5};
  Statistics statistics;
  if (const auto found = world.closest(ray, Faces::both, statistics))
    middle.there = Hit(world, ray, *found).surface;
  const Box3 all = frameOf(session.scene());
  if (!all.empty()) middle.ahead = std::max(length(all.center() - middle.camera.eye), 1e-30);
  return middle;
}

constexpr Box3 kEverywhere{{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};

/// On what the camera looks at, and in no other object.
Affine inSight(const Studio& studio, const Shape& shape) {
  const auto session = studio.workspace.render.session();
  if (!session) return {};
  const Middle middle = middleOf(*session);
  const Vec3& updir = session->scene().camera.updir;
  const Affine turn = upright(shape.type(), updir);
  const Box3 own = drawnBounds(shape, kEverywhere);
  const Box3 bounds = own.empty() || own.unbounded() ? own : turn * own;
  const std::vector<Box3> others = boxesOf(studio.workspace.document.scene());
  const auto lookAt = [&](const Vec2& place) -> std::optional<SeenObject> {
    const World& world = session->world();
    const Ray ray = middle.camera.ray(place);
    Statistics statistics;
    const auto found = world.closest(ray, Faces::both, statistics);
    if (!found) return {};
    const std::vector<Object>& objects = session->scene().objects;
    return SeenObject{Hit(world, ray, *found).surface,
                      found->object < objects.size() ? boxOf(objects[found->object]) : Box3{}};
  };
  if (!bounds.empty() && !bounds.unbounded())
    if (const auto placed = placedAmong(bounds, middle.camera, updir, others, lookAt)) return *placed * turn;
  const Affine first = placedInSight(bounds, middle.camera, updir, middle.there, middle.ahead);
  if (bounds.empty() || bounds.unbounded()) return first * turn;
  const Vec3 down = letDown(first * bounds, updir, [&](const Ray& ray) -> std::optional<Real> {
    Statistics statistics;
    const auto found = session->world().closest(ray, Faces::both, statistics);
    return found ? std::optional(found->t) : std::nullopt;
  });
  const Affine placed = Affine::translation(down) * first;
  return Affine::translation(freedFrom(others, placed * bounds, middle.camera, updir)) * placed * turn;
}

/// Above and to the left of what the camera looks at, or less far where something is in between.
void shineOnMiddle(const Studio& studio, Light& light) {
  const auto session = studio.workspace.render.session();
  const Camera& camera = studio.workspace.document.scene().camera;
  if (!session) return aimLight(light, camera.position, camera.position + camera.viewdir);
  const Middle middle = middleOf(*session);
  const Vec3 target =
      middle.there ? middle.there->point : middle.camera.eye + normalize(middle.camera.look) * middle.ahead;
  const Vec3 away = placeOfLight(middle.camera, camera.updir, target) - target;
  constexpr Real kStart = 0.02, kBefore = 0.8;  // shares of the way
  const Ray ray{target + away * kStart, away};
  Statistics statistics;
  const auto found = session->world().closest(ray, Faces::both, statistics);
  aimLight(light, target + away * (found && found->t < 1 ? kBefore * found->t : 1), target);
}

/// Shaded from the sides that the scene's others are: from both in files of the kind `Trace 1`.
void addMaterial(Scene& scene, Material material) {
  if (!scene.materials.empty()) material.sides = scene.materials.front().sides;
  scene.materials.push_back(std::move(material));
}

/// The scene's material of that name, or the library's, which the scene gets.
std::size_t materialCalled(Scene& scene, const std::string& name) {
  const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                  [&](const Material& material) { return material.name == name; });
  const auto index = static_cast<std::size_t>(found - scene.materials.begin());
  if (found != scene.materials.end()) return index;
  Material material = libraryMaterial(name).value_or(newMaterial());
  material.name = name;
  addMaterial(scene, std::move(material));
  return index;
}

/// The material of the object or the material that is selected, if one is.
std::optional<std::size_t> selectedMaterial(const Studio& studio, const Scene& scene) {
  const std::size_t index = studio.selectedIndex;
  if (studio.selected == Selected::material && index < scene.materials.size()) return index;
  if (studio.selected == Selected::object && index < scene.objects.size() &&
      scene.objects[index].material < scene.materials.size())
    return scene.objects[index].material;
  return {};
}

/// The field that gives the material its colour; "" if it has none.
std::string_view colourField(const MaterialModel& model) {
  std::string_view found;
  forEachField(model, [&](const ModelField& field, const auto&) {
    if (field.keyword == kDiffuse || field.keyword == kColor) found = field.keyword;
  });
  return found;
}

/// On the colour of the selected material. Where others use it too, the object gets its own.
void addTexture(Studio& studio, const std::string& kind) {
  Scene scene = studio.workspace.document.scene();
  std::optional<std::size_t> material = selectedMaterial(studio, scene);
  if (!material) return studio.refuse("no texture was added: select an object or a material first");
  const bool shared = usersOf(scene, static_cast<std::uint32_t>(*material)) > 1;
  if (studio.selected == Selected::object && shared) {
    Material own = scene.materials[*material];
    own.name.clear();
    scene.materials.push_back(std::move(own));
    material = scene.materials.size() - 1;
    scene.objects[studio.selectedIndex].material = static_cast<std::uint32_t>(*material);
  }
  Material& now = scene.materials[*material];
  const std::string_view field = colourField(now.model);
  if (field.empty()) return studio.refuse("no texture was added: the material has no colour");
  const trace::Texture* before = textureOf(now.textures, field);
  if (!before)  // black would hide it
    changeColors(now.model, {field}, [](const Color& c) { return c == Color(0) ? Color(1) : c; });
  setTexture(now.textures, field, textureOfKind(kind, before));
  studio.workspace.edit("add " + kind, std::move(scene));
}

/// As one step; then it is selected. A material goes to the selected object, if there is one.
void add(Studio& studio, const Addition& addition) {
  if (addition.kind == Addition::Kind::texture) return addTexture(studio, std::string(addition.name));
  Scene scene = studio.workspace.document.scene();
  const std::string name(addition.name);
  Selected kind = Selected::object;
  std::size_t index = 0;
  switch (addition.kind) {
    case Addition::Kind::shape: {
      addMaterial(scene, newMaterial());  // its own: others keep their colours
      const auto own = static_cast<std::uint32_t>(scene.materials.size() - 1);
      Shape shape(rowCalled<ShapeType>(name));
      constexpr int kDigits = 5;
      const Affine placed = rayfile::inShortNumbers(inSight(studio, shape), kDigits);
      scene.objects.push_back({"", std::move(shape), placed, own, {}});
      index = scene.objects.size() - 1;
      break;
    }
    case Addition::Kind::light: {
      Light added(rowCalled<LightType>(name));
      shineOnMiddle(studio, added);
      scene.lights.push_back({std::move(added), {}});
      kind = Selected::light;
      index = scene.lights.size() - 1;
      break;
    }
    case Addition::Kind::material: {
      index = materialCalled(scene, name);
      const bool given = studio.selected == Selected::object && studio.selectedIndex < scene.objects.size();
      if (given)
        scene.objects[studio.selectedIndex].material = static_cast<std::uint32_t>(index);
      else
        kind = Selected::material;
      if (given) index = studio.selectedIndex;
      break;
    }
    case Addition::Kind::texture: return;
  }
  const std::size_t told = studio.workspace.log().size();
  studio.workspace.edit("add " + name, std::move(scene));
  if (studio.workspace.log().size() > told) studio.mention("Log");
  if (index < howMany(studio.workspace.document.scene(), kind)) studio.select(kind, index);
}

std::string keyOf(const Addition& addition) {
  return std::to_string(static_cast<int>(addition.kind)) + std::string(addition.name);
}

/// Their pictures, as far as the words ask for them; the one that was pressed, and the one under the cursor.
struct Cards {
  const Addition* pressed = nullptr;
  const Addition* over = nullptr;
  const Addition* first = nullptr;
};
Cards drawCards(Studio& studio, const std::vector<Addition>& all, const char* words) {
  Cards cards;
  constexpr int kMostAcross = 8;
  const CardRow row = cardsAcross(characters(14), kMostAcross);
  int shown = 0;
  for (const Addition& each : all) {
    if (!isAbout(each, words)) continue;
    if (!cards.first) cards.first = &each;
    if (shown++ % row.count != 0) ImGui::SameLine();
    const ImVec2 size{row.width, std::round(row.width * 0.8f)};
    const bool inSight = ImGui::IsRectVisible({size.x, cardHeight(size.y)});
    const std::string name(each.name);
    if (drawCard(name, name, inSight ? studio.previews.of(each) : nullptr, size)) cards.pressed = &each;
    landmark("add " + name);
    if (ImGui::IsItemHovered() || ImGui::IsItemFocused()) cards.over = &each;
  }
  if (shown == 0) ImGui::TextDisabled("none of that name");
  return cards;
}

}  // namespace

const Texture* Previews::of(const Addition& addition) {
  const auto found = made_.find(keyOf(addition));
  if (found != made_.end()) return found->second.get();
  if (!task_.pending())
    task_.start([addition](const Cancelled&) { return Made{keyOf(addition), preview(addition, kSide)}; });
  return nullptr;
}

void Previews::update() {
  auto made = task_.take();
  if (!made) return;
  std::unique_ptr<Texture>& texture = made_[made->name];
  texture = std::make_unique<Texture>();
  if (made->bytes.width > 0) texture->set(made->bytes);
}

void drawAdditions(Studio& studio) {
  static char words[64] = "";
  if (ImGui::Button("Add...")) ImGui::OpenPopup("add");
  landmark("add");
  const ImVec2 window = ImGui::GetMainViewport()->WorkSize;
  ImGui::SetNextWindowSize({std::min(characters(96), window.x * 0.7f), window.y * 0.75f});
  if (!ImGui::BeginPopup("add")) return;
  studio.previews.update();
  if (ImGui::IsWindowAppearing()) {
    words[0] = 0;
    ImGui::SetKeyboardFocusHere();
  }
  ImGui::SetNextItemWidth(-1);
  const bool entered = ImGui::InputTextWithHint("##find", "find a shape, a light, a material or a texture",
                                                words, sizeof words, ImGuiInputTextFlags_EnterReturnsTrue);
  landmark("find an addition");
  static const std::pair<const char*, std::vector<Addition>> kSections[] = {
      {"Objects", additions(Addition::Kind::shape)},
      {"Lights", additions(Addition::Kind::light)},
      {"Materials of the library", additions(Addition::Kind::material)},
      {"Textures, for the colour of what is selected", additions(Addition::Kind::texture)}};
  ImGui::BeginChild("cards", {0, -ImGui::GetTextLineHeightWithSpacing()}, false,
                    ImGuiWindowFlags_NavFlattened);
  Cards cards;
  for (const auto& [title, list] : kSections) {
    ImGui::TextUnformatted(title);
    ImGui::Separator();
    const Cards some = drawCards(studio, list, words);
    if (some.pressed) cards.pressed = some.pressed;
    if (some.over) cards.over = some.over;
    if (!cards.first) cards.first = some.first;
    ImGui::Spacing();
  }
  ImGui::EndChild();
  const std::string help = !cards.first ? "nothing of that name"
                           : !cards.over
                               ? "a new object stands on what the picture shows, near its middle"
                               : std::string(cards.over->name) + ": " + std::string(cards.over->help);
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  rowName(help);
  ImGui::PopStyleColor();
  if (entered && words[0]) cards.pressed = cards.first;
  if (cards.pressed) {
    add(studio, *cards.pressed);
    ImGui::CloseCurrentPopup();
  }
  ImGui::EndPopup();
}

}  // namespace trace::studio

#include "app/texture_edits.h"

#include <any>
#include <memory>
#include <utility>

#include "base/error.h"
#include "formats/ies.h"
#include "formats/textures.h"

namespace trace {
namespace {

/// Calls visit(file) with each photometry of the scene.
template <class AScene, class Visit>
void eachPhotometry(AScene& scene, const Visit& visit) {
  for (auto& source : scene.lights)
    match(source.light, [&](auto& light) {
      if constexpr (requires { light.file.data; }) visit(light.file);
    });
}

bool lacksPicture(const Pixels& pixels) { return !pixels.map && !pixels.file.empty(); }

/// The picture files that a texture lacks, or one in it.
bool lacksPicture(const Texture& texture) {
  const bool own = match(texture->model, [](const auto& model) {
    if constexpr (requires { model.file.map; }) return lacksPicture(model.file);
    return false;
  });
  if (own) return true;
  for (const FieldTexture& input : texture->inputs)
    if (lacksPicture(input.texture)) return true;
  return false;
}

/// The part of a texture that is shown right after it was chosen.
template <class Model>
Model newModel() {
  Model model;
  if constexpr (std::is_same_v<Model, Formula>) model.value = FormulaText("0.5 + 0.5 * sin(6 * x)");
  return model;
}

template <class Model>
void keepFields(Model& to, const TextureModel& from) {
  match(from, [&]<class Other>(const Other& other) {
    forEachField<Other>([&](const auto& was) {
      const auto& value = other.*was.member;
      using Value = std::remove_cvref_t<decltype(value)>;
      if (value == Other{}.*was.member) return;  // another kind may have another default
      forEachField<Model>([&](const auto& field) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(to.*field.member)>, Value>)
          if (field.keyword == was.keyword) to.*field.member = value;
      });
    });
  });
}

template <class Model>
bool takesTexture(std::string_view keyword) {
  bool takes = false;
  forEachField<Model>([&](const auto& field) {
    using Value = std::remove_cvref_t<decltype(std::declval<Model&>().*field.member)>;
    takes |= (std::is_same_v<Value, Real> || std::is_same_v<Value, Color>)&&field.keyword == keyword;
  });
  return takes;
}

}  // namespace

std::vector<TextureKind> textureKindsToChoose() {
  std::vector<TextureKind> kinds;
  forEachType<TextureModel>([&]<class Model>(Model*) { kinds.push_back({Model::kKeyword, Model::kHelp}); });
  return kinds;
}

Texture textureOfKind(std::string_view keyword, const Texture* before) {
  TextureNode node;
  if (before) node = TextureNode{{}, {}, (*before)->placement, (*before)->inputs};
  forEachType<TextureModel>([&]<class Model>(Model*) {
    if (Model::kKeyword != keyword) return;
    Model model = newModel<Model>();
    if (before) keepFields(model, (*before)->model);
    node.model = std::move(model);
    std::erase_if(node.inputs, [](const FieldTexture& input) { return !takesTexture<Model>(input.field); });
  });
  return node;
}

void removeTexture(std::vector<FieldTexture>& textures, std::string_view field) {
  std::erase_if(textures, [&](const FieldTexture& t) { return t.field == field; });
}

std::string whyIdle(const TextureModel& model, std::string_view field) {
  return match(model, [&](const auto& m) -> std::string {
    const bool isColor = field == "a" || field == "b";
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(m)>, Formula>) {
      const bool colored = isColor || field == "ramp";
      if (colored && m.value.text().empty()) return "value is empty";
      if (!colored && field != "value" && !m.value.text().empty()) return "value counts instead";
    }
    if constexpr (requires { m.ramp; })
      if (isColor && !m.ramp.empty()) return "ramp counts instead";
    return "";
  });
}

bool lacksFiles(const Scene& scene) {
  bool lacks = false;
  for (const Material& material : scene.materials)
    for (const FieldTexture& t : material.textures) lacks |= lacksPicture(t.texture);
  for (const LightSource& source : scene.lights)
    match(source.light, [&](const auto& light) {
      if constexpr (requires { light.file.map; }) lacks |= lacksPicture(light.file);
    });
  const Background& b = scene.background;
  for (const Pixels* face : {&b.front, &b.back, &b.left, &b.right, &b.top, &b.bottom})
    lacks |= lacksPicture(*face);
  eachPhotometry(scene, [&](const PhotometryFile& file) { lacks |= !file.data && !file.file.empty(); });
  return lacks;
}

void readLackingFiles(Scene& scene) {
  Messages messages;
  loadTextures(scene, messages);
  if (!messages.all().empty()) {
    const Message& first = messages.all().front();
    throw Error(Fault::scene, first.what);
  }
  eachPhotometry(scene, [&](PhotometryFile& file) {
    if (file.data || file.file.empty()) return;
    const std::string path = pictureFile(scene.file, file.file);
    file.data =
        std::make_shared<const Photometry>(readIes(path, readBeside("", path, scene.inputs), messages));
  });
}

}  // namespace trace

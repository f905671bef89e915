#include "app/editing/texture_edits.h"

#include <memory>
#include <utility>

#include "base/error.h"
#include "formats/ies.h"
#include "formats/textures.h"
#include "shading/textures/formula.h"

namespace trace {
namespace {

bool lacksFile(const Pixels& pixels) { return !pixels.map && !pixels.file.empty(); }
bool lacksFile(const PhotometryFile& file) { return !file.data && !file.file.empty(); }

/// A picture or a photometric file.
bool lacksFile(const Light& light) {
  bool lacks = false;
  forEachField(light, [&]<class Value>(const LightField&, const Value& value) {
    if constexpr (requires { lacksFile(value); }) lacks |= lacksFile(value);
  });
  return lacks;
}

/// A picture of the texture, or of one in it.
bool lacksFile(const Texture& texture) {
  bool own = false;
  forEachField(texture->model, [&]<class Value>(const TextureField&, const Value& value) {
    if constexpr (std::is_same_v<Value, Pixels>) own |= lacksFile(value);
  });
  if (own) return true;
  for (const FieldTexture& input : texture->inputs)
    if (lacksFile(input.texture)) return true;
  return false;
}

/// The texture that is shown right after a kind was chosen.
TextureModel newModel(const TextureType& type) {
  TextureModel model(type);
  if (Formula* formula = model.edit<Formula>()) formula->value = FormulaText("0.5 + 0.5 * sin(6 * x)");
  return model;
}

bool takesTexture(const TextureModel& model, std::string_view keyword) {
  bool takes = false;
  forEachField(model, [&]<class Value>(const TextureField& field, const Value&) {
    takes |= (std::is_same_v<Value, Real> || std::is_same_v<Value, Color>)&&field.keyword == keyword;
  });
  return takes;
}

}  // namespace

std::vector<TextureKind> textureKindsToChoose() {
  std::vector<TextureKind> kinds;
  for (const TextureType& type : textureTypes()) kinds.push_back({type.keyword, type.help});
  return kinds;
}

Texture textureOfKind(std::string_view keyword, const Texture* before) {
  TextureNode node{.model = newModel(rowCalled<TextureType>(keyword))};
  if (!before) return node;
  node.placement = (*before)->placement;
  node.inputs = (*before)->inputs;
  takeChangedFields(node.model, (*before)->model);
  std::erase_if(node.inputs,
                [&](const FieldTexture& input) { return !takesTexture(node.model, input.field); });
  return node;
}

void removeTexture(std::vector<FieldTexture>& textures, std::string_view field) {
  std::erase_if(textures, [&](const FieldTexture& t) { return t.field == field; });
}

std::string whyIdle(const TextureModel& model, std::string_view field) {
  const bool isColor = field == "a" || field == "b";
  if (const Formula* formula = model.as<Formula>()) {
    const bool colored = isColor || field == "ramp";
    if (colored && formula->value.text().empty()) return "value is empty";
    if (!colored && field != "value" && !formula->value.text().empty()) return "value counts instead";
  }
  bool hasRamp = false;
  forEachField(model, [&]<class Value>(const TextureField& f, const Value& value) {
    if constexpr (std::is_same_v<Value, ColorRamp>) hasRamp |= f.keyword == "ramp" && !value.empty();
  });
  return isColor && hasRamp ? "ramp counts instead" : "";
}

bool lacksFiles(const Scene& scene) {
  bool lacks = false;
  for (const Material& material : scene.materials)
    for (const FieldTexture& t : material.textures) lacks |= lacksFile(t.texture);
  for (const LightSource& source : scene.lights) lacks |= lacksFile(source.light);
  const Background& b = scene.background;
  for (const Pixels* face : {&b.front, &b.back, &b.left, &b.right, &b.top, &b.bottom})
    lacks |= lacksFile(*face);
  return lacks;
}

void readLackingFiles(Scene& scene, Messages& messages) {
  if (!loadTextures(scene, messages)) throw Error(Fault::scene, messages.all().back().what);
  const auto readPhotometry = [&](PhotometryFile& file) {
    if (!lacksFile(file)) return;
    const std::string path = pictureFile(scene.file, file.file);
    file.data =
        std::make_shared<const Photometry>(readIes(path, readBeside("", path, scene.inputs), messages));
  };
  for (LightSource& source : scene.lights)
    editEachField(source.light, [&]<class Value>(const LightField&, Value& value) {
      if constexpr (std::is_same_v<Value, PhotometryFile>) readPhotometry(value);
    });
}

}  // namespace trace

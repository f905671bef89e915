// ray texture: a texture as a picture, to be looked at or used as a texture file; without -o, its fields;
// alone, the list of all.
//
// The picture shows u and v, and x and y at z = 0, from (0, 0) at the bottom left.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/budget.h"
#include "base/files/file.h"
#include "base/parallel.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "formats/ray/file/format.h"
#include "formats/ray/read/fields.h"
#include "formats/text_front.h"
#include "image/codecs/codec.h"
#include "shading/texture.h"

namespace trace::cli {
namespace {

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(text.size() + 2, width), ' ');
  return text;
}

std::string kindsText() {
  std::string text =
      "textures: ray texture NAME lists the fields of one, with -o OUT it is written as a picture\n";
  for (const TextureType& type : textureTypes())
    text += padded("  " + std::string(type.keyword), 14) + std::string(type.help) + "\n";
  return text;
}

std::string fieldsText(const TextureType& type) {
  std::string text = std::string(type.keyword) + ": " + std::string(type.help) + "\n";
  const auto row = [&](const auto& f, const auto& standard) {
    const std::string value = rayfile::written(standard, 6);
    text += padded("  " + std::string(f.keyword), 16) + padded(value.empty() ? "\"\"" : value, 24) +
            std::string(f.help) + "\n";
  };
  forEachField(TextureModel(type), row);
  forEachField(TexturePlacement{}, row);
  return text;
}

/// The file docs/texture-fields.md.
std::string fieldsMarkdown() {
  std::string text =
      "# Fields of textures\n\nMade by `ray texture --markdown`. [textures.md](textures.md) describes how to "
      "use textures. All have `name`, `scale`, `rotate` and\n`translate` too. Another texture may replace "
      "any colour or number.\n";
  for (const TextureType& type : textureTypes()) {
    text += "\n## " + std::string(type.keyword) + "\n\n" + std::string(type.help) +
            ".\n\n| field | default | what |\n|---|---|---|\n";
    forEachField(TextureModel(type), [&](const TextureField& f, const auto& value) {
      text += "| `" + std::string(f.keyword) + "` | " + rayfile::written(value, 6) + " | " +
              std::string(f.help) + " |\n";
    });
  }
  return text;
}

/// One of that kind, in u and v if it can lie there.
Texture ofKind(const std::string& keyword) {
  if (const TextureType* type = findTextureType(keyword)) {
    TextureModel model(*type);
    editEachField(model, [](const TextureField& f, auto& value) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, EnumValue>)
        if (f.keyword == "space") value.set(static_cast<std::size_t>(TextureSpace::uv));
    });
    return TextureNode{.model = std::move(model)};
  }
  std::vector<std::string_view> kinds;
  for (const TextureType& type : textureTypes()) kinds.push_back(type.keyword);
  std::string all;
  for (const std::string_view kind : kinds) all += (all.empty() ? "" : ", ") + std::string(kind);
  std::string hint = didYouMean(keyword, kinds);
  if (hint.empty()) hint = "a texture of a scene is named as in floor.ray:stone";
  throw Error(Fault::usage, "ray texture: expected " + all + " or SCENE:NAME, found \"" + keyword + "\"",
              std::move(hint));
}

Texture ofScene(const std::string& file, const std::string& name, const Console& console) {
  const Work work("reading the textures");
  const std::string bytes = readFile(file);
  if (!recognisesRay(TextFront(file, bytes).text()))
    throw Error(Fault::scene, SourcePlace{.file = file},
                "expected a .ray file, which has textures with names");
  Messages messages;
  const std::vector<Texture> textures = readNamedTextures(file, bytes, messages);
  for (const Message& message : messages.all())
    if (message.place.line > 0) console.warnings({&message, 1});  // not that there is nothing else to see
  std::vector<std::string_view> names;
  for (const Texture& texture : textures) {
    if (texture->name == name) return texture;
    names.push_back(texture->name);
  }
  throw Error(Fault::usage, "ray texture: there is no texture \"" + name + "\" in " + file,
              names.empty() ? "it has none with a name, as in texture = marble { name = stone; }"
                            : didYouMean(name, names));
}

/// `across`: how many steps the picture is wide.
Picture pictureOf(const Texture& texture, int width, int height, Real across) {
  Picture picture(width, height);
  const Real step = across / width;
  const Work work("drawing the texture", height);
  Job job;
  parallelChunks(height, 0, job, [&](std::int64_t row, int) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < width; ++x) {
      checkBudget();
      const Vec2 at{(x + 0.5) * step, (height - y - 0.5) * step};
      picture.at(x, y) = texture.at({.point = {at.x, at.y, 0},
                                     .uv = at,
                                     .uvX = {step, 0},
                                     .uvY = {0, step},
                                     .pointX = {step, 0, 0},
                                     .pointY = {0, step, 0}});
    }
  });
  return picture;
}

}  // namespace

int textureCommand(const Arguments& arguments, const Console& console) {
  if (arguments.files.empty() && arguments.output.empty()) {
    printResult(arguments.markdown ? fieldsMarkdown() : kindsText());
    return kDone;
  }
  if (arguments.files.size() != 1)
    throw Error(Fault::usage,
                "ray texture: expected one texture, found " + std::to_string(arguments.files.size()));
  const auto [width, height] = arguments.size.value_or(std::array{256, 256});
  if (!arguments.output.empty()) checkEncodable(pictureFormatFor(arguments.output), width, height);
  const std::string& named = arguments.files.front();
  const std::size_t colon = named.rfind(':');
  const bool inScene = colon != std::string::npos;
  if (inScene) checkDistinct(named.substr(0, colon), arguments.output);
  if (!arguments.output.empty()) checkWritable(arguments.output);
  const Texture texture =
      inScene ? ofScene(named.substr(0, colon), named.substr(colon + 1), console) : ofKind(named);
  if (arguments.output.empty()) {
    printResult(fieldsText(texture->model.type()));
    return kDone;
  }
  const Picture picture = pictureOf(texture, width, height, arguments.across.value_or(inScene ? 1 : 4));
  writePicture(arguments.output, picture, Rounding::nearest);
  return kDone;
}

}  // namespace trace::cli

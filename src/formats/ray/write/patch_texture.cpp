#include "formats/ray/write/patch_texture.h"

#include <algorithm>
#include <optional>
#include <type_traits>
#include <utility>

#include "formats/ray/read/student_textures.h"
#include "formats/ray/read/texture.h"

namespace trace::rayfile {
namespace {

/// `KIND { ... }` of `value`, which may stand in `texture(KIND { ... }, constant)`.
std::optional<Item> callOf(const Item& value) {
  if (!value.is(Kind::call)) return {};
  if (value.key() != kTexture) return value;
  if (!value.value().is(Kind::tuple) || value.value().count() == 0) return {};
  const Item first = *value.value().begin();
  return first.is(Kind::call) ? std::optional(first) : std::nullopt;
}

/// Does the block say the model in its own words, all of which are known?
bool isPlain(const Item& call, const TextureModel& model) {
  if (textureKeyword(call.key()) != model.keyword() || !call.value().is(Kind::block)) return false;
  const std::vector<std::string_view> known = keywords(model, {"name", "scale", "rotate", "translate"});
  for (const Item field : call.value())
    if (!field.keyed() || std::find(known.begin(), known.end(), canonical(field.key())) == known.end())
      return false;
  return true;
}

std::string indentIn(const TextEdits& edits, const Item& block) {
  return std::string(edits.indentAt(block.offset())) + "    ";
}

/// A field that has a texture, or had one.
template <class Value>
void changeInput(TextEdits& edits, const Item& block, std::string_view keyword, const Texture* was,
                 const Value& from, const Texture* is, const Value& to) {
  const std::optional<Item> field = fieldOf(block, keyword);
  const std::string before = written(from, 0), now = written(to, 0);
  if (field && was && is && changeTexture(edits, field->value(), *was, before, *is, now)) return;
  sayField(edits, block, keyword, is ? laidOut(textured(*is, to, 0), indentIn(edits, block)) : now);
}

/// Precondition: they are of one type.
void changeBlock(TextEdits& edits, const Item& block, const TextureNode& was, const TextureNode& is) {
  if (was.name != is.name)
    sayField(edits, block, "name", is.name.empty() ? std::string() : written(is.name, 0));
  const std::vector<TextureField> from = was.model.fields(), to = is.model.fields();
  for (std::size_t i = 0; i < to.size(); ++i)
    visitValueOf(to[i], [&]<class Value>(const Value& now) {
      const std::string_view keyword = to[i].keyword;
      const Value& before = valueOf<Value>(from[i]);
      if constexpr (kIsContinuous<Value>) {
        const Texture *a = textureOf(was.inputs, keyword), *b = textureOf(is.inputs, keyword);
        const bool same = before == now && (a && b ? *a == *b : a == b);
        if (!same && (a || b)) return changeInput(edits, block, keyword, a, before, b, now);
      }
      if (!(before == now)) changeField(edits, block, keyword, now);
    });
  changeFields(edits, block, was.placement, is.placement);
}

/// The constant that the texture scales.
void changeConstant(TextEdits& edits, const Item& value, const std::string& to) {
  if (value.key() != kTexture) {
    edits.insert(value.offset(), std::string(kTexture) + "(");
    return edits.insert(endOf(value), ", " + to + ")");
  }
  const Item tuple = value.value();
  if (tuple.count() == 2) return edits.change(*++tuple.begin(), to);
  edits.insert(endOf(*tuple.begin()), ", " + to);
}

}  // namespace

bool changeTexture(TextEdits& edits, const Item& value, const Texture& was, const std::string& from,
                   const Texture& is, const std::string& to) {
  const std::optional<Item> call = callOf(value);
  if (!call || &was->model.type() != &is->model.type() || !isPlain(*call, was->model)) return false;
  changeBlock(edits, call->value(), *was, *is);
  if (from != to) changeConstant(edits, value, to);
  return true;
}

}  // namespace trace::rayfile

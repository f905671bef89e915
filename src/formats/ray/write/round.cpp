#include "formats/ray/write/round.h"

#include <algorithm>
#include <utility>

#include "base/find_field.h"
#include "base/text.h"
#include "formats/ray/read/light.h"
#include "formats/ray/write/edits.h"
#include "formats/ray/write/outline.h"
#include "formats/ray/write/patch_material.h"
#include "formats/ray/write/patch_view.h"
#include "formats/ray/write/same.h"
#include "formats/ray/write/writer.h"
#include "geometry/mesh/mesh.h"
#include "geometry/shapes/solids/csg.h"
#include "geometry/shapes/solids/csg_tree.h"
#include "geometry/shapes/surfaces/height_field.h"

namespace trace::rayfile {
namespace {

/// An object or an operand.
struct Part {
  const std::string& name;
  const Shape& shape;
  const Affine& placed;
  std::uint32_t material;
};
Part partOf(const Object& o) { return {o.name, o.shape, o.worldFromObject, o.material}; }
Part partOf(const Operand& o) { return {o.name, o.shape, o.wholeFromOperand, o.material}; }

/// Numbers from files, which are not to be copied into the scene.
bool isBulk(const Shape& shape) { return shape.is<Mesh>() || shape.is<HeightField>(); }

class Round {
 public:
  Round(const Reading& now, const Wanted& wanted, Anew& anew, Messages& messages)
      : syntax_(*now.syntax),
        notes_(now.notes),
        from_(now.scene),
        wanted_(wanted),
        to_(wanted.scene),
        anew_(anew),
        messages_(messages),
        outline_(syntax_),
        edits_(syntax_),
        materials_(edits_, notes_, wanted.materials) {}

  std::string run() {
    changeView(edits_, from_, to_);
    for (std::size_t i = 0; i < from_.lights.size(); ++i) light(i);
    for (std::size_t i = 0; i < from_.objects.size(); ++i) object(i);
    materials_.run();
    for (std::size_t i = 0; i < to_.lights.size(); ++i)
      if (wanted_.lights[i] == Wanted::kNew) append(lightText(to_.lights[i]));
    for (std::size_t i = 0; i < to_.objects.size(); ++i)
      if (wanted_.objects[i] == Wanted::kNew) append(newObject(to_.objects[i]));
    for (const Item& lost : edits_.lostExpressions())
      messages_.warn(syntax_.shortPlace(lost.offset()),
                     "\"" + std::string(lost.source()) + "\" is replaced by what was typed for it here");
    for (std::size_t offset : edits_.lostKeys())
      messages_.warn(syntax_.shortPlace(offset),
                     "the keys of this value are replaced by what was typed for it",
                     "values that change with time are edited in the file itself");
    return edits_.text();
  }

 private:
  static const std::size_t* find(const std::vector<std::size_t>& all, std::size_t what) {
    const auto found = std::lower_bound(all.begin(), all.end(), what);  // they ascend
    return found == all.end() || *found != what ? nullptr : &*found;
  }

  /// Nothing for a place in a file that this one includes.
  std::optional<std::size_t> offsetOf(const SourcePlace& place) const {
    if (place.file != syntax_.file() || place.line < 1) return {};
    return syntax_.offsetOf(place);
  }
  TransformStep asSaid(const TransformStep& step) const {
    return syntax_.isOfKind() ? inDegrees(step) : step;
  }

  void append(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    edits_.append("\n" + text + "\n");
  }

  // --- lights ---

  void light(std::size_t index) {
    const std::size_t* mine = find(wanted_.lights, index);
    const LightSource* now =
        mine ? &to_.lights[static_cast<std::size_t>(mine - wanted_.lights.data())] : nullptr;
    const LightSource& before = from_.lights[index];
    const bool stays = now && now->light == before.light && now->links == before.links;
    if (before.place.line < 1) {  // by the kind of file: it is there only as long as nobody names one
      if (now && !(stays && wanted_.lights.size() == 1)) append(lightText(*now));
      return;
    }
    const std::optional<std::size_t> offset = offsetOf(before.place);
    const std::optional<Item> call = offset ? syntax_.itemAt(*offset) : std::nullopt;
    if (!call) {
      if (!stays) throw Error(Fault::scene, before.place, "this light has no text here");
      return;
    }
    if (!now) return edits_.erase(*call);
    if (!changedLights_.insert(call->offset()).second) return;  // a copy in rows; the first speaks for all
    const Light &was = before.light, &is = now->light;
    changeFields(edits_, call->value(), before.links, now->links);
    if (was == is) return;
    if (&was.type() != &is.type() || anew_.lights.contains(index))
      return edits_.replace(*call, lightText(*now));
    changeFields(edits_, call->value(), was, is);
    const Color *color = findValue<Color>(was, "color"), *other = findValue<Color>(is, "color");
    if (isInWatts(is) && !(*color == *other))
      sayField(edits_, call->value(), kWatts, written(kPowerOfOne, 0));
  }

  /// Its colour is one for the watts that a file of the kind gives, or for the distance of what is looked at.
  bool isInWatts(const Light& light) const {
    return syntax_.isOfKind() && light.type().starts == LightOrigin::ball;
  }
  std::string lightText(const LightSource& source) const {
    std::string text = writtenLight(source);
    if (isInWatts(source.light))
      text.insert(text.find("{\n") + 2, "  " + std::string(kWatts) + " = " + written(kPowerOfOne, 0) + ";\n");
    while (text.back() == '\n') text.pop_back();
    return text;
  }

  // --- objects ---

  void object(std::size_t index) {
    const std::size_t* mine = find(wanted_.objects, index);
    const Object& was = from_.objects[index];
    const Object* is = mine ? &to_.objects[static_cast<std::size_t>(mine - wanted_.objects.data())] : nullptr;
    const std::optional<std::size_t> offset = offsetOf(was.place);
    const bool hasManyPlaces = !offset || syntax_.usesLanguage();  // one text may have made several things
    if (hasManyPlaces && is && sameObject(from_, was, to_, *is)) return;
    if (!offset) throw Error(Fault::scene, was.place, "this object has no text here");
    const PlacedCall* placed = outline_.find(*offset);
    if (!is) return drop(placed ? placed->whole() : whole(*offset));
    if (!placed || !standsAlone(from_, index)) return;  // with others; they stay as they are
    const bool fits = !anew_.objects.contains(index) && change(*placed, partOf(was), partOf(*is));
    if (!fits) return anew(index, *placed, *is);
    changeFields(edits_, placed->call.value(), was.links, is->links);
  }

  /// A node that is not in the outline, with the transforms around it.
  Item whole(std::size_t offset) const {
    Item item = *syntax_.itemAt(offset);
    for (const Node& node : syntax_.nodes()) {  // outer calls come first
      if (node.offset >= offset || node.kind != Kind::call) continue;
      const Item call(syntax_, static_cast<std::uint32_t>(&node - syntax_.nodes().data()));
      Item inner = call;
      while (stepOf(inner)) inner = childOf(inner);
      if (inner.is(Kind::call) && inner.offset() == offset) return call;
    }
    return item;
  }

  void drop(const Item& item) {
    if (!dropped_.insert(item.offset()).second) return;
    edits_.erase(item);
    materials_.drop(item.offset(), endOf(item));
  }

  /// The node alone, in the place where it stood.
  void anew(std::size_t index, const PlacedCall& placed, const Object& is) {
    anew_.objects.insert(index);
    Affine outer = placed.outer;
    for (std::size_t i = 0; i < placed.direct; ++i)
      if (const std::optional<TransformStep> step = stepOf(placed.own[i])) outer = outer * affineOf(*step);
    Object inside = is;
    if (outer != Affine{} && invertible(outer)) inside.worldFromObject = inverse(outer) * is.worldFromObject;
    std::string text = writtenObject(
        to_, inside, [&](std::uint32_t i, bool) { return materials_.fullText(to_.materials.at(i)); });
    while (text.back() == '\n') text.pop_back();
    const Item whole = placed.whole();
    edits_.replace(whole, text);
    materials_.drop(whole.offset(), endOf(whole));
  }

  /// False if only writing it anew helps.
  bool change(const PlacedCall& placed, const Part& was, const Part& is) {
    const Item& call = placed.call;
    if (&was.shape.type() != &is.shape.type()) return false;
    if (was.name != is.name) {
      const std::optional<Item> name = fieldOf(call.value(), "name");
      const std::string text = written(is.name, 0);
      if (name && is.name.empty())
        edits_.erase(*name);
      else if (name)
        edits_.change(name->value(), text);
      else
        edits_.addField(call.value(), "name = " + text);
    }
    materials_.want(call, was.material, from_.materials.at(was.material), to_.materials.at(is.material));
    changeFields(edits_, call.value(), was.shape, is.shape);
    const bool shaped = !was.shape.type().ofObjects ||
                        operands(call, was.shape.operands().list(), is.shape.operands().list());
    return shaped && place(placed, was.placed, is.placed);
  }

  // --- operands ---

  using OperandTexts = std::vector<Notes::OperandText>;

  bool operands(const Item& call, const std::vector<Operand>& was, const std::vector<Operand>& is) {
    const auto found = notes_.operands.find(call.offset());
    if (found == notes_.operands.end()) return was.empty() && is.empty();
    const OperandTexts& texts = found->second;
    if (!operands(texts, was, is)) return false;
    for (std::size_t i = was.size(); i < is.size(); ++i) edits_.addField(call.value(), operandText(is[i]));
    return true;
  }

  /// All but those that are new.
  bool operands(const OperandTexts& texts, const std::vector<Operand>& was, const std::vector<Operand>& is) {
    if (texts.size() != was.size()) return false;
    if (is.size() < was.size()) return withoutSome(texts, was, is);
    for (std::size_t i = 0; i < was.size(); ++i)
      if (!operand(texts[i], was[i], is[i])) operandAnew(texts[i], is[i]);
    return true;
  }

  bool withoutSome(const OperandTexts& texts, const std::vector<Operand>& was,
                   const std::vector<Operand>& is) {
    std::size_t kept = 0;
    std::vector<Item> gone;
    for (std::size_t i = 0; i < was.size(); ++i) {
      if (kept < is.size() && sameOperand(from_, was[i], to_, is[kept])) {
        if (!operand(texts[i], was[i], is[kept])) return false;
        ++kept;
      } else {
        gone.push_back(*syntax_.itemAt(texts[i].offset));
      }
    }
    if (kept < is.size()) return false;
    for (const Item& item : gone) drop(item);
    return true;
  }

  /// False if only writing it anew helps.
  bool operand(const Notes::OperandText& text, const Operand& was, const Operand& is) {
    if (text.calls.size() > 1) return group(text, was, is) || sameOperand(from_, was, to_, is);
    const PlacedCall* placed = outline_.find(text.calls.front());
    return placed ? change(*placed, partOf(was), partOf(is)) : sameOperand(from_, was, to_, is);
  }

  /// The union that a group is has no name, place and material of its own.
  bool group(const Notes::OperandText& text, const Operand& was, const Operand& is) {
    const Material& own = wanted_.materials.at(was.material).value_or(from_.materials.at(was.material));
    const std::size_t parts = is.shape.operands().list().size();
    if (!is.shape.is<Union>() || is.name != was.name || !(is.wholeFromOperand == was.wholeFromOperand) ||
        !(own == to_.materials.at(is.material)) || parts < 2 || parts > text.calls.size())
      return false;
    OperandTexts texts;
    std::set<std::size_t> known;
    for (std::size_t call : text.calls) {
      const PlacedCall* placed = outline_.find(call);
      if (!placed || !known.insert(call).second) return false;  // several objects of one call
      texts.push_back({placed->whole().offset(), {call}});
    }
    return operands(texts, was.shape.operands().list(), is.shape.operands().list());
  }

  void operandAnew(const Notes::OperandText& text, const Operand& is) {
    const Item item = *syntax_.itemAt(text.offset);
    edits_.replace(item, operandText(is));
    materials_.drop(item.offset(), endOf(item));
    messages_.warn(syntax_.shortPlace(text.offset),
                   "this part of a solid is rewritten: comments and nesting within it are lost");
  }

  std::string operandText(const Operand& operand) const {
    std::string text =
        writtenObject(to_, {operand.name, operand.shape, operand.wholeFromOperand, operand.material, {}},
                      [&](std::uint32_t i, bool) { return materials_.fullText(to_.materials.at(i)); });
    while (text.back() == '\n') text.pop_back();
    return text;
  }

  // --- transforms ---

  bool place(const PlacedCall& placed, const Affine& was, const Affine& is) {
    if (was == is) return true;
    if (!placed.plain) return false;
    std::vector<TransformStep> own;
    for (const Item& call : placed.own) own.push_back(*stepOf(call));
    Affine said = placed.outer;
    for (const TransformStep& step : own) said = said * affineOf(step);
    Affine target = is;
    if (!nearlyEqual(said, was)) {  // what the reader puts in between stays, as of a mesh in its file
      const Affine between = invertible(said) ? inverse(said) * was : Affine::scaling({});
      if (!invertible(between)) return false;
      target = is * inverse(between);
    }
    const auto steps = changedSteps(placed.outer, own, target);
    if (!steps) return false;
    const std::size_t more = steps->size() - own.size();
    for (std::size_t i = 0; i < own.size(); ++i) changeStep(placed.own[i], own[i], (*steps)[more + i]);
    if (more == 0) return true;
    const Item& outermost = placed.own.empty() ? placed.call : placed.own.front();
    std::string heads;
    for (std::size_t i = 0; i < more; ++i) heads += head(asSaid((*steps)[i]), 0);
    edits_.insert(outermost.offset(), heads);
    edits_.insert(endOf(outermost), std::string(more, ')'));
    return true;
  }

  void changeStep(const Item& call, const TransformStep& was, const TransformStep& becomes) {
    if (was == becomes) return;
    const TransformStep is = asSaid(becomes);
    if (was.kind != is.kind) {
      const Item child = childOf(call);
      std::size_t last = call.offset();
      for (const Item item : call.value())
        if (item.offset() < child.offset()) last = endOf(item);
      std::string text = head(is, 0);
      text.resize(text.size() - 2);  // the comma is there
      return edits_.replace(call.offset(), last, text);
    }
    if (was.numbers.size() != is.numbers.size()) {  // scale(2, ...) becomes scale(2, 2, 3, ...)
      std::string text;
      for (Real number : is.numbers) text += (text.empty() ? "" : ", ") + written(number, 0);
      return edits_.replace(*call.value().begin(), text);
    }
    std::size_t next = 0;
    for (auto at = call.value().begin(); next < is.numbers.size();) {
      const Item item = *at;
      if (item.is(Kind::tuple)) {
        changeRow(item, is, next);
        ++at;
        continue;
      }
      // Three numbers that one text gives: a point in brackets, or the name of one.
      std::string text;
      std::size_t count = 0;
      bool differs = false;
      for (; next < is.numbers.size() && (*at).offset() == item.offset(); ++at, ++next, ++count) {
        differs = differs || asSaid(was).numbers[next] != is.numbers[next];
        text += (count > 0 ? ", " : "") + written(is.numbers[next], 0);
      }
      if (count == 1)
        edits_.change(item, text);
      else if (differs)
        edits_.replace(item, "(" + text + ")");
    }
  }

  void changeRow(const Item& row, const TransformStep& is, std::size_t& next) {
    std::string text;
    for (std::size_t i = 0; i < 4; ++i) text += (i == 0 ? "(" : ", ") + written(is.numbers[next++], 0);
    edits_.change(row, text + ")");
  }

  // --- what is new ---

  std::string newObject(const Object& object) {
    const auto materialText = [&](std::uint32_t i, bool whole) {
      return materials_.text(to_.materials.at(i), whole);
    };
    if (isBulk(object.shape))
      for (std::size_t i = 0; i < from_.objects.size(); ++i)
        if (standsAlone(from_, i) && sameShape(from_, from_.objects[i].shape, to_, object.shape))
          if (const PlacedCall* like = outline_.find(syntax_.offsetOf(from_.objects[i].place)))
            return copyOf(like->call, object, materialText(object.material, false));
    return writtenObject(to_, object, materialText);
  }

  /// The text of another object that has the same shape, so that its file stays named.
  std::string copyOf(const Item& call, const Object& object, const std::string& material) {
    const std::vector<TransformStep> steps = stepsOf(object.worldFromObject);
    std::string text;
    for (const TransformStep& step : steps) text += head(asSaid(step), 0);
    const Item block = call.value();
    const std::optional<Item> shared = fieldOf(block, "shared");
    const std::string name = written(object.name, 0);
    if (shared) {
      text += std::string(call.key()) + " { " + std::string(shared->source()) + ";";
      if (!object.name.empty()) text += " name = " + name + ";";
      text += " material = " + material + "; }";
    } else {
      TextEdits copy(syntax_);
      const auto set = [&](std::string_view key, const std::string& value) {
        if (const std::optional<Item> field = fieldOf(block, key))
          copy.replace(field->value(), value);
        else
          copy.addField(block, std::string(key) + " = " + value);
      };
      if (!object.name.empty() || fieldOf(block, "name")) set("name", name);
      set("material", material);
      text += copy.text(call.offset(), endOf(call));
    }
    return text + std::string(steps.size(), ')');
  }

  const Syntax& syntax_;
  const Notes& notes_;
  const Scene& from_;
  const Wanted& wanted_;
  const Scene& to_;
  Anew& anew_;
  Messages& messages_;
  Outline outline_;
  TextEdits edits_;
  MaterialEdits materials_;
  std::set<std::size_t> dropped_, changedLights_;  ///< offsets
};

}  // namespace

Reading::Reading(const std::string& file, std::string_view bytes, Real time)
    : text(std::make_unique<std::string>(bytes)), syntax(std::make_unique<Syntax>(file, *text)) {
  Messages ignored;
  scene = readNoted(*syntax, ignored, time, notes);
}

bool standsAlone(const Scene& scene, std::size_t object) {
  const auto same = [&](std::size_t other) {
    return other < scene.objects.size() &&
           scene.objects[other].place.line == scene.objects[object].place.line &&
           scene.objects[other].place.column == scene.objects[object].place.column;
  };
  return !same(object + 1) && (object == 0 || !same(object - 1));
}

std::string changedText(const Reading& now, const Wanted& wanted, Anew& anew, Messages& messages) {
  return Round(now, wanted, anew, messages).run();
}

}  // namespace trace::rayfile

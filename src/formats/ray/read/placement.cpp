#include "formats/ray/read/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/text.h"
#include "formats/ray/read/fields.h"
#include "math/elementary.h"

namespace trace::rayfile {
namespace {

struct TransformForm {
  std::string_view name, form;
};
constexpr std::array<TransformForm, 4> kTransforms{{
    {"translate", "translate(x, y, z, object)"},
    {"rotate", "rotate(x, y, z, radians, object)"},
    {"scale", "scale(factor, object) or scale(x, y, z, object)"},
    {"transform", "transform((a, b, c, d), (e, f, g, h), (i, j, k, l), (0, 0, 0, 1), object)"},
}};

const TransformForm* findTransform(const Item& item) {
  if (!item.is(Kind::call)) return nullptr;
  for (const TransformForm& transform : kTransforms)
    if (transform.name == item.key()) return &transform;
  return nullptr;
}

/// The numbers at the start of a transform; nothing if there are others than `count` numbers.
bool numbers(std::span<const Item> items, std::span<Real> to) {
  if (items.size() != to.size()) return false;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!items[i].is(Kind::number)) return false;
    to[i] = items[i].number();
  }
  return true;
}

std::optional<Affine> translation(std::span<const Item> items) {
  Real n[3];
  if (!numbers(items, n)) return {};
  return Affine::translation({n[0], n[1], n[2]});
}

std::optional<Affine> scaling(std::span<const Item> items) {
  Real n[3];
  if (numbers(items, std::span(n, 1))) return Affine::scaling({n[0], n[0], n[0]});
  if (!numbers(items, n)) return {};
  return Affine::scaling({n[0], n[1], n[2]});
}

std::string rowText(const Vec3& row, Real last) {
  return "(" + toText(row.x) + ", " + toText(row.y) + ", " + toText(row.z) + ", " + toText(last) + ")";
}

/// Files of the kind count angles in degrees.
std::string formOf(const Findings& findings, const TransformForm& transform) {
  const bool turns = transform.name == "rotate" && findings.isOfKind();
  return std::string(turns ? "rotate(x, y, z, degrees, object)" : transform.form);
}

/// The verb for a transform.
std::string_view deedOf(const TransformForm& transform) {
  return transform.name == "translate" ? "moves"
         : transform.name == "scale"   ? "scales"
         : transform.name == "rotate"  ? "rotates"
                                       : "transforms";
}

/// For `translate(1, 0, 0) sphere { }`: all numbers are there, and the braces are not.
std::optional<Item> withoutBraces(Findings& findings, const Item& call, const TransformForm& transform,
                                  std::span<const Item> items) {
  std::string form = std::string(transform.name) + "(";
  for (const Item& item : items)
    form += (form.ends_with('(') ? "" : ", ") +
            (item.is(Kind::number) ? toText(item.number()) : std::string(item.source()));
  form += ")";
  findings.error(call, "expected braces after " + form,
                 "the object that it " + std::string(deedOf(transform)) + " stands in them: " + form +
                     " { sphere { } }");
  return {};
}

std::optional<Item> wrongForm(Findings& findings, const Item& call, const TransformForm& transform,
                              const char* hint) {
  findings.error(call, "expected " + formOf(findings, transform), hint);
  return {};
}

std::optional<Affine> rotation(Findings& findings, std::span<const Item> items) {
  Real n[4];
  if (!numbers(items, n)) return {};
  const Real length = math::hypot(n[0], n[1], n[2]);
  if (!(length > 0 && std::isfinite(length))) {
    findings.error(items[0], "rotate: expected an axis, found one of length " + toText(length));
    return Affine{};
  }
  const Real radians = findings.isOfKind() ? n[3] * (kPi / 180) : n[3];
  return Affine::rotation(Vec3{n[0], n[1], n[2]} / length, radians);
}

std::optional<Affine> matrix(Findings& findings, std::span<const Item> rows) {
  Real n[4][4];
  if (rows.size() != 4) return {};
  for (int i = 0; i < 4; ++i)
    if (!numbers(rows[i], n[i], 4)) return {};
  const auto& last = n[3];
  const bool homogeneous = last[0] == 0 && last[1] == 0 && last[2] == 0 && last[3] != 0;
  const Real w = homogeneous ? last[3] : 1;
  if (!homogeneous)
    findings.warn(
        rows[3],
        "transform: expected a last row of (0, 0, 0, 1), found " + describe(rows[3]) + "; it is ignored", {},
        "last row");
  Affine m;
  for (int i = 0; i < 3; ++i) {
    m.row[i] = Vec3{n[i][0], n[i][1], n[i][2]} / w;
    m.offset[i] = n[i][3] / w;
  }
  return m;
}

}  // namespace

std::optional<Affine> transformOf(std::string_view name, std::span<const Real> n, bool degrees) {
  if (name == "translate" && n.size() == 3) return Affine::translation({n[0], n[1], n[2]});
  if (name == "scale" && n.size() == 1) return Affine::scaling({n[0], n[0], n[0]});
  if (name == "scale" && n.size() == 3) return Affine::scaling({n[0], n[1], n[2]});
  if (name == "rotate" && n.size() == 4) {
    const Real length = math::hypot(n[0], n[1], n[2]);
    if (!(length > 0 && std::isfinite(length))) return {};
    return Affine::rotation(Vec3{n[0], n[1], n[2]} / length, degrees ? n[3] * (kPi / 180) : n[3]);
  }
  if (name == "transform" && n.size() == 16 && n[12] == 0 && n[13] == 0 && n[14] == 0 && n[15] == 1)
    return Affine{{{n[0], n[1], n[2]}, {n[4], n[5], n[6]}, {n[8], n[9], n[10]}}, {n[3], n[7], n[11]}};
  return {};
}

bool isTransform(const Item& item) { return findTransform(item) != nullptr; }

void addTransformWords(std::vector<std::string_view>& words) {
  for (const TransformForm& transform : kTransforms) words.push_back(transform.name);
}

std::optional<Item> applyTransform(Findings& findings, const Item& call, Affine& worldFromObject) {
  const TransformForm& transform = *findTransform(call);
  std::vector<Item> items;
  items.reserve(5);  // most have fewer, and a scene may have a million
  if (call.value().is(Kind::tuple))
    for (const Item item : call.value()) items.push_back(item);
  const bool hasChild = !items.empty() && !items.back().is(Kind::number) && !items.back().is(Kind::tuple);
  if (!hasChild) {
    const bool ofKind = findings.isOfKind() && !items.empty();
    const std::size_t count = items.size(),
                      wanted = transform.name == "translate" || transform.name == "scale" ? 3 : 4;
    if (ofKind && (count == wanted || (count == 1 && transform.name == "scale")))
      return withoutBraces(findings, call, transform, items);
    return wrongForm(findings, call, transform,
                     !ofKind ? "the object is missing"
                     : transform.name == "rotate"
                         ? "as in rotate(0, 1, 0, 30) { sphere { } } or rotate y 30 { sphere { } }"
                         : "a number is missing, as in translate(1, 2, 3) { sphere { } }");
  }

  const std::optional<Item> child = items.back();
  items.pop_back();
  std::optional<Affine> own;
  if (transform.name == "translate")
    own = translation(items);
  else if (transform.name == "rotate")
    own = rotation(findings, items);
  else if (transform.name == "scale")
    own = scaling(items);
  else
    own = matrix(findings, items);
  if (!own) {
    const bool several = !items.empty() && (items.back().is(Kind::call) || items.back().is(Kind::block));
    const auto word =
        std::find_if(items.begin(), items.end(), [](const Item& item) { return item.is(Kind::word); });
    if (!several && word != items.end()) {
      findings.error(*word, "expected " + formOf(findings, transform) + ", found " + describe(*word));
      return {};
    }
    return wrongForm(findings, call, transform, several ? "several objects stand in a group { }" : "");
  }
  worldFromObject = worldFromObject * *own;
  return child;
}

std::string transformed(const Affine& m, std::string_view text) {
  if (m == Affine{}) return std::string(text);
  return "transform(" + rowText(m.row[0], m.offset.x) + ", " + rowText(m.row[1], m.offset.y) + ", " +
         rowText(m.row[2], m.offset.z) + ", (0, 0, 0, 1),\n" + std::string(text) + ")";
}

}  // namespace trace::rayfile

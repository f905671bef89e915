// Source: the scenes by which students of Hong Kong's COMP 4411 demonstrated their extensions, their
// comments, and the READMEs of their programs (COMP4411-Team/Trace, coeusguo/Trace on GitHub).
#include "formats/ray/file/students.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/text.h"
#include "formats/words.h"
#include "geometry/shape.h"
#include "math/elementary.h"
#include "math/vec.h"

namespace trace::rayfile {
namespace {

/// Their lights and emissive meshes are ten times as bright as what their pictures show.
constexpr Real kEmission = 0.1;
/// Area lights are scaled by a slider of their program; at a tenth of it their demonstrations are dark.
constexpr Real kAreaLights = 10;
constexpr Real kBumpHeight = 0.02;
constexpr int kMostCopies = 200;

/// Fields of an object that belong to its material.
constexpr std::array<std::string_view, 6> kObjectFields{
    "diffuse_map", "bump_map", "normal_map", "perlin_noise", "anisotropic_specular", "emission"};
constexpr std::array<std::string_view, 3> kMaterialFields{"absorb", "glossiness", "type"};
constexpr std::array<std::string_view, 4> kSpotFields{"target", "cone_angle", "penumbra", "cutoff_distance"};
constexpr std::array<std::string_view, 3> kCameraFields{"enable_motion_blur", "time0", "time1"};

constexpr std::array<std::pair<std::string_view, std::string_view>, 14> kOperations{
    {{"sub", "difference"},
     {"subtract", "difference"},
     {"subtraction", "difference"},
     {"minus", "difference"},
     {"difference", "difference"},
     {"or", "union"},
     {"add", "union"},
     {"plus", "union"},
     {"union", "union"},
     {"and", "intersection"},
     {"intersect", "intersection"},
     {"intersection", "intersection"},
     {"common", "intersection"},
     {"join", "union"}}};

template <std::size_t N>
bool isListed(std::string_view word, const std::array<std::string_view, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

std::string text(Real value) { return std::isfinite(value) ? toText(value) : "0"; }
std::string text(const Vec3& v) { return "(" + text(v.x) + ", " + text(v.y) + ", " + text(v.z) + ")"; }

class Translator {
 public:
  explicit Translator(Syntax& syntax) : syntax_(syntax), all_(syntax.nodes()) {}

  bool anything() {
    translate();
    return changed_;
  }
  void replace() {
    translate();
    if (!changed_) return;
    syntax_.replace(std::move(result_));
    if (hasKeys_) syntax_.noteKeys();
    for (Syntax::Remark& remark : remarks_) syntax_.remark(std::move(remark));
  }

 private:
  using Index = std::uint32_t;
  using Write = std::function<void()>;
  using Rule = bool (Translator::*)(Index call);

  // --- the tree ---

  Item at(Index index) const { return {syntax_, index}; }
  Kind kind(Index index) const { return all_[index].kind; }
  std::vector<Index> children(Index parent) const {
    std::vector<Index> list;
    for (Index child = parent + 1; child < all_[parent].end; child = all_[child].end) list.push_back(child);
    return list;
  }
  bool isKeyed(Index index) const { return at(index).keyed(); }
  std::string_view key(Index index) const { return isKeyed(index) ? at(index).key() : std::string_view(); }
  /// The value of a keyed node.
  Index value(Index keyed) const { return all_[keyed + 1].end; }

  /// The last field of that name in a block.
  std::optional<Index> field(Index block, std::string_view name) const {
    std::optional<Index> found;
    for (const Index child : children(block))
      if (key(child) == name) found = value(child);
    return found;
  }
  std::optional<Real> number(Index block, std::string_view name) const {
    const auto found = field(block, name);
    if (!found || kind(*found) != Kind::number) return {};
    return all_[*found].number;
  }
  Real number(Index block, std::string_view name, Real otherwise) const {
    return number(block, name).value_or(otherwise);
  }
  std::optional<std::vector<Real>> numbers(Index tuple) const {
    if (kind(tuple) != Kind::tuple) return {};
    std::vector<Real> list;
    for (const Index child : children(tuple)) {
      if (kind(child) != Kind::number) return {};
      list.push_back(all_[child].number);
    }
    return list;
  }
  std::optional<Vec3> vector(Index block, std::string_view name) const {
    const auto found = field(block, name);
    const auto list = found ? numbers(*found) : std::nullopt;
    if (!list || list->size() != 3) return {};
    return Vec3{(*list)[0], (*list)[1], (*list)[2]};
  }
  std::optional<Vec3> color(Index block) const {
    const auto found = vector(block, "color");
    return found ? found : vector(block, "colour");
  }
  std::string_view word(Index block, std::string_view name) const {
    const auto found = field(block, name);
    return found && kind(*found) == Kind::word ? at(*found).text() : std::string_view();
  }

  // --- writing ---

  /// A copy, in which what is to be translated is.
  void copy(Index index) {
    if (kind(index) == Kind::call && kind(value(index)) == Kind::block && rewritten(index)) return;
    if (key(index) == "material" && kind(value(index)) == Kind::block)
      return material(index, value(index), {});
    const std::size_t copied = push(all_[index]);
    for (const Index child : children(index)) copy(child);
    close(copied);
  }
  std::size_t push(const Node& node) {
    result_.push_back(node);
    return result_.size() - 1;
  }
  void close(std::size_t index) { result_[index].end = static_cast<std::uint32_t>(result_.size()); }

  /// Adds the items of a text of the format in the place of a node; `_0`, `_1` ... stand for what `parts`
  /// write.
  void make(Index of, const std::string& source, const std::vector<Write>& parts = {}) {
    const Syntax made(syntax_.file(), source);
    hasKeys_ |= made.hasKeys();
    changed_ = true;
    for (const Item item : made.root()) graft(made, item, of, parts);
  }
  void graft(const Syntax& made, const Item& item, Index of, const std::vector<Write>& parts) {
    if (const std::optional<std::size_t> part = placeholder(item, parts.size())) return parts[*part]();
    const Node& from = made.nodes()[item.index()];
    Node node = from;
    node.offset = all_[of].offset;
    node.length = all_[of].length;
    if (item.is(Kind::word)) node.number = syntax_.spell(std::string(item.source()));
    const std::size_t grafted = push(node);
    for (const Item child : item) graft(made, child, of, parts);
    close(grafted);
  }
  static std::optional<std::size_t> placeholder(const Item& item, std::size_t parts) {
    for (std::size_t i = 0; i < parts && item.is(Kind::word); ++i)
      if (item.source() == "_" + std::to_string(i)) return i;
    return {};
  }
  Write copyOf(Index index) {
    return [this, index] { copy(index); };
  }
  /// Copies of the items of a block except for the fields of those names.
  Write rest(Index block, std::function<bool(std::string_view)> isLeftOut) {
    return [this, block, isLeftOut = std::move(isLeftOut)] {
      for (const Index child : children(block))
        if (!isLeftOut(key(child))) copy(child);
    };
  }
  void remark(Index of, std::string what, std::string hint = {}) {
    if (told_.insert(what).second) remarks_.push_back({all_[of].offset, std::move(what), std::move(hint)});
  }

  // --- materials ---

  /// The material of a block, with `more` fields behind its own; those of `taken` are left out.
  void material(Index of, std::optional<Index> block, const std::string& more,
                const std::vector<Write>& parts = {}, const std::set<std::string_view>& taken = {}) {
    const bool isCall = kind(of) == Kind::call && key(of) == "material";
    std::vector<Write> all = parts;
    std::string fields;
    std::set<std::string_view> left(taken);
    if (block) {
      fields = theirFields(*block, left);
      all.push_back(rest(*block, [left](std::string_view name) { return left.contains(name); }));
    }
    if (block && fields.empty() && more.empty()) {  // as it is
      const std::size_t copied = push(all_[of]);
      for (const Index child : children(of)) {
        if (child != *block) {
          copy(child);
          continue;
        }
        const std::size_t inside = push(all_[child]);
        all.back()();
        close(inside);
      }
      return close(copied);
    }
    const std::string own = block ? "_" + std::to_string(all.size() - 1) + "; " : "";
    make(of, std::string(isCall ? "material {" : "material = {") + fields + own + more + "}", all);
  }

  /// Fields of the format for those of students in a material; the latter are put into `left`.
  std::string theirFields(Index block, std::set<std::string_view>& left) {
    std::string fields;
    const auto take = [&](std::initializer_list<std::string_view> names) { left.insert(names); };
    if (const std::string_view type = word(block, "type"); type == "microfacet") {
      take({"type", "albedo"});
      fields += "model = principled; color = " + text(vector(block, "albedo").value_or(Vec3{1, 1, 1})) + "; ";
    } else if (type == "fresnel") {
      take({"type", "albedo", "metallic", "roughness", "translucency"});
      const Vec3 albedo = vector(block, "albedo").value_or(Vec3{1, 1, 1});
      const Real passes = std::clamp(number(block, "translucency", 0), 0.0, 1.0);
      fields += "diffuse = " + text(albedo * (1 - passes)) +
                "; transmissive = " + text(Vec3{passes, passes, passes}) + "; ";
      remark(block, "a material of type \"fresnel\" is shown as glass of its albedo and translucency");
    }
    if (const auto absorbs = vector(block, "absorb")) {  // Beer's law, per unit of length
      take({"absorb"});
      fields += "attenuation_color = " +
                text(Vec3{math::exp(-max(0, absorbs->x)), math::exp(-max(0, absorbs->y)),
                          math::exp(-max(0, absorbs->z))}) +
                "; attenuation_distance = 1; ";
    }
    if (const auto gloss = number(block, "glossiness")) {
      take({"glossiness"});
      const Vec3 mirror = vector(block, "reflective").value_or(Vec3{});
      if (*gloss > 0 && (mirror.x > 0 || mirror.y > 0 || mirror.z > 0)) {
        take({"diffuse", "specular", "reflective", "shininess", "transmissive", "index", "ambient"});
        fields += "model = conductor; color = " + text(mirror) +
                  "; roughness = " + text(std::sqrt(std::clamp(*gloss, 0.0, 1.0))) + "; ";
        remark(block, "a glossy mirror is shown without its diffuse and specular light");
        glossy_ = block;
      }
    }
    return fields;
  }

  /// Their pictures and patterns beside a material, as fields of it.
  bool objectFields(Index call) {
    const Index block = value(call);
    const auto has = [&](std::string_view name) { return field(block, name).has_value(); };
    if (std::none_of(kObjectFields.begin(), kObjectFields.end(), has)) return false;
    const std::optional<Index> given = field(block, "material");
    const bool inPlace = given && kind(*given) == Kind::block;
    std::string more;
    std::vector<Write> parts;
    std::set<std::string_view> taken;
    const auto part = [&](Write write) {
      parts.push_back(std::move(write));
      return "_" + std::to_string(parts.size() - 1);
    };
    if (const auto picture = field(block, "diffuse_map")) {
      const bool principled = inPlace && word(*given, "type") == "microfacet";
      taken.insert("diffuse");
      more += std::string(principled ? "color" : "diffuse") + " = map(" + part(copyOf(*picture)) + "); ";
    }
    if (const auto picture = field(block, "normal_map"))
      more += "normal_map = " + part(copyOf(*picture)) + "; ";
    else if (const auto heights = field(block, "bump_map"))
      more += "bump = texture(image { file = " + part(copyOf(*heights)) + "; }, " + text(kBumpHeight) + "); ";
    if (const auto noise = field(block, "perlin_noise"); noise && kind(*noise) == Kind::block) {
      // (1 + sin(scale z + 10 |turbulence|)) / 2 of their diffuse colour
      const Vec3 lit = inPlace ? vector(*given, "diffuse").value_or(Vec3{1, 1, 1}) : Vec3{1, 1, 1};
      const Real octaves = std::clamp(std::floor(number(*noise, "turbulence_depth", 7)), 1.0, 16.0);
      taken.insert("diffuse");
      more += "diffuse = texture(marble { a = (0, 0, 0); b = " + text(lit) +
              "; frequency = " + text(number(*noise, "scale", 4) / (2 * kPi)) +
              "; turbulence = " + text(10 / (2 * kPi)) + "; octaves = " + text(octaves) +
              "; rotate = (0, 90, 0); }); ";
    }
    if (field(block, "anisotropic_specular")) {
      Real exponent = inPlace ? number(*given, "shininess", 0.5) : 0.5;
      if (exponent <= 1) exponent *= 128;
      const Real rough = std::sqrt(2 / (exponent + 2));
      taken.insert({"shininess", "reflective", "transmissive", "index", "specular"});
      const Vec3 specular = inPlace ? vector(*given, "specular").value_or(Vec3{}) : Vec3{1, 1, 1} * 0.5;
      more = "model = ward; specular = " + text(specular) + "; roughness = " + text(rough) +
             "; roughness_across = " + text(std::min(1.0, 4 * rough)) + "; " + more;
      remark(call, "anisotropic_specular is shown as a surface brushed along u; its picture is not read");
    }
    if (const auto emission = vector(block, "emission")) {
      more += "emissive = " + text(*emission * kEmission) + "; ";
      emits(call);
    }
    const auto isTaken = [](std::string_view name) {
      return isListed(name, kObjectFields) || name == "material";
    };
    const std::string head = std::string(key(call)) + " { _0; _1; }";
    const Write own = rest(block, isTaken);
    const Write look = [this, call, given, inPlace, &more, &parts, &taken] {
      material(call, inPlace ? given : std::nullopt, more, parts, taken);
    };
    if (given && !inPlace)  // a material by its name: the fields are added to what it is
      make(call, "{ material = _2; " + head + " }", {look, own, copyOf(*given)});
    else
      make(call, head, {look, own});
    return true;
  }

  // --- objects ---

  bool csg(Index call) {
    const Index block = value(call);
    std::optional<Index> operation = field(block, "operation");
    if (!operation) operation = field(block, "operator");
    if (!operation) return false;
    if (kind(*operation) == Kind::tuple) {
      if (!canCombine(block, *operation)) return false;
      combine(block, *operation);
      return true;
    }
    const std::string_view name = kind(*operation) == Kind::word ? at(*operation).text() : "";
    const std::string_view ours = operationCalled(name);
    if (ours.empty()) return false;
    const auto objects = [this, block] {
      for (const Index child : children(block))
        if (kind(child) != Kind::entry) copy(child);
    };
    const std::optional<Index> material = field(block, "material");
    make(call, std::string(ours) + " { " + (material ? "material = _1; " : "") + "_0; }",
         {objects, copyOf(material.value_or(block))});
    return true;
  }
  static std::string_view operationCalled(std::string_view name) {
    for (const auto& [theirs, ours] : kOperations)
      if (sameWord(name, theirs)) return ours;
    return {};
  }
  /// The value of a name or number in an expression.
  std::optional<Index> operandOf(Index block, Index operand) const {
    if (kind(operand) == Kind::word) return field(block, at(operand).text());
    return {};
  }
  static std::string numbered(std::string_view name, Real number) {
    return std::string(name) + std::to_string(static_cast<std::int64_t>(number));
  }
  bool canCombine(Index block, Index expression) const {
    const std::vector<Index> parts = children(expression);
    if (parts.size() != 3 || kind(parts[1]) != Kind::word || operationCalled(at(parts[1]).text()).empty())
      return false;
    return std::all_of(parts.begin(), parts.end(), [&](Index part) {
      if (part == parts[1]) return true;
      if (kind(part) == Kind::tuple) return canCombine(block, part);
      if (kind(part) == Kind::number)
        return findShapeType(word(block, numbered("primitive", all_[part].number))) != nullptr;
      return operandOf(block, part).has_value();
    });
  }
  void combine(Index block, Index expression) {
    const std::vector<Index> parts = children(expression);
    const auto operand = [this, block](Index part) {
      if (kind(part) == Kind::tuple) return combine(block, part);
      if (kind(part) == Kind::number) return primitive(block, all_[part].number, part);
      copy(*operandOf(block, part));
    };
    make(expression, std::string(operationCalled(at(parts[1]).text())) + " { _0; _1; }",
         {[=] { operand(parts[0]); }, [=] { operand(parts[2]); }});
  }
  /// queue3 = ("translate", "scale", "cylinder"), translate3 = (...), scale3 = (...), materialID3 = "name".
  void primitive(Index block, Real number, Index of) {
    const std::string name(word(block, numbered("primitive", number)));
    std::string object = name + " { ";
    std::vector<Write> parts;
    if (const auto material = field(block, numbered("materialID", number))) {
      object += "material = _0; ";
      parts.push_back(copyOf(*material));
    }
    object += "}";
    const auto queue = field(block, numbered("queue", number));
    std::vector<Index> steps = queue && kind(*queue) == Kind::tuple ? children(*queue) : std::vector<Index>{};
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
      if (kind(*step) != Kind::word) continue;
      const std::string_view transform = at(*step).text();
      if (transform != "translate" && transform != "rotate" && transform != "scale") continue;
      const auto values = field(block, numbered(transform, number));
      const auto list = values ? this->numbers(*values) : std::nullopt;
      if (!list) continue;
      std::string all;
      for (const Real value : *list) all += text(value) + ", ";
      object = std::string(transform) + "(" + all + object + ")";
    }
    make(of, object, parts);
  }

  /// Two tubes around a ring, turned around each other: at the angle phi they stand at q phi.
  bool torusKnot(Index call) {
    const Index block = value(call);
    const Real radius = number(block, "radius", 1), tube = number(block, "tube", 0.1),
               p = number(block, "p", 0.4), q = number(block, "q", 3.5);
    constexpr int kStations = 24;  // to a turn of the tubes around the ring or around each other
    if (!(std::abs(q) <= 100) || !(tube > 0)) return false;
    const bool one = std::abs(std::remainder(q, 1)) == 0.5;  // the second continues where the first ends
    const int rounds = one ? 2 : 1;
    const int stations = rounds * kStations * static_cast<int>(std::ceil(std::max(1.0, std::abs(q))));
    std::string tubes;
    for (int i = 0; i < (one ? 1 : 2); ++i) {
      std::string points;
      for (int k = -1; k <= stations + 1; ++k) {
        const Real phi = 2 * kPi * rounds * k / stations, turn = q * phi + i * kPi;
        const Real away = radius + p * math::sin(turn);
        points += "(" + text(away * math::sin(phi)) + ", " + text(p * math::cos(turn)) + ", " +
                  text(away * math::cos(phi)) + ", " + text(tube) + "), ";
      }
      tubes += "sphere_sweep { _0; spline = catmull; points = (" + points + "); } ";
    }
    const auto rest = this->rest(block, [](std::string_view name) {
      return name == "radius" || name == "tube" || name == "p" || name == "q";
    });
    make(call, one ? tubes : "union { " + tubes + "}", {rest});
    return true;
  }

  bool movingSphere(Index call) {
    const Index block = value(call);
    const auto start = vector(block, "start"), end = vector(block, "end");
    if (!start || !end) return false;
    const Real radius = number(block, "radius", 1), from = number(block, "time0", 0),
               to = number(block, "time1", 1);
    const auto along = [&](Real a, Real b) {
      if (!(to > from)) return text(a);
      return "key((" + text(from) + ", " + text(a) + "), (" + text(to) + ", " + text(b) + "))";
    };
    const auto rest = this->rest(block, [](std::string_view name) {
      return name == "start" || name == "end" || name == "radius" || name == "time0" || name == "time1";
    });
    make(call,
         "translate(" + along(start->x, end->x) + ", " + along(start->y, end->y) + ", " +
             along(start->z, end->z) + ", scale(" + text(radius) + ", sphere { _0 }))",
         {rest});
    return true;
  }

  bool sphereLight(Index call) {
    const auto emission = vector(value(call), "emission");
    if (!emission) return false;
    make(call,
         "sphere { material = { emissive = " + text(*emission * kEmission) + "; diffuse = (0, 0, 0); } }");
    emits(call);
    return true;
  }

  /// x^2 - y^2 = 1 for z from 0 to 1; their sheets have no end, ours reach ten units.
  bool hyperbolic(Index call) {
    const auto rest = this->rest(value(call), [](std::string_view) { return false; });
    make(call,
         "quadric { _0; squares = (1, -1, 0); constant = -1; low = (-10, -10, 0); high = (10, 10, 1); capped "
         "= "
         "false; }",
         {rest});
    return true;
  }

  /// The sum of r^2 / d^2 over the balls is 1.
  bool metaball(Index call) {
    const Index block = value(call);
    const auto balls = field(block, "ball");
    if (!balls || kind(*balls) != Kind::tuple) return false;
    std::string sum = "1";
    Vec3 low(kInfinity, kInfinity, kInfinity), high = -low;
    Real all = 0;
    for (const Index ball : children(*balls)) {
      const auto n = numbers(ball);
      if (!n || n->size() != 4) return false;
      const Vec3 place{(*n)[0], (*n)[1], (*n)[2]};
      all += (*n)[3] * (*n)[3];
      low = min(low, place), high = max(high, place);
      sum += " - " + text((*n)[3] * (*n)[3]) + " / ((x - " + bracketed(place.x) + ")^2 + (y - " +
             bracketed(place.y) + ")^2 + (z - " + bracketed(place.z) + ")^2 + 0.00001)";
    }
    const Real reach = std::sqrt(all);
    if (!(reach > 0)) return false;
    const Vec3 margin{reach, reach, reach};
    const auto rest = this->rest(
        block, [](std::string_view name) { return name == "ball" || name == "gridSize" || name == "size"; });
    make(call,
         "isosurface { _0; formula = \"" + sum + "\"; low = " + text(low - margin) +
             "; high = " + text(high + margin) + "; }",
         {rest});
    return true;
  }
  static std::string bracketed(Real value) { return value < 0 ? "(" + text(value) + ")" : text(value); }

  /// Balls where the blocks of a fluid stand before it flows.
  bool fluid(Index call) {
    const Index block = value(call);
    const auto blocks = field(block, "initial_blocks");
    const Real radius = number(block, "kernel_radius", 0) * 0.1;
    if (!blocks || !(radius > 0)) return false;
    std::string rows;
    for (const Index one : children(*blocks)) {
      if (kind(one) != Kind::block) return false;
      const auto low = vector(one, "min"), high = vector(one, "max");
      const Real spacing = number(one, "spacing", 0);
      if (!low || !high || !(spacing > 0)) return false;
      const auto count = [&](Real from, Real to) {
        return text(std::max(1.0, std::floor((to - from) / spacing)));
      };
      rows += "translate" + text(*low).substr(0, text(*low).size() - 1) + ", rows { count = (" +
              count(low->x, high->x) + ", " + count(low->y, high->y) + ", " + count(low->z, high->z) +
              "); step = " + text(Vec3{spacing, spacing, spacing}) + "; scale(" + text(radius) +
              ", sphere { material = { diffuse = (0.7, 0.7, 0.7); } }) }) ";
    }
    make(call, "{ " + rows + "}");
    remark(call, "a fluid is shown as it stands before it flows: its simulation is not run");
    return true;
  }

  /// Particles that are thrown upward in all directions, with the trail of where each was.
  bool emitter(Index call) {
    const Index block = value(call);
    const Real step = number(block, "time_step", 0.01), ticks = number(block, "tick", 100);
    const Real mass = number(block, "mass", 1), drag = number(block, "drag", 0),
               speed = number(block, "initial_speed", 1), lifespan = number(block, "lifespan", 10);
    const auto first = field(block, "initial_material");
    if (!(step > 0) || !(ticks >= 1) || !(mass > 0) || !first || kind(*first) != Kind::block) return false;
    const auto last = field(block, "end_material");
    const Vec3 force = vector(block, "force").value_or(Vec3{});
    const Vec3 from = glowOf(*first), to = last && kind(*last) == Kind::block ? glowOf(*last) : from;
    const Real trail = std::clamp(std::min(number(block, "tail", 1), ticks), 1.0, Real{kMostCopies});
    std::string systems;
    for (int i = 0; i < static_cast<int>(trail); ++i) {
      const Real share = i / std::max(1.0, trail - 1);
      systems += "particles { rate = " + text(number(block, "emission_rate", 1) / step) +
                 "; begin = " + text(-(ticks - trail + i + 1) * step) +
                 "; duration = " + text(number(block, "emission_cut", ticks) * step) +
                 "; lifetime = " + text(lifespan) + "; step = " + text(step) +
                 "; position = " + text(vector(block, "source_position").value_or(Vec3{})) +
                 "; velocity = " + text(Vec3{0, speed / 2, 0}) + "; velocity_spread = " + text(speed / 2) +
                 "; gravity = " + text(force / mass) + "; drag = " + text(drag / mass) +
                 "; spread = (0, 0, 0); lifetime_spread = 0; size = 1; end_size = 1; scale(" +
                 text(number(block, "particle_radius", 0.01)) +
                 ", sphere { material = { emissive = " + text(from + (to - from) * share) +
                 "; diffuse = (0, 0, 0); } }) } ";
    }
    make(call, "{ " + systems + "}");
    return true;
  }
  Vec3 glowOf(Index material) const {
    const auto glows = vector(material, "emissive");
    return glows ? *glows : vector(material, "diffuse").value_or(Vec3{1, 1, 1});
  }

  // --- lights and the environment ---

  bool areaLight(Index call) {
    const Index block = value(call);
    const auto position = vector(block, "position"), u = vector(block, "u"), v = vector(block, "v"),
               color = this->color(block);
    if (!position || !u || !v || !color) return false;
    // Theirs fades with the square of the distance, whatever its area, and has no front.
    const Real area = length(cross(*u, *v));
    const Vec3 strength = area > 0 ? *color * (kAreaLights * kPi / area) : Vec3{};
    make(call, "rectangle_light { position = " + text(*position + (*u + *v) / 2) + "; u = " + text(*u) +
                   "; v = " + text(*v) + "; color = " + text(strength) + "; two_sided = true; }");
    return true;
  }

  bool spotLight(Index call) {
    const Index block = value(call);
    const auto position = vector(block, "position"), target = vector(block, "target");
    if (!position || !target) return false;
    const Real cone = std::clamp(number(block, "cone_angle", 60), 0.0, 180.0),
               inner = std::clamp(number(block, "penumbra", 30), 0.0, cone),
               reach = number(block, "cutoff_distance", 50);
    std::string fading;  // (1 - d / reach)^2, by the first terms of what it is a part of 1 over
    if (reach > 0)
      fading = "constant_attenuation_coeff = 1; linear_attenuation_coeff = " + text(2 / reach) +
               "; quadratic_attenuation_coeff = " + text(3 / (reach * reach)) + "; ";
    const auto rest = this->rest(block, [](std::string_view name) { return isListed(name, kSpotFields); });
    make(call,
         "spot_light { _0; direction = " + text(*target - *position) + "; angle = " + text(cone) +
             "; full_angle = " + text(inner) + "; " + fading + "}",
         {rest});
    return true;
  }

  /// parms = (size, distance, exponent): a hole of that size at that distance.
  bool shapeLight(Index call) {
    const Index block = value(call);
    const auto parameters = vector(block, "parms"), position = vector(block, "position"),
               direction = vector(block, "direction"), color = this->color(block);
    if (!parameters || !position || !direction || !color || !(parameters->y > 0)) return false;
    const Real angle = math::atan2(parameters->x, parameters->y) * 180 / kPi;
    make(call, "spot_light { position = " + text(*position) + "; direction = " + text(*direction) +
                   "; color = " + text(*color) + "; angle = " + text(angle) + "; full_angle = " +
                   text(angle) + "; exponent = " + text(std::max(0.0, parameters->z)) + "; }");
    remark(call, "a shape_light is shown as a round spot light: its triangle, square or star is not");
    return true;
  }

  bool skybox(Index call) {
    make(call, "{ }");  // where it stands changes nothing: a background is of the top of a file
    skybox_ = call;
    return true;
  }

  bool camera(Index call) {
    const Index block = value(call);
    const auto rest = this->rest(block, [](std::string_view name) { return isListed(name, kCameraFields); });
    const Real from = number(block, "time0", 0), to = number(block, "time1", 1);
    const bool blurs = word(block, "enable_motion_blur") == "true" && to > from;
    make(call,
         "camera { _0 }" +
             (blurs ? " settings { time = " + text(from) + "; shutter = " + text(to - from) + "; spp = 64; }"
                    : std::string()),
         {rest});
    return true;
  }

  /// Only integrators that follow light from surface to surface show what it lights.
  void emits(Index call) {
    if (!emitter_) emitter_ = call;
  }

  // --- all ---

  /// Writes what the call stands for, if that is another.
  bool rewritten(Index call) {
    static const std::array<std::pair<std::string_view, Rule>, 12> kRules{
        {{"csg", &Translator::csg},
         {"torus_knot", &Translator::torusKnot},
         {"moving_sphere", &Translator::movingSphere},
         {"sphere_light", &Translator::sphereLight},
         {"hyperbolic", &Translator::hyperbolic},
         {"metaball", &Translator::metaball},
         {"fluid", &Translator::fluid},
         {"emitter", &Translator::emitter},
         {"area_light", &Translator::areaLight},
         {"spot_light", &Translator::spotLight},
         {"shape_light", &Translator::shapeLight},
         {"skybox", &Translator::skybox}}};
    const std::string_view name = key(call);
    for (const auto& [theirs, rule] : kRules)
      if (name == theirs) return (this->*rule)(call);
    if (name == "camera") {
      for (const std::string_view field : kCameraFields)
        if (this->field(value(call), field)) return camera(call);
      return false;
    }
    if (name == "trimesh" || name == "mesh" || findShapeType(name)) return objectFields(call);
    return false;
  }

  void translate() {
    const std::size_t root = push(all_[0]);
    for (const Index child : children(0)) copy(child);
    if (skybox_)
      make(*skybox_, "background { _0 }", {rest(value(*skybox_), [](std::string_view) { return false; })});
    std::string settings;
    if (emitter_) settings += "integrator = path; spp = 64; ";
    if (glossy_) settings += "glossy = on; spp = 64; ";
    if (emitter_ && glossy_) settings = "integrator = path; glossy = on; spp = 64; ";
    if (!settings.empty()) make(emitter_ ? *emitter_ : *glossy_, "settings { " + settings + "}");
    close(root);
  }

  Syntax& syntax_;
  const std::span<const Node> all_;
  std::vector<Node> result_;
  std::vector<Syntax::Remark> remarks_;
  std::set<std::string> told_;
  std::optional<Index> emitter_, glossy_;  ///< the first of what needs other settings
  std::optional<Index> skybox_;            ///< the last
  bool changed_ = false, hasKeys_ = false;
};

/// A look that costs little: a scene of a million numbers is not copied in vain.
bool mayBeTheirs(const Syntax& syntax) {
  static const std::unordered_set<std::string_view> theirs = [] {
    std::unordered_set<std::string_view> words{"csg",         "torus_knot", "moving_sphere", "sphere_light",
                                               "hyperbolic",  "metaball",   "fluid",         "emitter",
                                               "shape_light", "skybox",     "area_light"};
    const auto add = [&](const auto& more) { words.insert(more.begin(), more.end()); };
    add(kObjectFields), add(kMaterialFields), add(kSpotFields), add(kCameraFields);
    return words;
  }();
  const std::span<const Node> nodes = syntax.nodes();
  for (std::uint32_t i = 0; i + 1 < nodes.size(); ++i) {
    if (nodes[i].kind != Kind::entry && nodes[i].kind != Kind::call) continue;
    if (theirs.count(Item(syntax, i).key()) > 0) return true;
  }
  return false;
}

}  // namespace

bool speaksStudents(const Syntax& syntax) {
  if (!mayBeTheirs(syntax)) return false;
  Syntax again(syntax.file(), syntax.source());
  return Translator(again).anything();
}

void translateStudents(Syntax& syntax) {
  if (mayBeTheirs(syntax)) Translator(syntax).replace();
}

}  // namespace trace::rayfile

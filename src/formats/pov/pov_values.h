// The values of POV-Ray's scene language: what #declare may name. Source: the POV-Ray 3.7 reference, sections
// 2.2.1 and 2.2.2.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "formats/pov/pov_tokens.h"
#include "geometry/shape.h"
#include "math/transform.h"

namespace trace::pov {

/// A number, a vector of 2 to 5 components, or a colour: red, green, blue, filter, transmit.
struct Numbers {
  std::array<Real, 5> v{};
  int size = 1;

  Numbers() = default;
  Numbers(Real number) : v{number} {}  // NOLINT(google-explicit-constructor): a number is one
  Numbers(const Vec3& p) : v{p.x, p.y, p.z}, size(3) {}  // NOLINT(google-explicit-constructor)
  Real operator[](int i) const { return v[static_cast<std::size_t>(i)]; }
  Real& operator[](int i) { return v[static_cast<std::size_t>(i)]; }
  /// A number stands for a vector of which all components are it.
  Numbers promoted(int to) const {
    Numbers r = *this;
    if (size >= to) return r;
    for (int i = size; i < to; ++i) r[i] = size == 1 ? v[0] : 0;
    r.size = to;
    return r;
  }
  Vec3 vec() const {
    const Numbers p = promoted(3);
    return {p.v[0], p.v[1], p.v[2]};
  }
};

struct Node;     // an object
struct Formula;  // a user function
struct Array;
struct SplineCurve;
struct Macro;
struct PigmentNode;
struct NormalNode;
struct FinishNode;
struct TextureNode;
struct InteriorNode;
struct MediaNode;
struct MaterialNode;
struct CameraNode;
struct FogNode;
struct SkyNode;
struct MapNode;

template <class T>
using Ref = std::shared_ptr<const T>;

/// The meaning of a name.
struct Value {
  std::variant<std::monostate, Numbers, std::string, Affine, std::shared_ptr<Array>, Ref<Formula>,
               std::shared_ptr<SplineCurve>, Ref<Macro>, Ref<Node>, Ref<PigmentNode>, Ref<NormalNode>,
               Ref<FinishNode>, Ref<TextureNode>, Ref<InteriorNode>, Ref<MediaNode>, Ref<MaterialNode>,
               Ref<CameraNode>, Ref<FogNode>, Ref<SkyNode>, Ref<MapNode>>
      held;

  template <class T>
  const T* as() const {
    return std::get_if<T>(&held);
  }
  bool none() const { return held.index() == 0; }
};
/// A value that a macro shares with its caller.
using Slot = std::shared_ptr<Value>;

struct Array {
  std::vector<std::size_t> sizes;  ///< size of each dimension
  std::vector<Slot> elements;
  std::size_t level = 0;  ///< the dimensions that were chosen already
};

struct SplineCurve {
  enum class Kind { linear, quadratic, cubic, natural };
  Kind kind = Kind::linear;
  std::map<Real, Numbers> points;

  Numbers at(Real t) const;
};

struct Macro {
  std::string name;
  std::vector<std::string> parameters;
  const Source* source = nullptr;
  std::size_t begin = 0, end = 0;  ///< tokens of its body
};

/// The result of the operator, component by component; "" where one has no meaning.
std::optional<Numbers> combined(std::string_view op, const Numbers& a, const Numbers& b);

/// The kind of a value, for messages: "a number", "a texture".
std::string_view kindOf(const Value& value);

}  // namespace trace::pov

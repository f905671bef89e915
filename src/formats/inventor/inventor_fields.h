// The fields of a node as values, with the values that a PROTO hands down.
#pragma once

#include <string_view>
#include <vector>

#include "formats/inventor/syntax/inventor_syntax.h"
#include "math/color.h"
#include "math/vec.h"

namespace trace::inventor {

/// An instance of a PROTO, and the environment it.
struct Env {
  const Node* instance = nullptr;
  const Env* outer = nullptr;
};

struct NodeIn {
  const Node* node = nullptr;
  const Env* env = nullptr;
};

class Values {
 public:
  Values(const Node& node, const Env* env) : node_(node), env_(env) {}
  const Node& node() const { return node_; }
  const Env* env() const { return env_; }

  const Field* field(std::string_view name) const { return find(name).field; }
  bool has(std::string_view name) const { return field(name) != nullptr; }
  Real number(std::string_view name, Real otherwise) const {
    const std::vector<double>& n = numbers(name);
    return n.empty() ? otherwise : n[0];
  }
  Vec3 vector(std::string_view name, const Vec3& otherwise) const {
    const std::vector<double>& n = numbers(name);
    return n.size() < 3 ? otherwise : Vec3{n[0], n[1], n[2]};
  }
  Color color(std::string_view name, const Color& otherwise) const {
    const std::vector<double>& n = numbers(name);
    return n.size() < 3 ? otherwise : Color{n[0], n[1], n[2]};
  }
  bool flag(std::string_view name, bool otherwise) const {
    const std::string_view w = word(name, otherwise ? "TRUE" : "FALSE");
    return w == "TRUE" || w == "true";
  }
  std::string_view word(std::string_view name, std::string_view otherwise) const {
    const Field* field = find(name).field;
    return field && !field->words.empty() ? field->words[0] : otherwise;
  }
  const std::vector<std::string_view>& words(std::string_view name) const {
    static const std::vector<std::string_view> kNone;
    const Field* field = find(name).field;
    return field ? field->words : kNone;
  }
  const std::vector<double>& numbers(std::string_view name) const {
    static const std::vector<double> kNone;
    const Field* field = find(name).field;
    return field ? field->numbers : kNone;
  }
  std::vector<Vec3> vectors(std::string_view name) const {
    const std::vector<double>& n = numbers(name);
    std::vector<Vec3> result;
    result.reserve(n.size() / 3);
    for (std::size_t i = 0; i + 2 < n.size(); i += 3) result.push_back({n[i], n[i + 1], n[i + 2]});
    return result;
  }
  std::vector<Color> colors(std::string_view name) const {
    std::vector<Color> result;
    for (const Vec3& v : vectors(name)) result.emplace_back(v.x, v.y, v.z);
    return result;
  }
  std::vector<Vec2> pairs(std::string_view name) const {
    const std::vector<double>& n = numbers(name);
    std::vector<Vec2> result;
    for (std::size_t i = 0; i + 1 < n.size(); i += 2) result.push_back({n[i], n[i + 1]});
    return result;
  }
  /// The nodes of a field.
  std::vector<NodeIn> nodes(std::string_view name) const {
    const Found found = find(name);
    std::vector<NodeIn> result;
    if (found.field)
      for (const Node* node : found.field->nodes) result.push_back({node, found.env});
    return result;
  }

 private:
  struct Found {
    const Field* field = nullptr;
    const Env* env = nullptr;
  };
  static const Field* last(const std::vector<Field>& fields, std::string_view name) {
    for (auto field = fields.rbegin(); field != fields.rend(); ++field)
      if (field->name == name) return &*field;
    return nullptr;
  }
  Found find(std::string_view name) const {
    Found found{last(node_.fields, name), env_};
    while (found.field && !found.field->is.empty()) {
      if (!found.env) return {};
      const Node& instance = *found.env->instance;
      const Field* given = last(instance.fields, found.field->is);
      // A default belongs to no instance; what it holds stands by itself.
      found = given ? Found{given, found.env->outer}
                    : Found{last(instance.proto->fields, found.field->is), nullptr};
      if (!given) break;
    }
    return found;
  }

  const Node& node_;
  const Env* env_;
};

}  // namespace trace::inventor

// Parts of the checks of glTF's JSON: parts of the tree with their paths, and what is asked of their
// values.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/field.h"
#include "base/text.h"
#include "formats/warnings.h"

namespace trace {

constexpr std::string_view kGltfLights = "KHR_lights_punctual";

/// An object of the file and where it stands, as in `materials[0].pbrMetallicRoughness`.
struct GltfPart {
  const nlohmann::json& value;
  std::string path;

  const nlohmann::json* find(std::string_view key) const {
    const auto at = value.find(key);
    return at == value.end() ? nullptr : &*at;
  }
  std::string pathOf(std::string_view key) const {
    return path.empty() ? std::string(key) : path + "." + std::string(key);
  }
};

class GltfRules {
 public:
  using json = nlohmann::json;
  using Part = GltfPart;

  GltfRules(const json& file, const SourcePlace& place) : root{file, ""}, place_(place) {}

  [[noreturn]] void fail(const std::string& what, std::string hint = {}) const {
    throw Error(Fault::scene, place_, what, std::move(hint));
  }
  void warn(std::string what, std::string hint = {}, std::string_view kind = {}) {
    warnings.warn(place_, std::move(what), std::move(hint), kind);
  }

  // --- parts and values ---

  template <class Visit>
  void each(const Part& owner, std::string_view key, Visit&& visit) {
    const json* list = owner.find(key);
    if (!list) return;
    const std::string path = owner.pathOf(key);
    if (!list->is_array()) fail(path + ": expected a list, found " + found(*list));
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string place = path + "[" + std::to_string(i) + "]";
      if (!(*list)[i].is_object()) fail(place + ": expected an object, found " + found((*list)[i]));
      visit(Part{(*list)[i], place});
    }
  }
  template <class Visit>
  void object(const Part& owner, std::string_view key, Visit&& visit) {
    const json* value = owner.find(key);
    if (!value) return;
    if (!value->is_object()) fail(owner.pathOf(key) + ": expected an object, found " + found(*value));
    visit(Part{*value, owner.pathOf(key)});
  }
  template <class Visit>
  void extension(const Part& owner, std::string_view name, Visit&& visit) {
    object(owner, "extensions", [&](const Part& all) { object(all, name, visit); });
  }

  /// The length of the top list of that name; lights stand in an extension.
  std::size_t countOf(std::string_view list) const {
    const json* all = root.find(list);
    if (list == "lights") {
      all = root.find("extensions");
      for (std::string_view key : {kGltfLights, list})
        if (all && all->is_object()) all = Part{*all, ""}.find(key);
    }
    return all && all->is_array() ? all->size() : 0;
  }
  void checkIndex(const json& value, const std::string& path, std::string_view list) const {
    const std::size_t count = countOf(list);
    if (value.is_number_unsigned() && value.get<std::uint64_t>() < count) return;
    if (count == 0) fail(path + ": the file has no " + std::string(list) + ", found " + found(value));
    fail(path + ": expected a number of one of the " + std::to_string(count) + " " + std::string(list) +
             ", found " + found(value),
         count > 0 ? "they are counted from 0" : "");
  }
  void index(const Part& owner, std::string_view key, std::string_view list) const {
    if (const json* value = owner.find(key)) checkIndex(*value, owner.pathOf(key), list);
  }
  void indices(const Part& owner, std::string_view key, std::string_view list) const {
    const json* all = owner.find(key);
    if (!all) return;
    if (!all->is_array()) fail(owner.pathOf(key) + ": expected a list of numbers, found " + found(*all));
    for (const json& value : *all) checkIndex(value, owner.pathOf(key), list);
  }

  void inRange(const Part& owner, std::string_view key, double value, double least, double most) {
    if (value >= least && value <= most) return;
    const std::string range =
        most == kNoLimit ? "at least " + toText(least) : toText(least) + " to " + toText(most);
    warn(owner.pathOf(key) + ": expected " + range + ", found " + toText(value), {},
         "range of " + std::string(key));
  }
  void number(const Part& owner, std::string_view key, double least = -kNoLimit, double most = kNoLimit) {
    const json* value = owner.find(key);
    if (!value) return;
    if (!value->is_number()) fail(owner.pathOf(key) + ": expected a number, found " + found(*value));
    inRange(owner, key, value->get<double>(), least, most);
  }
  void whole(const Part& owner, std::string_view key, std::uint64_t least = 0) const {
    const json* value = owner.find(key);
    if (!value || (value->is_number_unsigned() && value->get<std::uint64_t>() >= least)) return;
    const bool tooLarge = value->is_number_float() && value->get<double>() >= 1.8e19;
    fail(owner.pathOf(key) + ": expected a whole number " +
         (tooLarge ? "that 64 bits can hold" : "of at least " + std::to_string(least)) + ", found " +
         found(*value));
  }
  void numbers(const Part& owner, std::string_view key, std::size_t count, double least = -kNoLimit,
               double most = kNoLimit) {
    const json* value = owner.find(key);
    if (!value) return;
    const bool good = value->is_array() && value->size() == count &&
                      std::all_of(value->begin(), value->end(), [](const json& n) { return n.is_number(); });
    if (!good)
      fail(owner.pathOf(key) + ": expected " + std::to_string(count) + " numbers, found " + found(*value));
    for (const json& n : *value) inRange(owner, key, n.get<double>(), least, most);
  }
  void word(const Part& owner, std::string_view key, std::initializer_list<std::string_view> words) {
    const json* value = owner.find(key);
    if (!value) return;
    if (value->is_string() && isOneOf(value->get_ref<const std::string&>(), {words.begin(), words.size()}))
      return;
    std::string list;
    for (std::string_view w : words) list += (list.empty() ? "" : ", ") + std::string(w);
    fail(owner.pathOf(key) + ": expected one of " + list + ", found " + found(*value));
  }
  /// Warns of properties that the specification does not have there.
  void known(const Part& owner, std::initializer_list<std::string_view> keys) {
    for (const auto& [key, value] : owner.value.items()) {
      if (key == "name" || key == "extensions" || key == "extras") continue;
      if (isOneOf(key, {keys.begin(), keys.size()})) continue;
      warn("unknown property " + inQuotes(key) + " of " + owner.path + " is ignored",
           didYouMean(key, {keys.begin(), keys.size()}), "unknown " + key.substr(0, 60));
    }
  }

  const Part root;
  WarningsByKind warnings;

 protected:
  static bool isOneOf(std::string_view word, std::span<const std::string_view> list) {
    return std::find(list.begin(), list.end(), word) != list.end();
  }
  static std::string inQuotes(std::string_view word) { return "\"" + std::string(word.substr(0, 60)) + "\""; }
  /// The value as the file has it, short.
  static std::string found(const json& value) {
    const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    return text.size() > 40 ? text.substr(0, 40) + "..." : text;
  }

 private:
  const SourcePlace& place_;
};

}  // namespace trace

#include "shading/material.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace trace {
namespace {

/// Those that differ from the default, which another model may have another of.
template <class From, class To>
void copyFields(const From& from, To& to) {
  forEachField<To>([&](const auto& target) {
    auto& value = to.*target.member;
    forEachField<From>([&](const auto& source) {
      using Value = std::remove_cvref_t<decltype(from.*source.member)>;
      if constexpr (std::is_same_v<Value, std::remove_cvref_t<decltype(value)>>)
        if (source.keyword == target.keyword && !(from.*source.member == From{}.*source.member))
          value = from.*source.member;
    });
  });
}

}  // namespace

void changeColors(MaterialModel& model, std::initializer_list<std::string_view> keywords,
                  const std::function<Color(const Color&)>& change) {
  match(model, [&]<class M>(M& m) {
    forEachField<M>([&](const auto& f) {
      auto& value = m.*f.member;
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(value)>, Color>)
        if (std::find(keywords.begin(), keywords.end(), f.keyword) != keywords.end()) value = change(value);
    });
  });
}

MaterialModel converted(const MaterialModel& from, const MaterialModel& to) {
  if (from.index() == to.index()) return from;
  MaterialModel result = match(to, []<class M>(const M&) -> MaterialModel { return M{}; });
  match(result, [&](auto& target) { match(from, [&](const auto& source) { copyFields(source, target); }); });
  return result;
}

Material withModel(Material material, const MaterialModel& to) {
  material.model = converted(material.model, to);
  std::erase_if(material.textures, [&](const FieldTexture& t) {
    bool known = false;
    forEachField<Material>([&](const auto& f) { known |= f.keyword == t.field; });
    match(material.model, [&]<class M>(const M&) {
      forEachField<M>([&](const auto& f) {
        using Value = std::remove_cvref_t<decltype(std::declval<M&>().*f.member)>;
        known |= kIsContinuous<Value> && f.keyword == t.field;
      });
    });
    return !known;
  });
  return material;
}

}  // namespace trace

// match(variant, visitor): calls the visitor with the alternative held, through a chain of comparisons
// that compilers inline at any number of alternatives (libstdc++'s std::visit stops inlining at 11).
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

namespace trace {

/// Several lambdas as one visitor: Overloaded{[](const Sphere&) ..., [](const auto&) ...}.
template <class... Fs>
struct Overloaded : Fs... {
  using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;

/// The std::variant that a type is or comes from.
template <class... T>
std::variant<T...> asVariant(const std::variant<T...>&);
template <class Variant>
using VariantOf = decltype(asVariant(std::declval<const Variant&>()));

template <std::size_t I = 0, class Variant, class Visitor>
constexpr decltype(auto) match(Variant&& variant, Visitor&& visitor) {
  constexpr std::size_t kCount = std::variant_size_v<VariantOf<Variant>>;
  if constexpr (I + 1 < kCount) {
    if (variant.index() != I)
      return match<I + 1>(std::forward<Variant>(variant), std::forward<Visitor>(visitor));
  }
  return std::forward<Visitor>(visitor)(*std::get_if<I>(&variant));
}

/// Calls visit(static_cast<T*>(nullptr)) for each alternative of the variant: loops over a type list.
template <class Variant, class Visit>
constexpr void forEachType(Visit&& visit) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (visit(static_cast<std::variant_alternative_t<I, VariantOf<Variant>>*>(nullptr)), ...);
  }
  (std::make_index_sequence<std::variant_size_v<VariantOf<Variant>>>{});
}

}  // namespace trace

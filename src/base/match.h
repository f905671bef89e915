// match(variant, visitor): calls the visitor with the alternative held, through a switch that compilers
// inline at any number of alternatives (libstdc++'s std::visit stops inlining at 11).
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

namespace detail {
/// Calls the visitor with alternative I; the last one also for numbers beyond it, which nobody has.
template <std::size_t I, class Variant, class Visitor>
[[gnu::always_inline]] constexpr decltype(auto) matchAt(Variant&& variant, Visitor&& visitor) {
  constexpr std::size_t kLast = std::variant_size_v<VariantOf<Variant>> - 1;
  return std::forward<Visitor>(visitor)(*std::get_if<(I < kLast ? I : kLast)>(&variant));
}
}  // namespace detail

template <std::size_t I = 0, class Variant, class Visitor>
constexpr decltype(auto) match(Variant&& variant, Visitor&& visitor) {
  constexpr std::size_t kTogether = 16, kCount = std::variant_size_v<VariantOf<Variant>>;
#define TRACE_CASE(N)                                                                                \
  case I + N:                                                                                        \
    if constexpr (I + N + 1 < kCount)                                                                \
      return detail::matchAt<I + N>(std::forward<Variant>(variant), std::forward<Visitor>(visitor)); \
    else                                                                                             \
      break
  switch (variant.index()) {
    TRACE_CASE(0);
    TRACE_CASE(1);
    TRACE_CASE(2);
    TRACE_CASE(3);
    TRACE_CASE(4);
    TRACE_CASE(5);
    TRACE_CASE(6);
    TRACE_CASE(7);
    TRACE_CASE(8);
    TRACE_CASE(9);
    TRACE_CASE(10);
    TRACE_CASE(11);
    TRACE_CASE(12);
    TRACE_CASE(13);
    TRACE_CASE(14);
    TRACE_CASE(15);
    default: break;
  }
#undef TRACE_CASE
  if constexpr (I + kTogether < kCount)
    return match<I + kTogether>(std::forward<Variant>(variant), std::forward<Visitor>(visitor));
  else
    return detail::matchAt<kCount - 1>(std::forward<Variant>(variant), std::forward<Visitor>(visitor));
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

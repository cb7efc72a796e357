#pragma once
// The alternatives of Joint and Shape by their names in files.

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>
#include <variant>

namespace substep {

/// Names in files of the alternatives of a variant, in its order.
template <class Variant>
inline constexpr auto kTypes = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array{std::string_view(std::variant_alternative_t<I, Variant>::kType)...};
}
(std::make_index_sequence<std::variant_size_v<Variant>>{});

/// @param type index into kTypes
template <class Variant>
Variant make_type(std::size_t type) {
  Variant item;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((I == type ? (void)item.template emplace<I>() : (void)0), ...);
  }
  (std::make_index_sequence<std::variant_size_v<Variant>>{});
  return item;
}

}  // namespace substep

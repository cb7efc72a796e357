#pragma once
// The names of settings as scene files, the command line and links spell them: one table for all.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "core/model/expectation.hpp"
#include "core/model/methods.hpp"
#include "core/model/recommended.hpp"
#include "core/model/settings.hpp"
#include "core/model/start_policy.hpp"

namespace substep {

/// The names of an enumeration's values, in their order.
template <class Enum>
inline constexpr auto kNames = nullptr;  // specialised below for every enum with names

template <std::size_t N>
using NameList = std::array<std::string_view, N>;

/// The names in a table of methods.
template <class Entry, std::size_t N>
consteval NameList<N> names_in(const std::array<Entry, N>& table) {
  NameList<N> names;
  std::transform(table.begin(), table.end(), names.begin(), [](const Entry& e) { return e.name; });
  return names;
}

template <>
inline constexpr NameList<kCountOf<SolverKind>> kNames<SolverKind> = names_in(kSolvers);
template <>
inline constexpr NameList<kCountOf<Mode>> kNames<Mode> = names_in(kModes);
template <>
inline constexpr NameList<kCountOf<Integrator>> kNames<Integrator> = names_in(kIntegrators);
template <>
inline constexpr NameList<2> kNames<Defaults>{"steady", "paper"};
template <>
inline constexpr NameList<2> kNames<Policy>{"frame", "substep"};
template <>
inline constexpr NameList<4> kNames<Drift>{"auto", "full", "soft", "exact"};
template <>
inline constexpr NameList<2> kNames<ContactStiffness>{"paper", "exact"};
template <>
inline constexpr NameList<2> kNames<FrictionCone>{"box", "cone"};
template <>
inline constexpr NameList<3> kNames<Forces>{"end", "mean", "numerov"};
template <>
inline constexpr NameList<2> kNames<Gyroscopic>{"explicit", "implicit"};
template <>
inline constexpr NameList<3> kNames<Detection>{"substep", "frame", "continuous"};
template <>
inline constexpr NameList<3> kNames<StartPolicy>{"project", "keep", "refuse"};
template <>
inline constexpr NameList<3> kNames<Expected>{"holds", "fails", "depends"};
template <>
inline constexpr NameList<4> kNames<ErrorAxis>{"path", "energy", "gap", "overlap"};

template <class Enum>
constexpr std::string_view name_of(Enum value) {
  const auto i = static_cast<std::size_t>(value);
  return i < kNames<Enum>.size() ? kNames<Enum>[i] : "?";
}

template <class Enum>
constexpr std::optional<Enum> value_of(std::string_view name) {
  const auto& names = kNames<Enum>;
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Enum>(found - names.begin());
}

}  // namespace substep

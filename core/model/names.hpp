#pragma once
// The names of settings as scene files, the command line and links spell them: one table for all.

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

template <class Enum>
struct Named {
  std::string_view name;
  Enum value;
};

template <class Enum>
struct NameTable;  // specialised below for every enum with names

/// The names in a table of methods.
template <class Enum, class Entry, std::size_t N>
consteval std::array<Named<Enum>, N> names_in(const std::array<Entry, N>& table) {
  std::array<Named<Enum>, N> names{};
  for (std::size_t i = 0; i < N; ++i) names[i] = {table[i].name, table[i].value};
  return names;
}

template <>
struct NameTable<SolverKind> {
  static constexpr std::array entries = names_in<SolverKind>(kSolvers);
};
template <>
struct NameTable<Mode> {
  static constexpr std::array entries = names_in<Mode>(kModes);
};
template <>
struct NameTable<Integrator> {
  static constexpr std::array entries = names_in<Integrator>(kIntegrators);
};
template <>
struct NameTable<Policy> {
  static constexpr std::array entries{Named<Policy>{"frame", Policy::kFrame},
                                      Named<Policy>{"substep", Policy::kSubstep}};
};
template <>
struct NameTable<Drift> {
  static constexpr std::array entries{Named<Drift>{"auto", Drift::kAuto},
                                      Named<Drift>{"full", Drift::kFull},
                                      Named<Drift>{"soft", Drift::kSoft}};
};
template <>
struct NameTable<ContactStiffness> {
  static constexpr std::array entries{Named<ContactStiffness>{"paper", ContactStiffness::kPaper},
                                      Named<ContactStiffness>{"exact", ContactStiffness::kExact}};
};
template <>
struct NameTable<FrictionCone> {
  static constexpr std::array entries{Named<FrictionCone>{"box", FrictionCone::kBox},
                                      Named<FrictionCone>{"cone", FrictionCone::kCone}};
};
template <>
struct NameTable<Forces> {
  static constexpr std::array entries{Named<Forces>{"end", Forces::kEnd},
                                      Named<Forces>{"mean", Forces::kMean},
                                      Named<Forces>{"numerov", Forces::kNumerov}};
};
template <>
struct NameTable<Gyroscopic> {
  static constexpr std::array entries{Named<Gyroscopic>{"explicit", Gyroscopic::kExplicit},
                                      Named<Gyroscopic>{"implicit", Gyroscopic::kImplicit}};
};

template <>
struct NameTable<Detection> {
  static constexpr std::array entries{Named<Detection>{"substep", Detection::kSubstep},
                                      Named<Detection>{"frame", Detection::kFrame}};
};

template <>
struct NameTable<StartPolicy> {
  static constexpr std::array entries{Named<StartPolicy>{"project", StartPolicy::kProject},
                                      Named<StartPolicy>{"keep", StartPolicy::kKeep},
                                      Named<StartPolicy>{"refuse", StartPolicy::kRefuse}};
};

template <>
struct NameTable<Expected> {
  static constexpr std::array entries{Named<Expected>{"holds", Expected::kHolds},
                                      Named<Expected>{"fails", Expected::kFails},
                                      Named<Expected>{"depends", Expected::kDepends}};
};

template <>
struct NameTable<ErrorAxis> {
  static constexpr std::array entries{Named<ErrorAxis>{"path", ErrorAxis::kTrajectory},
                                      Named<ErrorAxis>{"energy", ErrorAxis::kEnergy},
                                      Named<ErrorAxis>{"gap", ErrorAxis::kGap},
                                      Named<ErrorAxis>{"overlap", ErrorAxis::kPenetration}};
};

template <class Enum>
constexpr std::string_view name_of(Enum value) {
  for (const auto& entry : NameTable<Enum>::entries) {
    if (entry.value == value) return entry.name;
  }
  return "?";
}

template <class Enum>
constexpr std::optional<Enum> value_of(std::string_view name) {
  for (const auto& entry : NameTable<Enum>::entries) {
    if (entry.name == name) return entry.value;
  }
  return std::nullopt;
}

}  // namespace substep

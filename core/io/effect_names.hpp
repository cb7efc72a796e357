#pragma once
// The names of effects in scene files, in file order.

#include <array>
#include <string_view>

#include "core/model/effects.hpp"

namespace substep {

struct NamedEffect {
  std::string_view name;
  bool Effects::*member;
};

inline constexpr std::array kEffectNames{
    NamedEffect{"gravity", &Effects::gravity},   NamedEffect{"gyroscopic", &Effects::gyroscopic},
    NamedEffect{"joints", &Effects::joints},     NamedEffect{"contact", &Effects::contact},
    NamedEffect{"friction", &Effects::friction}, NamedEffect{"restitution", &Effects::restitution},
    NamedEffect{"external", &Effects::external}};

}  // namespace substep

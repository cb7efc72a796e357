#pragma once
// Every setting with its name, what it means and its allowed range: the one table that scene files,
// the command line, links and the app's controls read.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "core/model/range.hpp"
#include "core/model/settings.hpp"

namespace substep {

struct FlagSetting {
  bool Settings::*member;
};
struct CountSetting {
  int Settings::*member;
  int least;
  int most;
};
struct NumberSetting {
  double Settings::*member;
  Range range;
};
template <class Enum>
struct ChoiceSetting {
  Enum Settings::*member;
};

/// One field of Settings.
struct SettingField {
  std::string_view name;  // in scene files and links; as a flag with '-' for '_'
  std::string_view help;  // one line, with its equation where it has one
  std::variant<FlagSetting, CountSetting, NumberSetting, ChoiceSetting<SolverKind>,
               ChoiceSetting<Forces>, ChoiceSetting<Mode>, ChoiceSetting<Policy>,
               ChoiceSetting<Integrator>, ChoiceSetting<Gyroscopic>, ChoiceSetting<Drift>,
               ChoiceSetting<Detection>, ChoiceSetting<ContactStiffness>,
               ChoiceSetting<FrictionCone>>
      member;
};

/// All fields, in the order of struct Settings.
std::span<const SettingField> setting_fields();

/// The field of that name, or null.
const SettingField* find_setting(std::string_view name);

/// What is allowed, for people: "pgs or bpp", "a whole number from 1 to 100000",
/// "above 0 and at most 1".
std::string allowed_values(const SettingField& field);

/// What is wrong with a value: "must be above 0 and at most 1, not 3", "admm is not pgs or bpp".
std::string refusal(const SettingField& field, const std::string& value);

/// Whether its values are names, not numbers or true and false.
bool is_choice(const SettingField& field);

/// The field's value as text: what set_setting takes. Numbers lose nothing.
std::string setting_text(const SettingField& field, const Settings& settings);

/// Sets a field from text. @return what is wrong, then nothing is changed
std::optional<std::string> set_setting(const SettingField& field, std::string_view text,
                                       Settings& settings);

/// " --mode const --n 12": the command-line flags that make `settings` out of `base`. What is only
/// looked at, watch_stiffness, is left out.
std::string setting_flags(const Settings& settings, const Settings& base);

}  // namespace substep

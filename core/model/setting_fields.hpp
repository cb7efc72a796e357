#pragma once
// Every setting with its name, meaning and allowed range: the one table for scene files, the
// command line, links and the app's controls.

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
  std::string_view help;  // one line, with its equation if any
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

/// The allowed values, for messages: "pgs or bpp", "a whole number from 1 to 100000",
/// "above 0 and at most 1".
std::string allowed_values(const SettingField& field);

/// The message for an invalid value: "must be pgs or bpp, not admm".
std::string refusal(const SettingField& field, const std::string& value);

/// True if its values are names, not numbers or booleans.
bool is_choice(const SettingField& field);

/// The field's value as text: the input of set_setting. Numbers are lossless.
std::string setting_text(const SettingField& field, const Settings& settings);

/// Sets a field from text. @return the problem, if any; then nothing is changed
std::optional<std::string> set_setting(const SettingField& field, std::string_view text,
                                       Settings& settings);

/// " --mode const --n 12": the command-line flags that turn `base` into `settings`.
/// watch_stiffness, which affects only the display, is omitted, and what has no effect beside the
/// others (idle_settings.hpp).
std::string setting_flags(const Settings& settings, const Settings& base);

}  // namespace substep

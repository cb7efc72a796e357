#include "app/cli/settings_flags.hpp"

#include <algorithm>

#include "core/model/methods.hpp"
#include "core/model/problem.hpp"

namespace substep::cli {
namespace {

// Help text of the flag, with a description of each method.
std::string help_of(const SettingField& field) {
  std::string help(field.help);
  const auto append = [&help](std::string_view name, const std::string& what) {
    help.append("\n").append(name).append(": ").append(what);
  };
  if (std::holds_alternative<ChoiceSetting<SolverKind>>(field.member)) {
    for (const SolverEntry& e : kSolvers) {
      append(e.name, std::string(e.full_name) + " (" + e.reference + ")");
    }
  } else if (std::holds_alternative<ChoiceSetting<Mode>>(field.member)) {
    for (const ModeEntry& e : kModes) append(e.name, e.line);
  } else if (std::holds_alternative<ChoiceSetting<Integrator>>(field.member)) {
    for (const IntegratorEntry& e : kIntegrators) append(e.name, e.reference);
  }
  return help;
}

}  // namespace

void SettingsFlags::add_to(CLI::App& command) {
  constexpr const char* kGroup = "Settings (default: those of the scene)";
  command
      .add_option_function<std::string>(
          "--preset",
          [this](const std::string& name) {
            preset_ = find_preset(name);
            if (preset_ == nullptr) {
              throw CLI::ValidationError("--preset", must_be(preset_names(), name));
            }
          },
          "All settings at once, before the others; `recommended` is the scene's own if it has "
          "one")
      ->type_name(preset_names())
      ->group(kGroup);
  for (const SettingField& field : setting_fields()) {
    std::string name(field.name);
    std::replace(name.begin(), name.end(), '_', '-');
    const std::string help = help_of(field);
    if (std::holds_alternative<FlagSetting>(field.member)) {
      command
          .add_flag_function(
              "--" + name + ",!--no-" + name,
              [this, &field](std::int64_t count) { take(field, count > 0 ? "true" : "false"); },
              help)
          ->disable_flag_override()  // the library accepts any text after '=', and throws
          ->group(kGroup);
    } else {
      command
          .add_option_function<std::string>(
              "--" + name, [this, &field](const std::string& text) { take(field, text); }, help)
          ->type_name(allowed_values(field))
          ->group(kGroup);
    }
  }
}

void SettingsFlags::take(const SettingField& field, const std::string& text) {
  Settings scratch;
  if (const auto problem = set_setting(field, text, scratch)) {
    std::string flag = "--" + std::string(field.name);
    std::replace(flag.begin(), flag.end(), '_', '-');
    throw CLI::ValidationError(flag, *problem);
  }
  given_.emplace_back(&field, text);
}

Settings SettingsFlags::applied_to(const Scene& scene) const {
  Settings settings = preset_ != nullptr ? settings_for(*preset_, scene) : scene.settings;
  for (const auto& [field, text] : given_) set_setting(*field, text, settings);
  return settings;
}

}  // namespace substep::cli

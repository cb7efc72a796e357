#include "app/cli/flags.hpp"

#include <algorithm>
#include <cmath>

#include "app/cli/within.hpp"
#include "core/model/idle_settings.hpp"
#include "core/model/methods.hpp"
#include "core/model/problem.hpp"

namespace substep::cli {
namespace {

constexpr const char* kSettingsGroup = "Settings (default: those of the scene)";

bool is_flag(const SettingField& field) {
  return std::holds_alternative<FlagSetting>(field.member);
}

/// Without the dashes.
std::string flag_name(const SettingField& field) {
  std::string name(field.name);
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

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
  add_preset(command);
  for (const SettingField& field : setting_fields()) {
    is_flag(field) ? add_flag(command, field) : add_value(command, field);
  }
}

void SettingsFlags::add_to(CLI::App& command, std::span<const std::string_view> refused,
                           const std::string& reason) {
  // Without these hidden flags the library would report unexpected arguments, without the reason.
  const auto refuse = [&](const std::string& names, const std::string& name, bool with_value) {
    const auto refusing = [name, reason](const auto&) {
      throw CLI::ValidationError("--" + name, reason);
    };
    CLI::Option* option =
        with_value ? command.add_option_function<std::string>(names, refusing)
                   : command.add_flag_function(names, [refusing](std::int64_t n) { refusing(n); });
    option->group("");
  };
  refuse("--preset", "preset", true);
  for (const SettingField& field : setting_fields()) {
    if (std::find(refused.begin(), refused.end(), field.name) == refused.end()) {
      is_flag(field) ? add_flag(command, field) : add_value(command, field);
    } else if (const std::string name = flag_name(field); is_flag(field)) {
      refuse("--" + name + ",--no-" + name, name, false);
    } else {
      refuse("--" + name, name, true);
    }
  }
}

void SettingsFlags::add_preset(CLI::App& command) {
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
      ->group(kSettingsGroup);
}

void SettingsFlags::add_flag(CLI::App& command, const SettingField& field) {
  const std::string name = flag_name(field);
  // Of --name and --no-name together the library would take the sum.
  const auto one_of_both = [name, first = std::string()](const std::string& value) mutable {
    if (first.empty()) first = value;
    if (first != value) throw CLI::ExcludesError("--" + name, "--no-" + name);
  };
  command
      .add_flag_function(
          "--" + name + ",!--no-" + name,
          [this, &field](std::int64_t count) { take(field, count > 0 ? "true" : "false"); },
          help_of(field))
      ->each(one_of_both)
      ->disable_flag_override()  // the library accepts any text after '=', and throws
      ->group(kSettingsGroup);
}

void SettingsFlags::add_value(CLI::App& command, const SettingField& field) {
  command
      .add_option_function<std::string>(
          "--" + flag_name(field), [this, &field](const std::string& text) { take(field, text); },
          help_of(field))
      ->type_name(allowed_values(field))
      ->group(kSettingsGroup);
}

void SettingsFlags::take(const SettingField& field, const std::string& text) {
  Settings scratch;
  if (const auto problem = set_setting(field, text, scratch)) {
    throw CLI::ValidationError("--" + flag_name(field), *problem);
  }
  given_.emplace_back(&field, text);
}

Settings SettingsFlags::applied_to(const Scene& scene) const {
  Settings settings = preset_ != nullptr ? settings_for(*preset_, scene) : scene.settings;
  for (const auto& [field, text] : given_) set_setting(*field, text, settings);
  return settings;
}

Settings SettingsFlags::of_run(const Scene& scene) const {
  const Settings settings = applied_to(scene);
  for (const auto& [field, text] : given_) {
    if (const auto idle = idle_reason(settings, field->name)) {
      throw CLI::ValidationError("--" + flag_name(*field), *idle);
    }
  }
  return settings;
}

void LengthFlags::add_to(CLI::App& command) {
  constexpr double kMostSeconds = 86400.0;
  constexpr std::int64_t kMostFrames = 100'000'000;
  auto* by_time = command.add_option("--seconds", seconds, "how long to run [s]")
                      ->check(within(0.0, kMostSeconds));
  auto* by_count = command.add_option("--frames", frames, "how many frames to run")
                       ->check(whole(0, kMostFrames));
  by_time->excludes(by_count);
}

std::int64_t LengthFlags::count(const Scene& scene) const {
  if (frames) return *frames;
  return std::llround(seconds.value_or(scene.criteria.duration) / scene.frame);
}

void refuse_beside(const CLI::App& command, const std::string& flag,
                   std::initializer_list<std::string_view> allowed) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || name == flag) continue;
    if (std::find(allowed.begin(), allowed.end(), name) != allowed.end()) continue;
    throw CLI::ExcludesError(name, flag);
  }
}

void BudgetFlags::add_to(CLI::App& command) {
  constexpr const char* kBudgetGroup =
      "Budget (a run that exceeds it stops and reports the reason)";
  command
      .add_option("--memory-budget", mebibytes_,
                  "maximum memory of the direct solver [MiB]; default 512")
      ->check(within(kMemoryBudgetRange.least / kMebibyte, kMemoryBudgetRange.most / kMebibyte))
      ->group(kBudgetGroup);
  command
      .add_option("--work-budget", operations_,
                  "maximum of floating-point operations per frame; default 2e10")
      ->check(within(kWorkBudgetRange.least, kWorkBudgetRange.most))
      ->group(kBudgetGroup);
}

Budget BudgetFlags::budget() const { return {mebibytes_ * kMebibyte, operations_}; }

}  // namespace substep::cli

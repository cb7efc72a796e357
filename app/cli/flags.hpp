#pragma once
// Flags that several commands share.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/lab/presets.hpp"
#include "core/model/budget.hpp"
#include "core/model/scene.hpp"
#include "core/model/setting_fields.hpp"

namespace substep::cli {

/// All settings as flags; those not given keep the scene's values.
class SettingsFlags {
 public:
  /// Adds the flags. This object must outlive the parse.
  void add_to(CLI::App& command);
  /// The same without --preset and these settings: they are refused for this reason.
  void add_to(CLI::App& command, std::span<const std::string_view> refused,
              const std::string& reason);

  /// The scene's settings with the given preset and flags applied.
  [[nodiscard]] Settings applied_to(const Scene& scene) const;
  /// The same for one run. Throws a CLI::ValidationError for a flag that has no effect beside the
  /// others.
  [[nodiscard]] Settings of_run(const Scene& scene) const;

 private:
  void add_preset(CLI::App& command);
  void add_flag(CLI::App& command, const SettingField& field);
  void add_value(CLI::App& command, const SettingField& field);
  void take(const SettingField& field, const std::string& text);

  const Preset* preset_ = nullptr;
  std::vector<std::pair<const SettingField*, std::string>> given_;
};

/// Duration of a run: --seconds or --frames.
struct LengthFlags {
  std::optional<double> seconds;       // [s]
  std::optional<std::int64_t> frames;  // [-]

  void add_to(CLI::App& command);
  /// Number of frames; by default, the scene's own duration.
  [[nodiscard]] std::int64_t count(const Scene& scene) const;
};

/// Throws a CLI::ExcludesError for every given option of a command but `flag` and the `allowed`
/// ones: they would be ignored beside that flag.
void refuse_beside(const CLI::App& command, const std::string& flag,
                   std::initializer_list<std::string_view> allowed);

/// `--memory-budget` and `--work-budget` of a command that steps a scene.
class BudgetFlags {
 public:
  void add_to(CLI::App& command);
  [[nodiscard]] Budget budget() const;

 private:
  double mebibytes_ = Budget{}.memory / kMebibyte;
  double operations_ = Budget{}.work;
};

}  // namespace substep::cli

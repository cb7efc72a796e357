#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/lab/presets.hpp"
#include "core/model/setting_fields.hpp"

namespace substep::cli {

/// All settings as flags; those not given keep the scene's values.
class SettingsFlags {
 public:
  /// Adds the flags. This object must outlive the parse.
  void add_to(CLI::App& command);

  /// The scene's settings with the given preset and flags applied.
  [[nodiscard]] Settings applied_to(const Scene& scene) const;

 private:
  void take(const SettingField& field, const std::string& text);

  const Preset* preset_ = nullptr;
  std::vector<std::pair<const SettingField*, std::string>> given_;
};

}  // namespace substep::cli

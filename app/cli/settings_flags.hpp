#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <utility>
#include <vector>

#include "core/lab/presets.hpp"
#include "core/model/setting_fields.hpp"

namespace substep::cli {

/// Every setting as a flag; what is not given stays as the scene has it.
class SettingsFlags {
 public:
  /// Adds the flags. This object must outlive the parse.
  void add_to(CLI::App& command);

  /// The scene's settings with the preset and the flags that were given.
  [[nodiscard]] Settings applied_to(const Scene& scene) const;

 private:
  void take(const SettingField& field, const std::string& text);

  const Preset* preset_ = nullptr;
  std::vector<std::pair<const SettingField*, std::string>> given_;
};

}  // namespace substep::cli

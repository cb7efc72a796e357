#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>

#include "core/model/scene.hpp"

namespace substep::cli {

/// Duration of a run: --seconds or --frames.
struct LengthFlags {
  std::optional<double> seconds;       // [s]
  std::optional<std::int64_t> frames;  // [-]

  void add_to(CLI::App& command);
  /// Number of frames; by default, the scene's own duration.
  [[nodiscard]] std::int64_t count(const Scene& scene) const;
};

}  // namespace substep::cli

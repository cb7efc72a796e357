#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>

#include "core/model/scene.hpp"

namespace substep::cli {

/// How long to run: --seconds or --frames.
struct LengthFlags {
  std::optional<double> seconds;       // [s]
  std::optional<std::int64_t> frames;  // [-]

  void add_to(CLI::App& command);
  /// Left out: the scene's own duration.
  [[nodiscard]] std::int64_t count(const Scene& scene) const;
};

}  // namespace substep::cli

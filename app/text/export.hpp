#pragma once

#include <span>
#include <string>

#include "app/lab/history.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// A run in the table: its name and its samples.
struct ExportedRun {
  std::string name;
  const History* history = nullptr;
};

/// The channels as CSV, one line per frame and run, with the column names of the command line
/// (core/io/frame_columns.hpp). Channels that do not apply to the scene are omitted.
/// @param from omits earlier samples [s]
std::string history_csv(const Scene& scene, std::span<const ExportedRun> runs,
                        std::span<const Channel> channels, double from);

}  // namespace substep

#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/lab/history.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// A run of a table: what a person calls it, and what it did.
struct ExportedRun {
  std::string name;
  const History* history = nullptr;
};

/// The channels as CSV, one line a frame and run, by the names that the command line gives them
/// too (core/io/frame_columns.hpp). What the scene has no effect for is left out.
/// @param from what is earlier is left out [s]
std::string history_csv(const Scene& scene, std::span<const ExportedRun> runs,
                        std::span<const Channel> channels, double from);

}  // namespace substep

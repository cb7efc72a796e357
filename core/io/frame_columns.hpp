#pragma once
// A run as a table, one line per frame: the columns of CSV and JSON results.

#include <string>
#include <string_view>
#include <vector>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/report.hpp"

namespace substep {

/// Input of a column: one frame and the state at its end.
struct FrameView {
  const Scene& scene;
  const FrameReport& report;
  const State& state;
};

struct FrameColumn {
  std::string_view name;
  std::string_view meaning;               // with its unit
  std::string (*text)(const FrameView&);  // a lossless number, "inf", or a name of the scene
  bool Effects::*effect = nullptr;        // the column exists only with this effect; null: always
  bool is_number = true;                  // otherwise a name
};

/// The columns for a scene, in order.
std::vector<FrameColumn> frame_columns(const Scene& scene);

/// "frame,time,substeps,..." and a line feed.
std::string csv_header(const std::vector<FrameColumn>& columns);
/// One frame and a line feed.
std::string csv_line(const std::vector<FrameColumn>& columns, const FrameView& frame);
/// One frame as a JSON object on one line; null for infinite numbers.
std::string json_line(const std::vector<FrameColumn>& columns, const FrameView& frame);

}  // namespace substep

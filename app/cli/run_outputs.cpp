#include "app/cli/run_outputs.hpp"

#include <algorithm>

#include "app/cli/scene_source.hpp"
#include "app/cli/within.hpp"
#include "core/io/experiment.hpp"
#include "core/io/json.hpp"
#include "core/io/motion_csv.hpp"
#include "core/io/result.hpp"
#include "core/model/setting_fields.hpp"

namespace substep::cli {
namespace {

/// The flags for result files, with the files.
NamedPaths by_flag(const RunFiles& f) {
  return {{"--csv", f.csv}, {"--json", f.json}, {"--states", f.states}, {"--joints", f.joints}};
}

std::string json_text(const std::string& text) {
  return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Errors found at the start, maximum over the joints [m, rad, m/s, rad/s], the energy of their
/// correction [J] and the deepest overlap [m].
Json start_json(const StartReport& start, const FrameReport& observed) {
  const StartErrors& found = start.found;
  return {{"consistent", found.consistent()},
          {"gap", found.gap},
          {"tilt", found.tilt},
          {"speed", found.speed},
          {"turning", found.turning},
          {"projected", start.projected},
          {"energy_found", start.energy_found},
          {"energy_begun", start.energy_begun},
          {"overlap", observed.penetration}};
}

std::string json_head(const Simulator& simulator, const FrameReport& start) {
  const Scene& scene = simulator.scene();
  const Settings& settings = simulator.settings();
  std::string text = "{\n  \"scene\": " + json_text(scene.name) + ",\n  \"settings\": {";
  const char* separator = "";
  for (const SettingField& field : setting_fields()) {
    const std::string value = setting_text(field, settings);
    text += separator + json_text(std::string(field.name)) + ": ";
    text += is_choice(field) ? json_text(value) : value;
    separator = ", ";
  }
  return text + "},\n  \"start\": " + start_json(simulator.start(), start).dump() +
         ",\n  \"frames\": [";
}

std::string json_tail(const Metrics& metrics) {
  return "\n  ],\n  \"work\": " + work_json(metrics.work).dump() +
         ",\n  \"timing\": " + timing_json(metrics.timing).dump() + ",\n  \"hash\": \"" +
         hex_text(metrics.hash) + "\",\n  \"holds\": " + (metrics.holds ? "true" : "false") +
         ",\n  \"verdict\": " + json_text(metrics.verdict) + "\n}\n";
}

}  // namespace

void RunFiles::add_to(CLI::App& command) {
  command.add_option("--csv", csv, "write one line per frame to this file, - for stdout")
      ->check(named());
  command
      .add_option("--json", json,
                  "the same as JSON, with settings, verdict, and work and time by stage")
      ->check(named());
  command
      .add_option("--states", states,
                  "write pose and velocity of every body, a line per body and frame, the start "
                  "first; world axes, - for stdout")
      ->check(named());
  command
      .add_option("--joints", joints,
                  "write force and torque of every joint on its body a, a line per joint and "
                  "frame: of the frame's last sub-step, about the anchor on a, world axes, at "
                  "force_time")
      ->check(named());
}

void RunFiles::check(const std::string& scene) const {
  keep_apart(by_flag(*this), {scene_path(scene)});
}

bool RunFiles::take_standard_output() const {
  const auto files = by_flag(*this);
  return std::any_of(files.begin(), files.end(),
                     [](const auto& f) { return is_standard_output(f.second); });
}

bool RunOutputs::open(const RunFiles& files) {
  return csv_.open(files.csv) && json_.open(files.json) && states_.open(files.states) &&
         joints_.open(files.joints);
}

void RunOutputs::begin(const Simulator& simulator, const FrameReport& start) {
  const Scene& scene = simulator.scene();
  columns_ = frame_columns(scene);
  if (csv_.is_open()) csv_.write(csv_header(columns_));
  if (json_.is_open()) json_.write(json_head(simulator, start));
  if (states_.is_open()) states_.write(states_header() + states_lines(scene, simulator.state()));
  if (joints_.is_open()) joints_.write(joints_header());
  for (Output* lines : {&csv_, &states_, &joints_}) lines->keep_if_ended();
  json_.keep_if_ended("\n  ],\n  \"cancelled\": true\n}\n");
}

void RunOutputs::add(const Simulator& simulator, const FrameReport& frame) {
  const Scene& scene = simulator.scene();
  const FrameView view{scene, frame, simulator.state()};
  if (csv_.is_open()) csv_.write(csv_line(columns_, view));
  if (json_.is_open()) {
    json_.write(separator_ + json_line(columns_, view));
    separator_ = ",\n    ";
  }
  if (states_.is_open()) states_.write(states_lines(scene, simulator.state()));
  if (joints_.is_open()) {
    joints_.write(joints_lines(scene, simulator.state(), simulator.constraint_forces()));
  }
}

bool RunOutputs::failed() const {
  return csv_.failed() || json_.failed() || states_.failed() || joints_.failed();
}

bool RunOutputs::end(const Simulator& simulator, const Measure& measure) {
  if (json_.is_open()) {
    json_.write_last(json_tail(measure.metrics(simulator.scene(), simulator.state())));
  }
  const bool csv = csv_.close();
  const bool json = json_.close();
  const bool states = states_.close();
  const bool joints = joints_.close();
  return csv && json && states && joints;
}

}  // namespace substep::cli

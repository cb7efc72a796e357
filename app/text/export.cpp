#include "app/text/export.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "core/forces/applied_forces.hpp"

namespace substep {
namespace {

struct Column {
  Channel channel;
  std::string_view name;
  bool Effects::*effect;  // null: always present
};

constexpr std::array<Column, static_cast<std::size_t>(Channel::kCount)> kColumns{
    {{Channel::kSubsteps, "substeps", nullptr},
     {Channel::kMean, "substeps_mean", nullptr},
     {Channel::kLimit, "substeps_least", nullptr},
     {Channel::kKinetic, "kinetic", nullptr},
     {Channel::kPotential, "potential", nullptr},
     {Channel::kElastic, "springs", nullptr},
     {Channel::kTotal, "energy", nullptr},
     {Channel::kPutIn, "energy_put_in", nullptr},
     {Channel::kDrift, "energy_drift", nullptr},
     {Channel::kJointError, "constraint_error", &Effects::joints},
     {Channel::kJointGap, "joint_gap", &Effects::joints},
     {Channel::kPenetration, "penetration", &Effects::contact},
     {Channel::kTime, "ms", nullptr},
     {Channel::kTimeSolve, "ms_solve", nullptr},
     {Channel::kTimeJoints, "ms_joints", &Effects::joints},
     {Channel::kTimeContact, "ms_contact", &Effects::contact},
     {Channel::kTimeFriction, "ms_friction", &Effects::friction},
     {Channel::kTimeStiffness, "ms_stiffness", nullptr}}};

// As many digits as a float sample has.
std::string number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.8g", value);
  return text.data();
}

// A name as one CSV field, quoted.
std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    text += c;
    if (c == '"') text += c;
  }
  return text + '"';
}

// Samples of the potential are relative to the start; the file has absolute values.
double value_of(const History& history, Channel channel, std::size_t i) {
  const auto value = static_cast<double>(history[channel][i]);
  const bool counted = channel == Channel::kPotential || channel == Channel::kTotal;
  return counted ? value + history.potential_at_start() : value;
}

}  // namespace

std::string history_csv(const Scene& scene, std::span<const ExportedRun> runs,
                        std::span<const Channel> channels, double from) {
  std::vector<Column> columns;
  for (const Column& column : kColumns) {
    const bool wanted =
        std::find(channels.begin(), channels.end(), column.channel) != channels.end();
    if (column.channel == Channel::kPotential && !has_applied_forces(scene.effects)) continue;
    const auto springs = [](const ExportedRun& run) { return run.history->has_springs(); };
    if (column.channel == Channel::kElastic && std::none_of(runs.begin(), runs.end(), springs)) {
      continue;
    }
    if (wanted && (!column.effect || scene.effects.*column.effect)) columns.push_back(column);
  }
  const bool named = runs.size() > 1;
  std::string csv = named ? "run,frame,time" : "frame,time";
  for (const Column& column : columns) csv.append(",").append(column.name);
  csv += '\n';
  for (const ExportedRun& run : runs) {
    const History& history = *run.history;
    const std::string name = named ? quoted(run.name) + ',' : "";
    for (std::size_t i = 0; i < history.size(); ++i) {
      const double time = history.time(i);
      if (time <= from && from > history.start_time()) continue;
      csv += name + std::to_string(std::llround(time / history.frame())) + ',' + number(time);
      for (const Column& column : columns) {
        csv.append(",").append(number(value_of(history, column.channel, i)));
      }
      csv += '\n';
    }
  }
  return csv;
}

}  // namespace substep

#pragma once
// Experiments as text: an id, JSON and a command line, all lossless.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/io/json.hpp"
#include "core/lab/experiment.hpp"
#include "core/model/problem.hpp"
#include "core/model/range.hpp"

namespace substep {

inline constexpr int kMostSeed = 1'000'000;
inline constexpr Range kLoadRange{1e-6, 1e6};

/// Hash of the scene's content: bodies, joints, contact, gravity, criteria. Excludes texts, camera
/// and verdict table, which do not affect a run, and settings, which belong to the experiment. 0 if
/// write_scene() cannot write it.
std::uint64_t scene_hash(const Scene& scene);

/// An experiment on a scene with the scene's duration.
Experiment experiment_of(const Scene& scene, const Settings& settings, int seed = 0);

/// 16 hexadecimal digits, machine-independent. Settings at their default are excluded, so that new
/// settings do not change existing ids.
std::string experiment_id(const Experiment& experiment);

std::string hex_text(std::uint64_t value);

/// {"id": ..., "scene": ..., "scene_hash": ..., "settings": {...}, "seconds": 10,
/// "load": 1, "seed": 0}
Json experiment_json(const Experiment& experiment);

/// Finds a scene by its name, or null.
using SceneFinder = std::function<std::shared_ptr<const Scene>(const std::string& name)>;

struct ExperimentInput {
  std::optional<Experiment> experiment;  // nothing if there are problems
  std::shared_ptr<const Scene> scene;
};
/// Reads the output of experiment_json. Only "scene" is required: settings and seconds default to
/// the scene's; id and hash are checked if present.
ExperimentInput read_experiment(const Json& json, const SceneFinder& find, Problems& problems);

/// "substep run swinging_box --alpha 0.05 --seconds 10": the same run on the command line.
std::string command_line(const Experiment& experiment, const Scene& scene);

}  // namespace substep

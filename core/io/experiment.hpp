#pragma once
// Experiments as text: an id, JSON and a command line, all of which come back to the same bits.

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

/// Hash of what the scene holds: bodies, joints, contact, gravity, criteria. Not of words, camera,
/// verdict table and settings, which make no other run or are the experiment's own.
std::uint64_t scene_hash(const Scene& scene);

/// The experiment of a scene with the scene's own duration.
Experiment experiment_of(const Scene& scene, const Settings& settings, int seed = 0);

/// 16 hexadecimal digits, the same on every machine. Settings that stand at their default do not
/// enter, so that a setting added later leaves the ids of before.
std::string experiment_id(const Experiment& experiment);

std::string hex_text(std::uint64_t value);

/// {"id": ..., "scene": ..., "scene_hash": ..., "settings": {...}, "seconds": 10,
/// "load": 1, "seed": 0}
Json experiment_json(const Experiment& experiment);

/// Finds a scene by its name, or null.
using SceneFinder = std::function<std::shared_ptr<const Scene>(const std::string& name)>;

struct ExperimentInput {
  std::optional<Experiment> experiment;  // nothing where there are problems
  std::shared_ptr<const Scene> scene;
};
/// Reads what experiment_json writes. Only "scene" must be there: settings and seconds that are
/// left out are the scene's own; id and hash are checked where they are given.
ExperimentInput read_experiment(const Json& json, const SceneFinder& find, Problems& problems);

/// "substep run swinging_box --alpha 0.05 --seconds 10": the same run on the command line.
std::string command_line(const Experiment& experiment, const Scene& scene);

}  // namespace substep

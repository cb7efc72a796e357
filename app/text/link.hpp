#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/io/experiment.hpp"
#include "core/model/scene.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// The experiment as a URL fragment, without '#': "scene=bridge&solver=pgs&...". The main settings
/// are always included; others only if they differ from the scene's own.
std::string make_link(const Scene& scene, const Settings& settings);

/// The same with duration, load and seed if they differ from the defaults.
std::string make_link(const Scene& scene, const Experiment& experiment);

struct LinkPart {
  std::string key;
  std::string value;
};
/// The parts of a fragment, with or without '#', percent-decoded. Accepts any text.
std::vector<LinkPart> parse_link(std::string_view fragment);

/// The experiment in a fragment; missing parts come from the scene. Ignores keys that are not part
/// of an experiment.
ExperimentInput read_experiment_link(std::string_view fragment, const SceneFinder& find,
                                     Problems& problems);

}  // namespace substep

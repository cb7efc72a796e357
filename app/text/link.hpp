#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/io/experiment.hpp"
#include "core/model/scene.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// The experiment as the fragment of an address, without '#': "scene=bridge&solver=pgs&...". What
/// people ask for first is always there; other settings where they differ from the scene's own.
std::string make_link(const Scene& scene, const Settings& settings);

/// The same with duration, load and seed, where they are not the scene's own.
std::string make_link(const Scene& scene, const Experiment& experiment);

struct LinkPart {
  std::string key;
  std::string value;
};
/// The parts of a fragment, with or without '#', percent signs decoded. Takes any text.
std::vector<LinkPart> parse_link(std::string_view fragment);

/// The experiment of a fragment: what it leaves out is the scene's own. Keys that are no part of an
/// experiment are left alone.
ExperimentInput read_experiment_link(std::string_view fragment, const SceneFinder& find,
                                     Problems& problems);

}  // namespace substep

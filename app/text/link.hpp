#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/lab/experiment.hpp"
#include "core/model/scene.hpp"

namespace substep {

/// The experiment as a URL fragment, without '#': "scene=bridge&solver=pgs&...". The main settings
/// are always included; other settings, duration, load and seed only if they differ from the
/// scene's own.
std::string make_link(const Scene& scene, const Experiment& experiment);

struct LinkPart {
  std::string key;
  std::string value;
};
/// The parts of a fragment, with or without '#', percent-decoded. Accepts any text.
std::vector<LinkPart> parse_link(std::string_view fragment);

}  // namespace substep

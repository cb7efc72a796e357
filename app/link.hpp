#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/model/scene.hpp"
#include "core/model/settings.hpp"

namespace substep {

/// The experiment as the fragment of an address, without '#': "scene=bridge&solver=pgs&...". What
/// people ask for first is always there; other settings where they differ from the scene's own.
std::string make_link(const Scene& scene, const Settings& settings);

struct LinkPart {
  std::string key;
  std::string value;
};
/// The parts of a fragment, with or without '#', percent signs decoded. Takes any text.
std::vector<LinkPart> parse_link(std::string_view fragment);

}  // namespace substep

#pragma once
// The settings in which one run differs from another.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/settings.hpp"

namespace substep {

/// One setting that differs from the reference run, as spelt in links.
struct Override {
  std::string key;
  std::string value;
  friend bool operator==(const Override&, const Override&) = default;
};
using Overrides = std::vector<Override>;

inline constexpr std::size_t kMostCompared = 3;  // runs beside the session itself

/// What sets `of` apart from `from`; settings that only affect the display are ignored.
Overrides differences(const Settings& of, const Settings& from);
Settings with_overrides(Settings settings, const Overrides& overrides);

/// "mode:none;mode:damping,alpha:0.2": the runs of a comparison as links spell them.
std::string overrides_text(const std::vector<Overrides>& runs);
/// Parses such text; at most kMostCompared runs. @param problem error message, or ""
std::vector<Overrides> parse_overrides(std::string_view text, std::string& problem);
/// The overrides as a title, without settings that the run does not read: "no sub-steps, PGS"; "the
/// same" if there are none. @param session the settings to which they are applied
std::string overrides_title(const Overrides& overrides, const Settings& session);

}  // namespace substep

#include "app/shell/level.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "app/lab/lab.hpp"
#include "core/model/setting_fields.hpp"

namespace substep {
namespace {

// What Explore shows, and what is looked at and not done.
constexpr std::array<std::string_view, 6> kExplored{"solver", "mode",  "alpha",
                                                    "n",      "n_cap", "watch_stiffness"};

}  // namespace

bool needs_lab(const Lab& lab) {
  if (lab.seed != 0) return true;
  return std::ranges::any_of(setting_fields(), [&](const SettingField& field) {
    const bool explored = std::ranges::find(kExplored, field.name) != kExplored.end();
    return !explored && setting_text(field, lab.session.settings()) !=
                            setting_text(field, lab.session.loaded().settings);
  });
}

}  // namespace substep

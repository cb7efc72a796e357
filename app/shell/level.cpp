#include "app/shell/level.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "app/lab/lab.hpp"
#include "core/model/setting_fields.hpp"

namespace substep {
namespace {

// Settings shown in Explore, and display-only settings.
constexpr std::array<std::string_view, 6> kExplored{"solver", "mode",  "alpha",
                                                    "n",      "n_cap", "watch_stiffness"};

}  // namespace

bool needs_lab(const Lab& lab) {
  if (lab.seed != 0) return true;
  const Settings& now = lab.session.settings();
  const Settings& own = lab.session.loaded().settings;
  const auto fields = setting_fields();
  return std::any_of(fields.begin(), fields.end(), [&](const SettingField& field) {
    const bool explored =
        std::find(kExplored.begin(), kExplored.end(), field.name) != kExplored.end();
    return !explored && setting_text(field, now) != setting_text(field, own);
  });
}

}  // namespace substep

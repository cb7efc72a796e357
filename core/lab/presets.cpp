#include "core/lab/presets.hpp"

#include <algorithm>
#include <array>

#include "core/model/format_text.hpp"
#include "core/model/methods.hpp"
#include "core/model/problem.hpp"

namespace substep {
namespace {

constexpr std::string_view kRecommended = "recommended";

/// "0.858 mm", "1 m", "3.1 J"
std::string error_text(double error, ErrorAxis of) {
  const bool small = of != ErrorAxis::kEnergy && error < 0.1;
  const char* unit = of == ErrorAxis::kEnergy ? "J" : small ? "mm" : "m";
  return format_text("%.3g %s", small ? 1e3 * error : error, unit);
}

/// "86.9 thousand"
std::string count_text(double count) {
  if (count >= 1e6) return format_text("%.3g million", 1e-6 * count);
  if (count >= 1e3) return format_text("%.3g thousand", 1e-3 * count);
  return format_text("%.3g", count);
}

constexpr std::array<const char*, kCountOf<ErrorAxis>> kNouns{"the path", "energy",
                                                              "gaps of joints", "overlaps"};

/// "For this scene: keeps the path within 1 mm for 8.5 thousand solver operations per frame,
/// over 10 s. The cheapest of ..."
std::string about(const Recommended& r) {
  std::string text = "For this scene: keeps " +
                     std::string(kNouns[static_cast<std::size_t>(r.of)]) + " within " +
                     error_text(r.within, r.of) + format_text(" over %g s, for ", r.seconds) +
                     count_text(r.operations) + " solver operations per frame.";
  if (!r.why.empty()) text += " " + r.why;
  return text;
}

}  // namespace

std::span<const Preset> presets() {
  static const std::array all{
      Preset{"paper", "As in the paper: adaptive, alpha 0.1, N decided once per frame.",
             kPaperSettings},
      Preset{kRecommended,
             "Up to four sub-steps, then damping: holds 48 of the 49 hard scenes at 15 % of the "
             "operations of 32 constant sub-steps; damps motions slightly.",
             PaperSettings{.mode = Mode::kCapped, .n_cap = 4}},
      Preset{"robust",
             "Newton's method, implicit, with four sub-steps: holds all 49 hard scenes at three "
             "quarters of the operations of 32 constant sub-steps; damps motions slightly.",
             PaperSettings{.solver = SolverKind::kNewton, .mode = Mode::kConst, .n = 4}},
      Preset{"steady",
             "The default of scenes without settings. Adaptive without a gain of energy: leapfrog, "
             "joints that hold exactly, an N that falls after a second only, frames taken again "
             "where it was too small, contacts found along the motion, and isotropic friction.",
             {}},
  };
  return all;
}

std::vector<Preset> presets_for(const Scene& scene) {
  std::vector<Preset> all(presets().begin(), presets().end());
  for (Preset& preset : all) {
    preset.settings = settings_for(preset, scene);
    if (preset.name == kRecommended && scene.recommended) preset.about = about(*scene.recommended);
  }
  return all;
}

const Preset* find_preset(std::string_view name) {
  const auto found = std::find_if(presets().begin(), presets().end(),
                                  [&](const Preset& preset) { return preset.name == name; });
  return found == presets().end() ? nullptr : &*found;
}

Settings settings_for(const Preset& preset, const Scene& scene) {
  return preset.name == kRecommended && scene.recommended ? scene.recommended->settings
                                                          : preset.settings;
}

std::string preset_names() {
  std::vector<std::string_view> names;
  for (const Preset& preset : presets()) names.push_back(preset.name);
  return one_of(names);
}

}  // namespace substep

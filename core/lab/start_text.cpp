#include "core/lab/start_text.hpp"

#include <vector>

#include "core/lab/verdict.hpp"
#include "core/model/format_text.hpp"
#include "core/stepping/compliance.hpp"

namespace substep {
namespace {

std::string short_text(double value, const char* unit) {
  return format_text("%.3g %s", value, unit);
}

std::string length_text(double metres) {
  if (metres >= 1.0) return short_text(metres, "m");
  if (metres >= 1e-2) return short_text(1e2 * metres, "cm");
  if (metres >= 1e-3) return short_text(1e3 * metres, "mm");
  if (metres >= 1e-6) return short_text(1e6 * metres, "um");
  return short_text(1e9 * metres, "nm");
}

std::string gap_text(double gap) { return "open by " + length_text(gap); }
std::string tilt_text(double tilt) { return "tilted by " + short_text(tilt, "rad"); }
std::string speed_text(double speed) { return "moving apart at " + short_text(speed, "m/s"); }
std::string turning_text(double turning) {
  return "rotating across its axis at " + short_text(turning, "rad/s");
}

// Prints both energies: their difference may be a small part of either.
std::string energy_text(double energy) { return format_text("%.6g J", energy); }

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text;
}

}  // namespace

std::string fault_text(const JointStart& start) {
  std::vector<std::string> parts;
  if (start.beyond.gap) parts.push_back(gap_text(start.gap));
  if (start.beyond.tilt) parts.push_back(tilt_text(start.tilt));
  if (start.beyond.speed) parts.push_back(speed_text(start.speed));
  if (start.beyond.turning) parts.push_back(turning_text(start.turning));
  return joined(parts);
}

std::string start_text(const Scene& scene, const StartReport& report) {
  const StartErrors& found = report.found;
  if (found.consistent() || report.continued) return "";
  std::vector<std::string> parts;
  const auto add = [&](bool beyond, int joint, const std::string& what) {
    if (!beyond) return;
    const std::string& name = base(scene.joints[index(joint)]).name;
    parts.push_back((parts.empty() ? "joint '" : "'") + name + "' " + what);
  };
  add(found.beyond.gap, found.gap_joint, gap_text(found.gap));
  add(found.beyond.tilt, found.tilt_joint, tilt_text(found.tilt));
  add(found.beyond.speed, found.speed_joint, speed_text(found.speed));
  add(found.beyond.turning, found.turning_joint, turning_text(found.turning));
  std::string text = "The start was inconsistent: " + joined(parts);
  const std::string energy = energy_text(report.energy_found);
  if (report.projected) {
    return text + "; projected. Energy " + energy + " before, " + energy_text(report.energy_begun) +
           " after.";
  }
  if (report.too_large) {
    text += "; kept, as the scene is too large to project.";
  } else {
    text += report.failed ? "; no start nearby closes the joints, so it is kept." : "; kept.";
  }
  return text + " Energy " + energy + ".";
}

std::string overlap_text(const Scene& scene, const Settings& settings, const FrameReport& start) {
  constexpr double kLeast = 1e-3;  // of the width
  if (start.inside_a < 0 || !(start.inside > kLeast) || is_soft(scene.contact)) return "";
  const auto name = [&](int body) { return "'" + scene.bodies[index(body)].name + "'"; };
  return name(start.inside_a) + " and " + name(start.inside_b) + " overlap by " +
         length_text(start.inside * smaller_width(scene, start.inside_a, start.inside_b)) +
         (settings.detection == Detection::kContinuous
              ? " at the start; they are parted without speed."
              : " at the start; their correction adds speed (detection continuous: none).");
}

}  // namespace substep

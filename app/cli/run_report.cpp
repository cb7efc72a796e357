#include "app/cli/run_report.hpp"

#include <algorithm>
#include <cinttypes>

#include "core/io/experiment.hpp"
#include "core/lab/energy_scale.hpp"
#include "core/lab/experiment.hpp"
#include "core/model/format_text.hpp"
#include "core/model/names.hpp"
#include "core/model/number_text.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep::cli {

RunReport::RunReport(const Scene& scene, const FrameReport& start)
    : scene_(scene), energy_at_start_(start.energy), last_(start) {}

void RunReport::add(const FrameReport& report) {
  last_ = report;
  capped_frames_ += report.capped ? 1 : 0;
  substeps_of_a_body_ += report.n_mean;
  lowered_ += report.lowered;
  lowered_to_ = std::min(lowered_to_, report.lowered_to);
  most_asleep_ = std::max(most_asleep_, report.asleep);
  has_islands_ = has_islands_ || report.islands > 0;
}

std::string RunReport::energy_text() const {
  const double change = last_.energy - energy_at_start_;
  // Only relative to an energy stated in the scene: the energy exchanged in this run is not known
  // yet.
  const auto& stated = scene_.criteria.energy_scale;
  const auto scale = stated ? energy_scale(stated, 0.0, 0.0) : std::nullopt;
  const auto share = energy_share(change, scale);
  if (!share) return format_text("%+.6g J", change);
  return format_text("%+.3g %% of %g J", 100.0 * *share, *scale);
}

std::string RunReport::progress(std::int64_t frames) const {
  const double done =
      frames > 0 ? 100.0 * static_cast<double>(last_.frame) / static_cast<double>(frames) : 100.0;
  std::string line =
      format_text("%3.0f %%  %7.2f s  %3d sub-steps", done, last_.time, last_.n_substeps);
  line += "  energy " + energy_text();
  if (scene_.effects.joints) line += format_text("  gap %.1e m", last_.joint_gap);
  return line;
}

std::string RunReport::summary(const Metrics& metrics) const {
  const Work& work = metrics.work;
  const auto frames = static_cast<double>(work.frames);
  std::string text;
  text += format_text("time         %.3f s in %" PRId64 " frames\n", last_.time, last_.frame);
  if (work.frames > 0) {
    text += format_text("sub-steps    %" PRId64 "; %d / %d / %d per frame (least, median, most)\n",
                        work.substeps, work.n_min, work.n_median, work.n_max);
  }
  if (has_islands_) {
    text += format_text("per body     %.3g sub-steps per frame on average\n",
                        substeps_of_a_body_ / frames);
  }
  if (most_asleep_ > 0) text += format_text("asleep       %d bodies at most\n", most_asleep_);
  if (capped_frames_ > 0) text += format_text("capped       %" PRId64 " frames\n", capped_frames_);
  text += "energy       " + energy_text() + "\n";
  if (const auto& gap = metrics.errors.joint_gap) {
    text += format_text("joint gap    %.2e m at most\n", gap->peak);
  }
  if (const auto& overlap = metrics.errors.penetration) {
    text += format_text("penetration  %.2e m at most\n", overlap->peak);
  }
  if (lowered_ > 0) {
    text += format_text(
        "restitution  lowered %d times, to %.2g of e at the least: Newton's law "
        "would add energy\n",
        lowered_, lowered_to_);
  }
  if (work.substeps > 0) {
    const double computing = metrics.timing.stages.total;
    text +=
        format_text("computing    %.3f s; %.3f ms per frame, %.1f us per sub-step\n", computing,
                    1e3 * computing / frames, 1e6 * computing / static_cast<double>(work.substeps));
  }
  return text + "state hash   " + hex_text(metrics.hash) + "\n";
}

std::string settings_line(const Settings& s) {
  std::string line = solver_text(s);
  line += ", ";
  line += name_of(s.mode);
  if (reads(s, "n")) line += " " + std::to_string(s.n);
  if (reads(s, "n_cap")) line += " at " + std::to_string(s.n_cap);
  if (reads(s, "alpha")) line += ", alpha " + number_text(s.alpha);
  if (reads(s, "alpha_m")) line += ", alpha_m " + number_text(s.alpha_m);
  if (reads(s, "beta")) line += ", beta " + number_text(s.beta);
  if (reads(s, "policy")) {
    line += s.policy == Policy::kFrame ? ", decided per frame" : ", decided per sub-step";
    if (s.islands) line += " for each island";
    if (!s.rotation_criterion) line += ", without the rotation criterion";
  }
  line += ", ";
  line += name_of(s.integrator);
  line += ", drift ";
  line += name_of(drift_law(s));
  if (s.drift_order == 2) line += " of second order";
  if (s.friction_cone == FrictionCone::kCone) line += ", friction cone";
  return line;
}

}  // namespace substep::cli

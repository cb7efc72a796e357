// The energy plots: the parts and their sum, and the gain or loss of the sum.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/text/format.hpp"
#include "app/ui/plot_headings.hpp"
#include "app/ui/plots.hpp"
#include "app/ui/widgets.hpp"
#include "core/forces/applied_forces.hpp"
#include "core/lab/energy_scale.hpp"

namespace substep::ui {
namespace {

// Smaller values are rounding errors in the scenes' energies [J].
constexpr double kLeastEnergy = 1e-6;
constexpr double kLeastDrift = 1e-9;

// A run that exploded may leave the plot, so that the others stay readable.
constexpr double kRoomForFailed = 1.5;

/// The largest value over this run and those compared with it; failed runs count only if all
/// failed.
double largest_of_stable(const PlotContext& in, double (History::*largest)() const) {
  double stable = 0.0;
  double any = (in.session.history().*largest)();
  if (in.session.verdict().holds()) stable = any;
  for (const Compare::Run& run : in.compare.runs()) {
    const double one = (run.history.*largest)();
    any = std::max(any, one);
    if (run.verdict->holds()) stable = std::max(stable, one);
  }
  return stable > 0.0 ? stable : any;
}

/// "0.85", "12.3", ">999": a value in the unit of the heading.
std::string in_unit(double value, const Unit& unit, double most, int digits) {
  const double v = value / unit.factor;
  if (std::abs(v) > most) return (v > 0.0 ? ">" : "<−") + fixed(most, 0);
  return fixed(v, std::abs(v) < 9.95 ? digits : std::abs(v) < 99.5 ? digits - 1 : 0);
}

void compared_energies(const PlotContext& in, ImVec2 at, const std::string& heading,
                       Channel channel, const Unit& unit) {
  compared_values(
      in, at, heading, channel, [&](double joules) { return in_unit(joules, unit, 9999.0, 2); },
      [&](double joules) { return in_unit(joules, unit, 99.0, 1); });
}

}  // namespace

std::vector<Series> energy_series(const Theme& theme, const History& history, bool gravity) {
  const double zero = history.potential_offset();
  std::vector<Series> series{{&history, Channel::kKinetic, theme.teal, "kinetic", false, true}};
  if (!gravity) return series;  // the total is identical
  series.push_back(
      {&history, Channel::kPotential, theme.purple, "potential", false, false, 1.0F, zero});
  series.push_back({&history, Channel::kTotal, theme.orange, "total", false, false, 1.5F, zero});
  return series;
}

void energy_plot(const PlotContext& in) {
  const Look& look = in.look;
  const Theme& t = *look.theme;
  const History& h = in.session.history();
  const bool gravity = has_applied_forces(in.session.scene().effects);
  const bool several = in.compare.open();
  const double zero = h.potential_offset();
  double most = largest_of_stable(in, &History::largest_kinetic);
  if (!several && gravity) {  // parting overlaps and gains raise the total
    most = std::max({most, zero, largest_of_stable(in, &History::largest_drift)});
  }
  const Unit unit = unit_for(std::max(most, kLeastEnergy));
  const std::string heading = (several ? "Kinetic, " : "Energy, ") + unit.prefix + "J";

  const ImVec2 origin = ImGui::GetCursorScreenPos();
  section(look, heading);
  PlotSpec spec{.id = "energy",
                .linear = true,  // sums are only visible on a linear axis
                .least_span = std::max(unit.factor, kLeastEnergy),
                .factor = unit.factor};
  if (several) {
    tooltip(look, "Kinetic energy", "Of each run. A run that explodes leaves the plot.");
    compared_energies(in, origin, heading, Channel::kKinetic, unit);
    spec.most = kRoomForFailed * most;
    add_runs(in, spec, Channel::kKinetic);
  } else {
    tooltip(
        look, "Energy",
        gravity
            ? "Kinetic + potential = total, on one scale. The potential energy of gravity is zero "
              "near its lowest value; the zero stays when the run fails. Where energy is conserved "
              "the total is a flat line; the plot of the drift shows changes too small to see here."
            : "Kinetic energy. There is no gravity, so it is also the total.");
    std::vector<HeadingValue> values;
    const auto add = [&](const std::string& name, Channel channel, ImU32 color, double offset) {
      const double joules = shown_value(h, channel, in.desk.time) + offset;
      const bool known = std::isfinite(joules);
      const std::string number = known ? in_unit(joules, unit, 9999.0, 2) : name;
      values.push_back({color, known ? name + " " + number : name, number});
    };
    if (gravity) {
      add("total", Channel::kTotal, t.orange, zero);
      add("pot.", Channel::kPotential, t.purple, zero);
    }
    add("kin.", Channel::kKinetic, t.teal, 0.0);
    heading_values(look, origin, heading, values);
    spec.series = energy_series(t, h, gravity);
  }
  draw_plot(in, Plot::kEnergy, std::move(spec));
}

void drift_plot(const PlotContext& in) {
  const Look& look = in.look;
  const Theme& t = *look.theme;
  const History& h = in.session.history();
  const bool several = in.compare.open();
  const double most = largest_of_stable(in, &History::largest_drift);
  const Unit unit = unit_for(std::max(most, kLeastDrift));
  const std::string heading = (several ? "Drift, " : "Energy drift, ") + unit.prefix + "J";
  const auto scale = energy_scale(in.session.scene().criteria.energy_scale, h.largest_kinetic(),
                                  h.largest_drift());
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const double now = shown_value(h, Channel::kDrift, in.desk.time);
  const bool named = !several && std::isfinite(now);
  section(look, heading, named ? energy_change(now, scale) : "");
  tooltip(look, "Energy drift",
          "The change of the total energy since the start, on its own scale; ideally zero. "
          "Friction, impacts and damping remove energy. The percentage is of the energy "
          "that the motion exchanges; a scene at rest exchanges none, and has no percentage.");
  PlotSpec spec{.id = "drift",
                .linear = true,  // a loss is negative
                .least_span = std::max(0.1 * unit.factor, kLeastDrift),
                .factor = unit.factor};
  if (several) {
    compared_energies(in, origin, heading, Channel::kDrift, unit);
    spec.most = kRoomForFailed * most;
    add_runs(in, spec, Channel::kDrift);
  } else {
    spec.series.push_back({&h, Channel::kDrift, t.orange, "drift"});
  }
  draw_plot(in, Plot::kDrift, std::move(spec));
}

}  // namespace substep::ui

// The energy plots: the parts and their sum, and the gain or loss of the sum.

#include <algorithm>
#include <cmath>
#include <optional>
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

/// For values up to a size; before the first sample without a prefix.
Unit unit_of(double most, double least) {
  return unit_for(most > 0.0 ? std::max(most, least) : 1.0);
}

/// "0.85", "12.3", ">999": a value in the unit of the heading.
std::string in_unit(double value, const Unit& unit, double most, int digits) {
  const double v = value / unit.factor;
  if (std::abs(v) > most) return (v > 0.0 ? ">" : "<−") + fixed(most, 0);
  return fixed(v, std::abs(v) < 9.95 ? digits : std::abs(v) < 99.5 ? digits - 1 : 0);
}

/// Where the potential energy is zero.
std::string zero_text(double at_start) {
  if (at_start == 0.0) return "The potential energy is zero at the start. ";
  const Unit unit = unit_for(at_start);
  return "The potential energy is " + short_number(at_start / unit.factor) + " " + unit.prefix +
         "J at the start, the energy that the scene's file gives for this motion. ";
}

/// Moments at which the user began to put energy into the run, and how much.
std::vector<Mark> marks_of_work(const History& history, const TimeAxis& axis, ImU32 color) {
  std::vector<Mark> marks;
  const auto work = history[Channel::kPutIn];
  const auto [t0, t1] = axis.window(history.end_time());
  const History::Slice slice = history.between(t0, t1);
  std::size_t began = 0;  // of the change in progress, if any
  bool changing = false;
  for (std::size_t i = slice.first; i < slice.last; ++i) {
    const float before = i == 0 ? 0.0F : work[i - 1];
    if (work[i] != before && !changing) began = i;
    changing = work[i] != before;
    if (!changing) continue;
    const double change = static_cast<double>(work[i] - (began == 0 ? 0.0F : work[began - 1]));
    if (began != i) marks.pop_back();
    if (!marks.empty()) marks.back().name.clear();  // room for one name
    marks.push_back({history.time(began), energy_change(change), color});
  }
  return marks;
}

/// "−29.8 J (−0.058 %), you +10.7 kJ", as much of it as there is room for.
std::string drift_text(const Look& look, const std::string& heading, double drift,
                       std::optional<double> scale, double put_in) {
  const std::string whole = energy_change(drift, scale);
  if (put_in == 0.0) return whole;
  const std::string work = ", you " + energy_change(put_in);
  const float room = ImGui::GetContentRegionAvail().x - heading_width(look, heading) - 8.0F;
  const bool fits = text_size(look.fonts.small, whole + work).x <= room;
  return (fits ? whole : energy_change(drift)) + work;
}

void compared_energies(const PlotContext& in, ImVec2 at, const std::string& heading,
                       Channel channel, const Unit& unit) {
  compared_values(
      in, at, heading, channel, [&](double joules) { return in_unit(joules, unit, 9999.0, 2); },
      [&](double joules) { return in_unit(joules, unit, 99.0, 1); });
}

}  // namespace

std::vector<Series> energy_series(const Theme& theme, const History& history, bool gravity) {
  const double zero = gravity ? history.potential_offset() : 0.0;
  const bool springs = history.has_springs();
  std::vector<Series> series{{&history, Channel::kKinetic, theme.teal, "kinetic", false, true}};
  if (!gravity && !springs) return series;  // the total is identical
  if (gravity) {
    series.push_back(
        {&history, Channel::kPotential, theme.purple, "potential", false, false, 1.0F, zero});
  }
  if (springs) {
    series.push_back({&history, Channel::kElastic, theme.amber, "elastic", false, false, 1.0F});
  }
  series.push_back({&history, Channel::kTotal, theme.orange, "total", false, false, 1.5F, zero});
  return series;
}

void energy_plot(const PlotContext& in) {
  const Look& look = in.look;
  const Theme& t = *look.theme;
  const History& h = in.session.history();
  // A potential that was switched off stays in the sum.
  const bool gravity = has_applied_forces(in.session.scene().effects) ||
                       has_applied_forces(in.session.loaded().effects);
  const bool several = in.compare.open();
  const double zero = gravity ? h.potential_offset() : 0.0;
  const bool springs = h.has_springs();
  double most = largest_of_stable(in, &History::largest_kinetic);
  if (!several && gravity) {  // parting overlaps and gains raise the total
    most = std::max({most, zero, largest_of_stable(in, &History::largest_potential),
                     largest_of_stable(in, &History::largest_drift)});
  }
  const Unit unit = unit_of(most, kLeastEnergy);
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
    const std::string elastic = springs ? " + elastic" : "";
    tooltip(
        look, "Energy",
        gravity
            ? "Kinetic + potential" + elastic + " = total, on one scale. " + zero_text(zero) +
                  "Where energy is conserved the total is a flat line; the plot of the drift shows "
                  "changes too small to see here. A throw, a pull or a change of the scene moves "
                  "the total by the work done."
        : springs ? std::string("Kinetic + elastic = total, on one scale. There is no gravity.")
                  : std::string("Kinetic energy. There is no gravity, so it is also the total."));
    std::vector<HeadingValue> values;  // from the right
    const auto add = [&](const std::string& name, Channel channel, ImU32 color, double offset) {
      const double joules = shown_value(h, channel, in.desk.time) + offset;
      const bool known = std::isfinite(joules);
      const std::string number = known ? in_unit(joules, unit, 9999.0, 2) : name;
      values.push_back({color, known ? name + " " + number : name, number});
    };
    if (gravity || springs) add("total", Channel::kTotal, t.orange, zero);
    if (springs) add("el.", Channel::kElastic, t.amber, 0.0);
    if (gravity) add("pot.", Channel::kPotential, t.purple, zero);
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
  const Unit unit = unit_of(most, kLeastDrift);
  const std::string heading = (several ? "Drift, " : "Energy drift, ") + unit.prefix + "J";
  const auto scale = energy_scale(in.session.scene().criteria.energy_scale, h.largest_kinetic(),
                                  h.largest_drift());
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const double now = shown_value(h, Channel::kDrift, in.desk.time);
  const bool named = !several && std::isfinite(now);
  const double put_in = shown_value(h, Channel::kPutIn, in.desk.time);
  const bool by_user = named && put_in != 0.0;
  section(look, heading, named ? drift_text(look, heading, now, scale, put_in) : "");
  tooltip(look, "Energy drift",
          "The change of the total energy since the start that is not the user's work, on its own "
          "scale; ideally zero. Friction, impacts and damping remove energy; motors, drives "
          "and constant torques can add it. The percentage is of the energy that the motion "
          "exchanges; a scene at "
          "rest exchanges none, and has no percentage." +
              (by_user ? " Your work so far: " + energy_change(put_in) +
                             ", by balls, pulls and changes of the scene. While a body is held, "
                             "every change counts as yours."
                       : std::string()));
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
    spec.marks = marks_of_work(h, in.desk.time, t.amber);
  }
  draw_plot(in, Plot::kDrift, std::move(spec));
}

}  // namespace substep::ui

#pragma once
// The plots of the panel, and what all of them are drawn with.

#include <optional>

#include "app/lab/compare.hpp"
#include "app/lab/session.hpp"
#include "app/ui/desk.hpp"
#include "app/ui/plot.hpp"

namespace substep::ui {

/// What plots show and may change: a click goes to its moment of the run.
struct PlotContext {
  const Look& look;
  Session& session;
  const Compare& compare;
  Desk& desk;
};

/// What the curve of the run itself is called beside those compared with it.
inline constexpr const char* kThisRun = "this run";

/// Adds the others of a comparison, in the colours that they have in the picture, and marks where
/// they diverge from this run.
void add_compared(const PlotContext& in, PlotSpec& spec, Channel channel, bool steps = false);

/// Draws a plot over the width of the window, with the time that is looked at; a click goes there.
/// @param height of the curves, without the labels of the time
void draw_plot(const PlotContext& in, Plot which, const PlotSpec& spec, float height);

/// Kinetic, potential and total energy on one scale: at every sample the first two make the third.
/// In a comparison the kinetic energy of each run.
void energy_plot(const PlotContext& in, float height, bool last);
/// The change of the total energy since the start, on a scale of its own.
void drift_plot(const PlotContext& in, float height, bool last);

/// The smallest constant N that would have been stable so far: N at alpha = 1 of the stiffest
/// frame. Nothing where it would mislead: where N does not vary, where more than small steps keeps
/// the run stable, and with a solver that sweeps, which needs more sub-steps than its stiffness
/// says.
std::optional<int> smallest_stable_n(const History& history, const Settings& settings);

/// The curves of the energy plot where nothing is compared, potential and total counted from the
/// lowest potential so far.
std::vector<Series> energy_series(const Theme& theme, const History& history, bool gravity);

}  // namespace substep::ui

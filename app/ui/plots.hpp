#pragma once
// The plots of the panel, and their common context.

#include <optional>

#include "app/lab/compare.hpp"
#include "app/lab/session.hpp"
#include "app/ui/desk.hpp"
#include "app/ui/plot.hpp"

namespace substep::ui {

/// Data of a plot; a click on it seeks the session.
struct PlotContext {
  const Look& look;
  Session& session;
  const Compare& compare;
  Desk& desk;
  float height;  // of the curves, without the time labels
  bool last;     // the time labels are below it
};

/// Adds this run and the compared ones, in the same colours as in the picture, and marks where they
/// diverge from this run.
void add_runs(const PlotContext& in, PlotSpec& spec, Channel channel, bool steps = false);

/// Draws a plot over the width of the window, with the current time; a click seeks to its time.
void draw_plot(const PlotContext& in, Plot which, PlotSpec spec);

/// Kinetic, potential, elastic and total energy on one scale; the first three add up to the last.
/// In a comparison, the kinetic energy of each run.
void energy_plot(const PlotContext& in);
/// The change of the total energy since the start without the user's work, on its own scale.
void drift_plot(const PlotContext& in);

/// N at alpha = 1, the limit of stability by the criterion, of the stiffest frame so far: 7 for the
/// swinging box, which needs as many constant sub-steps, and 17 for the bridge, which holds with 7.
/// Empty if it would mislead: if N is constant, if something besides small steps keeps the run
/// stable, or with an iterative solver, which needs more sub-steps than its stiffness indicates.
std::optional<int> n_at_limit(const History& history, const Settings& settings);

/// The curves of the energy plot without a comparison; potential and total have the zero of
/// History::potential_offset().
std::vector<Series> energy_series(const Theme& theme, const History& history, bool gravity);

}  // namespace substep::ui

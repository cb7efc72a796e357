// The plots panel: time series per frame.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "app/text/export.hpp"
#include "app/text/format.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/plot_headings.hpp"
#include "app/ui/plots.hpp"
#include "app/ui/timing.hpp"
#include "app/ui/widgets.hpp"
#include "core/model/names.hpp"
#include "core/stepping/substep_clock.hpp"

namespace substep::ui {

void add_runs(const PlotContext& in, PlotSpec& spec, Channel channel, bool steps) {
  spec.series.push_back(
      {&in.session.history(), channel, in.look.theme->blue, "this run", steps, false});
  // Labelled once: the plots are stacked on the same time axis.
  const bool named = channel == Channel::kSubsteps || !in.desk.plot(Plot::kSubsteps).shown;
  for (std::size_t i = 0; i < in.compare.runs().size(); ++i) {
    const Compare::Run& run = in.compare.runs()[i];
    const ImU32 color = compare_color(in.look, i);
    spec.series.push_back({&run.history, channel, color,
                           overrides_title(run.overrides, in.session.settings()), steps, false,
                           1.25F});
    if (run.divergence) spec.marks.push_back({run.divergence->time, named ? "differs" : "", color});
  }
}

void draw_plot(const PlotContext& in, Plot which, PlotSpec spec) {
  spec.time_labels = in.last;
  const float below = spec.time_labels ? kTimeLabelHeight : 0.0F;
  plot(in.look, spec, in.session.history().end_time(),
       {ImGui::GetContentRegionAvail().x, in.height + below}, in.desk.time, in.desk.plot(which));
  if (in.desk.time.clicked) {
    in.session.go_to(in.session.timeline().at_time(*in.desk.time.clicked));
    in.desk.time.clicked.reset();
  }
}

std::optional<int> n_at_limit(const History& history, const Settings& settings) {
  const bool varies = settings.mode == Mode::kAdaptive;
  if (!varies || entry_of(settings.solver).sweeps) return std::nullopt;
  const Extent least = history.samples(Channel::kLimit).extent(0, history.size());
  if (least.empty() || !(least.high > 1.0F)) return std::nullopt;
  return static_cast<int>(std::min(1e9F, std::ceil(least.high)));
}

namespace {

constexpr float kLeastPlot = 46.0F;  // four of them fit into a window of 720

// A scene without constraints has no plot of errors.
bool exists(const Session& session, Plot plot) {
  const Effects& effects = session.scene().effects;
  return plot != Plot::kError || effects.joints || effects.contact;
}

void substeps_plot(const PlotContext& in) {
  const Look& look = in.look;
  const Theme& t = *look.theme;
  const History& h = in.session.history();
  const Settings& s = in.session.settings();
  const bool several = in.compare.open();
  count_heading(in, "Sub-steps per frame", "Sub-steps", Channel::kSubsteps, "N = ", "",
                [](double v) { return fixed(v, 0); });
  tooltip(look, "Sub-steps per frame",
          "The N of each frame (Eq. 11). Dashed: N at alpha = 1, where the criterion puts the "
          "limit of stability, of the stiffest frame so far. The swinging box needs that many "
          "constant sub-steps; the bridge holds with 7 where the line is at 17. It is known only "
          "after the run, and less accurate than the N of a smaller alpha. With islands: the "
          "largest N of an island, and the mean of the bodies.");

  PlotSpec spec{.id = "substeps", .counts = true, .least_span = 4.0};
  const bool islands = !several && looks_for_islands(s);
  if (several) {
    add_runs(in, spec, Channel::kSubsteps, true);
  } else {
    spec.series.push_back({&h, Channel::kSubsteps, t.blue, islands ? "most" : "N", true, true});
  }
  if (islands) spec.series.push_back({&h, Channel::kMean, t.teal, "mean", true});
  if (const auto n = n_at_limit(h, s); n && !several) {
    spec.levels.push_back({static_cast<double>(*n), "Limit (α = 1): N = " + grouped(*n),
                           "α = 1: N = " + grouped(*n), t.amber});
  }
  // A cap is drawn once N comes near it.
  const int cap = reads(s, "n_max") ? s.n_max : reads(s, "n_cap") ? s.n_cap : 0;
  const std::size_t recent = h.size() - std::min<std::size_t>(h.size(), 600);
  const Extent taken = h.samples(Channel::kSubsteps).extent(recent, h.size());
  if (cap > 0 && taken.high >= 0.7F * static_cast<float>(cap)) {
    spec.levels.push_back({static_cast<double>(cap), "cap " + std::to_string(cap), "", t.orange});
  }
  draw_plot(in, Plot::kSubsteps, std::move(spec));
}

void error_plot(const PlotContext& in) {
  const Look& look = in.look;
  const Theme& t = *look.theme;
  const History& h = in.session.history();
  const Effects& effects = in.session.scene().effects;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  section(look, "Error, m");
  tooltip(
      look, "Constraint error",
      "Joints: the sum of |phi| of joint rows, springs excepted. Overlap: the deepest contact.");
  PlotSpec spec{.id = "error", .least_span = 1e-9};
  if (in.compare.open()) {
    const Channel channel = effects.joints ? Channel::kJointError : Channel::kPenetration;
    compared_values(in, origin, "Error, m", channel, coarse_number, order_of_magnitude);
    add_runs(in, spec, channel);
  } else {
    std::vector<HeadingValue> values;
    const auto add = [&](Channel channel, const std::string& name, ImU32 color) {
      const double v = shown_value(h, channel, in.desk.time);
      const bool known = std::isfinite(v);
      values.push_back({color, known ? name + " " + coarse_number(v) : name,
                        known ? name + " " + order_of_magnitude(v) : name});
      spec.series.push_back({&h, channel, color, name});
    };
    if (effects.contact) add(Channel::kPenetration, "overlap", t.amber);
    if (effects.joints) add(Channel::kJointError, "joint sum", t.blue);
    heading_values(look, origin, "Error, m", values);
  }
  draw_plot(in, Plot::kError, std::move(spec));
}

void time_plot(const PlotContext& in) {
  const Look& look = in.look;
  const History& h = in.session.history();
  const bool several = in.compare.open();
  count_heading(in, "Time per frame, ms", "Time, ms", Channel::kTime, "", " ms",
                [](double v) { return fixed(v, 2); });
  tooltip(look, "Time per frame",
          "Wall time of the simulation per frame: the total in grey, its stages in the colours of "
          "the list below.");
  PlotSpec spec{.id = "time", .least_span = 0.01};
  if (several) {
    add_runs(in, spec, Channel::kTime);
  } else {
    spec.series.push_back({&h, Channel::kTime, look.theme->grey, "all", false, true});
    for (const Stage& stage : stages(in.look, in.session)) {
      if (stage.channel == Channel::kTime) continue;
      spec.series.push_back({&h, stage.channel, stage.color, stage.name, false, false, 1.0F});
    }
  }
  draw_plot(in, Plot::kTime, std::move(spec));
}

// A plot of the panel, with the channels that it exports. A new plot is a function and a line here.
struct PlotInfo {
  Plot plot;
  const char* name;
  void (*draw)(const PlotContext& in);
  std::span<const Channel> channels;
};
constexpr std::array kSubstepChannels{Channel::kSubsteps, Channel::kMean, Channel::kLimit};
constexpr std::array kEnergyChannels{Channel::kKinetic, Channel::kPotential, Channel::kElastic,
                                     Channel::kTotal};
constexpr std::array kDriftChannels{Channel::kPutIn, Channel::kDrift};
constexpr std::array kErrorChannels{Channel::kJointError, Channel::kJointGap,
                                    Channel::kPenetration};
constexpr std::array kTimeChannels{Channel::kTime,         Channel::kTimeSolve,
                                   Channel::kTimeJoints,   Channel::kTimeContact,
                                   Channel::kTimeFriction, Channel::kTimeStiffness};
constexpr std::array<PlotInfo, static_cast<std::size_t>(Plot::kCount)> kPlots{
    {{Plot::kSubsteps, "Sub-steps per frame", substeps_plot, kSubstepChannels},
     {Plot::kEnergy, "Energy", energy_plot, kEnergyChannels},
     {Plot::kDrift, "Energy drift", drift_plot, kDriftChannels},
     {Plot::kError, "Error and overlap", error_plot, kErrorChannels},
     {Plot::kTime, "Time by stage", time_plot, kTimeChannels}}};

std::vector<const PlotInfo*> shown_plots(const Session& session, Desk& desk) {
  std::vector<const PlotInfo*> shown;
  // A tour step has chosen its plots at either level.
  const bool explore = desk.level == DeskLevel::kExplore && desk.tour < 0;
  for (const PlotInfo& info : kPlots) {
    const bool wanted = explore ? info.plot == Plot::kSubsteps || info.plot == Plot::kEnergy
                                : exists(session, info.plot) && desk.plot(info.plot).shown;
    if (wanted) shown.push_back(&info);
  }
  return shown;
}

// File name of this run, without an extension.
std::string file_stem(const Session& session) {
  return session.scene().name + "-" + std::string(name_of(session.settings().mode));
}

std::string span_name(double seconds) {
  return seconds < 9.95 ? plain_number(seconds) + " s" : fixed(seconds, 0) + " s";
}

void span_menu(const Look& look, Desk& desk, float width) {
  TimeAxis& time = desk.time;
  menu_button(look, "span", span_name(time.span), width, look.m.row,
              "Time range of the plots (wheel on a plot)", [&] {
                for (const double span : {2.0, 5.0, 10.0, 30.0, 60.0, 200.0, 600.0}) {
                  if (menu_item(look, span_name(span), "", span == time.span)) {
                    time.span = span;
                    time.follow = true;
                  }
                }
              });
}

float plot_gap(const Look& look) { return 0.75F * look.m.section; }

// @param height of each, without headings and time labels
void stack_of_plots(const Look& look, Lab& lab, Desk& desk,
                    const std::vector<const PlotInfo*>& shown, float height) {
  for (const PlotInfo* info : shown) {
    if (info != shown.front()) space(plot_gap(look));
    info->draw({look, lab.session, lab.compare, desk, height, info == shown.back()});
  }
}

void save_menu(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport) {
  icon_menu(look, "save", Icon::kSave, ButtonKind::kPlain, look.m.row, "Save the run or a picture",
            [&] {
              const std::string name = file_stem(lab.session);
              const ImVec2 display = ImGui::GetIO().DisplaySize;
              if (menu_item(look, "Run as a table", "CSV")) save_table(lab, desk);
              if (menu_item(look, "Plots", "PNG")) {
                desk.capture = {name + "-plots.png", desk.plots_area};
              }
              for (const double width : kFigureWidths) {
                if (!menu_item(look, "Plots and settings, " + fixed(width, 0) + " mm", "SVG")) {
                  continue;
                }
                desk.figure = {name + "-plots.svg", width,
                               [&](const Look& paper) { plots_figure(paper, lab, desk); }};
              }
              if (menu_item(look, "View", "PNG")) {
                desk.capture = {name + "-view.png", viewport.view_rect};
              }
              if (menu_item(look, "Window", "PNG")) {
                desk.capture = {name + ".png", {0.0F, 0.0F, display.x, display.y}};
              }
            });
}

// Toolbar above the plots: which plots, and the time span.
void toolbar(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport) {
  TimeAxis& time = desk.time;
  const float row = look.m.row;
  const float width = ImGui::GetContentRegionAvail().x;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  if (button(look, "follow", time.follow ? Icon::kHold : Icon::kFollow, "", ButtonKind::kPlain, row,
             row,
             time.follow ? "Hold the plots; the run continues"
                         : "Follow the run again (double click on a plot)")) {
    if (time.follow) {
      time.end = time.window(lab.session.history().end_time()).second;
      time.follow = false;
    } else {
      time.follow_again();
    }
  }
  ImGui::SameLine(0.0F, 8.0F);
  span_menu(look, desk, 84.0F);
  ImGui::SetCursorScreenPos({origin.x + width - 3.0F * row - 16.0F, origin.y});
  icon_menu(look, "which", Icon::kList, ButtonKind::kPlain, row, "Which plots are shown", [&] {
    for (const PlotInfo& info : kPlots) {
      PlotState& state = desk.plot(info.plot);
      if (exists(lab.session, info.plot) && menu_item(look, info.name, "", state.shown)) {
        state.shown = !state.shown;
      }
    }
  });
  ImGui::SameLine(0.0F, 8.0F);
  save_menu(look, lab, desk, viewport);
  ImGui::SameLine(0.0F, 8.0F);
  const bool hidden = time.from > lab.session.history().start_time();
  if (button(look, "clear", hidden ? Icon::kUndo : Icon::kSweep, "", ButtonKind::kPlain, row, row,
             hidden ? "Show the hidden past again" : "Hide what is before now")) {
    time.from = hidden ? 0.0 : lab.session.history().end_time();
    time.follow = true;
  }
}

}  // namespace

void plots_figure(const Look& look, Lab& lab, Desk& desk) {
  constexpr float kHeight = 88.0F;
  stack_of_plots(look, lab, desk, shown_plots(lab.session, desk), kHeight);
}

void save_table(const Lab& lab, Desk& desk) {
  if (!lab.host.save_file) return;
  std::vector<Channel> channels;
  for (const PlotInfo* info : shown_plots(lab.session, desk)) {
    channels.insert(channels.end(), info->channels.begin(), info->channels.end());
  }
  std::vector<ExportedRun> runs{{file_stem(lab.session), &lab.session.history()}};
  for (const Compare::Run& run : lab.compare.runs()) {
    runs.push_back({overrides_title(run.overrides, lab.session.settings()), &run.history});
  }
  lab.host.save_file(file_stem(lab.session) + ".csv",
                     history_csv(lab.session.scene(), runs, channels, desk.time.from));
}

void plots(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport, float height) {
  // All of the same height, the last with the time labels below.
  const bool tools = desk.level == DeskLevel::kLab;
  if (tools) toolbar(look, lab, desk, viewport);
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const std::vector<const PlotInfo*> shown = shown_plots(lab.session, desk);
  const auto count = static_cast<float>(shown.size());
  const float above = tools ? look.m.row + 8.0F : 0.0F;
  const float rest =
      height - above - count * kHeading - (count - 1.0F) * plot_gap(look) - kTimeLabelHeight;
  // Values at the cursor belong to the picture shown, also in the past.
  desk.time.past.reset();
  if (!lab.session.timeline().at_end()) desk.time.past = lab.session.state().time;
  stack_of_plots(look, lab, desk, shown,
                 std::floor(std::max(rest / std::max(count, 1.0F), kLeastPlot)));
  if (shown.empty()) {
    label(look.fonts.small, look.theme->dim, "Every plot is hidden: the list above shows them.");
  }
  desk.plots_area = {from.x - 8.0F, from.y - 4.0F, width + 16.0F,
                     ImGui::GetCursorScreenPos().y - from.y + 4.0F};
}

}  // namespace substep::ui

// "What does accuracy cost?": the sweep of all methods over this scene, and its picture.

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "app/format.hpp"
#include "app/ui/accuracy_picture.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/stability_map.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr std::array<const char*, static_cast<std::size_t>(ErrorAxis::kCount)> kErrorNames{
    "Path", "Energy", "Gap", "Overlap"};
constexpr std::array<Choice, static_cast<std::size_t>(CostAxis::kCount)> kCosts{
    {{"Sub-steps", "Counted, per frame"},
     {"Operations", "Of the solver, counted, per frame: the same on every machine"},
     {"Time", "Median of a frame on this machine, while everything else runs"}}};

/// A button to start or to stop, and how far it is.
void sweep_bar(App& app) {
  const Look& look = app.look;
  Accuracy& accuracy = app.accuracy;
  const float width = ImGui::GetContentRegionAvail().x;
  if (!accuracy.running()) {
    const bool again = !accuracy.results().empty();
    if (button(look, "sweep", Icon::kPlay, again ? "Run it again" : "Run all methods",
               again ? ButtonKind::kPlain : ButtonKind::kPrimary, width, look.m.row + 4.0F,
               "Every method over this scene from its start, in the background")) {
      accuracy.start(app.plain_scene);
    }
    return;
  }
  if (progress(look, accuracy.progress(), "The results so far stay")) accuracy.cancel();
}

std::string state_text(const Accuracy& accuracy) {
  const auto& results = accuracy.results();
  const auto failed = std::count_if(results.begin(), results.end(),
                                    [](const Result& r) { return !r.metrics.holds; });
  std::string text = std::to_string(results.size()) + " of " + std::to_string(accuracy.planned()) +
                     " runs, " + std::to_string(failed) + " failed";
  if (accuracy.running() && accuracy.reference() == nullptr) return "Finding the reference …";
  if (accuracy.cancelled()) return text + ", cancelled";
  const double left = accuracy.seconds_left();
  if (accuracy.running() && left >= 0.0) text += ", about " + fixed(left, 0) + " s left";
  return text;
}

void axes_row(App& app) {
  const Look& look = app.look;
  Accuracy& accuracy = app.accuracy;
  std::vector<Choice> names;
  std::vector<ErrorAxis> axes;
  int current = 0;
  for (std::size_t i = 0; i < kErrorNames.size(); ++i) {
    const auto axis = static_cast<ErrorAxis>(i);
    if (!accuracy.has(axis)) continue;
    if (axis == accuracy.error) current = static_cast<int>(axes.size());
    axes.push_back(axis);
    names.push_back({kErrorNames[i], axis_name(axis)});
  }
  if (axes.size() > 1 && segmented_row(look, "Error", names, current, "What goes up")) {
    accuracy.error = axes[static_cast<std::size_t>(current)];
  }
  int cost = static_cast<int>(accuracy.cost);
  if (segmented_row(look, "Cost", kCosts, cost, "What goes to the right")) {
    accuracy.cost = static_cast<CostAxis>(cost);
  }
}

bool shows_map(const Accuracy& accuracy) {
  return accuracy.picture == AccuracyPicture::kStabilityMap;
}

/// Which picture; the map only of scenes that have one.
void picture_row(App& app) {
  std::vector<Choice> names{{"Error", "Error against cost, a curve for every method"}};
  std::vector<AccuracyPicture> pictures{AccuracyPicture::kErrorAgainstCost};
  if (app.accuracy.has_map()) {
    names.push_back({"Map", "How long runs survive as the mass of the heaviest body varies"});
    pictures.push_back(AccuracyPicture::kStabilityMap);
  }
  names.push_back({"Stages", "Where the time of a frame goes: stages, effects, the criterion"});
  pictures.push_back(AccuracyPicture::kEffectCosts);
  const auto now = std::find(pictures.begin(), pictures.end(), app.accuracy.picture);
  auto current = static_cast<int>(now - pictures.begin());
  if (segmented_row(app.look, "Show", names, current, "Which picture of what accuracy costs")) {
    app.accuracy.picture = pictures[static_cast<std::size_t>(current)];
  }
}

/// The map, or the picture with the name of what goes up; a click on a run runs it.
void picture(App& app, ImVec2 size) {
  if (shows_map(app.accuracy)) {
    if (const auto chosen = stability_map(app.look, app.accuracy, size.x)) {
      app.run_result(app.accuracy.results()[*chosen]);
    }
    return;
  }
  label(app.look.fonts.small, app.look.theme->dim, axis_name(app.accuracy.error));
  if (const auto chosen = accuracy_picture(app.look, app.accuracy, app.session.settings(), size)) {
    app.run_result(app.accuracy.results()[*chosen]);
  }
}

/// "0.82 mm", "3.1 J"
std::string error_text(double error, ErrorAxis axis) {
  const Unit unit = unit_for(error);
  return coarse_number(error / unit.factor) + " " + unit.prefix +
         (axis == ErrorAxis::kEnergy ? "J" : "m");
}

std::string cost_text(double cost, CostAxis axis) {
  switch (axis) {
    case CostAxis::kSubsteps:
      return short_number(cost) + " sub-steps a frame";
    case CostAxis::kOperations:
      return short_number(cost) + " operations a frame";
    default:
      return duration(1e-3 * cost) + " a frame";
  }
}

constexpr std::array<Choice, 2> kGiven{{{"an error", "The cheapest setting that keeps within it"},
                                        {"a cost", "The most exact setting that keeps within it"}}};
constexpr std::array<const char*, static_cast<std::size_t>(CostAxis::kCount)> kBudgetNames{
    "Sub-steps", "Operations", "Time, ms"};

/// A slider by the exponent: Dear ImGui's logarithmic ones end at what their format prints as zero.
void limit_slider(const Look& look, const char* name, double least, double most, double& value,
                  const char* tip) {
  double exponent = std::log10(value);
  if (slider(look, name, exponent, std::min(exponent, std::log10(least)),
             std::max(exponent, std::log10(most)), false, "10^%.1f", tip)) {
    value = std::pow(10.0, exponent);
  }
}

/// What is wanted, and how much of it.
void wanted(const Look& look, Accuracy& accuracy, const std::vector<Accuracy::Point>& points) {
  int given = accuracy.error_is_given ? 0 : 1;
  if (segmented_row(look, "Given", kGiven, given, "What is wanted; the other is looked for")) {
    accuracy.error_is_given = given == 0;
  }
  const auto limits = [&](double CostAndError::*member) {
    const auto [least, most] =
        std::minmax_element(points.begin(), points.end(),
                            [&](const auto& p, const auto& q) { return p.*member < q.*member; });
    return std::pair((*least).*member, (*most).*member);
  };
  if (accuracy.error_is_given) {
    const auto [least, most] = limits(&CostAndError::error);
    limit_slider(look, accuracy.error == ErrorAxis::kEnergy ? "Error, J" : "Error, m", least, most,
                 accuracy.wanted.at(static_cast<std::size_t>(accuracy.error)),
                 "The error that is wanted at most. What holds it at the least cost is below");
  } else {
    const auto cost = static_cast<std::size_t>(accuracy.cost);
    const auto [least, most] = limits(&CostAndError::cost);
    limit_slider(look, kBudgetNames.at(cost), least, most, accuracy.budget.at(cost),
                 "What a frame may cost at most. What comes nearest for it is below");
  }
}

/// "1 mm", "0.05 ms a frame": what is wanted at most.
std::string limit_text(const Accuracy& accuracy) {
  if (accuracy.error_is_given) {
    return error_text(accuracy.wanted.at(static_cast<std::size_t>(accuracy.error)), accuracy.error);
  }
  return cost_text(accuracy.budget.at(static_cast<std::size_t>(accuracy.cost)), accuracy.cost);
}

/// What the alpha came to that was found for the limit.
std::string found_text(const Accuracy& accuracy, const AlphaSearch& search) {
  const std::string within = " alpha within " + limit_text(accuracy);
  if (!search.choice()) {
    return "The paper's method: no alpha from " + plain_number(AlphaSearch::kLeast) +
           " to 1 keeps within " + limit_text(accuracy) + ".";
  }
  const auto& [alpha, result] = *search.choice();
  const std::string found = std::string("The paper's ") +
                            (accuracy.error_is_given ? "largest" : "smallest") + within + " is " +
                            coarse_number(alpha) + ": ";
  const auto error = error_of(result, accuracy.error);
  if (!result.metrics.holds || !error) return found + result.metrics.verdict + ".";
  return found + error_text(*error, accuracy.error) + " for " +
         cost_text(cost_of(result, accuracy.cost), accuracy.cost) + ".";
}

/// The paper's own knob, chosen for what is wanted by whole runs.
void paper_alpha(App& app) {
  const Look& look = app.look;
  Accuracy& accuracy = app.accuracy;
  const AlphaSearch* search = accuracy.alpha_search();
  if (!search) {
    if (accuracy.reference() != nullptr &&
        button(look, "find_alpha", Icon::kNone, "Find the paper's alpha", ButtonKind::kGhost, 0.0F,
               look.m.row,
               "Between the values of its curve: by halving, each try a whole run of the scene")) {
      accuracy.search_alpha();
    }
    return;
  }
  if (!search->done()) {
    label(look.fonts.small, look.theme->dim,
          ("Run " + std::to_string(search->runs()) + ", alpha = " + coarse_number(search->alpha()))
              .c_str());
    if (progress(look, search->progress(), "What was found so far is given up")) {
      accuracy.cancel_search();
    }
    return;
  }
  label(look.fonts.small, look.theme->dim, found_text(accuracy, *search).c_str());
  if (search->choice() &&
      button(look, "found_alpha", Icon::kPlay, "Run with this alpha", ButtonKind::kPlain, 0.0F,
             look.m.row, "This scene from its start with the paper's method and this alpha")) {
    app.run_result(Result(search->choice()->result));
  }
}

/// How the paper's method stands beside it.
std::string beside_paper(const Accuracy& accuracy, const std::vector<Accuracy::Point>& points,
                         const Accuracy::Point& best) {
  const auto paper = accuracy.best(of_paper(points, accuracy.results()));
  if (!paper) return "The paper's method does not get there.";
  const double alpha = accuracy.results()[paper->result].experiment.settings.alpha;
  if (paper->result == best.result) return "It is the paper's.";
  const std::string with = "The paper's method, with alpha = " + plain_number(alpha) + ", ";
  return accuracy.error_is_given
             ? with + "takes " + coarse_number(paper->cost / best.cost) + " times that."
             : with + "comes to " + error_text(paper->error, accuracy.error) + ".";
}

/// The cheapest setting within an error or the most exact within a cost, with the reason, and a
/// button that runs it.
void advice(App& app) {
  const Look& look = app.look;
  Accuracy& accuracy = app.accuracy;
  const std::vector<Accuracy::Point> points = accuracy.points();
  if (points.size() < 2) return;
  section(look, "What to set");
  wanted(look, accuracy, points);
  const auto best = accuracy.best(points);
  if (!best) {
    label(look.fonts.small, look.theme->dim,
          ("No method keeps within " + limit_text(accuracy) + ".").c_str());
    paper_alpha(app);
    space(8.0F);
    return;
  }
  const Result& result = accuracy.results()[best->result];
  const Settings& s = result.experiment.settings;
  const CurveStyle style = curve_style(*look.theme, s);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_swatch(style, look.theme->panel | IM_COL32_A_MASK, draw, {at.x + 14.0F, at.y + 10.0F});
  draw_text(
      draw, look.fonts.medium, {at.x + 36.0F, at.y + 2.0F}, look.theme->text,
      fitted(look.fonts.medium, style.name, ImGui::GetContentRegionAvail().x - 36.0F).c_str());
  ImGui::Dummy({1.0F, 18.0F});
  const SeriesParameter parameter = series_parameter(s);
  const std::string reason =
      std::string("With ") + parameter.name + " = " + plain_number(parameter.value) + " within " +
      limit_text(accuracy) + ": " + error_text(best->error, accuracy.error) + " for " +
      cost_text(best->cost, accuracy.cost) + ". " + beside_paper(accuracy, points, *best);
  label(look.fonts.small, look.theme->dim, reason.c_str());
  if (button(look, "cheapest", Icon::kPlay, "Run it", ButtonKind::kPlain, 0.0F, look.m.row,
             "This scene from its start with this method")) {
    app.run_result(Result(result));
  }
  // What a scene keeps is counted in operations: the same on every machine.
  if (accuracy.error_is_given && accuracy.cost == CostAxis::kOperations) {
    ImGui::SameLine(0.0F, 8.0F);
    if (button(look, "keep", Icon::kNone, "Keep for this scene", ButtonKind::kGhost, 0.0F,
               look.m.row,
               "A copy of the scene among your own that starts with it, and has it as the preset "
               "recommended")) {
      app.keep(*recommended_of(accuracy.results(), accuracy.error,
                               accuracy.wanted.at(static_cast<std::size_t>(accuracy.error))));
    }
  }
  paper_alpha(app);
  space(8.0F);
}

/// Who is who, and how many of each hold.
void picture_legend(const App& app) {
  const Look& look = app.look;
  struct Mark {
    CurveStyle style;
    int runs = 0;
    int held = 0;
  };
  std::map<std::string, Mark> entries;
  std::vector<std::string> order;
  for (const Result& result : app.accuracy.results()) {
    if (result.experiment.load != 1.0) continue;
    const Settings& s = result.experiment.settings;
    const auto [entry, is_new] =
        entries.try_emplace(series_name(s), Mark{curve_style(*look.theme, s)});
    if (is_new) order.push_back(entry->first);
    ++entry->second.runs;
    entry->second.held += result.metrics.holds ? 1 : 0;
  }
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float width = ImGui::GetContentRegionAvail().x;
  for (const std::string& name : order) {
    const Mark& entry = entries.at(name);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    draw_swatch(entry.style, look.theme->panel | IM_COL32_A_MASK, draw,
                {at.x + 14.0F, at.y + 8.0F});
    const std::string held =
        std::to_string(entry.held) + " of " + std::to_string(entry.runs) + " hold";
    const float note = text_size(look.fonts.small, held.c_str()).x;
    draw_text(draw, look.fonts.small, {at.x + 36.0F, at.y + 1.0F}, look.theme->text,
              fitted(look.fonts.small, entry.style.name, width - note - 44.0F).c_str());
    draw_text(draw, look.fonts.small, {at.x + width - note, at.y + 1.0F},
              entry.held == entry.runs ? look.theme->dim : look.theme->orange, held.c_str());
    ImGui::Dummy({1.0F, 12.0F});
  }
}

}  // namespace

void accuracy(App& app) {
  const Look& look = app.look;
  Accuracy& accuracy = app.accuracy;
  section(look, "What does accuracy cost?");
  picture_row(app);
  if (accuracy.picture == AccuracyPicture::kEffectCosts) {
    effect_costs(app);
    return;
  }
  const bool other = accuracy.scene() && accuracy.scene() != app.plain_scene;
  if (accuracy.planned() == 0 || other) {
    label(look.fonts.small, look.theme->dim,
          other ? "The picture below is of another scene."
                : "Every method along its own parameter: how wrong it is, and what it costs. The "
                  "picture grows while they run; a click on a point runs it.");
    space(8.0F);
  }
  sweep_bar(app);
  if (accuracy.planned() == 0) return;
  label(look.fonts.small, look.theme->dim, state_text(accuracy).c_str());
  space(8.0F);
  if (!shows_map(accuracy)) axes_row(app);
  const float width = ImGui::GetContentRegionAvail().x;
  if (!app.desk.accuracy_large) picture(app, {width, std::clamp(1.05F * width, 240.0F, 460.0F)});
  if (ImGui::GetIO().DisplaySize.x >= 900.0F &&
      button(look, "larger", app.desk.accuracy_large ? Icon::kNone : Icon::kFrame,
             app.desk.accuracy_large ? "Back into the panel" : "Larger", ButtonKind::kGhost, 0.0F,
             look.m.row, "The picture over the view")) {
    app.desk.accuracy_large = !app.desk.accuracy_large;
  }
  if (shows_map(accuracy)) {
    label(
        look.fonts.small, look.theme->dim,
        ("To the right the mass ratio, heaviest to lightest body, by the mass of the heaviest. A "
         "cell tells when the run fails, in seconds, the paler the later; blue ones hold for all " +
         plain_number(accuracy.experiments().front().duration) + " s.")
            .c_str());
    return;
  }
  advice(app);
  if (const Reference* reference = accuracy.reference()) {
    label(look.fonts.small, look.theme->dim,
          ("Measured from: " + reference->source + ", uncertain by " +
           coarse_number(reference->uncertainty) + " m, over " + plain_number(reference->window) +
           " s. The band is the Pareto front.")
              .c_str());
  }
  space(8.0F);
  picture_legend(app);
}

void accuracy_card(App& app) {
  if (!app.desk.accuracy_large || app.desk.tab != Tab::kAccuracy || !app.desk.panels ||
      app.accuracy.planned() == 0 || app.accuracy.picture == AccuracyPicture::kEffectCosts) {
    return;
  }
  constexpr float kAround = 16.0F;
  constexpr float kCaption = 76.0F;  // what runs is named at the top of the view
  const ViewRect& v = app.view_rect;
  const ImVec2 size(v.width - 2.0F * kAround, std::min(v.height - kCaption - kAround, 620.0F));
  ImGui::SetNextWindowPos({v.x + kAround, v.y + kCaption});
  ImGui::SetNextWindowSize(size);
  if (ImGui::Begin("##accuracy", nullptr,
                   ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                       ImGuiWindowFlags_NoScrollbar)) {
    const ImVec2 room = ImGui::GetContentRegionAvail();
    picture(app, {room.x, room.y - 22.0F});
  }
  ImGui::End();
}

}  // namespace substep::ui

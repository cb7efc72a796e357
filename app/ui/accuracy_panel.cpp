// "What does accuracy cost?": the sweep of all methods over this scene, and its picture.

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/text/format.hpp"
#include "app/ui/accuracy_curves.hpp"
#include "app/ui/curve_style.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr std::array<const char*, static_cast<std::size_t>(ErrorAxis::kCount)> kErrorNames{
    "Path", "Energy", "Gap", "Overlap"};
constexpr std::array<Choice, static_cast<std::size_t>(CostAxis::kCount)> kCosts{
    {{"Sub-steps", "Counted, per frame"},
     {"Operations", "Of the solver, counted, per frame: the same on every machine"},
     {"Time", "Median of a frame on this machine, while everything else runs"}}};

bool sweep_button(const Look& look, Lab& lab, float width) {
  const bool again = !lab.accuracy.results().empty();
  if (!button(look, "sweep", Icon::kPlay, again ? "Run again" : "Run all methods",
              again ? ButtonKind::kPlain : ButtonKind::kPrimary, width, look.m.row,
              "Every method over this scene from its start, in the background, with the times of "
              "this machine")) {
    return false;
  }
  lab.accuracy.start(lab.plain_scene);
  return true;
}

void sweep_progress(const Look& look, Accuracy& accuracy) {
  if (!accuracy.running()) return;
  if (progress(look, accuracy.progress(), "The results so far stay")) accuracy.cancel();
}

std::string state_text(const Accuracy& accuracy) {
  const auto& results = accuracy.results();
  const auto failed = std::count_if(results.begin(), results.end(),
                                    [](const Result& r) { return !r.metrics.holds; });
  std::string text = std::to_string(results.size()) + " of " + std::to_string(accuracy.planned()) +
                     " runs, " + std::to_string(failed) + " failed";
  if (accuracy.shipped()) {
    return std::to_string(results.size()) + " runs of " +
           plain_number(results.front().experiment.duration) + " s, " + std::to_string(failed) +
           " failed. Computed in advance: run again to measure times.";
  }
  if (accuracy.running() && accuracy.effects.running()) return text + ", waits for the stages";
  if (accuracy.running() && accuracy.reference() == nullptr) return "Finding the reference …";
  if (accuracy.cancelled()) return text + ", cancelled";
  if (accuracy.running() && accuracy.searching()) return text + ", waits for the search";
  const double left = accuracy.seconds_left();
  if (accuracy.running() && left >= 0.0) text += ", about " + fixed(left, 0) + " s left";
  return text;
}

void axes_row(const Look& look, Accuracy& accuracy) {
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
  if (axes.size() > 1 &&
      segmented_row(look, "Error", names, current, "Quantity on the vertical axis")) {
    accuracy.error = axes[static_cast<std::size_t>(current)];
  }
  const std::span<const Choice> costs(kCosts);  // the last, the time, is not in files
  choose(look, "Cost", accuracy.shipped() ? costs.first(2) : costs, accuracy.cost,
         "Quantity on the horizontal axis");
}

bool shows_map(const Accuracy& accuracy) {
  return accuracy.picture == AccuracyPicture::kStabilityMap;
}

bool shows_errors(const Accuracy& accuracy) {
  return accuracy.picture == AccuracyPicture::kErrorAgainstCost;
}

/// The choice of picture; the map only for scenes that have one.
void picture_row(const Look& look, Accuracy& accuracy) {
  std::vector<Choice> names{
      {"Find N", "N and error along alpha, and the cheapest method within an error, in seconds"}};
  std::vector<AccuracyPicture> pictures{AccuracyPicture::kFindN};
  names.push_back({"Error", "Error against cost, a curve for every method"});
  pictures.push_back(AccuracyPicture::kErrorAgainstCost);
  names.push_back({"Trade", "Adaptive sub-steps beside the best constant N, chosen in hindsight"});
  pictures.push_back(AccuracyPicture::kFairTrade);
  if (accuracy.has_map()) {
    names.push_back({"Map", "How long runs survive as the mass of the heaviest body varies"});
    pictures.push_back(AccuracyPicture::kStabilityMap);
  }
  names.push_back({"Stages", "Where the time of a frame goes: stages, effects, the criterion"});
  pictures.push_back(AccuracyPicture::kEffectCosts);
  const auto now = std::find(pictures.begin(), pictures.end(), accuracy.picture);
  auto current = static_cast<int>(now - pictures.begin());
  if (segmented(look, "Show", names, current, ImGui::GetContentRegionAvail().x)) {
    accuracy.picture = pictures[static_cast<std::size_t>(current)];
  }
}

/// The map, the trade, or the errors with their vertical axis title; a click on a run starts it.
void picture(const Look& look, Lab& lab, ImVec2 size) {
  std::optional<std::size_t> chosen;
  if (shows_map(lab.accuracy)) {
    chosen = stability_map(look, lab, size.x);
  } else if (lab.accuracy.picture == AccuracyPicture::kFairTrade) {
    chosen = trade_chart(look, lab.accuracy, size.x);
  } else {
    label(look.fonts.small, look.theme->dim, axis_name(lab.accuracy.error));
    chosen = accuracy_picture(look, lab.accuracy, lab.session.settings(), size);
  }
  if (chosen) lab.run_result(lab.accuracy.results()[*chosen]);
}

void other_scene(const Look& look, Lab& lab) {
  if (lab.accuracy.scene() == lab.plain_scene) return;
  label(look.fonts.small, look.theme->dim, "The picture below is of another scene.");
  if (!is_own(*lab.plain_scene) && !lab.accuracy.running() &&
      button(look, "this scene", Icon::kNone, "Show this scene", ButtonKind::kGhost, 0.0F,
             look.m.row, "What was computed in advance for the scene that runs")) {
    lab.accuracy.show_shipped(lab.plain_scene, true);
  }
  space(8.0F);
}

/// Options of the picture: curves, size, saving it, and computing it here.
void picture_buttons(const Look& look, Lab& lab, Desk& desk) {
  Accuracy& accuracy = lab.accuracy;
  if (shows_errors(accuracy)) {
    toggle(look, "All methods", accuracy.all_methods, 0, true,
           "Every curve in its colour, with the list of their names");
  }
  const bool wide = ImGui::GetIO().DisplaySize.x >= 900.0F;
  if (wide) {
    if (shows_errors(accuracy)) ImGui::SameLine(0.0F, 6.0F);
    if (button(look, "larger", desk.accuracy_large ? Icon::kNone : Icon::kFrame,
               desk.accuracy_large ? "Dock" : "Larger", ButtonKind::kGhost, 0.0F, look.m.row,
               "The picture over the view")) {
      desk.accuracy_large = !desk.accuracy_large;
    }
  }
  if (lab.host.save_file) {
    if (shows_errors(accuracy) || wide) ImGui::SameLine(0.0F, 6.0F);
    menu_button(look, "figure", "SVG", 72.0F, look.m.row,
                "Save the picture for a paper, as a vector graphic with its settings inside", [&] {
                  for (const double width : kFigureWidths) {
                    if (!menu_item(look, fixed(width, 0) + " mm wide", "SVG")) continue;
                    desk.figure = {lab.accuracy.scene()->name + "-accuracy.svg", width,
                                   [&](const Look& paper) { accuracy_figure(paper, lab); }};
                  }
                });
  }
  label(look.fonts.small, look.theme->dim, state_text(accuracy));
  if (!accuracy.running()) sweep_button(look, lab, 0.0F);
}

void map_note(const Look& look, const Accuracy& accuracy) {
  label(look.fonts.small, look.theme->dim,
        "A cell shows when the run fails, in seconds; blue cells with a tick are stable for all " +
            plain_number(accuracy.experiments().front().duration) +
            " s. The mass of the heaviest body is varied. Drag over the map to run what you pass.");
}

void error_note(const Look& look, const Accuracy& accuracy) {
  const ReferenceSummary* reference = accuracy.reference();
  if (reference == nullptr) return;
  label(look.fonts.small, look.theme->dim,
        "Measured from: " + reference->source + ", uncertain by " +
            coarse_number(reference->uncertainty) + " m, over " + plain_number(reference->window) +
            " s. The band is the Pareto front. Point at a grey curve for its name.");
  space(8.0F);
}

/// The legend, with the number of stable runs per curve, by solver and integrator.
void picture_legend(const Look& look, const Accuracy& accuracy) {
  struct Mark {
    CurveStyle style;
    int runs = 0;
    int held = 0;
  };
  std::map<std::string, Mark> entries;  // by series
  std::vector<std::vector<const Mark*>> families;
  for (const Result& result : accuracy.results()) {
    if (result.experiment.load != 1.0) continue;
    const Settings& s = result.experiment.settings;
    const auto [entry, is_new] =
        entries.try_emplace(series_name(s), Mark{curve_style(*look.theme, s)});
    Mark& mark = entry->second;
    if (is_new) {
      const auto known = std::find_if(families.begin(), families.end(), [&](const auto& family) {
        return family.front()->style.family == mark.style.family;
      });
      (known == families.end() ? families.emplace_back() : *known).push_back(&mark);
    }
    ++mark.runs;
    mark.held += result.metrics.holds ? 1 : 0;
  }
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float width = ImGui::GetContentRegionAvail().x;
  for (const auto& family : families) {
    const ImVec2 top = ImGui::GetCursorScreenPos();
    draw_text(look.fonts.small, {top.x, top.y + 1.0F}, look.theme->dim,
              family.front()->style.family);
    if (&family == &families.front()) {
      draw_text_before(look.fonts.small, {top.x + width, top.y + 1.0F}, look.theme->dim,
                       "runs that hold");
    }
    ImGui::Dummy({1.0F, 12.0F});
    for (const Mark* entry : family) {
      const ImVec2 at = ImGui::GetCursorScreenPos();
      draw_swatch(entry->style, look.theme->panel | IM_COL32_A_MASK, draw,
                  {at.x + 14.0F, at.y + 8.0F});
      const float left =
          draw_text_before(look.fonts.small, {at.x + width, at.y + 1.0F},
                           entry->held == entry->runs ? look.theme->dim : look.theme->orange,
                           std::to_string(entry->held) + " of " + std::to_string(entry->runs));
      draw_text(look.fonts.small, {at.x + 36.0F, at.y + 1.0F}, look.theme->text,
                fitted(look.fonts.small, entry->style.own_name, left - at.x - 44.0F));
      ImGui::Dummy({1.0F, 12.0F});
    }
    space(10.0F);
  }
}

}  // namespace

void accuracy_figure(const Look& look, Lab& lab) {
  const float width = ImGui::GetContentRegionAvail().x;
  picture(look, lab, {width, std::clamp(0.8F * width, 240.0F, 420.0F)});
}

void accuracy(const Look& look, Lab& lab, Desk& desk) {
  Accuracy& accuracy = lab.accuracy;
  accuracy.show_shipped(lab.plain_scene);
  section(look, "What does accuracy cost?");
  picture_row(look, lab.accuracy);
  if (accuracy.picture == AccuracyPicture::kFindN) return find_n(look, lab);
  // With the error picture the search has a separate place.
  if (accuracy.picture != AccuracyPicture::kErrorAgainstCost) search_bar(look, lab.accuracy);
  if (accuracy.picture == AccuracyPicture::kEffectCosts) {
    if (accuracy.running()) {  // the sweep continues in parallel
      label(look.fonts.small, look.theme->dim, "All methods. " + state_text(accuracy));
      sweep_progress(look, accuracy);
    }
    effect_costs(look, lab);
    return;
  }
  if (accuracy.planned() == 0) {
    label(look.fonts.small, look.theme->dim,
          "Error against cost for every method. Updates live; click a point to run it.");
    space(8.0F);
    sweep_button(look, lab, ImGui::GetContentRegionAvail().x);
    return;
  }
  other_scene(look, lab);
  sweep_progress(look, accuracy);
  if (accuracy.picture == AccuracyPicture::kFairTrade) trade_head(look, lab.accuracy);
  if (shows_errors(accuracy)) {
    label(look.fonts.regular, look.theme->text, conclusion(accuracy, accuracy.points()));
    space(6.0F);
    axes_row(look, lab.accuracy);
  }
  const float width = ImGui::GetContentRegionAvail().x;
  if (!desk.accuracy_large) {
    picture(look, lab, {width, std::clamp(1.05F * width, 240.0F, 460.0F)});
  }
  picture_buttons(look, lab, desk);
  if (shows_map(accuracy)) map_note(look, accuracy);
  if (accuracy.picture == AccuracyPicture::kFairTrade) {
    label(look.fonts.small, look.theme->dim,
          "Euler with BPP. \"Error\" compares all methods, under the scene's own load.");
  }
  if (!shows_errors(accuracy)) return;
  space(8.0F);
  advice(look, lab);
  error_note(look, accuracy);
  if (accuracy.all_methods) picture_legend(look, lab.accuracy);
}

void accuracy_card(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport) {
  if (!desk.accuracy_large || desk.tab != Tab::kAccuracy || !desk.panels ||
      lab.accuracy.planned() == 0 || lab.accuracy.picture == AccuracyPicture::kEffectCosts) {
    return;
  }
  constexpr float kAround = 16.0F;
  constexpr float kCaption = 76.0F;  // the caption at the top of the view
  constexpr float kFoot = 52.0F;     // the tour button and the scale of the tint
  const ViewRect& v = viewport.view_rect;
  constexpr float kMapHeight = 330.0F;  // below the run that it controls
  const float room = v.height - kCaption - kFoot;
  const ImVec2 size(v.width - 2.0F * kAround,
                    std::min(room, shows_map(lab.accuracy) ? kMapHeight : 620.0F));
  const float down = shows_map(lab.accuracy) ? room - size.y : 0.0F;
  ImGui::SetNextWindowPos({v.x + kAround, v.y + kCaption + down});
  ImGui::SetNextWindowSize(size);
  if (ImGui::Begin("##accuracy", nullptr, kPlaced | ImGuiWindowFlags_NoScrollbar)) {
    const ImVec2 inside = ImGui::GetContentRegionAvail();
    picture(look, lab, {inside.x, inside.y - 22.0F});
  }
  ImGui::End();
}

}  // namespace substep::ui

// "Find N": what is wanted, the progress, the plots, and the answer with what was tried for it.

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/text/format.hpp"
#include "app/ui/accuracy_curves.hpp"
#include "app/ui/curve_style.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/lab/sweep.hpp"

namespace substep::ui {
namespace {

constexpr std::array<Choice, static_cast<std::size_t>(ErrorAxis::kCount)> kFindErrors{
    {{"Path", "Distance of a body from the reference motion"},
     {"Energy", "Drift of the energy"},
     {"Gap", "Largest gap of a joint"},
     {"Overlap", "Deepest overlap of a contact"}}};
constexpr std::array<const char*, static_cast<std::size_t>(ErrorAxis::kCount)> kFindKept{
    "a path error", "an energy drift", "joint gaps", "overlaps"};

std::string seconds_text(double seconds) { return plain_number(seconds) + " s"; }

void find_wanted(const Look& look, FindN& find, const Scene& scene) {
  std::vector<Choice> names;
  std::vector<ErrorAxis> axes;
  int current = 0;
  for (std::size_t i = 0; i < kFindErrors.size(); ++i) {
    const auto axis = static_cast<ErrorAxis>(i);
    if (!FindN::has(axis, scene)) continue;
    if (axis == find.next_axis) current = static_cast<int>(axes.size());
    axes.push_back(axis);
    names.push_back(kFindErrors[i]);
  }
  segmented_row(look, "Error", names, current, "The error that is limited");
  find.next_axis = axes[static_cast<std::size_t>(current)];
  const bool energy = find.next_axis == ErrorAxis::kEnergy;
  power_slider(look, energy ? "Within, J" : "Within, m",
               find.next_limit.at(static_cast<std::size_t>(find.next_axis)), 1e-6,
               energy ? 1e6 : 1.0, "The largest permitted error");
}

/// "Methods: 120 of 408"
std::string find_stage(const FindN& find) {
  const FindN::Count count = find.count();
  switch (find.stage()) {
    case FindN::Stage::kSurvey:
      return "Looking at the motion";
    case FindN::Stage::kSubsteps:
      return "N along alpha: " + std::to_string(find.along_alpha().size() + 1) + " of " +
             std::to_string(find.alphas());
    case FindN::Stage::kReference:
      return "Computing the reference motion";
    case FindN::Stage::kMethods:
      return "Methods: " + std::to_string(count.complete + count.error + count.cost) + " of " +
             std::to_string(count.planned);
    case FindN::Stage::kWhole:
      return "Trying the cheapest for all " + seconds_text(find.whole());
    case FindN::Stage::kIdle:
    case FindN::Stage::kDone:
      break;
  }
  return "";
}

void find_start(const Look& look, Lab& lab) {
  FindN& find = lab.find_n;
  if (find.busy()) {
    if (progress(look, find.progress(), "Keeps what was found so far")) find.cancel();
    label(look.fonts.small, look.theme->dim, find_stage(find));
    return;
  }
  const double limit = find.next_limit.at(static_cast<std::size_t>(find.next_axis));
  const bool answered = find.stage() == FindN::Stage::kDone && find.of() == lab.find_scene() &&
                        find.axis() == find.next_axis && find.wanted() == limit;
  const std::string text =
      find.cancelled() ? "Find N: continue" : "Find N within " + error_text(limit, find.next_axis);
  if (button(look, "find_n", Icon::kSweep, text,
             answered ? ButtonKind::kPlain : ButtonKind::kPrimary, ImGui::GetContentRegionAvail().x,
             look.m.row + 4.0F,
             "Runs this scene from its start: the paper's method along alpha, then all methods")) {
    lab.start_find_n();
  }
}

void find_method(const Look& look, const Settings& s) {
  const CurveStyle style = curve_style(*look.theme, s);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  draw_swatch(style, look.theme->panel | IM_COL32_A_MASK, *ImGui::GetWindowDrawList(),
              {at.x + 14.0F, at.y + 10.0F});
  const std::string name = wrapped(look.fonts.medium, style.name() + ", " + parameter_text(s),
                                   ImGui::GetContentRegionAvail().x - 36.0F);
  draw_text(look.fonts.medium, {at.x + 36.0F, at.y + 2.0F}, look.theme->text, name);
  ImGui::Dummy({1.0F, text_size(look.fonts.medium, name).y + 2.0F});
}

/// "0.858 mm for 3 sub-steps and 43,200 operations per frame."
std::string find_figures(const Result& result, ErrorAxis axis) {
  return error_text(error_of(result, axis).value_or(0.0), axis) + " for " +
         plain_number(cost_of(result, CostAxis::kSubsteps)) + " sub-steps and " +
         cost_text(cost_of(result, CostAxis::kOperations), CostAxis::kOperations) + ".";
}

/// Over which time it was compared and held.
std::string find_times(const FindN& find) {
  std::string text = " Compared over " + seconds_text(find.compared());
  if (find.stage() != FindN::Stage::kDone) return text + ".";
  text += ", holds for " + seconds_text(std::max(find.whole(), find.compared())) + ".";
  if (find.failed().size() == 1) text += " A cheaper one does not.";
  if (find.failed().size() > 1) {
    text += " " + std::to_string(find.failed().size()) + " cheaper ones do not.";
  }
  return text;
}

std::string find_beside_paper(const FindN& find, const Result& best) {
  const Result* paper = find.best_of_paper();
  const auto points = find.along_alpha();
  if (points.empty()) return "";
  if (paper == nullptr) {
    return " No alpha tried for the paper's method, from " + plain_number(points.front().alpha) +
           " to " + plain_number(points.back().alpha) + ", is within it.";
  }
  if (paper->experiment.settings == best.experiment.settings) return " It is the paper's method.";
  const double times =
      cost_of(*paper, CostAxis::kOperations) / cost_of(best, CostAxis::kOperations);
  return " The paper's method needs alpha = " + plain_number(paper->experiment.settings.alpha) +
         ", N = " + coarse_number(cost_of(*paper, CostAxis::kSubsteps)) +
         " on average: " + coarse_number(times) + " times the work.";
}

/// What the answer rests on: "Tried 408 of 408 methods and parameters: 13 hold, 30 fail, ..."
std::string find_tried(const FindN& find) {
  const FindN::Count n = find.count();
  std::string text = "Tried " + std::to_string(n.complete + n.error + n.cost) + " of " +
                     std::to_string(n.planned) +
                     " methods and parameters: " + std::to_string(n.held) + " hold, " +
                     std::to_string(n.complete - n.held) + " fail";
  if (n.error > 0) {
    text += ", " + std::to_string(n.error) + " ended early above " +
            error_text(find.limit(), find.axis());
  }
  if (n.cost > 0) {
    text += ", " + std::to_string(n.cost) + " ended early with more work than the cheapest";
  }
  return text + ".";
}

std::string find_measured(const FindN& find) {
  std::string text;
  if (!find.chosen_body().empty()) {
    text = "The path is that of " + find.chosen_body() + ", which moves farthest. ";
  }
  if (!find.reference().source.empty()) {
    text += "Measured from: " + find.reference().source + ", uncertain by " +
            coarse_number(find.reference().uncertainty) + " m.";
  }
  if (!find.energy_changes().empty()) {
    text += "The true motion does not keep its energy (" + find.energy_changes() +
            "): less drift is not less error.";
  }
  return text;
}

/// Nothing is within the limit, or nothing within it holds.
void find_none(const Look& look, const FindN& find) {
  const Theme& t = *look.theme;
  const std::string limit = error_text(find.limit(), find.axis());
  const Result* nearest = find.nearest();
  if (!find.failed().empty()) {
    label(look.fonts.medium, t.text,
          "None of the " + std::to_string(find.failed().size()) + " methods tried within " + limit +
              " holds for " + seconds_text(find.whole()) + ".");
  } else if (nearest == nullptr) {
    label(look.fonts.medium, t.text,
          find.count().held == 0 ? "No method holds for " + seconds_text(find.compared()) + "."
                                 : "No method has this error.");
  } else {
    label(look.fonts.medium, t.text, "No method is within " + limit + ". The nearest:");
    find_method(look, nearest->experiment.settings);
    label(look.fonts.small, t.dim, find_figures(*nearest, find.axis()) + find_times(find));
  }
}

void find_answer(const Look& look, Lab& lab) {
  const Theme& t = *look.theme;
  const FindN& find = lab.find_n;
  const bool done = find.stage() == FindN::Stage::kDone;
  const Result* best = done ? find.best() : find.best_so_far();
  if (find.limit() != find.wanted()) {
    label(look.fonts.small, t.dim,
          "The reference is uncertain by " + coarse_number(find.reference().uncertainty) +
              " m, so less than " + error_text(find.limit(), find.axis()) + " is not promised.");
  }
  if (best == nullptr) {
    if (done) find_none(look, find);
    return;
  }
  const auto axis = static_cast<std::size_t>(find.axis());
  label(look.fonts.small, t.dim,
        std::string(done ? "The cheapest with " : "So far the cheapest with ") +
            kFindKept.at(axis) + " of at most " + error_text(find.limit(), find.axis()));
  find_method(look, best->experiment.settings);
  label(look.fonts.small, t.dim,
        find_figures(*best, find.axis()) + find_times(find) +
            (done ? find_beside_paper(find, *best) : ""));
  if ((done || find.cancelled()) &&
      button(look, "run_found", Icon::kPlay, "Run it", ButtonKind::kPlain, 0.0F, look.m.row,
             "The scene from its start with this method")) {
    lab.run_found(Result(*best));
  }
}

}  // namespace

void find_n_button(const Look& look, Lab& lab, Desk& desk) {
  if (!button(look, "open_find_n", Icon::kSweep, "Find N", ButtonKind::kPlain,
              ImGui::GetContentRegionAvail().x, look.m.row + 2.0F,
              "How many sub-steps this scene needs: tries all methods and names the cheapest "
              "within an error")) {
    return;
  }
  desk.level = DeskLevel::kLab;
  desk.tab = Tab::kAccuracy;
  lab.accuracy.picture = AccuracyPicture::kFindN;
  if (!lab.find_n.busy()) lab.start_find_n();
}

void find_n(const Look& look, Lab& lab) {
  const Theme& t = *look.theme;
  FindN& find = lab.find_n;
  if (!FindN::has(find.next_axis, lab.session.scene())) find.next_axis = ErrorAxis::kTrajectory;
  if (!find.busy()) find_wanted(look, find, lab.session.scene());
  find_start(look, lab);
  if (find.stage() == FindN::Stage::kIdle) {
    label(look.fonts.small, t.dim,
          "Runs this scene from its start: the paper's method along alpha, then all methods. "
          "Names the one with the least work within the error. Plots and the answer appear as the "
          "runs end.");
    return;
  }
  if (find.of() != lab.find_scene()) {
    label(look.fonts.small, t.orange,
          "Below: " + find.of().plain->title + " as it was when the search started.");
  }
  if (find.cancelled()) label(look.fonts.small, t.orange, "Cancelled. What was found so far:");
  if (!find.failure().empty()) {
    label(look.fonts.medium, t.orange, "No answer");
    label(look.fonts.small, t.text, find.failure());
    if (find.axis() == ErrorAxis::kTrajectory) {
      label(look.fonts.small, t.dim, "Choose another error above.");
    }
  }
  if (find.failure().empty()) find_answer(look, lab);
  if (!find.along_alpha().empty()) {
    space(8.0F);
    const Result* chosen = find_n_chart(look, find, ImGui::GetContentRegionAvail().x);
    if (chosen != nullptr) lab.run_found(Result(*chosen));
    space(4.0F);
  }
  if (!find.failure().empty()) return;
  if (find.count().complete == 0) return;
  space(4.0F);
  label(look.fonts.small, t.dim, find_tried(find));
  const std::string measured = find_measured(find);
  if (!measured.empty()) label(look.fonts.small, t.dim, measured);
}

}  // namespace substep::ui

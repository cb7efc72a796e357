// "What to set": the cheapest method within an error or the most accurate within a cost, and the
// alpha of the paper's method that meets the same requirement.

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/text/format.hpp"
#include "app/ui/accuracy_curves.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr std::array<Choice, 2> kGiven{{{"an error", "The cheapest setting within the limit"},
                                        {"a cost", "The most accurate setting within the limit"}}};
constexpr std::array<const char*, static_cast<std::size_t>(CostAxis::kCount)> kBudgetNames{
    "Sub-steps", "Operations", "Time, ms"};

/// The requirement: its axis and its limit.
void wanted(const Look& look, Accuracy& accuracy, const std::vector<Accuracy::Point>& points) {
  int given = accuracy.error_is_given ? 0 : 1;
  if (segmented_row(look, "Given", kGiven, given,
                    "The limited quantity; the other one is minimised")) {
    accuracy.error_is_given = given == 0;
  }
  const auto limits = [&](double RunPoint::*member) {
    const auto [least, most] =
        std::minmax_element(points.begin(), points.end(),
                            [&](const auto& p, const auto& q) { return p.*member < q.*member; });
    return std::pair((*least).*member, (*most).*member);
  };
  if (accuracy.error_is_given) {
    const auto [least, most] = limits(&RunPoint::error);
    power_slider(look, accuracy.error == ErrorAxis::kEnergy ? "Error, J" : "Error, m",
                 accuracy.wanted.at(static_cast<std::size_t>(accuracy.error)), least, most,
                 "The largest permitted error. The cheapest setting within it is below");
  } else {
    const auto cost = static_cast<std::size_t>(accuracy.cost);
    const auto [least, most] = limits(&RunPoint::cost);
    power_slider(
        look, kBudgetNames.at(cost), accuracy.budget.at(cost), least, most,
        "The largest permitted cost per frame. The most accurate setting within it is below");
  }
}

/// Result of the search for alpha. @param best the recommendation, or null
std::string found_text(const Accuracy& accuracy, const AlphaSearch& search,
                       const Accuracy::Point* best) {
  if (!search.choice()) {
    return "No alpha from " + plain_number(AlphaSearch::kLeast) +
           " to 1 makes the paper's method hold within " + limit_text(accuracy) +
           ", with at most " + std::to_string(accuracy.search_cap()) + " sub-steps per frame.";
  }
  const auto& [alpha, result] = *search.choice();
  const double cost = cost_of(result, accuracy.cost);
  const std::string text =
      std::string("The paper's ") + (accuracy.error_is_given ? "largest" : "smallest") +
      " alpha within " + limit_text(accuracy) + " is " + plain_number(alpha) + ": " +
      error_text(error_of(result, accuracy.error).value_or(0.0), accuracy.error) + " for " +
      cost_text(cost, accuracy.cost) + ".";
  if (!best || !accuracy.error_is_given) return text;
  return text + " That is " + coarse_number(cost / best->cost) +
         " times the cost of the setting above.";
}

/// The paper's alpha that meets the requirement, by search. @param best the recommendation, or null
void paper_alpha(const Look& look, Lab& lab, const Accuracy::Point* best) {
  Accuracy& accuracy = lab.accuracy;
  const AlphaSearch* search = accuracy.alpha_search();
  if (!search) {
    if (accuracy.can_search() &&
        button(look, "find_alpha", Icon::kNone, "Find the paper's alpha", ButtonKind::kGhost, 0.0F,
               look.m.row,
               "Bisection between the values of its curve: each step runs the whole scene")) {
      accuracy.search_alpha();
    }
    return;
  }
  if (accuracy.searching()) {
    search_bar(look, lab.accuracy);
    return;
  }
  label(look.fonts.small, look.theme->dim, found_text(accuracy, *search, best));
  if (search->choice() &&
      button(look, "found_alpha", Icon::kPlay, "Run with this alpha", ButtonKind::kPlain, 0.0F,
             look.m.row, "This scene from its start with the paper's method and this alpha")) {
    lab.run_result(Result(search->choice()->result));
  }
}

/// The runs of the paper's method in comparison.
std::string beside_paper(const Accuracy& accuracy, const std::vector<Accuracy::Point>& points,
                         const Accuracy::Point& best) {
  const auto paper = accuracy.best(of_paper(points, accuracy.results()));
  if (!paper) return "No tested alpha of the paper's method reaches this.";
  const double alpha = accuracy.results()[paper->result].experiment.settings.alpha;
  if (paper->result == best.result) return "It is the paper's.";
  const std::string with = "The paper's method, with alpha = " + plain_number(alpha) + ", ";
  return accuracy.error_is_given
             ? with + (paper->cost < 1.05 * best.cost
                           ? "costs as much."
                           : "takes " + coarse_number(paper->cost / best.cost) + " times the cost.")
             : with + "has an error of " + error_text(paper->error, accuracy.error) + ".";
}

/// Keeping the cheapest setting that also holds for the scene's whole duration.
void keep_button(const Look& look, Lab& lab) {
  Accuracy& accuracy = lab.accuracy;
  // Stored recommendations count operations, which are the same on every machine.
  if (!accuracy.error_is_given || accuracy.cost != CostAxis::kOperations) return;
  const std::string whole = plain_number(accuracy.scene()->criteria.duration) + " s";
  if (!accuracy.can_promise()) {
    label(look.fonts.small, look.theme->dim,
          "It is not kept: the reference is uncertain by " + coarse_number(accuracy.floor()) +
              " m, so less than ten times this is not promised.");
    return;
  }
  if (accuracy.trying()) {
    label(look.fonts.small, look.theme->dim, "Trying it for all " + whole + " of the scene");
    if (progress(look, accuracy.trial()->progress(), "Keeps nothing")) accuracy.cancel_trial();
    return;
  }
  ImGui::SameLine(0.0F, 8.0F);
  if (button(look, "keep", Icon::kNone, "Keep for this scene", ButtonKind::kGhost, 0.0F, look.m.row,
             "Adds a copy to your own scenes that starts with it, and has it as the preset "
             "recommended. It must hold for all " +
                 whole + " of the scene; otherwise the next cheapest that does is kept")) {
    accuracy.try_whole();
  }
  if (const auto recommended = accuracy.take_recommended()) {
    lab.keep(*recommended);
  } else if (accuracy.trial()) {
    label(look.fonts.small, look.theme->dim,
          "None of the " + std::to_string(accuracy.trial()->failed().size()) +
              " settings tried holds for all " + whole + " of the scene.");
  }
}

}  // namespace

void search_bar(const Look& look, Accuracy& accuracy) {
  if (!accuracy.searching()) return;
  const AlphaSearch& search = *accuracy.alpha_search();
  label(look.fonts.small, look.theme->dim,
        "Looking for the paper's alpha: run " + std::to_string(search.runs()) +
            ", alpha = " + coarse_number(search.alpha()));
  if (progress(look, search.progress(), "Discards the result so far")) {
    accuracy.cancel_search();
  }
}

void advice(const Look& look, Lab& lab) {
  Accuracy& accuracy = lab.accuracy;
  const std::vector<Accuracy::Point> points = accuracy.points();
  if (points.size() < 2) return;
  section(look, "What to set");
  wanted(look, accuracy, points);
  const auto best = accuracy.best(points);
  if (!best) {
    label(look.fonts.small, look.theme->dim, "No method is within " + limit_text(accuracy) + ".");
    paper_alpha(look, lab, nullptr);
    space(8.0F);
    return;
  }
  const Result& result = accuracy.results()[best->result];
  const Settings& s = result.experiment.settings;
  const CurveStyle style = curve_style(*look.theme, s);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw_swatch(style, look.theme->panel | IM_COL32_A_MASK, draw, {at.x + 14.0F, at.y + 10.0F});
  const std::string name =
      wrapped(look.fonts.medium, style.name(), ImGui::GetContentRegionAvail().x - 36.0F);
  draw_text(look.fonts.medium, {at.x + 36.0F, at.y + 2.0F}, look.theme->text, name);
  ImGui::Dummy({1.0F, text_size(look.fonts.medium, name).y + 2.0F});
  const AlphaSearch* search = accuracy.alpha_search();
  const std::string reason =
      "With " + parameter_text(s) + " within " + limit_text(accuracy) + ": " +
      error_text(best->error, accuracy.error) + " for " + cost_text(best->cost, accuracy.cost) +
      ", over " + plain_number(result.experiment.duration) + " s." +
      (search && search->done() ? "" : " " + beside_paper(accuracy, points, *best));
  label(look.fonts.small, look.theme->dim, reason);
  if (button(look, "cheapest", Icon::kPlay, "Run it", ButtonKind::kPlain, 0.0F, look.m.row,
             "This scene from its start with this method")) {
    lab.run_result(Result(result));
  }
  keep_button(look, lab);
  paper_alpha(look, lab, &*best);
  space(8.0F);
}

}  // namespace substep::ui

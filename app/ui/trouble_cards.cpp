// Error cards: a run that failed, external data that could not be read.

#include <algorithm>
#include <string>
#include <vector>

#include "app/text/format.hpp"
#include "app/text/verdict_words.hpp"
#include "app/ui/card.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/lab/remedy.hpp"

namespace substep::ui {
namespace {

std::string duration_text(const Scene& scene, const RemedyTrials& trials) {
  return plain_number(static_cast<double>(trials.trial().frames) * scene.frame) + " s";
}

/// One line above the remedies that hold.
std::string trials_text(const RemedyTrials& trials, std::size_t hold, const std::string& duration) {
  if (hold > 0) {
    return "Tried from the start, holds for " + duration +
           (trials.done() ? ":" : "; others are being tried:");
  }
  if (!trials.done()) return "Trying remedies for " + duration + " ...";
  if (trials.failed() == 1) return "The remedy that was tried does not hold for " + duration + ".";
  if (trials.failed() == 0) return "No remedy is known.";
  return "None of the " + std::to_string(trials.failed()) + " remedies that were tried holds for " +
         duration + ".";
}

/// A button: restarts the same scene with the remedy.
void reset_with(const Look& look, Lab& lab, const Remedy& remedy, const std::string& duration,
                ButtonKind kind) {
  const std::string tip = "The same scene from its start with " + remedy.text +
                          (remedy.why.empty() ? "" : "; " + remedy.why) + ". Tried: it holds for " +
                          duration + ".";
  if (button(look, remedy.text.c_str(), Icon::kReset, ("Reset with " + remedy.text), kind, 0.0F,
             28.0F, tip)) {
    lab.change(remedy.settings);
    lab.reset();
  }
}

}  // namespace

void failure_card(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport) {
  const Verdict& verdict = lab.session.verdict();
  if (verdict.holds() || desk.dismissed_failure == lab.run_count) return;
  const bool stopped = lab.session.stopped();
  if (lab.session.playing() && !stopped && !lab.frozen()) return;  // the user continues
  if (desk.tour >= 0 && !stopped) return;  // the tour's card explains the failure
  const ViewRect& v = viewport.view_rect;
  if (desk.failure_run != lab.run_count) desk.failure_place = -1;
  desk.failure_run = lab.run_count;
  if (desk.failure_place < 0 && !viewport.view.camera.at_rest()) return;  // first what failed
  constexpr ImVec2 kSize(380.0F, 256.0F);  // with the maximum number of remedies
  const CardPlace place = card_beside(lab.session, viewport, kSize, desk.failure_place);
  if (begin_card(look, "##failure", kSize.x, place)) {
    card_title(look, look.theme->orange, Icon::kCross,
               stopped ? "The run stopped at " + fixed(lab.session.state().time, 2) + " s"
                       : "Failed at " + fixed(verdict.failed_at(), 2) + " s");
    const FrameReport& report = lab.session.report();
    std::string what = verdict.text();
    if (const std::size_t colon = what.find(": "); colon != std::string::npos)
      what.erase(0, colon + 2);
    if (verdict.exceeded() && !stopped) what = exceeded_sentence(*verdict.exceeded());
    if (report.status == StepStatus::kNotFinite) {
      what = "The motion";
      if (report.failed_body >= 0) {
        what +=
            " of " + lab.session.scene().bodies[static_cast<std::size_t>(report.failed_body)].name;
      }
      what += " is no longer finite. The last finite state is shown.";
    }
    label(look.fonts.small, look.theme->dim, what);
    // Remedies are appended as they are found: nothing moves under the pointer.
    if (button(look, "again", Icon::kReset, "Reset", ButtonKind::kPlain, 0.0F, 28.0F,
               "Back to the start (R)")) {
      lab.reset();
    }
    ImGui::SameLine();
    if (button(look, "good", Icon::kNone, "Last good state", ButtonKind::kPlain, 0.0F, 28.0F,
               "Back to the last frame that held; the run continues from there")) {
      lab.session.go_to_last_good();
    }
    ImGui::SameLine();
    if (button(look, "second", Icon::kNone, "1 s before", ButtonKind::kPlain, 0.0F, 28.0F,
               "Back to one second before the failure; change a setting and continue")) {
      lab.session.go_to_last_good(1.0);
    }
    if (const RemedyTrials* trials = lab.remedy_trials()) {
      const std::vector<Remedy> hold = trials->hold();  // a button may start another run
      const std::string duration = duration_text(lab.session.scene(), *trials);
      label(look.fonts.small, look.theme->dim, trials_text(*trials, hold.size(), duration));
      auto kind = ButtonKind::kPrimary;  // for the most likely remedy
      const std::size_t most = v.height > 400.0F ? 3 : 1;
      for (std::size_t i = 0; i < std::min(hold.size(), most); ++i) {
        reset_with(look, lab, hold[i], duration, kind);
        kind = ButtonKind::kPlain;
      }
    }
    if (card_closed(look)) desk.dismissed_failure = lab.run_count;
  }
  ImGui::End();
}

void trouble_card(const Look& look, Lab& lab, const Viewport& viewport) {
  if (lab.trouble.title.empty()) return;
  bool close = ImGui::IsKeyPressed(ImGuiKey_Escape, false);
  ImGui::SetNextWindowFocus();
  if (begin_card(look, "##trouble", 520.0F, card_middle(viewport))) {
    card_title(look, look.theme->orange, Icon::kCross, lab.trouble.title);
    const std::size_t count = lab.trouble.problems.size();
    const std::string note =
        (count == 1 ? "One problem. " : std::to_string(count) + " problems. ") +
        lab.trouble.aftermath;
    label(look.fonts.small, look.theme->dim, note);
    ImGui::Dummy({1.0F, 0.0F});
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSizeConstraints({0.0F, 0.0F}, {1e4F, display.y - 260.0F});
    if (ImGui::BeginChild("list", {0, 0}, ImGuiChildFlags_AutoResizeY)) {
      for (const Problem& problem : lab.trouble.problems) {
        label(look.fonts.medium, look.theme->text,
              problem.pointer.empty() ? "whole file" : problem.pointer);
        ImGui::SetCursorPosY(ImGui::GetCursorPosY() - 6.0F);
        label(look.fonts.small, look.theme->dim, problem.message);
      }
    }
    ImGui::EndChild();
    close |= card_closed(look);
  }
  ImGui::End();
  if (close) lab.trouble = {};
}

}  // namespace substep::ui

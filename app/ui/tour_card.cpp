// The guided tour: a card over the picture, and the button that opens it.

#include <algorithm>
#include <string>

#include "app/text/tour_words.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr ImGuiWindowFlags kCard =
    kPlaced | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;

// Opened as a link at the end of the frame.
void go_to(Desk& desk, int step) { desk.follow = "tour=" + std::to_string(step + 1); }

void end(Desk& desk) {
  if (desk.tour >= 0) desk.follow = "tour=off";  // restores the earlier run
  desk.tour_hint = false;
}

void draw_dots(const Look& look, int step, int count, ImVec2 at) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (int i = 0; i < count; ++i) {
    const ImVec2 centre(at.x + 4.0F + 14.0F * static_cast<float>(i), at.y);
    draw.AddCircleFilled(centre, i == step ? 4.0F : 3.0F,
                         i == step ? look.theme->accent_hover : look.theme->faint);
  }
}

void steps_row(const Look& look, Desk& desk, int step, int count) {
  const float row = look.m.row + 2.0F;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const bool last = step + 1 == count;
  draw_dots(look, step, count, {origin.x, origin.y + 0.5F * row});
  ImGui::SetCursorScreenPos({origin.x + width - 168.0F, origin.y});
  if (step > 0) {
    if (button(look, "back", Icon::kNone, "Back", ButtonKind::kPlain, 80.0F, row, "")) {
      go_to(desk, step - 1);
    }
  } else {
    ImGui::Dummy({80.0F, row});
  }
  ImGui::SameLine(0.0F, 8.0F);
  if (button(look, "next", Icon::kNone, last ? "Done" : "Next", ButtonKind::kPrimary, 80.0F, row,
             "")) {
    if (last) {
      end(desk);
    } else {
      go_to(desk, step + 1);
    }
  }
}

// The task and the feedback from the run.
void task(const Look& look, const TourWords& words) {
  const Theme& t = *look.theme;
  label(look.fonts.medium, t.text, tour_sentence(words.task, words.numbers));
  const bool answered = !words.reply.text.empty();
  label(look.fonts.small, words.reply.done ? t.teal : t.dim,
        answered ? words.reply.text : words.now);
}

void card(const Look& look, Desk& desk, const Viewport& viewport, const TourWords& words) {
  const Theme& t = *look.theme;
  const ViewRect& v = viewport.view_rect;
  const float width = std::min(440.0F, v.width - 24.0F);
  // Below the picture, in the room reserved for it.
  const float bottom = v.y + v.height + desk.tour_height;
  ImGui::SetNextWindowPos({v.x + 0.5F * v.width, bottom - 12.0F}, ImGuiCond_Always, {0.5F, 1.0F});
  ImGui::SetNextWindowSizeConstraints({width, 0.0F}, {width, bottom - v.y - 24.0F});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, t.raised);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {16.0F, 12.0F});
  if (ImGui::Begin("##tour", nullptr, kCard)) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float right = at.x + ImGui::GetContentRegionAvail().x;
    const std::string title = std::to_string(words.step + 1) + "  ·  " + words.title;
    draw_text(look.fonts.medium, {at.x, at.y + 4.0F}, t.text,
              fitted(look.fonts.medium, title, right - at.x - 32.0F));
    ImGui::SetCursorScreenPos({right - 24.0F, at.y});
    if (button(look, "close", Icon::kCross, "", ButtonKind::kGhost, 24.0F, 24.0F, "End the tour")) {
      end(desk);
    }
    label(look.fonts.regular, t.text, tour_sentence(words.text, words.numbers));
    label(look.fonts.small, t.dim, tour_sentence(words.watch, words.numbers));
    task(look, words);
    steps_row(look, desk, static_cast<int>(words.step), static_cast<int>(words.count));
  }
  desk.tour_height = ImGui::GetWindowHeight() + 12.0F;
  ImGui::End();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
}

// An outline separates a button from the picture.
void outline(const Look& look) {
  ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(),
                                      look.theme->track, look.m.radius);
}

// Suggestions in the corner of the picture. The text is longer for new users until the tour is
// taken or dismissed.
void invitation(const Look& look, Desk& desk, const Viewport& viewport) {
  const ViewRect& v = viewport.view_rect;
  const bool fresh = desk.tour_hint;
  const float row = look.m.row + 2.0F;
  ImGui::SetNextWindowPos({v.x + v.width - 12.0F, v.y + v.height - 12.0F}, ImGuiCond_Always,
                          {1.0F, 1.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0F);
  if (ImGui::Begin("##tour_button", nullptr, kCard | ImGuiWindowFlags_NoBackground)) {
    const bool lab = desk.level == DeskLevel::kLab;
    if (lab && v.width >= 664.0F && desk.panels && desk.tab != Tab::kAccuracy) {
      if (button(look, "cost", Icon::kNone, "What does accuracy cost?", ButtonKind::kPlain, 0.0F,
                 row, "All methods on this scene: error against cost")) {
        desk.tab = Tab::kAccuracy;
      }
      outline(look);
      ImGui::SameLine(0.0F, 8.0F);
    }
    if (button(look, "tour", Icon::kNone, "Tour", fresh ? ButtonKind::kPrimary : ButtonKind::kPlain,
               0.0F, row, kTourTip)) {
      go_to(desk, 0);
    }
    if (!fresh) outline(look);
    if (fresh && lab) {
      ImGui::SameLine(0.0F, 4.0F);
      if (button(look, "not", Icon::kCross, "", ButtonKind::kPlain, row, row,
                 "Not now; the button stays")) {
        end(desk);
      }
      outline(look);
    }
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

}  // namespace

void advance_tour(Desk& desk) {
  if (desk.tour + 1 < static_cast<int>(tour_steps().size())) {
    go_to(desk, desk.tour + 1);
  } else {
    end(desk);
  }
}

void tour(const Look& look, Desk& desk, const Viewport& viewport, const TourWords* words) {
  if (words != nullptr) {
    card(look, desk, viewport, *words);
    return;
  }
  desk.tour_height = 0.0F;
  if (desk.tour < 0) invitation(look, desk, viewport);
}

}  // namespace substep::ui

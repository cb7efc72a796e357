// The scene as text: its state, the field, and the problems that its reader finds.

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "app/ui/handles.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr std::size_t kListed = 100;  // problems; each is measured in every frame

std::string problem_count(std::size_t count) {
  return count == 1 ? "One problem" : std::to_string(count) + " problems";
}

/// What runs, in one line.
void scene_text_state(const Look& look, const Lab& lab) {
  const SceneEditor& editor = lab.editor;
  const SceneText& text = editor.text();
  std::string words;
  ImU32 color = look.theme->dim;
  if (!editor.too_long.empty()) {
    words = "No text";
  } else if (!text.checked()) {
    words = "Checking the text ...";
  } else if (!text.problems().empty()) {
    words = problem_count(text.problems().size()) + ". The last valid text runs.";
    color = look.theme->orange;
  } else if (!text.changed()) {
    words = is_own(lab.session.loaded()) ? "Valid. This text runs."
                                         : "This text runs. A change of it is a scene of your own.";
  } else {
    words = editor.while_typing ? "Valid." : "Valid. It does not run yet.";
  }
  label(look.fonts.small, color, words);
}

/// Two ways out if the run has another scene.
void scene_text_conflict(const Look& look, Lab& lab) {
  label(look.fonts.small, look.theme->orange,
        "The scene was changed elsewhere. This text does not run.");
  if (button(look, "take_run", Icon::kNone, "Show the run's scene", ButtonKind::kPlain, 0.0F,
             look.m.row, "Undo returns to this text")) {
    lab.editor.show_run(lab);
  }
  ImGui::SameLine(0.0F, 8.0F);
  if (button(look, "keep_text", Icon::kNone, "Keep this text", ButtonKind::kPlain, 0.0F, look.m.row,
             "Once it is valid it replaces the scene of the run")) {
    lab.editor.keep_text(lab);
  }
}

/// Moves the cursor to where a change ends.
void go_to_change(const TextChange* change, TextField& field) {
  if (change != nullptr && field.active()) field.go_to(change->at + change->inserted.size());
}

// An icon, pale if there is nothing to do.
bool step_button(const Look& look, const char* id, Icon icon, bool enabled, const char* tip) {
  const auto kind = enabled ? ButtonKind::kPlain : ButtonKind::kGhost;
  return button(look, id, icon, "", kind, look.m.row + 4.0F, look.m.row, tip) && enabled;
}

void scene_text_buttons(const Look& look, Lab& lab, TextField& field) {
  SceneEditor& editor = lab.editor;
  const SceneText& text = editor.text();
  constexpr float kBetween = 6.0F;
  if (step_button(look, "Undo", Icon::kUndo, text.can_undo(), "Undo (Ctrl Z)")) {
    go_to_change(editor.undo(), field);
  }
  ImGui::SameLine(0.0F, kBetween);
  if (step_button(look, "Redo", Icon::kRedo, text.can_redo(), "Redo (Ctrl Y)")) {
    go_to_change(editor.redo(), field);
  }
  ImGui::SameLine(0.0F, kBetween);
  if (button(look, "format", Icon::kNone, "Format", ButtonKind::kPlain, 0.0F, look.m.row,
             "Line breaks and spaces of scene files; the content stays")) {
    if (!editor.format()) lab.tell("The text has an error of syntax: mend it first");
  }
  if (lab.host.save_file) {
    ImGui::SameLine(0.0F, kBetween);
    if (button(look, "save_text", Icon::kNone, "Save", ButtonKind::kPlain, 0.0F, look.m.row,
               "This text as a file, as it stands")) {
      editor.save(lab);
    }
  }
  if (!editor.while_typing) {
    ImGui::SameLine(0.0F, kBetween);
    const bool can = editor.can_apply();
    if (button(look, "apply", Icon::kNone, "Apply", can ? ButtonKind::kPrimary : ButtonKind::kGhost,
               0.0F, look.m.row, "Runs this text from its start (Ctrl Enter)")) {
      editor.apply(lab);
    }
  }
  toggle(look, "Apply while typing", editor.while_typing, 0, false,
         "A valid text runs at once, from its start. An invalid one leaves the run as it is.");
}

/// Keys of the text while it, or another control of the panel, has the keyboard.
void scene_text_keys(Lab& lab, TextField& field) {
  const ImGuiIO& io = ImGui::GetIO();
  if ((!io.KeyCtrl && !io.KeySuper) || io.KeyAlt ||
      !ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows)) {
    return;
  }
  SceneEditor& editor = lab.editor;
  const bool z = ImGui::IsKeyPressed(ImGuiKey_Z);
  if (z && !io.KeyShift) go_to_change(editor.undo(), field);
  if (ImGui::IsKeyPressed(ImGuiKey_Y) || (z && io.KeyShift)) go_to_change(editor.redo(), field);
  if (ImGui::IsKeyPressed(ImGuiKey_Enter, false)) editor.apply(lab);
}

/// @return height of the list
float problems_height(const Look& look, const SceneText& text, float most) {
  const float entry = 2.0F * text_size(look.fonts.small, "0").y + 8.0F;
  return std::min(most, entry * static_cast<float>(text.problems().size()));
}

/// "/bodies/1/mass: must be at least 1e-30 (kg), not -1"
void scene_text_problems(const Look& look, const SceneText& text, TextField& field) {
  const Theme& t = *look.theme;
  const float width = ImGui::GetContentRegionAvail().x;
  const float left = text_size(look.fonts.small_medium,
                               "Line " + std::to_string(text.problems().back().place.line))
                         .x +
                     12.0F;
  const std::size_t shown = std::min(kListed, text.problems().size());
  for (std::size_t i = 0; i < shown; ++i) {
    const PlacedProblem& placed = text.problems()[i];
    const std::string line = "Line " + std::to_string(placed.place.line);
    const std::string words =
        wrapped(look.fonts.small, to_string(placed.problem), width - left - 8.0F);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float height = text_size(look.fonts.small, words).y + 8.0F;
    ImGui::PushID(static_cast<int>(i));
    const bool pressed = marked_button("problem", {width, height}, line, "problem");
    ImGui::PopID();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    if (ImGui::IsItemHovered()) {
      draw.AddRectFilled(at, at + ImVec2(width, height), t.control, look.m.radius);
    }
    draw_text(look.fonts.small_medium, {at.x + 4.0F, at.y + 4.0F}, t.orange, line);
    draw_text(look.fonts.small, {at.x + left, at.y + 4.0F}, t.text, words);
    draw_focus(look);
    if (pressed) field.go_to(offset_of(text.text(), placed.place));
  }
  if (shown < text.problems().size()) {
    label(look.fonts.small, t.dim,
          "and " + std::to_string(text.problems().size() - shown) + " more");
  }
}

}  // namespace

void editor_heading(const Look& look, Desk& desk) {
  static constexpr std::array<Choice, 2> kEditors{
      {{"By hand", "Bodies, joints and the scene"}, {"As text", "The scene file"}}};
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  constexpr float kSwitch = 150.0F;
  const float y = at.y + 0.5F * (look.m.row - text_size(look.fonts.caps, "SCENE").y);
  ImGui::SetCursorScreenPos({at.x, y});
  section(look, "My model");
  ImGui::SetCursorScreenPos({at.x + width - look.m.row - 8.0F - kSwitch, at.y});
  int editor = desk.tab == Tab::kText ? 1 : 0;
  if (segmented(look, "editor", kEditors, editor, kSwitch)) {
    desk.tab = editor == 1 ? Tab::kText : Tab::kModel;
  }
  ImGui::SetCursorScreenPos({at.x + width - look.m.row, at.y});
  if (button(look, "Close the text", Icon::kCross, "", ButtonKind::kGhost, look.m.row, look.m.row,
             "Back to the plots")) {
    close_scene_text(desk);
  }
}

void open_scene_text(Desk& desk) {
  if (desk.tab < Tab::kText) desk.tab_before_text = desk.tab;
  desk.tab = Tab::kText;
  desk.panels = true;
  desk.right.open = true;
  desk.scene_text.take_keyboard();
}

void close_scene_text(Desk& desk) { desk.tab = desk.tab_before_text; }

void scene_text_panel(const Look& look, Lab& lab, Desk& desk, float height) {
  SceneEditor& editor = lab.editor;
  TextField& field = desk.scene_text;
  const float top = ImGui::GetCursorScreenPos().y;
  editor_heading(look, desk);
  scene_text_state(look, lab);
  if (!editor.too_long.empty()) {
    label(look.fonts.regular, look.theme->text, editor.too_long);
    return;
  }
  if (editor.conflict()) scene_text_conflict(look, lab);
  scene_text_buttons(look, lab, field);
  scene_text_keys(lab, field);
  if (!editor.refused.empty()) label(look.fonts.small, look.theme->orange, editor.refused);
  if (desk.scene_text_version != editor.version()) {
    desk.scene_text_version = editor.version();
    field.show(editor.text().text());
  }

  std::vector<LineMark> marks;
  for (const PlacedProblem& placed : editor.text().problems()) {
    marks.push_back({placed.place.line, to_string(placed.problem)});
  }
  const float room = std::max(160.0F, height - (ImGui::GetCursorScreenPos().y - top));
  const float list = problems_height(look, editor.text(), 0.35F * room);
  const float below = list > 0.0F ? list + ImGui::GetStyle().ItemSpacing.y : 0.0F;
  if (field.draw(look, "scene text", {ImGui::GetContentRegionAvail().x, room - below}, marks)) {
    editor.edit(field.text());
  }
  if (list <= 0.0F) return;
  if (ImGui::BeginChild("problems", {0.0F, list})) {
    scene_text_problems(look, editor.text(), field);
    scroll_by_drag();
  }
  ImGui::EndChild();
}

}  // namespace substep::ui

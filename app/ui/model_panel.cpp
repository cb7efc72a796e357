// "My model": what can be added, and the values of what is selected.

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "app/ui/handles.hpp"
#include "app/ui/model_actions.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/model/types_in_files.hpp"

namespace substep::ui {
namespace {

constexpr float kModelGap = 6.0F;

/// One value, typed. @return whether the user entered another one, which is then in `value`
bool value_field(const Look& look, ModelDesk& model, const Host& host, const std::string& id,
                 const std::string& handle, float width, std::string& value) {
  const bool refused = model.refused == id;
  std::array<char, 256> text{};
  const std::string& before = refused ? model.refused_text : value;
  const std::string& shown = model.typing == id ? model.typed : before;
  shown.copy(text.data(), text.size() - 1);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 end = at + ImVec2(width, look.m.row);
  bool entered = false;
  if (host.ask && ImGui::GetIO().MouseSource == ImGuiMouseSource_TouchScreen) {
    // A touch screen shows its keyboard for a field of the page only.
    if (marked_button(id.c_str(), {width, look.m.row}, handle)) {
      const std::string typed = host.ask(handle, shown);
      entered = typed != before;
      model.typed = typed;
    }
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    draw.AddRectFilled(at, end, look.theme->well, look.m.radius);
    draw_text(look.fonts.regular, {at.x + 6.0F, at.y + 0.5F * (look.m.row - ImGui::GetFontSize())},
              look.theme->text, fitted(look.fonts.regular, shown, width - 8.0F));
  } else {
    ImGui::PushFont(look.fonts.regular);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                        {6.0F, 0.5F * (look.m.row - ImGui::GetFontSize())});
    ImGui::PushStyleColor(ImGuiCol_FrameBg, look.theme->well);
    ImGui::SetNextItemWidth(width);
    ImGui::InputText(("##" + id).c_str(), text.data(), text.size(),
                     ImGuiInputTextFlags_AutoSelectAll);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    ImGui::PopFont();
    mark(handle, at, end);
    draw_focus(look);
    if (ImGui::IsItemActive()) {
      model.typing = id;
      model.typed = text.data();
    } else if (model.typing == id) {  // Enter, Tab or a press elsewhere
      model.typing.clear();
      model.typed = text.data();
      entered = model.typed != before;
      if (ImGui::IsKeyPressed(ImGuiKey_Escape, false)) {  // what was there stays
        entered = false;
        if (refused) model.refused.clear();
      }
    }
  }
  if (refused) {
    ImGui::GetWindowDrawList()->AddRect(at, end, look.theme->orange, look.m.radius, 0, 1.5F);
  }
  if (entered) value = model.typed;
  return entered;
}

/// The fields of something, one to a line. A refused value stays, with the reader's message.
void field_rows(const Look& look, Lab& lab, Desk& desk, const std::vector<ModelField>& fields) {
  constexpr float kName = 104.0F;
  constexpr float kBetween = 4.0F;
  const bool touch = ImGui::GetStyle().TouchExtraPadding.y > 0.0F;
  for (const ModelField& field : fields) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const std::string unit = field.unit.empty() ? "" : "  " + field.unit;
    const ImVec2 room = text_size(look.fonts.small, unit);
    draw_text(look.fonts.small, {at.x, at.y + 0.5F * (look.m.row - room.y)}, look.theme->dim,
              fitted(look.fonts.small, field.name, kName - 4.0F - room.x) + unit);
    const auto count = static_cast<float>(field.values.size());
    const float each = (width - kName - kBetween * (count - 1.0F)) / count;
    bool refused = false;
    for (std::size_t i = 0; i < field.values.size(); ++i) {
      ImGui::SetCursorScreenPos({at.x + kName + static_cast<float>(i) * (each + kBetween), at.y});
      const std::string id = field.pointer + '/' + std::to_string(i);
      const std::string handle =
          field.values.size() == 1 ? field.name : field.name + " " + "xyz"[i];
      std::string value = field.values[i];
      if (value_field(look, desk.model, lab.host, id, handle, each, value)) {
        const Problems problems =
            change_model(lab, desk, [&](const std::string& text, const Scene& scene) {
              return with_typed(text, scene, field, i, value);
            });
        desk.model.refused = problems.empty() ? "" : id;
        desk.model.refused_text = value;
        if (!problems.empty()) desk.model.message = problems.front().message;
      }
      refused = refused || desk.model.refused == id;
    }
    ImGui::SetCursorScreenPos({at.x, at.y + look.m.row + (touch ? 12.0F : 4.0F)});
    if (refused) {
      label(look.fonts.small, look.theme->orange, desk.model.message);
    } else {
      ImGui::Dummy({0.0F, 0.0F});
      ImGui::SetCursorScreenPos({at.x, at.y + look.m.row + (touch ? 12.0F : 4.0F)});
    }
  }
}

void history_buttons(const Look& look, Lab& lab, Desk& desk) {
  const SceneText& text = lab.editor.text();
  const auto step = [&](const char* id, Icon icon, bool can, const char* tip, bool forward) {
    const auto kind = can ? ButtonKind::kPlain : ButtonKind::kGhost;
    if (button(look, id, icon, "", kind, look.m.row + 4.0F, look.m.row, tip) && can) {
      step_model(lab, desk, forward);
    }
    ImGui::SameLine(0.0F, kModelGap);
  };
  step("Undo", Icon::kUndo, text.can_undo(), "Undo (Ctrl Z)", false);
  step("Redo", Icon::kRedo, text.can_redo(), "Redo (Ctrl Y)", true);
  if (button(look, "new_scene", Icon::kNone, "New scene", ButtonKind::kPlain, 0.0F, look.m.row,
             "A floor and gravity")) {
    new_scene(lab, desk);
  }
  ImGui::SameLine(0.0F, kModelGap);
  find_n_button(look, lab, desk);
}

void add_buttons(const Look& look, Lab& lab, Desk& desk) {
  section(look, "Add");
  static constexpr std::array<std::pair<BodyPart, const char*>, 3> kParts{
      {{BodyPart::kLink, "Link"}, {BodyPart::kBall, "Ball"}, {BodyPart::kBox, "Box"}}};
  const float each = (ImGui::GetContentRegionAvail().x - 2.0F * kModelGap) / 3.0F;
  for (const auto& [part, name] : kParts) {
    if (part != BodyPart::kLink) ImGui::SameLine(0.0F, kModelGap);
    if (button(look, name, Icon::kNone, name, ButtonKind::kPlain, each, look.m.row + 2.0F, "")) {
      add_to_model(lab, desk, part);
    }
  }
  const std::string to =
      desk.selected < 0 ? "the world" : lab.session.scene().bodies[index(desk.selected)].name;
  label(look.fonts.small, look.theme->dim,
        joins(lab, desk, BodyPart::kBall) ? "Joined to " + to + " by"
                                          : "A link is joined to " + to + " by");
  auto& type = desk.model.joint_type;
  menu_button(look, "joint type", std::string(kTypes<Joint>[type]) + (type == 1 ? "" : " joint"),
              ImGui::GetContentRegionAvail().x, look.m.row, "Joint of links, and of Join", [&] {
                for (std::size_t i = 0; i < kTypes<Joint>.size(); ++i) {
                  if (menu_item(look, std::string(kTypes<Joint>[i]), "", i == type)) type = i;
                }
              });
}

/// @param chosen called with the index of a body, or kWorld
template <class Chosen>
void body_menu(const Look& look, const Scene& scene, const Desk& desk, Chosen chosen) {
  constexpr std::size_t kListed = 200;
  const bool connecting = desk.model.connecting;
  const std::string now = connecting          ? "Choose the other body ..."
                          : desk.selected < 0 ? "none selected"
                                              : scene.bodies[index(desk.selected)].name;
  menu_button(look, "selected body", now, ImGui::GetContentRegionAvail().x, look.m.row,
              "Or press it in the picture", [&] {
                if (menu_item(look, connecting ? "the world" : "none")) chosen(kWorld);
                for (std::size_t i = 0; i < std::min(kListed, scene.bodies.size()); ++i) {
                  ImGui::PushID(static_cast<int>(i));
                  const bool is_now = static_cast<int>(i) == desk.selected;
                  if (menu_item(look, scene.bodies[i].name, "", is_now))
                    chosen(static_cast<int>(i));
                  ImGui::PopID();
                }
              });
}

void body_section(const Look& look, Lab& lab, Desk& desk, const Scene& scene) {
  section(look, "Body");
  int chosen = -2;
  body_menu(look, scene, desk, [&](int body) { chosen = body; });
  if (chosen > -2) {
    if (desk.model.connecting) {
      connect_selected(lab, desk, chosen);
    } else {
      desk.selected = chosen;
      desk.model.joint = -1;
    }
    return;
  }
  if (desk.selected < 0) return;
  const Body& body = scene.bodies[index(desk.selected)];
  if (button(look, "copy", Icon::kNone, "Copy", ButtonKind::kPlain, 0.0F, look.m.row, "")) {
    return copy_selected(lab, desk);
  }
  ImGui::SameLine(0.0F, kModelGap);
  if (button(look, "delete", Icon::kNone, "Delete", ButtonKind::kPlain, 0.0F, look.m.row,
             "With its joints (Delete)")) {
    return delete_selected(lab, desk);
  }
  ImGui::SameLine(0.0F, kModelGap);
  if (button(look, "connect", Icon::kNone, "Join",
             desk.model.connecting ? ButtonKind::kPrimary : ButtonKind::kPlain, 0.0F, look.m.row,
             "Joins it to the body that you press next")) {
    desk.model.connecting = !desk.model.connecting;
  }
  if (!std::holds_alternative<Plane>(body.shape)) {
    bool moves = !body.is_static;
    toggle(look, "moves", moves, 0, false, "");
    if (moves == body.is_static) {
      return change_or_tell(lab, desk, [&](const std::string& text, const Scene& of) {
        return with_motion(text, of, desk.selected, moves);
      });
    }
  }
  field_rows(look, lab, desk, fields_of_body(scene, desk.selected));
}

/// Of the selected body, or all.
void joint_section(const Look& look, Lab& lab, Desk& desk, const Scene& scene) {
  if (scene.joints.empty()) return;
  section(look, "Joint");
  const auto words = [&](const Joint& joint) {
    const JointBase& j = base(joint);
    const std::string other = j.b == kWorld ? "the world" : scene.bodies[index(j.b)].name;
    return std::string(kTypes<Joint>[joint.index()]) + ": " + scene.bodies[index(j.a)].name +
           " to " + other;
  };
  const int now = desk.model.joint;
  menu_button(look, "selected joint",
              now < 0 ? "none selected" : base(scene.joints[index(now)]).name,
              ImGui::GetContentRegionAvail().x, look.m.row, "", [&] {
                for (std::size_t i = 0, shown = 0; i < scene.joints.size() && shown < 200; ++i) {
                  const JointBase& j = base(scene.joints[i]);
                  if (desk.selected >= 0 && j.a != desk.selected && j.b != desk.selected) continue;
                  ++shown;
                  if (menu_item(look, j.name, words(scene.joints[i]), static_cast<int>(i) == now)) {
                    desk.model.joint = static_cast<int>(i);
                  }
                }
              });
  if (now < 0) return;
  label(look.fonts.small, look.theme->dim, words(scene.joints[index(now)]));
  if (button(look, "delete_joint", Icon::kNone, "Delete joint", ButtonKind::kPlain, 0.0F,
             look.m.row, "")) {
    return change_or_tell(lab, desk, [&](const std::string& text, const Scene&) {
      return without_joint(text, index(now));
    });
  }
  field_rows(look, lab, desk, fields_of_joint(scene, index(now)));
}

/// While no field has the keyboard.
void model_keys(Lab& lab, Desk& desk) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.WantTextInput || io.KeyAlt) return;
  if (ImGui::IsKeyPressed(ImGuiKey_Escape, false)) {
    if (!std::exchange(desk.model.connecting, false)) desk.selected = -1;
  }
  if (ImGui::IsKeyPressed(ImGuiKey_Delete, false)) delete_selected(lab, desk);
  if (!io.KeyCtrl && !io.KeySuper) return;
  const bool z = ImGui::IsKeyPressed(ImGuiKey_Z);
  if (z && !io.KeyShift) step_model(lab, desk, false);
  if (ImGui::IsKeyPressed(ImGuiKey_Y) || (z && io.KeyShift)) step_model(lab, desk, true);
}

}  // namespace

void model_panel(const Look& look, Lab& lab, Desk& desk) {
  editor_heading(look, desk);
  history_buttons(look, lab, desk);
  model_keys(lab, desk);
  // What is drawn below is the text's scene, which an action replaces.
  const auto scene = lab.editor.by_hand(lab);
  if (scene == nullptr || scene->bodies.size() != lab.session.scene().bodies.size()) {
    label(look.fonts.small, look.theme->orange,
          scene != nullptr || !lab.editor.text().checked() ? "Checking the text ..."
          : lab.editor.too_long.empty() ? "The text has changes that do not run: see As text."
                                        : lab.editor.too_long);
    return;
  }
  const auto count = static_cast<int>(scene->bodies.size());
  if (desk.selected >= count) desk.selected = -1;
  if (desk.model.joint >= static_cast<int>(scene->joints.size())) desk.model.joint = -1;
  if (ImGui::BeginChild("model", {0.0F, 0.0F})) {
    // After an action the rest is drawn in the next frame.
    const auto still = [&] { return lab.editor.text().scene() == scene; };
    add_buttons(look, lab, desk);
    space(look.m.section);
    if (still()) body_section(look, lab, desk, *scene);
    space(look.m.section);
    if (still()) joint_section(look, lab, desk, *scene);
    space(look.m.section);
    section(look, "Scene");
    if (still()) field_rows(look, lab, desk, fields_of_scene(*scene));
    scroll_by_drag();
  }
  ImGui::EndChild();
}

}  // namespace substep::ui

// The list of scenes: groups of scenes with their variants folded below.

#include <memory>
#include <string>
#include <vector>

#include "app/ui/model_actions.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kVariantIndent = 16.0F;

void group_heading(const Look& look, const std::string& group, bool first) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float top = first ? 4.0F : 10.0F;
  draw_text(look.fonts.small, {at.x + 8.0F, at.y + top}, look.theme->dim, group_title(group));
  ImGui::Dummy({1.0F, top + 18.0F});
}

// "tall" of "Heavy stack, tall", which is listed below "Heavy stack".
std::string variant_title(const Scene& base, const Scene& variant) {
  const std::string shared = base.title + ", ";
  return variant.title.starts_with(shared) ? variant.title.substr(shared.size()) : variant.title;
}

// An entry with a picture of the scene.
bool scene_item(const Look& look, const std::shared_ptr<const Scene>& scene,
                const std::string& title, bool current, Thumbnails& thumbnails) {
  constexpr float kHeight = 32.0F;
  const MenuPicture picture{{Thumbnail::kAspect * kHeight, kHeight},
                            [&](ImDrawList& draw, ImVec2 min, ImVec2 max) {
                              thumbnails.draw(draw, scene, look.theme->view, min, max);
                            }};
  return menu_item(look, title, "", current, &picture);
}

// One scene at a time is unfolded, and the one whose variant runs.
// @return the variant that was chosen, or null
std::shared_ptr<const Scene> variant_items(
    const Look& look, const Scene& base, const std::vector<std::shared_ptr<const Scene>>& variants,
    const std::string& now, Desk& desk) {
  std::shared_ptr<const Scene> chosen;
  bool runs = false;
  for (const auto& variant : variants) runs = runs || variant->name == now;
  bool open = runs || desk.unfolded_scene == base.name;
  const bool was_open = open;
  const std::string title = "Variants of " + base.title;
  ImGui::PushID(base.name.c_str());
  ImGui::Indent(kVariantIndent + 12.0F);
  fold(look, title, open, "");
  ImGui::Unindent(12.0F);
  if (open != was_open) desk.unfolded_scene = open ? base.name : "";
  for (const auto& variant : variants) {
    if (!open) break;
    const std::string name = variant_title(base, *variant);
    if (scene_item(look, variant, name, variant->name == now, desk.thumbnails)) {
      chosen = variant;
    }
  }
  ImGui::Unindent(kVariantIndent);
  ImGui::PopID();
  return chosen;
}

}  // namespace

void scene_picker(const Look& look, Lab& lab, Desk& desk, std::string_view tip) {
  const Scene& now = lab.session.scene();
  const float height = look.m.row + 4.0F;
  constexpr float kBetween = 6.0F;
  const bool in_lab = desk.level == DeskLevel::kLab;  // Explore has fewer than 20 controls
  const float width = ImGui::GetContentRegionAvail().x - (in_lab ? height + kBetween : 0.0F);
  std::shared_ptr<const Scene> chosen;
  bool added = false;
  menu_button(look, "scene", now.title, width, height, tip, [&] {
    std::string group;
    bool first = true;
    if (menu_item(look, "New scene", "a floor, and what you add")) added = true;
    for (const auto& scene : lab.library.scenes()) {
      if (lab.library.base_of(*scene) != nullptr) continue;
      if (first || group != scene->group) group_heading(look, scene->group, first);
      group = scene->group;
      first = false;
      if (scene_item(look, scene, scene->title, scene->name == now.name, desk.thumbnails)) {
        chosen = scene;
      }
      const auto variants = lab.library.variants_of(*scene);
      if (variants.empty()) continue;
      if (auto variant = variant_items(look, *scene, variants, now.name, desk)) {
        chosen = std::move(variant);
      }
    }
  });
  if (in_lab) {
    ImGui::SameLine(0.0F, kBetween);
    if (button(look, kEditText, Icon::kPencil, "", ButtonKind::kPlain, height, height,
               "Edit this scene as text (E)")) {
      open_scene_text(desk);
    }
  }
  if (chosen) lab.run(chosen);
  if (added) new_scene(lab, desk);
}

}  // namespace substep::ui

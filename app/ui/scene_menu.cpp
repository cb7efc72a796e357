// The list of scenes: groups of scenes with their variants folded below.

#include <memory>
#include <string>
#include <vector>

#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

constexpr float kVariantIndent = 16.0F;

void group_heading(const Look& look, const std::string& group, bool first) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float top = first ? 4.0F : 10.0F;
  draw_text(*ImGui::GetWindowDrawList(), look.fonts.small, {at.x + 8.0F, at.y + top},
            look.theme->dim, group_title(group).c_str());
  ImGui::Dummy({1.0F, top + 18.0F});
}

// "tall" of "Heavy stack, tall", which is listed below "Heavy stack".
std::string variant_title(const Scene& base, const Scene& variant) {
  const std::string shared = base.title + ", ";
  return variant.title.starts_with(shared) ? variant.title.substr(shared.size()) : variant.title;
}

// One scene at a time is unfolded, and the one whose variant runs.
// @return the variant that was chosen, or null
std::shared_ptr<const Scene> variant_items(
    const Look& look, const Scene& base, const std::vector<std::shared_ptr<const Scene>>& variants,
    const std::string& now, std::string& unfolded) {
  std::shared_ptr<const Scene> chosen;
  bool runs = false;
  for (const auto& variant : variants) runs = runs || variant->name == now;
  bool open = runs || unfolded == base.name;
  const bool was_open = open;
  const std::string title = "Variants of " + base.title;
  ImGui::PushID(base.name.c_str());
  ImGui::Indent(kVariantIndent + 12.0F);
  fold(look, title.c_str(), open, "");
  ImGui::Unindent(12.0F);
  if (open != was_open) unfolded = open ? base.name : "";
  for (const auto& variant : variants) {
    if (!open) break;
    if (menu_item(look, variant_title(base, *variant).c_str(), "", variant->name == now)) {
      chosen = variant;
    }
  }
  ImGui::Unindent(kVariantIndent);
  ImGui::PopID();
  return chosen;
}

}  // namespace

void scene_picker(const Look& look, Lab& lab, Desk& desk, const char* tip) {
  const Scene& now = lab.session.scene();
  const float width = ImGui::GetContentRegionAvail().x;
  std::shared_ptr<const Scene> chosen;
  menu_button(look, "scene", now.title.c_str(), width, look.m.row + 4.0F, tip, [&] {
    std::string group;
    bool first = true;
    for (const auto& scene : lab.library.scenes()) {
      if (lab.library.base_of(*scene) != nullptr) continue;
      if (first || group != scene->group) group_heading(look, scene->group, first);
      group = scene->group;
      first = false;
      if (menu_item(look, scene->title.c_str(), "", scene->name == now.name)) chosen = scene;
      const auto variants = lab.library.variants_of(*scene);
      if (variants.empty()) continue;
      if (auto variant = variant_items(look, *scene, variants, now.name, desk.unfolded_scene)) {
        chosen = std::move(variant);
      }
    }
  });
  if (chosen) lab.run(chosen);
}

}  // namespace substep::ui

// The file dialogue, for systems without a chooser.

#include <imgui.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "app/ui/card.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

void open(Lab& lab, FileBrowser& browser, const std::filesystem::path& file) {
  if (lab.open_file(file)) {
    browser.close();
  }
}

// The path as text; Enter goes to another folder or opens a file.
void path_field(const Look& look, Lab& lab, FileBrowser& browser) {
  std::array<char, 1024>& text = browser.typed();
  ImGui::PushFont(look.fonts.regular);
  ImGui::SetNextItemWidth(-1.0F);
  const bool entered =
      ImGui::InputText("##path", text.data(), text.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::PopFont();
  tooltip(look, "", "Type or paste a folder or a file, then Enter");
  if (!entered) return;
  const std::filesystem::path file = browser.follow(text.data());
  if (!file.empty()) open(lab, browser, file);
}

}  // namespace

void file_card(const Look& look, Lab& lab, const Viewport& viewport, FileBrowser& browser) {
  if (!browser.open()) return;
  bool close = lab.trouble.title.empty() && ImGui::IsKeyPressed(ImGuiKey_Escape, false);
  if (begin_card(look, "##open_file", 480.0F, card_middle(viewport))) {
    if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
    card_title(look, 0, Icon::kNone, "Open a scene file");
    path_field(look, lab, browser);
    if (!browser.problem().empty()) {
      label(look.fonts.small, look.theme->orange, browser.problem());
    }
    const float height = std::clamp(ImGui::GetIO().DisplaySize.y - 260.0F, 120.0F, 320.0F);
    if (ImGui::BeginChild("entries", {0.0F, height}, ImGuiChildFlags_None)) {
      // A click changes the list: it is handled after drawing.
      std::filesystem::path folder;
      std::filesystem::path file;
      if (browser.folder().has_relative_path() && menu_item(look, "..")) {
        folder = browser.folder().parent_path();
      }
      for (const FileBrowser::Entry& entry : browser.entries()) {
        if (!menu_item(look, entry.name, entry.folder ? "folder" : "")) continue;
        (entry.folder ? folder : file) = browser.folder() / entry.name;
      }
      if (browser.entries().empty()) {
        label(look.fonts.small, look.theme->dim,
              "No folders, scenes (*.json) or models (*.xml, *.urdf) here.");
      }
      if (!folder.empty()) browser.show(folder);
      if (!file.empty()) open(lab, browser, file);
    }
    ImGui::EndChild();
    close |= card_closed(look);
  }
  ImGui::End();
  if (close) browser.close();
}

}  // namespace substep::ui

// Choosing a scene file, where the system has no chooser to offer.

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <string>

#include "app/ui/card.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/io/scene_reader.hpp"

namespace substep::ui {
namespace {

void open(App& app, const std::filesystem::path& file) {
  if (app.open_result(read_scene_file(file.string()), file.filename().string())) {
    app.browser.close();
  }
}

// The folder in words; Enter goes to another one, or opens a file.
void path_field(App& app) {
  static std::array<char, 1024> text{};
  static std::filesystem::path shown;
  if (shown != app.browser.folder()) {
    shown = app.browser.folder();
    const std::string now = shown.string().substr(0, text.size() - 1);
    text.fill('\0');
    std::copy(now.begin(), now.end(), text.begin());
  }
  ImGui::PushFont(app.look.fonts.regular);
  ImGui::SetNextItemWidth(-1.0F);
  const bool entered =
      ImGui::InputText("##path", text.data(), text.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::PopFont();
  tooltip(app.look, "", "Type or paste a folder or a file, then Enter");
  if (!entered) return;
  const std::filesystem::path file = app.browser.follow(text.data());
  if (!file.empty()) open(app, file);
}

}  // namespace

void file_card(App& app) {
  if (!app.browser.open()) return;
  const Look& look = app.look;
  bool close = app.trouble.title.empty() && ImGui::IsKeyPressed(ImGuiKey_Escape, false);
  if (begin_card(app, "##open_file", 480.0F, card_middle(app), 0.5F)) {
    if (ImGui::IsWindowAppearing()) ImGui::SetWindowFocus();
    card_title(look, 0, Icon::kNone, "Open a scene file");
    path_field(app);
    if (!app.browser.problem().empty()) {
      label(look.fonts.small, look.theme->orange, app.browser.problem().c_str());
    }
    const float height = std::clamp(ImGui::GetIO().DisplaySize.y - 260.0F, 120.0F, 320.0F);
    if (ImGui::BeginChild("entries", {0.0F, height}, ImGuiChildFlags_None)) {
      // What is clicked changes the list: it is acted on after it was drawn.
      std::filesystem::path folder;
      std::filesystem::path file;
      if (app.browser.folder().has_relative_path() && menu_item(look, "..", "", false)) {
        folder = app.browser.folder().parent_path();
      }
      for (const FileBrowser::Entry& entry : app.browser.entries()) {
        if (!menu_item(look, entry.name.c_str(), entry.folder ? "folder" : "", false)) continue;
        (entry.folder ? folder : file) = app.browser.folder() / entry.name;
      }
      if (app.browser.entries().empty()) {
        label(look.fonts.small, look.theme->dim, "No folders and no scene files (*.json) here.");
      }
      if (!folder.empty()) app.browser.show(folder);
      if (!file.empty()) open(app, file);
    }
    ImGui::EndChild();
    close |= card_closed(look);
  }
  ImGui::End();
  if (close) app.browser.close();
}

}  // namespace substep::ui

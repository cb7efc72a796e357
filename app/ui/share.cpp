// Taking the experiment out of the window and bringing another one in.

#include <string>

#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"

namespace substep::ui {
namespace {

bool item(App& app, const char* text, const char* note = "") {
  return menu_item(app.look, text, note, false);
}

void line() {
  ImGui::Dummy({1.0F, 2.0F});
  ImGui::Separator();
  ImGui::Dummy({1.0F, 2.0F});
}

void items(App& app) {
  const Host& host = app.host;
  const std::string name = app.session.scene().name;
  if (host.copy_link && item(app, "Copy link")) host.copy_link();
  if (item(app, "Copy command")) {
    ImGui::SetClipboardText(app.command().c_str());
    app.tell("Command copied");
  }
  line();
  if (host.open_file && item(app, "Open scene …")) host.open_file();
  if (host.save_file && item(app, "Save scene as it is now")) app.save_scene();
  line();
  if (host.save_file && item(app, "Picture of the window", "PNG")) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    app.capture = Capture{name + ".png", {0.0F, 0.0F, display.x, display.y}};
  }
  if (host.save_file && item(app, "Picture of the view", "PNG")) {
    app.capture = Capture{name + "_view.png", app.view_rect};
  }
  if (host.record && item(app, app.recording ? "Stop the video" : "Record a video")) {
    host.record(!app.recording);
  }
}

}  // namespace

void share_menu(App& app, float size) {
  icon_menu(app.look, "share", Icon::kShare, ButtonKind::kGhost, size, "Share, open, save",
            [&] { items(app); });
}

}  // namespace substep::ui

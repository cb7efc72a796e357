// Taking the experiment out of the window and bringing another one in.

#include <string>

#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/io/scene_writer.hpp"

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
  if (host.copy_link && item(app, "Copy link", "L")) copy_link(app);
  if (item(app, "Copy command", "C")) copy_command(app);
  if (host.open_link && item(app, "Open the copied link")) host.open_link();
  line();
  if (host.open_file && item(app, "Open scene …", "O")) host.open_file();
  if (host.save_file && item(app, "Save scene as it is now", "S")) app.save_scene();
  line();
  if (host.save_file && item(app, "Picture of the window", "P")) capture_window(app);
  if (host.save_file && item(app, "Picture of the view")) {
    app.capture = Capture{app.session.scene().name + "_view.png", app.view_rect};
  }
  if (host.record && item(app, app.recording ? "Stop the video" : "Record a video")) {
    host.record(!app.recording);
  }
}

}  // namespace

void copy_link(App& app) {
  if (app.host.copy_link) app.host.copy_link();
}

void copy_command(App& app) {
  ImGui::SetClipboardText(app.command().c_str());
  std::string said = "Command copied";
  if (app.session.edition() != nullptr && app.host.save_file) {
    // The scene with the ball, or without the effect, is in no file yet.
    const Scene& scene = app.link_scene();
    app.host.save_file(scene.name + ".json", write_scene(scene));
    said += ", and the scene that it runs was saved";
  }
  app.tell(said);
}

void capture_window(App& app) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  app.capture = Capture{app.session.scene().name + ".png", {0.0F, 0.0F, display.x, display.y}};
}

void share_menu(App& app, float size) {
  if (app.desk.open_share_menu) {
    app.desk.open_share_menu = false;
    ImGui::PushID("share");
    ImGui::OpenPopup("menu");
    ImGui::PopID();
  }
  icon_menu(app.look, "share", Icon::kShare, ButtonKind::kGhost, size, "Share, open, save",
            [&] { items(app); });
}

}  // namespace substep::ui

// Export and import of experiments.

#include <string>

#include "app/ui/model_actions.hpp"
#include "app/ui/panels.hpp"
#include "app/ui/widgets.hpp"
#include "core/io/scene_writer.hpp"
#include "core/model/number_text.hpp"

namespace substep::ui {
namespace {

void line() {
  ImGui::Dummy({1.0F, 2.0F});
  ImGui::Separator();
  ImGui::Dummy({1.0F, 2.0F});
}

// "&at=1.25&camera=...": the time, and where the camera is heading.
std::string moment_in_link(const Session& session, const OrbitCamera& camera) {
  const double time = session.state().time;
  return (time > 0.0 ? "&at=" + number_text(time) : "") + "&camera=" + camera.text();
}

void items(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport) {
  const Host& host = lab.host;
  if (host.copy_link && menu_item(look, "Copy link", "L")) host.copy_link("");
  if (host.copy_link && menu_item(look, "Copy link to this moment and view")) {
    host.copy_link(moment_in_link(lab.session, viewport.view.camera));
  }
  if (host.copy_embed && menu_item(look, "Copy HTML to embed it")) host.copy_embed();
  if (menu_item(look, "Copy command", "C")) copy_command(lab);
  if (host.open_link && menu_item(look, "Open the copied link")) host.open_link();
  line();
  if (host.open_file && menu_item(look, "Open scene …", "O")) host.open_file();
  if (menu_item(look, "New scene")) new_scene(lab, desk);
  if (menu_item(look, kEditByHand, "M")) open_model(desk);
  if (menu_item(look, kEditText, "E")) open_scene_text(desk);
  if (host.save_file && menu_item(look, "Save scene as it is now", "S")) lab.save_scene();
  line();
  if (host.save_file && menu_item(look, "Picture of the window", "P"))
    capture_window(lab.session, desk);
  if (host.save_file && menu_item(look, "Picture of the view")) {
    desk.capture = Capture{lab.session.scene().name + "_view.png", viewport.view_rect};
  }
  if (host.record && menu_item(look, desk.recording ? "Stop the video" : "Record a video")) {
    host.record(!desk.recording);
  }
}

}  // namespace

void copy_command(Lab& lab) {
  ImGui::SetClipboardText(lab.command().c_str());
  std::string said = "Command copied";
  if (lab.session.edition() != nullptr && lab.host.save_file) {
    // The edited scene, with the ball or without the effect, is not in a file yet.
    const Scene& scene = lab.link_scene();
    lab.host.save_file(scene.name + ".json", write_scene(scene));
    said += ", and its scene was saved";
  }
  lab.tell(said);
}

void capture_window(const Session& session, Desk& desk) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  desk.capture = Capture{session.scene().name + ".png", {0.0F, 0.0F, display.x, display.y}};
}

void share_menu(const Look& look, Lab& lab, Desk& desk, const Viewport& viewport, float size) {
  if (desk.open_share_menu) {
    desk.open_share_menu = false;
    ImGui::PushID("share");
    ImGui::OpenPopup("menu");
    ImGui::PopID();
  }
  icon_menu(look, "share", Icon::kShare, ButtonKind::kGhost, size, "Share, open, save",
            [&] { items(look, lab, desk, viewport); });
}

}  // namespace substep::ui

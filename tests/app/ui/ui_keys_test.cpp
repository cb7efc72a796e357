// The keyboard: every listed key has its effect, and panels can be reached without a mouse.

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "app/text/citation.hpp"
#include "app/ui/keys.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

// The state that a key may change, as text: a key that changes none of it has no effect.
std::string look_of(App& app) {
  const Desk& d = app.desk;
  const Session& s = app.session;
  std::string text = app.link() + "|" + std::to_string(s.state().frame) + "|" +
                     std::to_string(s.substeps_left()) + "|" + std::to_string(s.speed()) + "|" +
                     std::to_string(s.balls()) + "|" + std::to_string(s.playing()) + "|" +
                     std::to_string(d.scale) + "|" + std::to_string(d.tour) + "|" +
                     app.notice.text + "|" + std::to_string(app.run_count);
  for (const bool flag : {d.dark, d.panels, d.help, d.split, d.tab == Tab::kModel}) {
    text += flag ? '1' : '0';
  }
  const Vec3 eye = app.view.camera.eye(app.view_rect);
  for (int i = 0; i < 3; ++i) text += std::to_string(eye[i]) + ",";
  return text;
}

TEST(Keys, EveryListedKeyHasItsOwnEffect) {
  std::set<char> known;
  for (const ui::KeyAction& action : ui::key_actions()) {
    EXPECT_FALSE(action.shown.empty());
    EXPECT_FALSE(action.what.empty());
    for (const char key : action.typed) {
      EXPECT_TRUE(known.insert(key).second) << key;
      Headless h;
      std::string host;
      h.app->host.copy_link = [&](const std::string&) { host += "link"; };
      h.app->host.open_file = [&] { host += "open"; };
      h.app->host.save_file = [&](const std::string& name, const std::string&) { host += name; };
      h.app->set("mode", "capped");
      if (key == '5') h.app->set("mode", "none");
      for (int i = 0; i < 3; ++i) h.app->session.step();
      h.app->view.camera.orbit(0.4, 0.1);
      h.app->view.camera.zoom(0.5);
      h.app->view.camera.update(1.0, true);
      h.frames(30);
      const std::string before = look_of(*h.app) + host;
      ImGui::GetIO().AddInputCharacter(static_cast<unsigned char>(key));
      h.frames(12);
      EXPECT_NE(look_of(*h.app) + host, before) << "'" << key << "' " << action.what;
    }
  }
}

TEST(Keys, TypedIntoAFieldTheyAreText) {
  Headless h;
  h.app->browser.show(".");
  h.frames(3);
  ImGuiWindow* card = ImGui::FindWindowByName("##open_file");
  ASSERT_NE(card, nullptr);
  h.click(card->Pos.x + 100.0F, card->Pos.y + 60.0F);
  ASSERT_TRUE(ImGui::GetIO().WantTextInput);
  const bool dark = h.app->desk.dark;
  h.type("t");
  EXPECT_EQ(h.app->desk.dark, dark);
}

TEST(Keys, TheListStaysOnTheDisplay) {
  for (const ImVec2 display : {ImVec2(1280, 720), ImVec2(390, 844), ImVec2(844, 390)}) {
    Headless h(display.x, display.y);
    h.app->desk.help = true;
    h.frames(4);
    const ImGuiWindow* card = ImGui::FindWindowByName("##help");
    ASSERT_NE(card, nullptr);
    EXPECT_GE(card->Pos.x, 0.0F);
    EXPECT_GE(card->Pos.y, 0.0F);
    EXPECT_LE(card->Pos.x + card->Size.x, display.x);
    EXPECT_LE(card->Pos.y + card->Size.y, display.y);
  }
}

std::string file_text(const std::string& path) {
  std::ifstream in(std::string(SUBSTEP_SOURCE_DIR) + "/" + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(About, CopiesThePapersReferenceEntry) {
  Headless h;
  h.app->desk.help = true;
  h.frames(4);
  h.press("Copy BibTeX of the paper");
  const std::string copied = ImGui::GetClipboardText();
  const std::string references = file_text("core/docs/references.bib");
  std::istringstream lines(copied);
  int fields = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find(" = {") == std::string::npos) continue;
    ++fields;
    const std::string field = line.substr(0, line.rfind('}') + 1);
    EXPECT_NE(references.find(field), std::string::npos) << field;
  }
  EXPECT_EQ(fields, 5);
  EXPECT_NE(copied.find(kPaperTitle), std::string::npos);
  EXPECT_NE(copied.find(kPaperDoi), std::string::npos);
}

TEST(About, ShowsTheLicenceOfTheRepository) {
  const std::string licence = file_text("LICENSE");
  EXPECT_TRUE(licence.starts_with("MIT License"));
  EXPECT_NE(licence.find("2026 The substep authors"), std::string::npos);
  EXPECT_STREQ(kLicence, "MIT licence, © 2026 The substep authors");
}

void press(Headless& h, ImGuiKey key, bool shift = false) {
  ImGuiIO& io = ImGui::GetIO();
  if (shift) io.AddKeyEvent(ImGuiMod_Shift, true);
  io.AddKeyEvent(key, true);
  h.frames(1);
  io.AddKeyEvent(key, false);
  if (shift) io.AddKeyEvent(ImGuiMod_Shift, false);
  h.frames(2);
}

std::string focused() {
  const ImGuiWindow* w = ImGui::GetCurrentContext()->NavWindow;
  return w == nullptr ? "" : w->RootWindow->Name;
}

TEST(Keys, F6GoesFromPanelToPanelAndBack) {
  for (const float width : {1280.0F, 390.0F}) {
    Headless h(width, width > 900.0F ? 720.0F : 844.0F);
    std::vector<std::string> way;
    for (int i = 0; i < 12; ++i) {
      press(h, ImGuiKey_F6);
      way.push_back(focused());
    }
    const std::set<std::string> panels(way.begin(), way.end());
    const std::set<std::string> expected =
        width > 900.0F ? std::set<std::string>{"##controls",    "##plots",     "##transport",
                                               "##tour_button", "##left_edge", "##right_edge"}
                       : std::set<std::string>{"##phone", "##tour_button"};
    EXPECT_EQ(panels, expected);
    press(h, ImGuiKey_F6, true);
    EXPECT_EQ(focused(), way[way.size() - 2]);
    // From there the arrow keys and the space bar operate its controls.
    EXPECT_NE(ImGui::GetCurrentContext()->NavId, 0U);
    EXPECT_FALSE(ImGui::GetCurrentContext()->NavDisableHighlight);
  }
}

}  // namespace
}  // namespace substep

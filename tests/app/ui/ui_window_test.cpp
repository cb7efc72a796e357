#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/ui/over_picture.hpp"
#include "app/ui/widgets.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

struct Display {
  float width;
  float height;
  float ratio;
};
constexpr std::array<Display, 7> kDisplays{{{1280, 720, 1.0F},
                                            {1280, 720, 1.5F},
                                            {1920, 1080, 2.0F},
                                            {900, 600, 1.0F},
                                            {390, 844, 2.0F},
                                            {844, 390, 2.0F},
                                            {320, 568, 1.0F}}};

// Open windows, without the picture's own and child windows.
std::vector<const ImGuiWindow*> open_windows() {
  std::vector<const ImGuiWindow*> windows;
  for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
    const bool child = (w->Flags & ImGuiWindowFlags_ChildWindow) != 0;
    if (!w->WasActive || w->Hidden || child || std::string(w->Name) == "##view" ||
        std::string(w->Name).starts_with("Debug")) {
      continue;
    }
    windows.push_back(w);
  }
  return windows;
}

TEST(Window, EverySceneInEveryModeDrawsItsPicture) {
  Headless h;
  ASSERT_GE(h.app->library.scenes().size(), 10U);
  for (const auto& scene : h.app->library.scenes()) {
    h.app->run(scene);
    for (const char* mode : {"none", "const", "damping", "adaptive", "capped"}) {
      ASSERT_EQ(h.app->set("mode", mode), "");
      h.app->session.play();  // a failed run is paused
      h.frames(8);
      const Picture& p = h.renderer->picture;
      EXPECT_GT(p.boxes.size() + p.balls.size(), 0U) << scene->name;
      EXPECT_TRUE(p.view_projection.allFinite()) << scene->name;
    }
    EXPECT_GT(h.app->session.state().frame, 20) << scene->name;
  }
}

TEST(Window, PanelsDoNotOverlapAndStayOnTheDisplay) {
  for (const Display& d : kDisplays) {
    Headless h(d.width, d.height, d.ratio);
    for (const bool dark : {true, false}) {
      h.app->desk.dark = dark;
      for (const auto& scene : h.app->library.scenes()) {
        h.app->run(scene);
        h.frames(3);
        const auto windows = open_windows();
        ASSERT_FALSE(windows.empty());
        for (std::size_t i = 0; i < windows.size(); ++i) {
          const ImRect a = windows[i]->Rect();
          EXPECT_GE(a.Min.x, 0.0F) << windows[i]->Name;
          EXPECT_GE(a.Min.y, 0.0F) << windows[i]->Name;
          EXPECT_LE(a.Max.x, d.width) << windows[i]->Name;
          EXPECT_LE(a.Max.y, d.height) << windows[i]->Name;
          for (std::size_t j = i + 1; j < windows.size(); ++j) {
            EXPECT_FALSE(a.Overlaps(windows[j]->Rect()))
                << windows[i]->Name << " and " << windows[j]->Name << " at " << d.width << "x"
                << d.height;
          }
        }
      }
    }
  }
}

TEST(Window, PanelsOfTheDesktopNeedNoScrolling) {
  Headless h(1280, 720);
  for (const auto& scene : h.app->library.scenes()) {
    h.app->run(scene);
    h.frames(3);
    for (const ImGuiWindow* w : open_windows()) {
      EXPECT_EQ(w->ScrollMax.y, 0.0F) << w->Name << " in " << scene->name;
    }
  }
}

// Whatever is tracked stays in the picture for as long as the scene is judged.
TEST(Window, TheCameraFollowsAMotionThatWouldLeaveThePicture) {
  for (const char* name : {"free_fall", "sliding_box"}) {
    for (const auto& [width, height] : {std::pair{1280.0F, 720.0F}, std::pair{390.0F, 844.0F}}) {
      Headless h(width, height);
      h.app->run(shipped(name));
      Session& session = h.app->session;
      session.pause();
      h.frames(2);
      const Vec3 home = h.app->view.camera.target();
      const auto body = index(session.scene().criteria.track.value_or(0));
      for (int i = 0; i < 400; ++i) {
        session.step();
        if (i % 20 != 0) continue;
        h.frames(1);
        ImVec2 p;
        ASSERT_TRUE(ui::project(*h.app, session.state().x[body], p));
        const ViewRect& v = h.app->view_rect;
        ASSERT_TRUE(p.x > v.x && p.x < v.x + v.width && p.y > v.y && p.y < v.y + v.height)
            << name << " at " << session.state().time << " s: " << p.x << ", " << p.y;
      }
      EXPECT_GT((h.app->view.camera.target() - home).norm(), 1.0) << name;
      session.reset();
      h.frames(1);
      EXPECT_EQ(h.app->view.camera.target(), home) << name;
    }
  }
}

TEST(Window, TheCameraStaysWhileTheMotionIsInThePicture) {
  Headless h;
  for (const auto& scene : h.app->library.scenes()) {
    h.app->run(scene);
    h.app->session.pause();
    h.frames(1);
    const Vec3 home = h.app->view.camera.target();
    if (home != scene->camera.target) continue;  // it starts above the picture
    for (int i = 0; i < 60; ++i) h.app->session.step();
    h.frames(1);
    EXPECT_EQ(h.app->view.camera.target(), home) << scene->name;
  }
}

// The camera uses only the start: the scene's own camera must leave room for falling bodies.
TEST(Window, CratesFallWhereNoPanelIsOverThem) {
  Headless h;
  h.app->open("wrecking_ball");
  h.app->session.pause();
  h.frames(1);  // records the start
  for (int i = 0; i < 360; ++i) h.app->session.step();
  h.frames(3);
  const ViewRect& view = h.app->view_rect;
  const auto& bodies = h.app->session.scene().bodies;
  int crates = 0;
  int seen = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].name.starts_with("crate")) continue;
    ++crates;
    ImVec2 at;
    if (!ui::project(*h.app, h.app->session.poses().x[i], at)) continue;
    seen += at.x > view.x && at.x < view.x + view.width && at.y < view.y + view.height ? 1 : 0;
  }
  EXPECT_EQ(crates, 30);
  EXPECT_GE(seen, 25) << "a few slide far";
}

TEST(Window, FontsFollowThePixelRatio) {
  Headless h(1280, 720, 1.0F);
  const float before = h.app->look.fonts.regular->FontSize;
  h.resize(1280, 720, 2.0F);
  h.frames(2);
  EXPECT_FLOAT_EQ(h.app->look.fonts.regular->FontSize, 2.0F * before);
  EXPECT_FLOAT_EQ(ImGui::GetIO().FontGlobalScale, 0.5F);
  EXPECT_EQ(h.renderer->fonts, 1);
}

TEST(Window, NoLineIsBrokenBetweenANumberAndItsUnit) {
  Headless h;
  const std::string text = "It takes 0.8 % of 12,000 J, over 10 s. Of 3 boxes 2 stand.";
  for (float width = 20.0F; width < 500.0F; width += 3.0F) {
    std::string lines = ui::wrapped(h.app->look.fonts.small, text.c_str(), width);
    for (const char* unit : {"\n%", "\nJ", "\ns."}) {
      EXPECT_EQ(lines.find(unit), std::string::npos) << width << ": " << lines;
    }
    std::replace(lines.begin(), lines.end(), '\n', ' ');
    EXPECT_EQ(lines, text);
  }
}

TEST(Window, EveryCharacterShownHasAGlyph) {
  Headless h;
  const ImFont* font = h.app->look.fonts.regular;
  for (const ImWchar c : {u'α', u'√', u'×', u'·', u'²', u'⁻', u'⁶', u'−', u'…', u'µ', u'∞', u'ü'}) {
    EXPECT_NE(font->FindGlyphNoFallback(c), nullptr) << static_cast<int>(c);
  }
  EXPECT_FLOAT_EQ(font->FindGlyph('1')->AdvanceX, font->FindGlyph('8')->AdvanceX);
}

TEST(Keys, DriveTheRun) {
  Headless h;
  EXPECT_FALSE(h.app->session.playing());
  h.type(" ");
  EXPECT_TRUE(h.app->session.playing());
  h.frames(10);
  h.type(" ");
  EXPECT_FALSE(h.app->session.playing());
  const auto frame = h.app->session.state().frame;
  EXPECT_GT(frame, 0);
  h.type(".");
  EXPECT_EQ(h.app->session.state().frame, frame + 1);
  h.type("r");
  EXPECT_EQ(h.app->session.state().frame, 0);
  h.type("3");
  EXPECT_EQ(h.app->session.settings().mode, Mode::kDamping);
  h.type("?");
  EXPECT_TRUE(h.app->desk.help);
  h.type("t");
  EXPECT_FALSE(h.app->desk.dark);
  h.type("]");
  EXPECT_EQ(h.app->session.speed(), 2.0);
  h.type("h");
  EXPECT_FALSE(h.app->desk.panels);
}

TEST(Pointer, ChoosesAModeAndTurnsTheView) {
  Headless h;
  h.press("damping");
  EXPECT_EQ(h.app->session.settings().mode, Mode::kDamping);

  const Vec3 eye = h.app->view.camera.eye(h.app->view_rect);
  ImGuiIO& io = ImGui::GetIO();
  io.AddMousePosEvent(620.0F, 300.0F);
  h.frames(1);
  io.AddMouseButtonEvent(0, true);
  h.frames(1);
  io.AddMousePosEvent(720.0F, 300.0F);
  h.frames(1);
  io.AddMouseButtonEvent(0, false);
  h.frames(30);
  EXPECT_GT((h.app->view.camera.eye(h.app->view_rect) - eye).norm(), 1.0);
}

TEST(Failure, RunThatIsNoLongerFinitePausesAndResets) {
  Headless h;
  // An explicit gyroscopic torque at this speed gains energy without bound.
  Scene wild = *h.app->library.find("spinning_top");
  for (Body& body : wild.bodies) body.angular_velocity = {300.0, 2000.0, 100.0};
  wild.settings.gyroscopic = Gyroscopic::kExplicit;
  wild.settings.mode = Mode::kNone;
  h.app->run(std::make_shared<const Scene>(wild));
  h.app->session.play();
  h.frames(120);
  ASSERT_TRUE(h.app->session.stopped());
  EXPECT_FALSE(h.app->session.playing());
  EXPECT_TRUE(h.app->session.verdict().stopped());
  for (const Vec3& x : h.app->session.state().x) EXPECT_TRUE(x.allFinite());
  h.type(" ");
  EXPECT_FALSE(h.app->session.playing());
  h.app->session.go_to_last_good();
  EXPECT_FALSE(h.app->session.stopped());
  h.type("r");
  EXPECT_FALSE(h.app->session.stopped());
  h.type(" ");
  EXPECT_TRUE(h.app->session.playing());
}

TEST(Trouble, BrokenSceneIsShownAndTheRunningOneKept) {
  Headless h;
  h.app->open("bridge");
  h.app->session.step();
  const std::uint64_t hash = h.app->session.hash();
  EXPECT_FALSE(
      h.app->open_text(R"({"format": "substep-scene", "version": 1, "bodies": 3})", "bad.json"));
  EXPECT_EQ(h.app->trouble.title, "bad.json was not loaded");
  EXPECT_GE(h.app->trouble.problems.size(), 2U);
  h.frames(3);
  EXPECT_EQ(h.app->session.scene().name, "bridge");
  EXPECT_EQ(h.app->session.hash(), hash);
  ImGui::GetIO().AddKeyEvent(ImGuiKey_Escape, true);
  h.frames(2);
  EXPECT_TRUE(h.app->trouble.title.empty());
}

TEST(Trouble, ManyAndLongProblemsStayOnTheDisplay) {
  Headless h(390, 844, 2.0F);
  h.app->trouble.title.assign(200, 'x');
  h.app->trouble.title += " was not loaded";
  for (int i = 0; i < 300; ++i) {
    h.app->trouble.problems.push_back({"/bodies/" + std::to_string(i), std::string(400, 'y')});
  }
  h.frames(4);
  for (const ImGuiWindow* w : open_windows()) {
    EXPECT_LE(w->Rect().Max.y, 844.0F) << w->Name;
    EXPECT_LE(w->Rect().Max.x, 390.0F) << w->Name;
  }
}

TEST(ReadOut, FitsOnTheDisplayAndIsAsWideAsItsLines) {
  Headless h;
  const std::vector<ui::ReadOutLine> lines{{"BPP, adaptive per frame", 0, true},
                                           {"alpha = 0.1 and a sentence that is longer", 0},
                                           {"Click to run it", 0}};
  for (const ImVec2 mouse : {ImVec2(2, 2), ImVec2(1278, 2), ImVec2(1278, 718), ImVec2(2, 718)}) {
    ImGui::GetIO().AddMousePosEvent(mouse.x, mouse.y);
    for (int i = 0; i < 4; ++i) {
      ImGui::GetIO().DeltaTime = static_cast<float>(kFrame);
      ImGui::NewFrame();
      ui::read_out(h.app->look, lines);
      ImGui::Render();
    }
    const ImGuiWindow* tip = ImGui::FindWindowByName("##Tooltip_00");
    ASSERT_NE(tip, nullptr);
    EXPECT_GT(tip->Size.x, 200.0F);
    EXPECT_LT(tip->Size.y, 90.0F);
    EXPECT_GE(tip->Rect().Min.x, 0.0F);
    EXPECT_GE(tip->Rect().Min.y, 0.0F);
    EXPECT_LE(tip->Rect().Max.x, 1280.0F);
    EXPECT_LE(tip->Rect().Max.y, 720.0F);
  }
}

// A display too small for the interface shows all of it, smaller.
TEST(Window, TinyDisplaysShowTheWholeInterface) {
  struct Size {
    float width, height;
  };
  for (const auto& [width, height] :
       {Size{200, 150}, Size{320, 100}, Size{90, 400}, Size{40, 30}, Size{1, 1}}) {
    SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
    Headless h(width, height, 1.0F);
    h.app->introduction.offer(*h.app);
    h.frames(10);
    h.app->introduction.leave(*h.app);
    for (const char* link :
         {"scene=pendulum", "scene=pendulum&level=explore", "scene=bridge&panel=why",
          "scene=bridge&panel=accuracy&level=lab", "scene=heavy_stack&compare=mode:none",
          "scene=swinging_box&mode=none", "scene=wall&tint=on&forces=on", "scene=nowhere&warp=9",
          "tour=1", "tour=off&panels=off"}) {
      h.app->open_link(link);
      h.app->session.play();
      h.frames(45);
      for (const ImGuiWindow* w : open_windows()) {
        EXPECT_GT(w->Size.x, 0.0F) << link << " " << w->Name;
        EXPECT_GT(w->Size.y, 0.0F) << link << " " << w->Name;
      }
      EXPECT_GT(h.app->view_rect.width, 0.0F) << link;
      EXPECT_GT(h.app->view_rect.height, 0.0F) << link;
      EXPECT_TRUE(h.renderer->picture.view_projection.allFinite()) << link;
      EXPECT_EQ(imgui::complaints(), h.complaints) << link;
    }
    // Controls are where they are drawn.
    h.click(0.5F * width, 0.5F * height);
  }
}

// Dear ImGui's assertions are reported in every build and end no run.
TEST(Window, AnInvalidCallOfDearImguiIsReportedAndEndsNothing) {
  Headless h;
  ImGui::NewFrame();
  ImGui::Begin("wrong");
  ImGui::SetCursorPosY(1000.0F);  // space outside of any item
  testing::internal::CaptureStderr();
  ImGui::End();
  EXPECT_NE(testing::internal::GetCapturedStderr().find("SetCursorPos"), std::string::npos);
  ImGui::Render();
  EXPECT_EQ(imgui::complaints(), ++h.complaints);
  h.frames(2);
}

}  // namespace
}  // namespace substep

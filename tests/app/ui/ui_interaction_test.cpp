// The pointer in the picture, and the timeline scrubber.

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <cmath>
#include <string>

#include "app/render/picking.hpp"
#include "app/ui/over_picture.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

int body_of(const App& app, const std::string& name) {
  const auto& bodies = app.session.scene().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].name == name) return static_cast<int>(i);
  }
  ADD_FAILURE() << name;
  return 0;
}

ImVec2 on_display(const App& app, int body) {
  ImVec2 p;
  EXPECT_TRUE(ui::project(app, app.session.poses().x[static_cast<std::size_t>(body)], p));
  return p;
}

void point_at(Headless& h, ImVec2 p) {
  ImGui::GetIO().AddMousePosEvent(p.x, p.y);
  h.frames(1);
}

void press(Headless& h, bool down) {
  ImGui::GetIO().AddMouseButtonEvent(0, down);
  h.frames(1);
}

void key(Headless& h, ImGuiKey k) {
  ImGui::GetIO().AddKeyEvent(k, true);
  h.frames(1);
  ImGui::GetIO().AddKeyEvent(k, false);
  h.frames(1);
}

bool is_open(const char* window) {
  const ImGuiWindow* w = ImGui::FindWindowByName(window);
  return w != nullptr && w->WasActive && !w->Hidden;
}

TEST(Picking, RayHitsTheVisibleBody) {
  for (const char* scene : {"swinging_box", "bridge", "heavy_stack"}) {
    Headless h;
    h.app->open(scene);
    h.frames(2);
    const Session& session = h.app->session;
    const auto& bodies = session.scene().bodies;
    int met = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (std::holds_alternative<Plane>(bodies[i].shape)) continue;
      const ImVec2 p = on_display(*h.app, static_cast<int>(i));
      const Ray ray = ray_through(h.app->pictures.front().view_projection.cast<double>(),
                                  2.0 * static_cast<double>(p.x) / 1280.0 - 1.0,
                                  1.0 - 2.0 * static_cast<double>(p.y) / 720.0);
      const Vec3 to_centre = session.poses().x[i] - ray.origin;
      EXPECT_LT(ray.direction.cross(to_centre).norm(), 2e-3 * to_centre.norm());
      const auto hit = first_hit(ray, session.scene(), session.poses());
      ASSERT_TRUE(hit);
      EXPECT_LT(hit->distance, to_centre.norm());
      met += hit->body == static_cast<int>(i) ? 1 : 0;
    }
    EXPECT_GT(met, 3) << "visible bodies are picked, in " << scene;
  }
}

TEST(Picking, RayMissesBodiesBesideIt) {
  Scene scene;
  scene.bodies.resize(2);
  scene.bodies[0].shape = Sphere{1.0};
  scene.bodies[1].shape = Box{{1.0, 0.5, 0.25}};
  Poses poses;
  poses.x = {{0.0, 0.0, -5.0}, {0.0, 0.0, -10.0}};
  // Turned by 90 degrees about z, the box is 1 high and 0.5 wide.
  poses.q = {Quat::Identity(), Quat(Eigen::AngleAxisd(1.5707963267948966, Vec3::UnitZ()))};
  const auto along_z = [&](double x, double y) {
    return first_hit({{x, y, 0.0}, -Vec3::UnitZ()}, scene, poses);
  };
  ASSERT_TRUE(along_z(0.0, 0.0));
  EXPECT_EQ(along_z(0.0, 0.0)->body, 0);
  EXPECT_NEAR(along_z(0.0, 0.0)->distance, 4.0, 1e-12);
  EXPECT_NEAR(along_z(0.6, 0.0)->distance, 5.0 - 0.8, 1e-12);
  EXPECT_FALSE(along_z(1.01, 0.0));
  poses.x[0].x() = 9.0;
  EXPECT_EQ(along_z(0.4, 0.9)->body, 1);
  EXPECT_NEAR(along_z(0.4, 0.9)->distance, 9.75, 1e-9);
  EXPECT_FALSE(along_z(0.6, 0.9));
  EXPECT_FALSE(first_hit({{0.0, 0.0, -20.0}, -Vec3::UnitZ()}, scene, poses)) << "behind";
}

TEST(Selection, ClickShowsABodyAndAClickBesideHidesIt) {
  Headless h;
  const int box = body_of(*h.app, "box");
  const ImVec2 p = on_display(*h.app, box);
  h.click(p.x, p.y);
  EXPECT_EQ(h.app->desk.selected, box);
  h.frames(2);
  EXPECT_TRUE(is_open("##selection"));
  EXPECT_EQ(h.app->session.state().frame, 0) << "a selection does not change the run";
  EXPECT_FALSE(h.app->session.verdict().disturbed());
  h.click(640.0F, 560.0F);
  EXPECT_EQ(h.app->desk.selected, -1);
  h.frames(2);
  EXPECT_FALSE(is_open("##selection"));
  h.app->desk.selected = box;
  h.frames(2);
  h.app->open("pendulum");
  h.frames(2);
  EXPECT_FALSE(is_open("##selection")) << "another scene, other bodies";
}

TEST(Hand, DragPullsABodyWhileTheRunPlays) {
  Headless h;
  h.app->session.play();
  h.frames(5);
  const int box = body_of(*h.app, "box");
  const Vec3 eye = h.app->view.camera.eye(h.app->view_rect);
  ImVec2 p = on_display(*h.app, box);
  point_at(h, p);
  press(h, true);
  EXPECT_FALSE(h.app->session.held()) << "not before the pointer moves";
  for (int i = 0; i < 30; ++i) {
    p.y -= 4.0F;
    point_at(h, p);
  }
  ASSERT_TRUE(h.app->session.held());
  EXPECT_EQ(h.app->session.held()->body, box);
  ImVec2 target;
  ASSERT_TRUE(ui::project(*h.app, h.app->session.held()->target, target));
  EXPECT_NEAR(target.x, p.x, 1.5F);
  EXPECT_NEAR(target.y, p.y, 1.5F);
  EXPECT_LT((h.app->view.camera.eye(h.app->view_rect) - eye).norm(), 1e-9) << "the view stays";
  h.frames(60);
  const auto i = static_cast<std::size_t>(box);
  const double pulled = h.app->session.state().x[i].y();
  press(h, false);
  EXPECT_FALSE(h.app->session.held());
  EXPECT_EQ(h.app->desk.selected, -1) << "a drag is no click";
  EXPECT_TRUE(h.app->session.verdict().disturbed());
  Session alone(shipped("swinging_box"));
  while (alone.state().frame < h.app->session.state().frame) alone.step();
  EXPECT_GT(pulled, alone.state().x[i].y() + 0.5);
}

TEST(Hand, DragOnABodyTurnsTheViewWhileTheRunRests) {
  Headless h;
  const Vec3 eye = h.app->view.camera.eye(h.app->view_rect);
  const ImVec2 p = on_display(*h.app, body_of(*h.app, "box"));
  point_at(h, p);
  press(h, true);
  point_at(h, {p.x - 30.0F, p.y});
  point_at(h, {p.x - 90.0F, p.y});
  press(h, false);
  h.frames(30);
  EXPECT_FALSE(h.app->session.verdict().disturbed());
  EXPECT_GT((h.app->view.camera.eye(h.app->view_rect) - eye).norm(), 1.0);
}

TEST(Hand, APressFarFromThePointerDoesNotTurnTheView) {
  Headless h;
  point_at(h, {640.0F, 300.0F});
  const Vec3 eye = h.app->view.camera.eye(h.app->view_rect);
  ImGui::GetIO().AddMousePosEvent(560.0F, 620.0F);  // in the frame of the press
  press(h, true);
  press(h, false);
  h.frames(30);
  EXPECT_LT((h.app->view.camera.eye(h.app->view_rect) - eye).norm(), 1e-9);
}

bool tooltip_open() {
  const auto& windows = ImGui::GetCurrentContext()->Windows;
  return std::any_of(windows.begin(), windows.end(), [](const ImGuiWindow* w) {
    return (w->Flags & ImGuiWindowFlags_Tooltip) != 0 && w->WasActive && !w->Hidden;
  });
}

// The middle of a control of the Lab.
ImVec2 middle_of(Headless& h, std::string_view label) {
  h.app->set("level", "lab");
  h.frames(3);
  const ui::Handle* handle = find_handle(label);
  EXPECT_NE(handle, nullptr) << label;
  if (handle == nullptr) return {};
  return {0.5F * (handle->min.x + handle->max.x), 0.5F * (handle->min.y + handle->max.y)};
}

TEST(Tooltips, StayClosedOverWhatWasClicked) {
  Headless h;
  const ImVec2 at = middle_of(h, "Why N");
  point_at(h, at);
  h.frames(60);
  EXPECT_TRUE(tooltip_open()) << "the pointer rests";
  h.click(at.x, at.y);
  h.frames(60);
  EXPECT_FALSE(tooltip_open());
  point_at(h, {640.0F, 400.0F});
  h.frames(60);
  point_at(h, at);
  h.frames(60);
  EXPECT_TRUE(tooltip_open()) << "the pointer has come back";
}

TEST(Tooltips, OpenUnderAFinger) {
  Headless h;
  const ImVec2 at = middle_of(h, "Why N");
  ImGui::GetIO().AddMouseSourceEvent(ImGuiMouseSource_TouchScreen);
  point_at(h, at);
  press(h, true);
  h.frames(60);
  EXPECT_TRUE(tooltip_open());
  press(h, false);
}

TEST(Tooltips, OpenAtTheFocusOfTheKeyboardAfterAClick) {
  Headless h;
  const ImVec2 at = middle_of(h, "Why N");
  h.click(at.x, at.y);
  h.frames(60);
  ASSERT_FALSE(tooltip_open());
  for (int i = 0; i < 40 && !tooltip_open(); ++i) {
    key(h, ImGuiKey_Tab);
    h.frames(40);
  }
  EXPECT_TRUE(tooltip_open());
}

TEST(Hand, BallFliesAtThePointer) {
  Headless h;
  h.app->session.play();
  h.frames(3);
  const std::size_t bodies = h.app->session.scene().bodies.size();
  const ImVec2 aim(560.0F, 330.0F);
  point_at(h, aim);
  h.type("b");
  ASSERT_EQ(h.app->session.balls(), 1U);
  float closest = 1e6F;
  for (int i = 0; i < 60; ++i) {
    h.frames(1);
    const ImVec2 p = on_display(*h.app, static_cast<int>(bodies));
    closest = std::min(closest, std::hypot(p.x - aim.x, p.y - aim.y));
  }
  EXPECT_LT(closest, 25.0F);
  EXPECT_EQ(h.app->session.scene().name, "swinging_box") << "links name the scene that was loaded";
  h.type("r");
  EXPECT_EQ(h.app->session.balls(), 0U);
}

TEST(Keys, GoBackAndForthInThePast) {
  Headless h;
  for (int i = 0; i < 12; ++i) h.app->session.step();
  const std::uint64_t end = h.app->session.hash();
  h.type(",");
  h.type(",");
  EXPECT_EQ(h.app->session.state().frame, 10);
  h.type(".");
  EXPECT_EQ(h.app->session.state().frame, 11);
  key(h, ImGuiKey_Home);
  EXPECT_EQ(h.app->session.state().frame, 0);
  key(h, ImGuiKey_End);
  EXPECT_EQ(h.app->session.hash(), end);
  h.type(";");
  EXPECT_GT(h.app->session.substeps_left(), 0);
  EXPECT_GT(h.app->session.state().time, 12.0 * kFrame);
  EXPECT_EQ(h.app->session.state().frame, 12);
  h.type(".");
  EXPECT_EQ(h.app->session.state().frame, 13);
}

// The slider of alpha, by a click on its number and by Ctrl and a click anywhere.
TEST(Slider, TakesATypedValue) {
  for (const bool on_number : {true, false}) {
    Headless h;
    h.app->session.pause();
    h.frames(2);
    const ui::Handle* alpha = find_handle("Alpha  α");
    ASSERT_NE(alpha, nullptr);
    const float y = 0.5F * (alpha->min.y + alpha->max.y);
    const float x = on_number ? alpha->max.x - 8.0F : 0.5F * (alpha->min.x + alpha->max.x);
    if (!on_number) ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, true);
    h.frames(1);
    h.click(x, y);
    if (!on_number) ImGui::GetIO().AddKeyEvent(ImGuiMod_Ctrl, false);
    h.frames(1);
    EXPECT_TRUE(ImGui::GetIO().WantTextInput);
    h.type("0.037");
    key(h, ImGuiKey_Enter);
    h.frames(1);
    EXPECT_DOUBLE_EQ(h.app->session.settings().alpha, 0.037);
    EXPECT_EQ(h.app->session.settings().mode, Mode::kAdaptive) << "digits are no shortcuts";
  }
}

// Between two pictures a fast body has moved on: a press beside it takes the nearest.
TEST(Hand, TakesTheNearestBodyOfARunThatPlays) {
  Headless h;
  Session& session = h.app->session;
  session.play();
  h.frames(20);
  const int box = body_of(*h.app, "box");
  session.pause();
  h.app->view.camera.zoom(0.4);  // the box is smaller than the distance
  h.frames(60);
  const ImVec2 at = on_display(*h.app, box);
  // The first place on the side without the chain that shows none of the box.
  float aside = 0.0F;
  const auto pressed_body = [&](float by) {
    point_at(h, {at.x + by, at.y});
    press(h, true);
    const int body = h.app->hand.body;
    press(h, false);
    return body;
  };
  while (aside < 28.0F && pressed_body(aside) == box) aside += 1.0F;
  ASSERT_LT(aside, 28.0F) << "within this distance the nearest body is taken";
  EXPECT_EQ(pressed_body(aside), -1) << "a press beside it turns the view of a paused run";
  session.play();
  h.app->session.set_speed(0.01);
  EXPECT_EQ(pressed_body(aside), box);
  EXPECT_EQ(pressed_body(aside + 60.0F), -1);
}

TEST(Touch, TargetsOfAPhoneAre44PixelsHigh) {
  Headless h(390.0F, 844.0F, 2.0F);
  h.app->session.play();
  h.frames(2);
  const ui::Handle* reset = find_handle("reset");
  ASSERT_NE(reset, nullptr);
  const float height = reset->max.y - reset->min.y;
  const float beyond = 0.5F * (44.0F - height) - 1.0F;
  ASSERT_GT(beyond, 0.0F);
  ASSERT_GT(h.app->session.state().frame, 0);
  h.app->session.pause();
  h.click(0.5F * (reset->min.x + reset->max.x), reset->min.y - beyond);
  EXPECT_EQ(h.app->session.state().frame, 0);
}

TEST(Scrubber, DragLooksBackAndPausesTheRun) {
  for (const ImVec2 display : {ImVec2(1280, 720), ImVec2(390, 844)}) {
    Headless h(display.x, display.y);
    for (int i = 0; i < 100; ++i) h.app->session.step();
    h.app->session.play();
    h.frames(2);
    const auto end = h.app->session.state().frame;
    // The middle of the track: found by hovering, as a user would.
    const ImGuiWindow* bar = ImGui::FindWindowByName(display.x > 900 ? "##transport" : "##phone");
    ASSERT_NE(bar, nullptr);
    const float y = display.x > 900 ? bar->Pos.y + 28.0F : bar->Pos.y + 66.0F;
    const float x = display.x > 900 ? 500.0F : 200.0F;
    h.click(x, y);
    EXPECT_FALSE(h.app->session.playing());
    const auto middle = h.app->session.state().frame;
    EXPECT_GT(middle, 5);
    EXPECT_LT(middle, end - 5);
    EXPECT_EQ(h.app->session.timeline().last().state.frame, h.app->session.history().size());
    point_at(h, {x, y});
    press(h, true);
    point_at(h, {x - 30.0F, y});
    press(h, false);
    EXPECT_LT(h.app->session.state().frame, middle);
  }
}

TEST(Failure, ReturnsToTheLastGoodStateAndContinues) {
  Headless h;
  ASSERT_EQ(h.app->set("mode", "none"), "");
  for (int i = 0; i < 40; ++i) h.app->session.step();
  ASSERT_FALSE(h.app->session.verdict().holds());
  h.frames(2);
  EXPECT_TRUE(is_open("##failure"));
  h.app->session.go_to_last_good(0.3);  // before it began to swing up
  ASSERT_EQ(h.app->set("mode", "adaptive"), "");
  h.frames(2);
  EXPECT_FALSE(is_open("##failure"));
  h.app->session.play();
  h.frames(60);
  EXPECT_TRUE(h.app->session.verdict().holds()) << h.app->session.verdict().text();
}

TEST(Failure, OffersRemediesThatHold) {
  Headless h;
  const auto try_all = [&h] {
    h.frames(2);
    EXPECT_TRUE(h.app->trying_remedies());
    EXPECT_TRUE(h.app->busy()) << "otherwise an idle page would not continue";
    for (int i = 0; i < 5000 && h.app->trying_remedies(); ++i) h.frames(1);
    h.frames(2);
    EXPECT_FALSE(h.app->trying_remedies());
  };
  ASSERT_EQ(h.app->set("mode", "none"), "");
  for (int i = 0; i < 40; ++i) h.app->session.step();
  try_all();
  h.press("Reset with adaptive sub-steps");
  h.frames(1);
  EXPECT_EQ(h.app->session.settings().mode, Mode::kAdaptive);
  EXPECT_EQ(h.app->session.state().frame, 0);
  EXPECT_FALSE(is_open("##failure"));

  ASSERT_EQ(h.app->set("solver", "pgs"), "");
  ASSERT_EQ(h.app->set("n_max", "2"), "");
  for (int i = 0; i < 60; ++i) h.app->session.step();
  try_all();
  EXPECT_NE(find_handle("Reset with a larger cap, 10 sub-steps per frame"), nullptr);
  EXPECT_EQ(find_handle("Reset with the direct solver"), nullptr) << "two sub-steps are too few";
}

int vertices_over_the_picture() { return ImGui::GetBackgroundDrawList()->VtxBuffer.Size; }

TEST(Show, DrawsOnlyWhatIsSwitchedOn) {
  Headless h;
  h.app->open("bridge");
  ASSERT_EQ(h.app->set("tint", "off"), "");
  h.app->session.play();
  h.frames(60);
  h.app->session.pause();
  h.frames(2);
  const int plain = vertices_over_the_picture();
  for (const char* option : {"forces", "contacts", "frames", "errors", "axes"}) {
    ASSERT_EQ(h.app->set(option, "on"), "");
    h.frames(1);
    EXPECT_GT(vertices_over_the_picture(), plain + 20) << option;
    ASSERT_EQ(h.app->set(option, "off"), "");
    h.frames(1);
    EXPECT_EQ(vertices_over_the_picture(), plain) << option;
  }
  EXPECT_NE(h.app->set("forces", "maybe"), "");
}

TEST(Show, PastFramesHaveTheirForces) {
  Headless h;
  for (int i = 0; i < 20; ++i) h.app->session.step();
  const auto then = h.app->session.forces().joints.front().force;
  ASSERT_GT(then.norm(), 0.0F);
  for (int i = 0; i < 20; ++i) h.app->session.step();
  EXPECT_NE(h.app->session.forces().joints.front().force, then);
  h.app->session.go_to(20);
  EXPECT_EQ(h.app->session.forces().joints.front().force, then);
}

TEST(Controls, UnfoldedScrollWithinTheirPanel) {
  Headless h(1280, 720);
  h.app->desk.more = true;
  for (const auto& scene : h.app->library.scenes()) {
    for (const char* solver : {"pgs", "bpp"}) {
      h.app->run(scene);
      ASSERT_EQ(h.app->set("solver", solver), "");
      ASSERT_EQ(h.app->set("policy", "substep"), "");
      h.frames(3);
      const ImGuiWindow* panel = ImGui::FindWindowByName("##controls");
      ASSERT_NE(panel, nullptr);
      EXPECT_LE(panel->Rect().Max.y, ImGui::FindWindowByName("##transport")->Pos.y);
      EXPECT_EQ(panel->ScrollMax.x, 0.0F) << scene->name;
    }
  }
}

}  // namespace
}  // namespace substep

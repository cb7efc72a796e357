#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <map>
#include <string>

#include "app/shell/arrangement.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

ImRect window(const char* name) {
  const ImGuiWindow* w = ImGui::FindWindowByName(name);
  return w != nullptr && w->WasActive ? w->Rect() : ImRect();
}

void drag(Headless& h, ImVec2 from, ImVec2 to) {
  ImGuiIO& io = ImGui::GetIO();
  io.AddMousePosEvent(from.x, from.y);
  h.frames(2);
  io.AddMouseButtonEvent(0, true);
  h.frames(1);
  io.AddMousePosEvent(to.x, to.y);
  h.frames(2);
  io.AddMouseButtonEvent(0, false);
  h.frames(2);
}

TEST(Arrangement, APanelIsDraggedWiderAndFoldsAway) {
  Headless h;
  const float before = window("##plots").GetWidth();
  const ImVec2 edge = window("##right_edge").GetCenter();
  drag(h, edge, {edge.x - 60.0F, edge.y});
  EXPECT_NEAR(window("##plots").GetWidth(), before + 60.0F, 4.0F);
  EXPECT_NEAR(h.app->view_rect.x + h.app->view_rect.width, window("##plots").Min.x, 1.0F);

  const float view = h.app->view_rect.width;
  const ImVec2 moved = window("##right_edge").GetCenter();
  h.click(moved.x, moved.y);
  EXPECT_FALSE(h.app->desk.right.open);
  EXPECT_GT(h.app->view_rect.width, view + 200.0F);
  const ImVec2 folded = window("##right_edge").GetCenter();
  h.click(folded.x, folded.y);
  h.frames(2);
  EXPECT_TRUE(h.app->desk.right.open);
  EXPECT_NEAR(window("##plots").GetWidth(), before + 60.0F, 4.0F);
}

TEST(Arrangement, DraggedPanelsLeaveRoomForThePicture) {
  Headless h;
  for (const char* name : {"##left_edge", "##right_edge"}) {
    const ImVec2 edge = window(name).GetCenter();
    drag(h, edge, {640.0F, edge.y});
  }
  EXPECT_GE(h.app->view_rect.width, 300.0F);
  h.resize(900.0F, 600.0F, 1.0F);
  h.frames(2);
  EXPECT_GE(h.app->view_rect.width, 300.0F);
}

TEST(Arrangement, IsRestoredOnTheNextVisit) {
  std::map<std::string, std::string> kept;
  const auto keeps = [&](Headless& h) {
    h.app->host.remember = [&](const std::string& k, const std::string& v) { kept[k] = v; };
    h.app->host.recall = [&](const std::string& k) { return kept[k]; };
    recall_arrangement(*h.app);
    h.frames(2);
  };
  {
    Headless h;
    keeps(h);
    EXPECT_TRUE(h.app->desk.tour_hint);  // a first visit
    h.app->desk.right.width = 333.0F;
    h.app->desk.left.open = false;
    h.app->desk.plot(Plot::kTime).shown = true;
    h.app->desk.plot(Plot::kError).logarithmic = false;
    h.app->set("scale", "1.2");
    h.app->set("tour", "off");
    h.frames(2);
  }
  Headless h;
  keeps(h);
  EXPECT_FALSE(h.app->desk.tour_hint);
  EXPECT_EQ(h.app->desk.right.width, 333.0F);
  EXPECT_FALSE(h.app->desk.left.open);
  EXPECT_TRUE(h.app->desk.plot(Plot::kTime).shown);
  EXPECT_FALSE(h.app->desk.plot(Plot::kError).logarithmic);
  EXPECT_EQ(h.app->desk.scale, 1.2);

  for (const char* broken : {"", "right=nan&left=x&scale=99&plots=q", "&&&=", "left=-5"}) {
    kept["arrangement"] = broken;
    Headless again;
    keeps(again);
    EXPECT_GE(again.app->desk.left.width, 0.0F) << broken;
    EXPECT_LE(again.app->desk.scale, 1.5) << broken;
  }
}

TEST(Arrangement, AScaledInterfaceRespondsWhereItIsDrawn) {
  Headless h;
  ASSERT_EQ(h.app->set("scale", "1.25"), "");
  h.frames(3);
  EXPECT_FLOAT_EQ(ImGui::GetIO().DisplaySize.x,
                  1280.0F);  // the shell's own display size is unchanged
  EXPECT_NEAR(window("##transport").GetWidth(), 1280.0F / 1.25F - 24.0F, 1.0F);
  EXPECT_FLOAT_EQ(h.app->look.fonts.regular->FontSize, 20.0F);
  // The play button, 1.25 times as far from the corner as it is in the interface.
  const ImRect bar = window("##transport");
  const ImVec2 play(bar.Min.x + 30.0F, bar.Min.y + 28.0F);
  EXPECT_FALSE(h.app->session.playing());
  h.click(1.25F * play.x, 1.25F * play.y);
  EXPECT_TRUE(h.app->session.playing());
  h.type("-");
  EXPECT_NEAR(h.app->desk.scale, 1.2, 0.051);
  EXPECT_NE(h.app->set("scale", "3"), "");
}

}  // namespace
}  // namespace substep

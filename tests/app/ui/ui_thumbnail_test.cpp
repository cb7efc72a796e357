// The small pictures of scenes in the menu.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/render/hull.hpp"
#include "app/render/thumbnail.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

struct Extent {
  float low_x = 1e9F;
  float high_x = -1e9F;
  float low_y = 1e9F;
  float high_y = -1e9F;
};

// Of the bodies: shadows, which are drawn first and have no outline, may leave the frame.
Extent extent_of_bodies(const Thumbnail& picture) {
  Extent e;
  for (const Thumbnail::Polygon& polygon : picture.polygons) {
    if (!polygon.outlined) continue;
    for (std::size_t i = 0; i < polygon.count; ++i) {
      const auto& p = picture.points[polygon.first + i];
      e.low_x = std::min(e.low_x, p[0]);
      e.high_x = std::max(e.high_x, p[0]);
      e.low_y = std::min(e.low_y, p[1]);
      e.high_y = std::max(e.high_y, p[1]);
    }
  }
  return e;
}

TEST(Hull, KeepsTheOutermostPointsInOrder) {
  const auto hull = convex_hull({{0, 0}, {1, 1}, {2, 0}, {2, 2}, {0, 2}, {1, 0}});
  ASSERT_EQ(hull.size(), 4U);
  float area = 0.0F;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const ScreenPoint& a = hull[i];
    const ScreenPoint& b = hull[(i + 1) % hull.size()];
    area += 0.5F * (a.x * b.y - a.y * b.x);
  }
  EXPECT_FLOAT_EQ(std::abs(area), 4.0F);
  EXPECT_TRUE(convex_hull({}).empty());
}

TEST(Thumbnail, EveryShippedSceneFillsItsFrame) {
  const Library library = shipped();
  for (const auto& scene : library.scenes()) {
    for (const ui::Theme* theme : {&ui::dark_theme(), &ui::light_theme()}) {
      const Thumbnail picture = thumbnail_of(*scene, theme->view);
      ASSERT_FALSE(picture.polygons.empty()) << scene->name;
      for (const auto& p : picture.points) {
        ASSERT_TRUE(std::isfinite(p[0]) && std::isfinite(p[1])) << scene->name;
      }
      const Extent e = extent_of_bodies(picture);
      if (e.low_x > e.high_x) continue;  // of balls only
      EXPECT_GE(e.low_x, 0.0F) << scene->name;
      EXPECT_LE(e.high_x, Thumbnail::kAspect) << scene->name;
      EXPECT_GE(e.low_y, 0.0F) << scene->name;
      EXPECT_LE(e.high_y, 1.0F) << scene->name;
    }
  }
}

TEST(Thumbnail, NearerFacesAreDrawnLater) {
  Scene scene;
  Body body;
  body.shape = Box{Vec3(0.5, 0.5, 0.5)};
  body.color = 0xff0000;
  body.position = {0.0, 0.5, -3.0};
  scene.bodies.push_back(body);
  body.color = 0x00ff00;
  body.position.z() = 3.0;
  scene.bodies.insert(scene.bodies.begin(), body);  // the nearer one is first
  const Thumbnail picture = thumbnail_of(scene, ui::dark_theme().view);
  ASSERT_GE(picture.polygons.size(), 4U);
  EXPECT_GT(picture.polygons.front().color.r, picture.polygons.front().color.g);
  EXPECT_GT(picture.polygons.back().color.g, picture.polygons.back().color.r);
}

TEST(Thumbnail, OfAHugeSceneStaysSmall) {
  Scene scene;
  Body body;
  body.shape = Box{Vec3(0.5, 0.5, 0.5)};
  for (int i = 0; i < 5000; ++i) {
    body.position = Vec3(i % 50, i / 50, 0.0);
    scene.bodies.push_back(body);
  }
  EXPECT_LT(thumbnail_of(scene, ui::dark_theme().view).polygons.size(), 1500U);
}

// The colours drawn in the open menu, over what is drawn while it is closed.
TEST(SceneMenu, ShowsPicturesOfShippedAndUsersScenes) {
  Headless h(1280.0F, 1200.0F);
  Scene own = *h.app->library.find("bridge");
  own.name = "mine";
  own.title = "My own scene";
  h.app->add_own(own);
  h.frames(2);
  const int closed = ImGui::GetIO().MetricsRenderVertices;
  h.press("scene");
  h.frames(12);  // a few pictures are made in each frame
  const int open = ImGui::GetIO().MetricsRenderVertices;
  EXPECT_GT(open, closed + 2000);
  const ui::Handle* item = find_handle("My own scene");
  ASSERT_NE(item, nullptr);
  EXPECT_GE(item->max.y - item->min.y, 32.0F);
}

TEST(SceneMenu, ScrollsWithAFingerOnAPhone) {
  Headless h(390.0F, 844.0F, 2.0F);
  h.press("scene");
  h.frames(12);
  const ui::Handle* item = find_handle("Bridge");
  ASSERT_NE(item, nullptr);
  EXPECT_LE(item->max.x, 390.0F) << "as wide as the phone";
  const float before = item->min.y;
  ImGuiIO& io = ImGui::GetIO();
  io.AddMouseSourceEvent(ImGuiMouseSource_TouchScreen);
  const float x = 0.5F * (item->min.x + item->max.x);
  float y = item->min.y + 20.0F;
  io.AddMousePosEvent(x, y);
  h.frames(1);
  io.AddMouseButtonEvent(0, true);
  h.frames(1);
  for (int i = 0; i < 10; ++i) {
    io.AddMousePosEvent(x, y -= 6.0F);
    h.frames(1);
  }
  io.AddMouseButtonEvent(0, false);
  h.frames(2);
  item = find_handle("Bridge");
  EXPECT_TRUE(item == nullptr || item->min.y < before - 20.0F) << "scrolled up";
  EXPECT_TRUE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel))
      << "nothing was chosen";
}

}  // namespace
}  // namespace substep

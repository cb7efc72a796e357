// What lies over the picture: which panels are drawn anew, and what they cover.

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>

#include "app/render/layers.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

// A machine that is too slow for a fine picture, so that the governor is at its coarsest.
void slow_down(Headless& h) {
  for (int i = 0; i < 60; ++i) {
    ImGui::GetIO().DeltaTime = 0.08F;
    frame(*h.app, 0.08);
  }
  ASSERT_EQ(h.app->quality.quality(), Quality::kSketch);
}

bool fills(const Layer& layer) { return layer.covers.width > 0; }

std::ptrdiff_t shown(const Headless& h, Showing showing) {
  return std::count_if(h.renderer->layers.begin(), h.renderer->layers.end(),
                       [&](const Layer& layer) { return layer.showing == showing; });
}

TEST(Layers, HoldEveryDrawListOnceAndInOrder) {
  Headless h;
  std::vector<const ImDrawList*> held;
  for (const Layer& layer : h.renderer->layers) {
    held.insert(held.end(), layer.lists.CmdLists.begin(), layer.lists.CmdLists.end());
  }
  const ImVector<ImDrawList*>& all = ImGui::GetDrawData()->CmdLists;
  EXPECT_TRUE(std::equal(held.begin(), held.end(), all.begin(), all.end()));
  EXPECT_GE(std::count_if(h.renderer->layers.begin(), h.renderer->layers.end(), fills), 3);
}

TEST(Layers, LieWithinTheWindowInItsPixels) {
  for (const float ratio : {1.0F, 1.5F, 2.0F}) {
    const Headless h(1280, 720, ratio);
    for (const Layer& layer : h.renderer->layers) {
      if (!fills(layer)) continue;
      EXPECT_GE(layer.area.x, 0);
      EXPECT_GE(layer.area.y, 0);
      EXPECT_LE(layer.area.x + layer.area.width, static_cast<int>(1280 * ratio));
      EXPECT_LE(layer.area.y + layer.area.height, static_cast<int>(720 * ratio));
      EXPECT_GT(layer.covers.x, layer.area.x) << "round corners show the picture";
    }
  }
}

TEST(Layers, AreAllDrawnWhereDrawingIsQuick) {
  Headless h;
  h.app->session.play();
  h.frames(20);
  EXPECT_EQ(shown(h, Showing::kDraw), static_cast<std::ptrdiff_t>(h.renderer->layers.size()));
}

TEST(Layers, ThatDoNotChangeAreKeptWhereDrawingIsSlow) {
  Headless h;
  h.app->session.play();
  slow_down(h);
  const ImGuiID controls = ImGui::FindWindowByName("##controls")->ID;
  for (int i = 0; i < 30; ++i) {
    frame(*h.app, 0.08);
    const auto& layers = h.renderer->layers;
    const auto found = std::find_if(layers.begin(), layers.end(),
                                    [&](const Layer& layer) { return layer.id == controls; });
    ASSERT_NE(found, layers.end());
    EXPECT_EQ(found->showing, Showing::kKept) << i;
  }
}

TEST(Layers, AreAllDrawnWhereThePictureRests) {
  Headless h;
  slow_down(h);
  h.app->session.pause();
  frame(*h.app, 0.08);
  EXPECT_EQ(shown(h, Showing::kDraw), static_cast<std::ptrdiff_t>(h.renderer->layers.size()));
}

TEST(Layers, ThatChangeTakeTurns) {
  Headless h;
  h.app->session.play();
  slow_down(h);
  std::map<ImGuiID, int> age;
  std::set<ImGuiID> drawn;
  for (int i = 0; i < 30; ++i) {
    frame(*h.app, 0.08);
    EXPECT_LE(shown(h, Showing::kDrawAndKeep), 1);
    for (const Layer& layer : h.renderer->layers) {
      int& a = age[layer.id];
      ++a;
      if (layer.showing != Showing::kDrawAndKeep) continue;
      if (!drawn.insert(layer.id).second) {
        EXPECT_GE(a, LayerKeeper::kTurn);
        EXPECT_LE(a, 3 * LayerKeeper::kTurn);
      }
      a = 0;
    }
  }
  EXPECT_GE(drawn.size(), 2U) << "the plots and the bar with the time";
}

TEST(Layers, AreDrawnAtOnceWhereTheyAreNewOrMoved) {
  Headless h;
  h.app->session.play();
  slow_down(h);
  h.app->set("help", "on");
  frame(*h.app, 0.08);
  frame(*h.app, 0.08);  // Dear ImGui shows a window once it knows its size
  EXPECT_GE(shown(h, Showing::kDrawAndKeep), 1);
  h.resize(1000, 700, 1.0F);
  frame(*h.app, 0.08);
  for (const Layer& layer : h.renderer->layers) {
    if (!fills(layer)) continue;
    EXPECT_EQ(layer.showing, Showing::kDrawAndKeep);
  }
}

TEST(Layers, AreAllDrawnForAPictureOfTheWindow) {
  Headless h;
  h.app->session.play();
  slow_down(h);
  h.app->capture = Capture{"window.png", {0, 0, 1280, 720}};
  frame(*h.app, 0.08);
  EXPECT_EQ(shown(h, Showing::kDraw), static_cast<std::ptrdiff_t>(h.renderer->layers.size()));
}

TEST(Layers, LeaveUncoveredWhatNoneCovers) {
  std::mt19937 random(7);
  const auto upto = [&](int most) {
    return static_cast<int>(random() % static_cast<unsigned>(most));
  };
  for (int run = 0; run < 50; ++run) {
    const PixelRect window{0, 0, 30, 20};
    std::vector<PixelRect> covers;
    for (int i = upto(5); i > 0; --i)
      covers.push_back({upto(30) - 5, upto(20) - 5, upto(20), upto(20)});
    const std::vector<PixelRect> parts = uncovered(window, covers);
    for (int x = 0; x < window.width; ++x) {
      for (int y = 0; y < window.height; ++y) {
        const auto holds = [&](const PixelRect& r) {
          return x >= r.x && x < r.x + r.width && y >= r.y && y < r.y + r.height;
        };
        const bool covered = std::any_of(covers.begin(), covers.end(), holds);
        EXPECT_EQ(std::count_if(parts.begin(), parts.end(), holds), covered ? 0 : 1);
      }
    }
  }
}

}  // namespace
}  // namespace substep

// The parts of the picture that panels hide.

#include <gtest/gtest.h>

#include <imgui_internal.h>

#include <algorithm>
#include <cfloat>
#include <random>

#include "app/render/cover.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

TEST(Cover, LiesWithinTheWindowInItsPixels) {
  for (const float ratio : {1.0F, 1.5F, 2.0F}) {
    const Headless h(1280, 720, ratio);
    const std::vector<PixelRect> covers = panels_over_picture().interiors;
    EXPECT_GE(covers.size(), 3U) << "the controls, the plots and the transport";
    for (const PixelRect& r : covers) {
      EXPECT_GE(r.x, 0);
      EXPECT_GE(r.y, 0);
      EXPECT_LE(r.x + r.width, static_cast<int>(1280 * ratio));
      EXPECT_LE(r.y + r.height, static_cast<int>(720 * ratio));
    }
  }
}

TEST(Cover, IsLittleWhereNoPanelIsOpen) {
  Headless h;
  h.app->desk.panels = false;
  h.frames(2);
  int area = 0;
  for (const PixelRect& r : panels_over_picture().interiors) area += r.width * r.height;
  EXPECT_LT(area, 1280 * 720 / 10);
}

TEST(Cover, LeavesTheRestUncovered) {
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

TEST(Cover, TheLargestPartIsTheWindowWhereAllPartsAreSmall) {
  const PixelRect window{0, 0, 100, 100};
  const std::vector<PixelRect> sides{{0, 0, 30, 100}, {80, 0, 20, 100}};
  const std::vector<PixelRect> most{{20, 0, 80, 100}};
  EXPECT_EQ(largest_uncovered(window, sides), (PixelRect{30, 0, 50, 100}));
  const std::vector<PixelRect> panels{{5, 10, 30, 60}, {80, 10, 15, 70}, {5, 85, 90, 10}};
  EXPECT_EQ(largest_uncovered(window, panels), (PixelRect{35, 0, 45, 85}));
  EXPECT_EQ(largest_uncovered(window, {}), window);
  EXPECT_EQ(largest_uncovered(window, most), window) << "a fifth is left";
  EXPECT_EQ(largest_uncovered(window, {&window, 1}), window);
}

// Counts triangles whose bounding box overlaps the clip rectangle of their command.
std::size_t triangles_drawn(const ImDrawData& data) {
  std::size_t drawn = 0;
  for (const ImDrawList* list : data.CmdLists) {
    for (const ImDrawCmd& c : list->CmdBuffer) {
      for (unsigned i = 0; i < c.ElemCount; i += 3) {
        ImRect box(FLT_MAX, FLT_MAX, -FLT_MAX, -FLT_MAX);
        for (unsigned k = 0; k < 3; ++k) {
          const ImDrawIdx vertex = list->IdxBuffer[static_cast<int>(c.IdxOffset + i + k)];
          box.Add(list->VtxBuffer[static_cast<int>(c.VtxOffset + vertex)].pos);
        }
        if (box.Overlaps(ImRect(c.ClipRect))) ++drawn;
      }
    }
  }
  return drawn;
}

// The pixels that Dear ImGui's OpenGL back end leaves to a command.
PixelRect scissor_of(const ImDrawCmd& c, int window_height, float ratio) {
  const ImVec2 min(c.ClipRect.x * ratio, c.ClipRect.y * ratio);
  const ImVec2 max(c.ClipRect.z * ratio, c.ClipRect.w * ratio);
  const auto height = static_cast<int>(max.y - min.y);
  const auto below = static_cast<int>(static_cast<float>(window_height) - max.y);
  return {static_cast<int>(min.x), window_height - below - height, static_cast<int>(max.x - min.x),
          height};
}

TEST(Cover, PanelsOutsideAPartAreNotDrawn) {
  for (const float ratio : {1.0F, 1.5F, 2.0F}) {
    Headless h(1280, 720, ratio);
    h.frames(2);
    ImDrawData& panels = *ImGui::GetDrawData();
    const PixelRect window{0, 0, static_cast<int>(1280 * ratio), static_cast<int>(720 * ratio)};
    const PixelRect part = largest_uncovered(window, panels_over_picture().bounds);
    ASSERT_NE(part, window);
    const int lists = panels.CmdListsCount;
    const std::size_t before = triangles_drawn(panels);
    keep_within(part, panels);
    EXPECT_LT(panels.CmdListsCount, lists);
    EXPECT_EQ(panels.CmdListsCount, panels.CmdLists.Size);
    const std::size_t after = triangles_drawn(panels);
    EXPECT_GT(after, 0U) << "the title lies over the picture";
    EXPECT_LT(4 * after, before);
    bool all_of_it = false;
    for (const ImDrawList* list : panels.CmdLists) {
      for (const ImDrawCmd& c : list->CmdBuffer) {
        const PixelRect scissor = scissor_of(c, window.height, ratio);
        if (scissor.width <= 0 || scissor.height <= 0) continue;
        EXPECT_GE(scissor.x, part.x);
        EXPECT_GE(scissor.y, part.y);
        EXPECT_LE(scissor.x + scissor.width, part.x + part.width);
        EXPECT_LE(scissor.y + scissor.height, part.y + part.height);
        all_of_it |= scissor == part;
      }
    }
    EXPECT_TRUE(all_of_it) << "no row or column is left out";
  }
}

}  // namespace
}  // namespace substep

// Tessellation of panel areas into triangles for the software renderer.

#include <gtest/gtest.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "app/render/fans.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

using Triangle = std::array<ImVec2, 3>;

std::vector<Triangle> triangles_of(const ImDrawData& data) {
  std::vector<Triangle> all;
  for (const ImDrawList* list : data.CmdLists) {
    for (const ImDrawCmd& command : list->CmdBuffer) {
      for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
        Triangle t;
        for (unsigned k = 0; k < 3; ++k) {
          const auto at = static_cast<int>(command.IdxOffset + i + k);
          t.at(k) = list->VtxBuffer[static_cast<int>(command.VtxOffset) +
                                    static_cast<int>(list->IdxBuffer[at])]
                        .pos;
        }
        all.push_back(t);
      }
    }
  }
  return all;
}

double side(ImVec2 a, ImVec2 b, ImVec2 p) {
  const auto d = [](float x) { return static_cast<double>(x); };
  return (d(b.x) - d(a.x)) * (d(p.y) - d(a.y)) - (d(b.y) - d(a.y)) * (d(p.x) - d(a.x));
}

double area(const Triangle& t) { return 0.5 * std::abs(side(t[0], t[1], t[2])); }

double height(const Triangle& t) {
  const auto [low, high] = std::minmax({t[0].y, t[1].y, t[2].y});
  return static_cast<double>(high - low);
}

bool inside(const Triangle& t, ImVec2 p) {
  const double a = side(t[0], t[1], p);
  const double b = side(t[1], t[2], p);
  const double c = side(t[2], t[0], p);
  return (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0);
}

double sum(const std::vector<Triangle>& triangles, double (*of)(const Triangle&)) {
  double total = 0.0;
  for (const Triangle& t : triangles) total += of(t);
  return total;
}

// Draws one area and tessellates it. @param draw draws into the given list
template <class Draw>
std::pair<std::vector<Triangle>, std::vector<Triangle>> cut(const Draw& draw) {
  ImDrawList list(ImGui::GetDrawListSharedData());
  list._ResetForNewFrame();
  list.PushClipRectFullScreen();
  list.PushTextureID(ImGui::GetIO().Fonts->TexID);
  list.Flags |= ImDrawListFlags_AntiAliasedFill;
  draw(list);
  ImDrawData data;
  data.AddDrawList(&list);
  std::vector<Triangle> before = triangles_of(data);
  slice_fans(data);
  return {std::move(before), triangles_of(data)};
}

TEST(Fans, OfAPanelCoverTheSameInFewerRows) {
  const Headless h;
  for (const float rounding : {0.0F, 3.0F, 12.0F}) {
    const auto [before, after] = cut([&](ImDrawList& list) {
      list.AddRectFilled({10, 20}, {290, 620}, IM_COL32_WHITE, rounding);
    });
    ASSERT_EQ(before.size(), after.size());
    EXPECT_NEAR(sum(before, area), sum(after, area), 1e-3 * sum(before, area));
    EXPECT_LE(sum(after, height), sum(before, height));
    if (rounding == 12.0F) {
      EXPECT_LT(sum(after, height), 0.5 * sum(before, height));
    }
  }
}

TEST(Fans, OfAnyConvexAreaCoverEachPointOnce) {
  const Headless h;
  for (int corners = 3; corners < 40; corners += 3) {
    std::vector<ImVec2> ring;
    for (int i = 0; i < corners; ++i) {
      const float angle = 6.2831853F * (static_cast<float>(i) + 0.3F) / static_cast<float>(corners);
      ring.emplace_back(300.0F + 200.0F * std::cos(angle), 200.0F + 90.0F * std::sin(angle));
    }
    const auto [before, after] = cut(
        [&](ImDrawList& list) { list.AddConvexPolyFilled(ring.data(), corners, IM_COL32_WHITE); });
    for (float x = 90.13F; x < 510.0F; x += 7.37F) {
      for (float y = 100.21F; y < 300.0F; y += 7.41F) {
        const auto holds = [&](const Triangle& t) { return inside(t, {x, y}); };
        EXPECT_EQ(std::count_if(after.begin(), after.end(), holds),
                  std::count_if(before.begin(), before.end(), holds));
      }
    }
  }
}

TEST(Fans, LeaveTextAndLinesAsTheyAre) {
  const Headless h;
  const auto [before, after] = cut([&](ImDrawList& list) {
    list.AddText({10, 10}, IM_COL32_WHITE, "substep");
    list.AddRect({10, 20}, {290, 620}, IM_COL32_WHITE, 12.0F);
    list.AddLine({0, 0}, {300, 20}, IM_COL32_WHITE, 2.0F);
  });
  const auto same = [](const Triangle& a, const Triangle& b) {
    return std::equal(a.begin(), a.end(), b.begin(),
                      [](ImVec2 p, ImVec2 q) { return p.x == q.x && p.y == q.y; });
  };
  EXPECT_TRUE(std::equal(before.begin(), before.end(), after.begin(), after.end(), same));
}

}  // namespace
}  // namespace substep

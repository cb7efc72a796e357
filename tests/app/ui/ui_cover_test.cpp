// The parts of the picture that panels hide.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "app/render/cover.hpp"
#include "tests/app/ui/ui_fixture.hpp"

namespace substep {
namespace {

TEST(Cover, LiesWithinTheWindowInItsPixels) {
  for (const float ratio : {1.0F, 1.5F, 2.0F}) {
    const Headless h(1280, 720, ratio);
    const std::vector<PixelRect> covers = covered_by_panels();
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
  for (const PixelRect& r : covered_by_panels()) area += r.width * r.height;
  EXPECT_LT(area, 1280 * 720 / 10);
}

TEST(Cover, LeavesUncoveredWhatNoneCovers) {
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

// Adaptive sub-stepping compared with the best constant N, in the window.

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "app/text/trade_text.hpp"
#include "core/lab/sweep.hpp"
#include "tests/app/ui/ui_sweep.hpp"

namespace substep {
namespace {

/// Shows the trade of a shipped scene.
void show_trade(Headless& h, const char* scene) {
  ASSERT_EQ(h.app->set("scene", scene), "");
  h.app->session.pause();
  h.app->desk.tab = Tab::kAccuracy;
  ASSERT_EQ(h.app->set("accuracy", "trade"), "");
  h.frames(3);
}

struct BarHandle {
  std::size_t result = 0;
  ImVec2 centre;
};

std::vector<BarHandle> bars_of(const Headless& h) {
  std::vector<BarHandle> bars;
  const auto s = static_cast<float>(h.app->desk.scale);
  for (const ui::Handle& handle : ui::handles()) {
    if (handle.group != "trade") continue;
    bars.push_back(
        {std::stoul(handle.label),
         {0.5F * s * (handle.min.x + handle.max.x), 0.5F * s * (handle.min.y + handle.max.y)}});
  }
  return bars;
}

/// Presses a choice of a row.
void choose_in_row(Headless& h, std::string_view row, std::string_view choice) {
  for (const ui::Handle& handle : ui::handles()) {
    if (handle.group != row || handle.label != choice) continue;
    const auto s = static_cast<float>(h.app->desk.scale);
    h.click(0.5F * s * (handle.min.x + handle.max.x), 0.5F * s * (handle.min.y + handle.max.y));
    return;
  }
  ADD_FAILURE() << row << ", " << choice << " is not there";
}

TEST(FairTrade, ABarRunsItsExperiment) {
  Headless h(1280, 1000);
  show_trade(h, "swinging_box");
  h.app->accuracy.trade_alpha = 0.5;
  h.frames(2);
  const std::vector<BarHandle> bars = bars_of(h);
  ASSERT_GT(bars.size(), 6U) << "two for each of six loads, unless no constant N is enough";
  std::set<double> loads;
  for (const BarHandle& bar : bars) {
    const Experiment e = h.app->accuracy.results()[bar.result].experiment;
    h.click(bar.centre.x, bar.centre.y);
    h.frames(2);
    EXPECT_EQ(h.app->load, e.load);
    EXPECT_EQ(h.app->session.settings().mode, e.settings.mode);
    loads.insert(e.load);
  }
  EXPECT_EQ(loads.size(), 6U);
}

TEST(FairTrade, AlphaAndPolicyAreChosenInThePanel) {
  Headless h(1280, 1000);
  show_trade(h, "swinging_box");
  EXPECT_EQ(h.app->accuracy.trade_alpha, 0.1) << "the scene's own";
  const std::size_t all_loads = bars_of(h).size();
  choose_in_row(h, "Alpha", "0.5");
  h.frames(2);
  EXPECT_EQ(h.app->accuracy.trade_alpha, 0.5);
  choose_in_row(h, "Choose N every", "sub-step");
  h.frames(2);
  EXPECT_EQ(h.app->accuracy.trade_policy, Policy::kSubstep);
  EXPECT_LT(bars_of(h).size(), all_loads) << "the scene's own load only";
  EXPECT_GT(bars_of(h).size(), 0U);
}

TEST(FairTrade, EveryShippedSweepHasAConclusion) {
  Headless h(1280, 1000);
  for (const auto& scene : h.app->library.scenes()) {
    if (scene->group == "exam") continue;
    show_trade(h, scene->name.c_str());
    for (const Policy policy : {Policy::kFrame, Policy::kSubstep}) {
      h.app->accuracy.trade_policy = policy;
      for (const double alpha : std::vector<double>(h.app->accuracy.trade().alphas)) {
        h.app->accuracy.trade_alpha = alpha;
        EXPECT_EQ(h.app->accuracy.trade().alpha, alpha) << scene->name;
        EXPECT_FALSE(trade_text(h.app->accuracy.trade()).empty()) << scene->name << ", " << alpha;
      }
    }
  }
}

TEST(FairTrade, GrowsWithASweep) {
  Headless h;
  sweep_a_rope(h);
  const std::size_t all = h.app->accuracy.trade().rows.size();
  EXPECT_EQ(all, 6U) << "a row for each load";
  h.app->accuracy.start(h.app->accuracy.scene());
  EXPECT_TRUE(h.app->accuracy.trade().rows.empty()) << "the rows of the last sweep";
  finish(h);
  EXPECT_EQ(h.app->accuracy.trade().rows.size(), all);
}

TEST(FairTrade, StatesTheSavingAndItsUncertainty) {
  Result adaptive;
  adaptive.experiment.settings.alpha = 0.1;
  adaptive.metrics.work.frames = 10;
  adaptive.metrics.work.substeps = 50;
  Result constant;
  constant.experiment.settings.n = 12;
  FairTrade trade;
  trade.alpha = 0.1;
  trade.most_n = 24;
  trade.rows = {{1.0, &adaptive, &constant, 9}};
  EXPECT_NE(trade_text(trade).find("is 10 to 12: at least 2.0 times as many."), std::string::npos)
      << trade_text(trade);
  trade.rows[0].too_few = 11;
  EXPECT_NE(trade_text(trade).find("is 12: 2.4 times as many."), std::string::npos)
      << trade_text(trade);
  trade.rows[0].constant = nullptr;
  trade.rows[0].too_few = 24;
  EXPECT_NE(trade_text(trade).find("is more than 24: at least 5.0 times as many."),
            std::string::npos)
      << trade_text(trade);
  adaptive.metrics.holds = false;
  EXPECT_NE(trade_text(trade).find("fails here"), std::string::npos) << trade_text(trade);
}

}  // namespace
}  // namespace substep

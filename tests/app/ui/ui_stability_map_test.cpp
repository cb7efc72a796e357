// The map of stable settings by load, in the window.

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "tests/app/ui/ui_sweep.hpp"

namespace substep {
namespace {

TEST(Accuracy, TheMapComesLastAndACellReproducesItsFigures) {
  Headless h;
  sweep_a_rope(h);
  ASSERT_TRUE(h.app->accuracy.has_map());
  const std::vector<Result> results = h.app->accuracy.results();
  const auto is_varied = [](const Result& r) { return r.experiment.load != 1.0; };
  const auto first = std::find_if(results.begin(), results.end(), is_varied);
  EXPECT_TRUE(std::all_of(first, results.end(), is_varied)) << "the curves come first";
  for (const auto& point : h.app->accuracy.points()) {
    EXPECT_EQ(results[point.result].experiment.load, 1.0);
  }
  int failed = 0;
  for (auto r = first; r < results.end(); r += 3) {
    h.app->run_result(*r);
    h.app->session.pause();
    EXPECT_EQ(h.app->load, r->experiment.load);
    for (std::int64_t f = 0; f < r->metrics.work.frames; ++f) h.app->session.step();
    EXPECT_EQ(h.app->session.hash(), r->metrics.hash) << r->experiment.load;
    failed += r->metrics.holds ? 0 : 1;
  }
  EXPECT_GT(failed, 0) << "a map in which every run holds tests nothing";
  h.app->run_result(results.front());
  EXPECT_EQ(h.app->load, 1.0);
}

TEST(Accuracy, CellsOfTheMapAreFoundUnderThePointer) {
  Headless h;
  sweep_a_rope(h);
  h.app->accuracy.picture = AccuracyPicture::kStabilityMap;
  h.frames(2);
  std::set<std::pair<double, double>> chosen;  // load and parameter
  for (float y = 240.0F; y < 660.0F; y += 11.0F) {
    for (float x = 1000.0F; x < 1260.0F; x += 20.0F) {
      h.click(x, y);
      chosen.insert({h.app->load, series_parameter(h.app->session.settings()).value});
    }
  }
  std::set<double> loads;
  for (const auto& [load, value] : chosen) loads.insert(load);
  EXPECT_EQ(loads.size(), 6U);
  EXPECT_GT(chosen.size(), 40U);
}

// Centres of the cells, by the index of their result.
std::vector<std::pair<std::size_t, ImVec2>> cells_of(const Headless& h) {
  std::vector<std::pair<std::size_t, ImVec2>> cells;
  const auto s = static_cast<float>(h.app->desk.scale);
  for (const ui::Handle& handle : ui::handles()) {
    if (handle.group != "map") continue;
    cells.emplace_back(std::stoul(handle.label), ImVec2(0.5F * s * (handle.min.x + handle.max.x),
                                                        0.5F * s * (handle.min.y + handle.max.y)));
  }
  return cells;
}

TEST(Accuracy, DraggingOverTheMapRunsEachCellOnce) {
  Headless h;
  sweep_a_rope(h);
  h.app->accuracy.picture = AccuracyPicture::kStabilityMap;
  h.frames(2);
  const auto cells = cells_of(h);
  ASSERT_GT(cells.size(), 12U);
  ImGuiIO& io = ImGui::GetIO();
  const auto shows = [&](std::size_t index) {
    const Experiment& e = h.app->accuracy.results()[index].experiment;
    return h.app->load == e.load &&
           series_parameter(h.app->session.settings()).value == series_parameter(e.settings).value;
  };
  io.AddMousePosEvent(cells[0].second.x, cells[0].second.y);
  h.frames(1);
  const int before = h.app->run_count;
  h.frames(3);
  EXPECT_EQ(h.app->run_count, before) << "hovering starts a run";
  io.AddMouseButtonEvent(0, true);
  h.frames(1);
  for (const std::size_t i : {0U, 1U, 7U, 8U}) {
    io.AddMousePosEvent(cells[i].second.x, cells[i].second.y);
    h.frames(1);
    EXPECT_TRUE(shows(cells[i].first)) << i;
    const int runs = h.app->run_count;
    h.frames(4);
    EXPECT_EQ(h.app->run_count, runs) << "a resting pointer restarts the run";
  }
  io.AddMouseButtonEvent(0, false);
  h.frames(2);
  const int after = h.app->run_count;
  io.AddMousePosEvent(cells[3].second.x, cells[3].second.y);
  h.frames(2);
  EXPECT_EQ(h.app->run_count, after) << "the drag continues after the release";
}

void press_key(Headless& h, ImGuiKey key) {
  ImGui::GetIO().AddKeyEvent(key, true);
  h.frames(1);
  ImGui::GetIO().AddKeyEvent(key, false);
  h.frames(1);
}

TEST(Accuracy, ArrowKeysGoFromCellToCell) {
  Headless h;
  sweep_a_rope(h);
  h.app->accuracy.picture = AccuracyPicture::kStabilityMap;
  h.frames(2);
  const auto cells = cells_of(h);
  h.click(cells[0].second.x, cells[0].second.y);
  const double load = h.app->load;
  ImGui::GetCurrentContext()->NavDisableHighlight = false;  // as after the Tab key
  press_key(h, ImGuiKey_RightArrow);
  EXPECT_GT(h.app->load, load);
  EXPECT_EQ(h.app->session.settings().n, 1);
  press_key(h, ImGuiKey_DownArrow);
  EXPECT_EQ(h.app->session.settings().n, 2);
  press_key(h, ImGuiKey_LeftArrow);
  EXPECT_EQ(h.app->load, load);
  const int runs = h.app->run_count;
  press_key(h, ImGuiKey_LeftArrow);
  EXPECT_EQ(h.app->run_count, runs) << "the edge of the map starts the run again";
  press_key(h, ImGuiKey_UpArrow);
  press_key(h, ImGuiKey_UpArrow);
  EXPECT_EQ(h.app->session.settings().n, 1) << "the keys leave the map";
}

TEST(Accuracy, CellsOfTheMapKeepTheComparison) {
  Headless h;
  sweep_a_rope(h);
  h.app->set("compare", "mode:none");
  std::set<double> loads;
  for (const Result& result : h.app->accuracy.results()) {
    if (!loads.insert(result.experiment.load).second) continue;
    h.app->run_result(result);
    ASSERT_TRUE(h.app->compare.open()) << result.experiment.load;
    EXPECT_EQ(h.app->load, result.experiment.load);
    EXPECT_EQ(h.app->plain_scene, h.app->accuracy.scene());
  }
  EXPECT_GT(loads.size(), 3U);
  h.app->run_result(h.app->accuracy.results().front());
  EXPECT_EQ(&h.app->session.loaded(), h.app->accuracy.scene().get());
}

}  // namespace
}  // namespace substep

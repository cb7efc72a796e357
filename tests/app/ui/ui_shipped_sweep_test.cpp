// The sweeps shipped with the scenes, and the chart that is available immediately.

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <random>

#include "app/ui/accuracy_curves.hpp"
#include "core/io/stored_sweep.hpp"
#include "scenes/generator/scenes.hpp"
#include "scenes/generator/sweeps.hpp"
#include "tests/app/ui/ui_sweep.hpp"

namespace substep {
namespace {

/// The file of a scene's sweep, including hashes; "" if there is none.
std::string sweep_file(const Scene& scene) {
  std::ifstream file(std::string(SUBSTEP_SOURCE_DIR) + "/scenes/sweeps/" + scene.name + ".txt");
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> sweep_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

/// A line without its path error, which is compared separately.
std::string without_path(const std::string& line) {
  if (line.starts_with("! ")) return line;
  const std::size_t second = line.find(' ', line.find(' ') + 1);
  return line.substr(0, second) + line.substr(line.find(' ', second + 1));
}

constexpr std::size_t kHeadLines = 4;

// A daily sample of the experiments of each scene reproduces the bits in its file. References of
// 256 sub-steps take longest: each day one scene computes its own.
TEST(ShippedSweep, ASampleReproducesItsBits) {
  const auto day = std::chrono::duration_cast<std::chrono::hours>(
                       std::chrono::system_clock::now().time_since_epoch())
                       .count() /
                   24;
  std::mt19937 dice(static_cast<unsigned>(day));
  const Library library = shipped();
  const auto& of_the_day =
      library.scenes()[static_cast<std::size_t>(day) % library.scenes().size()];
  for (const auto& scene : library.scenes()) {
    const std::vector<std::string> lines = sweep_lines(sweep_file(*scene));
    const std::vector<Experiment> plan = quick_sweep(*scene);
    ASSERT_EQ(lines.size(), kHeadLines + plan.size()) << scene->name << ": ./dev sweeps";
    const bool measured = lines[2].starts_with("exact") || scene == of_the_day;
    const Reference reference =
        measured ? find_reference(scene, plan.front().duration) : no_reference();
    for (int i = 0; i < 2; ++i) {
      const std::size_t chosen = dice() % plan.size();
      ExperimentRun run(*scene, plan[chosen], reference);
      while (run.advance()) {
      }
      const Result result = run.result();
      const std::string text = sweep_text({&result, 1}, reference);
      const std::string line = sweep_lines(text).back();
      const std::string& stored = lines[kHeadLines + chosen];
      EXPECT_EQ(without_path(line), without_path(stored)) << scene->name << " day " << day;
      const auto read = read_sweep(sweep_file(*scene), *scene);
      ASSERT_TRUE(read) << scene->name;
      const auto& path = read->results[chosen].metrics.errors.trajectory_peak;
      if (!path || !measured) continue;
      ASSERT_TRUE(result.metrics.errors.trajectory_peak) << scene->name;
      // Four digits, and no more accurate than the reference.
      EXPECT_NEAR(*path, *result.metrics.errors.trajectory_peak,
                  1e-3 * *path + reference.uncertainty)
          << scene->name;
    }
  }
}

TEST(ShippedSweep, MatchesTheCurrentScene) {
  const Library library = shipped();
  for (const auto& scene : library.scenes()) {
    const std::string text(scenes::sweep_of(scene->name));
    EXPECT_TRUE(read_sweep(text, *scene)) << scene->name << " has changed: ./dev sweeps";
    EXPECT_EQ(text.find('#'), std::string::npos) << "hashes are for tests";
    Scene edited = *scene;
    edited.bodies.back().position.x() += 0.25;
    EXPECT_FALSE(read_sweep(text, edited)) << scene->name;
    EXPECT_FALSE(read_sweep(text.substr(0, text.size() / 2), *scene)) << "truncated";
  }
  EXPECT_EQ(scenes::sweep_of("nowhere"), "");
}

TEST(ShippedSweep, TheChartIsAvailableWhenThePanelOpens) {
  Headless h;
  for (const char* name : {"swinging_box", "bridge", "pendulum"}) {
    ASSERT_EQ(h.app->set("scene", name), "");
    ASSERT_EQ(h.app->set("panel", "accuracy"), "");
    h.frames(1);
    EXPECT_TRUE(h.app->accuracy.shipped()) << name;
    EXPECT_FALSE(h.app->accuracy.running()) << name;
    EXPECT_GT(h.app->accuracy.points().size(), 50U) << name;
    EXPECT_EQ(h.app->accuracy.scene(), h.app->plain_scene) << name;
  }
  h.frames(2);
  EXPECT_NE(find_handle("Run again"), nullptr);
  EXPECT_EQ(find_handle("Time"), nullptr) << "files have no times of this machine";
  h.press("Run again");
  EXPECT_TRUE(h.app->accuracy.running());
  EXPECT_FALSE(h.app->accuracy.shipped());
  // The stored results are gone; a few runs of the new sweep may be finished.
  EXPECT_LT(2 * h.app->accuracy.results().size(), h.app->accuracy.planned());
}

TEST(ShippedSweep, AnOwnSceneHasNone) {
  Headless h;
  Scene scene = *shipped("pendulum");
  scene.bodies.back().mass *= 2.0;
  h.app->run(std::make_shared<const Scene>(std::move(scene)));
  ASSERT_EQ(h.app->set("panel", "accuracy"), "");
  h.frames(2);
  EXPECT_EQ(h.app->accuracy.planned(), 0U);
  EXPECT_NE(find_handle("Run all methods"), nullptr);
}

TEST(ShippedSweep, OwnResultsStayUntilTheShippedOnesAreRequested) {
  Headless h;
  sweep_a_rope(h);
  const std::size_t runs = h.app->accuracy.results().size();
  ASSERT_EQ(h.app->set("scene", "pendulum"), "");
  h.frames(2);
  EXPECT_FALSE(h.app->accuracy.shipped());
  EXPECT_EQ(h.app->accuracy.results().size(), runs);
  h.press("Show this scene");
  EXPECT_TRUE(h.app->accuracy.shipped());
  EXPECT_EQ(h.app->accuracy.scene(), h.app->plain_scene);
  EXPECT_EQ(find_handle("Show this scene"), nullptr);
}

// The conclusion, derived from the points by hand.
TEST(ShippedSweep, TheConclusionFollowsFromThePoints) {
  Headless h;
  for (const char* name : {"swinging_box", "bridge", "heavy_stack"}) {
    ASSERT_EQ(h.app->set("scene", name), "");
    ASSERT_EQ(h.app->set("panel", "accuracy"), "");
    h.frames(1);
    const Accuracy& accuracy = h.app->accuracy;
    const auto points = accuracy.points();
    const double wanted = accuracy.wanted.at(static_cast<std::size_t>(accuracy.error));
    const Result* cheapest = nullptr;
    const Result* constant = nullptr;  // direct, Euler
    for (const Result& r : accuracy.results()) {
      const auto error = error_of(r, accuracy.error);
      if (r.experiment.load != 1.0 || !error || *error > wanted || *error <= 0.0) continue;
      const auto cheaper = [&](const Result* than) {
        return than == nullptr || r.metrics.work.flops < than->metrics.work.flops;
      };
      if (cheaper(cheapest)) cheapest = &r;
      if (series_name(r.experiment.settings) == "bpp, const, euler" && cheaper(constant)) {
        constant = &r;
      }
    }
    ASSERT_NE(cheapest, nullptr) << name;
    const std::string text = ui::conclusion(accuracy, points);
    EXPECT_NE(text.find(ui::short_name(cheapest->experiment.settings).substr(1)), std::string::npos)
        << text;
    EXPECT_EQ(text.find("no tested constant N") != std::string::npos, constant == nullptr) << text;
    if (constant == nullptr) continue;
    const double ratio = static_cast<double>(constant->metrics.work.flops) /
                         static_cast<double>(cheapest->metrics.work.flops);
    if (ratio > 1.1) {
      EXPECT_NE(text.find("times fewer operations"), std::string::npos) << text << ratio;
    }
  }
}

TEST(ShippedSweep, ErrorsBelowTheUncertaintyAreOnTheFloor) {
  Headless h;
  ASSERT_EQ(h.app->set("panel", "accuracy"), "");
  h.frames(1);
  const Accuracy& accuracy = h.app->accuracy;
  ASSERT_GT(accuracy.floor(), 0.0);
  const auto points = accuracy.points();
  EXPECT_TRUE(std::all_of(points.begin(), points.end(),
                          [&](const auto& p) { return p.error >= accuracy.floor(); }));
  EXPECT_TRUE(std::any_of(points.begin(), points.end(),
                          [&](const auto& p) { return p.error == accuracy.floor(); }));
}

TEST(ShippedSweep, FiveCurvesAreNamedAndAllOnAClick) {
  Headless h(1280.0F, 1100.0F);
  ASSERT_EQ(h.app->set("panel", "accuracy"), "");
  h.frames(2);
  Accuracy& accuracy = h.app->accuracy;
  const auto headlines = [&] {
    const auto curves = ui::curves_of(ui::dark_theme(), accuracy, accuracy.points());
    return std::count_if(curves.begin(), curves.end(), [](const auto& c) { return c.headline; });
  };
  EXPECT_LE(headlines(), 5);
  EXPECT_GE(headlines(), 4);
  h.press("All methods");
  EXPECT_TRUE(accuracy.all_methods);
  h.press("All methods");
  EXPECT_FALSE(accuracy.all_methods);
}

// Tooltips are complete at every point: no lines of two characters, nothing outside the display.
TEST(ShippedSweep, TooltipsOfPointsAreComplete) {
  for (const bool large : {false, true}) {
    Headless h;
    ASSERT_EQ(h.app->set("panel", "accuracy"), "");
    h.app->desk.accuracy_large = large;
    h.frames(3);
    std::vector<ImVec2> places;
    for (const ui::Handle& handle : ui::handles()) {
      if (handle.group == "accuracy picture") places.push_back(handle.min);
    }
    ASSERT_GT(places.size(), 100U);
    int read = 0;
    for (std::size_t i = 0; i < places.size(); i += 3) {
      ImGui::GetIO().AddMousePosEvent(places[i].x + 1.0F, places[i].y + 1.0F);
      h.frames(2);
      const ImGuiWindow* tip = ImGui::FindWindowByName("##Tooltip_00");
      if (tip == nullptr || !tip->Active) continue;
      ++read;
      EXPECT_GT(tip->Size.x, 120.0F) << large << " " << i;
      EXPECT_LT(tip->Size.y, 170.0F) << large << " " << i;
      EXPECT_GE(tip->Pos.x, 0.0F);
      EXPECT_GE(tip->Pos.y, 0.0F);
      EXPECT_LE(tip->Pos.x + tip->Size.x, 1280.0F) << large << " " << i;
      EXPECT_LE(tip->Pos.y + tip->Size.y, 720.0F) << large << " " << i;
    }
    EXPECT_GT(read, 30) << large;
  }
}

}  // namespace
}  // namespace substep

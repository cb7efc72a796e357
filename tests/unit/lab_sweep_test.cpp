// The runs of a sweep, and that slicing does not change them.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "core/io/experiment.hpp"
#include "core/lab/sweep.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/paper_settings.hpp"

namespace substep::test {
namespace {

TEST(Sweep, DefaultHasEveryMethodOnce) {
  const Scene scene = scenes::swinging_box();
  std::set<std::string> series;
  std::set<std::string> ids;
  const auto by_island = [](const std::string& name) {
    return name.find("by island") != std::string::npos;
  };
  for (const SweepPoint& point : default_sweep(scene)) {
    series.insert(series_name(point.settings));
    Experiment experiment = experiment_of(scene, point.settings);
    experiment.load = point.load;
    EXPECT_TRUE(ids.insert(experiment_id(experiment)).second);
  }
  for (const char* name : {"bpp, const, euler",
                           "bpp, const, leapfrog",
                           "bpp, adaptive per frame, euler",
                           "bpp, adaptive per sub-step, leapfrog",
                           "bpp, damping, euler",
                           "bpp, capped, euler",
                           "bpp, stiffness, euler",
                           "bpp, inertia, leapfrog",
                           "bpp, blend, euler",
                           "bpp, stiffness, leapfrog",
                           "bpp, damping, leapfrog",
                           "bpp, capped, leapfrog",
                           "bpp, const, leapfrog, drift order 2",
                           "bpp, const, stormer",
                           "pgs 25, const, euler",
                           "pgs 25, adaptive per frame, euler",
                           "pgs 25, damping, euler",
                           "pgs 25, const, leapfrog",
                           "newton 1 mean, const, leapfrog",
                           "newton 2 mean, const, leapfrog",
                           "xpbd 1, const, euler",
                           "xpbd 25, const, euler",
                           "newton, const, euler",
                           "newton mean, const, leapfrog",
                           "newton 1 numerov, const, leapfrog",
                           "newton 2 numerov, const, leapfrog",
                           "newton numerov, const, leapfrog",
                           "pgs 64 per frame, const, euler",
                           "xpbd 64 per frame, const, euler"}) {
    EXPECT_TRUE(series.contains(name)) << name;
  }
  EXPECT_EQ(std::count_if(series.begin(), series.end(), by_island), 0)
      << "joints connect all bodies";
  for (const Scene& apart : {scenes::wrecking_ball(), scenes::bridge(), scenes::heavy_stack()}) {
    int islands = 0;
    int explicit_torques = 0;
    for (const SweepPoint& point : default_sweep(apart)) {
      if (by_island(series_name(point.settings))) ++islands;
      if (series_name(point.settings).ends_with("explicit gyroscopic torque")) ++explicit_torques;
    }
    EXPECT_EQ(islands, 11 + 11 + 7) << apart.name;
    EXPECT_EQ(explicit_torques, apart.effects.gyroscopic ? 18 : 0) << apart.name;
  }
  // The same on the other main scenes; curves for joints alone are absent with contacts.
  for (const Scene& other : {scenes::bridge(), scenes::heavy_stack(), scenes::heavy_stack_stress(),
                             scenes::heavy_stack_stress_tall()}) {
    std::set<std::string> there;
    for (const SweepPoint& point : default_sweep(other)) there.insert(series_name(point.settings));
    for (const std::string& name : series) {
      const bool joints_alone = name.find("numerov") != std::string::npos ||
                                name.ends_with("stormer") ||
                                (name.ends_with("drift order 2") && !other.effects.joints);
      const bool shared_sweeps = name.find(" 64 per frame") != std::string::npos;
      EXPECT_EQ(there.contains(shared_sweeps ? name + ", contacts once per frame" : name),
                !joints_alone)
          << other.name << ": " << name;
    }
    EXPECT_TRUE(there.contains("bpp, adaptive per frame, euler, exact contact block"));
  }
  int exact = 0;
  for (const SweepPoint& point : default_sweep(scenes::bridge())) {
    EXPECT_NE(point.settings.forces, Forces::kNumerov) << "it is for joints only";
    if (series_name(point.settings).ends_with("exact contact block")) ++exact;
  }
  EXPECT_EQ(exact, 11);
}

TEST(Sweep, DefaultHasEachRunOnceForAnySettingsOfAScene) {
  Scene scene = scenes::swinging_box();
  scene.settings.iterations = 1;
  std::set<std::string> ids;
  for (const SweepPoint& point : default_sweep(scene)) {
    Experiment experiment = experiment_of(scene, point.settings);
    experiment.load = point.load;
    EXPECT_TRUE(ids.insert(experiment_id(experiment)).second) << series_name(point.settings);
  }
}

TEST(Sweep, SlicesGiveTheResultsOfWholeRuns) {
  const Scene scene = scenes::rope_of_n({.n = 3});
  const auto held = std::make_shared<const Scene>(scene);
  std::vector<Experiment> experiments;
  for (const int n : {1, 2, 4}) {
    Settings settings;
    settings.mode = Mode::kConst;
    settings.n = n;
    experiments.push_back(experiment_of(scene, settings));
    experiments.back().duration = 0.5;
  }
  Sweep sweep(held, experiments);
  double before = 0.0;
  while (sweep.advance(1e-5)) {
    EXPECT_GE(sweep.progress(), before);
    before = sweep.progress();
  }
  EXPECT_EQ(sweep.progress(), 1.0);
  ASSERT_EQ(sweep.results().size(), experiments.size());
  const Reference reference = find_reference(held, 0.5);
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    ExperimentRun run(scene, experiments[i], reference);
    while (run.advance()) {
    }
    const Metrics whole = run.result().metrics;
    const Metrics& sliced = sweep.results()[i].metrics;
    EXPECT_EQ(sweep.results()[i].experiment, experiments[i]);
    EXPECT_EQ(sliced.errors, whole.errors) << i;
    EXPECT_EQ(sliced.work, whole.work) << i;
    EXPECT_EQ(sliced.hash, whole.hash) << i;
  }
}

}  // namespace
}  // namespace substep::test

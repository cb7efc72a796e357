// Experiments, their text forms, what is measured of them, and sweeps.

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <random>
#include <set>

#include "core/io/experiment.hpp"
#include "core/io/json_text.hpp"
#include "core/io/result.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/setting_fields.hpp"
#include "core/lab/effect_cost.hpp"
#include "core/lab/sweep.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/unit/scene_schema_validator.hpp"

namespace substep::test {
namespace {

std::shared_ptr<const Scene> shared(const Scene& scene) {
  return std::make_shared<const Scene>(scene);
}

/// Settings none of which stands at its default.
Settings unusual() {
  Settings s;
  s.solver = SolverKind::kPgs;
  s.iterations = 31;
  s.share_iterations = true;
  s.warm_start = true;
  s.forces = Forces::kMean;
  s.refinements = 2;
  s.pivots = 7;
  s.mode = Mode::kCapped;
  s.alpha = 0.1 / 3.0;
  s.n = 9;
  s.n_max = 99;
  s.n_cap = 5;
  s.alpha_m = 0.6;
  s.beta = 0.9;
  s.policy = Policy::kSubstep;
  s.memory = 0.8;
  s.islands = true;
  s.sleep = true;
  s.probe = false;
  s.integrator = Integrator::kLeapfrog;
  s.gyroscopic = Gyroscopic::kExplicit;
  s.drift = Drift::kFull;
  s.drift_tau = 0.001;
  s.drift_order = 2;
  s.detection = Detection::kFrame;
  s.contact_stiffness = ContactStiffness::kExact;
  return s;
}

TEST(Experiment, EverySettingOfTheTestIsUnusual) {
  for (const SettingField& field : setting_fields()) {
    if (field.name == "watch_stiffness") continue;
    EXPECT_NE(setting_text(field, unusual()), setting_text(field, Settings{})) << field.name;
  }
}

TEST(Experiment, JsonComesBackTheSame) {
  const auto scene = shared(scenes::swinging_box());
  Experiment experiment = experiment_of(*scene, unusual(), 3);
  experiment.duration = 1.0 / 3.0;
  experiment.load = 0.1;
  Problems problems;
  const auto json = parse_json(experiment_json(experiment).dump(), problems);
  ASSERT_TRUE(json.has_value());
  const auto input = read_experiment(
      *json, [&](const std::string&) { return scene; }, problems);
  ASSERT_TRUE(input.experiment.has_value()) << (problems.empty() ? "" : to_string(problems[0]));
  EXPECT_EQ(*input.experiment, experiment);
  EXPECT_EQ(experiment_id(*input.experiment), experiment_id(experiment));
}

TEST(Experiment, WhatIsLeftOutIsTheScenesOwn) {
  const auto scene = shared(scenes::heavy_stack_tall());
  Problems problems;
  const auto input = read_experiment(
      Json{{"scene", "heavy_stack_tall"}}, [&](const std::string&) { return scene; }, problems);
  ASSERT_TRUE(input.experiment.has_value());
  EXPECT_EQ(input.experiment->settings, scene->settings);
  EXPECT_EQ(input.experiment->duration, scene->criteria.duration);
}

TEST(Experiment, AllThatIsWrongIsToldAtOnce) {
  const auto scene = shared(scenes::pendulum());
  Problems problems;
  const Json json{{"scene", "pendulum"}, {"scene_hash", "0"}, {"settings", {{"alpha", 3.0}}},
                  {"seconds", -1.0},     {"seed", -1},        {"colour", "red"}};
  const auto input = read_experiment(
      json, [&](const std::string&) { return scene; }, problems);
  EXPECT_FALSE(input.experiment.has_value());
  EXPECT_EQ(problems.size(), 5U);
  problems.clear();
  EXPECT_FALSE(read_experiment(
                   Json{{"scene", "?"}}, [](const std::string&) { return nullptr; }, problems)
                   .experiment.has_value());
  EXPECT_EQ(problems.size(), 1U);
  problems.clear();
  Json other = experiment_json(experiment_of(*scene, Settings{}));
  other["seconds"] = 7.0;
  EXPECT_FALSE(read_experiment(
                   other, [&](const std::string&) { return scene; }, problems)
                   .experiment)
      << "the id belongs to another duration";
}

TEST(Experiment, IdDependsOnAllThatMakesTheRunAndOnNothingElse) {
  const Scene scene = scenes::pendulum();
  const std::string id = experiment_id(experiment_of(scene, Settings{}));
  EXPECT_EQ(id.size(), 16U);
  std::set<std::string> ids{id};
  for (const SettingField& field : setting_fields()) {
    Settings settings;
    if (field.name == "watch_stiffness") continue;
    EXPECT_FALSE(set_setting(field, setting_text(field, unusual()), settings));
    EXPECT_TRUE(ids.insert(experiment_id(experiment_of(scene, settings))).second) << field.name;
  }
  EXPECT_TRUE(ids.insert(experiment_id(experiment_of(scene, Settings{}, 1))).second);
  Experiment longer = experiment_of(scene, Settings{});
  longer.duration = 11.0;
  EXPECT_TRUE(ids.insert(experiment_id(longer)).second);
  longer.load = 2.0;
  EXPECT_TRUE(ids.insert(experiment_id(longer)).second);
  Scene heavier = scene;
  heavier.bodies[0].mass = 2.0;
  EXPECT_TRUE(ids.insert(experiment_id(experiment_of(heavier, Settings{}))).second);
  Scene reworded = scene;
  reworded.description = "another description";
  reworded.camera.eye.x() += 1.0;
  reworded.settings.alpha = 0.3;
  EXPECT_EQ(experiment_id(experiment_of(reworded, Settings{})), id);
}

// Results of years are keyed by it.
TEST(Experiment, IdOfTheScenesFileStaysWhatItIs) {
  const auto scene = read_scene_file(SUBSTEP_SOURCE_DIR "/scenes/free_fall.json").scene;
  ASSERT_TRUE(scene);
  EXPECT_EQ(experiment_id(experiment_of(*scene, Settings{})),
            experiment_id(experiment_of(scenes::free_fall(), Settings{})));
  EXPECT_EQ(experiment_id(experiment_of(*scene, Settings{})), "338fa7f7f23df747");
}

TEST(Experiment, ALoadScalesTheHeaviestBodyAlone) {
  const Scene scene = scenes::swinging_box();
  const Scene loaded = start_of(scene, 3.0, 0);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double factor = scene.bodies[i].name == "box" ? 3.0 : 1.0;
    EXPECT_EQ(loaded.bodies[i].mass, factor * scene.bodies[i].mass) << i;
    EXPECT_EQ(loaded.bodies[i].inertia, factor * scene.bodies[i].inertia) << i;
  }
  EXPECT_EQ(mass_ratio(scene), 1000.0);
  EXPECT_EQ(mass_ratio(loaded), 3000.0);
}

TEST(Experiment, ASeedNudgesEveryMovingBodyAndNoMore) {
  const Scene scene = scenes::swinging_box();
  EXPECT_EQ(start_of(scene, 1.0, 0).bodies[1].velocity, scene.bodies[1].velocity);
  const Scene nudged = start_of(scene, 1.0, 5);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const double by = (nudged.bodies[i].velocity - scene.bodies[i].velocity).norm();
    EXPECT_EQ(by > 0.0, !scene.bodies[i].is_static) << i;
    EXPECT_LT(by, 2e-9) << i;
    EXPECT_EQ(nudged.bodies[i].position, scene.bodies[i].position);
  }
  EXPECT_EQ(start_of(scene, 1.0, 5).bodies[1].velocity, nudged.bodies[1].velocity);
  EXPECT_NE(start_of(scene, 1.0, 6).bodies[1].velocity, nudged.bodies[1].velocity);
}

TEST(Metrics, AFreeTopKeepsItsMomentumAndAPendulumIsNotAsked) {
  const auto metrics = [](const Scene& scene) {
    const auto held = shared(scene);
    Experiment experiment = experiment_of(scene, scene.settings);
    experiment.duration = 1.0;
    const Reference reference = find_reference(held, 1.0);
    ExperimentRun run(scene, experiment, reference);
    while (run.advance()) {
    }
    return run.result().metrics;
  };
  const Metrics top = metrics(scenes::spinning_top());
  ASSERT_TRUE(top.errors.angular_momentum_drift.has_value());
  EXPECT_LT(*top.errors.angular_momentum_drift, 1e-10);
  EXPECT_LT(std::abs(*top.errors.energy_drift_percent), 1e-9);
  EXPECT_FALSE(top.errors.joint_gap.has_value());
  const Metrics pendulum = metrics(scenes::pendulum());
  EXPECT_FALSE(pendulum.errors.angular_momentum_drift.has_value());
  EXPECT_TRUE(pendulum.errors.joint_gap.has_value());
  EXPECT_EQ(pendulum.work.frames, 60);
  EXPECT_GT(pendulum.timing.ms_median, 0.0);
  EXPECT_GE(pendulum.timing.ms_p95, pendulum.timing.ms_median);
}

TEST(Metrics, AFailedRunEndsThereAndHasNoTrajectoryError) {
  const Scene scene = scenes::swinging_box();
  const auto held = shared(scene);
  Settings settings;
  settings.mode = Mode::kNone;
  const Reference reference = find_reference(held, 0.5);
  ExperimentRun run(scene, experiment_of(scene, settings), reference);
  while (run.advance()) {
  }
  const Metrics m = run.result().metrics;
  EXPECT_FALSE(m.holds);
  EXPECT_NEAR(m.failed_at, 0.35, 0.035);
  EXPECT_EQ(m.work.frames, std::llround(m.failed_at * 60.0));
  EXPECT_FALSE(m.errors.trajectory_peak.has_value());
  const Json json = result_json(run.result());
  EXPECT_EQ(json["holds"], false);
  Problems problems;
  EXPECT_EQ(result_id(json, problems), experiment_id(run.experiment()));
}

Work work_of(const Scene& scene, const Settings& settings, double seconds) {
  Experiment experiment = experiment_of(scene, settings);
  experiment.duration = seconds;
  const Reference reference;
  ExperimentRun run(scene, experiment, reference);
  while (run.advance()) {
  }
  return run.result().metrics.work;
}

TEST(Work, FlopsFollowFromSizesAlone) {
  // Pinned hinges in a row: a run's flops are a constant per solve.
  const Scene scene = scenes::rope_of_n({.n = 6});
  const auto work = [&](const Settings& settings, double seconds) {
    return work_of(scene, settings, seconds);
  };
  Settings settings;
  settings.mode = Mode::kConst;
  for (const SolverKind solver : {SolverKind::kBpp, SolverKind::kPgs}) {
    settings.solver = solver;
    settings.n = 3;
    const Work once = work(settings, 0.1);
    settings.n = 6;
    const Work twice = work(settings, 0.1);
    EXPECT_GT(once.flops, 0);
    EXPECT_EQ(once.flops % once.solves, 0);
    EXPECT_EQ(twice.flops, 2 * once.flops);
    EXPECT_EQ(twice.row_updates, 2 * once.row_updates);
    EXPECT_EQ(once.substeps, 18);
  }
  EXPECT_EQ(work(settings, 0.1), work(settings, 0.1)) << "run to run";
}

TEST(Work, GaussSeidelVisitsEveryRowOnceAnIteration) {
  Settings settings;
  settings.solver = SolverKind::kPgs;
  settings.iterations = 7;
  const Work work = work_of(scenes::bridge(), settings, 0.5);
  EXPECT_GT(work.rows.joint, 0);
  EXPECT_GT(work.rows.contact, 0);
  EXPECT_EQ(work.rows.friction, 2 * work.rows.contact);
  EXPECT_EQ(work.rows.grab, 0);
  EXPECT_EQ(work.row_updates, 7 * (work.rows.joint + work.rows.contact + work.rows.friction));
  EXPECT_EQ(work_of(scenes::swinging_box(), settings, 0.1).rows.joint % 130, 0);
}

TEST(Work, AHandHasRowsOfItsOwn) {
  const Scene scene = scenes::rope_of_n({.n = 4});
  Simulator simulator(shared(scene));
  const auto rows = [&] { return simulator.step().work.rows; };
  Settings settings;
  settings.mode = Mode::kConst;
  settings.n = 2;
  simulator.set_settings(settings);
  const RowCounts free = rows();
  simulator.set_grab(Grab{.body = 2});
  const RowCounts held = rows();
  EXPECT_EQ(free.grab, 0);
  EXPECT_EQ(held.grab, 2 * 3);
  EXPECT_EQ(held.joint, free.joint);
}

TEST(Work, TheCriterionIsCountedAsOftenAsItsPolicyAsks) {
  const Scene scene = scenes::swinging_box();
  Settings settings;
  settings.mode = Mode::kConst;
  EXPECT_EQ(work_of(scene, settings, 0.5).criterion, CriterionWork{});
  settings.mode = Mode::kAdaptive;
  const Work by_frame = work_of(scene, settings, 0.5);
  EXPECT_EQ(by_frame.criterion.evaluations, by_frame.frames + 1) << "and the probe's";
  settings.policy = Policy::kSubstep;
  const Work by_substep = work_of(scene, settings, 0.5);
  EXPECT_EQ(by_substep.criterion.evaluations, by_substep.substeps + 1);
  EXPECT_EQ(by_substep.criterion.flops / by_substep.criterion.evaluations,
            by_frame.criterion.flops / by_frame.criterion.evaluations);
}

TEST(EffectCost, WhatAnEffectAddsIsWhatItsAbsenceSpares) {
  Scene scene = scenes::bridge();
  Experiment experiment = experiment_of(scene, scene.settings);
  experiment.settings.solver = SolverKind::kPgs;
  experiment.duration = 0.5;
  const CostBreakdown costs = cost_of_effects(scene, experiment);
  ASSERT_EQ(costs.effects.size(), 4U);  // gravity, joints, contact, friction
  std::map<std::string_view, EffectCost> by_name;
  for (const EffectCost& cost : costs.effects) by_name[cost.effect] = cost;
  EXPECT_GT(by_name["friction"].row_updates, 0.0);
  EXPECT_GT(by_name["contact"].row_updates, by_name["friction"].row_updates)
      << "without contact there is no friction";
  EXPECT_GT(by_name["joints"].flops, by_name["contact"].flops);

  experiment.settings.solver = SolverKind::kBpp;
  const CostBreakdown direct = cost_of_effects(scene, experiment);
  const CostBreakdown again = cost_of_effects(scene, experiment);
  for (std::size_t i = 0; i < direct.effects.size(); ++i) {
    EXPECT_EQ(direct.effects[i].flops, again.effects[i].flops) << direct.effects[i].effect;
  }
}

TEST(EffectCost, WhereThereAreJointsAloneTheyCostAllRowUpdates) {
  const Scene scene = scenes::swinging_box();
  Experiment experiment = experiment_of(scene, scene.settings);
  experiment.settings.solver = SolverKind::kPgs;
  experiment.duration = 0.1;
  const CostBreakdown costs = cost_of_effects(scene, experiment);
  const Work& work = costs.run.work;
  const auto frames = static_cast<double>(work.frames);
  ASSERT_EQ(costs.effects.size(), 2U);
  EXPECT_EQ(costs.effects[0].effect, "gravity");
  EXPECT_EQ(costs.effects[0].row_updates, 0.0);
  EXPECT_EQ(costs.effects[1].effect, "joints");
  EXPECT_DOUBLE_EQ(costs.effects[1].row_updates * frames,
                   25.0 * 130.0 * static_cast<double>(work.substeps));  // the probe is no frame's
}

// Until the ball hits the tower its chain takes 12 sub-steps a frame and the tower one.
TEST(EffectCost, OfIslandsIsPartOfWhatTheyCost) {
  const Scene scene = scenes::wrecking_ball();
  Experiment experiment = experiment_of(scene, scene.settings);
  experiment.settings.islands = true;
  experiment.duration = 0.1;
  const CostBreakdown costs = cost_of_effects(scene, experiment);
  const Work& work = costs.run.work;
  ASSERT_EQ(costs.effects.size(), 5U);
  for (const EffectCost& cost : costs.effects) {
    EXPECT_LE(cost.flops * static_cast<double>(work.frames), static_cast<double>(work.flops))
        << cost.effect;
  }
  EXPECT_EQ(costs.effects[3].effect, "contact");
  EXPECT_GT(costs.effects[3].flops, 0.5 * static_cast<double>(work.flops / work.frames));
}

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
                           "newton numerov, const, leapfrog",
                           "pgs 64 a frame, const, euler",
                           "xpbd 64 a frame, const, euler"}) {
    EXPECT_TRUE(series.contains(name)) << name;
  }
  EXPECT_EQ(std::count_if(series.begin(), series.end(), by_island), 0) << "which has one";
  int islands = 0;
  for (const SweepPoint& point : default_sweep(scenes::wrecking_ball())) {
    if (by_island(series_name(point.settings))) ++islands;
  }
  EXPECT_EQ(islands, 11 + 11 + 7);
  // The same on the other main scenes; what is for joints alone is not there where contacts are.
  for (const Scene& other : {scenes::bridge(), scenes::heavy_stack(), scenes::heavy_stack_stress(),
                             scenes::heavy_stack_stress_tall()}) {
    std::set<std::string> there;
    for (const SweepPoint& point : default_sweep(other)) there.insert(series_name(point.settings));
    for (const std::string& name : series) {
      const bool joints_alone = name.starts_with("newton numerov") ||
                                (name.ends_with("drift order 2") && !other.effects.joints);
      const bool once_a_frame = name.find(" a frame") != std::string::npos;
      EXPECT_EQ(there.contains(once_a_frame ? name + ", contacts once a frame" : name),
                !joints_alone)
          << other.name << ": " << name;
    }
    EXPECT_TRUE(there.contains("bpp, adaptive per frame, euler, exact contact block"));
  }
  int exact = 0;
  for (const SweepPoint& point : default_sweep(scenes::bridge())) {
    EXPECT_NE(point.settings.forces, Forces::kNumerov) << "which is for joints alone";
    if (series_name(point.settings).ends_with("exact contact block")) ++exact;
  }
  EXPECT_EQ(exact, 11);
}

TEST(Sweep, DefaultHasEachRunOnceWhateverASceneAsksForItself) {
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
  const auto held = shared(scene);
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

Json result_schema() {
  std::ifstream file(SUBSTEP_SOURCE_DIR "/core/io/result.schema.json");
  return Json::parse(file, nullptr, false);
}

TEST(Results, LinesKeepToTheirSchema) {
  const Json schema = result_schema();
  ASSERT_TRUE(schema.is_object());
  EXPECT_EQ(schema_errors(schema, schema, Json::parse(results_header())),
            std::vector<std::string>{});
  Settings none;
  none.mode = Mode::kNone;
  for (const auto& [scene, settings] :
       {std::pair{scenes::swinging_box(), Settings{}}, std::pair{scenes::swinging_box(), none},
        std::pair{scenes::heavy_stack(), Settings{}}, std::pair{scenes::spinning_top(), Settings{}},
        std::pair{scenes::sliding_box(), unusual()}}) {
    Experiment experiment = experiment_of(scene, settings);
    experiment.duration = 0.5;
    const Reference reference = find_reference(shared(scene), 0.1);
    ExperimentRun run(scene, experiment, reference);
    while (run.advance()) {
    }
    Json line = Json::parse(result_json(run.result()).dump());
    EXPECT_EQ(schema_errors(schema, schema, line), std::vector<std::string>{}) << line.dump();
    line["colour"] = "red";
    EXPECT_FALSE(schema_errors(schema, schema, line).empty());
  }
}

TEST(Results, HeadersOfOtherFilesAreRefused) {
  Problems problems;
  std::string own = results_header();
  own.pop_back();
  check_results_header(own, problems);
  EXPECT_TRUE(problems.empty());
  for (const char* foreign : {"", "{}", "frame,time", R"({"format":"substep-scene","version":1})",
                              R"({"format":"substep-results","version":2})"}) {
    problems.clear();
    check_results_header(foreign, problems);
    EXPECT_FALSE(problems.empty()) << foreign;
  }
}

}  // namespace
}  // namespace substep::test

// Every public function that takes a scene refuses one that a Simulator refuses: it returns its
// empty result, and reads nothing that is not there.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/import/export_mjcf.hpp"
#include "core/io/experiment.hpp"
#include "core/io/frame_columns.hpp"
#include "core/io/motion_csv.hpp"
#include "core/io/saved_scene.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/io/stored_sweep.hpp"
#include "core/lab/alpha_search.hpp"
#include "core/lab/axes.hpp"
#include "core/lab/closed_form.hpp"
#include "core/lab/doctor.hpp"
#include "core/lab/effect_cost.hpp"
#include "core/lab/fair_trade.hpp"
#include "core/lab/forecast.hpp"
#include "core/lab/hold_search.hpp"
#include "core/lab/joint_tree.hpp"
#include "core/lab/passage.hpp"
#include "core/lab/planar_chain.hpp"
#include "core/lab/presets.hpp"
#include "core/lab/remedy.hpp"
#include "core/lab/start_text.hpp"
#include "core/lab/stop_text.hpp"
#include "core/lab/survey.hpp"
#include "core/lab/sweep.hpp"
#include "core/lab/verdict_table.hpp"
#include "core/model/grab.hpp"
#include "core/model/scene_builder.hpp"
#include "core/model/validate.hpp"
#include "core/sim/changed_scene.hpp"
#include "core/sim/conserved.hpp"
#include "core/sim/simulator.hpp"
#include "core/sim/start_projection.hpp"

namespace substep {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kSeconds = 0.1;

/// Two joined boxes above a floor, with all effects.
Scene valid_scene() {
  SceneBuilder builder("boxes");
  builder.add_fixed(Plane{}, {0, 0, 0});
  const int a = builder.add_body(Box{{0.5, 0.1, 0.1}}, 1.0, {0.5, 2, 0});
  const int b = builder.add_body(Box{{0.5, 0.1, 0.1}}, 2.0, {1.5, 2, 0});
  builder.add_hinge(a, kWorld, {0, 2, 0}, {0, 0, 1});
  builder.add_ball_joint(b, a, {1, 2, 0});
  builder.scene().criteria.track = b;
  builder.scene().criteria.duration = kSeconds;
  return *builder.build();
}

struct Broken {
  const char* name;
  std::function<void(Scene&)> apply;
};

const std::vector<Broken>& broken_scenes() {
  static const std::vector<Broken> all{
      {"joint of a body that is not there", [](Scene& s) { base(s.joints[1]).b = 77; }},
      {"joint of a body far away", [](Scene& s) { base(s.joints[1]).a = 2'000'000'000; }},
      {"joint of a negative body", [](Scene& s) { base(s.joints[1]).a = -5; }},
      {"joint of the world alone", [](Scene& s) { base(s.joints[0]).a = kWorld; }},
      {"joint of a body with itself", [](Scene& s) { base(s.joints[1]).b = 2; }},
      {"joints without bodies", [](Scene& s) { s.bodies.clear(); }},
      {"mass that is not a number", [](Scene& s) { s.bodies[1].mass = kNotANumber; }},
      {"mass of 0", [](Scene& s) { s.bodies[1].mass = 0.0; }},
      {"infinite mass", [](Scene& s) { s.bodies[1].mass = HUGE_VAL; }},
      {"no inertia", [](Scene& s) { s.bodies[1].inertia.setZero(); }},
      {"position that is not a number",
       [](Scene& s) { s.bodies[2].position.setConstant(kNotANumber); }},
      {"orientation of length 0", [](Scene& s) { s.bodies[2].orientation.coeffs().setZero(); }},
      {"moving plane", [](Scene& s) { s.bodies[1].shape = Plane{}; }},
      {"box without size",
       [](Scene& s) {
         s.bodies[1].shape = Box{{0, 0, 0}};
       }},
      {"tracked body that is not there", [](Scene& s) { s.criteria.track = 3; }},
      {"tracked body -2, no joints",
       [](Scene& s) {
         s.criteria.track = -2;
         s.joints.clear();
         s.effects.contact = s.effects.joints = false;
       }},
      {"displaced body that is not there",
       [](Scene& s) {
         s.criteria.displacement = Criteria::Displacement{99, 0.1};
       }},
      {"frame of 0", [](Scene& s) { s.frame = 0.0; }},
      {"frame that is not a number", [](Scene& s) { s.frame = kNotANumber; }},
      {"infinite gravity", [](Scene& s) { s.gravity.y() = -HUGE_VAL; }},
      {"unknown solver", [](Scene& s) { s.settings.solver = static_cast<SolverKind>(9); }},
      {"no sub-steps", [](Scene& s) { s.settings.n = 0; }},
      {"duration that is not a number", [](Scene& s) { s.criteria.duration = kNotANumber; }},
      {"endless window", [](Scene& s) { s.criteria.window = HUGE_VAL; }},
      {"carried state of no bodies", [](Scene& s) { s.carried = Carried{}; }},
  };
  return all;
}

std::shared_ptr<const Scene> pointer_to(const Scene& scene) {
  return std::make_shared<const Scene>(scene);
}

Experiment experiment_on(const Scene& scene) {
  Experiment experiment;
  experiment.scene = scene.name;
  experiment.duration = kSeconds;
  return experiment;
}

constexpr double kLong = 10.0;  // of a slice, more than a refused run takes [s]

void expect_failed(const Result& result) {
  EXPECT_FALSE(result.metrics.holds);
  EXPECT_NE(result.metrics.verdict.find("invalid"), std::string::npos) << result.metrics.verdict;
}

struct Call {
  const char* name;
  std::function<void(const Scene&)> call;
};

// What only has a scene, by module. States are those of its bodies, as far as it has any.
const std::vector<Call>& calls() {
  static const std::vector<Call> all{
      // import
      {"export_mjcf",
       [](const Scene& s) {
         const ExportedModel model = export_mjcf(s);
         EXPECT_EQ(model.text, "");
         EXPECT_EQ(model.left_out.notes.size(), 1U);
       }},
      // sim
      {"kept_by_name",
       [](const Scene& s) {
         EXPECT_EQ(kept_by_name(valid_scene(), s).joints.size(), s.joints.size());
         EXPECT_EQ(kept_by_name(s, valid_scene()).joints.size(), valid_scene().joints.size());
       }},
      // model
      {"joined_mass",
       [](const Scene& s) {
         for (const int body : {-5, kWorld, 0, 1, 99}) EXPECT_EQ(joined_mass(s, body), 0.0);
       }},
      {"validate", [](const Scene& s) { EXPECT_FALSE(validate(s).empty()); }},
      {"validate(State)", [](const Scene& s) { validate(State{}, s); }},
      {"validate(Grab)", [](const Scene& s) { EXPECT_FALSE(validate(Grab{}, s).empty()); }},
      {"effects_of", [](const Scene& s) { effects_of(s); }},
      {"initial_state",
       [](const Scene& s) { EXPECT_EQ(initial_state(s).x.size(), s.bodies.size()); }},
      // sim
      {"Simulator",
       [](const Scene& s) {
         Simulator simulator(pointer_to(s));
         EXPECT_EQ(simulator.step().status, StepStatus::kInvalid);
         EXPECT_FALSE(simulator.problems().empty());
       }},
      {"start_of_run", [](const Scene& s) { EXPECT_TRUE(start_of_run(s).state.x.empty()); }},
      {"with_start_of_run",
       [](const Scene& s) {
         const auto scene = pointer_to(s);
         EXPECT_EQ(with_start_of_run(scene), scene);
       }},
      {"joint_starts",
       [](const Scene& s) { EXPECT_TRUE(joint_starts(s, initial_state(s)).empty()); }},
      {"start_errors",
       [](const Scene& s) { EXPECT_TRUE(start_errors(s, initial_state(s)).consistent()); }},
      {"close_joints",
       [](const Scene& s) {
         State state = initial_state(s);
         EXPECT_EQ(close_joints(s, state), Projection::kFailed);
       }},
      {"match_velocities",
       [](const Scene& s) {
         State state = initial_state(s);
         EXPECT_EQ(match_velocities(s, state), Projection::kFailed);
       }},
      {"energies_of", [](const Scene& s) { EXPECT_EQ(energies_of(s, State{}).sum(), 0.0); }},
      {"momenta_of",
       [](const Scene& s) { EXPECT_EQ(momenta_of(s, State{}).linear, Vec3::Zero()); }},
      // lab
      {"find_reference",
       [](const Scene& s) {
         const Reference reference = find_reference(pointer_to(s), kSeconds);
         EXPECT_TRUE(reference.track.empty());
         EXPECT_EQ(reference.failure, "the scene is invalid: " + to_code(check_values(s).front()));
       }},
      {"ReferenceRun",
       [](const Scene& s) {
         ReferenceRun run(pointer_to(s), kSeconds);
         EXPECT_EQ(run.source(), "");
         EXPECT_FALSE(run.advance());
         EXPECT_EQ(run.progress(), 1.0);
         EXPECT_EQ(run.reference().source, "");
       }},
      {"predictable_window", [](const Scene& s) { predictable_window(s, kSeconds); }},
      {"reference_settings", [](const Scene& s) { EXPECT_EQ(reference_settings(s, 4).n, 4); }},
      {"forecast",
       [](const Scene& s) {
         const Forecast f = forecast(s, Settings{});
         EXPECT_EQ(f.n(), 1);
         EXPECT_EQ(f.body, -1);
         EXPECT_EQ(f.mass_ratio, 1.0);
       }},
      {"default_sweep", [](const Scene& s) { EXPECT_TRUE(default_sweep(s).empty()); }},
      {"paper_settings", [](const Scene& s) { paper_settings(s); }},
      {"expected_work", [](const Scene& s) { EXPECT_GE(expected_work(s, experiment_on(s)), 0.0); }},
      {"Sweep",
       [](const Scene& s) {
         Sweep sweep(pointer_to(s), {experiment_on(s), experiment_on(s)});
         EXPECT_FALSE(sweep.advance(kLong));
         ASSERT_EQ(sweep.results().size(), 2U);
         expect_failed(sweep.results()[1]);
       }},
      {"closed_form", [](const Scene& s) { EXPECT_FALSE(closed_form(s)); }},
      {"PlanarChain", [](const Scene& s) { EXPECT_FALSE(PlanarChain::of(s)); }},
      {"JointTree", [](const Scene& s) { EXPECT_FALSE(JointTree::of(s)); }},
      {"LinearModel",
       [](const Scene& s) { EXPECT_TRUE(LinearModel::of(s, initial_state(s)).empty()); }},
      {"static_findings",
       [](const Scene& s) { EXPECT_TRUE(static_findings(s, initial_state(s)).empty()); }},
      {"diagnose",
       [](const Scene& s) {
         EXPECT_EQ(diagnose(pointer_to(s), {}).verdict, Diagnosis::Verdict::kNotUnderstood);
       }},
      {"start_of", [](const Scene& s) { EXPECT_EQ(start_of(s, 3.0, 7).name, s.name); }},
      {"mass_ratio", [](const Scene& s) { mass_ratio(s); }},
      {"frames_of",
       [](const Scene& s) {
         for (const double seconds : {kSeconds, kNotANumber, HUGE_VAL, -1.0}) {
           EXPECT_GE(frames_of(s, seconds), 0);
         }
       }},
      {"ExperimentRun",
       [](const Scene& s) {
         for (const int seed : {0, 3}) {
           if (seed != 0 && s.carried) continue;  // another start drops the invalid part
           Experiment experiment = experiment_on(s);
           experiment.seed = seed;
           experiment.load = seed == 0 ? 1.0 : 100.0;
           ExperimentRun run(s, experiment, no_reference());
           while (run.advance()) {
           }
           expect_failed(run.result());
           EXPECT_EQ(run.simulator().problems().front().pointer, check_values(s).front().pointer);
           EXPECT_FALSE(judge(s, {}, run).as_expected);
         }
       }},
      {"cost_of_effects",
       [](const Scene& s) { EXPECT_FALSE(cost_of_effects(s, experiment_on(s)).run.holds); }},
      {"Verdict",
       [](const Scene& s) {
         Verdict verdict(s, initial_state(s), FrameReport{});
         verdict.add(s, initial_state(s), FrameReport{});
         EXPECT_FALSE(verdict.holds());
         EXPECT_TRUE(verdict.stopped());
         EXPECT_EQ(verdict.text(), "fails at 0.000 s: the input of the simulator is invalid");
       }},
      {"Verdict without a state",
       [](const Scene& s) {
         Verdict verdict(s, State{}, FrameReport{});
         verdict.add(s, State{}, FrameReport{});
         EXPECT_FALSE(verdict.holds());
       }},
      {"EnergyWatch", [](const Scene& s) { EnergyWatch(s, FrameReport{}).add(FrameReport{}); }},
      {"PassageWatch",
       [](const Scene& s) {
         for (const State& state : {State{}, initial_state(s)}) {
           EXPECT_FALSE(PassageWatch(s, state).add(s, state));
         }
       }},
      {"Measure",
       [](const Scene& s) {
         Reference reference;
         reference.track.assign(3, Vec3::Zero());
         Measure measure(s, State{}, FrameReport{}, reference);
         measure.add(s, State{}, FrameReport{}, 0.0);
         EXPECT_FALSE(measure.metrics(s, State{}).holds);
       }},
      {"Survey",
       [](const Scene& s) {
         Survey survey(pointer_to(s), kSeconds);
         EXPECT_FALSE(survey.advance());
         EXPECT_FALSE(survey.farthest());
       }},
      {"AlphaSearch",
       [](const Scene& s) {
         AlphaSearch search = AlphaSearch::largest_within(pointer_to(s), experiment_on(s),
                                                          no_reference(), ErrorAxis::kGap, 1.0);
         EXPECT_FALSE(search.advance(kLong));
         EXPECT_FALSE(search.choice());
       }},
      {"HoldSearch",
       [](const Scene& s) {
         Result candidate;
         candidate.experiment = experiment_on(s);
         candidate.experiment.duration = kSeconds / 2;
         HoldSearch search(pointer_to(s), {candidate}, kSeconds, no_reference(),
                           [](const Result&) { return true; });
         EXPECT_FALSE(search.advance(kLong));
         EXPECT_FALSE(search.found());
       }},
      {"RemedyTrials",
       [](const Scene& s) {
         RemedyTrials trials(pointer_to(s), {{"", "", Settings{}}}, {.frames = 3});
         EXPECT_FALSE(trials.advance());
         EXPECT_TRUE(trials.hold().empty());
       }},
      {"fair_trade",
       [](const Scene& s) { EXPECT_TRUE(fair_trade(s, {}, Policy::kFrame, 0.1).rows.empty()); }},
      {"verdict_table", [](const Scene& s) { verdict_table(s); }},
      {"presets_for", [](const Scene& s) { EXPECT_FALSE(presets_for(s).empty()); }},
      {"energy_changes_by", [](const Scene& s) { energy_changes_by(s); }},
      {"first_axis", [](const Scene& s) { first_axis(s); }},
      {"start_text", [](const Scene& s) { EXPECT_EQ(start_text(s, {}), ""); }},
      {"overlap_text", [](const Scene& s) { EXPECT_EQ(overlap_text(s, {}, {}), ""); }},
      {"stop_text", [](const Scene& s) { EXPECT_EQ(stop_text(s, {}), ""); }},
      // io
      {"write_scene",
       [](const Scene& s) {
         const std::string text = write_scene(s);  // a file may hold a scene that readers refuse
         EXPECT_TRUE(text.empty() || !read_scene(text).problems.empty()) << text;
       }},
      {"scene_hash", [](const Scene& s) { scene_hash(s); }},
      {"experiment_of",
       [](const Scene& s) { EXPECT_EQ(experiment_of(s, Settings{}).scene, s.name); }},
      {"command_line", [](const Scene& s) { command_line(experiment_on(s), s); }},
      {"saved_scene",
       [](const Scene& s) {
         EXPECT_TRUE(saved_scene(s, State{}, Settings{}).bodies.empty());
         EXPECT_TRUE(saved_scene(s, initial_state(s), Settings{}).bodies.empty());
       }},
      {"states_lines",
       [](const Scene& s) {
         EXPECT_EQ(states_lines(s, State{}), "");
         EXPECT_EQ(states_lines(s, initial_state(s)), "");
       }},
      {"joints_lines",
       [](const Scene& s) {
         EXPECT_EQ(joints_lines(s, State{}, {}), "");
         EXPECT_EQ(joints_lines(s, initial_state(s), {}), "");
       }},
      {"csv_line",
       [](const Scene& s) {
         const FrameReport report;
         csv_line(frame_columns(s), {s, report, State{}});
         json_line(frame_columns(s), {s, report, initial_state(s)});
       }},
      {"quick_sweep", [](const Scene& s) { EXPECT_TRUE(quick_sweep(s).empty()); }},
      {"read_sweep", [](const Scene& s) { EXPECT_FALSE(read_sweep("substep-sweep 1 x\n", s)); }},
  };
  return all;
}

TEST(RefusedScenes, ByEveryFunctionThatTakesAScene) {
  ASSERT_TRUE(check_values(valid_scene()).empty());
  for (const Broken& broken : broken_scenes()) {
    Scene scene = valid_scene();
    broken.apply(scene);
    ASSERT_FALSE(check_values(scene).empty()) << broken.name;
    for (const Call& call : calls()) {
      SCOPED_TRACE(std::string(call.name) + ", " + broken.name);
      EXPECT_NO_THROW(call.call(scene));
    }
  }
}

TEST(RefusedScenes, NoneAtAll) {
  EXPECT_EQ(find_reference(nullptr, kSeconds).failure, "the scene is invalid: there is no scene");
  EXPECT_EQ(with_start_of_run(nullptr), nullptr);
  EXPECT_FALSE(Survey(nullptr, kSeconds).advance());
  Sweep sweep(nullptr, {Experiment{}});
  EXPECT_FALSE(sweep.advance(kLong));
  expect_failed(sweep.results().at(0));
  EXPECT_FALSE(
      AlphaSearch::smallest_within(nullptr, Experiment{}, no_reference(), CostAxis::kSubsteps, 1.0)
          .advance(kLong));
  EXPECT_FALSE(HoldSearch(nullptr, {Result{}}, kLong * 10.0, no_reference(), [](const Result&) {
                 return true;
               }).advance(kLong));
  EXPECT_FALSE(RemedyTrials(nullptr, {{"", "", Settings{}}}, {.frames = 3}).advance());
}

TEST(RefusedScenes, TheSameCallsServeAValidOne) {
  const Scene scene = valid_scene();
  EXPECT_EQ(joined_mass(scene, 1), 3.0);
  EXPECT_EQ(joined_mass(scene, 3), 0.0) << "no such body";
  EXPECT_EQ(joined_mass(scene, kWorld), 0.0);
  EXPECT_EQ(find_reference(pointer_to(scene), kSeconds).failure, "");
  EXPECT_GE(forecast(scene, Settings{}).body, 0);
  EXPECT_FALSE(default_sweep(scene).empty());
  EXPECT_NE(scene_hash(scene), 0U);
  EXPECT_FALSE(states_lines(scene, initial_state(scene)).empty());
  EXPECT_FALSE(joints_lines(scene, initial_state(scene), {}).empty());
  EXPECT_TRUE(read_scene(write_scene(scene)).problems.empty());
}

TEST(RefusedScenes, AMovedSimulatorHasNone) {
  Simulator simulator(pointer_to(valid_scene()));
  simulator.step();
  Simulator other(std::move(simulator));
  Simulator third(pointer_to(valid_scene()));
  third = std::move(other);
  EXPECT_EQ(third.state().frame, 1) << "the run went along";
  EXPECT_EQ(third.step().status, StepStatus::kOk);
  for (Simulator* moved : {&simulator, &other}) {
    EXPECT_EQ(moved->step().status, StepStatus::kInvalid);
    EXPECT_EQ(moved->substep().status, StepStatus::kInvalid);
    EXPECT_EQ(moved->step_some(1.0).status, StepStatus::kInvalid);
    EXPECT_EQ(moved->observe().status, StepStatus::kInvalid);
    EXPECT_EQ(moved->substeps_left(), 0);
    EXPECT_TRUE(moved->scene().bodies.empty());
    EXPECT_TRUE(moved->state().x.empty());
    EXPECT_TRUE(moved->constraint_forces().joints.empty());
    EXPECT_FALSE(moved->start().projected);
    moved->reset();
    moved->set_state(State{});
    moved->set_settings(Settings{});
    moved->set_budget(Budget{});
    moved->set_measures(Measures{});
    moved->set_grab(Grab{});
    moved->set_grab(std::nullopt);
    EXPECT_FALSE(moved->grab());
    EXPECT_EQ(to_code(moved->problems().front()), "there is no scene");
    *moved = Simulator(pointer_to(valid_scene()));
    EXPECT_EQ(moved->step().status, StepStatus::kOk) << "it can be used again";
  }
}

TEST(RefusedScenes, OtherMovedRunsHaveEnded) {
  ReferenceRun run(pointer_to(valid_scene()), kSeconds);
  const ReferenceRun other(std::move(run));
  EXPECT_FALSE(run.advance());
  EXPECT_EQ(run.source(), "");
  RemedyTrials trials(pointer_to(valid_scene()), {{"", "", Settings{}}}, {.frames = 3});
  trials.advance();
  const RemedyTrials rest(std::move(trials));
  EXPECT_FALSE(trials.advance());
}

TEST(RefusedQuestions, OfTheDoctor) {
  const auto problem = [](const std::function<void(DoctorQuestion&)>& change) {
    DoctorQuestion question;
    question.runs = false;
    change(question);
    return diagnose(std::make_shared<const Scene>(valid_scene()), question).problem;
  };
  EXPECT_EQ(problem([](DoctorQuestion&) {}), "");
  EXPECT_EQ(problem([](DoctorQuestion& q) { q.engine = nullptr; }), "there is no engine");
  for (const double step : {kNotANumber, -1.0, 2.0, std::numeric_limits<double>::infinity()}) {
    EXPECT_NE(problem([&](DoctorQuestion& q) { q.step = step; }), "") << step;
    EXPECT_NE(problem([&](DoctorQuestion& q) { q.seconds = 1e6 * step; }), "") << step;
  }
  EXPECT_NE(problem([](DoctorQuestion& q) { q.held = -1; }), "");
}

TEST(RefusedBuilding, OfIndicesAndJointsWithoutACoordinate) {
  SceneBuilder builder("one");
  builder.add_body(Sphere{0.5}, 1.0, Vec3::Zero());
  const int ball = builder.add_ball_joint(0, kWorld, Vec3::UnitX());
  const std::vector<std::function<void(int)>> calls = {
      [&](int joint) { builder.limit(joint, 0.0, 1.0); },
      [&](int joint) { builder.drive(joint, 1.0, 1.0); },
      [&](int joint) { builder.drive(joint, Drive{}); },
      [&](int joint) {
        builder.add_spring(joint, {0.0, 1.0, 0.0});
      },
      [&](int joint) { builder.rub(joint, 1.0); },
      [&](int joint) { builder.add_armature(joint, 1.0); }};
  for (const auto& call : calls) {
    EXPECT_THROW(call(-1), std::out_of_range);
    EXPECT_THROW(call(1), std::out_of_range);
    EXPECT_THROW(call(ball), std::invalid_argument);
  }
  EXPECT_THROW(builder.body(1), std::out_of_range);
  EXPECT_THROW(builder.joint(-1), std::out_of_range);
}

TEST(RefusedScenes, AJointOfABodyThatIsNotThere) {
  Scene scene = valid_scene();
  base(scene.joints[0]).a = 99;
  base(scene.joints[0]).b = -7;
  EXPECT_EQ(joint_json(scene, scene.joints[0])["a"], "");
  EXPECT_GE(largest_gap(scene, base(scene.joints[0])), 0.0);
}

TEST(HoldSearch, WithoutAFunctionEachRunServesThatHolds) {
  const auto scene = std::make_shared<const Scene>(valid_scene());
  Result candidate;
  candidate.experiment = experiment_of(*scene, scene->settings);
  candidate.experiment.duration = kSeconds;
  HoldSearch search(scene, {candidate}, 2.0 * kSeconds, no_reference(), nullptr);
  while (search.advance(1.0)) {
  }
  EXPECT_TRUE(search.found());
}

}  // namespace
}  // namespace substep

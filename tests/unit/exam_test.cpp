// The exam's closed forms against known values and against each other, and the verdicts of cases.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <set>

#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "core/lab/elliptic.hpp"
#include "core/lab/exact_motion.hpp"
#include "core/lab/exam.hpp"
#include "core/sim/simulator.hpp"
#include "scenes/generator/bricard.hpp"
#include "scenes/generator/exam.hpp"
#include "scenes/generator/exam_contact.hpp"
#include "scenes/generator/exam_parts.hpp"
#include "tests/support/keep_largest.hpp"

namespace substep {
namespace {

TEST(Elliptic, CompleteIntegralHasItsKnownValues) {
  EXPECT_NEAR(complete_elliptic(0.0), 0.5 * std::numbers::pi, 1e-15);
  // Gamma(1/4)^2 / (4 sqrt(pi)), the lemniscate's.
  EXPECT_NEAR(complete_elliptic(0.5), 1.8540746773013719, 1e-14);
  EXPECT_NEAR(complete_elliptic(0.81), 2.2805491384227703, 1e-14);
}

TEST(Elliptic, JacobiFunctionsHaveTheirKnownValues) {
  // Abramowitz and Stegun's worked example to five decimals.
  const Jacobi example = jacobi(0.2, 0.81);
  EXPECT_NEAR(example.sn, 0.19762, 5e-6);
  EXPECT_NEAR(example.cn, 0.98028, 5e-6);
  EXPECT_NEAR(example.dn, 0.98406, 1e-5);
  for (const double m : {0.0, 0.1, 0.5, 0.9, 0.999}) {
    const double K = complete_elliptic(m);
    const double k1 = std::sqrt(1.0 - m);
    EXPECT_NEAR(jacobi(0.5 * K, m).sn, 1.0 / std::sqrt(1.0 + k1), 1e-14) << m;
    EXPECT_NEAR(jacobi(K, m).sn, 1.0, 1e-14) << m;
    EXPECT_NEAR(jacobi(K, m).dn, k1, 1e-12) << m;
    EXPECT_NEAR(jacobi(6.0 * K, m).am, 3.0 * std::numbers::pi, 1e-12) << m;
  }
}

TEST(Elliptic, AmplitudeInvertsTheIntegralOfTheFirstKind) {
  const double m = 0.7;
  const double phi = jacobi(1.3, m).am;
  constexpr int kPanels = 2000;  // Simpson's rule: an error of 1e-15
  double sum = 0.0;
  for (int i = 0; i <= kPanels; ++i) {
    const double s = std::sin(phi * i / kPanels);
    const double weight = i == 0 || i == kPanels ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight / std::sqrt(1.0 - m * s * s);
  }
  EXPECT_NEAR(sum * phi / (3.0 * kPanels), 1.3, 1e-13);
}

TEST(ExactPendulum, IsThatOfTheIftommBenchmark) {
  const double angle =
      ExactPendulum::released(std::sqrt(9.81), 0.5 * std::numbers::pi).at(10.0).angle;
  EXPECT_NEAR(-std::sin(angle), -0.27508746258, 1e-11);
  EXPECT_NEAR(-std::cos(angle), -0.96141920510, 1e-11);
  const double over = ExactPendulum::over_the_top(std::sqrt(3.5 * 9.81 / 3.0), 1.0).at(10.0).angle -
                      std::numbers::pi;
  EXPECT_NEAR(std::sin(over), 0.32845811154, 2e-8);
  EXPECT_NEAR(std::cos(over), 0.94451853818, 2e-8);
}

TEST(ExactPendulum, SpeedAndAccelerationAreTheDerivatives) {
  constexpr double kStep = 1e-5;
  for (const auto& pendulum :
       {ExactPendulum::released(3.0, 2.5), ExactPendulum::over_the_top(3.0, 0.7)}) {
    for (const double t : {0.1, 0.9, 3.7}) {
      const auto before = pendulum.at(t - kStep);
      const auto after = pendulum.at(t + kStep);
      const auto now = pendulum.at(t);
      EXPECT_NEAR((after.angle - before.angle) / (2.0 * kStep), now.speed, 1e-8);
      EXPECT_NEAR((after.speed - before.speed) / (2.0 * kStep), now.acceleration, 1e-8);
    }
  }
}

TEST(FreeBody, ClosedFormsAgreeWithRungeKutta) {
  const Attitude start{Quat(0.8, 0.1, -0.5, 0.3).normalized(), {1.0, -2.0, 0.7}};
  const PivotedBody plate{.mass = 1.0, .inertia = {1.0, 1.0, 2.0}};
  const Attitude symmetric = free_symmetric_body(1.0, 2.0, start, 5.0);
  const Attitude integrated = pivoted_body_after(plate, start, 5.0, 20000);
  EXPECT_LT(scenes::angle_between(symmetric.q_WB, integrated.q_WB), 1e-10);
  EXPECT_LT((symmetric.w - integrated.w).norm(), 1e-10);

  const PivotedBody block{.mass = 1.0, .inertia = {1.0, 2.0, 3.0}};
  ExactTumbling tumbling(block.inertia, 3.0, 0.03);
  const Attitude resting{Quat::Identity(), {0.0, 3.0, 0.03}};
  double t = 0.0;
  for (const double until : {0.4, 3.0, 9.0}) {  // the last after several tumbles
    t = until;
    const Attitude exact = tumbling.at(t);
    const Attitude own = pivoted_body_after(block, resting, t, static_cast<int>(10000 * t));
    // Every tumble passes close to the intermediate axis and magnifies rounding a hundredfold.
    const double tolerance = t < tumbling.half_period() ? 1e-9 : 1e-7;
    EXPECT_LT(scenes::angle_between(exact.q_WB, own.q_WB), tolerance) << t;
    EXPECT_LT((exact.w - own.w).norm(), tolerance) << t;
  }
  EXPECT_LT(tumbling.half_period(), t);
}

TEST(HeavyTop, MinimalCoordinatesGiveThePublishedEulerParameters) {
  const PivotedBody top{.mass = 15.0,
                        .inertia = {15.234375, 0.46875, 15.234375},
                        .centre = {0.0, 1.0, 0.0},
                        .gravity = {0.0, 0.0, -9.81}};
  const Attitude start{Quat::Identity(), {0.0, 150.0, -4.61538}};
  const Attitude fine = pivoted_body_after(top, start, 0.2, 20000);
  const Attitude finer = pivoted_body_after(top, start, 0.2, 40000);
  EXPECT_LT(scenes::angle_between(fine.q_WB, finer.q_WB), 1e-10);
  Quat q = finer.q_WB;
  if (q.w() > 0.0) q.coeffs() = -q.coeffs();
  EXPECT_NEAR(q.w(), -0.70828, 1e-5);
  EXPECT_NEAR(q.x(), 0.43878, 1e-5);
  EXPECT_NEAR(q.y(), 0.54573, 1e-5);
  EXPECT_NEAR(q.z(), 0.0894, 1e-5);
}

TEST(Bricard, LoopClosesAndEnergyIsConserved) {
  for (const double angle : {0.0, 0.3, 1.5, 3.0}) {
    EXPECT_LT(scenes::Bricard::closure_error(angle), 1e-14) << angle;
  }
  scenes::Bricard once;
  once.advance(5.0);
  EXPECT_NEAR(once.energy(), 0.0, 1e-8);
  scenes::Bricard finer;
  double most = 0.0;
  for (int i = 1; i <= 5000; ++i) {
    finer.advance(1e-3 * i);
    keep_largest(most, finer.angle());
  }
  EXPECT_NEAR(once.angle(), finer.angle(), 1e-9);
  EXPECT_NEAR(most, std::numbers::pi, 1e-3) << "it swings from a cube to its mirror image";
}

TEST(SpringBounce, LosesNothingAndBouncesElevenTimesInTenSeconds) {
  const scenes::SpringBounce bounce{.mass = 0.1, .stiffness = 1e3, .height = 1.0, .gravity = 9.81};
  EXPECT_EQ(bounce.bounces_within(10.0), 11);
  constexpr double kStep = 1e-5;
  for (int i = 0; i < 220; ++i) {
    const double t = 0.01 + 0.0137 * i;
    const double gap = bounce.gap_after(t);
    const double v = (bounce.gap_after(t + kStep) - bounce.gap_after(t - kStep)) / (2.0 * kStep);
    const double pressed = std::min(0.0, gap);
    const double energy = 0.05 * v * v + 0.981 * gap + 500.0 * pressed * pressed;
    EXPECT_NEAR(energy, 0.981, 1e-5) << t;
  }
}

TEST(Rolling, AccelerationsSatisfyNewtonsLaws) {
  const scenes::RollingAccelerations a = scenes::rolling_accelerations();
  const double on_ball = 1.0 * a.ball;               // m a = f
  const double spin = on_ball * 0.5 / (0.4 * 0.25);  // (2/5) m r^2 alpha = f r
  EXPECT_NEAR(a.box, a.ball + 0.5 * spin, 1e-12) << "no slip";
  EXPECT_NEAR(10.0 * a.box, 150.0 - 0.4 * 35.0 * 9.8 - 25.0 * on_ball, 1e-12);
  EXPECT_LT(on_ball, 0.8 * 9.8) << "within the cone";
}

/// A ball in free fall with a synthetic error computed from the number of sub-steps.
ExamCase made_up(double power, std::optional<double> order) {
  ExamCase exam = scenes::exam_case("made_up", "", "", "", 0.1, 0.05);
  exam.scene.effects.gravity = true;
  exam.scene.bodies.push_back(scenes::solid("ball", Sphere{0.5}, 1.0, Vec3::Zero()));
  exam.quantities = {{"error", "m", 1e-3, ""}};
  exam.measure = [power] {
    return [power](const ExamView& view, std::span<double> errors) {
      if (view.report.n_substeps > 0) errors[0] = std::pow(view.report.n_substeps, -power);
    };
  };
  PaperSettings settings;
  settings.mode = Mode::kConst;
  exam.methods = {{"made up", settings, {2, 8, 32}, order}};
  exam.most_for_order = 1.0;
  return exam;
}

TEST(Exam, PassesIfARunIsWithinToleranceAndOrdersHold) {
  const ExamResult second = run_exam(made_up(2.0, 2.0));
  ASSERT_EQ(second.rows.size(), 3U);
  EXPECT_FALSE(second.rows[1].passes);
  EXPECT_TRUE(second.rows[2].passes) << "32^-2 is below 1e-3";
  EXPECT_NEAR(second.rows[2].order.value(), 2.0, 1e-12);
  EXPECT_EQ(second.rows[2].substeps, 32.0);
  EXPECT_TRUE(second.passed());
  EXPECT_EQ(second.best(made_up(2.0, 2.0)), 2U);

  const ExamResult less = run_exam(made_up(2.0, 4.0));
  EXPECT_TRUE(less.reached);
  EXPECT_FALSE(less.kept) << "second order where fourth is expected";
  const ExamResult first = run_exam(made_up(1.0, 1.0));
  EXPECT_FALSE(first.reached);
  EXPECT_TRUE(first.kept);
}

TEST(Exam, AToleranceForEveryRunFailsIfOneRunExceedsIt) {
  ExamCase exam = made_up(2.0, std::nullopt);
  exam.quantities[0].for_every_run = true;
  const ExamResult result = run_exam(exam);
  EXPECT_TRUE(result.reached);
  EXPECT_FALSE(result.passed());
}

TEST(Exam, ANonFiniteErrorFails) {
  ExamCase exam = made_up(2.0, std::nullopt);
  exam.measure = [] {
    return [](const ExamView&, std::span<double> errors) {
      errors[0] = std::numeric_limits<double>::quiet_NaN();
    };
  };
  EXPECT_FALSE(run_exam(exam).reached);
}

TEST(Exam, ForcesBelongToTheStateThatTheyAreShownWith) {
  ExamCase exam = scenes::exam_revolute();
  exam.methods.resize(1);  // adaptive: frames of one sub-step among them
  exam.methods[0].parameters = {1.0};
  std::int64_t expected = 0;
  exam.measure = [&expected] {
    return [&expected](const ExamView& view, std::span<double>) {
      EXPECT_EQ(view.state.frame, expected++);
      EXPECT_EQ(view.forces.joints.size(), 1U);
    };
  };
  run_exam(exam);
  EXPECT_EQ(expected, 51) << "the start and 50 frames";
}

TEST(Exam, MotionsMatchTheScenes) {
  int seen = 0;
  for (const ExamEntry& entry : scenes::exam()) {
    const ExamCase exam = entry.build();
    if (!exam.motion) continue;
    ++seen;
    PaperSettings settings;
    settings.mode = Mode::kConst;
    settings.n = 256;
    settings.integrator = Integrator::kLeapfrog;
    Simulator simulator(std::make_shared<const Scene>(exam.scene));
    simulator.set_settings(settings);
    const ExamMotion motion = exam.motion();
    std::vector<Vec3> x = simulator.state().x;
    std::vector<Quat> q = simulator.state().q;
    for (int frame = 0; frame <= 3; ++frame) {
      const State& state = simulator.state();
      motion(state.time, x, q);
      const double allowed = frame == 0 ? 1e-12 : 2e-3;
      for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_LT((state.x[i] - x[i]).norm(), allowed) << entry.name << ' ' << i << ' ' << frame;
        EXPECT_LT(scenes::angle_between(state.q[i], q[i]), allowed)
            << entry.name << ' ' << i << ' ' << frame;
      }
      simulator.step();
    }
  }
  EXPECT_GE(seen, 10);
}

TEST(Exam, EveryCaseHasASceneAndTolerancesWithReasons) {
  std::set<std::string> names;
  for (const ExamEntry& entry : scenes::exam()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    const ExamCase exam = entry.build();
    EXPECT_EQ(exam.name, entry.name);
    EXPECT_EQ(exam.scene.name, "exam_" + entry.name);
    EXPECT_EQ(exam.scene.group, "exam");
    EXPECT_FALSE(exam.scene.bodies.empty());
    EXPECT_FALSE(exam.source.empty());
    for (const Problem& problem : read_scene(write_scene(exam.scene)).problems) {
      ADD_FAILURE() << entry.name << ": " << to_string(problem);
    }
    EXPECT_FALSE(exam.methods.empty());
    for (const ExamQuantity& quantity : exam.quantities) {
      EXPECT_GT(quantity.tolerance, 0.0) << entry.name << ' ' << quantity.name;
      EXPECT_NE(quantity.why, "") << entry.name << ' ' << quantity.name;
    }
  }
}

}  // namespace
}  // namespace substep

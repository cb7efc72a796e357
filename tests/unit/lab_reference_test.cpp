// The exact motions used as references for errors.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/lab/closed_form.hpp"
#include "core/lab/planar_chain.hpp"
#include "core/lab/reference.hpp"
#include "scenes/generator/scenes.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/unit/tree_scenes.hpp"

namespace substep::test {
namespace {

TEST(Extrapolation, OscillatorOverAThousandPeriods) {
  Extrapolation integrator(1e-13);
  VecX y(2);
  y << 1.0, 0.0;
  const double pi = std::acos(-1.0);
  integrator.advance(
      [](const VecX& at, VecX& slope) {
        slope.resize(2);
        slope << at[1], -at[0];
      },
      2000.0 * pi, y);
  EXPECT_NEAR(y[0], 1.0, 1e-10);
  EXPECT_NEAR(y[1], 0.0, 1e-9);
}

// The error of a step is bounded by the tolerance: a smaller tolerance gives a more accurate
// answer.
TEST(Extrapolation, ErrorFollowsTheTolerance) {
  const auto error = [](double tolerance) {
    Extrapolation integrator(tolerance);
    VecX y = VecX::Constant(1, 1.0);
    integrator.advance([](const VecX& at, VecX& slope) { slope = -at.cwiseProduct(at); }, 100.0, y);
    return std::abs(y[0] - 1.0 / 101.0);
  };
  EXPECT_LT(error(1e-13), 1e-13);
  EXPECT_LT(error(1e-7), 1e-7);
  EXPECT_GT(error(1e-3), error(1e-13));
}

/// The data of an independent fourth-order Runge-Kutta program: t, x, y, six angles, E, KE.
std::vector<std::array<double, 11>> independent_rows() {
  std::ifstream file(SUBSTEP_SOURCE_DIR "/tests/reference/reference_swinging_box.csv");
  std::vector<std::array<double, 11>> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    auto& row = rows.emplace_back();
    for (double& value : row) fields >> value;
  }
  return rows;
}

TEST(PlanarChain, SwingingBoxAgreesWithTheIndependentDataAndKeepsItsEnergy) {
  const Scene scene = scenes::swinging_box();
  auto chain = PlanarChain::of(scene);
  ASSERT_TRUE(chain.has_value());
  EXPECT_EQ(chain->size(), 26);
  const int box = *scene.criteria.track;
  const double at_start = potential(scene, *chain);
  const auto rows = independent_rows();
  ASSERT_EQ(rows.size(), 601U);
  double apart = 0.0;
  double drift = 0.0;
  for (std::size_t frame = 0; frame < index(repetitions(601, 61)); ++frame) {
    if (frame > 0) chain->advance(scene.frame);
    const Vec3 x = chain->centre(box);
    keep_largest(apart, std::hypot(x.x() - rows[frame][1], x.y() - rows[frame][2]));
    keep_largest(drift, std::abs(chain->kinetic() + potential(scene, *chain) - at_start));
    EXPECT_NEAR(chain->kinetic(), rows[frame][10], 1e-4) << frame;
  }
  EXPECT_LT(apart, 1e-8) << "[m], over 10 s";
  EXPECT_LT(drift, 1e-9 * 51500.0) << "[J], of the exchanged energy";
}

TEST(PlanarChain, PendulumHasThePeriodOfTheEllipticIntegral) {
  const Scene scene = scenes::pendulum();
  auto chain = PlanarChain::of(scene);
  ASSERT_TRUE(chain.has_value());
  const Body& rod = scene.bodies[0];
  const double arm = 0.5;
  const double about_pivot = rod.inertia.z() + rod.mass * arm * arm;
  const double half_angle = std::sqrt((1.0 - 0.8) / 2.0);  // sin(theta_0/2) of cos(theta_0) = 0.8
  const double period =
      4.0 * std::sqrt(about_pivot / (rod.mass * 9.81 * arm)) * std::comp_ellint_1(half_angle);
  const Vec3 start = chain->centre(0);
  chain->advance(0.5 * period);
  EXPECT_NEAR(chain->centre(0).x(), -start.x(), 1e-11);
  chain->advance(0.5 * period);
  EXPECT_LT((chain->centre(0) - start).norm(), 1e-11);
  EXPECT_NEAR(period, 1.682, 5e-4) << "as stated in the scene";
}

TEST(PlanarChain, AnyLengthAndStartAngleKeepTheirEnergy) {
  for (const int n : {1, 2, 7, repetitions(40, 15)}) {
    for (const scenes::Angle& angle : {scenes::Angle{0.6, 0.8}, scenes::Angle{0.96, -0.28}}) {
      const Scene scene = scenes::rope_of_n({.n = n, .angle = angle});
      auto chain = PlanarChain::of(scene);
      ASSERT_TRUE(chain.has_value()) << n;
      const double before = potential(scene, *chain);
      chain->advance(1.0);
      const double exchanged = chain->kinetic();
      EXPECT_GT(exchanged, 1.0) << n;
      EXPECT_NEAR(chain->kinetic() + potential(scene, *chain), before, 1e-9 * exchanged) << n;
    }
  }
}

// The orientation of the world must not matter: the same chain with hinges along x, gravity along
// z.
TEST(PlanarChain, ATurnedSceneMovesTheSame) {
  const Scene straight = scenes::rope_of_n({.n = 3});
  Scene turned = straight;
  const Quat turn(Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, -0.5).normalized()));
  turned.gravity = turn * straight.gravity;
  for (Body& body : turned.bodies) {
    body.position = turn * body.position;
    body.orientation = turn * body.orientation;
  }
  for (Joint& joint : turned.joints) {
    auto& hinge = std::get<HingeJoint>(joint);
    if (hinge.b != kWorld) continue;
    hinge.anchor_b = turn * hinge.anchor_b;
    hinge.axis_b = turn * hinge.axis_b;
  }
  auto a = PlanarChain::of(straight);
  auto b = PlanarChain::of(turned);
  ASSERT_TRUE(a && b);
  a->advance(0.8);
  b->advance(0.8);
  EXPECT_LT((turn * a->centre(3) - b->centre(3)).norm(), 1e-11);
}

TEST(PlanarChain, OtherScenesAreRefused) {
  EXPECT_FALSE(PlanarChain::of(scenes::bridge()));
  EXPECT_FALSE(PlanarChain::of(scenes::free_fall()));
  EXPECT_FALSE(PlanarChain::of(scenes::spinning_top()));
  Scene leaves_the_plane = scenes::rope_of_n({.n = 3});
  leaves_the_plane.bodies[1].angular_velocity.x() = 0.1;
  EXPECT_FALSE(PlanarChain::of(leaves_the_plane));
  Scene torn = scenes::rope_of_n({.n = 3});
  torn.joints.pop_back();
  EXPECT_FALSE(PlanarChain::of(torn));
  Scene not_parallel = scenes::rope_of_n({.n = 3});
  std::get<HingeJoint>(not_parallel.joints[2]).axis_a = Vec3::UnitX();
  EXPECT_FALSE(PlanarChain::of(not_parallel));
  Scene touching = scenes::rope_of_n({.n = 3});
  touching.effects.contact = true;
  EXPECT_FALSE(PlanarChain::of(touching));
}

TEST(ClosedForm, BoxOnASlopeSlidesOrStays) {
  const auto slides = closed_form(scenes::sliding_box());
  ASSERT_TRUE(slides.has_value());
  EXPECT_NEAR(slides->acceleration.norm(), 9.81 * (5.0 - 0.3 * 12.0) / 13.0, 1e-12);
  const auto stays = closed_form(scenes::sliding_box({.friction = 0.5}));
  ASSERT_TRUE(stays.has_value());
  EXPECT_EQ(stays->acceleration.norm(), 0.0);
}

TEST(ClosedForm, OtherScenesAreRefused) {
  EXPECT_FALSE(closed_form(scenes::heavy_stack()));
  EXPECT_FALSE(closed_form(scenes::pendulum()));
  Scene thrown = scenes::sliding_box();
  thrown.bodies[1].velocity.x() = 1.0;
  EXPECT_FALSE(closed_form(thrown));
  Scene tips = scenes::sliding_box({.fall = 4.0, .run = 3.0, .length = 5.0, .friction = 1.2});
  EXPECT_FALSE(closed_form(tips));
}

// Both directions: the simulation validates the reference, and the reference the simulation.
TEST(Reference, EveryExactSceneConvergesToIt) {
  Settings fine;
  fine.mode = Mode::kConst;
  fine.n = 64;
  fine.integrator = Integrator::kLeapfrog;
  for (const Scene& scene : {scenes::pendulum(), scenes::free_fall(), scenes::sliding_box(),
                             scenes::spinning_top(), scenes::rope_of_n({.n = 4})}) {
    const auto shared = std::make_shared<const Scene>(scene);
    const Reference reference = find_reference(shared, 2.0);
    EXPECT_EQ(reference.source.rfind("exact", 0), 0U) << scene.name;
    ASSERT_EQ(reference.track.size(), 121U) << scene.name;
    const Outcome r = run(scene, fine, 2.0);
    double apart = 0.0;
    for (std::size_t i = 0; i < r.track.size(); ++i) {
      keep_largest(apart, (r.track[i] - reference.track[i]).norm());
    }
    EXPECT_LT(apart, 1e-4) << scene.name;
  }
}

TEST(Reference, WithoutAnExactMotionTheFinestRunStatesItsUncertainty) {
  Scene scene = scenes::bridge();
  const auto shared = std::make_shared<const Scene>(scene);
  const Reference reference = find_reference(shared, 0.2);
  EXPECT_EQ(reference.source.rfind("finest run", 0), 0U);
  EXPECT_GT(reference.uncertainty, 0.0);
  EXPECT_LT(reference.uncertainty, 1e-2);
  EXPECT_EQ(predictable_window(scene, 10.0), 2.0) << "contact is chaotic";
  EXPECT_EQ(predictable_window(scenes::swinging_box(), 10.0), 10.0);
  scene.criteria.window = 5.0;
  EXPECT_EQ(predictable_window(scene, 10.0), 5.0) << "the scene's own";
  EXPECT_EQ(predictable_window(scene, 3.0), 3.0) << "no longer than the run";
}

Reference refined(const Scene& scene, double duration, double required) {
  ReferenceRun run(std::make_shared<const Scene>(scene), duration, {}, required);
  while (run.advance()) EXPECT_LE(run.progress(), 1.0);
  EXPECT_FALSE(run.advance()) << "it is done";
  return run.reference();
}

TEST(Reference, IsRefinedUntilItIsAsCertainAsRequired) {
  const Scene scene = scenes::crank_rocker();
  const Reference plain = find_reference(std::make_shared<const Scene>(scene), 0.1);
  EXPECT_EQ(plain.source, "finest run: bpp, leapfrog, 256 sub-steps per frame");
  ASSERT_GT(plain.uncertainty, 0.0);
  const Reference fine = refined(scene, 0.1, 0.02 * plain.uncertainty);
  EXPECT_LE(fine.uncertainty, 0.02 * plain.uncertainty);
  EXPECT_EQ(fine.source, "finest run: bpp, leapfrog, 2048 sub-steps per frame");
  ASSERT_EQ(fine.track.size(), plain.track.size());
  double apart = 0.0;
  for (std::size_t i = 0; i < fine.track.size(); ++i) {
    keep_largest(apart, (fine.track[i] - plain.track[i]).norm());
  }
  EXPECT_GT(apart, 0.0);
  EXPECT_LE(apart, plain.uncertainty) << "the uncertainty was no promise too much";
  const Reference same = refined(scene, 0.1, plain.uncertainty);
  EXPECT_EQ(same.source, plain.source) << "as certain as required";
  EXPECT_EQ(same.track, plain.track);
}

TEST(Reference, IsTheMostCertainRunIfNoneIsAsCertainAsRequired) {
  const Reference plain =
      find_reference(std::make_shared<const Scene>(scenes::bouncing_balls()), 2.0);
  const Reference fine = refined(scenes::bouncing_balls(), 2.0, 1e-15);
  EXPECT_LE(fine.uncertainty, plain.uncertainty);
  EXPECT_GT(fine.uncertainty, 1e-15);
  // An exact motion has nothing to refine.
  EXPECT_EQ(refined(scenes::pendulum(), 0.5, 1e-15).source, "exact: minimal coordinates, 1 angle");
}

TEST(Reference, ARunThatFailsSaysSo) {
  Scene scene = scenes::crank_rocker();
  EXPECT_EQ(refined(scene, 0.05, 1.0).failure, "");
  scene.criteria.joint_gap = 1e-12;
  const Reference failed = refined(scene, 0.05, 1e-3);
  EXPECT_NE(failed.failure.find("joint gap"), std::string::npos) << failed.failure;
}

}  // namespace
}  // namespace substep::test

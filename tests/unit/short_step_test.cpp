// Every solver on joints and contacts of rigid bodies. In a sub-step so short that nothing rotates,
// the implicit solvers have the same boxed problem as the linear ones; in a long one Newton's
// solution is complementary at its end.

#include "core/constraints/moved_rows.hpp"
#include "core/model/names.hpp"
#include "core/solver/solver.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

/// Balls over a floor, some of them joined to each other or to the world. The bias sets the
/// distance at which they touch.
struct Pile {
  Scene scene;
  State state;
  Blocks blocks;
  std::vector<InverseMass> inverse_mass;
  std::vector<Vec6> u_before;
  std::vector<Mat3> R_WB;
  double dt;

  Pile(Random& random, int balls, int joints, double mu, double step) : dt(step) {
    scene.effects.joints = scene.effects.contact = true;
    scene.effects.friction = mu > 0.0;
    scene.contact.margin = 10.0;  // all pairs have rows
    scene.bodies.push_back(fixed(Plane{}));
    for (int i = 0; i < balls; ++i) {
      Body body = moving(Sphere{uniform(random, 0.3, 0.5)}, uniform(random, 1.0, 5.0));
      body.orientation = random_rotation(random);
      body.position = 0.3 * random_vector(random) + Vec3(1.2 * i, 1.0, 0.0);
      scene.bodies.push_back(body);
    }
    for (Body& body : scene.bodies) body.friction = mu;
    for (int i = 0; i < joints; ++i) {
      HingeJoint hinge;
      hinge.a = 1 + i % balls;
      hinge.b = i == 0 ? kWorld : i % balls;
      hinge.anchor_a = 0.3 * random_vector(random);
      hinge.anchor_b = 0.3 * random_vector(random);
      hinge.axis_a = hinge.axis_b = random_vector(random).normalized();
      if (i % 2 == 0) {
        scene.joints.emplace_back(hinge);
      } else {
        scene.joints.emplace_back(ball_of(hinge));
      }
    }
    state = initial_state(scene);
    for (std::size_t i = 1; i < state.u.size(); ++i) {
      state.u[i] << random_vector(random), random_vector(random);
    }
    u_before = state.u;
    R_WB = rotations(state);
    JointStage(scene).append(whole(scene), state, R_WB, blocks);
    ContactStage(scene).detect_and_append(scene, whole(scene), state, R_WB, blocks);
    if (mu > 0.0) FrictionStage(scene).append(scene, R_WB, blocks.all());
    for (Block& block : blocks.all()) {
      const double softness = uniform(random, 0.05, 0.5);
      for (int row = 0; row < block.rows; ++row) {
        block.softness[row] = softness;
        block.bias[row] = uniform(random);
        block.impulse[row] = 0.0;
        block.active_set[row] = block.is_contact() ? kUnknownSet : std::int8_t{0};
      }
    }
    inverse_mass = inverse_masses(scene, state);
  }
  System system() { return {blocks.all(), inverse_mass, state.u, u_before, dt, R_WB}; }
};

Settings until_done(Forces forces) {
  Settings settings;
  settings.iterations = 4000;
  settings.forces = forces;
  return settings;
}

/// Bounds of friction change with the solution; BPP updates them a few times per call.
SolveReport settle(Solver& solver, Pile& pile, Forces forces = Forces::kEnd) {
  const std::vector<Vec6> u = pile.state.u;
  SolveReport report;
  for (int call = 0; call < 20; ++call) {
    pile.state.u = u;
    report = solver.solve(pile.system(), until_done(forces));
    if (report.status == SolveStatus::kSolved) break;
  }
  return report;
}

struct SolverAndForces {
  SolverKind solver;
  Forces forces = Forces::kEnd;  // of Newton's method
};

class EverySolverOfRigidBodies : public testing::TestWithParam<SolverAndForces> {};
INSTANTIATE_TEST_SUITE_P(Solvers, EverySolverOfRigidBodies,
                         testing::Values(SolverAndForces{SolverKind::kPgs},
                                         SolverAndForces{SolverKind::kBpp},
                                         SolverAndForces{SolverKind::kXpbd},
                                         SolverAndForces{SolverKind::kNewton},
                                         SolverAndForces{SolverKind::kNewton, Forces::kMean}),
                         [](const auto& of) {
                           const std::string solver(name_of(of.param.solver));
                           return of.param.forces == Forces::kEnd ? solver : solver + "_mean";
                         });

constexpr double kShort = 3e-7;   // rows rotate by as many radians [s]
constexpr double kTurned = 1e-4;  // upper bound of its effect on velocities and impulses

TEST_P(EverySolverOfRigidBodies, SolutionsOfShortStepsAreComplementary) {
  Random random(51);
  const auto solver = make_solver(GetParam().solver);
  int closed = 0;
  int sliding = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Pile pile(random, 1 + trial % 3, trial % 4, trial % 2 == 0 ? 0.0 : 0.4, kShort);
    const std::vector<Vec6> u_star = pile.state.u;
    settle(*solver, pile, GetParam().forces);
    EXPECT_LT(lcp_residual(pile.system()), kTurned) << "trial " << trial;
    std::vector<Vec6> u = u_star;
    for (const Block& block : pile.blocks.all()) {
      apply_impulse(block, block.impulse, pile.inverse_mass, u);
      if (!block.is_contact() || block.impulse[0] == 0.0) continue;
      ++closed;
      // BPP's bound is that of its last pass but one.
      constexpr double kAtBound = 1.0 - 1e-6;
      sliding +=
          block.rows == 3 && std::abs(block.impulse[1]) >= kAtBound * block.mu * block.impulse[0];
    }
    for (std::size_t i = 0; i < u.size(); ++i) {
      EXPECT_LT((u[i] - pile.state.u[i]).norm(), kTurned) << "trial " << trial;
    }
  }
  EXPECT_GT(closed, 60);
  EXPECT_GT(sliding, 5);
}

// With this much softness the solution is unique.
TEST_P(EverySolverOfRigidBodies, SolutionsOfShortStepsAgree) {
  Random random(52);
  const auto solver = make_solver(GetParam().solver);
  const auto direct = make_solver(SolverKind::kBpp);
  for (int trial = 0; trial < 60; ++trial) {
    Pile pile(random, 1 + trial % 3, trial % 4, trial % 2 == 0 ? 0.0 : 0.3, kShort);
    Pile other = pile;
    settle(*solver, pile, GetParam().forces);
    settle(*direct, other);
    for (std::size_t i = 0; i < pile.state.u.size(); ++i) {
      EXPECT_LT((pile.state.u[i] - other.state.u[i]).norm(), kTurned) << "trial " << trial;
    }
  }
}

TEST_P(EverySolverOfRigidBodies, WithoutBlocksVelocitiesAreUnchanged) {
  Random random(53);
  Pile pile(random, 3, 0, 0.0, 0.01);
  pile.blocks.clear();
  const std::vector<Vec6> u = pile.state.u;
  make_solver(GetParam().solver)->solve(pile.system(), Settings{});
  for (std::size_t i = 0; i < u.size(); ++i) EXPECT_EQ(u[i], pile.state.u[i]);
}

// Long steps: the poses at the end determine which contacts open and which carry load.
TEST(Newton, IsComplementaryAtTheEndOfALongStep) {
  Random random(54);
  const auto newton = make_solver(SolverKind::kNewton);
  int closed = 0;
  int open = 0;
  for (int trial = 0; trial < 60; ++trial) {
    Pile pile(random, 1 + trial % 3, trial % 4, trial % 2 == 0 ? 0.0 : 0.4, 0.02);
    const SolveReport report = settle(*newton, pile);
    if (report.status != SolveStatus::kSolved) continue;
    const auto move = [&](int body) {
      return body < 0 ? Motion{} : motion(pile.state.u[static_cast<std::size_t>(body)], pile.dt);
    };
    for (const Block& start : pile.blocks.all()) {
      Block end = start;
      move_rows(start, move(start.a), move(start.b), end);
      double w[kMaxRows];
      for (int row = 0; row < start.rows; ++row) {
        w[row] =
            start.bias[row] + end.phi[row] / pile.dt + start.softness[row] * start.impulse[row];
      }
      if (!start.is_contact()) {
        for (int row = 0; row < start.rows; ++row) EXPECT_NEAR(w[row], 0.0, 1e-6);
        continue;
      }
      EXPECT_GE(start.impulse[0], 0.0);
      EXPECT_NEAR(std::min(w[0], start.impulse[0]), 0.0, 1e-6) << "trial " << trial;
      (start.impulse[0] > 0.0 ? closed : open) += 1;
      const double bound = start.mu * start.impulse[0];
      for (int row = 1; row < start.rows; ++row) {
        const double x = start.impulse[row];
        EXPECT_NEAR(x, std::min(bound, std::max(-bound, x - w[row])), 1e-6) << "trial " << trial;
      }
    }
  }
  EXPECT_GT(closed, 40);
  EXPECT_GT(open, 40);
}

}  // namespace
}  // namespace substep::test

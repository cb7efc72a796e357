// Solvers that are implicit at the end of a sub-step, against the equations that they solve.

#include "core/constraints/moved_rows.hpp"
#include "core/math/across.hpp"
#include "core/model/names.hpp"
#include "core/solver/solver.hpp"
#include "core/stepping/integrate.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/unit/support.hpp"

namespace substep::test {
namespace {

enum class Links : std::uint8_t {
  kHingesAndBalls,
  kAnyRows,  // hinges and slides without their last rows: universal joints, points on a line, ...
};

/// A chain of boxes on joints under tension.
struct Chain {
  Scene scene;
  State state;
  Blocks blocks;
  std::vector<InverseMass> inverse_mass;
  std::vector<Vec6> u_before;
  std::vector<Mat3> R_WB;
  double dt = 1.0 / 60.0;

  Chain(Random& random, int links, double mass_of_last, Links kind = Links::kHingesAndBalls) {
    scene.effects.joints = true;
    for (int i = 0; i < links; ++i) {
      Body body = moving(Box{Vec3{0.2, 0.1, 0.15}}, i + 1 == links ? mass_of_last : 1.0);
      body.orientation = random_rotation(random);
      const Vec3 pivot = i == 0 ? Vec3(Vec3::Zero()) : end_of(i - 1);
      body.position = pivot - body.orientation * Vec3(-0.2, 0.0, 0.0);
      HingeJoint hinge;
      hinge.a = i;
      hinge.b = i == 0 ? kWorld : i - 1;
      hinge.anchor_a = {-0.2, 0.0, 0.0};
      hinge.anchor_b = i == 0 ? Vec3(Vec3::Zero()) : Vec3(0.2, 0.0, 0.0);
      const Vec3 axis = random_vector(random).normalized();
      hinge.axis_a = body.orientation.conjugate() * axis;
      hinge.axis_b =
          i == 0
              ? axis
              : Vec3(scene.bodies[static_cast<std::size_t>(i - 1)].orientation.conjugate() * axis);
      scene.bodies.push_back(body);
      if (i % 2 == 0) {
        scene.joints.emplace_back(hinge);
      } else if (kind == Links::kAnyRows) {
        scene.joints.emplace_back(slide_of(hinge));
      } else {
        scene.joints.emplace_back(ball_of(hinge));
      }
    }
    state = initial_state(scene);
    for (Vec6& u : state.u) u << 0.3 * random_vector(random), random_vector(random);
    u_before = state.u;
    for (Vec6& u : state.u) u[1] -= 9.81 * dt;
    R_WB = rotations(state);
    JointStage(scene).append(whole(scene), state, R_WB, blocks);
    for (Block& block : blocks.all()) {
      if (kind == Links::kAnyRows) {
        block.rows -= static_cast<int>(random() % (block.has_point_rows ? 3U : 5U));
        block.position_rows =
            static_cast<std::int8_t>(std::min(block.rows, int{block.position_rows}));
      }
      std::fill(block.impulse, block.impulse + kMaxRows, 0.0);
      std::fill(block.active_set, block.active_set + kMaxRows, std::int8_t{0});
      for (int row = 0; row < block.rows; ++row) {
        block.softness[row] = 1e-9;
        block.bias[row] = block.phi[row] / dt;
      }
    }
    inverse_mass = inverse_masses(scene, state);
  }
  [[nodiscard]] Vec3 end_of(int i) const {
    const Body& body = scene.bodies[static_cast<std::size_t>(i)];
    return body.position + body.orientation * Vec3(0.2, 0.0, 0.0);
  }
  /// A slide along the axis of a hinge.
  [[nodiscard]] PrismaticJoint slide_of(const HingeJoint& hinge) const {
    const auto turned = [&](int body) -> Mat3 {
      if (body == kWorld) return Mat3::Identity();
      return scene.bodies[index(body)].orientation.toRotationMatrix();
    };
    PrismaticJoint slide;
    static_cast<JointBase&>(slide) = hinge;
    slide.axis_a = hinge.axis_a;
    slide.axis_b = hinge.axis_b;
    Vec3 third;
    across(slide.axis_a, slide.across_a, third);
    slide.across_b = turned(slide.b).transpose() * turned(slide.a) * slide.across_a;
    return slide;
  }
  System system() { return {blocks.all(), inverse_mass, state.u, u_before, dt, R_WB}; }
};

/// Residual of phi(q+)/dt + softness * impulse, largest row [m/s].
double error_at_end(Chain& chain) {
  double worst = 0.0;
  const auto move = [&](int body) {
    return body < 0 ? Motion{} : motion(chain.state.u[static_cast<std::size_t>(body)], chain.dt);
  };
  for (const Block& start : chain.blocks.all()) {
    Block end = start;
    move_rows(start, move(start.a), move(start.b), end);
    for (int row = 0; row < start.rows; ++row) {
      keep_largest(worst, std::abs(start.bias[row] + end.phi[row] / chain.dt +
                                   start.softness[row] * start.impulse[row]));
    }
  }
  return worst;
}

/// Residual of u+ - u* - M^-1 J'^T impulse, largest body, relative.
double error_of_impulses(Chain& chain, const std::vector<Vec6>& u_star, Forces forces) {
  std::vector<Vec6> u = u_star;
  const auto move = [&](int body, std::span<const Vec6> velocities, double dt) {
    return body < 0 ? Motion{} : motion(velocities[static_cast<std::size_t>(body)], dt);
  };
  const auto add = [&](const Block& rows, const double* impulse, double weight) {
    double part[kMaxRows];
    for (int row = 0; row < rows.rows; ++row) part[row] = weight * impulse[row];
    apply_impulse(rows, part, chain.inverse_mass, u);
  };
  const double w = forces == Forces::kEnd ? 1.0 : 0.25;
  for (const Block& start : chain.blocks.all()) {
    Block end = start;
    Block back = start;
    move_rows(start, move(start.a, chain.state.u, chain.dt), move(start.b, chain.state.u, chain.dt),
              end);
    move_rows(start, move(start.a, chain.u_before, -chain.dt),
              move(start.b, chain.u_before, -chain.dt), back);
    add(end, start.impulse, w);
    if (forces == Forces::kEnd) continue;
    add(start, start.impulse, 1.0 - 2.0 * w);
    add(back, start.impulse, w);
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    keep_largest(worst, (u[i] - chain.state.u[i]).norm() / (1.0 + u[i].norm()));
  }
  return worst;
}

TEST(Newton, SolvesTheImplicitSubstep) {
  Random random(41);
  for (const Forces forces : {Forces::kEnd, Forces::kMean}) {
    for (int trial = 0; trial < 30; ++trial) {
      Chain chain(random, 1 + trial % 8, trial % 2 == 0 ? 1.0 : 1000.0);
      const std::vector<Vec6> u_star = chain.state.u;
      Settings settings;
      settings.iterations = 100;
      settings.forces = forces;
      const auto newton = make_solver(SolverKind::kNewton);
      const SolveReport report = newton->solve(chain.system(), settings);
      EXPECT_EQ(report.status, SolveStatus::kSolved) << name_of(forces) << " trial " << trial;
      EXPECT_LT(error_at_end(chain), 1e-7) << name_of(forces) << " trial " << trial;
      EXPECT_LT(error_of_impulses(chain, u_star, forces), 1e-7)
          << name_of(forces) << " trial " << trial;
    }
  }
}

TEST(Newton, SolvesJointsOfAnyNumberOfRows) {
  Random random(46);
  for (int trial = 0; trial < 30; ++trial) {
    Chain chain(random, 1 + trial % 8, 1.0, Links::kAnyRows);
    const std::vector<Vec6> u_star = chain.state.u;
    Settings settings;
    settings.iterations = 100;
    settings.forces = Forces::kEnd;
    const SolveReport report = make_solver(SolverKind::kNewton)->solve(chain.system(), settings);
    EXPECT_EQ(report.status, SolveStatus::kSolved) << "trial " << trial;
    EXPECT_LT(error_at_end(chain), 1e-7) << "trial " << trial;
    EXPECT_LT(error_of_impulses(chain, u_star, settings.forces), 1e-7) << "trial " << trial;
  }
}

// The part of the Hessian that does not resist, and the coupling of the two bodies of a hinge, are
// omitted: the error falls by a factor of ten per step, not quadratically.
TEST(Newton, ConvergesInAFewSteps) {
  Random random(42);
  for (int trial = 0; trial < 20; ++trial) {
    double error[6];
    const Chain start(random, 6, 1.0);
    for (int steps = 1; steps < 6; ++steps) {
      Chain chain = start;
      Settings settings;
      settings.iterations = steps;
      make_solver(SolverKind::kNewton)->solve(chain.system(), settings);
      error[steps] = error_at_end(chain);
    }
    EXPECT_LT(error[5], 1e-3 * error[2]) << "trial " << trial;
    EXPECT_LT(error[5], 1e-6) << "trial " << trial;
  }
}

TEST(Newton, WithoutRotationIsTheLinearSolve) {
  Random random(43);
  Chain chain(random, 1, 1.0);
  BallJoint ball;
  ball.a = 0;
  ball.b = kWorld;  // at the centre: no rotation, phi is linear
  ball.anchor_b = chain.state.x[0];
  chain.scene.joints = {ball};
  for (Vec6* u : {&chain.state.u[0], &chain.u_before[0]}) u->tail<3>().setZero();
  chain.blocks.clear();
  JointStage(chain.scene)
      .append(whole(chain.scene), chain.state, rotations(chain.state), chain.blocks);
  Block& block = chain.blocks.all()[0];
  for (int row = 0; row < 3; ++row) {
    block.impulse[row] = block.bias[row] = 0.0;
    block.active_set[row] = 0;
    block.softness[row] = 0.1;
  }
  Chain linear = chain;
  make_solver(SolverKind::kNewton)->solve(chain.system(), Settings{});
  make_solver(SolverKind::kBpp)->solve(linear.system(), Settings{});
  EXPECT_LT((chain.state.u[0] - linear.state.u[0]).norm(), 1e-14);
}

// The directions of XPBD's impulses are those of the intermediate poses, Newton's those of the end:
// they differ by the rotation of a sub-step, and the velocities by its square.
TEST(Xpbd, ConvergesToTheEndOfTheSubstepAndNearlyToNewton) {
  Random random(44);
  double whole = 0.0;
  double half = 0.0;
  for (int trial = 0; trial < 10; ++trial) {
    for (double* sum : {&whole, &half}) {
      Random same(100U + static_cast<unsigned>(trial));
      Chain chain(same, 3, 1.0);
      if (sum == &half) chain.dt *= 0.5;
      Chain other = chain;
      Settings settings;
      settings.iterations = 3000;
      make_solver(SolverKind::kXpbd)->solve(chain.system(), settings);
      EXPECT_LT(error_at_end(chain), 1e-8);
      make_solver(SolverKind::kNewton)->solve(other.system(), settings);
      for (std::size_t i = 0; i < chain.state.u.size(); ++i) {
        keep_largest(*sum, (chain.state.u[i] - other.state.u[i]).norm());
      }
    }
  }
  EXPECT_LT(half, 0.6 * whole);
}

TEST(Xpbd, SolvesJointsOfAnyNumberOfRows) {
  Random random(47);
  for (int trial = 0; trial < 10; ++trial) {
    Chain chain(random, 1 + trial % 4, 1.0, Links::kAnyRows);
    Settings settings;
    settings.iterations = 3000;
    make_solver(SolverKind::kXpbd)->solve(chain.system(), settings);
    EXPECT_LT(error_at_end(chain), 1e-8) << "trial " << trial;
  }
}

TEST(Xpbd, ImpulsesMatchTheVelocitiesOfTheCentres) {
  Random random(45);
  Chain chain(random, 5, 20.0);
  std::vector<Vec6> u = chain.state.u;
  Settings settings;
  settings.iterations = 7;
  make_solver(SolverKind::kXpbd)->solve(chain.system(), settings);
  for (const Block& block : chain.blocks.all()) {
    apply_impulse(block, block.impulse, chain.inverse_mass, u);
  }
  for (std::size_t i = 0; i < u.size(); ++i) {
    EXPECT_LT((u[i] - chain.state.u[i]).head<3>().norm(), 1e-12);
  }
}

}  // namespace
}  // namespace substep::test

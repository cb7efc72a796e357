#pragma once
// Every solver and integrator, for tests of a joint type against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <vector>

#include "core/io/saved_scene.hpp"
#include "core/io/scene_reader.hpp"
#include "core/io/scene_writer.hpp"
#include "tests/support/keep_largest.hpp"
#include "tests/support/run.hpp"

namespace substep::test {

struct JointMethod {
  const char* name;
  PaperSettings settings;
  int order;  // of the integration
};

inline void PrintTo(const JointMethod& method, std::ostream* out) { *out << method.name; }

inline Settings const_settings(SolverKind solver, Integrator integrator, int n,
                               Forces forces = Forces::kEnd) {
  PaperSettings settings;
  settings.mode = Mode::kConst;
  settings.solver = solver;
  settings.integrator = integrator;
  settings.forces = forces;
  settings.n = n;
  settings.iterations = 400;      // for the iterative solvers
  settings.drift = Drift::kFull;  // the default of PGS corrects errors at its own rate
  return settings;
}

inline std::vector<JointMethod> joint_methods() {
  return {{"Bpp", const_settings(SolverKind::kBpp, Integrator::kEuler, 8), 1},
          {"BppLeapfrog", const_settings(SolverKind::kBpp, Integrator::kLeapfrog, 8), 2},
          {"BppStormer", const_settings(SolverKind::kBpp, Integrator::kStormer, 8), 4},
          {"Pgs", const_settings(SolverKind::kPgs, Integrator::kEuler, 8), 1},
          {"Xpbd", const_settings(SolverKind::kXpbd, Integrator::kEuler, 8), 1},
          {"Newton", const_settings(SolverKind::kNewton, Integrator::kEuler, 8), 1},
          {"NewtonMean",
           const_settings(SolverKind::kNewton, Integrator::kLeapfrog, 8, Forces::kMean), 2},
          {"NewtonNumerov",
           const_settings(SolverKind::kNewton, Integrator::kLeapfrog, 8, Forces::kNumerov), 4}};
}

/// Largest error after each frame.
inline double error_after(const Scene& scene, const Settings& settings, double seconds,
                          const std::function<double(const State&, double)>& error) {
  Simulator simulator = simulator_of(scene, settings);
  double most = 0.0;
  const auto frames = std::lround(seconds / scene.frame);
  for (long i = 0; i < frames; ++i) {
    const FrameReport report = simulator.step();
    EXPECT_EQ(report.status, StepStatus::kOk);
    keep_largest(most, error(simulator.state(), simulator.state().time));
  }
  return most;
}

/// The error after doubling the sub-steps: reduced at least by the method's order, or at the level
/// of the iteration's or rounding's residual.
inline void expect_order(const Scene& scene, const JointMethod& method, double seconds,
                         double floor, const std::function<double(const State&, double)>& error) {
  Settings finer = method.settings;
  finer.n *= 2;
  const double coarse = error_after(scene, method.settings, seconds, error);
  const double fine = error_after(scene, finer, seconds, error);
  const double shrinks = std::pow(2.0, method.order);
  EXPECT_LT(fine, std::max(floor, 1.15 * coarse / shrinks)) << coarse;
}

/// A run that is saved after 20 frames and read again continues bit for bit.
inline void expect_continues(const Scene& scene, const Settings& settings) {
  Simulator whole = simulator_of(scene, settings);
  for (int i = 0; i < 20; ++i) ASSERT_EQ(whole.step().status, StepStatus::kOk);
  const SceneResult saved =
      read_scene(write_scene(saved_scene(scene, whole.state(), whole.settings())));
  ASSERT_TRUE(saved.scene) << to_string(saved.problems.front());
  Simulator rest(saved.scene);
  for (int i = 0; i < 20; ++i) {
    whole.step();
    rest.step();
  }
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    EXPECT_EQ(whole.state().x[body], rest.state().x[body]);
    EXPECT_EQ(whole.state().q[body].coeffs(), rest.state().q[body].coeffs());
    EXPECT_EQ(whole.state().u[body], rest.state().u[body]);
  }
}

}  // namespace substep::test

// Laws that every method in the sweep of a scene must satisfy, whatever its source: closed forms of
// small scenes. A method added to the sweep is tested here automatically.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include "core/io/experiment.hpp"
#include "core/lab/axes.hpp"
#include "core/lab/sweep.hpp"
#include "tests/support/paper_settings.hpp"
#include "tests/support/run.hpp"
#include "tests/support/tumbling_chain.hpp"

namespace substep::test {
namespace {

/// The curves of a scene's sweep by name, each with the settings along its parameter.
std::map<std::string, std::vector<Settings>> methods_of(const Scene& scene) {
  std::map<std::string, std::vector<Settings>> methods;
  for (const SweepPoint& point : default_sweep(scene)) {
    if (point.load == 1.0) methods[series_name(point.settings)].push_back(point.settings);
  }
  return methods;
}

/// The best result of a curve.
struct Best {
  Settings method;  // without its parameter
  double error = std::numeric_limits<double>::infinity();
  int holds = 0;
  int runs = 0;
};

std::map<std::string, Best> best_of(const Scene& scene, ErrorAxis axis, double seconds) {
  const auto shared = std::make_shared<const Scene>(scene);
  const Reference reference = find_reference(shared, seconds);
  std::map<std::string, Best> all;
  for (const auto& [name, curve] : methods_of(scene)) {
    Best& best = all[name];
    best.method = curve.front();
    best.runs = static_cast<int>(curve.size());
    for (const Settings& settings : curve) {
      Experiment experiment = experiment_of(scene, settings);
      experiment.duration = seconds;
      ExperimentRun run(scene, experiment, reference);
      while (run.advance()) {
      }
      const Result result = run.result();
      best.holds += result.metrics.holds ? 1 : 0;
      best.error = std::min(best.error, error_of(result, axis).value_or(best.error));
    }
  }
  return all;
}

bool damps(const Settings& s) { return s.mode == Mode::kDamping || s.mode == Mode::kStiffness; }
bool sweeps(const Settings& s) {
  return s.solver == SolverKind::kPgs || s.solver == SolverKind::kXpbd;
}

TEST(EveryMethod, SwingsAsAPendulum) {
  const Scene scene = scenes::pendulum();
  for (const auto& [name, best] : best_of(scene, ErrorAxis::kTrajectory, 3.0)) {
    EXPECT_EQ(best.holds, best.runs) << name;
    // All of K in the mass is inertia that the rod does not have. The other methods are of first,
    // second or fourth order, with one sub-step per frame if N follows K: nothing is stiff here.
    const double of_fourth_order = best.method.mode == Mode::kAdaptive ? 1e-5 : 1e-9;
    const double most = best.method.mode == Mode::kStiffness             ? 0.1
                        : best.method.integrator == Integrator::kStormer ? of_fourth_order
                        : best.method.integrator == Integrator::kEuler   ? 10.1e-3
                                                                         : 0.7e-3;
    EXPECT_LT(best.error, most) << name;
  }
}

TEST(EveryMethod, CarriesALoad) {
  scenes::RopeOptions options;
  options.n = 4;
  options.end_mass = 100.0;
  const Scene scene = scenes::rope_of_n(options);
  for (const auto& [name, best] : best_of(scene, ErrorAxis::kTrajectory, 1.0)) {
    // One sub-step per frame is too few for explicit methods, two for Störmer, whose stability
    // limit is half as large.
    const int too_few = best.method.integrator == Integrator::kStormer ? 2 : 1;
    EXPECT_GE(best.holds, sweeps(best.method) ? 1 : best.runs - too_few) << name;
    const double most = damps(best.method)                               ? 0.25
                        : sweeps(best.method)                            ? 0.02
                        : best.method.integrator == Integrator::kStormer ? 2e-8
                        : best.method.integrator == Integrator::kEuler   ? 8e-3
                                                                         : 0.1e-3;
    EXPECT_LT(best.error, most) << name;
  }
}

TEST(EveryMethod, SlidesWithTheFrictionOfCoulomb) {
  const Scene scene = scenes::sliding_box();
  const double seconds = 1.0;
  const double acceleration = 9.81 * (5.0 / 13.0 - 0.3 * 12.0 / 13.0);
  const double ahead = 0.5 * acceleration * seconds / 60.0;  // of Euler with one sub-step per frame
  for (const auto& [name, best] : best_of(scene, ErrorAxis::kTrajectory, seconds)) {
    EXPECT_EQ(best.holds, best.runs) << name;
    const bool exact = best.method.integrator == Integrator::kLeapfrog;
    EXPECT_LT(best.error, exact ? 1e-8 : 1.0001 * ahead) << name;
  }
}

TEST(EveryMethod, StandsUnderAPlate) {
  scenes::HeavyStackOptions options;
  options.layers = 1;
  options.top_mass = 10.0;
  options.stress = true;
  const Scene scene = scenes::heavy_stack(options);
  for (const auto& [name, best] : best_of(scene, ErrorAxis::kPenetration, 1.0)) {
    EXPECT_GE(best.holds, best.runs - 3) << name;
    EXPECT_LT(best.error, sweeps(best.method) ? 0.5e-3 : 1e-6) << name;
  }
}

TEST(EveryMethod, KeepsTheEnergyOfASpinningTop) {
  for (const auto& [name, best] : best_of(scenes::spinning_top(), ErrorAxis::kEnergy, 3.0)) {
    EXPECT_EQ(best.holds, best.runs) << name;
    if (best.method.gyroscopic == Gyroscopic::kImplicit) {
      // Fourth-order rotations conserve the momentum exactly, and the energy up to their error.
      const bool fourth_order =
          best.method.integrator == Integrator::kStormer || best.method.forces == Forces::kNumerov;
      EXPECT_LT(best.error, fourth_order ? 1e-11 : 1e-12) << name;
    } else {
      EXPECT_GT(best.error, 1e-2) << "the purpose of the implicit torque";
    }
  }
}

TEST(EveryMethod, KeepsTheMomentumOfAFreeChain) {
  const Scene scene = tumbling_chain();
  for (const auto& [name, curve] : methods_of(scene)) {
    const Settings& finest = curve.back();
    Experiment experiment = experiment_of(scene, finest);
    experiment.duration = 1.0;
    ExperimentRun run(scene, experiment, no_reference());
    while (run.advance()) {
    }
    const Errors& errors = run.result().metrics.errors;
    EXPECT_LT(*errors.linear_momentum_drift, 1e-12) << name;
    // Damping, full stiffness and fully implicit forces are dampers, and a damper against the world
    // slows rotation.
    const bool brakes = damps(finest) || finest.solver == SolverKind::kXpbd ||
                        (finest.solver == SolverKind::kNewton && finest.forces == Forces::kEnd);
    if (brakes) {
      EXPECT_GT(*errors.angular_momentum_drift, 0.01) << name;
    } else {
      EXPECT_LT(*errors.angular_momentum_drift,
                finest.mode == Mode::kConst && !sweeps(finest) ? 1e-4 : 0.07)
          << name;
    }
  }
}

TEST(EveryMethod, ContinuesFromASnapshot) {
  for (const Scene& scene : {scenes::swinging_box(), scenes::ragdoll_drop()}) {
    const auto shared = std::make_shared<const Scene>(scene);
    for (const auto& [name, curve] : methods_of(scene)) {
      const Settings& cheap = curve.front();
      Simulator whole = simulator_of(shared, cheap);
      for (int i = 0; i < 10; ++i) whole.step();
      Simulator rest = simulator_of(shared, cheap);
      rest.set_state(whole.state());
      for (int i = 0; i < 10; ++i) {
        whole.step();
        rest.step();
      }
      EXPECT_EQ(state_hash(whole.state()), state_hash(rest.state())) << scene.name << ": " << name;
    }
  }
}

}  // namespace
}  // namespace substep::test

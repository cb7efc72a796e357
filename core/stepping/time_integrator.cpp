#include "core/stepping/time_integrator.hpp"

#include "core/stepping/leapfrog.hpp"

namespace substep {

bool TimeIntegrator::breaks_motion(const Block& contact) const {
  return contact.impulse[0] > 0.0 && !contact.was_closed && !(contact.spring_ahead[0] > 0.0);
}

std::unique_ptr<TimeIntegrator> make_integrator(const Scene& scene, const JointStage* joints,
                                                const Settings& settings) {
  if (settings.solver == SolverKind::kNewton && settings.forces == Forces::kNumerov) {
    return make_numerov(scene, joints, settings.integrator);
  }
  if (follows_accelerations(settings)) return make_stormer(scene, joints);
  if (settings.integrator == Integrator::kEuler) return std::make_unique<Euler>(scene);
  return std::make_unique<Leapfrog>(scene);
}

}  // namespace substep

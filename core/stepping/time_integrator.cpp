#include "core/stepping/time_integrator.hpp"

#include "core/stepping/leapfrog.hpp"
#include "core/stepping/numerov_integrator.hpp"
#include "core/stepping/stormer.hpp"

namespace substep {

bool TimeIntegrator::breaks_motion(const Block& contact) const {
  return contact.impulse[0] > 0.0 && !contact.was_closed && !(contact.spring_ahead[0] > 0.0);
}

std::unique_ptr<TimeIntegrator> make_integrator(const Scene& scene, const JointStage* joints,
                                                const Settings& settings) {
  if (settings.solver == SolverKind::kNewton && settings.forces == Forces::kNumerov) {
    return std::make_unique<Numerov>(scene, joints, settings.integrator);
  }
  if (follows_accelerations(settings)) return std::make_unique<Stormer>(scene, joints);
  if (settings.integrator == Integrator::kEuler) return std::make_unique<Euler>(scene);
  return std::make_unique<Leapfrog>(scene);
}

}  // namespace substep

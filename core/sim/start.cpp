#include "core/sim/start.hpp"

#include <utility>

#include "core/model/validate.hpp"
#include "core/sim/conserved.hpp"
#include "core/sim/start_projection.hpp"

namespace substep {

Start start_of_run(const Scene& scene) {
  if (!is_runnable(scene)) return {};
  Start start{initial_state(scene), {}};
  StartReport& report = start.report;
  report.continued = scene.carried.has_value();
  report.found = report.left = start_errors(scene, start.state);
  report.energy_found = report.energy_begun = energies_of(scene, start.state).sum();
  if (report.found.consistent() || report.continued || scene.start != StartPolicy::kProject) {
    return start;
  }
  State state = start.state;
  const bool poses = report.found.beyond.poses();
  Projection projection = poses ? close_joints(scene, state) : Projection::kDone;
  if (projection == Projection::kDone) projection = match_velocities(scene, state);
  if (projection != Projection::kDone) {
    report.failed = true;
    report.too_large = projection == Projection::kTooLarge;
    return start;
  }
  start.state = std::move(state);
  report.projected = true;
  report.left = start_errors(scene, start.state);
  report.energy_begun = energies_of(scene, start.state).sum();
  return start;
}

std::shared_ptr<const Scene> with_start_of_run(std::shared_ptr<const Scene> scene) {
  if (!scene) return scene;
  const Start start = start_of_run(*scene);
  if (!start.report.projected) return scene;
  Scene begun = *scene;
  for (std::size_t i = 0; i < begun.bodies.size(); ++i) {
    Body& body = begun.bodies[i];
    if (body.is_static) continue;
    body.position = start.state.x[i];
    body.orientation = start.state.q[i];
    body.velocity = start.state.u[i].head<3>();
    body.angular_velocity = start.state.u[i].tail<3>();
  }
  if (!check_values(begun).empty()) return scene;  // velocities beyond the scene's limits
  return std::make_shared<const Scene>(std::move(begun));
}

}  // namespace substep

#include "core/io/saved_scene.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "core/model/format_text.hpp"
#include "core/model/scene_limits.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

// Appends `mark` and `when`, replacing those of an earlier save. Texts that would be too long are
// unchanged.
void append_date(std::string& text, const std::string& mark, const std::string& when,
                 std::size_t most) {
  std::string dated = text.substr(0, text.rfind(mark)) + mark + when;
  if (dated.size() <= most) text = std::move(dated);
}

}  // namespace

Scene saved_scene(const Scene& scene, const State& state, const Settings& settings) {
  if (!is_runnable(scene) || !fits(state, scene)) return {};
  Scene saved = scene;
  saved.settings = settings;
  saved.verdicts.clear();
  for (std::size_t i = 0; i < saved.bodies.size(); ++i) {
    Body& body = saved.bodies[i];
    if (body.is_static) continue;
    body.position = state.x[i];
    body.orientation = state.q[i];
    // Leapfrog keeps u at the middle of a sub-step; the carried state includes it.
    const bool at_the_middle = settings.integrator != Integrator::kEuler;
    const Vec6& u = at_the_middle ? state.u_synchronised[i] : state.u[i];
    body.velocity = u.head<3>();
    body.angular_velocity = u.tail<3>();
  }
  if (state.frame > 0) {
    saved.carried = state;
    const long long ms = std::llround(1e3 * state.time);
    append_date(saved.name, "_at_", std::to_string(ms) + "ms", kMaxNameSize);
    append_date(saved.title, ", from ", format_text("%.2f s", state.time), kMaxTitle);
  }
  return saved;
}

}  // namespace substep

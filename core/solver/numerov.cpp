#include "core/solver/numerov.hpp"

#include <algorithm>

#include "core/math/free_turn.hpp"

namespace substep {

namespace {

constexpr double kLeastAhead = -0.25;

double previous(double dt, double time) { return std::max(0.0, 2.0 * time - dt); }

/// Angular momentum of a body from I^-1 times it, and back. @param I principal moments
Vec3 times_inertia(const Mat3& R, const Vec3& I, const Vec3& w) {
  return R * I.cwiseProduct(R.transpose() * w);
}

/// Rotation of a body in dt, world axes [rad].
/// @param I principal moments, 0 where `w` itself is extrapolated  @param w mean of I^-1
/// times the momentum [rad/s]  @param start, end torque at both ends, or angular acceleration
/// @param bend dt^2 times its second derivative
Vec3 turn_in(const Vec3& I, const Mat3& R, const Vec3& w, const Vec3& start, const Vec3& end,
             const Vec3& bend, double dt) {
  const Vec3 middle = 0.5 * (start + end) - 0.125 * bend;
  if (I.isZero(0.0)) return dt * w + dt * dt * dt / 12.0 * middle.cross(w);  // Magnus' expansion
  const auto to_body = [&](const Vec3& v) -> Vec3 { return R.transpose() * v; };
  const Vec3 change = to_body(end - start);
  const Vec3 l = I.cwiseProduct(to_body(w)) - dt / 12.0 * change;
  return R * free_turn(I, l, to_body(middle), change, dt);
}

/// Angular velocity for which integrate() yields a given rotation.
Vec3 velocity_of_turn(const Vec3& turn, double dt) {
  return half_tangent_factor(0.5 * turn) / dt * turn;
}

}  // namespace

// The weights solve, with rho = dt-/dt and b = dt or dt-,
//   ahead dt - behind b = (dt - dt-)/3,   ahead dt^2 + behind b^2 = (dt^2 - dt dt- + dt-^2)/6.
PoseWeights numerov_weights(double dt, double dt_previous) {
  const double rho = dt_previous / dt;
  PoseWeights w;
  if (rho <= 1.0) {
    const double even = (1.0 - rho + rho * rho) / 12.0;
    w.ahead = even + (1.0 - rho) / 6.0;
    w.behind = even - (1.0 - rho) / 6.0;
    w.reach = dt;
  } else {
    w.ahead = std::max(kLeastAhead, (1.0 + rho - rho * rho) / (6.0 * (1.0 + rho)));
    w.behind = (w.ahead - (1.0 - rho) / 3.0) / rho;
    w.reach = dt_previous;
  }
  w.here = 1.0 - w.behind - w.ahead;
  return w;
}

void NumerovCourses::reserve(std::size_t bodies) {
  courses_.reserve(bodies);
  ahead_.reserve(bodies);
  behind_.reserve(bodies);
}

void NumerovCourses::begin(const System& system, std::span<const Vec6> u_star) {
  courses_.assign(system.u.size(), Course{});
  ahead_.resize(system.u.size());
  behind_.resize(system.u.size());
  for (std::size_t i = 0; i < courses_.size(); ++i) {
    const double time = system.force_time[i];
    if (time > 0.0) courses_[i].given = 1.0 / time * (u_star[i] - system.u_before[i]);
  }
}

PoseWeights NumerovCourses::weights_of(const System& system, const Block& block) const {
  const double time = longest_of(block, system.force_time);
  return numerov_weights(system.dt, previous(system.dt, time));
}

// A newly closed contact is an impact; its force is not extrapolated.
void NumerovCourses::add_forces(const System& system, const Block& here, const Block& behind,
                                const Block& ahead) {
  if (here.is_unilateral() && !here.was_closed) return;
  const double time = longest_of(here, system.force_time);
  if (time == 0.0) return;
  const PoseWeights w = weights_of(system, here);
  const double dt = system.dt;
  const bool knows_rates = !here.is_bounded() && here.seeded;
  double at_start[kMaxRows];
  double at_end[kMaxRows];
  double before[kMaxRows];
  for (int row = 0; row < here.rows; ++row) {
    const double rate = knows_rates ? here.rate[row] : 0.0;
    const double change = knows_rates ? here.rate_change[row] : 0.0;
    at_start[row] = here.impulse[row] / time - w.bent(dt) * change;
    at_end[row] = at_start[row] + dt * (rate + 0.5 * dt * change);
    before[row] = at_start[row] - w.reach * (rate - 0.5 * w.reach * change);
  }
  const auto of = [&](int body) { return body < 0 ? nullptr : &courses_[index(body)]; };
  Course* a = of(here.a);
  Course* b = of(here.b);
  push(here, at_start, a ? &a->here : nullptr, b ? &b->here : nullptr);
  push(ahead, at_end, a ? &a->ahead : nullptr, b ? &b->ahead : nullptr);
  push(behind, before, a ? &a->behind : nullptr, b ? &b->behind : nullptr);
}

BodyCourse NumerovCourses::course_of(const System& system, std::size_t i) const {
  const Course& course = courses_[i];
  const Vec3& I = system.inertia[i];
  const bool tumbles = !I.isZero(0.0);
  const InverseMass& W = system.inverse_mass[i];
  const auto rate = [&](const Vec6& force) {
    Vec6 a = course.given;
    a.head<3>() += W.linear * force.head<3>();
    if (tumbles) {
      a.tail<3>() = times_inertia(system.R_WB[i], I, a.tail<3>()) + force.tail<3>();
    } else {
      a.tail<3>() += W.angular * force.tail<3>();
    }
    return a;
  };
  BodyCourse of;
  of.start = rate(course.here);
  of.end = rate(course.ahead);
  const Vec6 before = rate(course.behind);
  const double dt = system.dt;
  const double reach = numerov_weights(dt, previous(dt, system.force_time[i])).reach;
  of.bend = 2.0 * dt / (dt + reach) * ((of.end - of.start) - dt / reach * (of.start - before));
  of.move_by = system.u[i];
  of.move_by.tail<3>() =
      velocity_of_turn(turn_in(I, system.R_WB[i], system.u[i].tail<3>(), of.start.tail<3>(),
                               of.end.tail<3>(), of.bend.tail<3>(), dt),
                       dt);
  return of;
}

// The mean over the time `reach` behind: that of the previous sub-step, plus half the acceleration
// times the difference in length.
void NumerovCourses::find_turns(const System& system) {
  for (std::size_t i = 0; i < courses_.size(); ++i) {
    const double time = system.force_time[i];
    if (!(time > 0.0)) continue;
    const BodyCourse of = course_of(system, i);
    system.courses[i] = of;
    ahead_[i] = motion(of.move_by, system.dt);
    const double dt_previous = previous(system.dt, time);
    const double reach = numerov_weights(system.dt, dt_previous).reach;
    const Vec6 a = 1.0 / time * (system.u[i] - system.u_before[i]);
    Vec6 back = system.u_before[i] + 0.5 * (dt_previous - reach) * a;
    const double scale = reach / system.dt;
    const Vec3 start = of.start.tail<3>();
    const Vec3 bend = scale * scale * of.bend.tail<3>();
    const Vec3 before = start - scale * (of.end - of.start).tail<3>() +
                        0.5 * (scale + 1.0) * scale * of.bend.tail<3>();
    back.tail<3>() = velocity_of_turn(
        turn_in(system.inertia[i], system.R_WB[i], back.tail<3>(), start, before, bend, -reach),
        -reach);
    behind_[i] = motion(back, -reach);
    courses_[i].clear_forces();
  }
}

}  // namespace substep

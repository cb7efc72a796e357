#include "core/io/motion_csv.hpp"

#include <limits>

#include "core/io/csv_text.hpp"
#include "core/model/joint_fields.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

void add(std::string& line, const Vec3& v) {
  for (int i = 0; i < 3; ++i) line += ',' + csv_number(v[i]);
}

std::string start_of_line(const State& state, const std::string& name) {
  return std::to_string(state.frame) + ',' + csv_number(state.time) + ',' + csv_field(name);
}

/// Distance by which the positions of a joint are apart [m].
double gap_of(const State& state, const Joint& joint) {
  const JointBase& j = base(joint);
  const Vec3 on_a = state.x[index(j.a)] + state.q[index(j.a)] * j.anchor_a;
  if (j.b == kWorld) return gap_of(joint, on_a - j.anchor_b, Quat::Identity()).norm();
  const Quat& q_b = state.q[index(j.b)];
  return gap_of(joint, on_a - (state.x[index(j.b)] + q_b * j.anchor_b), q_b).norm();
}

}  // namespace

std::string states_header() { return "frame,time,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n"; }

std::string states_lines(const Scene& scene, const State& state) {
  std::string lines;
  if (!is_runnable(scene) || !fits(state, scene)) return lines;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    lines += start_of_line(state, scene.bodies[i].name);
    add(lines, state.x[i]);
    lines += ',' + csv_number(state.q[i].w());
    add(lines, state.q[i].vec());
    add(lines, state.u_synchronised[i].head<3>());
    add(lines, state.u_synchronised[i].tail<3>());
    lines += '\n';
  }
  return lines;
}

std::string joints_header() { return "frame,time,joint,fx,fy,fz,tx,ty,tz,gap,force_time\n"; }

std::string joints_lines(const Scene& scene, const State& state, const ConstraintForces& forces) {
  const Vec3 unknown = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  std::string lines;
  if (!is_runnable(scene) || !fits(state, scene)) return lines;
  for (std::size_t i = 0; i < scene.joints.size(); ++i) {
    const JointBase& joint = base(scene.joints[i]);
    const bool known = i < forces.joints.size() && forces.joints[i].known;
    lines += start_of_line(state, joint.name);
    add(lines, known ? forces.joints[i].force : unknown);
    add(lines, known ? forces.joints[i].torque : unknown);
    lines += ',' + csv_number(gap_of(state, scene.joints[i]));
    lines += ',' + csv_number(known ? forces.joints[i].time : unknown[0]) + '\n';
  }
  return lines;
}

}  // namespace substep

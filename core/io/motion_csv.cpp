#include "core/io/motion_csv.hpp"

#include <limits>

#include "core/io/csv_text.hpp"
#include "core/model/validate.hpp"

namespace substep {
namespace {

void add(std::string& line, const Vec3& v) {
  for (int i = 0; i < 3; ++i) line += ',' + csv_number(v[i]);
}

std::string start_of_line(const State& state, const std::string& name) {
  return std::to_string(state.frame) + ',' + csv_number(state.time) + ',' + csv_field(name);
}

/// The anchor of one side, world [m].
Vec3 anchor(const State& state, int body, const Vec3& local) {
  return body == kWorld ? local : Vec3(state.x[index(body)] + state.q[index(body)] * local);
}

/// Distance of the anchors [m], without the travel of a slide.
double gap_of(const State& state, const Joint& joint) {
  const JointBase& sides = base(joint);
  Vec3 gap = anchor(state, sides.a, sides.anchor_a) - anchor(state, sides.b, sides.anchor_b);
  if (const auto* slide = std::get_if<PrismaticJoint>(&joint)) {
    const Vec3 axis =
        slide->b == kWorld ? slide->axis_b : Vec3(state.q[index(slide->b)] * slide->axis_b);
    gap -= axis * axis.dot(gap);
  }
  return gap.norm();
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

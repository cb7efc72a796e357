#pragma once
// A run as tables of bodies and joints, for comparison with other programs. Lossless numbers,
// metres, world axes. No lines for a scene and a state that is_runnable() or fits() refuses.

#include <string>

#include "core/model/scene.hpp"
#include "core/model/state.hpp"
#include "core/sim/constraint_forces.hpp"

namespace substep {

/// "frame,time,body,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz" and a line feed.
std::string states_header();

/// A line for each body of the scene, static ones included: centre of mass [m], q_WB, velocity
/// [m/s] and angular velocity [rad/s] at the time of the pose.
std::string states_lines(const Scene& scene, const State& state);

/// "frame,time,joint,fx,fy,fz,tx,ty,tz,gap,force_time" and a line feed.
std::string joints_header();

/// A line for each joint of the scene: the force on its body a [N], which acts at the anchor on a,
/// and the torque about that anchor [N m], both of the last sub-step; the distance by which its
/// positions are apart in the state, without the travel of a slide [m]; and the time to which the
/// force belongs [s]. "nan" if no sub-step has solved for the joint (both sides asleep).
std::string joints_lines(const Scene& scene, const State& state, const ConstraintForces& forces);

}  // namespace substep

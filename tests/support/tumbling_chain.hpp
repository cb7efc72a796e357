#pragma once

#include "scenes/generator/scenes.hpp"

namespace substep::test {

/// A freely tumbling chain: hinges and ball joints, no gravity.
inline Scene tumbling_chain() {
  scenes::RopeOptions options;
  options.n = 6;
  options.end_mass = 3.0;
  Scene scene = scenes::rope_of_n(options);
  scene.effects = {.gyroscopic = true, .joints = true};
  scene.joints.erase(scene.joints.begin());  // detach from the world
  scene.joints[2] = [&] {
    BallJoint ball;
    static_cast<JointBase&>(ball) = base(scene.joints[2]);
    return Joint(ball);
  }();
  std::erase_if(scene.bodies, [](const Body& body) { return body.is_static; });
  // One rigid motion to start with: v = V + W x (x - x_0), consistent with all joints.
  const Vec3 W{1.0, -2.0, 3.0};
  for (Body& body : scene.bodies) {
    body.angular_velocity = W;
    body.velocity = Vec3(0.5, 0.2, -0.1) + W.cross(body.position - scene.bodies[0].position);
  }
  scene.criteria = Criteria{};
  return scene;
}

}  // namespace substep::test

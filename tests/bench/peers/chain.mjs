// A chain that is not a scene file: six flat boxes on ball joints, suspended from the world and
// released in a shape that lies in no plane, so that all moments of inertia and the gyroscopic torque
// matter.

import { add, between, length, rotate } from "./rotation.mjs";

const kSize = [0.5, 0.2, 0.1]; // [m]
const kMass = 2; // [kg]
const kTop = [0, 4, 0]; // [m]
// Direction of each box, from the world outwards: a descending arc.
const kAlong = [
  [2, -1, 2],
  [6, -2, 3],
  [6, -3, 2],
  [2, -2, 1],
  [6, -2, -3],
  [2, -1, -2],
];

/** @return the content of a scene file */
export function chain() {
  const half = kSize[0] / 2;
  const bodies = [];
  const joints = [];
  let joint = kTop; // the next one [m]
  kAlong.forEach((along, i) => {
    const orientation = between([1, 0, 0], along.map((x) => x / length(along)));
    const arm = rotate(orientation, [half, 0, 0]);
    bodies.push({
      name: `box_${i}`,
      shape: { type: "box", size: kSize },
      mass: kMass,
      position: add(joint, arm),
      orientation,
    });
    joints.push({
      name: `joint_${i}`,
      type: "ball",
      a: `box_${i}`,
      b: i > 0 ? `box_${i - 1}` : "world",
      anchor_a: [-half, 0, 0],
      anchor_b: i > 0 ? [half, 0, 0] : kTop,
    });
    joint = add(joint, add(arm, arm));
  });
  return {
    format: "substep-scene",
    version: 1,
    name: "chain",
    title: "Chain",
    frame: 1 / 60,
    effects: ["gravity", "gyroscopic", "joints"],
    gravity: [0, -9.81, 0],
    criteria: { duration: 3, joint_gap: 0.1, track: `box_${kAlong.length - 1}` },
    bodies,
    joints,
  };
}

// A crane that is not a scene file, with a joint of every type: a bridge slides on rails, a trolley slides
// along the bridge, and from it hang an arm and a box that start sideways. The rails are level, so that
// only the load accelerates bridge and trolley.

import { add, between, rotate } from "./rotation.mjs";

const kHeight = 5; // of the rails [m]
const kRail = [0.8, 0, 0.6]; // direction of the lower rails
const kAlong = [-0.6, 0, 0.8]; // direction of the bridge
const kUp = [0, 1, 0];
const kSpeed = { bridge: kRail.map((x) => 0.4 * x), trolley: kAlong.map((x) => 0.2 * x) }; // [m/s]
const kArm = 1; // [m]
const kBox = [0.5, 0.3, 0.2]; // [m]

const body = (name, size, mass, position, orientation) => ({
  name,
  shape: { type: "box", size },
  mass,
  position,
  orientation,
  velocity: name === "bridge" ? kSpeed.bridge : add(kSpeed.bridge, kSpeed.trolley),
});

/** A joint that slides along the axis, given in both bodies, and keeps the vertical. */
const slider = (name, a, b, anchorB, axisA, axisB) => ({
  ...{ name, type: "prismatic", a, b, anchor_a: [0, 0, 0], anchor_b: anchorB },
  ...{ axis_a: axisA, axis_b: axisB, across_a: kUp, across_b: kUp },
});

/** @return the content of a scene file */
export function crane() {
  const turn = between([1, 0, 0], kRail);
  const at = [0, kHeight, 0];
  // The arm is along its y axis, turned by 50 degrees about its hinge, the direction of the rails.
  const half = (50 * Math.PI) / 360;
  const armTurn = [Math.cos(half), ...kRail.map((x) => Math.sin(half) * x)];
  const boxTurn = between([1, 0, 0], [0.8, -0.6, 0]);
  const down = rotate(armTurn, [0, -kArm, 0]);
  const end = add(at, down);
  const hook = [-kBox[0] / 2, 0, 0]; // of the box
  return {
    format: "substep-scene",
    version: 1,
    name: "crane",
    title: "Crane",
    frame: 1 / 60,
    effects: ["gravity", "gyroscopic", "joints"],
    gravity: [0, -9.81, 0],
    criteria: { duration: 3, joint_gap: 0.1, track: "box" },
    bodies: [
      body("bridge", [0.4, 0.2, 2], 10, at, turn),
      body("trolley", [0.4, 0.2, 0.4], 4, at, turn),
      body("arm", [0.1, kArm, 0.1], 1, add(at, down.map((x) => x / 2)), armTurn),
      body("box", kBox, 5, add(end, rotate(boxTurn, hook.map((x) => -x))), boxTurn),
    ],
    joints: [
      slider("rails", "bridge", "world", at, [1, 0, 0], kRail),
      slider("slide", "trolley", "bridge", [0, 0, 0], [0, 0, 1], [0, 0, 1]),
      {
        ...{ name: "hinge", type: "hinge", a: "arm", b: "trolley" },
        ...{ anchor_a: [0, kArm / 2, 0], anchor_b: [0, 0, 0], axis_a: kRail, axis_b: [1, 0, 0] },
      },
      {
        ...{ name: "hook", type: "ball", a: "box", b: "arm" },
        ...{ anchor_a: hook, anchor_b: [0, -kArm / 2, 0] },
      },
    ],
  };
}

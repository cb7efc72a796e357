// Reads a scene file of this project into plain numbers, from which every engine builds its world.

import { readFileSync } from "node:fs";
import { add, conjugate, cross, dot, rotate, subtract } from "./rotation.mjs";

/** Principal moments of inertia of the solid shape [kg m^2]. */
function solidInertia(mass, shape) {
  if (shape.type === "sphere") return Array(3).fill(0.4 * mass * shape.radius ** 2);
  if (shape.type === "box") {
    const [x, y, z] = shape.size.map((edge) => edge * edge);
    return [y + z, x + z, x + y].map((sum) => (mass * sum) / 12);
  }
  throw new Error(`no solid inertia of a ${shape.type}`);
}

function readBody(body) {
  return {
    name: body.name,
    fixed: body.static ?? false,
    shape: body.shape,
    mass: body.mass ?? 0, // [kg]
    inertia: body.static ? [0, 0, 0] : (body.inertia ?? solidInertia(body.mass, body.shape)),
    x: body.position, // [m]
    q: body.orientation ?? [1, 0, 0, 0], // w x y z, body to world
    v: body.velocity ?? [0, 0, 0], // [m/s]
    w: body.angular_velocity ?? [0, 0, 0], // in the world's axes [rad/s]
    friction: body.friction ?? 0,
    group: body.collision_group ?? null, // bodies of one group do not collide
  };
}

/**
 * @return bodies and joints by index, -1 for the world; anchors and axes in their bodies' frames.
 * Effects that a scene does not list are off: without "contact" nothing collides.
 */
export function readScene(path) {
  const file = JSON.parse(readFileSync(path, "utf8"));
  const index = new Map(file.bodies.map((body, i) => [body.name, i]));
  index.set("world", -1);
  return {
    path,
    name: file.name,
    frame: file.frame,
    gravity: file.gravity,
    collides: file.effects.includes("contact"),
    gyroscopic: file.effects.includes("gyroscopic"),
    criteria: file.criteria,
    settings: file.settings,
    bodies: file.bodies.map(readBody),
    joints: (file.joints ?? []).map((joint) => ({
      name: joint.name,
      type: joint.type, // ball, hinge or prismatic
      a: index.get(joint.a),
      b: index.get(joint.b),
      anchorA: joint.anchor_a,
      anchorB: joint.anchor_b,
      axisA: joint.axis_a,
      axisB: joint.axis_b,
      acrossA: joint.across_a,
      acrossB: joint.across_b,
    })),
  };
}

/** Why an engine cannot state a scene: its first joint of a type that is not in the list, or null. */
export function foreignJoint(scene, types) {
  const joint = scene.joints.find(({ type }) => !types.includes(type));
  return joint ? `no ${joint.type} joint (${joint.name})` : null;
}

/** Initial angular velocity of a link relative to its parent, in the link's axes [rad/s]. */
export function relativeTurn(scene, { body, parent }) {
  const { q, w } = scene.bodies[body];
  return rotate(conjugate(q), parent < 0 ? w : subtract(w, scene.bodies[parent].w));
}

/** Initial velocity of a link relative to its parent along a prismatic joint [m/s]. */
export function relativeSlide(scene, { body, parent, joint, flipped }) {
  const { x, q, v } = scene.bodies[body];
  const axis = rotate(q, flipped ? joint.axisB : joint.axisA);
  if (parent < 0) return dot(axis, v);
  const base = scene.bodies[parent];
  return dot(axis, subtract(v, add(base.v, cross(base.w, subtract(x, base.x)))));
}

/** For engines that filter pairs by bit and mask: one bit per group, bit 1 for bodies without group. */
export function collisionBits(body) {
  if (body.group === null) return { bit: 1, mask: 0x7fff };
  const bit = 2 << body.group;
  return { bit, mask: 0x7fff & ~bit };
}

/**
 * The joints as a tree rooted at the world, for formulations in reduced coordinates: for every moving
 * body the joint to its parent.
 * @return parents first: {body, parent, joint, flipped}; flipped if the joint's a is the parent, joint
 * null if the body is free. Joints that close loops are left out: loopJoints().
 */
export function jointTree(scene) {
  const placed = new Set([-1]);
  scene.bodies.forEach((body, i) => body.fixed && placed.add(i));
  const open = new Set(scene.joints);
  const tree = [];
  for (let grown = true; grown; ) {
    grown = false;
    for (const joint of open) {
      const a = placed.has(joint.a);
      const b = placed.has(joint.b);
      if (!a && !b) continue;
      open.delete(joint);
      grown = true;
      if (a && b) continue;
      tree.push({ body: a ? joint.b : joint.a, parent: a ? joint.a : joint.b, joint, flipped: a });
      placed.add(a ? joint.b : joint.a);
    }
  }
  scene.bodies.forEach((body, i) => {
    if (!placed.has(i)) tree.push({ body: i, parent: -1, joint: null, flipped: false });
  });
  return tree;
}

/** The joints that are not in the tree: each closes a loop. */
export function loopJoints(scene) {
  const inTree = new Set(jointTree(scene).map(({ joint }) => joint));
  return scene.joints.filter((joint) => !inTree.has(joint));
}

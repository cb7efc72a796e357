// MuJoCo: Newton's method on soft constraints, in reduced coordinates if the joints form a tree, or
// in maximal ones (free bodies and equality constraints).

import loadMujoco from "@mujoco/mujoco";
import {
  collisionBits,
  foreignJoint,
  jointTree,
  loopJoints,
  relativeSlide,
  relativeTurn,
} from "./scene.mjs";
import { add, between, conjugate, cross, dot, multiply, rotate, subtract } from "./rotation.mjs";

export const title = "MuJoCo";

const reduced = (integrator, ...counts) =>
  counts.map((substeps) => ({ substeps, coordinates: "reduced", integrator }));
/** @param timeconst time constant of the decay of an error [sub-steps]
 *  @param impedance share of a constraint that is enforced; the rest is soft */
const maximal = (integrator, timeconst, impedance, ...counts) =>
  counts.map((substeps) => ({
    substeps,
    coordinates: "maximal",
    integrator,
    timeconst,
    impedance,
  }));
/** A loop in reduced coordinates, closed by an equality. */
const closed = (...args) => maximal(...args).map((setting) => ({ ...setting, coordinates: "reduced" }));
/** First order and cheap; without damping they differ in maximal coordinates only. */
const kCheap = ["Euler", "implicitfast", "discrete"];

export const ladder = {
  swinging_box: [
    ...reduced("Euler", 6, 7, 8, 16),
    ...reduced("implicit", 4, 6),
    ...reduced("implicitfast", 4, 6, 7, 8, 16),
    ...reduced("discrete", 4, 6, 7, 8, 16),
    ...reduced("RK4", 3, 4, 5),
    ...kCheap.flatMap((integrator) => maximal(integrator, 2, 0.9999, 8)),
  ],
  bridge: kCheap.flatMap((integrator) => [
    ...maximal(integrator, 2, 0.99, 8, 12, 16),
    ...maximal(integrator, 4, 0.99, 6, 8, 12),
    ...maximal(integrator, 4, 0.999, 12, 16, 24),
  ]),
  stack: kCheap.flatMap((integrator) => [
    ...maximal(integrator, 2, 0.9999, 8, 12, 16, 32),
    ...maximal(integrator, 2, 0.99999, 8, 16),
    ...maximal(integrator, 4, 0.9999, 32),
  ]),
  crank_rocker: [
    ...kCheap.flatMap((integrator) => closed(integrator, 2, 0.9999, 8, 32)),
    ...kCheap.flatMap((integrator) => maximal(integrator, 2, 0.9999, 16, 32)),
    ...closed("RK4", 2, 0.9999, 4, 8, 16),
    ...closed("RK4", 6, 0.9999, 2, 4, 8, 16, 32),
    ...maximal("RK4", 2, 0.9999, 8, 16, 32),
  ],
  thrown_rope: [
    ...["Euler", "implicit", "RK4"].flatMap((integrator) => reduced(integrator, 8, 16, 32, 64)),
    ...reduced("RK4", 128),
    ...kCheap.flatMap((integrator) => maximal(integrator, 2, 0.9999, 8, 16, 32)),
    ...maximal("RK4", 2, 0.9999, 8, 16, 32, 64),
  ],
  in_space: [
    ...[...kCheap, "implicit", "RK4"].flatMap((integrator) => reduced(integrator, 2, 4, 8, 16, 32)),
    ...[...kCheap, "RK4"].flatMap((integrator) => maximal(integrator, 2, 0.9999, 4, 8, 16, 32)),
  ],
};

/** Its equality constraints join points or hold all six coordinates: none leaves a direction free. */
export const cannotState = (scene, { coordinates }) =>
  foreignJoint(scene, coordinates === "reduced" ? ["ball", "hinge", "prismatic"] : ["ball", "hinge"]);

const text = (numbers) => numbers.map((x) => x.toPrecision(17)).join(" ");

function geom(body, collides) {
  if (!collides) return "";
  const { bit, mask } = collisionBits(body);
  // The normal of a plane is z in MuJoCo and y in our scenes.
  const shape = {
    plane: () => `type="plane" size="0 0 1" quat="${text(between([0, 0, 1], [0, 1, 0]))}"`,
    box: () => `type="box" size="${text(body.shape.size.map((edge) => edge / 2))}"`,
    sphere: () => `type="sphere" size="${body.shape.radius}"`,
  }[body.shape.type]();
  const condim = body.friction > 0 ? 3 : 1;
  return `<geom ${shape} condim="${condim}" friction="${body.friction} 0 0"
    contype="${bit}" conaffinity="${mask}"/>`;
}

const inertial = (body) =>
  `<inertial pos="0 0 0" mass="${body.mass}" diaginertia="${text(body.inertia)}"/>`;

function fixedBody(body, i, collides) {
  return `<body name="b${i}" pos="${text(body.x)}" quat="${text(body.q)}">${geom(body, collides)}</body>`;
}

function freeBody(body, i, collides) {
  return `<body name="b${i}" pos="${text(body.x)}" quat="${text(body.q)}">
    <freejoint/>${inertial(body)}${geom(body, collides)}</body>`;
}

/** A body of the joint tree in the frame of its parent, with its subtree. */
function nestedBody(scene, tree, link) {
  const { body: i, parent, joint, flipped } = link;
  const body = scene.bodies[i];
  if (!joint) return freeBody(body, i, scene.collides);
  const origin = parent < 0 ? { x: [0, 0, 0], q: [1, 0, 0, 0] } : scene.bodies[parent];
  const back = conjugate(origin.q);
  const anchor = flipped ? joint.anchorB : joint.anchorA;
  const axis = flipped ? joint.axisB : joint.axisA;
  const kind = {
    ball: () => `type="ball"`,
    hinge: () => `type="hinge" axis="${text(axis)}"`,
    prismatic: () => `type="slide" axis="${text(axis)}"`,
  }[joint.type]();
  return `<body name="b${i}" pos="${text(rotate(back, subtract(body.x, origin.x)))}"
    quat="${text(multiply(back, body.q))}"><joint ${kind} pos="${text(anchor)}"/>
    ${inertial(body)}${geom(body, scene.collides)}
    ${tree.filter((child) => child.parent === i).map((child) => nestedBody(scene, tree, child)).join("\n")}
    </body>`;
}

function reducedWorld(scene) {
  const tree = jointTree(scene);
  const roots = tree.filter(({ parent }) => parent < 0 || scene.bodies[parent].fixed);
  return roots.map((link) => nestedBody(scene, tree, link)).join("\n");
}

/** Whether bodies in reduced coordinates can move in a plane only: all hinges are parallel. */
function planar(scene) {
  const axes = scene.joints.map(({ a, axisA }) => axisA && rotate(scene.bodies[a].q, axisA));
  return axes.every((axis) => axis && Math.abs(dot(axis, axes[0])) > 1 - 1e-12);
}

/** One point per ball joint, two points on the axis of a hinge. In reduced coordinates only joints that
 *  close loops; in a plane one point of each. */
function equalities(scene, isReduced) {
  const name = (i) => (i < 0 ? "world" : `b${i}`);
  const single = isReduced && planar(scene);
  const joints = isReduced ? loopJoints(scene) : scene.joints;
  return joints.flatMap(({ type, a, b, anchorA, axisA }) =>
    (type === "hinge" && !single ? [-0.5, 0.5] : [0]).map((along) => {
      const point = anchorA.map((x, i) => x + along * (axisA?.[i] ?? 0));
      return `<connect body1="${name(a)}" body2="${name(b)}" anchor="${text(point)}"/>`;
    }),
  );
}

function xml(scene, setting) {
  const dt = scene.frame / setting.substeps;
  const isReduced = setting.coordinates === "reduced";
  const moving = isReduced
    ? reducedWorld(scene)
    : scene.bodies.map((b, i) => (b.fixed ? "" : freeBody(b, i, scene.collides))).join("\n");
  const fixed = scene.bodies.map((b, i) => (b.fixed ? fixedBody(b, i, scene.collides) : "")).join("\n");
  const { timeconst = 2, impedance = 0.9999 } = setting;
  const soft = `solref="${timeconst * dt} 1" solimp="${impedance} ${impedance} 0.001"`;
  return `<mujoco>
    <compiler angle="radian" autolimits="false" boundmass="0" boundinertia="0"/>
    <option timestep="${dt}" gravity="${text(scene.gravity)}" integrator="${setting.integrator}"
      solver="Newton" cone="elliptic" iterations="100" tolerance="1e-10">
      <flag refsafe="disable"/></option>
    <default><geom ${soft}/><equality ${soft}/></default>
    <worldbody>${fixed}${moving}</worldbody>
    <equality>${equalities(scene, isReduced).join("\n")}</equality>
  </mujoco>`;
}

const freeVelocity = ({ q, v, w }) => [...v, ...rotate(conjugate(q), w)];

function freeStart(scene) {
  const moving = [...scene.bodies.keys()].filter((i) => !scene.bodies[i].fixed);
  return moving.map((body) => ({ body, qvel: freeVelocity(scene.bodies[body]) }));
}

function reducedStart(scene) {
  return jointTree(scene).map((link) => {
    const { body, joint, flipped } = link;
    if (!joint) return { body, qvel: freeVelocity(scene.bodies[body]) };
    if (joint.type === "prismatic") return { body, qvel: [relativeSlide(scene, link)] };
    const turn = relativeTurn(scene, link);
    if (joint.type === "ball") return { body, qvel: turn };
    return { body, qvel: [dot(turn, flipped ? joint.axisB : joint.axisA)] };
  });
}

let mujoco;

export async function build(scene, setting) {
  mujoco ??= await loadMujoco();
  const model = mujoco.MjModel.from_xml_string(xml(scene, setting));
  const data = new mujoco.MjData(model);
  const id = scene.bodies.map((_, i) =>
    mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY.value, `b${i}`),
  );
  const start = setting.coordinates === "reduced" ? reducedStart(scene) : freeStart(scene);
  for (const { body, qvel } of start) data.qvel.set(qvel, model.body_dofadr[id[body]]);
  const root = id.map((b) => model.body_rootid[b]);
  return {
    steps: setting.substeps,
    step: () => mujoco.mj_step(model, data),
    /** xpos is that of the start of the last step until the kinematics are recomputed. */
    poses() {
      mujoco.mj_kinematics(model, data);
      const { xpos, xquat } = data;
      return id.flatMap((b) => [
        ...xpos.subarray(3 * b, 3 * b + 3),
        ...xquat.subarray(4 * b, 4 * b + 4),
      ]);
    },
    /** RK4 has velocities at the time of the poses, the others at the middle of the last step. */
    lag: setting.integrator === "RK4" || setting.coordinates === "reduced" ? 0 : 0.5,
    /** cvel holds the velocity of the point of a body that is at the centre of mass of its tree. */
    velocities() {
      mujoco.mj_kinematics(model, data);
      mujoco.mj_comPos(model, data);
      mujoco.mj_comVel(model, data);
      const { cvel, xipos, subtree_com: centre } = data;
      const at = (values, i) => [...values.subarray(3 * i, 3 * i + 3)];
      return id.flatMap((b, i) => {
        const [w, v] = [at(cvel, 2 * b), at(cvel, 2 * b + 1)];
        return [...add(v, cross(w, subtract(at(xipos, b), at(centre, root[i])))), ...w];
      });
    },
    free() {
      data.delete();
      model.delete();
    },
  };
}

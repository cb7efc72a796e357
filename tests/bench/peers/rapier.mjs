// Rapier: sub-stepped Gauss-Seidel on soft constraints (`iterations` is the number of its sub-steps,
// each of `inner` sweeps); joints as impulses or as multibodies (reduced coordinates).

import RAPIER from "@dimforge/rapier3d-compat";
import { conjugate, frameOf, multiply, rotate } from "./rotation.mjs";
import { collisionBits, foreignJoint, jointTree, loopJoints } from "./scene.mjs";

export const title = "Rapier";

const impulse = (steps, iterations, inner, contactHz = 30) => ({
  steps,
  iterations,
  inner,
  contactHz,
  joints: "impulse",
});
const multibody = (steps, iterations) => ({ steps, iterations, inner: 1, joints: "multibody" });

export const ladder = {
  swinging_box: [
    ...[8, 16].map((iterations) => impulse(1, iterations, 4)),
    ...[16, 32].map((iterations) => impulse(1, iterations, 8)),
    ...[4, 8].map((steps) => impulse(steps, 8, 8)),
    ...[8, 32].map((steps) => multibody(steps, 1)),
  ],
  bridge: [
    ...[16, 32].map((iterations) => impulse(1, iterations, 8, 1000)),
    ...[4, 8, 16].map((steps) => impulse(steps, 4, 8, 1000)),
    ...[4, 8, 16, 32].map((steps) => impulse(steps, 8, 1, 1000)),
  ],
  in_space: [
    ...[8, 32].map((iterations) => impulse(1, iterations, 8)),
    ...[2, 4, 8, 16, 32].map((steps) => impulse(steps, 4, 8)),
  ],
  energy: [
    ...[8, 32].map((iterations) => impulse(1, iterations, 8)),
    ...[4, 8, 16, 32].map((steps) => impulse(steps, 4, 8)),
  ],
  stack: [impulse(1, 32, 8, 1000), impulse(8, 8, 8, 1000), impulse(16, 100, 8, 1000)],
};

/** The orientation of a relative to b, or to the world, that a prismatic joint holds. */
const heldTurn = ({ axisA, acrossA, axisB, acrossB }) =>
  multiply(frameOf(axisB, acrossB), conjugate(frameOf(axisA, acrossA)));

/** Its prismatic joint has one axis and no direction across: both bodies have the same frame. */
export function cannotState(scene, { joints }) {
  const types = joints === "impulse" ? ["ball", "hinge", "prismatic"] : ["ball", "hinge"];
  const foreign = foreignJoint(scene, types);
  if (foreign) return foreign;
  const [loop] = joints === "impulse" ? [] : loopJoints(scene);
  if (loop) return `no loop of multibodies (${loop.name})`;
  const turned = scene.joints.find(
    (joint) => joint.type === "prismatic" && joint.b >= 0 && Math.abs(heldTurn(joint)[0]) < 1 - 1e-12,
  );
  return turned ? `no prismatic joint between bodies turned against each other (${turned.name})` : null;
}

const vector = ([x, y, z]) => ({ x, y, z });
const quaternion = ([w, x, y, z]) => ({ w, x, y, z });
const kOrigin = vector([0, 0, 0]);
const kNoTurn = quaternion([1, 0, 0, 0]);

function shape(body) {
  if (body.shape.type === "sphere") return RAPIER.ColliderDesc.ball(body.shape.radius);
  if (body.shape.type === "box") {
    return RAPIER.ColliderDesc.cuboid(...body.shape.size.map((edge) => edge / 2));
  }
  return new RAPIER.ColliderDesc(new RAPIER.HalfSpace(vector([0, 1, 0])));
}

function addCollider(world, body, rigid) {
  const { bit, mask } = collisionBits(body);
  world.createCollider(
    shape(body).setDensity(0).setFriction(body.friction).setCollisionGroups((bit << 16) | mask),
    rigid,
  );
}

function addBody(world, body) {
  const desc = body.fixed
    ? RAPIER.RigidBodyDesc.fixed()
    : RAPIER.RigidBodyDesc.dynamic()
        .setAdditionalMassProperties(body.mass, kOrigin, vector(body.inertia), kNoTurn)
        .setLinvel(...body.v)
        .setAngvel(vector(body.w));
  desc.setTranslation(...body.x).setRotation(quaternion(body.q)).setCanSleep(false);
  return world.createRigidBody(desc);
}

/** From b to a, or from a to b if flipped. */
function jointData(joint, flipped) {
  const anchors = [joint.anchorB, joint.anchorA].map(vector);
  if (flipped) anchors.reverse();
  if (joint.type === "ball") return RAPIER.JointData.spherical(...anchors);
  if (joint.type === "prismatic") return RAPIER.JointData.prismatic(...anchors, vector(joint.axisA));
  const axes = [joint.axisB, joint.axisA].map(vector);
  if (flipped) axes.reverse();
  return RAPIER.JointData.revoluteWithAxes(...anchors, ...axes);
}

/**
 * Multibodies start with zero joint angles, i.e. equal orientations of both bodies: a body on a joint
 * to the world is joined to a fixed body at its own pose instead.
 */
function addTree(world, scene, rigid) {
  for (const { body, parent, joint, flipped } of jointTree(scene)) {
    if (!joint) continue;
    if (parent >= 0) {
      world.createMultibodyJoint(jointData(joint, flipped), rigid[parent], rigid[body], true);
      continue;
    }
    const ground = addBody(world, { ...scene.bodies[body], fixed: true });
    const anchor = flipped ? joint.anchorB : joint.anchorA;
    const axis = flipped ? joint.axisB : joint.axisA;
    const own = { ...joint, anchorA: anchor, anchorB: anchor, axisA: axis, axisB: axis };
    world.createMultibodyJoint(jointData(own, false), ground, rigid[body], true);
  }
}

/** A fixed body with the orientation that a prismatic joint to the world holds, and the joint to it. */
function turnedGround(world, joint) {
  const turn = heldTurn(joint);
  const ground = RAPIER.RigidBodyDesc.fixed().setRotation(quaternion(turn));
  return [world.createRigidBody(ground), { ...joint, anchorB: rotate(conjugate(turn), joint.anchorB) }];
}

function addJoints(world, scene, rigid) {
  const level = world.createRigidBody(RAPIER.RigidBodyDesc.fixed());
  for (const joint of scene.joints) {
    const turns = joint.type === "prismatic" && joint.b < 0;
    const [ground, own] = turns ? turnedGround(world, joint) : [level, joint];
    const b = joint.b < 0 ? ground : rigid[joint.b];
    world
      .createImpulseJoint(jointData(own, false), b, rigid[joint.a], true)
      .setContactsEnabled(scene.collides);
  }
}

export async function build(scene, setting) {
  await RAPIER.init();
  const world = new RAPIER.World(vector(scene.gravity));
  world.timestep = scene.frame / setting.steps;
  const parameters = world.integrationParameters;
  parameters.numSolverIterations = setting.iterations;
  parameters.numInternalPgsIterations = setting.inner;
  parameters.normalizedAllowedLinearError = 1e-6; // [m]
  if (setting.contactHz) parameters.contact_natural_frequency = setting.contactHz;
  const rigid = scene.bodies.map((body) => addBody(world, body));
  if (scene.collides) scene.bodies.forEach((body, i) => addCollider(world, body, rigid[i]));
  (setting.joints === "impulse" ? addJoints : addTree)(world, scene, rigid);
  return {
    steps: setting.steps,
    step: () => world.step(),
    poses() {
      return rigid.flatMap((body) => {
        const x = body.translation();
        const q = body.rotation();
        return [x.x, x.y, x.z, q.w, q.x, q.y, q.z];
      });
    },
    /** The velocity of the middle of the last of the inner sub-steps. */
    lag: 0.5 / setting.iterations,
    velocities() {
      return rigid.flatMap((body) => {
        const v = body.linvel();
        const w = body.angvel();
        return [v.x, v.y, v.z, w.x, w.y, w.z];
      });
    },
    free: () => world.free(),
  };
}

// PhysX: articulations (Featherstone's algorithm, reduced coordinates) if the joints form a tree, or
// joints between free bodies with its two Gauss-Seidel solvers, PGS and TGS; single precision.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import loadPhysX from "physx-js-webidl";
import {
  collisionBits,
  foreignJoint,
  jointTree,
  loopJoints,
  relativeSlide,
  relativeTurn,
} from "./scene.mjs";
import { add, between, conjugate, frameOf, multiply, rotate, subtract } from "./rotation.mjs";

export const title = "PhysX";

const articulation = (...counts) =>
  counts.map((steps) => ({ steps, joints: "articulation", solver: "TGS", iterations: 1 }));
const maximal = (solver, iterations, ...counts) =>
  counts.map((steps) => ({ steps, joints: "maximal", solver, iterations }));

export const ladder = {
  swinging_box: [...articulation(6, 7, 8, 16), ...maximal("TGS", 32, 4, 8)],
  bridge: [...maximal("TGS", 32, 4, 8, 16), ...maximal("TGS", 8, 8, 16, 32), ...maximal("PGS", 32, 16)],
  in_space: [...articulation(2, 4, 8, 16, 32), ...maximal("TGS", 32, 4, 8, 16)],
  energy: [
    ...articulation(4, 8, 16, 32),
    ...maximal("TGS", 32, 4, 8, 16, 32, 64),
    ...maximal("TGS", 8, 8, 16, 32),
    ...maximal("PGS", 32, 8, 32),
  ],
  stack: [...maximal("TGS", 32, 4, 16), ...maximal("PGS", 32, 16), ...maximal("TGS", 250, 8)],
};

export const cannotState = (scene) => foreignJoint(scene, ["ball", "hinge", "prismatic"]);

let PhysX;
let physics;
let dispatcher;
let tolerances;

/** The package is built for pages and rejects Node.js: process is hidden while it loads. */
async function loadAsInPage() {
  const path = createRequire(import.meta.url).resolve("physx-js-webidl/physx-js-webidl.wasm");
  const wasmBinary = readFileSync(path);
  const { process } = globalThis;
  globalThis.window = globalThis;
  globalThis.process = undefined;
  try {
    return await loadPhysX({ wasmBinary });
  } finally {
    globalThis.process = process;
  }
}

async function start() {
  if (PhysX) return;
  PhysX = await loadAsInPage();
  const top = PhysX.PxTopLevelFunctions.prototype;
  const errors = new PhysX.PxDefaultErrorCallback();
  const foundation = top.CreateFoundation(top.PHYSICS_VERSION, new PhysX.PxDefaultAllocator(), errors);
  tolerances = new PhysX.PxTolerancesScale();
  physics = top.CreatePhysics(top.PHYSICS_VERSION, foundation, tolerances);
  top.InitExtensions(physics);
  dispatcher = top.DefaultCpuDispatcherCreate(0); // no threads: runs in the caller's
}

const vector = (v) => new PhysX.PxVec3(...v);
const transform = (x, [w, qx, qy, qz]) =>
  new PhysX.PxTransform(vector(x), new PhysX.PxQuat(qx, qy, qz, w));
const kNoTurn = [1, 0, 0, 0];
// PxRigidBodyFlag::eENABLE_GYROSCOPIC_FORCES, which the package does not export.
const kGyroscopic = 1 << 10;

/** PhysX joints rotate about x or slide along it, prismatic ones with y across. @return the rotation
 *  from x, and y, to the axis of a joint and the direction across, if it has them */
function axisFrame(axis, across) {
  if (!axis) return kNoTurn;
  return across ? frameOf(axis, across) : between([1, 0, 0], axis);
}

function geometry({ shape }) {
  if (shape.type === "sphere") return new PhysX.PxSphereGeometry(shape.radius);
  if (shape.type === "box") return new PhysX.PxBoxGeometry(...shape.size.map((edge) => edge / 2));
  return new PhysX.PxPlaneGeometry(); // its normal is x
}

function attachShape(actor, body) {
  const material = physics.createMaterial(body.friction, body.friction, 0);
  const flags = new PhysX.PxShapeFlags(PhysX.PxShapeFlagEnum.eSIMULATION_SHAPE);
  const shape = physics.createShape(geometry(body), material, true, flags);
  const { bit, mask } = collisionBits(body);
  shape.setSimulationFilterData(new PhysX.PxFilterData(bit, mask, 0, 0));
  shape.setContactOffset(0.02); // [m]
  shape.setRestOffset(0);
  if (body.shape.type === "plane") {
    shape.setLocalPose(transform([0, 0, 0], between([1, 0, 0], [0, 1, 0])));
  }
  actor.attachShape(shape);
}

function setMass(rigid, body, gyroscopic) {
  rigid.setMass(body.mass);
  rigid.setMassSpaceInertiaTensor(vector(body.inertia));
  rigid.setLinearDamping(0);
  rigid.setAngularDamping(0);
  rigid.setMaxAngularVelocity(1e4);
  rigid.setMaxDepenetrationVelocity(1e3);
  rigid.setRigidBodyFlag(kGyroscopic, gyroscopic);
}

/** A body outside of articulations. */
function addBody(scene, body, setting, world) {
  const pose = transform(body.x, body.q);
  const rigid = body.fixed ? physics.createRigidStatic(pose) : physics.createRigidDynamic(pose);
  if (world.collides) attachShape(rigid, body);
  if (!body.fixed) {
    setMass(rigid, body, world.gyroscopic);
    rigid.setLinearVelocity(vector(body.v));
    rigid.setAngularVelocity(vector(body.w));
    rigid.setSleepThreshold(0);
    rigid.setStabilizationThreshold(0);
    rigid.setSolverIterationCounts(setting.iterations, 1);
  }
  scene.addActor(rigid);
  return rigid;
}

function addJoints(joints, rigid) {
  const top = PhysX.PxTopLevelFunctions.prototype;
  for (const joint of joints) {
    const at = (i) => (i < 0 ? null : rigid[i]);
    const create = {
      ball: top.SphericalJointCreate,
      hinge: top.RevoluteJointCreate,
      prismatic: top.PrismaticJointCreate,
    }[joint.type];
    create.call(
      top,
      physics,
      at(joint.a),
      transform(joint.anchorA, axisFrame(joint.axisA, joint.acrossA)),
      at(joint.b),
      transform(joint.anchorB, axisFrame(joint.axisB, joint.acrossB)),
    );
  }
}

const kOrigin = { x: [0, 0, 0], q: kNoTurn };

/** @param parent, child {x, q}: their poses at the start */
function tuneJoint(inbound, joint, flipped, parent, child) {
  const { PxArticulationAxisEnum: axes, PxArticulationMotionEnum: motion } = PhysX;
  const back = conjugate(parent.q);
  const [own, childAnchor] = flipped
    ? [joint.anchorA, joint.anchorB]
    : [joint.anchorB, joint.anchorA];
  // Joint coordinates are zero at the start: both frames have the same orientation in the world, and
  // those of a prismatic joint the same place.
  const place = add(child.x, rotate(child.q, childAnchor));
  const parentAnchor = joint.type === "prismatic" ? rotate(back, subtract(place, parent.x)) : own;
  const childFrame = axisFrame(flipped ? joint.axisB : joint.axisA);
  const parentFrame = multiply(multiply(back, child.q), childFrame);
  inbound.setParentPose(transform(parentAnchor, parentFrame));
  inbound.setChildPose(transform(childAnchor, childFrame));
  const types = PhysX.PxArticulationJointTypeEnum;
  const [type, ...free] = {
    ball: [types.eSPHERICAL, axes.eTWIST, axes.eSWING1, axes.eSWING2],
    hinge: [types.eREVOLUTE, axes.eTWIST],
    prismatic: [types.ePRISMATIC, axes.eX],
  }[joint.type];
  inbound.setJointType(type);
  for (const axis of free) inbound.setMotion(axis, motion.eFREE);
  inbound.setFrictionCoefficient(0);
  inbound.setMaxJointVelocity(1e4);
}

/** Sets the initial velocity of a joint from that of its body. */
function startJoint(inbound, world, link) {
  const { joint, flipped } = link;
  const { PxArticulationAxisEnum: axes } = PhysX;
  if (joint.type === "prismatic") {
    inbound.setJointVelocity(axes.eX, relativeSlide(world, link));
    return;
  }
  const frame = axisFrame(flipped ? joint.axisB : joint.axisA);
  const [x, y, z] = rotate(conjugate(frame), relativeTurn(world, link));
  inbound.setJointVelocity(axes.eTWIST, x);
  if (joint.type === "hinge") return;
  inbound.setJointVelocity(axes.eSWING1, y);
  inbound.setJointVelocity(axes.eSWING2, z);
}

/** All jointed bodies as one tree on a fixed base at the origin. */
function addArticulation(scene, world, setting) {
  const articulation = physics.createArticulationReducedCoordinate();
  articulation.setArticulationFlag(PhysX.PxArticulationFlagEnum.eFIX_BASE, true);
  articulation.setSolverIterationCounts(setting.iterations, 1);
  articulation.setSleepThreshold(0);
  const base = articulation.createLink(null, transform([0, 0, 0], kNoTurn));
  base.setMass(1);
  base.setMassSpaceInertiaTensor(vector([1, 1, 1]));
  const links = [];
  const tree = jointTree(world);
  for (const { body, parent, joint, flipped } of tree) {
    if (!joint) throw new Error("a free body beside an articulation is not supported");
    const { x, q } = world.bodies[body];
    links[body] = articulation.createLink(parent < 0 ? base : links[parent], transform(x, q));
    setMass(links[body], world.bodies[body], world.gyroscopic);
    const from = parent < 0 ? kOrigin : world.bodies[parent];
    tuneJoint(links[body].getInboundJoint(), joint, flipped, from, { x, q });
  }
  scene.addArticulation(articulation);
  for (const link of tree) startJoint(links[link.body].getInboundJoint(), world, link);
  return links;
}

function createScene(world, setting) {
  const desc = new PhysX.PxSceneDesc(tolerances);
  desc.gravity = vector(world.gravity);
  desc.cpuDispatcher = dispatcher;
  desc.filterShader = PhysX.PxTopLevelFunctions.prototype.DefaultFilterShader();
  const { eTGS, ePGS } = PhysX.PxSolverTypeEnum;
  desc.solverType = setting.solver === "TGS" ? eTGS : ePGS;
  return physics.createScene(desc);
}

/** The velocity is that of the middle of the last step of PGS, or of the last iteration of TGS. */
function lagOf({ joints, solver, iterations }) {
  if (joints === "articulation") return 0;
  return solver === "TGS" ? 0.5 / iterations : 0.5;
}

export async function build(world, setting) {
  await start();
  const scene = createScene(world, setting);
  const links = setting.joints === "articulation" ? addArticulation(scene, world, setting) : [];
  const rigid = world.bodies.map((body, i) => links[i] ?? addBody(scene, body, setting, world));
  addJoints(setting.joints === "maximal" ? world.joints : loopJoints(world), rigid);
  const dt = world.frame / setting.steps;
  return {
    steps: setting.steps,
    step() {
      scene.simulate(dt);
      scene.fetchResults(true);
    },
    poses() {
      return rigid.flatMap((body) => {
        const { p, q } = body.getGlobalPose();
        return [p.x, p.y, p.z, q.w, q.x, q.y, q.z];
      });
    },
    lag: lagOf(setting),
    velocities() {
      return rigid.flatMap((body, i) => {
        if (world.bodies[i].fixed) return Array(6).fill(0);
        const v = body.getLinearVelocity();
        const values = [v.x, v.y, v.z];
        const w = body.getAngularVelocity();
        return [...values, w.x, w.y, w.z];
      });
    },
    free: () => scene.release(),
  };
}

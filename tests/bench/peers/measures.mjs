// Errors and verdicts of a run, from its poses and, for energies, its velocities: the same for every
// engine.

import { add, conjugate, dot, length, rotate, subtract } from "./rotation.mjs";

const kNumbers = 7; // per pose: x y z, w x y z
const kRates = 6; // per body: its velocity, its angular velocity in the world's axes

/**
 * @param text lines of "milliseconds pose pose ... rates rates ..."
 * @param bodies their number
 * @return {ms, poses, rates} of every frame
 */
export function readFrames(text, bodies) {
  return text
    .trim()
    .split("\n")
    .map((line) => {
      const [ms, ...values] = line.split(" ").map(Number);
      const end = kNumbers * bodies;
      return { ms, poses: values.slice(0, end), rates: values.slice(end) };
    });
}

export function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const half = sorted.length >> 1;
  return sorted.length % 2 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
}

/** Energies of the moving bodies [J]. */
function energies(scene, { poses, rates }) {
  const sum = { kinetic: 0, potential: 0 };
  scene.bodies.forEach(({ fixed, mass, inertia }, i) => {
    if (fixed) return;
    const [v, w] = [0, 3].map((start) => rates.slice(kRates * i + start, kRates * i + start + 3));
    const local = rotate(conjugate(orientation(poses, i)), w);
    sum.kinetic += (mass * dot(v, v) + dot(local, local.map((x, k) => inertia[k] * x))) / 2;
    sum.potential -= mass * dot(scene.gravity, position(poses, i));
  });
  return sum;
}

/** The largest kinetic energy at the end of a frame [J]. */
export const largestKinetic = (scene, frames) =>
  frames.reduce((most, frame) => Math.max(most, energies(scene, frame).kinetic), 0);

const position = (poses, body) => poses.slice(kNumbers * body, kNumbers * body + 3);
const orientation = (poses, body) => poses.slice(kNumbers * body + 3, kNumbers * (body + 1));

function placed(poses, body, point) {
  if (body < 0) return point;
  return add(position(poses, body), rotate(orientation(poses, body), point));
}

const turned = (poses, body, v) => (body < 0 ? v : rotate(orientation(poses, body), v));

/** Largest distance between the two anchors of a joint; of a prismatic one, across its axis [m]. */
function jointGap(scene, poses) {
  const gaps = scene.joints.map(({ type, a, b, anchorA, anchorB, axisB }) => {
    const gap = subtract(placed(poses, a, anchorA), placed(poses, b, anchorB));
    if (type !== "prismatic") return length(gap);
    const axis = turned(poses, b, axisB);
    const along = dot(axis, gap);
    return length(subtract(gap, axis.map((x) => along * x)));
  });
  return Math.max(0, ...gaps);
}

/** Penetration of a sphere into a plane or a box; also with its centre inside the box [m]. */
function depth(sphere, centre, other, poses, i) {
  const local = rotate(conjugate(orientation(poses, i)), subtract(centre, position(poses, i)));
  if (other.shape.type === "plane") return sphere.shape.radius - local[1];
  const half = other.shape.size.map((edge) => edge / 2);
  const outside = local.map((x, k) => Math.max(0, Math.abs(x) - half[k]));
  const distance = length(outside);
  if (distance > 0) return sphere.shape.radius - distance;
  return sphere.shape.radius + Math.min(...local.map((x, k) => half[k] - Math.abs(x)));
}

/** Deepest overlap of a sphere with a plane or a box [m]. */
function penetration(scene, poses) {
  let deepest = 0;
  scene.bodies.forEach((sphere, s) => {
    if (sphere.shape.type !== "sphere") return;
    const centre = position(poses, s);
    scene.bodies.forEach((other, o) => {
      if (other.shape.type !== "sphere") {
        deepest = Math.max(deepest, depth(sphere, centre, other, poses, o));
      }
    });
  });
  return deepest;
}

const largest = (frames, measure) => frames.reduce((most, f) => Math.max(most, measure(f.poses)), 0);
const indexOf = (scene, name) => scene.bodies.findIndex((body) => body.name === name);

/** How a scene failed by its own criteria, as one word; null if it did not. */
export function broken(scene, poses) {
  const { joint_gap, displacement } = scene.criteria;
  if (!poses.every((x) => Math.abs(x) < 1e6)) return "explodes";
  if (jointGap(scene, poses) > joint_gap) return "torn";
  if (!displacement) return null;
  const i = indexOf(scene, displacement.body);
  const moved = length(subtract(position(poses, i), scene.bodies[i].x));
  return moved > displacement.distance ? "falls" : null;
}

const seconds = (scene, frame) => `${((frame + 1) * scene.frame).toFixed(2)} s`;

function whyBroken(scene, frames) {
  for (let i = 0; i < frames.length; ++i) {
    const how = broken(scene, frames[i].poses);
    if (how) return `${how} at ${seconds(scene, i)}`;
  }
  return null;
}

/**
 * Distance of the tracked body from the exact motion.
 * @param exact its positions after every frame [m]
 * @param most a larger distance is a failure: in reduced coordinates no joint can open [m]
 * @param error reduces the distances after all frames to the error
 */
function off(scene, frames, exact, most, error) {
  const body = indexOf(scene, scene.criteria.track);
  const distances = frames.map(({ poses }, i) => length(subtract(position(poses, body), exact[i])));
  const lost = distances.findIndex((distance) => distance > most);
  return {
    failure: lost < 0 ? null : `another motion at ${seconds(scene, lost)}`,
    error: error(distances),
    other: largest(frames, (poses) => jointGap(scene, poses)),
    costFrames: frames,
  };
}

/** Error: the distance of the heavy box from the exact motion at 3 s. */
function swingingBox(scene, frames, exact) {
  const kTime = 3.0; // [s]
  return off(scene, frames, exact, 0.5, (distances) => distances[Math.round(kTime / scene.frame) - 1]);
}

/** Error: the largest distance of the last body from the exact motion. */
function inSpace(scene, frames, exact) {
  return off(scene, frames, exact, 0.25, (distances) => Math.max(...distances));
}

/** The ball crosses; error: the largest joint gap. */
function bridge(scene, frames) {
  const kFarEnd = 4.9; // [m]
  const ball = indexOf(scene, scene.criteria.track);
  const left = frames.findIndex(({ poses }) => position(poses, ball)[0] > kFarEnd);
  // Below the end of the bridge the ball has fallen through it.
  const crosses = left >= 0 && position(frames[left].poses, ball)[1] > 4;
  const crossing = crosses ? frames.slice(0, left) : frames;
  return {
    failure: crosses ? null : "the ball does not cross",
    error: largest(frames, (poses) => jointGap(scene, poses)),
    other: largest(crossing, (poses) => penetration(scene, poses)),
    costFrames: crossing, // afterwards the bridge is empty
  };
}

/** Error: the deepest overlap. */
function stack(scene, frames) {
  const i = indexOf(scene, scene.criteria.displacement.body);
  const moved = (poses) => length(subtract(position(poses, i), scene.bodies[i].x));
  return {
    failure: null,
    error: largest(frames, (poses) => penetration(scene, poses)),
    other: largest(frames, moved),
    costFrames: frames,
  };
}

/** Error: the largest change of the energy, which is constant, as a share of the largest kinetic one. */
function energy(scene, frames, { path, kinetic }) {
  const start = { poses: scene.bodies.flatMap(({ x, q }) => [...x, ...q]) };
  start.rates = scene.bodies.flatMap(({ v, w }) => [...v, ...w]);
  const total = (frame) => Object.values(energies(scene, frame)).reduce((sum, x) => sum + x);
  const changes = frames.map((frame) => (total(frame) - total(start)) / kinetic);
  const lost = changes.findIndex((change) => !(Math.abs(change) < 1));
  const how = changes[lost] > 0 ? "gains" : "loses";
  const body = indexOf(scene, scene.criteria.track);
  const distances = path.map((x, i) => length(subtract(position(frames[i].poses, body), x)));
  return {
    failure: lost < 0 ? null : `${how} as much energy as there is at ${seconds(scene, lost)}`,
    error: Math.max(...changes.map(Math.abs)),
    other: Math.max(...distances),
    rise: Math.max(0, ...changes),
    drift: changes.at(-1),
    gap: largest(frames, (poses) => jointGap(scene, poses)),
    costFrames: frames,
  };
}

/**
 * @param kind swinging_box, in_space, bridge, stack or energy
 * @param exact positions of the tracked body after every frame, if known [m]; of kind energy path, such
 * positions as long as they are compared, and kinetic, the largest kinetic energy [J]
 * @return failure (null if the scene holds), error [m, of kind energy -], other [m], ms: median cost of a
 * frame; of kind energy also rise, drift [-] and gap [m]
 */
export function judge(kind, scene, frames, exact) {
  const failure = whyBroken(scene, frames);
  if (failure) return { failure };
  const rules = { swinging_box: swingingBox, in_space: inSpace, bridge, stack, energy };
  const { costFrames, ...result } = rules[kind](scene, frames, exact);
  return { ...result, ms: median(costFrames.map(({ ms }) => ms)) };
}

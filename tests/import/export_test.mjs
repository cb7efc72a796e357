// `substep export` against MuJoCo, which reads the model, and against `substep import`, which makes
// a scene of it again.
//
// usage: export_test.mjs SUBSTEP
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import test from "node:test";
import { bodiesOfScene, inFolder, Oracle, passive, relative, run } from "./mujoco.mjs";

const [program] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const shippedNames = readdirSync(join(here, "../../scenes"))
  .filter((file) => file.endsWith(".json") && !file.includes("schema"))
  .map((file) => file.slice(0, -".json".length));
const shipped = (name) => JSON.parse(readFileSync(join(here, "../../scenes", `${name}.json`), "utf8"));

/** The scene as MJCF, and the words of the command. */
function exported(scene, ...flags) {
  return inFolder((folder) => {
    const file = join(folder, "scene.json");
    writeFileSync(file, JSON.stringify(scene));
    const { status, stdout, stderr } = spawnSync(program, ["export", file, ...flags], { encoding: "utf8" });
    return { status, text: stdout, words: stderr };
  });
}

/** The scene that `substep import` makes of a model. */
function imported(text, folder, ...flags) {
  const [model, scene] = [join(folder, "model.xml"), join(folder, "again.json")];
  writeFileSync(model, text);
  execFileSync(program, ["import", model, "--out", scene, ...flags], { stdio: ["ignore", "ignore", "pipe"] });
  return JSON.parse(readFileSync(scene, "utf8"));
}

const scene = (name, bodies, joints, more = {}) => ({
  format: "substep-scene", version: 2, name, title: name, frame: 1 / 60, gravity: [0, -9.81, 0],
  effects: ["gravity", "gyroscopic", ...(joints.length > 0 ? ["joints"] : [])], bodies, joints,
  settings: { preset: "paper", mode: "const", n: 16, drift: "full" }, ...more,
});
const turn = (x, y, z, angle) => {
  const s = Math.sin(angle / 2) / Math.hypot(x, y, z);
  return [Math.cos(angle / 2), x * s, y * s, z * s];
};
const rotate = ([w, x, y, z], [a, b, c]) => {
  const [t, u, v] = [2 * (y * c - z * b), 2 * (z * a - x * c), 2 * (x * b - y * a)];
  return [a + w * t + y * v - z * u, b + w * u + z * t - x * v, c + w * v + x * u - y * t];
};
const plus = (a, b) => a.map((x, i) => x + b[i]);
const minus = (a, b) => a.map((x, i) => x - b[i]);

/**
 * A chain of boxes in space. Each hangs on the one before, by a joint whose body a is the child or the
 * parent in turn.
 * @param kinds of joints  @param parts of every hinge and slide
 */
function chain(name, kinds, parts = {}, more = {}) {
  const bodies = [];
  const joints = [];
  let before = null; // index, pose
  let at = [0.3, 1.1, -0.2];
  for (const [i, type] of kinds.entries()) {
    const q = turn(1, 0.3 * i, -0.7, 0.4 + 0.5 * i);
    const arm = [0.06, -0.15, 0.03]; // from the centre to the joint above
    const position = minus(at, rotate(q, arm));
    bodies.push({
      name: `body ${i} <&>'`, shape: { type: "box", size: [0.1, 0.3, 0.06 + 0.01 * i] }, mass: 1 + 0.3 * i,
      inertia: [0.02, 0.011, 0.025], position, orientation: q, collides: false,
    });
    const inverse = [q[0], -q[1], -q[2], -q[3]];
    const other = before ? { q: before.q, x: before.position } : { q: [1, 0, 0, 0], x: [0, 0, 0] };
    const inOther = (v) => rotate([other.q[0], -other.q[1], -other.q[2], -other.q[3]], v);
    const axis = rotate(q, [0.36, 0.48, 0.8]);
    const across = rotate(q, [-0.8, 0.6, 0]);
    const swapped = before !== null && i % 2 === 1;
    const [a, b] = swapped ? [before.i, i] : [i, before ? before.i : "world"];
    const [toA, toB] = swapped ? [inOther, (v) => rotate(inverse, v)] : [(v) => rotate(inverse, v), inOther];
    const [xA, xB] = swapped ? [other.x, position] : [position, other.x];
    const joint = {
      type, name: `joint ${i} <&>'`, a, b, anchor_a: toA(minus(at, xA)), anchor_b: toB(minus(at, xB)),
    };
    if (type !== "ball") {
      joint.axis_a = toA(type === "universal" && swapped ? across : axis);
      joint.axis_b = toB(type === "universal" && !swapped ? across : axis);
    }
    if (type === "prismatic" || type === "weld") {
      joint.across_a = toA(across);
      joint.across_b = toB(across);
    }
    if (type === "hinge") {
      for (const [part, content] of Object.entries(parts)) {
        joint[part] = typeof content === "object"
          ? { ...content, across_a: toA(across), across_b: toB(across) } : content;
      }
    }
    joints.push(joint);
    before = { i, q, position };
    at = plus(position, rotate(q, [-0.04, 0.16, -0.02]));
  }
  const made = scene(name, bodies, joints, more);
  made.joints = joints.map((joint) => ({
    ...joint, a: bodies[joint.a].name, b: joint.b === "world" ? "world" : bodies[joint.b].name,
  }));
  return made;
}

/** True if rows of the scene that is imported again differ. */
const swaps = ({ joints, bodies }) => joints.some(({ type, a, b }) => type === "prismatic" ||
  (type === "hinge" && bodies.findIndex(({ name }) => name === b) > bodies.findIndex(({ name }) => name === a)));

const effects = (...more) => ({ effects: ["gravity", "gyroscopic", "joints", ...more] });
const trees = [
  chain("hinges_and_balls", ["hinge", "ball", "hinge", "ball"]),
  chain("slides", ["prismatic", "hinge", "prismatic"]),
  chain("springs_and_dampers", ["hinge", "hinge", "ball"],
    { spring: { rest: 0.3, stiffness: 4, damping: 0.1 } }, effects("springs")),
  chain("armatures", ["hinge", "hinge"], { armature: 0.05 }, effects("armature")),
  chain("drives", ["hinge", "hinge", "hinge"],
    { drive: { target: 0.4, velocity: 0.2, stiffness: 30, damping: 2 } }, effects("drives")),
  chain("centred_drives", ["hinge", "hinge"],
    { drive: { target: 0, velocity: 0, stiffness: 30, damping: 2 } }, effects("drives")),
  chain("universal_joints", ["universal", "universal", "ball"]),
  shipped("spherical_pendulum"),
  shipped("heavy_top"),
  shipped("whirling_chain"),
];

/** At the start of its keyframe, if it has one. */
const key = (text) => (text.includes("<keyframe>") ? "start" : undefined);

for (const content of trees) {
  test(`${content.name}: MuJoCo reads masses, inertias and poses`, async () => {
    const { text, status, words } = exported(content);
    assert.equal(status, 0, words);
    const oracle = await Oracle.of(text, key(text));
    const theirs = oracle.bodies();
    const ours = bodiesOfScene(content);
    // In the order of the scene: they are chains.
    assert.equal(ours.length, theirs.length);
    for (const [i, body] of ours.entries()) {
      assert.ok(relative([theirs[i].mass], [body.mass]) < 1e-9, body.name);
      assert.ok(Math.max(...theirs[i].centre.map((x, j) => Math.abs(x - body.centre[j]))) < 1e-9, body.name);
      assert.ok(relative(theirs[i].inertia, body.inertia) < 1e-9, body.name);
    }
    oracle.free();
  });

  test(`${content.name}: its motion converges to that of MuJoCo`, async () => {
    const { text } = exported(content);
    const oracle = await Oracle.of(text, key(text));
    oracle.advance(1, 15360);
    const truth = oracle.bodies();
    const orders = [];
    inFolder((folder) => {
      const file = join(folder, "scene.json");
      writeFileSync(file, JSON.stringify(content));
      const names = bodiesOfScene(content).map((body) => body.name);
      for (const [integrator, order, counts] of [["euler", 1, [64, 128, 256]], ["leapfrog", 2, [16, 32, 64]]]) {
        const errors = counts.map((n) => {
          const flags = ["--mode", "const", "--n", `${n}`, "--integrator", integrator];
          const centres = run(program, file, flags);
          return Math.max(...names.map((body, i) =>
            Math.hypot(...centres.get(body).map((y, j) => y - truth[i].centre[j]))));
        });
        const observed = Math.log2(errors.at(-2) / errors.at(-1));
        console.log(content.name, integrator, errors.map((e) => e.toExponential(2)).join(" "), "order",
          observed.toFixed(2));
        orders.push({ integrator, order, observed });
      }
    });
    oracle.free();
    for (const { integrator, order, observed } of orders) {
      assert.ok(observed > order - 0.15, `${integrator}: order ${observed}`);
    }
  });

  if (content.joints.some(({ type }) => type === "universal")) continue; // other rows: see joint_stack.hpp
  test(`${content.name}: exported and imported again it moves the same`, () => {
    const { text } = exported(content);
    inFolder((folder) => {
      const file = join(folder, "scene.json");
      writeFileSync(file, JSON.stringify(content));
      const again = imported(text, folder, ...(key(text) ? ["--key", "start"] : []));
      writeFileSync(join(folder, "again.json"), JSON.stringify({ ...again, settings: content.settings }));
      const moved = (n) => {
        const flags = ["--preset", "paper", "--mode", "const", "--n", `${n}`];
        const before = run(program, file, flags);
        const after = run(program, join(folder, "again.json"), flags);
        return Math.max(...[...before].map(([name, x]) => Math.hypot(...minus(x, after.get(name)))));
      };
      // Rows of a hinge whose bodies have changed places, and of a slide with other directions across
      // it, are others: the motion is the same but for the error of the step.
      const [coarse, fine] = [moved(16), moved(64)];
      console.log(content.name, "imported again: moved by", coarse.toExponential(2), "and",
        fine.toExponential(2), "m in 1 s");
      assert.ok(coarse < 1e-8 && fine < Math.max(coarse / 4, 1e-12), `${coarse} m, ${fine} m`);
      assert.ok(swaps(content) || coarse < 1e-13, `${coarse} m`);
    });
  });
}

test("every shipped scene is a model that MuJoCo reads, and says what it lacks", async () => {
  for (const name of shippedNames) {
    const { text, words } = exported(shipped(name));
    const oracle = await Oracle.of(text, key(text));
    assert.ok(oracle.model.nv > 0, name);
    oracle.free();
    if (name === "crank_rocker") assert.match(words, /joints that close loops/);
  }
});

test("loops close: the four-bar linkage moves as in the scene", async () => {
  const content = shipped("crank_rocker");
  content.criteria = undefined;
  // As stiff as a step of 50 us allows.
  const text = exported(content).text.replaceAll("<connect", '<connect solref="1e-4 1" solimp="0.9999 0.9999 1"');
  const oracle = await Oracle.of(text, "start");
  oracle.advance(1, 20000);
  const theirs = oracle.bodies();
  inFolder((folder) => {
    const file = join(folder, "scene.json");
    writeFileSync(file, JSON.stringify(content));
    const centres = run(program, file, ["--mode", "const", "--n", "512"]);
    for (const [i, body] of bodiesOfScene(content).entries()) {
      const apart = Math.hypot(...minus(centres.get(body.name), theirs[i].centre));
      assert.ok(apart < 0.02, `${body.name}: ${apart} m apart`); // its loop is soft
    }
  });
  oracle.free();
});

test("MuJoCo reads hostile names as they are", async () => {
  const names = [`a"b`, "<body/>", "x]]>y", "&amp;&#10;", "'", "--> é 字 😀", "World", "a/b\\c", "%s%n", "a b"];
  const bodies = names.map((name, i) => ({
    name, shape: { type: "sphere", radius: 0.1 }, mass: 1, position: [i, 0, 0], collides: false,
  }));
  const { text, words } = exported(scene("names", bodies, []));
  assert.ok(text.length > 0, words);
  const oracle = await Oracle.of(text);
  assert.deepEqual(oracle.bodyNames(), names);
  oracle.free();
});

test("what MJCF does not say is listed by name", () => {
  const content = chain("all_parts", ["hinge", "ball", "cylindrical"], {
    limit: { lower: -1, upper: 1, restitution: 0.5 },
  }, { effects: ["gravity", "joints", "limits", "restitution", "external"] });
  content.bodies[1].force = [1, 0, 0];
  content.joints[1].compliance = 1e-6;
  const strict = exported(content, "--strict");
  assert.equal(strict.status, 1);
  assert.match(strict.words, /joint joint 0 <&>': the restitution of its limits/);
  assert.match(strict.words, /joint joint 1 <&>': is rigid: its compliance is left out/);
  assert.match(strict.words, /body body 1 <&>': a constant force or torque/);
  assert.equal(exported(trees[0], "--strict").status, 0);
});

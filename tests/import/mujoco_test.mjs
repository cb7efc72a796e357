// `substep import` against MuJoCo: the same masses, inertias and poses, and the same motion, to which
// both converge.
//
// usage: mujoco_test.mjs SUBSTEP [MODEL...]: other models than those of this folder; a keyframe follows
// its model after a #
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { execFileSync } from "node:child_process";
import { basename, dirname, extname, join } from "node:path";
import { fileURLToPath } from "node:url";
import test from "node:test";
import {
  bodiesOfScene, inFolder, Oracle, passive, passiveUrdf, relative, run, whole, withoutFiles,
} from "./mujoco.mjs";
import { randomModel } from "./random_model.mjs";

const [program, ...others] = process.argv.slice(2);
const folder = join(dirname(fileURLToPath(import.meta.url)), "models");
const own = ["arm.xml", "walker.xml", "walker.xml#home", "copies.xml", "arm.urdf"]
  .map((name) => join(folder, name));
const models = others.length > 0 ? others : own;

/** The scene of a model's text: the file, and its content. */
function imported(directory, path, text, key) {
  const model = join(directory, basename(path));
  const scene = join(directory, "scene.json");
  writeFileSync(model, text);
  execFileSync(program, ["import", model, "--out", scene, ...(key ? ["--key", key] : [])],
    { stdio: ["ignore", "ignore", "pipe"] });
  return { file: scene, content: JSON.parse(readFileSync(scene, "utf8")) };
}

/** The largest relative differences of bodies; fails if one is above 1e-9. */
function differences(ours, theirs) {
  assert.equal(ours.length, theirs.length);
  const worst = { mass: 0, centre: 0, inertia: 0 };
  for (const [i, body] of ours.entries()) {
    const { mass, centre, inertia } = theirs[i];
    const scale = Math.max(1, ...centre.map(Math.abs));
    const found = {
      mass: relative([body.mass], [mass]),
      centre: Math.max(...body.centre.map((x, j) => Math.abs(x - centre[j]))) / scale,
      inertia: relative(body.inertia, inertia),
    };
    for (const [what, difference] of Object.entries(found)) {
      assert.ok(difference < 1e-9, `${body.name}: ${what} differs by ${difference}`);
      worst[what] = Math.max(worst[what], difference);
    }
  }
  return worst;
}

for (const model of models) {
  const [path, key] = model.split("#");
  const isUrdf = extname(path) === ".urdf";
  // Other models may have springs and dampers that a scene cannot have, soft limits in URDF, files that
  // are not there, and fast motion.
  const isOwn = others.length === 0;
  const plain = isOwn ? whole(path) : withoutFiles(whole(path));
  const text = isUrdf ? (isOwn ? plain : passiveUrdf(plain))
    : (isOwn ? passive(plain) : passive(plain, "spring", "damper"));
  const finer = isOwn ? 1 : 4;
  const name = basename(model);

  test(`${name}: masses, inertias and poses are MuJoCo's`, async () => {
    const oracle = await Oracle.of(text, key);
    const read = inFolder((directory) => bodiesOfScene(imported(directory, path, text, key).content));
    const worst = differences(read, oracle.bodies());
    console.log(name, "differs at most by", worst);
  });

  test(`${name}: its motion converges to MuJoCo's`, async () => {
    const oracle = await Oracle.of(text, key);
    oracle.advance(1, 15360);
    const truth = oracle.bodies();
    const errors = (integrator, counts) => inFolder((directory) => {
      const { file, content } = imported(directory, path, text, key);
      const names = bodiesOfScene(content).map((body) => body.name);
      return counts.map((n) => finer * n).map((n) => {
        const centres = run(program, file, ["--mode", "const", "--n", `${n}`, "--integrator", integrator]);
        return Math.max(...names.map((body, i) =>
          Math.hypot(...centres.get(body).map((y, j) => y - truth[i].centre[j]))));
      });
    });
    const orders = [];
    for (const [integrator, order, counts] of [["euler", 1, [64, 128, 256]], ["leapfrog", 2, [16, 32, 64]]]) {
      const found = errors(integrator, counts);
      const observed = Math.log2(found.at(-2) / found.at(-1));
      console.log(name, integrator, found.map((e) => e.toExponential(2)).join(" "), "order",
        observed.toFixed(2));
      // A body in free fall is exact.
      if (found.at(-1) > 1e-9) orders.push({ integrator, order, observed, found });
    }
    for (const { integrator, order, observed, found } of orders) {
      assert.ok(Math.abs(observed - order) < 0.15, `${integrator}: order ${observed}, ${found}`);
    }
  });
}

if (others.length === 0) {
  test("random models: masses, inertias and poses are MuJoCo's", async () => {
    const kModels = 150;
    for (let seed = 1; seed <= kModels; ++seed) {
      const text = randomModel(seed);
      const oracle = await Oracle.of(text);
      const read = inFolder((directory) => bodiesOfScene(imported(directory, "model.xml", text).content));
      try {
        differences(read, oracle.bodies());
      } catch (error) {
        throw new Error(`random model ${seed}: ${error.message}\n${text}`, { cause: error });
      }
      oracle.free();
    }
  });
}

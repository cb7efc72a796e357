// `substep doctor --engine mujoco` against MuJoCo: the step that it foretells is the largest at which
// the model holds, and the drive that it names is the one that moves it.
//
// usage: doctor_test.mjs SUBSTEP [MODEL...]: other models than those of doctor_models.mjs. They are
// compared without contact, with two of MuJoCo's integrators, and only the figures are printed.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import test from "node:test";
import { fast, models, moving } from "./doctor_models.mjs";
import { inFolder, Oracle, whole, withoutFiles } from "./mujoco.mjs";

const [program, ...others] = process.argv.slice(2);

/** What the doctor says of a model. @param more flags */
function diagnosis(text, engine = "mujoco", more = ["--no-runs"]) {
  return inFolder((folder) => {
    const [model, json] = [join(folder, "model.xml"), join(folder, "diagnosis.json")];
    writeFileSync(model, text);
    const flags = ["--engine", engine, ...more, "--json", json];
    const { status, stderr } = spawnSync(program, ["doctor", model, ...flags], { encoding: "utf8" });
    assert.ok(status >= 0 && status <= 2, stderr);
    return JSON.parse(readFileSync(json, "utf8"));
  });
}

/** The largest speed of a coordinate after a small disturbance; infinite if MuJoCo gives up. */
function peakSpeed(oracle, step, seconds) {
  const { model, data } = oracle;
  oracle.restart(step);
  for (let i = 0; i < model.nv; ++i) data.qvel[i] = 1e-3 * Math.sin(1 + 7 * i);
  return oracle.peakSpeed(seconds);
}

/**
 * The largest step at which speeds stay near those of a fine run [s], within 0.2 %. `bound` says
 * where the search ended instead.
 */
function largestStep(oracle, foretold) {
  const seconds = (step) => Math.max(4, 400 * step);
  const fine = peakSpeed(oracle, foretold / 20, 4);
  const holds = (step) => peakSpeed(oracle, step, seconds(step)) < 4 * fine + 1e-2;
  let [low, high] = [foretold / 2, foretold * 2];
  if (!holds(low)) return { step: low, bound: "less than " };
  if (holds(high)) return { step: high, bound: "at least " };
  while (high > 1.002 * low) {
    const middle = Math.sqrt(low * high);
    if (holds(middle)) low = middle;
    else high = middle;
  }
  return { step: low, bound: "" };
}

async function measure(text, foretold, engine = "mujoco") {
  const oracle = await Oracle.of(text);
  oracle.integrate(engine === "mujoco" ? "EULER" : "IMPLICITFAST");
  const measured = largestStep(oracle, foretold);
  oracle.free();
  return measured;
}

const figures = (name, foretold, { step, bound }) => console.log(`${name}: foretold`,
  `${foretold.toExponential(3)} s, MuJoCo holds up to ${bound}${step.toExponential(3)} s,`,
  `ratio ${bound}${(step / foretold).toFixed(3)}`);

for (const path of others) {
  const text = withoutFiles(whole(path)).replace(/<mujoco( [^>]*)?>/, (tag) =>
    `${tag}<option><flag contact="disable"/></option>`);
  for (const engine of ["mujoco", "mujoco-implicitfast"]) {
    const { largest_step: foretold, limited_by: by } = diagnosis(whole(path), engine);
    if (foretold === null) console.log(`${basename(path)}, ${engine}: no limit is foretold`);
    else figures(`${basename(path)}, ${engine} (${by})`, foretold, await measure(text, foretold, engine));
  }
}

for (const { name, text } of others.length > 0 ? [] : models) {
  test(`${name}: the step is MuJoCo's`, async () => {
    const found = diagnosis(text);
    const foretold = found.largest_step;
    const measured = await measure(text, foretold);
    figures(name, foretold, measured);
    assert.ok(Math.abs(measured.step / foretold - 1) < 0.05, `${measured.step} s instead of ${foretold} s`);
    const named = /^the drive of (\S+) /.exec(found.limited_by)?.[1];
    if (named === undefined) return;
    // Gains that are 20 % smaller allow longer steps: most of all those of the drive that is named.
    const gains = new RegExp(`<(?:position|velocity)[^>]* joint="([^"]+)"[^>]*>`, "g");
    const softer = (joint) => text.replace(gains, (drive, of) => (of !== joint ? drive
      : drive.replace(/ k([pv])="([^"]+)"/g, (_, gain, value) => ` k${gain}="${0.8 * value}"`)));
    const longest = [];
    for (const [, joint] of text.matchAll(gains)) {
      longest.push({ joint, ...await measure(softer(joint), foretold) });
    }
    longest.sort((a, b) => b.step - a.step);
    if (longest.length > 0) assert.equal(longest[0].joint, named);
  });
}

for (const { name, text } of others.length > 0 ? [] : moving) {
  test(`${name}: the step is MuJoCo's`, async () => {
    const found = diagnosis(text, "mujoco", ["--step", "0.001"]);
    const measured = await measure(text, found.largest_step);
    figures(name, found.largest_step, measured);
    assert.ok(Math.abs(measured.step / found.largest_step - 1) < 0.05,
      `${measured.step} s instead of ${found.largest_step} s`);
    // What is said to hold holds.
    const half = diagnosis(text, "mujoco", ["--step", `${0.5 * found.largest_step}`]);
    assert.equal(half.verdict, "holds");
    assert.equal(half.runs.at(-1).holds, true);
  });
}

for (const { name, text } of others.length > 0 ? [] : fast) {
  test(`${name}: a step that holds keeps MuJoCo's energy`, async () => {
    const oracle = await Oracle.of(text.replace("<flag ", '<flag energy="enable" '));
    oracle.integrate("EULER");
    // Of the energy that falls: mass and length of the chain, at 45 degrees.
    const count = (text.match(/<body/g) ?? []).length;
    const scale = count * 9.81 * 0.15 * count;
    const seen = [];
    for (const step of [0.002, 0.005, 0.01, 0.02, 0.03]) {
      const { verdict } = diagnosis(text, "mujoco", ["--step", `${step}`]);
      const means = oracle.meanEnergies(step, 5);
      const rise = (Math.max(...means) - means[0]) / scale;
      seen.push(`${step} s: ${verdict}, energy of MuJoCo +${(100 * rise).toFixed(1)} %`);
      if (verdict === "holds") assert.ok(rise < 0.15, seen.at(-1));
      if (rise > 0.3) assert.equal(verdict, "fails", seen.at(-1));
    }
    console.log(name, seen.join("; "));
    oracle.free();
  });
}

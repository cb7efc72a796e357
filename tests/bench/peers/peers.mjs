// ./dev bench --peers: the same scenes on this project and on other engines. Every setting of every
// engine's ladder runs once. Those that hold, and that no other setting of the engine beats in both
// cost and error, are timed again, interleaved, so that other load on the machine affects all engines.

import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";
import { chain } from "./chain.mjs";
import { crane } from "./crane.mjs";
import { fourBarPath } from "./four_bar.mjs";
import { judge, largestKinetic, median, readFrames } from "./measures.mjs";
import * as ode from "./ode.mjs";
import * as ours from "./ours.mjs";
import { readScene } from "./scene.mjs";
import { factorLines, integratorLines, sceneLines } from "./table.mjs";

const here = path.dirname(fileURLToPath(import.meta.url));
const root = path.resolve(here, "../../..");
const out = path.join(root, "build/peers");

const { values: options } = parseArgs({
  options: {
    scene: { type: "string", multiple: true },
    engine: { type: "string", multiple: true },
    repeats: { type: "string", default: "3" },
    settings: { type: "string", default: "1000" }, // of each ladder, from its start
  },
});

const kWarmUp = { search: 60, timing: 600 }; // frames
// Only the optimising compiler: otherwise a frame could run in code of either tier.
const kNode = [process.execPath, "--no-liftoff"];
const kSlack = 0.8; // uncertainty of a cost from the single run of the search, on a shared machine [-]
const kLimit = 120e3; // of one run [ms]

const kCompared = 1; // part of an energy scene in which paths are compared [s]
const kFinest = { preset: "steady", mode: "const", n: 256 };

/** The scenes. kind selects the measures; aim, if given, is the factor by which we want to be cheaper
 *  than every peer at an error no larger; exact, the path of the tracked body where the lab has no
 *  reference. All but the chain and the crane are scene files. The
 *  regularisation of the moved stacks models finite precision; only this project has it, and it only
 *  increases its error, so it is removed. */
const kScenes = [
  { title: "Swinging box", kind: "swinging_box", file: "swinging_box", aim: 7 },
  { title: "Spherical pendulum", kind: "in_space", file: "spherical_pendulum" },
  { title: "Chain in space", kind: "in_space", file: "chain", make: chain },
  { title: "Crane", kind: "in_space", file: "crane", make: crane },
  { title: "Crank and rocker", kind: "energy", file: "crank_rocker", exact: fourBarPath },
  { title: "Thrown rope", kind: "energy", file: "thrown_rope" },
  { title: "Bridge", kind: "bridge", file: "bridge", aim: 10 },
  { title: "Heavy stack", kind: "stack", file: "heavy_stack", aim: 4 },
  { title: "Heavy stack, balls moved by 2 mm", kind: "stack", file: "heavy_stack_stress", aim: 4 },
  { title: "Tall stack, balls so moved", kind: "stack", file: "heavy_stack_stress_tall", aim: 4 },
];

function shipped(name) {
  return JSON.parse(readFileSync(path.join(root, "scenes", `${name}.json`), "utf8"));
}

function writeScene({ kind, file, make = () => shipped(file) }) {
  const scene = make();
  delete scene.regularisation;
  if (kind === "energy") Object.assign(scene.criteria, { joint_gap: 0.1, window: kCompared });
  const written = path.join(out, `${file}.json`);
  writeFileSync(written, JSON.stringify(scene));
  if (kind === "energy") writeFileSync(written, runProgram("consistent_start", written));
  return written;
}

const assignments = (setting) => Object.entries(setting).map(([name, value]) => `${name}=${value}`);

/** An engine that is a program of the build: its ladder and the command line of one run. */
const program = (name, title, { ladder, cannotState }, ...words) => ({
  name,
  title,
  ours: ladder === ours.ladder,
  ladder,
  cannotState,
  command: (file, frames, warmUp, setting) => [
    ...words,
    ...[file, frames, warmUp],
    ...assignments(setting),
  ],
});

/** An engine that is an npm package, run by Node.js. */
async function npmPackage(name) {
  const { title, ladder, cannotState } = await import(`./${name}.mjs`);
  return {
    name,
    title: `${title}, WASM`,
    ladder,
    cannotState,
    command: (file, frames, warmUp, setting) => [
      ...kNode,
      ...[path.join(here, "run.mjs"), name, file, frames, warmUp, JSON.stringify(setting)],
    ],
  };
}

const kPackages = ["mujoco", "rapier", "jolt", "physx"];

/** Exits with a list of the allowed names if a name is unknown. */
function known(what, names = [], allowed) {
  const stranger = names.find((name) => !allowed.includes(name));
  if (stranger === undefined) return;
  console.error(`--${what}: "${stranger}" is none of ${allowed.join(", ")}`);
  process.exit(2);
}

const built = (preset, name) => path.join(root, "build", preset, "tests/bench/peers", name);

/** The output of a native program of the build. */
function runProgram(name, ...args) {
  const options = { encoding: "utf8", maxBuffer: 1 << 28 };
  return execFileSync(built("release", name), args.map(String), options);
}

/** Positions of the tracked body after every frame [m], from the lab. */
function labPath({ path }) {
  const lines = runProgram("exact_path", path);
  return lines.trim().split("\n").map((line) => line.split(" ").map(Number));
}

const frameCount = (scene, seconds) => Math.round(seconds / scene.frame);

/** What judge() compares a run with, for the kinds that need it. */
function findExact(kind, scene, exact = labPath) {
  if (kind === "bridge" || kind === "stack") return null;
  if (kind !== "energy") return labPath(scene);
  const frames = frameCount(scene, scene.criteria.duration);
  const finest = runProgram("substep_peer", scene.path, frames, 0, ...assignments(kFinest));
  return {
    path: exact(scene, frameCount(scene, kCompared)),
    kinetic: largestKinetic(scene, readFrames(finest, scene.bodies.length)),
  };
}

async function engines() {
  const all = [
    program("native", "substep, native", ours, built("release", "substep_peer")),
    program("wasm", "substep, WASM", ours, ...kNode, built("web", "substep_peer.js")),
    program("ode", `${ode.title}, native`, ode, built("release", "ode_peer")),
    ...(await Promise.all(kPackages.map(npmPackage))),
  ];
  known("engine", options.engine, all.map(({ name }) => name));
  return options.engine ? all.filter(({ name }) => options.engine.includes(name)) : all;
}

/** One run in its own process: an engine that aborts does not end the bench. */
function run(entry, warmUp) {
  const { engine, scene, setting, kind, exact } = entry;
  const frames = frameCount(scene, scene.criteria.duration);
  const [command, ...args] = engine.command(scene.path, frames, warmUp, setting).map(String);
  const result = spawnSync(command, args, { encoding: "utf8", maxBuffer: 1 << 28, timeout: kLimit });
  if (result.error?.code === "ETIMEDOUT") return { failure: `over ${kLimit / 1e3} s` };
  if (result.status !== 0) {
    const why = (result.stderr || String(result.error ?? result.signal)).trim().split("\n");
    return { failure: `stops: ${why.find((line) => /error/i.test(line)) ?? why[0]}` };
  }
  return judge(kind, scene, readFrames(result.stdout, scene.bodies.length), exact);
}

/**
 * The settings that hold and that no other setting of the same engine beats in cost and error.
 * @param slack relative uncertainty of a cost [-]
 */
function frontier(entries, slack) {
  const holding = entries.filter((entry) => !entry.failure);
  const beats = (one, two) =>
    one.engine === two.engine && one.ms * (1 + slack) < two.ms && one.error <= two.error;
  return holding.filter((entry) => !holding.some((other) => beats(other, entry)));
}

/** The frontier, and our named settings that hold. */
function shown(entries, slack) {
  const front = frontier(entries, slack);
  const named = ({ setting, failure }) => !failure && Object.keys(setting).join() === "preset";
  return entries.filter((entry) => front.includes(entry) || named(entry));
}

/** Whether every run of an engine stopped: it is not built or not written as it is now. */
function neverRuns(engine, entries) {
  const own = entries.filter((entry) => entry.engine === engine && !entry.lacking);
  return own.length > 0 && own.every(({ failure }) => failure?.startsWith("stops"));
}

function progress(text) {
  if (process.stderr.isTTY) process.stderr.write(`\r${text.slice(0, 110)}\x1b[K`);
}

function search({ title, kind, ...source }, list, count) {
  const scene = readScene(writeScene({ kind, ...source }));
  const exact = findExact(kind, scene, source.exact);
  return list.flatMap((engine) =>
    (engine.ladder[source.file] ?? engine.ladder[kind]).slice(0, count).map((setting) => {
      progress(`${title}: ${engine.title}, ${assignments(setting).join(" ")}`);
      const entry = { engine, scene, setting, kind, exact };
      const lacking = engine.cannotState?.(scene, setting);
      if (lacking) return { ...entry, lacking, failure: `cannot state the scene: ${lacking}` };
      return Object.assign(entry, run(entry, kWarmUp.search));
    }),
  );
}

function time(entries, repeats) {
  for (const entry of entries) entry.medians = [];
  for (let i = 0; i < repeats; ++i) {
    for (const entry of entries) {
      progress(`timing, round ${i + 1} of ${repeats}: ${entry.engine.title}`);
      entry.medians.push(run(entry, kWarmUp.timing).ms);
    }
  }
  for (const entry of entries) {
    entry.ms = median(entry.medians);
    entry.least = Math.min(...entry.medians);
    entry.most = Math.max(...entry.medians);
  }
}

/** An entry of peers.json: lengths in metres, costs in milliseconds per frame. */
function record(entry, best) {
  const { setting, failure, error, other, rise, drift, gap, ms, medians } = entry;
  const engine = entry.engine.title;
  const measured = { error, other, rise, drift, gap, ms, medians };
  return { engine, setting, failure, ...measured, best: best.includes(entry) };
}

/** The value of an option that counts; exits if it is no whole number above 0. */
function counted(what) {
  const count = Number(options[what]);
  if (Number.isInteger(count) && count > 0) return count;
  console.error(`--${what}: "${options[what]}" is no whole number above 0`);
  process.exit(2);
}

async function main() {
  const repeats = counted("repeats");
  const settings = counted("settings");
  mkdirSync(out, { recursive: true });
  const list = await engines();
  known("scene", options.scene, kScenes.map(({ file }) => file));
  const scenes = kScenes.filter(({ file }) => !options.scene || options.scene.includes(file));
  const results = [];
  console.log(`WebAssembly in Node.js ${process.version} (V8 ${process.versions.v8})`);
  for (const scene of scenes) {
    const entries = search(scene, list, settings);
    const candidates = shown(entries, kSlack);
    time(candidates, repeats);
    const best = shown(candidates, 0);
    for (const engine of list) if (neverRuns(engine, entries)) process.exitCode = 1;
    progress("");
    console.log(sceneLines(scene, entries, best).join("\n"));
    console.log(integratorLines(entries, best).join("\n"));
    console.log(factorLines(scene, best).join("\n"));
    results.push({
      scene: scene.file,
      runs: entries.map((entry) => record(entry, best)),
    });
  }
  const lock = JSON.parse(readFileSync(path.join(here, "package-lock.json"), "utf8"));
  const versions = Object.fromEntries(
    Object.entries(lock.packages)
      .filter(([name]) => name)
      .map(([name, { version }]) => [name.replace("node_modules/", ""), version]),
  );
  const json = { node: process.version, versions, results };
  writeFileSync(path.join(out, "peers.json"), JSON.stringify(json, null, 1) + "\n");
  console.log(`All runs, failures included: build/peers/peers.json`);
}

await main();

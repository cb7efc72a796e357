// What adaptive sub-steps cost beside the paper's rule and beside the best constant N found in
// hindsight, at equal error of the path: prints the table of core/docs/energy.md. Minutes:
// node core/docs/figures/cost.mjs [PROGRAM [SCENE...]]. PROGRAM is the command line, `substep`;
// without scenes, all shipped ones whose sweep compares a path.
import { execFileSync, spawn } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, "../../..");
const program = resolve(process.argv[2] ?? join(root, "build/release/bin/substep"));
const only = process.argv.slice(3);

const certain = 10; // a reference is so many times better than the errors compared
const equal = 1.05; // errors up to this ratio are equal
const least = 1e-9; // smaller distances are rounding, and equal [m]
const goal = 1.3; // steady over the best constant
const finest = 8192; // sub-steps a frame of a reference
const mostWork = 2.2e11; // of one reference [operations]
const leastShare = 0.25; // of the time of the sweep that a reference must cover
const rounds = 3; // of timing
const short = 30; // runs that are timed more often [ms]

const presets = { paper: ["--preset", "paper"], steady: ["--preset", "steady"] };
const constant = (n) => [...presets.steady, "--mode", "const", "--n", String(n)];

// --------------------------------------------------------------------------------------------- scenes
/** The scenes whose sweep compares a path: file, seconds compared, source and uncertainty [m] of the reference. */
function scenes() {
  const found = [];
  for (const file of readdirSync(join(root, "scenes/sweeps")).sort()) {
    const name = file.replace(".txt", "");
    const path = join(root, "scenes", `${name}.json`);
    const { criteria, frame = 1 / 60 } = JSON.parse(readFileSync(path, "utf8"));
    if (!criteria.track || (only.length > 0 && !only.includes(name))) continue;
    // The head of a shipped sweep: hash; uncertainty, window, scale of energies; source.
    const [, numbers, source] = readFileSync(join(root, "scenes/sweeps", file), "utf8").split("\n", 3);
    const [uncertainty, seconds] = numbers.split(" ").map(Number);
    found.push({ name, path, seconds, source, uncertainty, frame, body: criteria.track });
  }
  return found;
}

// ------------------------------------------------------------------------------------------ measuring
/** Costs of a run. The criterion's operations are the price of choosing N, and count. */
function costs(work, timing) {
  return {
    n: work.substeps / work.frames, // with those of frames taken again
    range: [work.n_min, work.n_max],
    flops: work.flops + work.criterion.flops,
    ms: 1e3 * timing.stages.total,
  };
}

/** A run by the command line, with its path. */
function walk(scene, flags, seconds) {
  const args = ["run", scene.path, ...flags, "--seconds", String(seconds), "--quiet", "--json", "-"];
  const out = execFileSync(program, args, { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] });
  const { settings, frames, work, timing, holds, verdict } = JSON.parse(out.slice(0, out.lastIndexOf("}") + 1));
  return { settings, path: frames.map(({ x, y, z }) => [x, y, z]), holds, verdict, ...costs(work, timing) };
}

/** The largest distance of two paths so far [m], by frame. */
function apart(a, b) {
  let most = 0;
  return a.slice(0, b.length).map((p, i) => (most = Math.max(most, Math.hypot(...p.map((x, k) => x - b[i][k])))));
}

/** Settings of flags, as experiments read them. */
const settingsOf = (scene, flags) => walk(scene, flags, scene.frame).settings;

/** Errors against the program's own reference, by `substep run --experiments`. One process, one reference. */
function byProgram(scene) {
  const child = spawn(program, ["run", scene.path, "--experiments", "-"], { stdio: ["pipe", "pipe", "inherit"] });
  const lines = createInterface({ input: child.stdout })[Symbol.asyncIterator]();
  return {
    source: scene.source, seconds: scene.seconds, uncertainty: scene.uncertainty,
    async run(flags) {
      child.stdin.write(`${JSON.stringify({ scene: scene.name, settings: settingsOf(scene, flags), seconds: scene.seconds })}\n`);
      const { value, done } = await lines.next();
      if (done) throw new Error(`${scene.name}: no result`);
      const { errors, work, timing, holds, verdict } = JSON.parse(value);
      if (!holds) { // an experiment ends where it fails: these are the costs of the whole time, without error
        const { path, ...rest } = walk(scene, flags, scene.seconds);
        return rest;
      }
      return { error: errors.trajectory_peak, holds, verdict, ...costs(work, timing) };
    },
    close: () => child.stdin.end(),
  };
}

/**
 * Errors against the finest run of steady with constant N: the distance from half of its sub-steps is its
 * uncertainty. It is refined until it is certain enough for the errors of steady; if it never is, the
 * time compared ends where it no longer is.
 */
function byFinest(scene) {
  const steady = walk(scene, presets.steady, scene.seconds);
  let fine = walk(scene, constant(32), scene.seconds);
  for (let n = 64; ; n *= 2) {
    const coarse = fine;
    fine = walk(scene, constant(n), scene.seconds);
    const uncertainty = apart(fine.path, coarse.path);
    const error = apart(fine.path, steady.path);
    const sure = error.map((e, i) => certain * uncertainty[i] <= Math.max(e, certain * least));
    const frames = sure.lastIndexOf(true) + 1;
    // Stiff springs are damped until a sub-step resolves them: few sub-steps can agree by accident.
    const enough = n >= 512 && frames === sure.length;
    if (!enough && 2 * n <= finest && 2 * fine.flops <= mostWork) continue;
    const path = fine.path.slice(0, frames);
    const seconds = Math.round(frames * scene.frame * 1e6) / 1e6;
    return {
      source: `steady, N = ${n}`, n, seconds, uncertainty: uncertainty[frames - 1] ?? Infinity, path,
      whole: { uncertainty: uncertainty.at(-1), error: error.at(-1) },
      async run(flags) {
        const { path: own, ...rest } = walk(scene, flags, seconds);
        return { error: own.length < path.length ? undefined : apart(path, own).at(-1), ...rest };
      },
      close() {},
    };
  }
}

const median = (list) => {
  const sorted = list.filter(Number.isFinite).sort((a, b) => a - b);
  const half = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[half] : (sorted[half - 1] + sorted[half]) / 2;
};

/** The smallest constant N that is as good as `error` [m], and whether larger ones are too. */
async function best(reference, error, most) {
  const tried = new Map();
  const good = async (n) => {
    if (!tried.has(n)) tried.set(n, await reference.run(constant(n)));
    const run = tried.get(n);
    return run.holds && Math.max(run.error, least) <= equal * Math.max(error, least);
  };
  // Every N up to 128: with impacts the error is not monotonic, and a bisection would miss luck.
  let n = 1;
  while (n <= Math.min(most, 128) && !(await good(n))) ++n;
  if (n > 128) {
    while (n <= most && !(await good(n))) n = Math.ceil(1.25 * n);
    if (n > most) return { tried };
    for (let low = Math.max(128, Math.floor(n / 1.25)); n - low > 1;) {
      const middle = (low + n) >> 1;
      if (await good(middle)) n = middle;
      else low = middle;
    }
  }
  if (n > most) return { tried };
  // Luck: an N that is good, among larger ones that are not.
  const larger = Array.from({ length: Math.max(3, n >> 1) }, (_, i) => n + 1 + i);
  for (let m = 2 * n; m <= 128; m *= 2) larger.push(m);
  let lasting = n;
  for (const m of larger) {
    if (m <= most && !(await good(m))) lasting = m + 1;
  }
  return { n, lasting, tried };
}

async function measure(scene) {
  // Computing a reference that cannot be certain enough would be in vain.
  const hopeless = scene.uncertainty > 0.01; // [m]
  let reference = hopeless ? byFinest(scene) : byProgram(scene);
  let steady = await reference.run(presets.steady);
  if (certain * reference.uncertainty > Math.max(steady.error, certain * least)) {
    reference.close();
    reference = byFinest(scene);
    if (reference.seconds >= leastShare * scene.seconds) steady = await reference.run(presets.steady);
  }
  if (reference.seconds < leastShare * scene.seconds) return { scene, reference };
  const found = await best(reference, steady.error, Math.max(32, 4 * Math.ceil(steady.n)));
  const flags = { paper: presets.paper, steady: presets.steady };
  if (found.n) flags.constant = constant(found.n);
  const runs = Object.fromEntries(Object.keys(flags).map((key) => [key, []]));
  // In turn, so that a busy machine slows all of them.
  for (let i = 0; i < (steady.ms < short ? 5 * rounds : rounds); ++i) {
    for (const key of Object.keys(flags)) runs[key].push(await reference.run(flags[key]));
  }
  reference.close();
  const result = { scene, reference, found };
  for (const [key, list] of Object.entries(runs)) result[key] = { ...list[0], ms: median(list.map(({ ms }) => ms)) };
  return result;
}

// ------------------------------------------------------------------------------------------- printing
/** A number with three digits. */
function digits(x) {
  if (x === undefined) return "-";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size < 9.995e-4) return x.toExponential(1);
  return x.toFixed(Math.max(0, 2 - Math.floor(Math.log10(size) + 1e-9)));
}
const ratio = (a, b) => (b > 0 ? a / b : a > 0 ? NaN : 1);
const two = (x) => (Number.isFinite(x) ? x.toFixed(2) : "-");

/** What the numbers of a row do not say. */
function remarks({ scene, reference, found, paper, steady, constant: by }) {
  const { whole } = reference;
  const lost = reference.seconds < scene.seconds && `N = ${reference.n} and ${reference.n / 2} differ by ` +
    `${digits(1e3 * whole.uncertainty)} mm in ${digits(scene.seconds)} s, steady from them by ${digits(1e3 * whole.error)} mm`;
  if (!paper) return [`no reference: ${lost}`];
  const words = lost ? [lost] : [];
  if (!paper.holds) words.push(`paper ${paper.verdict}`);
  if (!steady.holds) words.push(`steady ${steady.verdict}`);
  if (!by) words.push(`no constant N up to ${Math.max(...found.tried.keys())} is as good`);
  else if (found.lasting > found.n) words.push(`luck: ${found.lasting - 1} is worse`);
  if (steady.error <= least) words.push("every N follows this path");
  return words;
}

const ratiosOf = ({ steady, constant: by }) =>
  steady && by ? [ratio(steady.n, by.n), ratio(steady.flops, by.flops), ratio(steady.ms, by.ms)] : [NaN, NaN, NaN];

function row(result) {
  const { scene, reference, paper, steady, constant: by } = result;
  const three = (of) => (steady ? [paper, steady, by].map((run) => (run ? of(run) : "-")).join(" / ") : "-");
  return [`\`${scene.name}\``, digits(reference.seconds), three(({ error }) => digits(error === undefined ? error : 1e3 * error)),
    three(({ n }) => digits(n)), three(({ flops }) => digits(flops / 1e6)), three(({ ms }) => digits(ms)),
    ...ratiosOf(result).map(two), remarks(result).join("; ")];
}

function print(results) {
  const head = ["scene", "s", "error [mm]", "sub-steps a frame", "Mflop", "ms", "sub-steps", "operations", "time", "remarks"];
  console.log("Cells: paper / steady / best constant N. Ratios: steady over constant.\n");
  console.log(`| ${head.join(" | ")} |\n|${"---|".repeat(head.length)}`);
  for (const result of results) console.log(`| ${row(result).join(" | ")} |`);
  for (const [words, some] of [["all", results], ["N above 1", results.filter(({ steady }) => steady?.n > 1)]]) {
    const of = (k) => some.map((result) => ratiosOf(result)[k]).filter(Number.isFinite);
    console.log(`\nMedian, ${words}: ${[0, 1, 2].map((k) => `${two(median(of(k)))} of ${of(k).length}`).join(", ")}; ` +
      `above ${goal}: ${[0, 1, 2].map((k) => of(k).filter((x) => x > goal).length).join(", ")}.`);
  }
}

const results = [];
for (const scene of scenes()) {
  try {
    results.push(await measure(scene));
    const { reference, steady } = results.at(-1);
    console.error(`${row(results.at(-1)).join(" | ")} (${reference.source}, within ${digits(1e3 * reference.uncertainty)} mm; ` +
      `${steady ? `steady N ${steady.range.join(" to ")}` : ""})`);
  } catch (error) {
    console.error(`${scene.name}: ${error.message}`);
    process.exitCode = 1;
  }
}
print(results);

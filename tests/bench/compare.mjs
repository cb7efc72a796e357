// ./dev bench: the cases natively, in the Node.js that runs this script, and in headless Chromium. Runs
// are interleaved, one at a time, so that other load on the machine affects all platforms; the result
// of a case is the minimum.
//   node tests/bench/compare.mjs [ROUNDS, 3]

import { execFile } from "node:child_process";
import { copyFile, mkdtemp, rm } from "node:fs/promises";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { serve } from "../../web/serve.mjs";
import { chromiumPath, renderer } from "../web/browser.mjs";

// The browser tests' own package.
const playwright = createRequire(new URL("../web/browser.mjs", import.meta.url))("playwright-core");

const here = path.dirname(fileURLToPath(import.meta.url));
const root = path.resolve(here, "../..");
const native = path.join(root, "build/release/tests/bench/bench_twin");
const twin = path.join(root, "build/web/tests/bench/bench_twin.js");
const rounds = Number(process.argv[2] ?? 3);
if (!Number.isInteger(rounds) || rounds < 1) {
  console.error(`ROUNDS must be a whole number above 0, not "${process.argv[2]}"`);
  process.exit(2);
}

async function run(...command) {
  const { stdout } = await promisify(execFile)(...command);
  return stdout.split("\n");
}

/** In the page: runs the program in a worker, without drawing. Resolves to its lines. */
const inWorker = (address) => new Promise((resolve, reject) => {
  const worker = new Worker(address);
  const lines = [];
  worker.onerror = ({ message }) => reject(new Error(message ?? `${address} was not loaded`));
  worker.onmessage = ({ data }) => {
    if (data.line !== undefined) lines.push(data.line);
    if (data.error !== undefined || data.status > 0) reject(new Error(data.error ?? data.status));
    if (data.status === 0) resolve(lines);
  };
});

/** A server of the program and its worker, under the policy of the page. */
async function serveTwin() {
  const folder = await mkdtemp(path.join(tmpdir(), "substep-bench-"));
  await copyFile(twin, path.join(folder, "bench_twin.js"));
  await copyFile(path.join(here, "bench_worker.js"), path.join(folder, "bench_worker.js"));
  const server = await serve(folder);
  return {
    worker: `http://127.0.0.1:${server.address().port}/bench_worker.js`,
    async close() {
      server.close();
      server.closeAllConnections();
      await rm(folder, { recursive: true });
    },
  };
}

/** Opens a browser for the measurement only, so that it does not disturb the other platforms. */
async function inChromium() {
  const server = await serveTwin();
  const browser = await playwright.chromium.launch({ executablePath: chromiumPath(), args: renderer });
  try {
    chromium.title = `Chromium ${browser.version()}`;
    const page = await browser.newPage();
    await page.goto(server.worker); // a worker must have the same origin as its page
    return await page.evaluate(inWorker, server.worker);
  } finally {
    await browser.close();
    await server.close();
  }
}

const chromium = { name: "Chromium", lines: inChromium };
const platforms = [
  { name: "native", lines: () => run(native, [path.join(root, "scenes")]) },
  {
    name: "Node.js",
    title: `Node.js ${process.version} (V8 ${process.versions.v8})`,
    lines: () => run(process.execPath, [twin, "scenes"]),
  },
  chromium,
];

/** Name, time, unit and allocations of a line, or null for the heading. */
const reading = (line) =>
  line.match(/^(\S+) +(\S+) ((?:us|ms) per \S+) +(\S+)$/)?.slice(1) ?? null;

/** Per case {of, allocations, times}: the minimum time of each platform, the maximum of allocations. */
async function measure() {
  const cases = new Map();
  for (let round = 0; round < rounds; ++round) {
    for (const { name: platform, lines } of platforms) {
      for (const [name, time, of, allocations] of (await lines()).map(reading).filter(Boolean)) {
        const entry = cases.get(name) ?? { of, allocations: 0, times: {} };
        cases.set(name, entry);
        entry.times[platform] = Math.min(entry.times[platform] ?? Infinity, Number(time));
        entry.allocations = Math.max(entry.allocations, Number(allocations));
      }
    }
  }
  return cases;
}

const row = (name, of, times, ratios, allocations) =>
  [
    name.padEnd(29),
    of.padEnd(16),
    ...times.map((cell) => cell.padStart(10)),
    ...ratios.map((cell) => cell.padStart(17)),
    String(allocations).padStart(13),
  ].join("");

const cases = await measure();
const titles = platforms.map(({ title }) => title).filter(Boolean).join(", ");
console.log(`${titles}: the minimum of ${rounds} interleaved runs`);
const names = platforms.map(({ name }) => name);
const others = names.slice(1);
const ratioNames = others.map((name) => `${name}/native`);
console.log(row("Benchmark", "Time", names, ratioNames, "allocations"));
for (const [name, { of, allocations, times }] of cases) {
  const absolute = names.map((platform) => times[platform].toPrecision(3));
  const ratios = others.map((platform) => (times[platform] / times.native).toFixed(2));
  console.log(row(name, of, absolute, ratios, allocations));
}

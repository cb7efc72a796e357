// ./dev bench: the cases natively, in the Node.js that runs this script, and in headless Chromium. Runs
// are interleaved, one at a time, so that other load on the machine affects all platforms; the result
// of a case is the minimum.
//   node tests/bench/compare.mjs [ROUNDS, 3]

import { execFile } from "node:child_process";
import path from "node:path";
import { fileURLToPath } from "node:url";
import { promisify } from "node:util";
import { open } from "../web/browser.mjs";

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), "../..");
const native = path.join(root, "build/release/tests/bench/bench_twin");
const twin = path.join(root, "build/web/tests/bench/bench_twin.js");
const rounds = Number(process.argv[2] ?? 3);

async function run(...command) {
  const { stdout } = await promisify(execFile)(...command);
  return stdout.split("\n");
}

/** In the page: runs the program in a worker, without drawing. Resolves to its lines. */
const inWorker = (address) => new Promise((resolve, reject) => {
  const source = `
    self.Module = {
      arguments: ["scenes"],
      print: (line) => postMessage({ line }),
      printErr: (line) => postMessage({ error: line }),
      onExit: (status) => postMessage({ status }),
    };
    importScripts(${JSON.stringify(address)});`;
  const worker = new Worker(URL.createObjectURL(new Blob([source])));
  const lines = [];
  worker.onerror = ({ message }) => reject(new Error(message));
  worker.onmessage = ({ data }) => {
    if (data.line !== undefined) lines.push(data.line);
    if (data.error !== undefined || data.status > 0) reject(new Error(data.error ?? data.status));
    if (data.status === 0) resolve(lines);
  };
});

/** Opens a browser for the measurement only, so that it does not disturb the other platforms. */
async function inChromium() {
  const session = await open({ dist: path.dirname(twin) });
  try {
    chromium.title = `Chromium ${session.browser.version()}`;
    const page = await session.browser.newPage();
    const address = `${session.address}${path.basename(twin)}`;
    await page.goto(address); // a worker must have the same origin as its page
    return await page.evaluate(inWorker, address);
  } finally {
    await session.close();
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

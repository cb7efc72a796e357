// Redraws the figures of core/docs/energy.md and prints its tables: node core/docs/figures/draw.mjs
// [PROGRAM], or ./dev figures. PROGRAM is the command line, `substep`. A table of the page that differs
// from what is measured is reported at the end, and the exit status is then 1.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

import { colours, panel, picture, plain, power } from "./chart.mjs";
import { mechanism, plus, run as runPlanar, runReversible, shadow } from "./planar.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const root = resolve(here, "../../..");
const program = resolve(process.argv[2] ?? join(root, "build/release/bin/substep"));
const sceneFile = (name) => join(root, "scenes", `${name}.json`);
const seconds = { crank_rocker: 20, thrown_rope: 10 };

// ------------------------------------------------------------------------------------------ measuring
const runs = new Map();

/** A run of the program: energies as changes from the start [J], N and sub-steps, the end of the track. */
function run(scene, flags, duration = seconds[scene]) {
  const key = `${scene} ${flags} ${duration}`;
  if (runs.has(key)) return runs.get(key);
  const args = ["run", sceneFile(scene), ...flags.split(" "), "--seconds", String(duration), "--quiet", "--json", "-"];
  const out = execFileSync(program, args, { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] });
  const { start, frames, work } = JSON.parse(out.slice(0, out.lastIndexOf("}") + 1));
  const change = [0, ...frames.map((frame) => frame.energy - start.energy_begun)];
  const result = {
    time: [0, ...frames.map((frame) => frame.time)], change, n: frames.map((frame) => frame.substeps),
    end: change.at(-1), low: Math.min(...change), high: Math.max(...change),
    kinetic: Math.max(...frames.map((frame) => frame.kinetic)),
    substeps: work.substeps, // those of discarded attempts too
    again: frames.filter((frame) => frame.discarded > 0).length,
    flops: work.flops, factorisations: work.factorisations, solves: work.solves,
    place: [frames.at(-1).x, frames.at(-1).y],
  };
  runs.set(key, result);
  return result;
}

const planar = (name, gravity) => mechanism(JSON.parse(readFileSync(sceneFile(name), "utf8")), gravity);

// ------------------------------------------------------------------------------------------- printing
/** A number with three digits. */
function digits(x) {
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size < 9.995e-4) return x.toExponential(1);
  const decimals = Math.max(0, 2 - Math.floor(Math.log10(size) + 1e-9));
  return x.toFixed(decimals);
}
const signed = (x) => (x > 0 ? "+" : "") + digits(x);
const thousands = (x) => String(Math.round(x)).replace(/\B(?=(\d{3})+$)/g, ",");
const range = ({ low, high }) => `${signed(low)} to ${signed(high)}`;

const outdated = [];
const page = readFileSync(join(here, "../energy.md"), "utf8");

/** Prints a table, and compares it with the page if it is there. */
function table(title, head, rows, onPage = true) {
  const lines = [head, head.map(() => "---"), ...rows].map((cells) => `| ${cells.join(" | ")} |`);
  lines[1] = `|${"---|".repeat(head.length)}`;
  console.log(`\n${title}\n${lines.join("\n")}`);
  if (onPage && !page.includes(lines.join("\n"))) outdated.push(title);
}

function draw(name, ...parts) {
  writeFileSync(join(here, name), picture(...parts));
}

// ---------------------------------------------------------------------------------------- the problem
const alphas = [0.1, 0.05, 0.025, 0.01, 0.001];
const paper = (alpha) => `--preset paper --alpha ${alpha} --n-max 10000`;
const steady = (alpha) => `--preset steady --alpha ${alpha} --n-max 10000`;

function problem() {
  const rows = [];
  for (const scene of ["crank_rocker", "thrown_rope"]) {
    for (const [words, flags] of [...alphas.map((alpha) => [`paper, alpha ${alpha}`, paper(alpha)]),
      ["steady, alpha 0.1", steady(0.1)], ["steady, alpha 0.025", steady(0.025)]]) {
      const r = run(scene, flags);
      rows.push([`\`${scene}\``, words, signed(r.end), range(r), thousands(r.substeps),
        thousands(r.flops / 1e6)]);
    }
  }
  table("Energy", ["scene", "settings", "change at the end [J]", "range [J]", "sub-steps", "Mflop"], rows);

  const points = (r) => r.time.map((t, i) => [t, r.change[i]]);
  const left = panel({ left: 72, top: 92, width: 400, height: 300, head: "crank_rocker, starts with 95 J of kinetic energy",
    x: { label: "time [s]", from: 0, to: 20, ticks: [0, 5, 10, 15, 20] },
    y: { label: "change of the energy [J]", from: -200, to: 1300, ticks: [0, 250, 500, 750, 1000, 1250] } });
  for (const [alpha, colour, dy] of [[0.1, colours.sky, -3], [0.05, colours.purple, 4], [0.01, colours.green, 4],
    [0.025, colours.red, 4]]) {
    const r = run("crank_rocker", paper(alpha));
    left.line(points(r), colour);
    left.label(20, r.end, `alpha ${alpha}`, colour, { dx: 8, dy });
  }
  left.line(points(run("crank_rocker", steady(0.1))), colours.black, { wide: 2.4 });
  left.label(20, 0, "steady", colours.black, { dx: 8, dy: 11 });
  const right = panel({ left: 632, top: 92, width: 300, height: 300, head: "thrown_rope, starts with 22 J",
    x: { label: "time [s]", from: 0, to: 10, ticks: [0, 2, 4, 6, 8, 10] },
    y: { label: "", from: -150, to: 300, ticks: [-100, 0, 100, 200, 300] } });
  for (const [alpha, colour, t, dx, dy] of [[0.1, colours.sky, 1.3, 8, 6], [0.05, colours.purple, 5.0, 4, 20]]) {
    const r = run("thrown_rope", paper(alpha));
    right.line(points(r), colour);
    const i = Math.round(60 * t);
    right.label(r.time[i], r.change[i], `alpha ${alpha}`, colour, { dx, dy });
  }
  right.line(points(run("thrown_rope", steady(0.1))), colours.black, { wide: 2.4 });
  right.label(6.2, 0, "steady", colours.black, { dx: 0, dy: -9 });
  draw("energy.svg", 960, 450, "Two mechanisms without friction: the energy should be constant",
    "coloured: preset paper, N follows the motion · black: preset steady, the default", [left.parts, right.parts]);
}

// ----------------------------------------------------------------------------------------------- N
function substeps() {
  const until = 90; // frames
  const [a, b] = [run("crank_rocker", paper(0.1)), run("crank_rocker", steady(0.1))];
  const points = (r) => [...r.n.slice(0, until).map((n, i) => [i / 60, n]), [until / 60, r.n[until - 1]]];
  const time = { label: "time [s]", from: 0, to: 1.5, ticks: [0, 0.25, 0.5, 0.75, 1, 1.25, 1.5] };
  const top = panel({ left: 72, top: 92, width: 700, height: 150, head: "sub-steps of a frame",
    x: { ...time, label: "" }, y: { label: "N", from: 0, to: 10, ticks: [0, 2, 4, 6, 8, 10], room: 40 } });
  top.steps(points(a), colours.red);
  top.steps(points(b), colours.black, { wide: 2.2 });
  top.label(1.5, 8, "steady", colours.black, { dx: 8 });
  top.label(1.5, a.n[until - 1], "paper", colours.red, { dx: 8 });
  const bottom = panel({ left: 72, top: 302, width: 700, height: 150, head: "change of the energy",
    x: time, y: { label: "[J]", from: -10, to: 50, ticks: [0, 10, 20, 30, 40, 50], room: 40 } });
  const energy = (r) => r.time.slice(0, until + 1).map((t, i) => [t, r.change[i]]);
  bottom.line(energy(a), colours.red);
  bottom.line(energy(b), colours.black, { wide: 2.2 });
  bottom.label(1.5, b.change[until], "steady", colours.black, { dx: 8 });
  bottom.label(1.5, a.change[until], "paper", colours.red, { dx: 8 });
  draw("substeps.svg", 850, 510, "N follows the motion, and the energy climbs with it",
    "crank_rocker, alpha 0.1; the crank turns once in 0.21 s, 12.6 frames", [top.parts, bottom.parts]);
}

// ---------------------------------------------------------------------------------------- three causes
function causes() {
  const rows = [];
  const all = [];
  for (const drift of ["full", "exact"]) {
    for (const hold of [1, 60]) {
      for (const redo of ["no-redo", "redo"]) {
        const cell = ["crank_rocker", "thrown_rope"].map((scene) =>
          run(scene, `--preset steady --drift ${drift} --hold ${hold} --${redo}`));
        const words = [drift, String(hold), redo === "redo" ? "on" : "off"];
        rows.push([...words, ...cell.flatMap((r) => [range(r), thousands(r.substeps)])]);
        all.push({ words, cell });
      }
    }
  }
  table("Causes", ["`drift`", "`hold`", "`redo`", "`crank_rocker` [J]", "sub-steps", "`thrown_rope` [J]", "sub-steps"], rows);

  const height = 8 * 36;
  const chart = panel({ left: 230, top: 92, width: 560, height,
    x: { label: "largest change of the energy, % of the largest kinetic energy of an exact motion (105 J; 125 J)",
      from: 0.1, to: 1000, ticks: [0.1, 1, 10, 100, 1000], log: true }, y: { from: 8, to: 0, ticks: [] } });
  const exact = [105, 125];
  for (const tick of [1, 10, 100]) {
    chart.raw(`<path d='M${Math.round(10 * chart.x(tick)) / 10} 92v${height}' stroke='#e3e7ed'/>`);
  }
  chart.text(60, 80, "joints", "note");
  chart.text(120, 80, "N falls", "note");
  chart.text(182, 80, "redo", "note");
  all.forEach(({ words: [drift, hold, redo], cell }, i) => {
    const y = chart.y(i + 0.5);
    chart.text(60, y + 4, drift === "full" ? "phi/h" : "exact");
    chart.text(120, y + 4, hold === "1" ? "at once" : "held");
    chart.text(182, y + 4, redo);
    const shares = cell.map((r, k) => 100 * Math.max(-r.low, r.high) / exact[k]);
    chart.line([[Math.min(...shares), i + 0.5], [Math.max(...shares), i + 0.5]], "#c3cad5", { wide: 2 });
    chart.dots([[shares[0], i + 0.5]], colours.red, "circle", 5);
    chart.dots([[shares[1], i + 0.5]], colours.blue, "square", 4.5);
    if (i === 4) chart.raw(`<path d='M60 ${Math.round(chart.y(4))}h730' stroke='#9aa3b2' stroke-dasharray='3 3'/>`);
  });
  chart.dots([[0.17, 0.5]], colours.red, "circle", 5);
  chart.label(0.17, 0.5, "crank_rocker, 20 s", colours.red, { dx: 12 });
  chart.dots([[0.17, 1.1]], colours.blue, "square", 4.5);
  chart.label(0.17, 1.1, "thrown_rope, 10 s", colours.blue, { dx: 12 });
  draw("causes.svg", 830, 450, "What joints, hold and redo do to the energy", "leapfrog, alpha 0.1; the last line is preset steady", chart.parts);
}

// ------------------------------------------------------------------------------------------------ order
function order() {
  const reference = run("crank_rocker", "--preset steady --mode const --n 4000", 1);
  const finer = run("crank_rocker", "--preset steady --mode const --n 8000", 1);
  const off = (r) => Math.hypot(r.place[0] - finer.place[0], r.place[1] - finer.place[1]);
  const list = [0.1, 0.025, 0.1 / 16, 0.1 / 64, 0.1 / 256, 0.1 / 1024];
  const kinds = [["paper", "paper"], ["steady with Euler", "steady --integrator euler"], ["steady", "steady"]];
  const errors = kinds.map(() => []);
  table("Order", ["alpha", ...kinds.flatMap(([words]) => [`${words} [mm]`, "sub-steps"])], list.map((alpha, i) =>
    [`0.1${i === 0 ? "" : `/${4 ** i}`}`, ...kinds.flatMap(([, preset], k) => {
      const r = run("crank_rocker", `--preset ${preset} --alpha ${alpha} --n-max 10000`, 1);
      errors[k].push([alpha, off(r)]);
      return [digits(1000 * off(r)), thousands(r.substeps)];
    })]));
  console.log(`The reference of 8,000 sub-steps a frame differs from that of 4,000 by ${off(reference).toExponential(1)} m.`);

  const chart = panel({ left: 80, top: 84, width: 560, height: 320,
    x: { label: "alpha (N grows as 1/√alpha)", from: 0.15, to: 0.00007, ticks: [0.1, 0.01, 0.001, 0.0001], log: true },
    y: { label: "distance from the exact path after 1 s [m]", from: 1e-6, to: 1, ticks: [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 1],
      log: true, text: power, room: 54 } });
  const slope = (from, to, at, p, words, dx, dy) => {
    chart.line([[from, at], [to, at * (to / from) ** p]], "#9aa3b2", { dash: "4 4", wide: 1.2 });
    chart.label(to, at * (to / from) ** p, words, colours.grey, { kind: "note", dx, dy });
  };
  slope(0.1, 0.0001, 2.5e-2, 0.5, "first order", -60, -14);
  slope(0.1, 0.0004, 6e-4, 1, "second order", -112, 4);
  [[colours.red, "circle"], [colours.purple, "ring"], [colours.black, "square"]].forEach(([colour, shape], k) => {
    chart.line(errors[k], colour, { wide: 2 });
    chart.dots(errors[k], colour, shape);
  });
  chart.label(...errors[0][2], "paper", colours.red, { dx: 10, dy: -6 });
  chart.label(...errors[1].at(-1), "steady, Euler", colours.purple, { dx: -84, dy: 26 });
  chart.label(...errors[2][3], "steady", colours.black, { dx: -52, dy: 18 });
  draw("order.svg", 680, 460, "The path of the rocker", "crank_rocker, 1 s, against 8,000 sub-steps a frame", chart.parts);
}

// ----------------------------------------------------------------------------------- the oscillator
/**
 * Leapfrog on x'' = -x with h^2 = h0^2 (1 - depth wave(phase, t)) in the middle of each step.
 * @returns [periods, energy relative to the start][], every half period
 */
function oscillate({ h0, depth, wave, periods }) {
  let [x, v, t] = [1, 0, 0];
  const energies = [[0, 1]];
  while (t < 2 * Math.PI * periods) {
    const phase = Math.atan2(-v, x);
    let h = h0;
    for (let i = 0; i < 4; ++i) h = h0 * Math.sqrt(1 - depth * wave(phase + 0.5 * h, t + 0.5 * h));
    const half = v - 0.5 * h * x;
    x += h * half;
    v = half - 0.5 * h * x;
    t += h;
    if (t > Math.PI * energies.length) energies.push([t / (2 * Math.PI), x * x + v * v]);
  }
  return energies;
}

function oscillator() {
  const [h0, depth, periods] = [0.2, 0.5, 40];
  const lagged = (lag) => (phase) => Math.cos(2 * (phase - 2 * Math.PI * lag));
  let seed = 1;
  const noise = Array.from({ length: 8 * (periods + 2) }, () => {
    seed = (seed * 48271) % 2147483647;
    return 2 * seed / 2147483647 - 1;
  });
  const random = (phase, t) => noise[Math.floor(8 * t / (2 * Math.PI))];
  const gain = (lag) => {
    const energies = oscillate({ h0, depth, wave: lagged(lag), periods });
    return 100 * Math.log(energies.at(-1)[1]) / energies.at(-1)[0];
  };
  const formula = (lag) => 100 * Math.PI / 4 * depth * h0 * h0 * Math.sin(4 * Math.PI * lag);
  table("Oscillator", ["lag [periods]", "gain of a period, measured [%]", "by the formula [%]"],
    [0, 1 / 16, 1 / 8, 1 / 4, 3 / 8].map((lag) => [digits(lag), signed(Math.round(1e3 * gain(lag)) / 1e3),
      signed(Math.round(1e3 * formula(lag)) / 1e3)]), false);

  const left = panel({ left: 72, top: 92, width: 360, height: 280, head: "energy at the turning points, E/E(0)",
    x: { label: "time [periods]", from: 0, to: 40, ticks: [0, 10, 20, 30, 40] },
    y: { label: "", from: 0.25, to: 2, ticks: [0.5, 1, 1.5, 2] } });
  for (const [words, wave, colour, dx, dy] of [["N late by 1/8 period", lagged(1 / 8), colours.red, -150, -2],
    ["N early by 1/8 period", lagged(-1 / 8), colours.blue, -140, 22], ["N at random", random, colours.purple, -86, 30],
    ["N in step", lagged(0), colours.black, -70, -10]]) {
    const energies = oscillate({ h0, depth, wave, periods });
    left.line(energies, colour, { wide: words === "N in step" ? 2.4 : 1.8 });
    left.label(...energies.at(-1), words, colour, { dx, dy });
  }
  const right = panel({ left: 520, top: 92, width: 320, height: 280, head: "gain of energy in a period [%]",
    x: { label: "lag of N behind x² [periods]", from: 0, to: 0.5, ticks: [0, 0.125, 0.25, 0.375, 0.5],
      text: (tick) => ({ 0: "0", 0.125: "1/8", 0.25: "1/4", 0.375: "3/8", 0.5: "1/2" })[tick] },
    y: { label: "", from: -2, to: 2, ticks: [-2, -1, 0, 1, 2] } });
  const lags = Array.from({ length: 65 }, (_, i) => i / 128);
  right.line(lags.map((lag) => [lag, formula(lag)]), colours.grey, { wide: 1.6 });
  right.dots(lags.filter((_, i) => i % 4 === 0).map((lag) => [lag, gain(lag)]), colours.red);
  right.label(0.125, formula(0.125), "line: formula; dots: measured", colours.grey, { dx: 14, dy: -8, kind: "note" });
  draw("oscillator.svg", 880, 430, "One oscillator, leapfrog: only the phase of N decides",
    "h² = h₀² (1 − cos 2ω(t − lag)/2), ω h₀ = 0.2: 26 to 44 steps in a period", [left.parts, right.parts]);
}

// --------------------------------------------------------------------------------- checks of formulas
/** The largest change of a quantity of x and the momentum of x'' = -x, with steps of 0.5. */
function kept(quantity, integrator) {
  const h = 0.5;
  let [x, p] = [1, 0.3];
  const begun = quantity(x, p, h);
  let largest = 0;
  for (let i = 0; i < 1e4; ++i) {
    if (integrator === "euler") {
      p -= h * x;
      x += h * p;
    } else {
      const half = p - 0.5 * h * x;
      x += h * half;
      p = half - 0.5 * h * x;
    }
    largest = Math.max(largest, Math.abs(quantity(x, p, h) / begun - 1));
  }
  return largest;
}

function formulas() {
  const euler = kept((x, p, h) => p * p / 2 + x * x / 2 - h / 2 * x * p, "euler");
  const leapfrog = kept((x, p, h) => p * p / 2 + (1 - h * h / 4) * x * x / 2, "leapfrog");
  console.log(`\nThe oscillator's shadow energies change by ${euler.toExponential(0)} (Euler) and ` +
    `${leapfrog.toExponential(0)} (leapfrog) in 10,000 steps.`);
  const of = planar("crank_rocker");
  // The same to rounding for any n if the shadow energy is complete to second order.
  table("Shadow", ["N, constant", "largest change of H [J]", "of the shadow energy [J]"], [8, 16, 32, 64].map((n) => {
    const h = 1 / (60 * n);
    let [q, v] = [of.q0, of.v0];
    const begun = of.energy(q, v);
    const shadowBegun = begun + h * h * shadow(of, q, v);
    let [plainly, shadowed] = [0, 0];
    for (let k = 1; k <= 60 * n; ++k) {
      [q, v] = of.steps.rattle(q, v, h);
      if (k % n !== 0) continue;
      const energy = of.energy(q, v);
      plainly = Math.max(plainly, Math.abs(energy - begun));
      shadowed = Math.max(shadowed, Math.abs(energy + h * h * shadow(of, q, v) - shadowBegun));
    }
    return [String(n), digits(plainly), digits(shadowed)];
  }));

  const free = planar("crank_rocker", 0);
  table("Loops", ["alpha", "exact joints, measured [J]", "by the formula [J]", "bias phi/h, measured [J]", "by the formula [J]"],
    [0.1, 0.1 / 4, 0.1 / 16, 0.1 / 64].map((alpha, i) => {
      let [loop, before, length] = [0, null, 0];
      const exact = runPlanar(free, { step: free.steps.rattle, alpha, seconds: 5, watch(q, v, h) {
        const now = shadow(free, q, v);
        if (before !== null) loop -= length * length * (now - before);
        [before, length] = [now, h];
      } });
      let [quarter, last, old] = [0, null, 0];
      const bias = runPlanar(free, { step: free.steps.bias, alpha, seconds: 5, watch(q, v, h) {
        const now = free.appell(q, v);
        if (last !== null) quarter += 0.25 * old * old * (now - last);
        [last, old] = [now, h];
      } });
      return [`0.1${i === 0 ? "" : `/${4 ** i}`}`, signed(exact.change), signed(loop), signed(bias.change), signed(quarter)];
    }));

  table("One change", ["h1", "h2", "measured [J]", "by the formula [J]"], [[32, 64], [128, 256], [64, 32], [256, 128]].map(([n1, n2]) => {
    const [h1, h2] = [1 / (60 * n1), 1 / (60 * n2)];
    let [q, v] = [free.q0, free.v0];
    for (let k = 0; k < 7 * n1; ++k) [q, v] = free.steps.bias(q, v, h1);
    const before = free.kinetic(v);
    const formula = 0.375 * (h1 * h1 - h2 * h2) * free.appell(q, v);
    for (let k = 0; k < 2; ++k) [q, v] = free.steps.bias(q, v, h2);
    return [`1/${60 * n1} s`, `1/${60 * n2} s`, signed(free.kinetic(v) - before), signed(formula)];
  }));

  table("Split", ["N, constant", "measured [J]", "by the formula [J]"], [16, 64, 256].map((n) => {
    let loss = 0;
    const r = runPlanar(free, { step: free.steps.split, n, seconds: 1, watch(q, v, h) {
      loss -= 0.5 * h * h * free.appell(q, v);
    } });
    return [String(n), signed(r.change), signed(loss)];
  }));

  table("Constant N", ["N, constant", "paper [J]", "exact joints, leapfrog [J]"], [4, 8, 16, 32, 64].map((n) => {
    const flags = `--mode const --n ${n}`;
    return [String(n), signed(run("crank_rocker", `--preset paper ${flags}`).end),
      range(run("crank_rocker", `--preset steady ${flags}`))];
  }));
}

// ------------------------------------------------------------------------------------- what was tried
function tried() {
  const duration = { crank_rocker: 20, thrown_rope: 5 };
  const adaptive = (step, options) => (of, alpha, time) =>
    runPlanar(of, { step: of.steps[step], alpha, seconds: time, ...options });
  const reversible = (step, control) => (of, alpha, time) =>
    runReversible(of, { step: of.steps[step], control, alpha, seconds: time });
  const rows = [];
  for (const [words, way] of [
    ["exact, hold and redo", adaptive("rattle", { hold: 60, redo: true })],
    ["exact, reversible, 1/h + 1/h_last = 2 rate", reversible("rattle", "verlet")],
    ["exact, reversible, integrated", reversible("rattle", "integral")],
    ["phi/h, hold and redo", adaptive("bias", { hold: 60, redo: true })],
    ["phi/h, reversible, integrated", reversible("bias", "integral")],
    ["split, hold and redo", adaptive("split", { hold: 60, redo: true })]]) {
    for (const alpha of [0.1, 0.02]) {
      rows.push([words, String(alpha), ...Object.entries(duration).flatMap(([scene, time]) => {
        const r = way(planar(scene), alpha, time);
        if (r.wanted && r.ended >= time) {
          console.log(`${words}, alpha ${alpha}, ${scene}: ${digits(r.rate)} steps a second at the end, ` +
            `asked for: ${digits(r.wanted)}`);
        }
        return [r.ended < time ? (r.ended > 0 ? `explodes at ${digits(r.ended)} s` : "explodes at once") : range(r), thousands(r.substeps)];
      })]);
    }
  }
  table("Tried", ["joints and steps", "alpha", "`crank_rocker`, 20 s [J]", "steps", "`thrown_rope`, 5 s [J]", "steps"], rows);

  table("Laws", ["instead of `drift: exact` and leapfrog", "`crank_rocker` [J]", "`thrown_rope` [J]"], ["--drift soft", "--drift full --drift-order 2",
    "--integrator stormer", "--solver newton --forces mean"].map((flags) =>
    [`\`${flags}\``, ...["crank_rocker", "thrown_rope"].map((scene) => range(run(scene, `--preset steady ${flags}`)))]));

  table("Hold", ["`hold`", "`crank_rocker` [J]", "sub-steps", "`thrown_rope` [J]", "sub-steps"], [1, 6, 12, 20, 60, 120].map((hold) =>
    [String(hold), ...["crank_rocker", "thrown_rope"].flatMap((scene) => {
      const r = run(scene, `--preset steady --hold ${hold}`);
      return [range(r), thousands(r.substeps)];
    })]));
}

problem();
substeps();
causes();
order();
oscillator();
formulas();
tried();
const s = run("crank_rocker", steady(0.1));
console.log(`\ncrank_rocker, steady: ${digits(s.factorisations / s.solves)} solves in a sub-step, ` +
  `${s.again} frames taken again; thrown_rope: ${run("thrown_rope", steady(0.1)).again}; with Euler and without ` +
  `redo: ${range(run("thrown_rope", "--preset steady --integrator euler --no-redo"))} J`);
if (outdated.length > 0) {
  console.error(`\nThese tables of core/docs/energy.md are outdated: ${outdated.join(", ")}. Replace them by the above.`);
  process.exit(1);
}

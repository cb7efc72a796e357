// Pictures 2 to 4: curves over time, the stability map, and the cost breakdown.
import * as Plot from "@observablehq/plot";
import { choice, el, figure, number } from "./dom.mjs";
import { colour, styleOf } from "./style.mjs";

const tones = ["blue", "orange", "teal", "purple", "amber", "grey"];

// chart: {title, note, x, y, log, curves: [{name, dashed, points: [[x, y], ...]}]}
export function timeChart(chart, index) {
  const rows = chart.curves.flatMap(c => c.points.map(([x, y]) => ({ curve: c.name, x, y })));
  const tone = i => colour(tones[i % tones.length]);
  const dashed = (c, i) => c.dashed || i >= tones.length; // a repeated colour
  const ys = rows.map(r => r.y);
  const fromZero = Math.min(...ys) < 0.5 * Math.max(...ys); // otherwise the curves would look flat
  const draw = width => [
    Plot.plot({
      width, height: Math.min(360, 0.45 * width + 60), marginLeft: 64, marginBottom: 44, marginTop: 28, marginRight: 20,
      style: { background: "transparent", color: "inherit", fontSize: "12px" },
      x: { label: chart.x + " →", labelAnchor: "center", labelOffset: 38 },
      y: { label: "↑ " + chart.y, type: chart.log ? "log" : "linear", grid: true, tickFormat: number, zero: !chart.log && fromZero, labelOffset: 58 },
      marks: [
        ...chart.curves.map((c, i) => Plot.line(c.points.filter(([, y]) => !chart.log || y > 0), { x: d => d[0], y: d => d[1], stroke: tone(i), strokeWidth: 1.6, strokeDasharray: dashed(c, i) ? "6 4" : undefined, curve: c.step ? "step-after" : "linear" })),
        ...chart.curves.map((c, i) => (c.failed_at === undefined ? null : Plot.dot([c.points[c.points.length - 1]], { x: d => d[0], y: d => d[1], symbol: "times", r: 6, strokeWidth: 2.4, stroke: tone(i) }))),
        Plot.ruleX(rows, Plot.pointerX({ x: "x", stroke: colour("dim"), strokeOpacity: 0.4 })),
        Plot.tip(rows, Plot.pointer({ x: "x", y: "y", title: d => `${d.curve}\n${number(d.x)} ${chart.x}\n${number(d.y)} ${chart.y}`, fill: colour("raised"), stroke: colour("border"), fontSize: 12 })),
      ],
    }),
    el("div", { class: "legend" }, ...chart.curves.map((c, i) => el("span", { class: "key" },
      el("i", { class: "line", style: `border-top: 2px ${dashed(c, i) ? "dashed" : "solid"} ${tone(i)}` }), el("span", {}, c.name),
      c.note && el("small", {}, c.note)))),
  ];
  return figure(chart.title, chart.note, { name: `chart-${index + 1}`, draw, data: () => rows });
}

// Survival over the mass ratio and a parameter.
export function stabilityMap(results, massRatio, select) {
  const loads = [...new Set(results.map(r => r.load ?? 1))].sort((a, b) => a - b);
  if (loads.length < 3) return null;
  const modes = [...new Set(results.filter(r => (r.load ?? 1) !== 1).map(r => r.series))];
  const draw = width => modes.flatMap(series => {
    const own = results.filter(r => r.series === series && results.some(q => q.series === series && (q.load ?? 1) !== 1 && q.parameter.value === r.parameter.value));
    const name = own[0].parameter.name;
    const life = r => (r.holds ? 1 : r.failed_at / r.seconds);
    const plot = Plot.plot({
      width: Math.min(width, 760), height: 90 + 30 * new Set(own.map(r => r.parameter.value)).size,
      marginLeft: 64, marginTop: 34, marginBottom: 44,
      style: { background: "transparent", color: "inherit", fontSize: "12px" },
      x: { type: "band", domain: loads, label: "mass ratio, heaviest to lightest →", labelAnchor: "center", labelOffset: 38, tickFormat: l => number(l * massRatio) },
      y: { type: "band", label: `${styleOf(series).name}: ${name}`, reverse: name !== "alpha", tickFormat: number, labelOffset: 58 },
      marks: [
        Plot.cell(own, { x: r => r.load ?? 1, y: r => r.parameter.value, fill: r => colour(r.holds ? "blue" : "orange"), inset: 1, rx: 3, fillOpacity: r => (r.holds ? 0.75 : 0.65 - 0.45 * life(r)) }),
        Plot.text(own, { x: r => r.load ?? 1, y: r => r.parameter.value, text: r => (r.holds ? "holds" : `${r.failed_at.toFixed(2)} s`), fill: colour("onCell"), fontWeight: 500 }),
        Plot.tip(own, Plot.pointer({ x: r => r.load ?? 1, y: r => r.parameter.value, title: r => `${styleOf(series).name}\n${name} = ${number(r.parameter.value)}, mass ratio ${number((r.load ?? 1) * massRatio)}\n${r.verdict}`, fill: colour("raised"), stroke: colour("border"), fontSize: 12 })),
      ],
    });
    plot.addEventListener("click", () => plot.value && select(plot.value));
    return [plot];
  });
  return figure("Where it holds",
    "The mass of the heaviest body is varied. Cells show how long the run survived, paler is longer; blue ones hold to the end. Click a cell for its command.",
    { name: "stability-map", draw, data: () => results.filter(r => modes.includes(r.series)).map(r => ({ series: r.series, mass_ratio: (r.load ?? 1) * massRatio, parameter: r.parameter.name, value: r.parameter.value, verdict: r.verdict })) });
}

const stages = [
  ["joints", "joint rows", "orange"], ["contact", "contact detection and rows", "amber"], ["friction", "friction rows", "purple"],
  ["mass", "forces and mass matrix", "grey"], ["solve", "solve", "blue"], ["stiffness", "stiffness: the criterion", "teal"],
  ["integrate", "integrate", "dim"],
];

// One representative run of each method, the time of its sub-steps by stage.
export function timeByStage(results) {
  const usual = { alpha: 0.1, n: 16, n_cap: 4 };
  const runs = [...new Set(results.map(r => r.series))].map(s =>
    results.filter(r => r.series === s && r.holds && (r.load ?? 1) === 1)
      .sort((a, b) => Math.abs(Math.log(a.parameter.value / usual[a.parameter.name])) - Math.abs(Math.log(b.parameter.value / usual[b.parameter.name])))[0]).filter(Boolean);
  const bars = runs.flatMap(r => stages.map(([key, label, tone]) => ({
    method: `${styleOf(r.series).name}, ${r.parameter.name} ${number(r.parameter.value)}`,
    stage: label, tone, us: 1e6 * r.timing.stages[key] / r.work.substeps,
    share: r.timing.stages[key] / r.timing.stages.total,
  }))).filter(b => b.us > 0);
  if (bars.length === 0) return null;
  const present = stages.filter(([, label]) => bars.some(b => b.stage === label));
  const draw = width => [
    Plot.plot({
      width, height: 70 + 30 * runs.length, marginLeft: Math.min(270, 0.42 * width), marginBottom: 44, marginRight: 24,
      style: { background: "transparent", color: "inherit", fontSize: "12px" },
      x: { label: "time of a sub-step by stage [µs] →", labelAnchor: "center", labelOffset: 38, grid: true },
      y: { label: null, domain: [...new Set(bars.map(b => b.method))] },
      marks: [
        Plot.barX(bars, Plot.stackX({ y: "method", x: "us", fill: b => colour(b.tone), order: present.map(([, label]) => label), z: "stage", insetTop: 3, insetBottom: 3, rx: 1 })),
        Plot.tip(bars, Plot.pointer(Plot.stackX({ y: "method", x: "us", z: "stage", order: present.map(([, label]) => label), title: b => `${b.method}\n${b.stage}: ${number(b.us)} µs, ${(100 * b.share).toFixed(0)} % of the frame`, fill: colour("raised"), stroke: colour("border"), fontSize: 12 }))),
      ],
    }),
    el("div", { class: "legend" }, ...present.map(([, label, tone]) => el("span", { class: "key" }, el("i", { class: "box", style: `background: var(--${tone})` }), label))),
  ];
  return figure("Where the time goes",
    "Stages that the scene does not need take no time. The criterion is the evaluation of the geometric stiffness, once per frame or once per sub-step.",
    { name: "stages", draw, data: () => bars.map(({ method, stage, us, share }) => ({ method, stage, us, share })) });
}

// The cost of each effect in a frame, and of choosing the sub-steps, for each solver.
const units = [
  { key: "flops", label: "solver operations per frame" },
  { key: "ms", label: "median time per frame [ms], this machine" },
];
export function effectCosts(costs) {
  if (!costs || costs.length === 0) return null;
  const solver = c => styleOf(c.series).name.includes("PGS") ? "Gauss-Seidel" : "direct solver";
  const bars = costs.flatMap(c => [
    ...Object.entries(c.effects).map(([effect, cost]) => ({ solver: solver(c), part: effect, tone: "blue", flops: cost.flops, ms: cost.ms })),
    { solver: solver(c), part: "criterion: K, r, N", tone: "teal", flops: c.work.criterion.flops / c.work.frames, ms: 1e3 * c.timing.stages.stiffness / c.work.frames },
  ]);
  let unit = units[0];
  const parts = [...new Set(bars.map(b => b.part))];
  const channels = () => ({ fy: "solver", y: "part", x: unit.key });
  const draw = width => [
    Plot.plot({
      width, height: 60 + costs.length * (24 + 28 * parts.length), marginLeft: 130, marginBottom: 44, marginRight: 90,
      style: { background: "transparent", color: "inherit", fontSize: "12px" },
      x: { label: unit.label + " →", labelAnchor: "center", labelOffset: 38, grid: true, tickFormat: number, ticks: Math.max(3, width / 140) },
      y: { label: null, domain: parts }, fy: { label: null, domain: costs.map(solver) },
      marks: [
        Plot.barX(bars, { ...channels(), fill: b => colour(b.tone), insetTop: 3, insetBottom: 3, rx: 1 }),
        Plot.ruleX([0], { stroke: colour("dim") }),
        Plot.tip(bars, Plot.pointer({ ...channels(), title: b => `${b.part}, ${b.solver}\n${number(b.flops)} operations per frame\n${number(b.ms)} ms per frame`, fill: colour("raised"), stroke: colour("border"), fontSize: 12 })),
      ],
    }),
    rowTable(costs, solver),
  ];
  const fig = figure("What each effect costs",
    "Every frame is stepped again from the same state without the effect, with the same number of sub-steps; the difference is the cost of the effect. The criterion is K, its column norms and r, from which N follows.",
    { name: "effects", draw, data: () => bars.map(({ solver, part, flops, ms }) => ({ solver, part, flops, ms })),
      controls: [choice("cost", units, unit.key, key => { unit = units.find(u => u.key === key); fig.redraw(); })] });
  return fig;
}

// Rows of a solve by kind, and how often Gauss-Seidel updated them.
function rowTable(costs, solver) {
  const kinds = [["joint", "joint rows"], ["contact", "contact normals"], ["friction", "friction rows"]]
    .filter(([key]) => costs.some(c => c.work.rows[key] > 0));
  const all = c => kinds.reduce((sum, [key]) => sum + c.work.rows[key], 0);
  return el("div", { class: "scroll" }, el("table", {},
    el("thead", {}, el("tr", {}, el("th", {}, "rows of a solve"), ...kinds.map(([, label]) => el("th", {}, label)))),
    el("tbody", {}, ...costs.map(c => el("tr", {}, el("th", { scope: "row" }, solver(c)),
      ...kinds.map(([key]) => el("td", {}, number(c.work.rows[key] / c.work.solves),
        c.work.row_updates > 0 && el("small", {}, `, ${number(c.work.row_updates / c.work.frames * c.work.rows[key] / all(c))} updates per frame`))))))));
}

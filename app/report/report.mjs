// The report of a sweep or of the reproduction: reads the data embedded in the page and draws them.
import { el, number, save } from "./dom.mjs";
import { effectCosts, stabilityMap, timeByStage, timeChart } from "./pictures.mjs";
import { priceTable, workPrecision } from "./precision.mjs";

const data = JSON.parse(document.getElementById("data").textContent);
const root = document.getElementById("report");
const figures = [];
const add = fig => {
  if (!fig) return;
  if (fig instanceof Node) { root.append(fig); return; }
  root.append(fig.node);
  figures.push(fig);
};
const redrawAll = () => figures.forEach(fig => fig.redraw());

// One run in detail: its settings, its results, and the command that repeats it.
const details = el("aside", { class: "details", hidden: true, "aria-live": "polite" });
function select(r) {
  const rows = Object.entries({
    verdict: r.verdict, "sub-steps": r.work.substeps, "per frame": `${r.work.n_min} / ${r.work.n_median} / ${r.work.n_max}`,
    "row updates": r.work.row_updates, "solver operations": r.work.flops, "ms per frame": `${number(r.timing.ms_median)} (p95 ${number(r.timing.ms_p95)})`,
    "trajectory error [m]": number(r.errors.trajectory_peak), "energy drift [%]": number(r.errors.energy_drift_percent),
    "joint gap [m]": number(r.errors.joint_gap?.peak), "state hash": r.hash, "experiment": r.id,
  });
  details.hidden = false;
  details.replaceChildren(
    el("button", { class: "close", "aria-label": "close", onclick: () => { details.hidden = true; } }, "×"),
    el("h3", {}, `${r.series}, ${r.parameter.name} = ${number(r.parameter.value)}`),
    r.command ? el("code", {}, r.command) : "",
    r.command ? el("button", { onclick: event => navigator.clipboard?.writeText(r.command).then(() => { event.target.textContent = "copied"; }) }, "copy command") : "",
    el("dl", {}, ...rows.flatMap(([key, value]) => [el("dt", {}, key), el("dd", {}, String(value ?? "–"))])));
}

function card(c) {
  return el("section", { class: `claim ${c.verdict}` },
    el("h2", {}, c.title),
    el("div", { class: "sides" },
      el("div", {}, el("h3", {}, "The paper"), el("p", {}, c.paper)),
      el("div", {}, el("h3", {}, "Here"), el("p", {}, c.here))),
    c.why ? el("p", { class: "why" }, el("b", {}, c.verdict === "agrees" ? "Note. " : "Why they differ. "), c.why) : "",
    c.command ? el("p", {}, el("code", {}, c.command)) : "",
    el("p", { class: "stamp" }, { agrees: "agrees", differs: "differs for a known reason", fails: "not reproduced" }[c.verdict] ?? c.verdict));
}

const theme = el("button", { onclick: () => {
  const dark = document.documentElement.dataset.theme
    ? document.documentElement.dataset.theme === "dark"
    : matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = dark ? "light" : "dark";
  redrawAll();
} }, "light / dark");

document.title = data.title;
root.append(el("header", {},
  el("div", { class: "bar" }, el("h1", {}, data.title), el("span", { class: "grow" }), theme,
    el("button", { onclick: () => save("results.json", "application/json", JSON.stringify(data.results ?? data.charts, null, 1)) }, "all data")),
  ...(data.about ?? []).map(text => el("p", {}, text))));

const results = data.results ?? [];
const plain = results.filter(r => (r.load ?? 1) === 1);
if (plain.length > 0) {
  add(workPrecision(plain, data.reference, select));
  root.append(details);
  add(priceTable(plain));
}
for (const [i, chart] of (data.charts ?? []).entries()) if (chart.card === undefined) add(timeChart(chart, i));
for (const [i, c] of (data.cards ?? []).entries()) {
  add(card(c));
  for (const [j, chart] of (data.charts ?? []).entries()) if (chart.card === i) add(timeChart(chart, j));
}
if (results.length > 0) {
  add(stabilityMap(results, data.mass_ratio ?? 1, select));
  add(timeByStage(results));
  add(effectCosts(data.costs));
}
root.append(el("footer", {}, ...(data.settings ?? []).map(text => el("p", {}, text))));
redrawAll();
let last = innerWidth;
addEventListener("resize", () => { if (innerWidth !== last) { last = innerWidth; redrawAll(); } });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redrawAll);

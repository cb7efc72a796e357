// Picture 1: error against cost, both logarithmic; one curve per method along its own parameter.
import * as Plot from "@observablehq/plot";
import { available, costs, errors, positive } from "./axes.mjs";
import { choice, el, figure, number } from "./dom.mjs";
import { isOrder, observedOrder } from "./order.mjs";
import { paretoFront } from "./pareto.mjs";
import { colour, styleOf, swatchText } from "./style.mjs";

const swatch = style => document.createRange().createContextualFragment(swatchText(style));

// A reference slope of this order through the first run of a series that holds.
function orderGuide(points, order, low) {
  const first = points.reduce((a, p) => (p.cost < a.cost ? p : a), points[0]);
  const error = 0.6 * first.error;
  const end = Math.min(Math.max(...points.map(p => p.cost)), first.cost * (error / low) ** (1 / order));
  return [first.cost, end].map(cost => ({ cost, error: error * (first.cost / cost) ** order }));
}

const parameter = r => `${r.parameter.name} = ${number(r.parameter.value)}`;

function readOut(r, x, y) {
  const lines = [`${styleOf(r.series).name}, ${parameter(r)}`];
  if (!r.holds) lines.push(r.verdict);
  else lines.push(`error ${number(y.of(r))}   ${y.label}`);
  lines.push(`cost ${number(x.of(r))}   ${x.label}`);
  return lines.join("\n");
}

export function workPrecision(results, reference, select) {
  const xs = available(costs, results), ys = available(errors, results);
  if (xs.length === 0 || ys.length === 0) return null;
  const series = [...new Set(results.map(r => r.series))];
  const shown = new Set(series);
  let x = xs[0], y = ys[0];
  let hovered = null;

  const visible = () => results.filter(r => shown.has(r.series));
  const points = list => list.filter(r => r.holds && positive(x.of(r)) && positive(y.of(r)))
    .map(r => ({ r, cost: x.of(r), error: y.of(r), series: r.series }));

  function draw(width) {
    const held = points(visible());
    const failed = visible().filter(r => !r.holds && positive(x.of(r)));
    const front = paretoFront(held);
    const faded = p => hovered && (p.series ?? p.r.series) !== hovered;
    const decades = { ticks: 6, strokeOpacity: 0.12 };
    const marks = [Plot.gridX(decades), Plot.gridY(decades)];
    const losers = series.filter(s => failed.some(r => r.series === s)); // one line of the rail each
    const height = Math.max(380, Math.min(600, 0.6 * width)) + 10 * losers.length;
    const marginTop = 40 + 10 * losers.length, marginBottom = 48;
    const limit = reference?.uncertainty ?? 0;
    const showLimit = y.key === "trajectory" && limit > 0 && held.some(p => p.error < 30 * limit);
    const values = held.map(p => p.error).concat(showLimit ? [limit] : []);
    const [low, high] = [Math.min(...values) / 1.4, Math.max(...values) * 1.4];
    // The rail is above the frame, at errors beyond the scale.
    const rail = r => high * (high / low) ** ((16 + 10 * losers.indexOf(r.series)) / (height - marginTop - marginBottom));
    if (front.length > 1) {
      marks.push(Plot.line(front, { x: "cost", y: "error", stroke: colour("front"), strokeWidth: 9, strokeLinecap: "round", strokeLinejoin: "round", curve: "step-after" }));
    }
    if (showLimit) {
      marks.push(Plot.ruleY([limit], { stroke: colour("dim"), strokeDasharray: "2 4" }),
        Plot.text([limit], { y: d => d, frameAnchor: "left", dx: 6, text: () => "uncertainty of the reference", dy: -7, textAnchor: "start", fill: colour("dim") }));
    }
    if (x.key === "substeps" && ["trajectory", "final"].includes(y.key)) {
      for (const [s, order] of [["bpp, const, euler", 1], ["bpp, const, leapfrog", 2]]) {
        const own = held.filter(p => p.series === s);
        if (own.length < 3) continue;
        const guide = orderGuide(own, order, 1.25 * low);
        marks.push(Plot.line(guide, { x: "cost", y: "error", stroke: colour("dim"), strokeDasharray: "1 4", clip: true }),
          // Below the line, or beside its end if it leaves the frame at the bottom.
          Plot.text([guide[1]], { x: "cost", y: "error", text: () => `order ${order}`, fill: colour("dim"), ...(guide[1].error < 2 * low ? { dx: 6, dy: -5, textAnchor: "start" } : { dx: -8, dy: 12, textAnchor: "end" }), clip: true }));
      }
    }
    for (const s of series.filter(s => shown.has(s))) {
      const style = styleOf(s), c = colour(style.token);
      const own = held.filter(p => p.series === s).sort((a, b) => a.r.parameter.value - b.r.parameter.value);
      const opacity = hovered && hovered !== s ? 0.18 : 1;
      marks.push(Plot.line(own, { x: "cost", y: "error", stroke: c, strokeWidth: 1.6, strokeOpacity: opacity, strokeDasharray: style.dashed ? "6 4" : undefined }));
      marks.push(Plot.dot(own, { x: "cost", y: "error", symbol: style.symbol, r: 4.2, stroke: c, fill: style.hollow ? colour("ground") : c, strokeWidth: 1.6, opacity }));
    }
    for (const s of losers) {
      const own = failed.filter(r => r.series === s), style = styleOf(s);
      const look = { x: r => x.of(r), y: rail, opacity: faded(own[0]) ? 0.18 : 1 };
      marks.push(Plot.dot(own, { ...look, symbol: "times", r: 3.6, strokeWidth: style.dashed ? 1.2 : 2.2, stroke: colour(style.token) }));
    }
    marks.push(Plot.tip(held, Plot.pointer({ x: "cost", y: "error", title: p => readOut(p.r, x, y), fill: colour("raised"), stroke: colour("border"), maxRadius: 30, fontSize: 12, lineHeight: 1.3 })));
    marks.push(Plot.tip(failed, Plot.pointer({ x: r => x.of(r), y: rail, title: r => readOut(r, x, y), fill: colour("raised"), stroke: colour("border"), maxRadius: 12, fontSize: 12, lineHeight: 1.3, anchor: "top" })));
    const plot = Plot.plot({
      width, height, marginLeft: 64, marginTop, marginRight: 22, marginBottom,
      style: { background: "transparent", color: "inherit", fontSize: "12px", overflow: "visible" },
      x: { type: "log", label: x.label + " →", labelAnchor: "center", labelOffset: 40, ticks: 6, tickFormat: number },
      y: { type: "log", domain: [low, high], label: "↑ " + y.label, ticks: 7, tickFormat: number, labelOffset: 58 },
      marks,
    });
    plot.setAttribute("role", "img");
    plot.setAttribute("aria-label", `${y.label} against ${x.label}`);
    plot.addEventListener("click", () => { const v = plot.value; if (v) select(v.r ?? v); });
    const sign = losers.length > 0 && el("div", { class: "rail", style: `top:${22 + 5 * losers.length}px` }, "fails ×");
    return [sign || "", plot, legend()];
  }

  function legend() {
    return el("div", { class: "legend" }, ...series.map(s => {
      const own = results.filter(r => r.series === s);
      const lost = own.filter(r => !r.holds).length;
      const { order, floor } = observedOrder(points(own), y.key === "trajectory" ? reference?.uncertainty ?? 0 : 0);
      return el("button", {
        class: "key", "aria-pressed": String(shown.has(s)),
        title: isOrder(order) && floor > 0 ? `Order of the error above ${number(floor)} m, which is within the uncertainty of the reference` : undefined,
        onclick: () => { if (!shown.delete(s)) shown.add(s); redraw(); },
        onmouseenter: () => { hovered = s; redrawPlot(); },
        onmouseleave: () => { hovered = null; redrawPlot(); },
      }, swatch(styleOf(s)), el("span", {}, styleOf(s).name),
        el("small", {}, [`${own.length - lost} of ${own.length} hold`, !isOrder(order) ? "" : `order ${order.toFixed(2)}`].filter(Boolean).join(", ")));
    }));
  }

  const fig = figure("Error against cost",
    "One curve per method along its own parameter. The broad band is the Pareto front: runs that no other run dominates. Crosses on the rail are failed runs. Click a point for its settings and its command; click a name to hide it.",
    {
      name: "work-precision",
      draw,
      data: () => visible().map(r => ({ series: r.series, [r.parameter.name]: r.parameter.value, id: r.id, verdict: r.verdict, [x.label]: x.of(r), [y.label]: r.holds ? y.of(r) : "" })
      ).map(row => ({ series: row.series, parameter: Object.keys(row)[1], value: Object.values(row)[1], ...row })),
      controls: [
        choice("error", ys, y.key, key => { y = ys.find(a => a.key === key); redraw(); }),
        choice("cost", xs, x.key, key => { x = xs.find(a => a.key === key); redraw(); }),
      ],
    });
  const redraw = () => fig.redraw();
  // Redraw only the chart: a legend entry under the pointer must not be replaced.
  const redrawPlot = () => {
    const body = fig.node.querySelector(".picture");
    const [, plot] = draw(Math.max(320, Math.min(1100, body.clientWidth)));
    body.querySelector("svg:not(.swatch)").replaceWith(plot);
  };
  return fig;
}

// The cheapest run of every method below each power of ten of the error.
export function priceTable(results) {
  const y = available(errors, results)[0];
  if (!y) return null;
  const held = results.filter(r => r.holds && positive(y.of(r)));
  const smallest = Math.min(...held.map(y.of)), largest = Math.max(...held.map(y.of));
  const limits = [];
  for (let e = Math.ceil(Math.log10(largest)); e >= Math.floor(Math.log10(smallest)) + 1 && limits.length < 7; --e) limits.push(10 ** e);
  const rows = [...new Set(results.map(r => r.series))].map(s => [s, limits.map(limit => {
    const good = held.filter(r => r.series === s && y.of(r) <= limit);
    return good.sort((a, b) => a.work.flops / a.work.frames - b.work.flops / b.work.frames)[0];
  })]);
  const best = limits.map((_, i) => Math.min(...rows.map(([, cells]) => (cells[i] ? cells[i].timing.ms_median : Infinity))));
  return el("section", { class: "figure" },
    el("h2", {}, "Cost of an error"),
    el("p", { class: "note" }, `The cheapest run of each method whose ${y.label.replace(/ \[.*/, "")} stays below the limit: its parameter and the median milliseconds per frame. The cheapest in each column is marked.`),
    el("div", { class: "scroll" }, el("table", {},
      el("thead", {}, el("tr", {}, el("th", {}, "method"), ...limits.map(l => el("th", {}, `≤ ${number(l)} ${/\[(.*)\]/.exec(y.label)?.[1] ?? ""}`)))),
      el("tbody", {}, ...rows.map(([s, cells]) => el("tr", {},
        el("th", { scope: "row" }, styleOf(s).name),
        ...cells.map((r, i) => el("td", { class: r && r.timing.ms_median === best[i] ? "best" : undefined },
          r ? [el("b", {}, number(r.timing.ms_median)), el("small", {}, ` ms, ${r.parameter.name} ${number(r.parameter.value)}`)] : "–"))))))));
}

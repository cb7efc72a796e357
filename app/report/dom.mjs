// Small helpers for the page: elements, number formatting, file downloads.

export function el(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else if (value !== undefined && value !== false) node.setAttribute(key, value === true ? "" : value);
  }
  node.append(...children.flat().filter(child => child !== undefined && child !== null && child !== false));
  return node;
}

// Three digits, with an SI prefix if it shortens the text.
export function number(x) {
  if (x === undefined || x === null || Number.isNaN(x)) return "–";
  if (x === 0) return "0";
  const size = Math.abs(x);
  if (size >= 1e5 || size < 1e-3) {
    const [mantissa, exponent] = x.toExponential(2).split("e");
    const digits = String(Number(exponent)).replace("-", "−");
    const power = `10${[...digits].map(c => "⁰¹²³⁴⁵⁶⁷⁸⁹"["0123456789".indexOf(c)] ?? "⁻").join("")}`;
    if (Number(mantissa) === 1) return power;
    return `${Number(mantissa)}·${power}`;
  }
  return String(Number(x.toPrecision(3)));
}

export function save(name, type, content) {
  const url = URL.createObjectURL(new Blob([content], { type }));
  el("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

// The picture as a standalone file: colours are resolved, the background is filled.
export function svgText(svg) {
  const copy = svg.cloneNode(true);
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  const style = getComputedStyle(svg);
  copy.setAttribute("style", `background:${getComputedStyle(document.body).backgroundColor};color:${style.color};font:${style.font}`);
  for (const [from, to] of pairs(svg, copy)) {
    const css = getComputedStyle(from);
    for (const key of ["fill", "stroke", "color"]) {
      if (from.getAttribute(key)?.match(/var\(|currentColor/)) to.setAttribute(key, css[key]);
    }
  }
  return new XMLSerializer().serializeToString(copy);
}
const pairs = (a, b) => [...a.querySelectorAll("*")].map((node, i) => [node, b.querySelectorAll("*")[i]]);

export async function savePng(name, svg) {
  const { width, height } = svg.viewBox.baseVal;
  const image = new Image();
  const url = URL.createObjectURL(new Blob([svgText(svg)], { type: "image/svg+xml" }));
  await new Promise((resolve, reject) => { image.onload = resolve; image.onerror = reject; image.src = url; });
  const canvas = el("canvas", { width: 2 * width, height: 2 * height });
  const context = canvas.getContext("2d");
  context.fillStyle = getComputedStyle(document.body).backgroundColor;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(image, 0, 0, canvas.width, canvas.height);
  URL.revokeObjectURL(url);
  canvas.toBlob(blob => save(name, "image/png", blob));
}

export function csv(rows) {
  if (rows.length === 0) return "";
  const keys = Object.keys(rows[0]);
  const cell = x => (/[",\n]/.test(String(x ?? "")) ? `"${String(x).replaceAll('"', '""')}"` : String(x ?? ""));
  return [keys.join(","), ...rows.map(row => keys.map(key => cell(row[key])).join(","))].join("\n") + "\n";
}

// A picture with its caption and the buttons that save it.
export function figure(title, note, { draw, data, name, controls = [] }) {
  const body = el("div", { class: "picture" });
  const svg = () => body.querySelector("svg:not(.swatch)");
  const redraw = () => body.replaceChildren(...[draw(Math.max(320, Math.min(1100, body.clientWidth || 900)))].flat());
  const node = el("section", { class: "figure" },
    el("h2", {}, title),
    note && el("p", { class: "note" }, note),
    el("div", { class: "bar" }, ...controls, el("span", { class: "grow" }),
      el("button", { onclick: () => save(`${name}.svg`, "image/svg+xml", svgText(svg())) }, "SVG"),
      el("button", { onclick: () => savePng(`${name}.png`, svg()) }, "PNG"),
      el("button", { onclick: () => save(`${name}.csv`, "text/csv", csv(data())) }, "CSV")),
    body);
  return { node, redraw };
}

export const choice = (label, options, value, onchange) =>
  el("label", {}, label, " ", el("select", { onchange: event => onchange(event.target.value) },
    ...options.map(o => el("option", { value: o.key, selected: o.key === value }, o.label))));

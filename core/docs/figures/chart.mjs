// Line charts as SVG, on a light ground and in colours that the colour-blind can tell apart (Okabe and
// Ito). Coordinates are rounded to 0.1, so that a picture is the same on every machine.

export const colours = { blue: "#0072b2", red: "#d55e00", green: "#00795a", purple: "#a8568a", sky: "#3a9bd9",
  grey: "#667080", black: "#161b24" };

const escape = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;");
const round = (x) => String(Math.round(10 * x) / 10);
const superscript = (n) => String(n).replace("-", "⁻").replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]);

/** A power of ten as text. */
export const power = (x) => `10${superscript(Math.round(Math.log10(x)))}`;

/** A number without an exponent, with a true minus sign. */
export const plain = (x) => String(x).replace("-", "−");

/** A whole picture. @param parts of its panels */
export const picture = (width, height, title, note, parts) => `<svg xmlns='http://www.w3.org/2000/svg' \
viewBox='0 0 ${width} ${height}' width='${width}' height='${height}'>
<style>text{font:12px system-ui,'Segoe UI',Roboto,Helvetica,Arial,sans-serif;fill:#161b24}.title{font-size:16px;\
font-weight:600}.head{font-size:13px;font-weight:600}.note,.tick{fill:#556072}.middle{text-anchor:middle}\
.end{text-anchor:end}.label{font-weight:600}</style>
<rect width='100%' height='100%' fill='#ffffff'/>
<text x='20' y='28' class='title'>${escape(title)}</text>
<text x='20' y='48' class='note'>${escape(note)}</text>
${parts.flat(Infinity).join("\n")}
</svg>
`;

/**
 * A panel with axes. An axis is {label, from, to, ticks, log, text}: text formats a tick.
 * @returns {parts, x(), y(), line(), dots(), label(), note()}: functions that add to parts
 */
export function panel({ left, top, width, height, head, x: across, y: up }) {
  const place = ({ from, to, log }, start, length) => {
    const scale = log ? Math.log10 : (value) => value;
    return (value) => start + length * (scale(value) - scale(from)) / (scale(to) - scale(from));
  };
  const x = place(across, left, width);
  const y = place(up, top + height, -height);
  const text = (px, py, words, kind = "", style = "") =>
    `<text x='${round(px)}' y='${round(py)}'${kind ? ` class='${kind}'` : ""}${style ? ` style='${style}'` : ""}>` +
    `${escape(words)}</text>`;
  const parts = [];
  if (head) parts.push(text(left, top - 12, head, "head"));
  for (const tick of up.ticks) {
    const strong = tick === 0 && !up.log;
    parts.push(`<path d='M${round(left)} ${round(y(tick))}h${round(width)}' stroke='${strong ? "#9aa3b2" : "#e3e7ed"}'/>`,
      text(left - 8, y(tick) + 4, (up.text ?? plain)(tick), "tick end"));
  }
  for (const tick of across.ticks) {
    parts.push(`<path d='M${round(x(tick))} ${round(top + height)}v5' stroke='#9aa3b2'/>`,
      text(x(tick), top + height + 19, (across.text ?? plain)(tick), "tick middle"));
  }
  parts.push(`<path d='M${round(left)} ${round(top)}v${round(height)}h${round(width)}' fill='none' stroke='#9aa3b2'/>`,
    text(left + width / 2, top + height + 38, across.label, "middle"));
  if (up.label) {
    const [px, py] = [left - (up.room ?? 46), top + height / 2];
    parts.push(`<text x='${round(px)}' y='${round(py)}' class='middle' ` +
      `transform='rotate(-90 ${round(px)} ${round(py)})'>${escape(up.label)}</text>`);
  }
  const path = (points) => points.map(([a, b], i) => `${i ? "L" : "M"}${round(x(a))} ${round(y(b))}`).join("");
  return {
    parts, x, y,
    line(points, colour, { wide = 1.6, dash = "" } = {}) {
      parts.push(`<path d='${path(points)}' fill='none' stroke='${colour}' stroke-width='${wide}' ` +
        `stroke-linejoin='round'${dash ? ` stroke-dasharray='${dash}'` : ""}/>`);
    },
    /** A line that is constant between its points and steps at them. */
    steps(points, colour, options) {
      this.line(points.flatMap(([a, b], i) => (i ? [[a, points[i - 1][1]], [a, b]] : [[a, b]])), colour, options);
    },
    dots(points, colour, shape = "circle", size = 4) {
      for (const [a, b] of points) {
        const [px, py] = [x(a), y(b)];
        parts.push(shape === "circle" ? `<circle cx='${round(px)}' cy='${round(py)}' r='${size}' fill='${colour}'/>`
          : shape === "ring" ? `<circle cx='${round(px)}' cy='${round(py)}' r='${size}' fill='#fff' stroke='${colour}' stroke-width='1.8'/>`
            : `<path d='M${round(px - size)} ${round(py - size)}h${2 * size}v${2 * size}h${-2 * size}z' fill='${colour}'/>`);
      }
    },
    /** Words at a point of the data. */
    label(a, b, words, colour, { dx = 6, dy = 4, kind = "label" } = {}) {
      parts.push(text(x(a) + dx, y(b) + dy, words, kind, colour ? `fill:${colour}` : ""));
    },
    raw: (part) => parts.push(part),
    text: (px, py, words, kind, style) => parts.push(text(px, py, words, kind, style)),
  };
}

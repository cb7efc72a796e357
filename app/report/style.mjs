// The style of a curve follows from its method: colour from the mode, or from the solver if it solves
// at the end of a sub-step; filled or hollow from the integrator; solid for exact solvers, dashed for
// sweeps.

const modes = [
  [/newton( \d+)? numerov, const/, "teal", "triangle", "Newton, Numerov"],
  [/newton( \d+)? mean, const/, "teal", "circle", "Newton, mean forces"],
  [/newton( \d+)?, const/, "teal", "circle", "Newton"],
  ["refined", "teal", "triangle", "constant N"],
  [/xpbd \d+ per frame, const/, "purple", "star", "small steps"],
  [/pgs \d+ per frame, const/, "amber", "triangle", "small steps"],
  ["xpbd 1, const", "purple", "diamond", "XPBD"],
  ["xpbd", "purple", "cross", "XPBD"],
  [/adaptive.*by island/, "teal", "wye", "adaptive by island"],
  ["capped by island", "amber", "hexagon", "capped + damping by island"],
  ["adaptive per sub-step", "purple", "triangle", "adaptive per sub-step"],
  ["adaptive", "blue", "circle", "adaptive per frame"],
  ["const", "orange", "square", "constant N"],
  ["damping", "teal", "diamond", "damping"],
  ["capped", "amber", "star", "capped + damping"],
  ["stiffness", "grey", "cross", "full geometric stiffness"],
  ["inertia", "text", "hexagon", "capped + geometric inertia"],
  ["blend", "grey", "wye", "capped + blend"],
];

const shapes = {
  circle: '<circle cx="17" cy="7" r="4"/>', square: '<rect x="13.3" y="3.3" width="7.4" height="7.4"/>',
  triangle: '<path d="M17 2L21.6 10.4H12.4Z"/>', diamond: '<path d="M17 1.6L21 7L17 12.4L13 7Z"/>',
  hexagon: '<path d="M17 2.2L21.2 4.6V9.4L17 11.8L12.8 9.4V4.6Z"/>',
  cross: '<path d="M15.6 2H18.4V5.6H22V8.4H18.4V12H15.6V8.4H12V5.6H15.6Z"/>',
  wye: '<path d="M15.6 12V7.8L12 5.7L13.4 3.3L17 5.4L20.6 3.3L22 5.7L18.4 7.8V12Z"/>',
  star: '<path d="M17 1.5L18.6 5.2L22.4 5.5L19.5 8L20.4 12L17 9.8L13.6 12L14.5 8L11.6 5.5L15.4 5.2Z"/>',
};

// The line sample before a curve's name.
export function swatchText({ token, symbol, hollow, dashed }) {
  const c = `var(--${token})`;
  return `<svg class="swatch" width="34" height="14" viewBox="0 0 34 14" aria-hidden="true" stroke="${c}" stroke-width="1.6">` +
    `<path d="M1 7H33"${dashed ? ' stroke-dasharray="5 3"' : ""}/><g fill="${hollow ? "var(--ground)" : c}">${shapes[symbol]}</g></svg>`;
}

export const colour = name =>
  getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

export function styleOf(series) {
  const [, token, shape, mode] = modes.find(([part]) => series.search(part) >= 0) ?? ["", "grey", "circle", series];
  const leapfrog = series.includes("leapfrog");
  const [, sweeping, sweeps, shared] = /^(pgs|xpbd) (\d+)( per frame)?/.exec(series) ?? [];
  const named = sweeping === "pgs" || shared; // XPBD is its own name otherwise
  const implicit = /^newton/.test(series);
  const [, steps] = /^newton (\d+)/.exec(series) ?? [];
  const stormer = series.includes("stormer");
  const symbol = stormer ? "star" : /drift order 2|exact contact block/.test(series) || steps === "1" ? "diamond"
    : /explicit gyroscopic/.test(series) ? "cross" : steps ? "square" : shape;
  const others = [/drift order 2/, /drift (?!order)\w+/, /exact contact block/, /explicit gyroscopic torque/, /refined \d+/]
    .map(other => other.exec(series)?.[0]);
  const name = [mode, leapfrog && !implicit ? "leapfrog" : stormer ? "Störmer" : "", named ? `${sweeping.toUpperCase()} ${sweeps}${shared ?? ""}` : "", steps ? `${steps} step${steps === "1" ? "" : "s"}` : "", ...others]
    .filter(Boolean).join(", ");
  return { token, symbol, name: sweeping && !named ? `${name} ${sweeps}` : name, hollow: leapfrog || stormer, dashed: sweeping !== undefined };
}

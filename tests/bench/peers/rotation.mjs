// Quaternions, w x y z, and vectors as arrays of numbers.

export const add = (a, b) => a.map((x, i) => x + b[i]);
export const subtract = (a, b) => a.map((x, i) => x - b[i]);
export const length = (a) => Math.hypot(...a);
export const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);

export function cross([a, b, c], [x, y, z]) {
  return [b * z - c * y, c * x - a * z, a * y - b * x];
}

export const conjugate = ([w, x, y, z]) => [w, -x, -y, -z];

export function multiply([a, b, c, d], [w, x, y, z]) {
  return [
    a * w - b * x - c * y - d * z,
    a * x + b * w + c * z - d * y,
    a * y - b * z + c * w + d * x,
    a * z + b * y - c * x + d * w,
  ];
}

export function rotate(q, v) {
  const [w, ...u] = q;
  const twice = cross(u, v).map((x) => 2 * x);
  return add(add(v, twice.map((x) => w * x)), cross(u, twice));
}

/** The shortest rotation that turns one unit vector into another. */
export function between(from, to) {
  const w = 1 + dot(from, to);
  if (w < 1e-12) {
    const other = Math.abs(from[0]) < 0.9 ? [1, 0, 0] : [0, 1, 0];
    const axis = cross(from, other);
    return [0, ...axis.map((x) => x / length(axis))];
  }
  const q = [w, ...cross(from, to)];
  const norm = Math.hypot(...q);
  return q.map((x) => x / norm);
}

/** The rotation that turns x to a unit vector and y to another, perpendicular to it. */
export function frameOf(axis, across) {
  const q = between([1, 0, 0], axis);
  const y = rotate(q, [0, 1, 0]);
  const half = Math.atan2(dot(cross(y, across), axis), dot(y, across)) / 2;
  return multiply([Math.cos(half), ...axis.map((x) => Math.sin(half) * x)], q);
}

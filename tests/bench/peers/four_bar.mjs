// The exact motion of a four-bar linkage in a plane, independent of all engines: one degree of freedom,
// the angle of the crank, whose rate follows from the energy. The crank must go round.

import { add, dot, length, rotate, subtract } from "./rotation.mjs";

const kSteps = 200; // of the Runge-Kutta method, per frame

const turned = ([x, y]) => [-y, x, 0];

/** @return places of the joints and of the centres, and their derivatives, at an angle of the crank */
function linkage(scene) {
  const [crank, coupler, rocker] = scene.bodies;
  const [a, b, c, d] = scene.joints;
  const long = (one, two) => length(subtract(one, two));
  const r1 = long(b.anchorB, a.anchorA);
  const r2 = long(c.anchorB, b.anchorA);
  const r3 = long(d.anchorA, c.anchorA);
  const start = add(coupler.x, rotate(coupler.q, c.anchorB));
  const hinge = add(crank.x, rotate(crank.q, b.anchorB));
  const side = Math.sign(dot(turned(subtract(d.anchorB, hinge)), subtract(start, hinge)));
  return (angle) => {
    const toB = [r1 * Math.cos(angle), r1 * Math.sin(angle), 0];
    const B = add(a.anchorB, toB);
    const gap = subtract(d.anchorB, B);
    const far = length(gap);
    const along = (r2 * r2 - r3 * r3 + far * far) / (2 * far * far);
    const across = (side * Math.sqrt(r2 * r2 - (along * far) ** 2)) / far;
    const C = add(B, gap.map((x, i) => along * x + across * turned(gap)[i]));
    // C moves with the coupler, B' + w2 z x (C - B), and with the rocker, w3 z x (C - D).
    const [toC, fromD] = [subtract(C, B), subtract(C, d.anchorB)];
    const B1 = turned(toB);
    const w2 = -dot(B1, fromD) / dot(turned(toC), fromD);
    const w3 = dot(B1, toC) / dot(turned(fromD), toC);
    const middle = (one, two) => add(one, two).map((x) => x / 2);
    return [
      { body: crank, x: middle(a.anchorB, B), v: B1.map((x) => x / 2), w: 1 },
      { body: coupler, x: middle(B, C), v: middle(B1, turned(fromD).map((x) => w3 * x)), w: w2 },
      { body: rocker, x: middle(C, d.anchorB), v: turned(fromD).map((x) => (w3 * x) / 2), w: w3 },
    ];
  };
}

/** @return the rocker's centre after every frame [m] */
export function fourBarPath(scene, frames) {
  const at = linkage(scene);
  const sum = (links, of) => links.reduce((total, link) => total + of(link), 0);
  const inertia = (links) =>
    sum(links, ({ body, v, w }) => body.mass * dot(v, v) + body.inertia[2] * w * w);
  const potential = (links) => -sum(links, ({ body, x }) => body.mass * dot(scene.gravity, x));
  const [crank] = scene.bodies;
  let angle = 2 * Math.atan2(crank.q[3], crank.q[0]);
  const first = at(angle);
  const energy = (inertia(first) * crank.w[2] ** 2) / 2 + potential(first);
  const rate = (angle) => {
    const links = at(angle);
    return Math.sqrt((2 * (energy - potential(links))) / inertia(links));
  };
  const h = scene.frame / kSteps;
  return Array.from({ length: frames }, () => {
    for (let i = 0; i < kSteps; ++i) {
      const k1 = rate(angle);
      const k2 = rate(angle + (h / 2) * k1);
      const k3 = rate(angle + (h / 2) * k2);
      angle += (h / 6) * (k1 + 2 * k2 + 2 * k3 + rate(angle + h * k3));
    }
    return at(angle)[2].x;
  });
}

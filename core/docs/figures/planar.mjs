// A small planar program for the page energy.md: what the product does not offer, such as steps that
// are chosen reversibly, and what its formulas are checked with. Bodies on ball or hinge joints in the
// plane z = 0, gravity, no contact; maximal coordinates (x, y, angle), dense matrices.

/** Solves A x = b by elimination with pivots; both are overwritten. */
function solve(A, b) {
  const n = b.length;
  for (let k = 0; k < n; ++k) {
    let p = k;
    for (let i = k + 1; i < n; ++i) if (Math.abs(A[i][k]) > Math.abs(A[p][k])) p = i;
    [A[k], A[p]] = [A[p], A[k]];
    [b[k], b[p]] = [b[p], b[k]];
    for (let i = k + 1; i < n; ++i) {
      const factor = A[i][k] / A[k][k];
      if (factor === 0) continue;
      for (let j = k; j < n; ++j) A[i][j] -= factor * A[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (let k = n - 1; k >= 0; --k) {
    for (let j = k + 1; j < n; ++j) b[k] -= A[k][j] * b[j];
    b[k] /= A[k][k];
  }
  return b;
}

const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const times = (J, v) => J.map((row) => dot(row, v));
/** a + factor b. */
export const plus = (a, b, factor = 1) => a.map((x, i) => x + factor * b[i]);

/**
 * [sin, cos] by their series about the nearest multiple of pi/2: those of Math differ between versions of
 * Node.js, and motions like that of a rope depend on the last digit.
 */
function turn(angle) {
  const quarter = Math.round(angle / (Math.PI / 2));
  const x = angle - quarter * (Math.PI / 2);
  let [sin, cos, term] = [0, 0, 1];
  for (let k = 1; k < 20; k += 2) {
    cos += term;
    term *= x / k;
    sin += term;
    term *= -x / (k + 1);
  }
  return [[sin, cos], [cos, -sin], [-sin, -cos], [-cos, sin]][((quarter % 4) + 4) % 4];
}
const length = (x, y) => Math.sqrt(x * x + y * y);

const finite = (v) => v.every((x) => Math.abs(x) < 1e5);

/** The mechanism of a scene file. @param scene parsed JSON  @param gravity [m/s^2] */
export function mechanism(scene, gravity = 9.81) {
  const moving = scene.bodies.filter((body) => !body.static);
  const index = new Map(moving.map((body, i) => [body.name, i]));
  const m = []; // of every coordinate
  const f = [];
  const q0 = [];
  let v0 = [];
  for (const { mass, shape, position, orientation: [w, , , z] = [1, 0, 0, 0], velocity = [0, 0],
    angular_velocity: spin = [0, 0, 0] } of moving) {
    const inertia = shape.type === "box" ? mass * (shape.size[0] * shape.size[0] + shape.size[1] * shape.size[1]) / 12
      : 0.4 * mass * shape.radius * shape.radius;
    m.push(mass, mass, inertia);
    f.push(0, -mass * gravity, 0);
    q0.push(position[0], position[1], 2 * Math.atan2(z, w));
    v0.push(velocity[0], velocity[1], spin[2]);
  }
  const joints = scene.joints.map((joint) => ["a", "b"].map((end) =>
    ({ body: index.get(joint[end]) ?? -1, anchor: joint[`anchor_${end}`] ?? [0, 0] })));

  /** Gaps and their gradients. @returns {phi, J} */
  function gaps(q) {
    const phi = [];
    const J = [];
    for (const ends of joints) {
      const rows = [q.map(() => 0), q.map(() => 0)];
      const gap = [0, 0];
      ends.forEach(({ body, anchor: [x, y] }, end) => {
        const sign = end === 0 ? 1 : -1;
        const angle = body < 0 ? 0 : q[3 * body + 2];
        const [sin, cos] = turn(angle);
        const arm = [cos * x - sin * y, sin * x + cos * y];
        for (const row of [0, 1]) {
          gap[row] += sign * (arm[row] + (body < 0 ? 0 : q[3 * body + row]));
          if (body < 0) continue;
          rows[row][3 * body + row] = sign;
          rows[row][3 * body + 2] = sign * (row === 0 ? -arm[1] : arm[0]);
        }
      });
      phi.push(...gap);
      J.push(...rows);
    }
    return { phi, J };
  }

  /** u^T phi'' u: the acceleration of the gaps at constant velocity. */
  function curvature(q, u) {
    const kappa = [];
    for (const ends of joints) {
      const of = [0, 0];
      ends.forEach(({ body, anchor: [x, y] }, end) => {
        if (body < 0) return;
        const [sin, cos] = turn(q[3 * body + 2]);
        const spin = u[3 * body + 2];
        const factor = (end === 0 ? -1 : 1) * spin * spin;
        of[0] += factor * (cos * x - sin * y);
        of[1] += factor * (sin * x + cos * y);
      });
      kappa.push(...of);
    }
    return kappa;
  }

  /** A^-1 b with A = J M^-1 K^T. */
  const against = (J, K, b) => solve(J.map((row) => K.map((other) =>
    row.reduce((sum, x, i) => sum + x * other[i] / m[i], 0))), [...b]);
  /** v + M^-1 J^T impulse. */
  const pushed = (v, J, impulse) => v.map((x, i) =>
    x + J.reduce((sum, row, j) => sum + row[i] * impulse[j], 0) / m[i]);
  const free = (v, h) => v.map((x, i) => x + h * f[i] / m[i]);
  const project = (q, v) => {
    const { J } = gaps(q);
    return pushed(v, J, against(J, J, times(J, v).map((x) => -x)));
  };
  v0 = project(q0, v0);

  /** Forces of the joints [N]. */
  function forces(q, v) {
    const { J } = gaps(q);
    const kappa = curvature(q, v);
    return against(J, J, times(J, f.map((x, i) => x / m[i])).map((x, i) => -x - kappa[i]));
  }
  const acceleration = (q, v) => pushed(free(v.map(() => 0), 1), gaps(q).J, forces(q, v));

  return {
    q0, v0, gaps, project, acceleration, curvature,
    energy: (q, v) => 0.5 * dot(m, v.map((x) => x * x)) - dot(f, q),
    kinetic: (v) => 0.5 * dot(m, v.map((x) => x * x)),
    /** The norm a^T M b. */
    product: (a, b) => dot(m, a.map((x, i) => x * b[i])),
    /** kappa^T A^-1 kappa: the acceleration that joints give, in the norm of M [J/s^2]. */
    appell(q, v, other = null) {
      const { J } = gaps(q);
      const kappa = other ?? curvature(q, v);
      return dot(kappa, against(J, J, kappa));
    },
    /** Sub-steps per second that the criterion asks for at alpha: the largest |lambda| |arm| / I. */
    rate(q, v, alpha) {
      const lambda = forces(q, v);
      let r = 0;
      joints.forEach((ends, k) => {
        for (const { body, anchor } of ends) {
          if (body < 0) continue;
          r = Math.max(r, length(lambda[2 * k], lambda[2 * k + 1]) * length(anchor[0], anchor[1]) /
            m[3 * body + 2]);
        }
      });
      return Math.sqrt(r / (4 * alpha));
    },
    steps: {
      /** The paper's joints: the bias phi/h in one linear solve; Euler. */
      bias(q, v, h) {
        const { phi, J } = gaps(q);
        const u = free(v, h);
        const after = pushed(u, J, against(J, J, times(J, u).map((x, i) => -x - phi[i] / h)));
        return [plus(q, after, h), after];
      },
      /** Velocities without the bias; positions corrected apart. */
      split(q, v, h) {
        const { J } = gaps(q);
        const u = free(v, h);
        const after = pushed(u, J, against(J, J, times(J, u).map((x) => -x)));
        let there = plus(q, after, h);
        for (let i = 0; i < 2; ++i) {
          const { phi, J: K } = gaps(there);
          there = pushed(there, K, against(K, K, phi.map((x) => -x)));
        }
        return [there, after];
      },
      /** RATTLE: gaps closed at the end of the step, then velocities projected. */
      rattle(q, v, h) {
        const { J } = gaps(q);
        let half = free(v, 0.5 * h);
        for (let i = 0; i < 20; ++i) {
          const { phi, J: K } = gaps(plus(q, half, h));
          if (Math.max(...phi.map(Math.abs)) < 1e-14) break;
          half = pushed(half, J, against(K, J, phi.map((x) => -x / h)));
        }
        const there = plus(q, half, h);
        return [there, project(there, free(half, 0.5 * h))];
      },
    },
  };
}

/**
 * The term of second order of the shadow energy of RATTLE, H + h^2 shadow: -(v M j + a M a / 2) / 12.
 * The jerk j is a difference along the motion.
 */
export function shadow(of, q, v) {
  const a = of.acceleration(q, v);
  const e = 1e-5;
  const at = (t) => of.acceleration(plus(plus(q, v, t), a, 0.5 * t * t), plus(v, a, t));
  const jerk = plus(at(e), at(-e), -1).map((x) => x / (2 * e));
  return -of.product(v, jerk) / 12 - of.product(a, a) / 24;
}

/**
 * Runs a mechanism, with N per frame of 1/60 s chosen by the criterion.
 * @param hold frames that must ask for fewer sub-steps before N falls (1: at once)
 * @param redo take a frame again if its criterion exceeds its N
 * @param n a constant N, instead
 * @param watch called before every sub-step with (q, v, h)
 * @returns {change, low, high, kinetic, substeps, gap, ended}: energies [J]; ended: seconds reached
 */
export function run(of, { step, alpha = 0.1, hold = 1, redo = false, n = 0, seconds, watch = () => {} }) {
  const most = 256;
  const frame = 1 / 60;
  let [q, v] = [of.q0, of.v0];
  const start = of.energy(q, v);
  const result = { change: 0, low: 0, high: 0, kinetic: of.kinetic(v), substeps: 0, gap: 0, ended: seconds };
  const wanted = (rate) => Math.min(most, Math.max(1, Math.ceil(rate * frame)));
  const last = []; // what the last frames needed
  let known = n === 0 ? of.rate(q, v, alpha) : 0;
  for (let i = 0; i < Math.round(seconds * 60); ++i) {
    let N = n || Math.max(wanted(known), ...last);
    let [q1, v1] = [q, v];
    let peak = 0;
    for (;;) {
      [q1, v1] = [q, v];
      peak = 0;
      for (let k = 0; k < N; ++k) {
        watch(q1, v1, frame / N);
        [q1, v1] = step(q1, v1, frame / N);
        if (!finite(v1)) {
          peak = Infinity;
          break;
        }
        if (n === 0) peak = Math.max(peak, known = of.rate(q1, v1, alpha));
      }
      result.substeps += N;
      if (!redo || wanted(peak) <= N || N >= most) break;
      N = Math.min(most, Math.max(N + 1, wanted(peak)));
    }
    if (!finite(v1)) return { ...result, ended: i * frame };
    [q, v] = [q1, v1];
    last.push(wanted(peak));
    if (last.length > hold - 1) last.shift();
    const change = of.energy(q, v) - start;
    result.change = change;
    result.low = Math.min(result.low, change);
    result.high = Math.max(result.high, change);
    result.kinetic = Math.max(result.kinetic, of.kinetic(v));
    result.gap = Math.max(result.gap, ...of.gaps(q).phi.map(Math.abs));
  }
  return result;
}

/**
 * The same with steps that are chosen reversibly. Frames do not bound them.
 * @param control verlet: 1/h + 1/h_last = 2 rate(q) (adaptive Verlet, Huang and Leimkuhler 1997);
 *   integral: 1/h = 1/h_last + h_last d(rate)/dt (Hairer and Söderlind 2005)
 * @returns as run(), and rate and wanted: steps a second at the end, taken and asked for
 */
export function runReversible(of, { step, control, alpha = 0.1, seconds }) {
  let [q, v] = [of.q0, of.v0];
  const start = of.energy(q, v);
  const result = { change: 0, low: 0, high: 0, kinetic: of.kinetic(v), substeps: 0, gap: 0, ended: seconds };
  const slowest = 60;
  const asked = () => Math.max(slowest, of.rate(q, v, alpha));
  /** d(rate)/dt along the motion. */
  function change() {
    const a = of.acceleration(q, v);
    const e = 1e-6;
    const at = (t) => of.rate(plus(q, v, t), plus(v, a, t), alpha);
    return (at(e) - at(-e)) / (2 * e);
  }
  let density = asked(); // 1/h
  for (let t = 0; t < seconds; ++result.substeps) {
    if (control === "integral") density += change() / density;
    const h = 1 / density;
    [q, v] = step(q, v, h);
    t += h;
    result.rate = density;
    if (control === "verlet") density = 2 * asked() - density;
    if (!(density > 0) || !finite(v)) return { ...result, ended: t };
    result.wanted = asked();
    result.change = of.energy(q, v) - start;
    result.low = Math.min(result.low, result.change);
    result.high = Math.max(result.high, result.change);
    result.kinetic = Math.max(result.kinetic, of.kinetic(v));
    result.gap = Math.max(result.gap, ...of.gaps(q).phi.map(Math.abs));
  }
  return result;
}

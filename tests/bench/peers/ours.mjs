// Settings of this project, for its native program and its WebAssembly build.

const kPaper = { mode: "adaptive", alpha: 0.1 };
const leapfrog = (n) => ({ mode: "const", n, integrator: "leapfrog", drift_order: 2 });
const stormer = (n) => ({ mode: "const", n, integrator: "stormer" });
const adaptive_stormer = (alpha) => ({ mode: "adaptive", alpha, integrator: "stormer" });
const euler = (n) => ({ mode: "const", n });
const steady = (n) => ({ preset: "steady", mode: "const", n });
const leapfrog_full = (n) => ({ mode: "const", n, integrator: "leapfrog", drift: "full" });
const blend = (n_cap, more) => ({ mode: "blend", n_cap, ...more });
const inertia = (n_cap) => ({ mode: "inertia", n_cap, integrator: "leapfrog" });
const newton = (forces, n, iterations) => ({
  ...{ solver: "newton", forces, mode: "const", n, iterations, integrator: "leapfrog" },
});
const kExact = { beta: 0.995, drift_order: 2, integrator: "leapfrog" };

export const ladder = {
  swinging_box: [
    kPaper,
    ...[6, 7, 8, 15, 32, 64].map(leapfrog),
    blend(1, kExact),
    blend(2, kExact),
    inertia(1),
    inertia(4),
    newton("mean", 1, 2),
    newton("mean", 2, 1),
    ...[9, 10, 16].map(stormer),
    ...[0.4, 0.3, 0.25, 0.1].map(adaptive_stormer),
    newton("numerov", 8, 1),
    newton("numerov", 6, 2),
    newton("numerov", 12, 2),
    { mode: "capped", n_cap: 4 },
  ],
  bridge: [
    kPaper,
    ...[4, 8, 16].map(euler),
    ...[1, 2, 3, 4, 5, 6, 8].map((n) => blend(n)),
    { mode: "capped", n_cap: 4 },
    { mode: "capped", n_cap: 8 },
    { mode: "damping" },
    ...[5, 10].map((steps) => newton("end", 1, steps)),
    newton("end", 2, 5),
  ],
  in_space: [
    kPaper,
    ...[2, 4, 8, 16, 32].map(leapfrog),
    ...[2, 4, 8, 16, 32].map(stormer),
    adaptive_stormer(0.1),
    inertia(1),
    ...[4, 8].map((n) => newton("numerov", n, 2)),
  ],
  energy: [
    { preset: "paper" },
    { preset: "steady" },
    { preset: "steady", alpha: 0.025 },
    ...[6, 7, 8, 16, 32, 64, 96, 128].map(steady),
    ...[8, 16, 32].map(leapfrog_full),
    ...[4, 8, 16, 32].map(stormer),
    adaptive_stormer(0.1),
    ...[8, 16].map((n) => newton("numerov", n, 2)),
  ],
  stack: [...[1, 2, 4].map(euler), { mode: "damping" }, blend(1), kPaper],
};

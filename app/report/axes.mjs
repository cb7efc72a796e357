// The axes of the charts: a label with its unit, and a function that reads the value from a result.

const perFrame = key => r => r.work[key] / r.work.frames;

export const costs = [
  { key: "substeps", label: "sub-steps per frame", of: perFrame("substeps") },
  { key: "flops", label: "solver operations per frame [flop]", of: perFrame("flops") },
  { key: "ms", label: "median time per frame [ms], the machine of the sweep", of: r => r.timing.ms_median },
  { key: "p95", label: "95th percentile of the time per frame [ms]", of: r => r.timing.ms_p95 },
];

const drift = r => Math.abs(r.errors.energy_drift_percent ?? NaN);
export const errors = [
  { key: "trajectory", label: "largest distance from the reference [m]", of: r => r.errors.trajectory_peak },
  { key: "final", label: "distance from the reference at its end [m]", of: r => r.errors.trajectory_final },
  { key: "energy", label: "energy drift at the end [% of the scale]", of: drift },
  { key: "joules", label: "largest energy drift [J]", of: r => r.errors.energy_drift_peak },
  { key: "gap", label: "largest joint gap [m]", of: r => r.errors.joint_gap?.peak },
  { key: "gapMedian", label: "median joint gap [m]", of: r => r.errors.joint_gap?.median },
  { key: "constraint", label: "largest constraint error, 1-norm [m, rad]", of: r => r.errors.constraint?.peak },
  { key: "constraintMedian", label: "median constraint error, 1-norm [m, rad]", of: r => r.errors.constraint?.median },
  { key: "penetration", label: "deepest overlap [m]", of: r => r.errors.penetration?.peak },
  { key: "angular", label: "angular momentum drift [kg m²/s]", of: r => r.errors.angular_momentum_drift },
  { key: "lcp", label: "largest residual of a solve [N s, m/s]", of: r => r.errors.lcp_residual },
];

export const positive = x => Number.isFinite(x) && x > 0;

// The axes for which at least two runs have a positive value.
export const available = (axes, results) =>
  axes.filter(axis => results.filter(r => r.holds && positive(axis.of(r))).length > 1);

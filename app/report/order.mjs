// The order of a method: how steeply its error falls with its cost.

// A straight line through the logarithms, of what the errors have above a floor.
function line(runs, floor) {
  const x = runs.map(p => Math.log(p.cost)), y = runs.map(p => Math.log(p.error - floor));
  const mean = v => v.reduce((a, b) => a + b) / v.length;
  const mx = mean(x), my = mean(y);
  const sxx = x.reduce((s, xi) => s + (xi - mx) ** 2, 0);
  const slope = x.reduce((s, xi, i) => s + (xi - mx) * (y[i] - my), 0) / sxx;
  const bent = x.reduce((s, xi, i) => s + (y[i] - my - slope * (xi - mx)) ** 2, 0);
  return { order: sxx < 0.05 ? NaN : -slope, bent, floor };
}

/**
 * Errors are measured from a reference that is itself off by up to its uncertainty: the rigid chain that
 * the swinging box is measured from knows nothing of the give of its hinges. That is a floor under all
 * errors of a curve, and bends it long before it gets there. So the floor that leaves the straightest
 * curve is taken off, at most the uncertainty; what bends it more is the method's own.
 * @returns {order, floor}; order is NaN where too few errors stand clear of the uncertainty
 */
export function observedOrder(runs, uncertainty) {
  const clear = runs.filter(p => p.error > 3 * uncertainty);
  if (clear.length < 3) return { order: NaN, floor: 0 };
  const steps = 100;
  const lines = Array.from({ length: steps + 1 }, (_, i) => line(clear, (uncertainty * i) / steps));
  const { order, floor } = lines.reduce((best, one) => (one.bent < best.bent ? one : best));
  return { order, floor };
}

// Errors that rounding or chaos decides fall at no method's order.
export const isOrder = order => order > 0.5 && order < 4;

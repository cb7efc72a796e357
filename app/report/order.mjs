// The order of a method: how steeply its error falls with its cost.

// A straight line through the logarithms of the errors minus a floor.
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
 * The reference itself is uncertain: the rigid chain used for the swinging box ignores the compliance
 * of its hinges. The uncertainty adds a floor to all errors of a curve and bends the curve well above
 * that floor. We subtract the floor, at most the uncertainty, that gives the straightest curve; the
 * remaining curvature belongs to the method.
 * @returns {order, floor}; order is NaN if too few errors are well above the uncertainty
 */
export function observedOrder(runs, uncertainty) {
  const clear = runs.filter(p => p.error > 3 * uncertainty);
  if (clear.length < 3) return { order: NaN, floor: 0 };
  const steps = 100;
  const lines = Array.from({ length: steps + 1 }, (_, i) => line(clear, (uncertainty * i) / steps));
  const { order, floor } = lines.reduce((best, one) => (one.bent < best.bent ? one : best));
  return { order, floor };
}

// Errors dominated by rounding or chaos show no order.
export const isOrder = order => order > 0.5 && order < 4;

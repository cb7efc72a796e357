// The Pareto front: no other point has less cost at no more error, or less error at no more cost.
export function paretoFront(points) {
  const sorted = [...points].sort((a, b) => a.cost - b.cost || a.error - b.error);
  const front = [];
  let least = Infinity;
  for (let i = 0; i < sorted.length;) {
    const { cost, error } = sorted[i];
    for (; i < sorted.length && sorted[i].cost === cost; ++i) {
      if (error < least && sorted[i].error === error) front.push(sorted[i]);
    }
    least = Math.min(least, error);
  }
  return front;
}

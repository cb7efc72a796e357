// The order that the report states for a curve.
import assert from "node:assert/strict";
import test from "node:test";
import { isOrder, observedOrder } from "../../app/report/order.mjs";

const curve = (order, floor) =>
  [7, 8, 10, 12, 14, 16, 20, 24, 28, 40].map(cost => ({ cost, error: 5e-3 * cost ** -order + floor }));

test("an exact power law has its order and no floor", () => {
  for (const order of [1, 2, 4]) {
    const observed = observedOrder(curve(order, 0), 1e-10);
    assert.ok(Math.abs(observed.order - order) < 1e-6, `${observed.order}`);
    assert.equal(observed.floor, 0);
  }
});

test("a floor within the reference's uncertainty does not hide the order", () => {
  const observed = observedOrder(curve(2, 2.5e-6), 2.8e-6);
  assert.ok(Math.abs(observed.order - 2) < 0.01, `${observed.order}`);
  assert.ok(Math.abs(observed.floor - 2.5e-6) < 1e-7, `${observed.floor}`);
});

test("a curve that bends more than that is not straightened", () => {
  const observed = observedOrder(curve(2, 2.5e-5), 2.8e-6);
  assert.ok(observed.order < 1.7, `${observed.order}`);
});

test("too few errors above the uncertainty give no order", () => {
  assert.ok(!isOrder(observedOrder(curve(2, 0), 1e-4).order));
  assert.ok(!isOrder(observedOrder(curve(2, 0).slice(0, 2), 0).order));
});

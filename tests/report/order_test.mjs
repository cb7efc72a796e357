// The order that the report tells of a curve.
import assert from "node:assert/strict";
import test from "node:test";
import { isOrder, observedOrder } from "../../app/report/order.mjs";

const curve = (order, floor) =>
  [7, 8, 10, 12, 14, 16, 20, 24, 28, 40].map(cost => ({ cost, error: 5e-3 * cost ** -order + floor }));

test("a clean curve has its order, and no floor", () => {
  for (const order of [1, 2, 4]) {
    const told = observedOrder(curve(order, 0), 1e-10);
    assert.ok(Math.abs(told.order - order) < 1e-6, `${told.order}`);
    assert.equal(told.floor, 0);
  }
});

test("a floor within the reference's uncertainty does not hide the order", () => {
  const told = observedOrder(curve(2, 2.5e-6), 2.8e-6);
  assert.ok(Math.abs(told.order - 2) < 0.01, `${told.order}`);
  assert.ok(Math.abs(told.floor - 2.5e-6) < 1e-7, `${told.floor}`);
});

test("a curve that bends for more than that is not made straight", () => {
  const told = observedOrder(curve(2, 2.5e-5), 2.8e-6);
  assert.ok(told.order < 1.7, `${told.order}`);
});

test("too few errors clear of the uncertainty tell no order", () => {
  assert.ok(!isOrder(observedOrder(curve(2, 0), 1e-4).order));
  assert.ok(!isOrder(observedOrder(curve(2, 0).slice(0, 2), 0).order));
});

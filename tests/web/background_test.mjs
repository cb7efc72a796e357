// Time behind another tab is not simulated and leaves no backlog:
// node tests/web/background_test.mjs [FOLDER OF THE BUILT PAGE] [all]
// Three seconds, or a minute on request.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { all, open } from "./browser.mjs";
import { openTab } from "./tabs.mjs";

let session;
let tab;
before(async () => {
  session = await open();
  tab = await openTab(`${session.address}#scene=swinging_box`);
});
after(async () => {
  await tab?.close();
  await session?.close();
});

const away = all ? 60000 : 3000; // [ms]
const wait = (ms) => new Promise((done) => { setTimeout(done, ms); });

test("time in the background is not simulated and leaves no backlog", async () => {
  await tab.evaluate(`new Promise((ready) => {
    window.seen = [];
    window.faults = [];
    window.addEventListener("error", ({ message }) => window.faults.push(message));
    document.addEventListener("visibilitychange", () => window.seen.push({ state: document.visibilityState,
      at: performance.now(), time: window.substep.report().time,
      drawn: document.querySelector(".substep-view").pictures.begun }));
    const timer = setInterval(() => {
      if (!(window.substep?.report().time > 0.5)) return;
      clearInterval(timer);
      ready();
    }, 50);
  })`);
  await tab.leave();
  await wait(away);
  await tab.comeBack();
  await wait(2000);
  const { seen, then, faults } = await tab.evaluate(`({ seen, faults,
    then: { at: performance.now(), time: window.substep.report().time } })`);
  assert.deepEqual(seen.map(({ state }) => state), ["hidden", "visible"]);
  const [left, back] = seen;
  assert.ok(back.at - left.at > away - 1000, `${back.at - left.at} ms away`);
  // The browser may draw a few pictures while it changes tabs. A picture advances by at most 0.1 s,
  // and one may have been begun before.
  const drawn = back.drawn - left.drawn;
  assert.ok(drawn < 10, `${drawn} pictures were drawn behind the other tab`);
  const simulated = back.time - left.time;
  assert.ok(simulated < 0.1 * (drawn + 1) + 0.02, `${simulated} s were simulated behind the other tab`);
  assert.ok(then.time > back.time, "the run does not continue");
  assert.ok(then.time - back.time < (then.at - back.at) / 1000 + 0.3, "simulated time was caught up");
  assert.deepEqual(faults, []);
});

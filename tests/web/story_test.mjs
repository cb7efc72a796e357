// Typical visits, by clicks only: node tests/web/story_test.mjs [FOLDER OF THE BUILT PAGE]
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { call, click, drawn, open, openPage, pick, quiet, reports, save } from "./browser.mjs";

let session;
before(async () => { session = await open(); });
after(() => session?.close());

/** Waits until a control is present. */
const offered = (page, label) => page.waitForFunction(
  (l) => window.substep.widgets().some((w) => w.label === l), label, { timeout: 20000 });

/** Plays until the verdict is a failure. */
const fails = (page) => page.waitForFunction(
  () => /^fails/.test(window.substep.report().verdict), null, { timeout: 60000 });

test("none tears, adaptive holds, alpha changes N, the link is copied", async () => {
  const page = await openPage(session);
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  assert.equal((await call(page, "report")).mode, "adaptive");
  await click(page, "none", "mode");
  await call(page, "reset");
  await fails(page);
  await offered(page, "Reset with adaptive sub-steps");
  await save(page, "story-torn");
  await click(page, "Reset with adaptive sub-steps");
  const report = await call(page, "report");
  assert.deepEqual([report.mode, report.verdict], ["adaptive", "holds"]);
  assert.ok(report.playing, "the run does not continue");
  await click(page, "What does accuracy cost?");
  await offered(page, "Run again"); // the picture appears immediately
  await pick(page, "Copy link");
  await drawn(page);
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.ok(link.startsWith(session.address), link);
  assert.match(link, /scene=swinging_box.*mode=adaptive/);
  quiet(page);
  await page.context().close();
});

test("a diverging run pauses, explains, and returns to its last good state", async () => {
  const page = await openPage(session, { fragment: "scene=spinning_top" });
  await call(page, "reset");
  // An explicit gyroscopic torque at this speed gains energy without bound.
  const wild = JSON.parse(await call(page, "saved"));
  for (const body of wild.bodies) body.angular_velocity = [300, 2000, 100];
  Object.assign(wild.settings, { gyroscopic: "explicit", mode: "none" });
  assert.deepEqual((await call(page, "load", wild)).problems, []);
  await call(page, "play");
  await reports(page, "stopped", true);
  assert.equal((await call(page, "report")).playing, false);
  await offered(page, "Last good state");
  await save(page, "diverged");
  const { time } = await call(page, "report");
  assert.ok(Number.isFinite(time), `${time}`);
  assert.equal((await call(page, "history")).includes("nan"), false);
  await click(page, "Last good state");
  const good = await call(page, "report");
  assert.equal(good.stopped, false);
  assert.ok(good.time <= time);
  assert.ok(Number.isFinite(good.kinetic) && Number.isFinite(good.energy), `${good.kinetic}`);
  await call(page, "set", { scene: "bridge" }); // nothing else failed
  await call(page, "step", 10);
  assert.equal((await call(page, "report")).verdict, "holds");
  quiet(page);
  await page.context().close();
});

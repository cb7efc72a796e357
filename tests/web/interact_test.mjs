// Mouse and touch on the picture and the timeline, and typical visits by clicks:
// node tests/web/interact_test.mjs [FOLDER OF THE BUILT PAGE]
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { appears, call, click, drawn, find, leave, open, openPage, pick, picture, place, quiet, reports,
  save } from "./browser.mjs";
import { difference, part } from "./pixels.mjs";

// Positions at 1280 x 720.
const side = { x: 980, y: 60, width: 280, height: 560 };

let session;
let page;
before(async () => {
  session = await open({ rate: 15 });
  page = await openPage(session, { calm: true });
});
after(() => session?.close());

/** The swinging box at its start, after some frames. @returns the hash */
async function run(frames) {
  await call(page, "pause");
  await call(page, "set", { scene: "swinging_box", mode: "adaptive" });
  await call(page, "reset");
  await call(page, "step", frames);
  await drawn(page);
  return call(page, "hash");
}

test("a body is grabbed, pulled and released", async () => {
  const free = await run(60);
  await run(0);
  await call(page, "set", { speed: 0.01 }); // bodies are held while the run plays
  await call(page, "play");
  const box = place(await find(page, "box", "body"));
  await page.mouse.move(...box);
  await drawn(page);
  await page.mouse.down();
  await drawn(page);
  await page.mouse.move(box[0] - 300, box[1] + 120, { steps: 5 });
  await drawn(page);
  await save(page, "grab");
  await call(page, "step", 30);
  await page.mouse.up();
  await drawn(page);
  await call(page, "pause");
  await call(page, "set", { speed: 1 });
  await call(page, "step", 60 - (await call(page, "report")).frame);
  assert.notEqual(await call(page, "hash"), free, "it was not pulled");
  assert.equal(await run(60), free, "the hand still pulls after a reset");
  quiet(page);
});

test("a key throws a ball", async () => {
  const free = await run(60);
  await run(0);
  await page.mouse.move(620, 300);
  await drawn(page);
  await page.keyboard.press("b");
  await drawn(page);
  await call(page, "step", 60);
  assert.notEqual(await call(page, "hash"), free);
  assert.equal(await run(60), free, "the ball is still there after a reset");
  quiet(page);
});

test("dragging along the timeline shows earlier frames", async () => {
  const end = await run(60);
  const track = await find(page, "past");
  await page.mouse.move(...place(track, 1));
  await page.mouse.down();
  await page.mouse.move(...place(track, 0.5), { steps: 4 });
  await drawn(page);
  await page.mouse.up();
  await drawn(page);
  const { time, latest } = await call(page, "report");
  assert.ok(time > 0.3 && time < 0.7, `${time} s`);
  assert.equal(latest, 1);
  await save(page, "past");
  await call(page, "step", 60 - Math.round(60 * time));
  assert.equal(await call(page, "hash"), end);
  quiet(page);
});

test("compared methods are shown in the picture and in the plots", async () => {
  await run(0);
  await click(page, "Compare", "tabs");
  const empty = await picture(page, side);
  await click(page, "None, damping, adaptive");
  await call(page, "step", 40);
  await page.waitForTimeout(1000);
  await drawn(page);
  await save(page, "compare");
  assert.ok(difference(empty, await picture(page, side)) > 0.05);
  await click(page, "Plots", "tabs");
  await save(page, "compare-plots");
  quiet(page);
});

test("why this N has its own panel", async () => {
  await run(30);
  const plots = await picture(page, side);
  await click(page, "Why N", "tabs");
  assert.ok(difference(plots, await picture(page, side)) > 0.03);
  await save(page, "why");
  await click(page, "Plots", "tabs");
  quiet(page);
});

test("an error in the scene's text is shown at its line, and mended the text runs", async () => {
  await run(0);
  await call(page, "set", { panel: "editor" });
  await drawn(page);
  const scene = await call(page, "sceneText");
  assert.deepEqual([scene.ok, scene.runs], [true, true]);
  await page.mouse.click(...place(await find(page, "scene text"), 0.9)); // the end of a line
  await drawn(page);
  await page.keyboard.type("x");
  await drawn(page);
  const wrong = await call(page, "sceneText");
  assert.equal(wrong.problems.length, 1);
  const { line } = wrong.problems[0];
  await save(page, "editor-error");
  const lines = [...wrong.text].map((letter, i) => (letter === scene.text[i] ? null : i));
  const typed = wrong.text.slice(0, lines.find((i) => i !== null)).split("\n").length;
  assert.ok(line === typed || line === typed + 1, `${line}, typed at ${typed}`);
  await appears(page, `marked line ${line}`);
  assert.equal((await call(page, "report")).scene, "swinging_box", "the run is kept");
  await page.keyboard.press("Control+Z");
  await drawn(page);
  assert.deepEqual(await call(page, "sceneText"), scene);
  const edited = await call(page, "editText", scene.text.replace('"mass": 1000', '"mass": 10'));
  assert.ok(edited.ok);
  assert.equal((await call(page, "report")).scene, "swinging_box_own");
  await save(page, "editor");
  await call(page, "set", { panel: "plots" });
  await run(0);
  quiet(page);
});

test("touches rotate, zoom and scroll", async () => {
  const phone = await openPage(session, { width: 390, height: 844, touch: true, calm: true });
  await call(phone, "pause");
  await call(phone, "set", { scene: "heavy_stack" });
  await phone.waitForTimeout(1000);
  const touch = await phone.context().newCDPSession(phone);
  /** Touches that move in a few steps. @param ways [[from, to], ...] in CSS pixels */
  const gesture = async (...ways) => {
    const at = (share) => ways.map(([from, to], id) => ({ id,
      x: from[0] + share * (to[0] - from[0]), y: from[1] + share * (to[1] - from[1]) }));
    await touch.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: at(0) });
    for (const share of [0.25, 0.5, 0.75, 1]) {
      await touch.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: at(share) });
      await drawn(phone);
    }
    await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    await phone.waitForTimeout(600);
    await drawn(phone);
  };
  const upper = { x: 0, y: 60, width: 390, height: 280 };
  let before = await picture(phone);
  await gesture([[40, 300], [160, 290]]);
  let now = await picture(phone);
  assert.ok(difference(part(before, upper), part(now, upper)) > 0.03, "one finger did not turn");
  before = now;
  await gesture([[150, 200], [90, 140]], [[240, 200], [300, 260]]);
  now = await picture(phone);
  assert.ok(difference(part(before, upper), part(now, upper)) > 0.03, "two fingers did not zoom");
  assert.equal((await call(phone, "report")).selected, "", "a pinch is no click");
  before = now;
  const lower = { x: 0, y: 500, width: 390, height: 300 };
  await gesture([[20, 700], [20, 500]]);
  now = await picture(phone);
  await save(phone, "phone-fingers", now);
  assert.ok(difference(part(before, lower), part(now, lower)) > 0.03, "the panel did not scroll");
  assert.deepEqual(await phone.evaluate(() => [window.scrollX, window.scrollY]), [0, 0]);
  // A tap on the scene's text opens the HTML field, for the keyboard of the screen.
  await call(phone, "set", { panel: "editor" });
  await drawn(phone);
  const field = place(await find(phone, "scene text"));
  await gesture([field, field]);
  await phone.waitForFunction(() => document.activeElement.name === "source");
  assert.ok((await phone.locator("textarea[name=source]").inputValue()).includes("heavy_stack"));
  await save(phone, "phone-text");
  await leave(phone);
});

test("a value is typed after Ctrl and a click on a slider", async () => {
  const page = await openPage(session);
  await call(page, "pause");
  await drawn(page);
  await page.keyboard.down("Control");
  await click(page, "Alpha  α");
  await page.keyboard.up("Control");
  await page.keyboard.type("0.037");
  await page.keyboard.press("Enter");
  await reports(page, "alpha", 0.037);
  assert.equal((await call(page, "report")).mode, "adaptive", "digits are no shortcuts");
  await leave(page);
});

test("none tears, adaptive holds, alpha changes N, the link is copied", async () => {
  const page = await openPage(session);
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  assert.equal((await call(page, "report")).mode, "adaptive");
  await click(page, "none", "mode");
  await call(page, "reset");
  await page.waitForFunction(() => /^fails/.test(window.substep.report().verdict), null, { timeout: 60000 });
  await appears(page, "Reset with adaptive sub-steps");
  await save(page, "story-torn");
  await click(page, "Reset with adaptive sub-steps");
  const report = await call(page, "report");
  assert.deepEqual([report.mode, report.verdict], ["adaptive", "holds"]);
  assert.ok(report.playing, "the run does not continue");
  await click(page, "What does accuracy cost?");
  await appears(page, "Run again"); // the picture appears immediately
  await pick(page, "Copy link");
  await drawn(page);
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.ok(link.startsWith(session.address), link);
  assert.match(link, /scene=swinging_box.*mode=adaptive/);
  await leave(page);
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
  await appears(page, "Last good state");
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
  await leave(page);
});

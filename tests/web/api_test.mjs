// window.substep and createSubstep: node tests/web/api_test.mjs [FOLDER OF THE BUILT PAGE]
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { PNG } from "pngjs";
import { call, drawn, leave, open, openPage, picture, quiet, save } from "./browser.mjs";
import { variance } from "./pixels.mjs";

let session;
let page;
before(async () => {
  session = await open({ rate: 15 });
  page = await openPage(session);
  await call(page, "pause");
});
after(() => session?.close());

test("invalid calls report problems and do not change the run", async () => {
  await call(page, "set", { scene: "bridge" });
  await call(page, "step", 10);
  const hash = await call(page, "hash");
  const settings = await call(page, "settings");
  const wrong = [["load"], ["load", 7], ["load", null], ["load", []], ["load", ""], ["load", {}],
    ["load", "no_such_scene"], ["load", "{"], ["load", '{"bodies": 3}'], ["load", "a\0b"],
    ["set"], ["set", 3], ["set", null], ["set", []], ["set", "mode=none"], ["set", { warp: 9 }],
    ["set", { alpha: -1 }], ["set", { alpha: "a" }], ["set", { alpha: null }], ["set", { n: 1e9 }],
    ["set", { mode: {} }], ["set", { mode: "warp" }], ["set", { scene: "nowhere" }],
    ["step", -1], ["step", 1.5], ["step", "3"], ["step", 1e9], ["step", null],
    ["openLink"], ["openLink", 3], ["openLink", {}]];
  for (const [name, ...args] of wrong) {
    const shown = `${name}(${JSON.stringify(args)})`;
    const result = await call(page, name, ...args);
    assert.equal(result.ok, false, shown);
    assert.ok(result.problems.length > 0 && result.problems.every((p) =>
      typeof p.pointer === "string" && p.message.length > 4), JSON.stringify(result));
    assert.equal(await call(page, "hash"), hash, shown);
    assert.deepEqual(await call(page, "settings"), settings, shown);
  }
  const odd = await page.evaluate(() => {
    const circle = {};
    circle.self = circle;
    const nothing = { toJSON() {} };
    return [window.substep.load(circle), window.substep.load(nothing), window.substep.set({ alpha: NaN }),
      window.substep.set({ alpha: 1n }), window.substep.set(() => {}), window.substep.step(NaN)];
  });
  for (const result of odd) assert.equal(result.ok, false, JSON.stringify(result));
  for (const [name, options] of [["screenshot", { part: "left" }], ["record", { seconds: -1 }]]) {
    await assert.rejects(call(page, name, options), new RegExp(Object.keys(options)[0]));
  }
  assert.equal(await call(page, "hash"), hash);
  quiet(page);
});

test("the valid settings of a call are applied", async () => {
  const result = await call(page, "set", { alpha: -1, warp: 9, mode: "none" });
  assert.deepEqual(result.problems.map((p) => p.pointer).sort(), ["alpha", "warp"]);
  assert.equal((await call(page, "report")).mode, "none");
});

test("settings are returned with their allowed values", async () => {
  const settings = Object.fromEntries((await call(page, "settings")).map((s) => [s.name, s]));
  assert.match(settings.mode.allowed, /none.*adaptive/);
  assert.equal(settings.mode.value, "none");
  assert.ok(settings.alpha.help.length > 10);
});

test("a scene without settings starts with the defaults, one that names the paper with the paper's", async () => {
  const values = async (settings) => {
    const scene = { format: "substep-scene", version: 2, name: "own", title: "Own", ...settings,
      bodies: [{ name: "ball", shape: { type: "sphere", radius: 0.1 }, mass: 1, position: [0, 1, 0] }] };
    assert.equal((await call(page, "load", scene)).ok, true);
    const all = Object.fromEntries((await call(page, "settings")).map((s) => [s.name, s.value]));
    return [all.integrator, all.drift, all.detection, all.friction_cone, String(all.hold)];
  };
  const ours = ["leapfrog", "exact", "continuous", "cone", "60"];
  assert.deepEqual(await values({}), ours);
  assert.deepEqual(await values({ settings: {} }), ours);
  assert.deepEqual(await values({ settings: { preset: "paper" } }), ["euler", "auto", "substep", "box", "1"]);
});

test("listeners receive frames and verdicts until they are removed", async () => {
  await call(page, "set", { scene: "swinging_box", mode: "none" });
  await call(page, "reset");
  await page.evaluate(() => {
    window.heard = { frames: [], verdicts: [] };
    window.leave = window.substep.on("frame", (report) => window.heard.frames.push(report.frame));
    window.substep.on("frame", () => { throw new Error("on purpose"); })();
    window.substep.on("verdict", (text) => window.heard.verdicts.push(text));
    window.substep.play();
  });
  await page.waitForFunction(() => window.heard.verdicts.some((text) => /^fails at/.test(text)));
  const heard = await page.evaluate(async () => {
    window.leave();
    const count = window.heard.frames.length;
    window.substep.reset();
    await new Promise((done) => { window.substep.on("frame", done); });
    return { ...window.heard, later: window.heard.frames.length - count };
  });
  assert.ok(heard.frames.length >= 3, `${heard.frames.length} frames`);
  assert.ok(heard.frames.every((f, i) => i === 0 || f > heard.frames[i - 1]));
  assert.equal(heard.later, 0);
  quiet(page);
});

test("the run continues from an earlier frame, bit for bit", async () => {
  await call(page, "set", { scene: "bridge", mode: "adaptive" });
  await call(page, "pause");
  await call(page, "reset");
  await call(page, "step", 20);
  const middle = await call(page, "hash");
  await call(page, "step", 20);
  const end = await call(page, "hash");
  const past = await call(page, "goTo", 20 / 60);
  assert.deepEqual([past.frame, await call(page, "hash")], [20, middle]);
  assert.ok(past.latest > past.time);
  await call(page, "set", { alpha: 0.1 }); // unchanged: later frames are recomputed
  await call(page, "step", 20);
  assert.equal(await call(page, "hash"), end);
  const begun = await call(page, "substep");
  assert.ok(begun.substeps_left > 0, JSON.stringify(begun));
  assert.equal((await call(page, "step")).substeps_left, 0);
  for (const time of [-1, "1", null]) assert.equal((await call(page, "goTo", time)).ok, false);
  quiet(page);
});

test("an unknown event is reported", async () => {
  await page.evaluate(() => window.substep.on("explosion", () => {}));
  assert.match(page.complaints.join(), /the event must be frame or verdict/);
  page.complaints = [];
});

test("pictures and videos are returned as blobs", async () => {
  const blob = async (name, options) => {
    const url = await page.evaluate(async ([n, o]) => {
      const reader = new FileReader();
      reader.readAsDataURL(await window.substep[n](o));
      await new Promise((done) => { reader.onload = done; });
      return reader.result;
    }, [name, options]);
    const [, type, letters] = /^data:(.*);base64,(.*)$/.exec(url);
    return [type, Buffer.from(letters, "base64")];
  };
  const [type, png] = await blob("screenshot", {});
  assert.equal(type, "image/png");
  const whole = PNG.sync.read(png);
  assert.deepEqual([whole.width, whole.height], [1280, 720]);
  assert.ok(variance(whole) > 60);
  assert.equal((await blob("screenshot", null))[0], "image/png", "as without options");
  assert.ok(PNG.sync.read((await blob("screenshot", { part: "view" }))[1]).width < 1280);
  const [kind, video] = await blob("record", { seconds: 1.5 });
  assert.match(kind, /^video\/webm/);
  assert.ok(video.length > 5000, `${video.length} bytes`);
  quiet(page);
});

test("the history is a table", async () => {
  await call(page, "set", { scene: "swinging_box", mode: "adaptive" });
  await call(page, "pause");
  await call(page, "reset");
  await call(page, "step", 30);
  const lines = (await call(page, "history")).trim().split("\n");
  assert.match(lines[0], /time.*substeps/);
  assert.equal(lines.length, 31);
});

test("two laboratories in an article are independent", async () => {
  const article = await openPage(session, { path: "example/article.html", height: 900 });
  await article.waitForFunction(() => window.laboratories, null, { timeout: 60000 });
  const report = (which) => article.evaluate((w) => window.laboratories[w].report(), which);
  await article.waitForFunction(() => window.laboratories.none.report().time > 0.2, null,
    { timeout: 30000 });
  assert.equal((await report("none")).mode, "none");
  assert.equal((await report("adaptive")).mode, "adaptive");
  assert.ok(!article.url().includes("#"), "the address is the article's");
  // The second is below the viewport: it does not run until it is visible.
  assert.equal((await report("adaptive")).time, 0);
  await article.evaluate(() => document.querySelector("#adaptive").scrollIntoView());
  await article.waitForFunction(() => window.laboratories.adaptive.report().time > 0.2, null,
    { timeout: 30000 });
  await article.evaluate(() => {
    for (const lab of Object.values(window.laboratories)) {
      lab.pause();
      lab.reset();
      lab.step(60);
    }
  });
  assert.notEqual((await report("none")).verdict, "holds");
  assert.equal((await report("adaptive")).verdict, "holds");
  await drawn(article);
  for (const id of ["none", "adaptive"]) {
    await article.evaluate((i) => document.getElementById(i).scrollIntoView({ block: "center" }), id);
    await drawn(article);
    const box = await article.locator(`#${id}`).boundingBox();
    assert.ok(variance(await picture(article, box)) > 20, id);
    await save(article, `article-${id}`);
  }
  // The wheel scrolls the page until the laboratory is clicked.
  await article.evaluate(() => window.scrollTo(0, 0));
  const box = await article.locator("#none").boundingBox();
  await article.mouse.move(box.x + 200, box.y + 200);
  await article.mouse.wheel(0, 200);
  await article.waitForFunction(() => window.scrollY > 100);
  const top = await article.evaluate(() => window.scrollY);
  await article.mouse.click(box.x + 200, box.y + 60);
  await article.mouse.wheel(0, 200);
  await article.waitForTimeout(300);
  assert.equal(await article.evaluate(() => window.scrollY), top);
  await leave(article);
});

test("createSubstep rejects invalid options, and names them", async () => {
  const other = await openPage(session, { path: "example/article.html" });
  await other.waitForFunction(() => window.laboratories, null, { timeout: 60000 });
  const attempt = (options) => other.evaluate(async (given) => {
    const { createSubstep } = await import("../substep.mjs");
    const place = document.body.appendChild(document.createElement("div"));
    place.style.height = "300px";
    try {
      const lab = await createSubstep(place, given);
      const { scene } = lab.report();
      lab.remove();
      return { scene };
    } catch (error) {
      return { message: `${error.name}: ${error.message}`, shown: place.innerText };
    } finally {
      place.remove();
    }
  }, options);
  assert.deepEqual(await attempt(null), { scene: "swinging_box" }, "as without options");
  assert.deepEqual(await attempt({ scene: "pendulum", play: false }), { scene: "pendulum" });
  for (const [options, message] of [
    [3, /^Error: createSubstep: the options must be an object/],
    [{ sceen: "bridge" }, /^Error: createSubstep: no option is called "sceen": they are scene, /],
    [{ play: "no" }, /^Error: createSubstep: play must be true or false/],
  ]) {
    assert.match((await attempt(options)).message, message);
  }
  for (const [options, message] of [
    [{ scene: "nowhere" }, /^Error: createSubstep: scene: .*nowhere/],
    [{ scene: { bodies: 3 } }, /^Error: createSubstep: scene\/format: missing/],
    [{ settings: { alpha: -1 } }, /^Error: createSubstep: settings\.alpha: must be above 0/],
    [{ settings: { warp: 9 } }, /^Error: createSubstep: settings\.warp: /],
    [{ link: "scene=nowhere" }, /^Error: createSubstep: link.*nowhere/],
  ]) {
    const { message: found, shown } = await attempt(options);
    assert.match(found, message);
    assert.match(shown, /substep did not start/);
    assert.match(shown, /createSubstep: /);
  }
  // Each of the five is logged as well.
  assert.equal(other.complaints.filter((text) => /createSubstep: /.test(text)).length, 5);
  other.complaints = [];
  await leave(other);
});

test("createSubstep reports a missing element, and can be removed", async () => {
  const other = await openPage(session, { path: "example/article.html" });
  await other.waitForFunction(() => window.laboratories, null, { timeout: 60000 });
  const message = await other.evaluate(async () => {
    const { createSubstep } = await import("../substep.mjs");
    try {
      await createSubstep(null);
      return "";
    } catch (error) {
      return error.message;
    }
  });
  assert.match(message, /must be an element/);
  assert.equal(await other.evaluate(() => {
    window.laboratories.none.remove();
    return document.querySelector("#none").children.length;
  }), 0);
  await other.waitForTimeout(500);
  await leave(other);
});

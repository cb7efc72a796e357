// Files in and out: node tests/web/files_test.mjs [FOLDER OF THE BUILT PAGE]
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { PNG } from "pngjs";
import { appears, call, click, drawn, drop, open, openPage, pick, quiet, reports,
  save } from "./browser.mjs";
import { variance } from "./pixels.mjs";

let session;
let page;
let mine; // a user's scene, as text

before(async () => {
  session = await open({ rate: 15 });
  page = await openPage(session);
  await call(page, "set", { scene: "bridge" });
  await call(page, "pause");
  const scene = JSON.parse(await readFile(new URL("../../scenes/pendulum.json", import.meta.url), "utf8"));
  mine = JSON.stringify({ ...scene, name: "mine", title: "My pendulum" });
});
after(() => session?.close());

const contents = async (download) => readFile(await download.path());

/** Closes the card of a file that was refused. */
async function dismiss() {
  await drawn(page);
  await page.keyboard.press("Escape");
  await drawn(page);
  assert.equal((await call(page, "report")).trouble, "");
}

test("a dropped scene file runs, and is available at the next visit", async () => {
  await drop(page, "mine.json", mine);
  assert.deepEqual([(await call(page, "report")).scene, (await call(page, "report")).trouble], ["mine", ""]);
  await page.reload();
  await page.waitForFunction(() => window.substep);
  assert.ok((await call(page, "scenes")).some((s) => s.name === "mine" && s.group === "own"));
  assert.deepEqual(await call(page, "load", "mine"), { ok: true, problems: [] });
  quiet(page);
});

test("a dropped model of another format is imported", async () => {
  const robot = `<mujoco model="robot"><worldbody><body><joint/><geom size="0.1" pos="1 0 0"/></body>
    </worldbody></mujoco>`;
  await drop(page, "robot.xml", robot);
  const report = await call(page, "report");
  assert.deepEqual([report.scene, report.trouble], ["robot", ""]);
  assert.match(report.notice, /^robot.xml: 0 approximated, 1 left out/);
  quiet(page);
});

test("an invalid file is reported by name, and the run is unchanged", async () => {
  await call(page, "set", { scene: "bridge" });
  await call(page, "pause");
  await call(page, "step", 20);
  const hash = await call(page, "hash");
  const files = {
    "broken.json": "{ this is no scene",
    "other.json": '{"name": "some-package", "version": "1.0.0"}',
    "empty.json": "",
    "list.json": "[1, 2, 3]",
    "deep.json": "[".repeat(200000),
    "picture.png": [0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0, 0, 0, 13],
    "utf16.json": [0xff, 0xfe, 0x7b, 0x00],
    "cut.json": mine.slice(0, mine.length / 2),
    "zero.json": `${mine}\0${mine}`,
    "model.xml": "<mujoco><worldbody></mujoco>",
    "mass.json": mine.replace(/"mass":\s*[0-9.]+/, '"mass":-1'),
  };
  for (const [name, bytes] of Object.entries(files)) {
    await drop(page, name, bytes);
    assert.equal((await call(page, "report")).trouble, `${name} was not loaded`);
    assert.equal(await call(page, "hash"), hash, name);
    if (name === "mass.json") {
      await drawn(page);
      await save(page, "problems");
    }
    await dismiss();
  }
  quiet(page);
});

test("a huge file is rejected without being read", async () => {
  const hash = await call(page, "hash");
  await page.evaluate(() => {
    const data = new DataTransfer();
    data.items.add(new File([new Uint8Array(40e6).fill(32)], "huge.json"));
    const event = new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true });
    document.querySelector(".substep-view").dispatchEvent(event);
  });
  await reports(page, "trouble", "huge.json was not loaded");
  assert.equal(await call(page, "hash"), hash);
  await dismiss();
  // A file just below the size limit goes through the heap, not the stack.
  await drop(page, "large.json", `${" ".repeat(8e6)}{`);
  assert.equal((await call(page, "report")).trouble, "large.json was not loaded");
  assert.equal(await call(page, "hash"), hash);
  await dismiss();
  quiet(page);
});

test("the menu opens a file", async () => {
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), pick(page, "Open scene …")]);
  await chooser.setFiles({ name: "chosen.json", mimeType: "application/json",
    buffer: Buffer.from(mine.replace('"mine"', '"chosen"')) });
  await reports(page, "scene", "chosen");
  quiet(page);
});

test("the current state is saved, and the run continues from its file", async () => {
  await call(page, "set", { scene: "heavy_stack", mode: "const", n: 8 });
  await call(page, "pause");
  await call(page, "reset");
  await call(page, "step", 60);
  const [download] = await Promise.all([page.waitForEvent("download"), pick(page, "Save scene as it is now")]);
  assert.equal(download.suggestedFilename(), "heavy_stack_at_1000ms.json");
  const text = (await contents(download)).toString();
  assert.equal(text, await call(page, "saved"));
  const before = await call(page, "report");
  assert.deepEqual(await call(page, "load", text), { ok: true, problems: [] });
  await call(page, "pause");
  const now = await call(page, "report");
  assert.equal(now.mode, "const");
  assert.ok(Math.abs(now.potential - before.potential) < 1e-3 * Math.abs(before.potential));
  quiet(page);
});

test("pictures of window and view equal the screen", async () => {
  for (const entry of ["window", "view"]) {
    const [download] = await Promise.all([page.waitForEvent("download"), pick(page, `Picture of the ${entry}`)]);
    assert.match(download.suggestedFilename(), /^heavy_stack.*\.png$/);
    const png = PNG.sync.read(await contents(download));
    assert.ok(entry === "window" ? png.width === 1280 && png.height === 720 : png.width < 1280);
    assert.ok(variance(png) > 60);
  }
  quiet(page);
});

test("a figure is an SVG with texts, and with its settings inside", async () => {
  await call(page, "set", { scene: "swinging_box", panel: "accuracy", level: "lab" });
  await call(page, "pause");
  await appears(page, "figure");
  await click(page, "figure");
  const [download] = await Promise.all([page.waitForEvent("download"), click(page, "84 mm wide")]);
  assert.equal(download.suggestedFilename(), "swinging_box-accuracy.svg");
  const svg = (await contents(download)).toString();
  const found = await page.evaluate((text) => {
    const parsed = new DOMParser().parseFromString(text, "image/svg+xml");
    return {
      fault: parsed.querySelector("parsererror")?.textContent ?? "",
      texts: [...parsed.querySelectorAll("text")].map((t) => t.textContent).join("\n"),
      about: JSON.parse(parsed.querySelector("metadata").textContent),
    };
  }, svg);
  assert.equal(found.fault, "");
  assert.match(found.texts, /solver operations per frame/);
  assert.doesNotMatch(found.texts, /Run again|SVG|Larger/, "controls");
  assert.match(svg, /^<svg [^>]*width="84mm"/);
  assert.equal(found.about.scene, "swinging_box");
  assert.equal(found.about.settings.alpha, 0.1);
  assert.match(found.about.link, /scene=swinging_box/);
  const own = await page.context().newPage();
  await own.setContent(svg);
  await save(own, "figure");
  assert.ok(variance(PNG.sync.read(await own.locator("svg").screenshot())) > 60);
  await own.close();
  quiet(page);
});

test("a video is recorded", async () => {
  await call(page, "play");
  await pick(page, "Record a video");
  await page.waitForTimeout(2500);
  await save(page, "recording");
  const [download] = await Promise.all([page.waitForEvent("download"), pick(page, "Stop the video")]);
  assert.match(download.suggestedFilename(), /\.webm$/);
  const bytes = await contents(download);
  assert.deepEqual([...bytes.subarray(0, 4)], [0x1a, 0x45, 0xdf, 0xa3]); // EBML
  assert.ok(bytes.length > 10000, `${bytes.length} bytes`);
  quiet(page);
});

// Files in and out: node tests/web/files_test.mjs [FOLDER OF THE BUILT PAGE [SUBSTEP]]
// With the command line, the page of the step doctor is compared with it.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { PNG } from "pngjs";
import { examples } from "../../web/doctor_examples.mjs";
import { appears, call, click, drawn, drop, leave, open, openPage, pick, pickUp, quiet, reports,
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

// ------------------------------------------------------------------------------------- the step doctor
const program = process.argv[3];

/** Drops a file on the page of the step doctor, and waits until it has said all. */
async function consult(doctor, name, text) {
  await doctor.dispatchEvent("body", "drop", { dataTransfer: await pickUp(doctor, name, text) });
  await answered(doctor);
}
const answered = (doctor) => doctor.waitForFunction(() => document.querySelector("#working").textContent === ""
  && (document.querySelector("#verdict").textContent !== "" || !document.querySelector("#trouble").hidden),
null, { timeout: 30000 });

/** What the page saves as JSON. */
async function diagnosed(doctor) {
  const [download] = await Promise.all([doctor.waitForEvent("download"), doctor.click("#save-json")]);
  return JSON.parse(await contents(download));
}

/** What the command line says of the same. */
function byCommandLine(text, ...flags) {
  const { status, stdout, stderr } = spawnSync(program, ["doctor", "-", "--json", "-", ...flags],
    { input: text, encoding: "utf8" });
  assert.ok(status >= 0 && status <= 2, stderr);
  return JSON.parse(stdout);
}

/** Takes frames of the run in the picture for so long. @returns its verdict */
const verdictAfter = (doctor, seconds) => doctor.evaluate((time) => {
  const { substep } = window;
  substep.pause();
  for (let i = 0; i < 1e4 && !substep.report().stopped && substep.report().time < time; ++i) substep.step(10);
  return substep.report().verdict;
}, seconds);

const runsAt = (doctor, text) => doctor.waitForFunction((start) =>
  document.querySelector("#run").textContent.startsWith(start), text, { timeout: 20000 });

test("the doctor reads the step of a model, fails above it, and a link has the same numbers", async () => {
  const doctor = await openPage(session, { path: "doctor.html" });
  await doctor.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  const { file, text } = examples.crane;
  await consult(doctor, file, text);
  const first = await diagnosed(doctor);
  const limit = first.largest_step;
  assert.equal(first.step, 0.01, "the model's own");
  assert.equal(first.verdict, "fails");
  if (program) assert.deepEqual(first, byCommandLine(text, "--engine", "mujoco", "--step", "0.01"));
  assert.match(await doctor.locator("#verdict").innerText(),
    /^MuJoCo, integrator Euler, needs steps below 7\.\d+\sms, set by the geometric stiffness of joint_\d/);
  // The picture rings the joint, and shows the run that fails above the limit.
  await runsAt(doctor, "At 10 ms");
  assert.deepEqual((await call(doctor, "report")).ringed, first.joints.map(({ name }) => name));
  assert.match(first.joints[0].name, /^joint_\d$/);
  assert.match(await verdictAfter(doctor, 1), /^fails at/);
  await doctor.click("#below");
  await runsAt(doctor, `At ${(0.9e3 * limit).toPrecision(3)} ms`);
  await answered(doctor);
  assert.equal((await diagnosed(doctor)).verdict, "holds narrowly");
  assert.equal(await verdictAfter(doctor, 1), "holds");
  // The slider, until it fails.
  await doctor.focus("#step");
  for (let i = 0; i < 10; ++i) await doctor.keyboard.press("ArrowRight");
  await answered(doctor);
  await doctor.waitForFunction(() => document.querySelector("#answer").className === "fails");
  await answered(doctor);
  const last = await diagnosed(doctor);
  assert.ok(last.step > limit && last.step < 1.3 * limit, `${last.step}`);
  assert.equal(last.runs.at(-1).holds, false);
  assert.match(await verdictAfter(doctor, 1), /^fails at/);
  assert.match(await doctor.locator("#details").innerText(), /Newton's method at this step\s+holds/);
  const shorter = last.remedies.find((remedy) => remedy.step !== undefined && remedy.holds);
  await save(doctor, "doctor");
  await doctor.click("#copy-badge");
  await doctor.waitForFunction(() => /copied/.test(document.querySelector("#shared").textContent));
  const badge = await doctor.evaluate(() => navigator.clipboard.readText());
  assert.match(badge, /^\[!\[MuJoCo[^\]]*\]\(data:image\/svg\+xml;base64,[A-Za-z0-9+/=]+\)\]\(http[^)]*doctor\.html#[^)]*model64=[^)]*\)\n$/);
  await doctor.click("#copy-link");
  await doctor.waitForFunction(() => document.querySelector("#shared").textContent === "Link copied");
  const link = await doctor.evaluate(() => navigator.clipboard.readText());
  await leave(doctor);
  const again = await openPage(session, { path: "doctor.html", fragment: link.split("#")[1] });
  await answered(again);
  assert.deepEqual(await diagnosed(again), last);
  assert.equal(await again.locator("#engine").inputValue(), "mujoco");
  // A remedy, applied.
  await again.click(`button[aria-label="Apply ${shorter.text}"]`);
  await answered(again);
  const cured = await diagnosed(again);
  assert.equal(cured.verdict, "holds");
  assert.ok(Math.abs(cured.step / shorter.step - 1) < 1e-5, `${cured.step}`);
  await leave(again);
});

test("the doctor names drives, and what was left out with its line", async () => {
  const doctor = await openPage(session, { path: "doctor.html", width: 390, height: 844, light: true });
  await doctor.click('[data-example="arm"]');
  await answered(doctor);
  const diagnosis = await diagnosed(doctor);
  assert.equal(diagnosis.by_drive, true);
  if (program) {
    assert.deepEqual(diagnosis, byCommandLine(examples.arm.text, "--engine", "mujoco", "--step", "0.002"));
  }
  assert.match(await doctor.locator("#details").innerText(), /wrist/);
  assert.match(await doctor.locator("#caveat").innerText(), /drives of this laboratory are implicit/);
  assert.match(await doctor.locator("details summary").innerText(), /1 left out/);
  await doctor.click("details summary");
  assert.match(await doctor.locator("details").innerText(), /arm\.xml:2/);
  // A remedy that changes the model, applied.
  const [{ text: armature }] = diagnosis.remedies.filter((remedy) => remedy.changes_model);
  await doctor.click(`button[aria-label="Apply ${armature}"]`);
  await doctor.waitForFunction((what) => document.querySelector("#patient").textContent.endsWith(what), armature);
  await answered(doctor);
  const cured = await diagnosed(doctor);
  assert.equal(cured.verdict, "holds");
  assert.ok(cured.largest_step >= 1.4 * diagnosis.step, `${cured.largest_step}`);
  assert.match(doctor.url(), /&scene64=/);
  // Another engine, which has no limit for drives.
  await doctor.selectOption("#engine", "drake");
  await answered(doctor);
  await doctor.waitForFunction(() => /Drake/.test(document.querySelector("#verdict").textContent));
  assert.match(await doctor.locator("#verdict").innerText(), /^No limit was found for Drake/);
  assert.equal(await doctor.evaluate(() => document.documentElement.scrollWidth), 390, "no sideways scrolling");
  await save(doctor, "doctor-phone");
  await leave(doctor);
});

test("the doctor refuses what is no model, and shows hostile names as text", async () => {
  const doctor = await openPage(session, { path: "doctor.html",
    fragment: "engine=none&step=9&warp=1&model64=AAAA" });
  await doctor.waitForFunction(() => !document.querySelector("#trouble").hidden);
  assert.match(await doctor.locator("#trouble").innerText(),
    /step: must be from 1e-05[^]*warp: is unknown[^]*model64[^]*engine: none is called none/);
  for (const [name, bytes, message] of [
    ["empty.xml", "", /empty\.xml was not read/],
    ["broken.xml", "<mujoco><worldbody></mujoco>", /broken\.xml was not read[^]*broken\.xml:1/],
    ["other.xml", "<html></html>", /neither <mujoco>/],
    ["picture.png", [0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0], /picture\.png was not read[^]*not text/],
    ["<img src=x>.json", "{", /<img src=x>\.json was not read/],
  ]) {
    await consult(doctor, name, bytes);
    assert.match(await doctor.locator("#trouble").innerText(), message);
    assert.equal(await doctor.locator("#trouble img").count(), 0);
  }
  const name = '&lt;img src=x onerror="window.harmed=1"&gt;&amp;,`'.replaceAll('"', "&quot;");
  await consult(doctor, "<script>window.harmed=2</script>.xml", examples.arm.text
    .replaceAll("wrist", name).replaceAll("hand", `&lt;b&gt;${name}`).replace("arm_on", `&lt;/title&gt;${name}`));
  assert.ok(await doctor.locator("#trouble").isHidden());
  assert.match(await doctor.locator("#verdict").innerText(), /<img src=x onerror="window\.harmed=1">&/);
  assert.equal(await doctor.locator(":is(#intake, #answer, #details) :is(img, b, script)").count(), 0);
  const [download] = await Promise.all([doctor.waitForEvent("download"), doctor.click("#save-html")]);
  const report = await doctor.context().newPage();
  await report.setContent((await contents(download)).toString());
  assert.match(await report.locator(".answer").innerText(), /needs steps below/);
  assert.equal(await report.locator("img, b, script").count(), 0);
  await report.close();
  assert.equal(await doctor.evaluate(() => window.harmed), undefined);
  // A model of many bodies: the page answers without their picture.
  const bodies = Array.from({ length: 501 }, (_, i) => ({ name: `b${i}`, mass: 1, position: [i, 0, 0],
    shape: { type: "sphere", radius: 0.1 } }));
  await doctor.dispatchEvent("body", "drop", { dataTransfer: await pickUp(doctor, "many.json",
    JSON.stringify({ format: "substep-scene", version: 2, name: "many", title: "Many", bodies })) });
  await doctor.waitForFunction(() => /^Not shown: it has 501 bodies/.test(document.querySelector("#run").textContent));
  await leave(doctor);
});

// Hostile links and scene files: the page stays responsive, and returns to the previous run:
// node tests/web/malice_test.mjs [FOLDER OF THE BUILT PAGE] [all]
// By day one case of each kind, or all on request.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { all, appears, call, click, drawn, dropPicked, find, leave, open, openPage, packScene, pickUp,
  place, read, save } from "./browser.mjs";

let session;
before(async () => { session = await open({ rate: 15 }); });
after(() => session?.close());

const shipped = async (name) =>
  JSON.parse(await readFile(new URL(`../../scenes/${name}.json`, import.meta.url), "utf8"));

/** Spheres in one place, so that all pairs touch. */
function heap(count, extra = {}) {
  const bodies = Array.from({ length: count }, (_, i) => (
    { name: `s${i}`, shape: { type: "sphere", radius: 0.5 }, mass: 1, position: [0, 0, 1e-3 * i] }));
  return { format: "substep-scene", version: 1, name: `heap_${count}`, title: `${count} spheres in a heap`,
    frame: 0.01, bodies, ...extra };
}

/** A chain of that many balls. */
function chain(count, settings = {}) {
  const bodies = Array.from({ length: count }, (_, i) => (
    { name: `b${i}`, shape: { type: "sphere", radius: 0.1 }, mass: 1 + 1e5 * (i === count - 1),
      position: [0.3 * (i + 1), 0, 0] }));
  const joints = bodies.map((body, i) => (
    { name: `j${i}`, type: "ball", a: body.name, b: i === 0 ? "world" : bodies[i - 1].name,
      anchor_a: [-0.15, 0, 0], anchor_b: [0.15, 0, 0] }));
  return { format: "substep-scene", version: 1, name: `chain_${count}`, title: `A chain of ${count}`,
    frame: 0.02, bodies, joints, settings };
}

const heavySettings = [
  "solver=pgs&iterations=100000&mode=const&n=10000",
  "solver=pgs&iterations=100000&mode=const&n=1",
  "solver=pgs&iterations=2000&mode=const&n=10000",
  "solver=xpbd&iterations=100000&mode=const&n=10000",
  "solver=xpbd&iterations=1000&mode=const&n=300",
  "solver=newton&iterations=100000&mode=const&n=10000&forces=numerov",
  "solver=newton&iterations=100&mode=const&n=10000&forces=mean",
  "solver=bpp&mode=const&n=10000&refinements=1000",
  "solver=bpp&mode=const&n=10000",
  "alpha=1e-300&n_max=10000&mode=adaptive",
  "alpha=1e-12&n_max=10000&mode=adaptive&policy=substep",
  "mode=inertia&n_cap=10000&alpha=1e-9",
];

/** A valid scene that takes long. */
const heavyRun = "solver=pgs&iterations=400&mode=const&n=10000";

/** @returns pairs of a description and a fragment */
function links() {
  const zeros = (size) => packScene(`{"a": "${"0".repeat(size)}"}`);
  const list = [];
  for (const scene of ["swinging_box", "heavy_stack", "ragdolls"]) {
    for (const settings of heavySettings) list.push([`${scene} ${settings}`, `scene=${scene}&${settings}`]);
  }
  const inside = (what, scene, rest = "") =>
    list.push([what, `scene64=${packScene(JSON.stringify(scene))}${rest}`]);
  inside("300 spheres at a point", heap(300));
  inside("600 spheres at a point", heap(600));
  inside("a chain of 2,000 and 100,000 sweeps", chain(2000), "&solver=pgs&iterations=100000");
  inside("a heap beside three others", heap(120), "&compare=mode:none;solver:pgs;mode:const,n:10000");
  inside("a script for a title", { ...heap(2), title: "<img src=x onerror=alert(1)>" });
  list.push(["100 MB in 100 kB", `scene64=${zeros(100e6)}`]);
  list.push(["3 MB of zeros", `scene64=${zeros(3e6)}`]);
  list.push(["a megabyte of noise", `scene64=${"Zz09_-".repeat(170000)}`]);
  list.push(["100,000 parts", "a=b&".repeat(100000)]);
  list.push(["100,000 times a scene", "scene=bridge&".repeat(100000)]);
  list.push(["a megabyte of percent signs", `scene=${"%00".repeat(350000)}`]);
  list.push(["compare of 10,000", `scene=bridge&compare=${"mode:none;".repeat(10000)}`]);
  list.push(["a compared run that is heavy", `scene=bridge&compare=${heavySettings[0].replaceAll("=", ":").replaceAll("&", ",")}`]);
  const toggles = Buffer.from([1, ...Array.from({ length: 150 }, (_, i) => [1, i % 2 ? 0x7f : 0]).flat()]);
  list.push(["150 effects switched before a frame", `scene=wall&events=${toggles.toString("base64url")}`]);
  list.push(["events of noise", `scene=bridge&events=${"AQqz-_".repeat(1300)}`]);
  list.push(["a megabyte of events", `scene=bridge&events=${"AAAA".repeat(250000)}`]);
  list.push(["an end that never comes", "scene=bridge&seconds=1e308&speed=1e308&load=1e308&seed=1e308"]);
  return list;
}

/** 20 files, each with its name. */
async function files() {
  const box = await shipped("swinging_box");
  const text = (scene) => JSON.stringify(scene);
  const edited = (change) => {
    const scene = structuredClone(box);
    change(scene);
    return text(scene);
  };
  return [
    ["heap_200", text(heap(200))], ["heap_600", text(heap(600))],
    ["heap_margin", text(heap(300, { contact: { margin: 10 } }))],
    ["heap_700", text(heap(700))], ["heap_3000", text(heap(3000))],
    ["chain_5000", text(chain(5000))], ["chain_10000", text(chain(10000, { mode: "const", n: 10000 }))],
    ["chain_sweeps", text(chain(500, { solver: "pgs", iterations: 100000, mode: "const", n: 1000 }))],
    ["chain_newton", text(chain(500, { solver: "newton", iterations: 1000, forces: "numerov" }))],
    ["chain_bent", text((() => {
      const bent = chain(3000);
      bent.bodies.forEach((body, i) => { body.velocity = [0, (i * 7919) % 13, (i * 104729) % 11]; });
      return { ...bent, start: "project" };
    })())],
    ["tiny_frame", edited((s) => { s.frame = 1e-5; s.settings = { mode: "const", n: 10000 }; })],
    ["long_frame", edited((s) => { s.frame = 1; s.settings = { mode: "adaptive", alpha: 1e-12, n_max: 10000 }; })],
    ["heaviest", edited((s) => { s.bodies.at(-1).mass = 1e12; })],
    ["fastest", edited((s) => { s.bodies.at(-1).velocity = [1e5, 1e5, 1e5]; })],
    ["gravity", edited((s) => { s.gravity = [1e4, 1e4, 1e4]; })],
    ["same_names", edited((s) => { s.bodies.forEach((body) => { body.name = "x"; }); })],
    ["deep", `${"[".repeat(2e6)}`], ["wide", `{"bodies": [${"{},".repeat(5e5)}{}]}`],
    ["seven_megabytes", edited((s) => { s.description = "x".repeat(7e6); })],
    ["nine_megabytes", "x".repeat(9e6)],
  ];
}

/** One case of each kind. */
const byDay = [`ragdolls ${heavySettings[0]}`, `heavy_stack ${heavySettings[4]}`,
  `swinging_box ${heavySettings[5]}`, `swinging_box ${heavySettings[10]}`, "300 spheres at a point",
  "a script for a title", "100 MB in 100 kB", "a megabyte of noise", "100,000 parts",
  "150 effects switched before a frame", "heap_700", "chain_5000", "deep", "nine_megabytes"];
const some = (list) => list.filter(([what]) => all || byDay.includes(what));

/** In the page: records the longest time without a response [ms]. */
function beat() {
  let last = performance.now();
  window.longest = 0;
  const next = () => {
    const now = performance.now();
    window.longest = Math.max(window.longest, now - last);
    last = now;
    setTimeout(next, 0);
  };
  next();
}

/** Resets the recorded time: the protocol of this test also blocks the page. */
const listenAgain = (page) => page.evaluate(() => new Promise((done) => {
  setTimeout(() => {
    window.longest = 0;
    done();
  }, 100);
}));

const silence = (page) => page.evaluate(() => Math.round(window.longest));

/**
 * Opens one case, lets it run, and goes back.
 * @param bring transfers it to the page; includes the overhead of the test's protocol
 * @param take opens what was transferred
 * @returns {what, silent, end}: the longest time without a response [ms], and the outcome
 */
async function suffer(page, what, bring, take) {
  const before = await call(page, "link");
  const { run } = await call(page, "report");
  const brought = await bring();
  await listenAgain(page);
  await take(brought);
  await read(page, run);
  await page.waitForTimeout(150);
  let report = await call(page, "report");
  const held = report.held !== "";
  let silent = await silence(page);
  if (held) {
    await appears(page, "Run it");
    const button = await find(page, "Run it"); // in spite of the forecast
    await listenAgain(page);
    await page.mouse.click(...place(button));
    await page.waitForTimeout(400);
    silent = Math.max(silent, await silence(page));
    report = await call(page, "report");
  }
  assert.match(await call(page, "hash"), /^[0-9a-f]{16}$/, what);
  const end = held ? "held" : report.trouble !== "" ? "refused" : report.verdict;
  const left = await call(page, "openLink", before.slice(before.indexOf("#")));
  assert.equal(left.ok, true, what);
  await drawn(page);
  assert.equal(await call(page, "link"), before, `${what}: the run before is back`);
  return { what, silent, end };
}

function tell(suffered) {
  const slow = [...suffered].sort((a, b) => b.silent - a.silent);
  for (const { what, silent, end } of slow.slice(0, 8)) console.log(`${silent} ms: ${what} (${end})`);
  const ends = { held: 0, refused: 0, runs: 0 };
  for (const { end } of suffered) ends[end in ends ? end : "runs"] += 1;
  console.log(Object.entries(ends).map(([end, count]) => `${count} ${end}`).join(", "));
}

async function openCalm() {
  const page = await openPage(session, { fragment: "scene=bridge&alpha=0.2" });
  await page.evaluate(beat);
  return page;
}

test("hostile links are rejected, wait for a confirmation, or run in slices", async () => {
  const page = await openCalm();
  const list = links();
  assert.ok(list.length >= 50, `${list.length} links`);
  const suffered = [];
  for (const [what, fragment] of some(list)) {
    suffered.push(await suffer(page, what, () => page.evaluateHandle((text) => [text], fragment),
      (link) => page.evaluate(([text]) => window.substep.openLink(text), link)));
  }
  tell(suffered);
  const count = (as) => suffered.filter(({ end }) => end === as).length;
  assert.ok(count("held") >= 0.4 * suffered.length, "too few heavy runs were held");
  assert.ok(count("refused") >= 0.1 * suffered.length);
  await leave(page);
});

test("hostile files, dropped on the page", async () => {
  const page = await openCalm();
  const list = await files();
  assert.equal(list.length, 20);
  const suffered = [];
  for (const [what, text] of some(list)) {
    suffered.push(await suffer(page, what, () => pickUp(page, `${what}.json`, text),
      (file) => dropPicked(page, file)));
  }
  tell(suffered);
  await leave(page);
});

test("a heavy run waits with a message and a button to go back", async () => {
  const page = await openCalm();
  const before = await call(page, "link");
  await call(page, "openLink", `scene=swinging_box&${heavyRun}`);
  await drawn(page);
  assert.match((await call(page, "report")).held, /10,000 sub-steps/);
  await save(page, "heavy-start");
  await click(page, "Go back");
  assert.equal(await call(page, "link"), before);
  const { frame } = await call(page, "report");
  await page.waitForFunction((f) => window.substep.report().frame > f, frame);
  await call(page, "openLink", `scene=swinging_box&${heavyRun}`);
  await drawn(page);
  await click(page, "Run it");
  await page.waitForFunction(
    () => window.substep.widgets().some(({ label }) => label === "Cancel"), null, { timeout: 20000 });
  await save(page, "long-frame");
  await click(page, "Cancel");
  const stopped = await call(page, "report");
  assert.equal(stopped.frame, 0);
  await leave(page);
});

test("a trap of the program is reported, and the page restarts with the previous run", async () => {
  const page = await openPage(session, { fragment: "scene=bridge&alpha=0.2" });
  await page.waitForURL(/scene=bridge.*alpha=0\.2/);
  await call(page, "set", { scene: "swinging_box" });
  await page.waitForURL(/scene=swinging_box/);
  // The next growth of the memory fails, and so does the call that needed it.
  await page.evaluate(() => {
    const { Memory } = WebAssembly;
    Memory.prototype.grow = () => { throw new RangeError("no more memory"); };
  });
  const bodies = heap(20000);
  bodies.bodies.forEach((body, i) => { body.position = [2 * (i % 200), 2 * Math.floor(i / 200), 0]; });
  for (let i = 0; i < 8; ++i) {
    const answer = await call(page, "load", JSON.stringify({ ...bodies, name: `field_${i}` }));
    if (/stopped/.test(answer.problems[0]?.message ?? "")) break;
  }
  await page.getByText("The laboratory stopped").waitFor({ timeout: 20000 });
  await save(page, "stopped");
  const answer = await call(page, "step", 1);
  assert.match(answer.problems[0].message, /the laboratory stopped/);
  page.complaints.length = 0; // it logged the reason
  await page.getByRole("button", { name: "Start again" }).click();
  await page.waitForFunction(() => window.substep?.report().scene === "bridge", null, { timeout: 60000 });
  assert.equal((await call(page, "report")).alpha, 0.2);
  await leave(page);
});

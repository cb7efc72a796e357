// The report of a sweep: node report_test.mjs SUBSTEP
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { paretoFront } from "../../app/report/pareto.mjs";
import { launch, openFile } from "./browser.mjs";

const program = process.argv[2];
const shots = process.env.SUBSTEP_SCREENSHOTS;
if (shots) mkdirSync(shots, { recursive: true });
const folder = mkdtempSync(join(tmpdir(), "substep-report-"));
const browser = await launch();

test.after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

execFileSync(program, ["sweep", "swinging_box", "--seconds", "1", "--quiet", "--out", folder]);
const report = join(folder, "report.html");
const results = readFileSync(join(folder, "results.jsonl"), "utf8").trim().split("\n").slice(1).map(line => JSON.parse(line));
const plain = results.filter(r => r.load === 1);

test("the Pareto front equals that of a brute-force search", () => {
  for (let round = 0; round < 200; ++round) {
    const points = Array.from({ length: round % 30 }, () => ({ cost: Math.floor(9 * Math.random()), error: Math.floor(9 * Math.random()) }));
    const front = new Set(paretoFront(points));
    for (const p of points) {
      const beaten = points.some(q => q.cost <= p.cost && q.error <= p.error && (q.cost < p.cost || q.error < p.error));
      assert.equal(front.has(p), !beaten);
    }
  }
});

test("its page is the one that this Node.js bundles", () => {
  const source = join(folder, "page.cpp");
  execFileSync(process.execPath, [fileURLToPath(new URL("../../app/report/build.mjs", import.meta.url)), source]);
  const [head, tail] = [...readFileSync(source, "utf8").matchAll(/\{([-\d,\s]+)\}/g)]
    .map(([, bytes]) => Buffer.from(bytes.split(",").map(Number)).toString());
  const page = readFileSync(report, "utf8");
  assert.ok(page.startsWith(head) && page.endsWith(tail));
});

for (const [name, options] of Object.entries({
  light: {}, dark: { dark: true }, phone: { width: 390, height: 844 },
})) {
  test(`it opens from disk without errors: ${name}`, async () => {
    const page = await openFile(browser, report, options);
    assert.deepEqual(page.complaints, []);
    assert.equal(await page.locator(".figure").count(), 7);
    const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wider <= 0, `${wider} pixels wider than the window`);
    if (shots) await page.screenshot({ path: join(shots, `report-${name}.png`), fullPage: true });
    await page.context().close();
  });
}

test("every point has a tooltip, and a click shows its command", async () => {
  const page = await openFile(browser, report, { height: 1400 });
  const dots = page.locator(".figure").first().locator('.picture svg:not(.swatch) g[aria-label="dot"] path, .picture svg:not(.swatch) g[aria-label="dot"] circle');
  const places = await dots.evaluateAll(nodes => nodes.map(node => {
    const { x, y, width, height } = node.getBoundingClientRect();
    return [x + width / 2, y + height / 2];
  }));
  assert.equal(places.length, plain.length, "one mark for every run");
  const tips = page.locator('.figure').first().locator('svg g[aria-label="tip"] text');
  for (const [x, y] of places) {
    await page.mouse.move(x, y);
    const text = (await tips.allTextContents()).join("");
    assert.match(text, /constant N|adaptive|damping|blend|inertia|full geometric stiffness|Newton|XPBD|small steps/, `at ${x}, ${y}`);
  }
  await page.mouse.click(...places[20]);
  const details = page.locator(".details");
  assert.match(await details.textContent(), /substep run swinging_box .*--seconds 1/);
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

test("each effect and the criterion have a bar, in operations or time", async () => {
  const page = await openFile(browser, report);
  const figure = page.locator(".figure").last();
  assert.equal(await figure.locator("h2").textContent(), "What each effect costs");
  assert.equal(await figure.locator('g[aria-label="bar"] rect, g[aria-label="bar"] path').count(), 2 * 3, "gravity, joints and the criterion, with two solvers");
  const axis = () => figure.locator('g[aria-label="x-axis label"]').textContent();
  assert.match(await axis(), /operations/);
  await figure.locator("select").selectOption("ms");
  assert.match(await axis(), /ms/);
  const cells = await figure.locator("td").allTextContents();
  assert.equal(cells[0], "130", "joint rows of a solve");
  assert.match(cells[1], /^130, .* updates per frame$/);
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

test("axes, methods and the theme can be switched", async () => {
  const page = await openFile(browser, report);
  const figure = page.locator(".figure").first();
  const name = () => figure.locator("svg[role=img]").getAttribute("aria-label");
  const before = await name();
  await figure.locator("select").nth(0).selectOption("energy");
  await figure.locator("select").nth(1).selectOption("flops");
  assert.notEqual(await name(), before);
  const marks = () => figure.locator('g[aria-label="dot"] path, g[aria-label="dot"] circle').count();
  const all = await marks();
  await figure.locator("button.key").first().click();
  assert.ok(await marks() < all);
  const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await ground();
  await page.getByRole("button", { name: "light / dark" }).click();
  assert.notEqual(await ground(), light);
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

test("pictures and data can be saved", async () => {
  const page = await openFile(browser, report);
  const saved = async button => {
    const [download] = await Promise.all([page.waitForEvent("download"), page.locator(".figure").first().getByRole("button", { name: button, exact: true }).click()]);
    return readFileSync(await download.path());
  };
  const svg = (await saved("SVG")).toString();
  assert.match(svg, /^<svg/);
  assert.ok(!svg.includes("var(--"), "the variables of the page are undefined outside of it");
  assert.deepEqual([...(await saved("PNG")).subarray(0, 4)], [0x89, 0x50, 0x4e, 0x47]);
  const rows = (await saved("CSV")).toString().trim().split("\n");
  assert.equal(rows.length, plain.length + 1);
  assert.deepEqual(page.complaints, []);
  await page.context().close();
});

// The report of the paper's figures and claims: node reproduction_test.mjs SUBSTEP
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { launch, openFile } from "./browser.mjs";

const program = process.argv[2];
const shots = process.env.SUBSTEP_SCREENSHOTS;
if (shots) mkdirSync(shots, { recursive: true });
const folder = mkdtempSync(join(tmpdir(), "substep-reproduction-"));
const browser = await launch();

test.after(async () => {
  await browser.close();
  rmSync(folder, { recursive: true });
});

// Fails if a card differs from its recorded result.
execFileSync(program, ["reproduce", "--quiet", "--out", folder]);

for (const [name, options] of Object.entries({
  light: {}, dark: { dark: true }, phone: { width: 390, height: 844 },
})) {
  test(`it opens from disk without errors: ${name}`, async () => {
    const page = await openFile(browser, join(folder, "report.html"), options);
    assert.deepEqual(page.complaints, []);
    assert.equal(await page.locator(".claim").count(), 9);
    assert.equal(await page.locator(".claim.fails").count(), 0);
    for (const text of await page.locator(".claim.differs .why").allTextContents()) {
      assert.match(text, /^Why they differ\. ./);
    }
    assert.equal(await page.locator(".claim.differs").count(), await page.locator(".claim.differs .why").count());
    assert.ok(await page.locator(".figure .picture > svg").count() >= 9);
    const wider = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(wider <= 0, `${wider} pixels wider than the window`);
    if (shots) await page.screenshot({ path: join(shots, `reproduction-${name}.png`), fullPage: true });
    await page.context().close();
  });
}

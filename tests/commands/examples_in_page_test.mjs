// The examples of the pages that need the web page, in Chromium:
//   node tests/commands/examples_in_page_test.mjs [DIST]
//   html   as a page beside the folder `substep`; it logs no error, and logs what a comment behind
//          console.log says
//   link   opened in the page: every setting that it names has its value
import assert from "node:assert/strict";
import { cpSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { call, open, openPage, quiet } from "../web/browser.mjs";
import { examples, pages } from "./examples.mjs";
import { until } from "./shell.mjs";

let session;
before(async () => { session = await open(); });
after(() => session?.close());

async function runHtml({ text }) {
  const folder = dirname(session.folder);
  cpSync(session.folder, join(folder, "substep"), { recursive: true });
  writeFileSync(join(folder, "example.html"),
    `<!doctype html>\n<meta charset="utf-8"><link rel="icon" href="data:,">\n${text}\n`);
  // The reader's server has a policy of its own; that of ./dev run forbids scripts within a page.
  const context = await session.browser.newContext({ bypassCSP: true });
  const page = await context.newPage();
  const logged = [];
  const wrong = [];
  page.on("console", (message) => {
    (message.type() === "error" ? wrong : logged).push(message.text());
  });
  page.on("pageerror", (error) => wrong.push(error.message));
  await page.goto(new URL("../example.html", session.address).href);
  const expected = [...text.matchAll(/console\.log\(.*?\/\/ (.*)/g)].map((match) => match[1]);
  assert.ok(expected.length > 0, "the block says nothing of what it logs");
  await until(`the page to log: ${expected.join("; ")}`, () => {
    assert.deepEqual(wrong, []);
    return expected.every((line) => logged.includes(line));
  }, 240); // without a graphics card, beside other tests
  await context.close();
}

async function openLink({ code }) {
  const page = await openPage(session, { fragment: code.slice(1) });
  const settings = new Map((await call(page, "settings")).map(({ name, value }) => [name, String(value)]));
  const report = await call(page, "report");
  for (const [key, value] of new URLSearchParams(code.slice(1))) {
    assert.equal(key === "scene" ? report.scene : settings.get(key), value, key);
  }
  quiet(page);
  await page.close();
}

const runners = { html: runHtml, link: openLink };
for (const page of pages()) {
  for (const example of examples(page).filter(({ kind, notRun }) => runners[kind] && !notRun)) {
    test(`${page}:${example.line}: ${example.code}`, () => runners[example.kind](example));
  }
}

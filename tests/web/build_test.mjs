// The last step of the page's build, and the sizes of its downloads: node tests/web/build_test.mjs
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";

const web = fileURLToPath(new URL("../../web", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "substep-build-"));
after(() => rmSync(folder, { recursive: true }));

const files = ["engine.wasm", "engine.data", "index.html", "example/article.html"];
const run = (script, ...args) =>
  execFileSync(process.execPath, [join(web, script), ...args], { encoding: "utf8" });

/** Writes the files of a build. @returns files.json */
function finish(page) {
  mkdirSync(join(folder, "example"), { recursive: true });
  for (const file of files) writeFileSync(join(folder, file), file);
  writeFileSync(join(folder, "index.html"), page);
  run("finish.mjs", web, folder, ...files);
  return JSON.parse(readFileSync(join(folder, "files.json"), "utf8"));
}

test("lists the files of this build, removes others, and writes the sizes", async () => {
  finish("old page");
  for (const old of ["old.mjs", "example/old.html"]) writeFileSync(join(folder, old), "");
  const { version, files: listed } = finish("page");
  assert.match(version, /^[0-9a-f]{16}$/);
  assert.deepEqual(listed, ["./", "engine.data", "engine.wasm", "example/article.html", "index.html",
    "version.mjs"]);
  assert.deepEqual(readdirSync(folder).sort(), ["engine.data", "engine.wasm", "example", "files.json",
    "index.html", "service_worker.js", "version.mjs"]);
  assert.deepEqual(readdirSync(join(folder, "example")), ["article.html"]);
  const { sizes } = await import(pathToFileURL(join(folder, "version.mjs")).href);
  assert.deepEqual(sizes, { "engine.wasm": 11, "engine.data": 11 });
});

test("the version is a hash of the contents", () => {
  const { version } = finish("page");
  assert.equal(finish("page").version, version);
  assert.notEqual(finish("another page").version, version);
});

test("prints the sizes of the downloads", () => {
  assert.match(run("sizes.mjs", folder), /plain +gzip +brotli\n[^]*\nall files +3 kB/);
});

// The examples of the pages are run: node tests/commands/examples_test.mjs [--night] [PAGE...]. Every code
// block of every *.md file, every command of `substep` in its text, and every example that substep --help
// prints is either run or in the list of exceptions.mjs; --night also runs those that take minutes.
// examples_in_page_test.mjs runs those of the web page.
//   commands   in a copy of the repository, all in one, in the order of the pages. With status 0, and
//              every file that a command writes by a flag or by ">" exists afterwards
//   bash, sh   the block as one script, which stops at the first command that fails
//   cpp        compiled and linked with the installed library; run, if it has main(). A part of a program
//              stands in the namespace substep, behind the includes that kFragment lists
//   diff       the lines that it adds are in a source of core/, those that it removes are not
//   json       parsed; a scene is also read by the scene reader
//   js, mjs    parsed
import assert from "node:assert/strict";
import { copyFileSync, existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync,
  writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { examples, pages, unused } from "./examples.mjs";
import { changes, contents, copyOfTree, git, root, run } from "./shell.mjs";

const words = process.argv.slice(2);
const night = words.includes("--night");
const chosen = words.filter((word) => word !== "--night");

// Files that the pages call the reader's own.
const kOwnFiles = {
  "my.json": "scenes/pendulum.json",
  "my_scene.json": "scenes/pendulum.json",
  "my_robot.xml": "tests/import/models/walker.xml",
  "my_robot.urdf": "tests/import/models/arm.urdf",
};
const kFragment = ["<algorithm>", "<cmath>", "<vector>", '"core/model/scene_builder.hpp"',
  '"core/model/settings.hpp"', '"core/sim/simulator.hpp"'];

// -------------------------------------------------------------------------------------------- commands
let copy = null;
const done = new Set(); // several pages print the same command

/** The copy of the repository in which commands run, and how to run one. */
function workplace() {
  if (!copy) {
    copy = copyOfTree(["release"]);
    for (const [name, from] of Object.entries(kOwnFiles)) {
      copyFileSync(join(root, from), join(copy.folder, name));
    }
    copy.before = contents(copy.folder);
  }
  const path = `${join(copy.folder, "build/release/bin")}:${process.env.PATH}`;
  return { cwd: copy.folder, env: { PATH: path } };
}

async function shell(text) {
  const { status, out } = await run("bash", ["-euo", "pipefail", "-c", text], workplace());
  assert.equal(status, 0, `${text}\nends with ${status}:\n${out.slice(-4000)}`);
}

/** Files that a command writes, by its flags. */
const outputs = (text) => [...text.matchAll(
  /(?:--(?:out|csv|json|html|badge|states|joints|picture|ship)[ =]|> ?)([\w./-]+\.\w+)(?=\s|$|')/g)]
  .map((match) => match[1]);

async function runCommand({ code }) {
  if (done.has(code.replace("./dev cli", "substep"))) return;
  await shell(code);
  done.add(code.replace("./dev cli", "substep"));
  for (const file of outputs(code)) {
    const path = join(workplace().cwd, file);
    assert.ok(existsSync(path) && statSync(path).size > 0, `${code}\nwrote no ${file}`);
  }
}

/** Commands may write files of their own, but what is shipped is what they write. */
function nothingShippedChanged() {
  if (!copy) return;
  const changed = changes(copy.before, contents(copy.folder)).filter((name) => copy.before.has(name));
  assert.deepEqual(changed.filter((name) => !(name in kOwnFiles)), []);
}

after(() => copy?.remove());

// -------------------------------------------------------------------------------------------- programs
/** A folder that is removed afterwards. */
async function inFolder(use) {
  const folder = mkdtempSync(join(tmpdir(), "substep-example-"));
  try {
    await use(folder);
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

const runCpp = ({ text }) => inFolder(async (folder) => {
  const works = async (...words) => {
    const { status, out } = await run(words[0], words.slice(1), { cwd: folder });
    assert.equal(status, 0, `${words.join(" ")}\nends with ${status}:\n${out.slice(-4000)}`);
  };
  const whole = /\bint main\(/.test(text);
  const includes = kFragment.map((name) => `#include ${name}\n`).join("");
  writeFileSync(join(folder, "example.cpp"),
    whole ? text : `${includes}namespace substep {\n${text}\n}  // namespace substep\n`);
  writeFileSync(join(folder, "CMakeLists.txt"), `
    cmake_minimum_required(VERSION 3.25)
    project(example LANGUAGES CXX)
    find_package(substep REQUIRED)
    ${whole ? "add_executable(example" : "add_library(example STATIC"} example.cpp)
    target_link_libraries(example PRIVATE substep::core)\n`);
  const build = join(root, "build/release");
  await works("cmake", "--install", build, "--component", "core", "--prefix", join(folder, "library"));
  await works("cmake", "-S", ".", "-B", "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
    `-DCMAKE_PREFIX_PATH=${join(folder, "library")}`);
  await works("cmake", "--build", "build");
  if (whole) await works(join(folder, "build/example"));
});

function checkDiff({ text }) {
  const sources = git(root, "ls-files", "core/*.hpp", "core/*.cpp").trim().split("\n")
    .map((name) => `\n${readFileSync(join(root, name), "utf8")}`).join("");
  for (const line of text.split("\n")) {
    const there = sources.includes(`\n${line.slice(1)}\n`);
    if (line.startsWith("+")) assert.ok(there, `no source has: ${line.slice(1)}`);
    if (line.startsWith("-")) assert.ok(!there, `a source still has: ${line.slice(1)}`);
  }
}

async function readJson({ text }) {
  const value = JSON.parse(text);
  if (value.format !== "substep-scene") return;
  writeFileSync(join(workplace().cwd, "example.json"), text);
  await shell("substep run example.json --seconds 0.1");
}

const parseModule = ({ text }) => inFolder(async (folder) => {
  mkdirSync(folder, { recursive: true });
  writeFileSync(join(folder, "example.mjs"), text);
  const { status, out } = await run(process.execPath, ["--check", join(folder, "example.mjs")]);
  assert.equal(status, 0, out);
});

const runners = {
  command: runCommand,
  script: ({ text }) => shell(text),
  cpp: runCpp,
  diff: checkDiff,
  json: readJson,
  module: parseModule,
  html: () => {}, // examples_in_page_test.mjs
  link: () => {},
  text: () => {}, // formulas
  unknown: ({ language, code }) => assert.fail(`no way is known to run ${language}: ${code}`),
};

// ----------------------------------------------------------------------------------------------- tests
test("every exception is of an example that a page has", () => {
  assert.deepEqual(unused(), []);
});

for (const page of pages()) {
  if (chosen.length > 0 && !chosen.includes(page)) continue;
  const own = examples(page).filter((example) => !example.notRun && (night || !example.night));
  if (own.length === 0) continue;
  test(page, async (t) => {
    for (const example of own) {
      await t.test(`${example.line}: ${example.code}`, () => runners[example.kind](example));
    }
    await t.test("what is shipped is unchanged", nothingShippedChanged);
  });
}

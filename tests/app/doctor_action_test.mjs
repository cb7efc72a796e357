// The GitHub Action of the step doctor, without GitHub: node tests/app/doctor_action_test.mjs SUBSTEP
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { fileURLToPath } from "node:url";

const program = process.argv[2];
const script = fileURLToPath(new URL("../../.github/actions/doctor/doctor.sh", import.meta.url));
const folder = mkdtempSync(join(tmpdir(), "substep-action-"));
after(() => rmSync(folder, { recursive: true }));

/** A rod on a drive with a limit of about 5.2 ms in MuJoCo's Euler. */
const rod = (joint) => `<mujoco><option gravity="0 0 0"/><worldbody><body><joint name="${joint}"
  axis="0 0 1"/><geom type="box" size="0.1 0.01 0.01" pos="0.1 0 0" mass="1"/></body></worldbody>
  <actuator><position joint="${joint}" kp="2000"/></actuator></mujoco>`;

const write = (name, text) => {
  mkdirSync(join(folder, name, ".."), { recursive: true });
  writeFileSync(join(folder, name), text);
};

/** @returns {status, lines, summary} */
function act(inputs) {
  const summary = join(folder, "summary.md");
  rmSync(summary, { force: true });
  const { status, stdout, stderr } = spawnSync(script, { cwd: folder, encoding: "utf8",
    env: { PATH: process.env.PATH, SUBSTEP: program, ENGINE: "mujoco", HELD: "0", RUNS: "false",
      NARROW: "false", FOLDER: "out", GITHUB_STEP_SUMMARY: summary, ...inputs } });
  assert.equal(stderr, "");
  return { status, lines: stdout.split("\n"), summary: existsSync(summary) ? readFileSync(summary, "utf8") : "" };
}

test("models that hold pass, and leave reports and badges", () => {
  write("robots/arm one.xml", rod("elbow"));
  write("robots/deep/hand.xml", rod("thumb"));
  const { status, lines, summary } = act({ MODELS: "robots/**/*.xml\n", STEP: "0.003" });
  assert.equal(status, 0, lines.join("\n"));
  assert.equal(lines.filter((line) => line.startsWith("::error") || line.startsWith("::warning")).length, 0);
  assert.match(summary, /robots\/arm one\.xml \| holds: Largest step: 5\.17 ms.*drive of elbow/);
  assert.match(summary, /robots\/deep\/hand\.xml/);
  assert.match(readFileSync(join(folder, "out/robots/arm one.xml.svg"), "utf8"), /below 5\.17 ms/);
  assert.match(readFileSync(join(folder, "out/robots/arm one.xml.html"), "utf8"), /elbow/);
  assert.equal(JSON.parse(readFileSync(join(folder, "out/robots/deep/hand.xml.json"), "utf8")).verdict, "holds");
});

test("one that fails, or cannot be read, fails with an annotation; a narrow margin warns", () => {
  write("robots/broken.xml", "<mujoco><worldbody></mujoco>");
  const failing = act({ MODELS: "robots/*.xml", STEP: "0.01" });
  assert.equal(failing.status, 1);
  const errors = failing.lines.filter((line) => line.startsWith("::error"));
  assert.equal(errors.length, 2);
  assert.match(errors[0], /^::error file=robots\/arm one\.xml::A step of 0\.01 s in mujoco fails\. Largest/);
  assert.match(errors[1], /^::error file=robots\/broken\.xml::.*not understood/);
  const narrow = { MODELS: "robots/arm*.xml", STEP: "0.005" };
  const warned = act(narrow);
  assert.deepEqual([warned.status, warned.lines.filter((l) => l.startsWith("::warning")).length], [0, 1]);
  assert.equal(act({ ...narrow, NARROW: "true" }).status, 1);
  const none = act({ MODELS: "nothing/*.xml", STEP: "0.01" });
  assert.equal(none.status, 1);
  assert.match(none.lines[0], /^::error::No file matches/);
});

test("names of files and joints are no commands of the workflow", () => {
  write("hostile/a::error,b|`c`.xml", rod("::error::x|&lt;b>"));
  const { status, lines, summary } = act({ MODELS: "hostile/*.xml", STEP: "0.005" });
  assert.equal(status, 0);
  const commands = lines.filter((line) => line.trimStart().startsWith("::"));
  assert.deepEqual(commands.map((line) => /^::(\w+)/.exec(line)[1]), ["group", "endgroup", "warning"]);
  assert.match(commands[2], /file=hostile\/a%3A%3Aerror%2Cb\|`c`\.xml::/);
  assert.doesNotMatch(summary, /<b>|`/);
});

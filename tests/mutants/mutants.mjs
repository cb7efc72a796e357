// Mutation tests: each mutant of mutants.json changes one place of a copy of the sources, and a test
// must fail there that passes without the change.
//   node tests/mutants/mutants.mjs [--check | --search] [NAME...]
// level: `core`, the default, is found by `./dev test`, `all` by `./dev test all`; `web`: needs the
// built page. `test` names the test that fails. --search looks for it among all tests of the level.
// --check only compares the mutants with the sources: each text to change must be there once.
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { availableParallelism, cpus } from "node:os";
import path from "node:path";
import { fileURLToPath } from "node:url";

const root = fileURLToPath(new URL("../..", import.meta.url));
const copy = path.join(root, "build/mutants");
const jobs = process.env.JOBS ?? String((availableParallelism ?? (() => cpus().length))());

/** Runs a command in the copy. @returns {ok, output} */
function run(command, ...args) {
  const { status, stdout, stderr, error } = spawnSync(command, args, { cwd: copy, encoding: "utf8",
    maxBuffer: 1 << 28, env: { ...process.env, CMAKE_CXX_COMPILER_LAUNCHER: "ccache" } });
  if (error) throw error;
  return { ok: status === 0, output: stdout + stderr };
}

function must(what, { ok, output }) {
  if (ok) return output;
  console.error(`${what} failed:\n${output.slice(-4000)}`);
  process.exit(1);
}

/** Copies the sources, but keeps the times of unchanged files, so that builds are incremental. */
function refresh() {
  const files = execFileSync("git", ["ls-files", "-co", "--exclude-standard", "-z"],
    { cwd: root, encoding: "utf8" }).split("\0").filter((file) => file && existsSync(path.join(root, file)));
  for (const file of files) {
    const text = readFileSync(path.join(root, file));
    const there = path.join(copy, file);
    if (existsSync(there) && readFileSync(there).equals(text)) continue;
    mkdirSync(path.dirname(there), { recursive: true });
    writeFileSync(there, text, { mode: file === "dev" ? 0o755 : 0o644 });
  }
}

const targets = (mutant) => (mutant.level === "all" ? [] : ["core_tests"]);
const labels = (mutant) => (mutant.level !== "all" ? "^(unit|physics|paper)$"
  : mutant.web ? "^web$" : "^(unit|physics|paper|golden|hard|app|web)$");

/** @returns the output if the build fails, or "" */
function build(mutant) {
  const native = run("ninja", "-C", "build/release", "-j", jobs, ...targets(mutant));
  if (!native.ok) return native.output;
  if (!mutant.web) return "";
  const page = run("ninja", "-C", "build/web", "-j", jobs);
  return page.ok ? "" : page.output;
}

/** @param test its exact name, or undefined: all tests of the level up to the first failure
 *  @returns names of the tests that ran and of those that failed */
function runTests(mutant, test) {
  const exact = (name) => `^${name.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")}$`;
  const { output } = run("ctest", "--test-dir", "build/release", "-j", jobs, "-L", labels(mutant),
    ...(test ? ["-R", exact(test)] : ["--stop-on-failure"]));
  const all = [...output.matchAll(/^ *\d+\/\d+ Test +#\d+: (.+?) \.+/gm)].map((match) => match[1]);
  const bad = [...output.matchAll(/^ *\d+\/\d+ Test +#\d+: (.+?) \.+.*\*\*\*/gm)].map((match) => match[1]);
  return { all, bad };
}

const args = process.argv.slice(2);
const search = args.includes("--search");
const names = args.filter((arg) => arg !== "--search" && arg !== "--check");
const known = JSON.parse(readFileSync(new URL("mutants.json", import.meta.url), "utf8"));
for (const name of names) {
  if (known.some((mutant) => mutant.name === name)) continue;
  console.error(`There is no mutant "${name}"; mutants.json lists them.`);
  process.exit(2);
}
const mutants = known.filter(({ name }) => names.length === 0 || names.includes(name));

const misplaced = mutants.filter(({ file, from }) =>
  readFileSync(path.join(root, file), "utf8").split(from).length !== 2);
for (const { name, file, from } of misplaced) console.log(`${name}: "${from}" is not exactly once in ${file}`);
if (misplaced.length > 0) process.exit(1);
if (args.includes("--check")) process.exit(0);

refresh();
const configure = (preset, options) => must(`configuring ${preset}`,
  run("cmake", "--preset", preset, "-DSUBSTEP_TESTS=ON", ...options));
const everything = mutants.some(({ level }) => level === "all");
configure("release", ["-DSUBSTEP_WERROR=OFF", `-DSUBSTEP_APP=${everything ? "ON" : "OFF"}`]);
if (mutants.some(({ web }) => web)) {
  configure("web", ["-DSUBSTEP_APP=ON", "-DSUBSTEP_TESTS=OFF"]);
  must("fetching the browser tests' packages", run("npm", "ci", "--prefix", "tests/web", "--no-audit", "--no-fund"));
}
for (const mutant of mutants) {
  const wrong = build(mutant);
  if (wrong) must("building without mutants", { ok: false, output: wrong });
}
let missed = 0;
for (const mutant of search ? [] : mutants) { // a test that fails anyway finds nothing
  const { all, bad } = runTests(mutant, mutant.test);
  if (all.length === 1 && bad.length === 0) continue;
  console.log(`${mutant.name}: ${all.length === 0 ? "there is no test" : "without the change fails"} ${mutant.test}`);
  missed += 1;
}
for (const mutant of missed > 0 ? [] : mutants) {
  const file = path.join(copy, mutant.file);
  const text = readFileSync(file, "utf8");
  writeFileSync(file, text.replace(mutant.from, () => mutant.to));
  try {
    const wrong = build(mutant);
    const { bad } = wrong ? { bad: [] } : runTests(mutant, search ? undefined : mutant.test);
    if (wrong) console.log(`${mutant.name}: does not compile\n${wrong.slice(-2000)}`);
    else console.log(`${mutant.name}: ${bad.length > 0 ? `found by ${bad.join(", ")}` : "NOT FOUND"}`);
    if (bad.length === 0) missed += 1;
  } finally {
    writeFileSync(file, text);
  }
}
console.log(`${mutants.length - missed} of ${mutants.length} mutants are found`);
process.exitCode = missed > 0 ? 1 : 0;

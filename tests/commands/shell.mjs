// Programs run by the tests of this folder, and copies of the repository for those that write into it.
import { spawn, spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, mkdtempSync, copyFileSync, lstatSync, readFileSync, readlinkSync, rmSync,
  symlinkSync, utimesSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

export const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");

/** Git accepts a repository that belongs to another user, as in a container of continuous integration. */
const environment = {
  ...process.env,
  GIT_CONFIG_COUNT: "1",
  GIT_CONFIG_KEY_0: "safe.directory",
  GIT_CONFIG_VALUE_0: "*",
};

const started = new Set();

/** Ends a program with all that it started. */
export function end(child, signal = "SIGTERM") {
  try {
    process.kill(-child.pid, signal);
  } catch { /* it has ended */ }
}

process.on("exit", () => { for (const child of started) end(child, "SIGKILL"); });
for (const signal of ["SIGINT", "SIGTERM"]) process.on(signal, () => process.exit(1));

/**
 * Starts a program in a process group of its own.
 * @param options {cwd, env, stdio}: env is added to the environment
 * @returns the child; child.out is what it has printed so far, child.done a promise of its exit status,
 *   or of the name of the signal that ended it
 */
export function start(command, args, { cwd = root, env = {}, stdio = ["ignore", "pipe", "pipe"] } = {}) {
  const child = spawn(command, args, { cwd, env: { ...environment, ...env }, stdio, detached: true });
  started.add(child);
  child.out = "";
  for (const stream of [child.stdout, child.stderr]) stream?.on("data", (text) => { child.out += text; });
  child.done = new Promise((ended) => {
    child.on("error", (error) => {
      child.out += String(error);
      ended(127);
    });
    child.on("close", (status, signal) => {
      started.delete(child);
      ended(status ?? signal);
    });
  });
  return child;
}

/** Runs a program to its end. @param options as for start(), and minutes @returns {status, out} */
export async function run(command, args, { minutes = 60, ...options } = {}) {
  const child = start(command, args, options);
  const timer = setTimeout(() => {
    child.out += `\nended after ${minutes} minutes`;
    end(child, "SIGKILL");
  }, minutes * 60e3);
  const status = await child.done;
  clearTimeout(timer);
  return { status, out: child.out };
}

/** Waits for a condition. @param ready returns what to wait for, or something false; may be a promise */
export async function until(what, ready, seconds = 60) {
  for (const start = Date.now(); Date.now() - start < seconds * 1e3;) {
    const found = await ready();
    if (found) return found;
    await new Promise((done) => { setTimeout(done, 100); });
  }
  throw new Error(`waited ${seconds} s for ${what}`);
}

/** The output of git. Throws if it fails. */
export function git(folder, ...args) {
  const { status, stdout, stderr } = spawnSync("git", args,
    { cwd: folder, env: environment, encoding: "utf8", maxBuffer: 1 << 28 });
  if (status !== 0) throw new Error(`git ${args.join(" ")}: ${stderr}`);
  return stdout;
}

/** Files that git knows or would add, and that exist. */
function files(folder) {
  const names = git(folder, "ls-files", "-z", "--cached", "--others", "--exclude-standard");
  return [...new Set(names.split("\0"))].filter((name) => name && existsSync(join(folder, name)));
}

/** A map from each file of a tree, without those that git ignores, to a hash of its content. */
export function contents(folder) {
  const hash = (path) => createHash("sha256").update(
    lstatSync(path).isSymbolicLink() ? readlinkSync(path) : readFileSync(path)).digest("hex");
  return new Map(files(folder).map((name) => [name, hash(join(folder, name))]));
}

/** The files in which two results of contents() differ. */
export const changes = (before, after) =>
  [...new Set([...before.keys(), ...after.keys()])].filter((name) => before.get(name) !== after.get(name));

/**
 * A copy of the repository as it is, uncommitted changes included, in which `git status` shows what
 * changed since. Ignored folders (build, node_modules) are links to those of the repository, so that
 * nothing is built again: CMakePresets.json keeps its time for that.
 * @param presets the build folders that will be used. If one were missing or older than its preset,
 *   ./dev would configure it with the copy as its source
 * @returns {folder, remove()}
 */
export function copyOfTree(presets) {
  for (const preset of presets) {
    const stamp = join(root, "build", preset, ".configured");
    const time = (path) => lstatSync(path).mtimeMs;
    if (!existsSync(stamp) || time(stamp) < time(join(root, "CMakePresets.json"))) {
      throw new Error(`build/${preset} is not as ./dev configures it; ./dev nightly does all`);
    }
  }
  const folder = mkdtempSync(join(tmpdir(), "substep-tree-"));
  const made = new Set();
  const parent = (path) => {
    if (!made.has(dirname(path))) mkdirSync(dirname(path), { recursive: true });
    made.add(dirname(path));
    return path;
  };
  for (const name of files(root)) {
    const [from, to] = [join(root, name), parent(join(folder, name))];
    const { atime, mtime } = lstatSync(from);
    if (lstatSync(from).isSymbolicLink()) symlinkSync(readlinkSync(from), to);
    else {
      copyFileSync(from, to);
      utimesSync(to, atime, mtime);
    }
  }
  const ignored = git(root, "ls-files", "-z", "--others", "--ignored", "--exclude-standard", "--directory");
  for (const name of ignored.split("\0").filter((entry) => entry.endsWith("/"))) {
    symlinkSync(join(root, name), parent(join(folder, name.slice(0, -1))));
  }
  git(folder, "init", "--quiet");
  git(folder, "add", "--all");
  const author = ["-c", "user.name=copy", "-c", "user.email=copy@localhost", "-c", "commit.gpgsign=false"];
  git(folder, ...author, "commit", "--quiet", "--no-verify", "--message", "the tree as it is");
  return { folder, remove: () => rmSync(folder, { recursive: true, force: true }) };
}

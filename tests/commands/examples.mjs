// The examples of the pages: code blocks, and commands in the text; and those that substep --help prints.
// Both tests of examples use this.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { blocks, spans } from "../meta/markdown.mjs";
import { exceptions } from "./exceptions.mjs";
import { git, root } from "./shell.mjs";

/** How a block is run, by the word after its fence; blocks without a word hold commands or a link. */
const kinds = {
  bash: "script",
  cpp: "cpp",
  diff: "diff",
  html: "html",
  javascript: "module",
  js: "module",
  json: "json",
  mjs: "module",
  sh: "script",
  text: "text",
};

/** A command without its comment. */
const command = (line) => line.replace(/(^|\s)#\s.*$/, "").trim();

/** A command in the text that can be run: of the command line and with arguments, none a placeholder. */
const isCommand = (text) => /^(\.\/dev cli|substep) \S+ \S|^\.\/dev cli \S+$|^(cmake|node) \S/.test(text) &&
  !/\b[A-Z]{2,}\b|\[|\.\.\./.test(text);

/** Lines that end with a backslash continue in the next one. */
const joined = (lines) => lines.join("\n").replace(/\\\n\s*/g, "").split("\n");

function ofBlock(page, { line, language, lines }) {
  const base = { page, line, text: lines.join("\n") };
  const code = lines.find((text) => text.trim() !== "")?.trim() ?? "";
  if (/^#\w+=/.test(code)) return [{ ...base, code, kind: "link" }];
  if (language !== "") return [{ ...base, code, kind: kinds[language] ?? "unknown", language }];
  return joined(lines).map(command).filter(Boolean)
    .map((text) => ({ ...base, code: text, kind: "command" }));
}

const program = join(root, "build/release/bin/substep");
const help = (words) => execFileSync(program, [...words, "--help"], { encoding: "utf8" });

/** Pages of the repository, and "substep --help" and the help of every command. */
export function pages() {
  const files = git(root, "ls-files", "-z", "--cached", "--others", "--exclude-standard", "*.md")
    .split("\0").filter((page) => page && existsSync(join(root, page))).sort();
  const [, list] = /^Subcommands:\n((?: .*\n)+)/m.exec(help([]));
  const commands = [...list.matchAll(/^ {2}(\w+)/gm)].map(([, name]) => `substep ${name} --help`);
  return [...files, "substep --help", ...commands];
}

/** The examples at the end of a help: lines that begin with a command. */
function ofHelp(page) {
  const lines = help(page.split(" ").slice(1, -1)).split("\n");
  const start = lines.findIndex((line) => /^Examples?:/.test(line));
  return lines.map((text, i) => ({ page, line: i + 1, code: text.trim(), text, kind: "command" }))
    .filter(({ text }, i) => start >= 0 && i > start && /^ {2}\S/.test(text));
}

function ofPage(page) {
  const text = readFileSync(join(root, page), "utf8");
  const inText = spans(text).filter((span) => isCommand(span.text))
    .map((span) => ({ page, line: span.line, code: span.text, text: span.text, kind: "command" }));
  return [...blocks(text).flatMap((block) => ofBlock(page, block)), ...inText]
    .sort((one, two) => one.line - two.line);
}

/**
 * Every example of a page, in its order.
 * @returns {page, line, code, text, kind, notRun, night}[]: kind is command, script, cpp, diff, html,
 *   module, json, link, text or unknown; code is the command, or the first line of a block; notRun and night
 *   are those of its entry in exceptions.mjs
 */
export function examples(page) {
  return (page.startsWith("substep ") ? ofHelp(page) : ofPage(page)).map((example) => {
    const { notRun, night } = exceptions.find((entry) => isFor(entry, example)) ?? {};
    return { ...example, notRun, night };
  });
}

const isFor = ({ page, code, kind }, example) =>
  page === example.page && (kind ? kind === example.kind : code === example.code);

/** Entries of exceptions.mjs for which no page has an example. */
export const unused = () => {
  const all = pages().flatMap((page) => examples(page));
  return exceptions.filter((entry) => !all.some((example) => isFor(entry, example)));
};

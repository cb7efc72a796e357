// Checks the pages: node tests/meta/pages_test.mjs [ROOT]. Every relative link and anchor of every *.md
// file exists; a link whose text is code names something in the linked file; commands of ./dev and
// substep exist; README.md has at most 100 lines.
import { existsSync, readFileSync, readdirSync } from "node:fs";
import path from "node:path";
import { fileURLToPath } from "node:url";

import { code, outsideCode, slugs } from "./markdown.mjs";

const root = process.argv[2] ?? fileURLToPath(new URL("../..", import.meta.url));
const read = file => readFileSync(path.join(root, file), "utf8");
const skipped = new Set([".git", ".cache", "build", "node_modules"]);

function files(folder, ending) {
  return readdirSync(path.join(root, folder), { withFileTypes: true }).flatMap(entry => {
    const file = path.join(folder, entry.name);
    if (skipped.has(entry.name)) return [];
    return entry.isDirectory() ? files(file, ending) : entry.name.endsWith(ending) ? [file] : [];
  });
}

// ------------------------------------------------------------------------------------- known commands
const known = {
  dev: new Set([...read("dev").matchAll(/^cmd_(\w+)\(\)/gm)].map(match => match[1]).concat("help")),
  label: new Set(/\^\(([a-z|]+)\)\$ \]\] \|\|\n\s*die "there is no label/.exec(read("dev"))[1].split("|").concat("all")),
  substep: new Set(files("app/cli", "_command.cpp")
    .flatMap(file => [...read(file).matchAll(/app\.add_subcommand\(\s*"(\w+)"/g)].map(match => match[1]))),
};

// ------------------------------------------------------------------------------------------- problems
/** The problems of a page, one per line. @param text of the page  @param page its path from the root */
function problems(text, page) {
  const found = [];
  const folder = path.dirname(page);
  const links = [];
  outsideCode(text, line => {
    for (const [, words, target] of line.matchAll(/\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)/g)) {
      links.push([words, target]);
      for (const [, inner] of words.matchAll(/\]\(([^)\s]+)\)/g)) links.push(["", inner]);
    }
    return line;
  });
  for (const [words, target] of links) {
    if (/^[a-z]+:/.test(target)) continue;
    const [file, anchor] = target.split("#");
    const linked = file ? path.join(folder, file) : page;
    if (file && !existsSync(path.join(root, linked))) {
      found.push(`${target} does not exist`);
      continue;
    }
    if (anchor !== undefined) {
      const there = linked === page ? text : linked.endsWith(".md") ? read(linked) : "";
      if (!slugs(there).includes(anchor)) found.push(`${target} is not a heading`);
    }
    const names = [...words.matchAll(/`([A-Za-z_][\w:.]*)(?:\(\))?`/g)].map(match => match[1]);
    const onlyCode = words.replace(/`[^`]*`/g, "").replace(/[, ]/g, "") === "";
    if (onlyCode && file && /\.(cpp|hpp|mjs)$/.test(linked) && !names.includes(path.basename(linked))) {
      const source = read(linked);
      for (const word of names.flatMap(name => name.split(/::|\./))) {
        if (!new RegExp(`\\b${word}\\b`).test(source)) found.push(`${word} is not in ${linked}`);
      }
    }
  }
  const commands = code(text);
  for (const [, command, rest] of commands.matchAll(/\.\/dev ([a-z]+)\b(.*)/g)) {
    if (!known.dev.has(command)) found.push(`./dev ${command} is unknown`);
    const [first] = rest.trim().split(/\s+/);
    if (command === "cli" && /^[a-z]+$/.test(first) && !known.substep.has(first)) {
      found.push(`./dev cli ${first} is unknown`);
    }
    if (command === "test" && /^[a-z]+$/.test(first) && !known.label.has(first)) {
      found.push(`./dev test ${first} is unknown`);
    }
  }
  for (const [, command] of commands.matchAll(/(?:^|[|/'] *)substep ([a-z]+)\b/gm)) {
    if (!known.substep.has(command)) found.push(`substep ${command} is unknown`);
  }
  return found.map(problem => `${page}: ${problem}`);
}

// ------------------------------------------------------------------------------------------ self-test
const faulty = `# A page
[a](README.md#nowhere) [b](nothing.md) [c](#b-page) [\`no_such_name()\`](core/sim/frame.cpp)
\`./dev fly\` \`./dev cli fly\` \`./dev test fly\` \`substep fly\`
[d](README.md) [e](#a-page) [f](https://example.org) [\`begin_frame()\`](core/sim/frame.cpp)
\`./dev test paper\` \`substep run SCENE\` a substep costs time
`;
const seen = problems(faulty, "page.md");
if (seen.length !== 8) {
  console.error(`expected 8 problems in the faulty page, found:\n${seen.join("\n")}`);
  process.exit(1);
}

// ---------------------------------------------------------------------------------------------- pages
const pages = files(".", ".md");
const wrong = pages.flatMap(page => problems(read(page), page));
const lines = read("README.md").split("\n").length - 1;
if (lines > 100) wrong.push(`README.md: ${lines} lines; at most 100`);
console.log(wrong.join("\n") || `${pages.length} pages are correct.`);
process.exit(wrong.length > 0 ? 1 : 0);

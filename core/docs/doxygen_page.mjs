// Converts a page for Doxygen: node core/docs/doxygen_page.mjs PAGE.md. The pages use GitHub's anchors,
// which Doxygen does not know. Every heading gets its own label, links between pages refer to these
// labels, and links to other files become text with a path.
import { readFileSync } from "node:fs";
import path from "node:path";

import { outsideCode, slugs } from "../../tests/meta/markdown.mjs";

const label = (page, anchor) => {
  if (page === "README.md" && !anchor) return "mainpage";
  return ["page", page.replace(/\.md$/, ""), anchor].filter(Boolean).join("_").replace(/[^A-Za-z0-9_]/g, "_");
};
const reference = (page, anchor) => label(page, anchor).replace(/^mainpage$/, "index");

const page = path.relative(process.cwd(), process.argv[2]);
const text = readFileSync(page, "utf8");
const named = slugs(text);
let heading = 0;

process.stdout.write(outsideCode(text, line => {
  if (/^#{1,6} /.test(line)) {
    const anchor = heading === 0 ? "" : named[heading];
    heading += 1;
    return `${line.replace(/`/g, "")} {#${label(page, anchor)}}`;
  }
  return line.replace(/(!?)\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)/g, (link, image, words, target) => {
    if (/^[a-z]+:/.test(target)) return link;
    const [file, anchor] = target.split("#");
    const linked = file ? path.normalize(path.join(path.dirname(page), file)) : page;
    if (image) return `![${words}](${linked})`;
    if (!linked.endsWith(".md")) return words.includes(path.basename(linked)) ? words : `${words} (${linked})`;
    return `[${words.replace(/`/g, "")}](@ref ${reference(linked, anchor === slugs(readFileSync(linked, "utf8"))[0] ? "" : anchor)})`;
  });
}));

// Parts of a Markdown page, for the tests and the site.

/** The page with every line outside fenced and indented code replaced by change(line). */
export function outsideCode(text, change) {
  let fence = false;
  return text.split("\n").map(line => {
    if (/^\s*```/.test(line)) {
      fence = !fence;
      return line;
    }
    return fence || /^ {4}/.test(line) ? line : change(line);
  }).join("\n");
}

/** The anchors that GitHub assigns to the headings of a page, in order. */
export function slugs(text) {
  const seen = new Map();
  const found = [];
  outsideCode(text, line => {
    const heading = /^#{1,6} +(.*?) *#*$/.exec(line);
    if (!heading) return line;
    const words = heading[1].replace(/\[([^\]]*)\]\([^)]*\)/g, "$1").replace(/[`*]/g, "");
    const slug = words.toLowerCase().replace(/[^\p{L}\p{N}\s_-]/gu, "").replace(/ /g, "-");
    const count = seen.get(slug) ?? 0;
    seen.set(slug, count + 1);
    found.push(count === 0 ? slug : `${slug}-${count}`);
    return line;
  });
  return found;
}

/** The code of a page: fenced and indented lines, and code spans of other lines, one per line. */
export function code(text) {
  const found = [];
  let fence = false;
  for (const line of text.split("\n")) {
    if (/^\s*```/.test(line)) fence = !fence;
    else if (fence || /^ {4}/.test(line)) found.push(line.trim());
    else for (const [, span] of line.matchAll(/`([^`]+)`/g)) found.push(span);
  }
  return found.join("\n");
}

/**
 * The code blocks of a page, fenced or indented by four spaces.
 * @returns {line, language, lines}[]: the number of the first line of code, from 1; the word after the
 *   fence, "" if there is none; the lines without their indentation
 */
export function blocks(text) {
  const found = [];
  let block = null;
  let fenced = false;
  text.split("\n").forEach((line, i) => {
    const fence = /^\s*```\s*(\S*)/.exec(line);
    const indented = /^ {4}/.test(line);
    if (fence) {
      block = fenced ? null : { line: i + 2, language: fence[1], lines: [] };
      fenced = !fenced;
      if (block) found.push(block);
    } else if (fenced) {
      block.lines.push(line);
    } else if (indented) {
      if (!block) found.push(block = { line: i + 1, language: "", lines: [] });
      block.lines.push(line.slice(4));
    } else {
      block = null;
    }
  });
  return found;
}

/** The code spans of a page outside its blocks: {line, text}[]. */
export function spans(text) {
  const found = [];
  let number = 0;
  let fence = false;
  for (const line of text.split("\n")) {
    ++number;
    if (/^\s*```/.test(line)) fence = !fence;
    else if (!fence && !/^ {4}/.test(line)) {
      for (const [, span] of line.matchAll(/`([^`]+)`/g)) found.push({ line: number, text: span });
    }
  }
  return found;
}

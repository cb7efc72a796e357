// Bundles the report's page into one HTML file and writes it as a C++ source: node build.mjs OUT.cpp
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const bundle = async (entry, options) => {
  const { outputFiles } = await build({
    entryPoints: [join(here, entry)],
    bundle: true,
    minify: true,
    write: false,
    legalComments: "inline", // keep the library's licence
    ...options,
  });
  return outputFiles[0].text;
};

const script = await bundle("report.mjs", { format: "iife", target: "es2020" });
const style = await bundle("report.css", { target: "es2020" });
const head = `<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<link rel="icon" href="data:,">
<title>substep</title>
<style>${style}</style>
<body>
<main id="report"></main>
<noscript>This report draws its pictures with JavaScript; the numbers are in results.jsonl.</noscript>
<script type="application/json" id="data">`;
// The bundle follows the data; a "</script" inside it would end it early.
const tail = `</script>
<script>${script.replaceAll("</script", "<\\/script")}</script>
</body>
</html>
`;

const bytes = (name, text) => {
  const numbers = [...Buffer.from(text, "utf8")].map(b => (b > 127 ? b - 256 : b));
  const rows = [];
  for (let i = 0; i < numbers.length; i += 40) rows.push(numbers.slice(i, i + 40).join(","));
  return `const char ${name}_bytes[] = {\n${rows.join(",\n")}};\n` +
         `const std::string_view ${name}{${name}_bytes, sizeof ${name}_bytes};\n`;
};
writeFileSync(process.argv[2], `// Written by app/report/build.mjs.
#include "app/report/page.hpp"
namespace substep::report {
${bytes("kHead", head)}${bytes("kTail", tail)}}  // namespace substep::report
`);

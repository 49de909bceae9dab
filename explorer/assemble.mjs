// Makes the one page of the explorer of its parts:
//   node assemble.mjs PAGE_FOLDER D3 ENGINE.js ENGINE.wasm OUTPUT.html
import {readFileSync, writeFileSync} from "node:fs";
import {join} from "node:path";
import {gzipSync} from "node:zlib";

const [folder, d3, engine, binary, output] = process.argv.slice(2);
const text = (name) => readFileSync(join(folder, name), "utf8");

// Nothing in a script may look like its end.
const script = (source) => source.replace(/<\/script/gi, "<\\/script").replace(/<!--/g, "<\\!--");

const files = ["engines.js", "settings.js", "figures.js", "chart.js", "page.js"];
const parts = {
  style: text("explorer.css"),
  engine: script(readFileSync(engine, "utf8")),
  worker: script(text("worker.js")),
  binary: gzipSync(readFileSync(binary), {level: 9}).toString("base64"),
  d3: script(readFileSync(d3, "utf8")),
  page: script(`"use strict";\n(() => {\n${files.map(text).join("\n")}\n})();`),
};
const page = text("explorer.html").replace(/\{\{(\w+)\}\}/g, (_, name) => parts[name]);
writeFileSync(output, page);

// Puts the sources of the page into one file that needs no network: npm ci && npm run build.
import { createHash } from "node:crypto";
import { readFileSync, readdirSync } from "node:fs";
import { build } from "esbuild";

const hash = createHash("sha256");
for (const name of readdirSync("src").sort()) hash.update(name).update(readFileSync(`src/${name}`));
hash.update(readFileSync("package-lock.json"));
await build({
  entryPoints: ["src/board.js"],
  outfile: "../static/board.js",
  bundle: true,
  minify: true,
  format: "esm",
  target: "es2022",
  legalComments: "eof",
  banner: { js: `// built from web/src ${hash.digest("hex")}; contains CodeMirror, MIT licence, (c) Marijn Haverbeke and others` },
});

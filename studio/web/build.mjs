// Bundles the page: node build.mjs OUT writes index.html, app.js, app.css and licences.txt into OUT.
// With --tests, node build.mjs --tests OUT FILE... bundles each test for node's own runner.
// The same sources give the same bytes, wherever they lie: no time, no path of this machine is in them.
import * as esbuild from "esbuild";
import { mkdir, readFile, readdir, writeFile } from "node:fs/promises";
import { basename, dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));

const shared = {
  bundle: true,
  absWorkingDir: here,
  charset: "utf8",
  legalComments: "none",
  logLevel: "warning",
  nodePaths: [join(here, "node_modules")],
  write: false,
};

async function bundlePage(out) {
  const result = await esbuild.build({
    ...shared,
    entryPoints: { app: "src/main.ts", "app.style": "src/style/app.css" },
    outdir: "page",
    format: "esm",
    target: ["chrome109", "firefox115", "safari16"],
    minify: true,
    metafile: true,
  });
  await mkdir(out, { recursive: true });
  for (const file of result.outputFiles) {
    const name = basename(file.path).replace("app.style.css", "app.css");
    await writeFile(join(out, name), file.contents);
  }
  await writeFile(join(out, "index.html"), await readFile(join(here, "src/index.html")));
  await writeFile(join(out, "licences.txt"), await licences(Object.keys(result.metafile.inputs)));
}

// The licences of all that was bundled, gathered from where npm put it; what says none is an error.
async function licences(inputs) {
  const names = new Set();
  for (const input of inputs) {
    const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
    if (found) names.add(found[1]);
  }
  let text = "The studio's page holds these packages of others, each under its own licence.\n";
  for (const name of [...names].sort()) {
    const folder = join(here, "node_modules", name);
    const about = JSON.parse(await readFile(join(folder, "package.json"), "utf8"));
    const file = (await readdir(folder)).sort().find((entry) => /^licen[cs]e/i.test(entry));
    if (!file) throw new Error(`${name} says no licence`);
    const words = (await readFile(join(folder, file), "utf8")).replaceAll("\r\n", "\n").trim();
    text += `\n${"-".repeat(72)}\n${name} ${about.version} (${about.license})\n\n${words}\n`;
  }
  return text;
}

async function bundleTests(out, files) {
  await mkdir(out, { recursive: true });
  for (const file of files) {
    await esbuild.build({
      ...shared,
      entryPoints: [file],
      outfile: join(out, basename(file).replace(/\.ts$/, ".mjs")),
      format: "esm",
      platform: "neutral", // what the page has of each package, not what node would have
      mainFields: ["module", "main"],
      external: ["node:*"],
      target: "node18",
      write: true,
    });
  }
}

const [first, ...rest] = process.argv.slice(2);
if (first === "--tests" && rest[0]) await bundleTests(rest[0], rest.slice(1));
else if (first && first !== "--tests") await bundlePage(first);
else throw new Error("usage: node build.mjs OUT, or node build.mjs --tests OUT FILE...");

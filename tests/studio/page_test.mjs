// The studio in a real browser: node page_test.mjs PROGRAM SOURCE PAGE SCRATCH. PAGE is the folder in which npm has put
// the page's packages. Opens a small garden, types, drags, undoes, exports, and looks for what keeps somebody out.
// Prints a line that begins with "skipped:" where a browser or the page is missing. Times are ten of those on a desk.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { copyFile, mkdir, readFile, rm, writeFile } from "node:fs/promises";
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

const [program, source, page_folder, scratch] = process.argv.slice(2);
const chromium_path = process.env.ESPALIER_CHROMIUM ?? "/usr/bin/chromium";

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(0);
}
if (!existsSync(chromium_path)) skip(`no browser at ${chromium_path}`);
if (!existsSync(join(page_folder, "node_modules/playwright-core"))) skip("the page's packages are not here");
const require = createRequire(join(page_folder, "package.json"));
const { chromium } = require("playwright-core");

/** The garden wall with a rule file of its own, in a folder that may be written. */
async function makeProject() {
  await rm(scratch, { recursive: true, force: true });
  await mkdir(scratch, { recursive: true });
  const scene = (await readFile(join(source, "scenes/library/garden_wall.yaml"), "utf8"))
    .replaceAll("../../rules/library/courtyard_vine.yaml", "vine.yaml")
    .replaceAll("../meshes/", join(source, "scenes/meshes/"))
    .replace("iterations: 51", "iterations: 30");
  await writeFile(join(scratch, "garden.yaml"), scene);
  await copyFile(join(source, "rules/library/courtyard_vine.yaml"), join(scratch, "vine.yaml"));
  return join(scratch, "garden.yaml");
}

async function serve(scene) {
  const child = spawn(program, ["studio", scene, "--no-open"], { stdio: ["ignore", "pipe", "inherit"] });
  process.on("exit", () => child.kill("SIGINT")); // however this ends
  const address = await new Promise((resolve, reject) => {
    let said = "";
    child.stdout.on("data", (piece) => {
      said += piece;
      const found = /http:\/\/127\.0\.0\.1:\d+\/\?token=\w+/.exec(said);
      if (found) resolve(found[0]);
    });
    child.on("exit", (status) => reject(new Error(`the program ended with ${status}`)));
  });
  return { child, address };
}

const counts = (page) => page.evaluate(() => window.studio.counts());
const text = (page) => page.evaluate(() => window.studio.text());
const settled = (page, after) =>
  page.waitForFunction((version) => window.studio.counts().done > version && window.studio.settled(), after, { timeout: 60_000 });

async function putCursor(page, words) {
  await page.evaluate((find) => window.studio.select(find), words);
}

async function main() {
  const scene = await makeProject();
  const { child, address } = await serve(scene);
  const browser = await chromium.launch({
    executablePath: chromium_path,
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking"],
  });
  const faults = [];
  try {
    const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme: "light", acceptDownloads: true });
    page.on("pageerror", (error) => faults.push(error.message));
    page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
    const answer = await page.goto(address);
    if ((await answer.text()).includes("built without its page")) skip("the program was built without its page");

    await settled(page, 0);
    const first = await counts(page);
    assert.ok(first.segments > 1000, `something grew: ${first.segments} segments`);
    assert.ok(first.calls <= 60 && first.triangles <= 2_000_000, `${first.calls} calls, ${first.triangles} triangles`);
    await page.screenshot({ path: join(scratch, "light.png") });

    await step("typing a bias grows another plant", async () => {
      await putCursor(page, "0.08");
      const began = Date.now();
      await page.keyboard.type("0.4");
      await page.waitForFunction((version) => window.studio.counts().version > version, first.version, { timeout: 3000 });
      console.log(`  first geometry after ${Date.now() - began} ms`);
      await settled(page, first.done);
      assert.notEqual((await counts(page)).segments, first.segments);
    });

    await step("a typo is marked, and its fix mends it", async () => {
      await putCursor(page, "up:");
      await page.keyboard.type("upp:");
      const mark = page.locator(".cm-lintRange-error");
      await mark.first().waitFor({ timeout: 3000 });
      assert.equal(await mark.first().textContent(), "upp");
      await page.screenshot({ path: join(scratch, "typo.png") });
      await mark.first().hover();
      await page.locator(".cm-diagnosticAction").click({ timeout: 5000 });
      await mark.first().waitFor({ state: "detached", timeout: 3000 });
      assert.match(await text(page), /\n {2}up: 0\.4/);
    });

    await step("a drag of a slider is one step of undo", async () => {
      const before = await text(page);
      const box = await page.locator('[data-dial=\'["random_tree","branch_angle"]\'] .slider').boundingBox();
      await page.mouse.move(box.x + box.width * 0.34, box.y + 9);
      await page.mouse.down();
      for (let i = 1; i <= 8; i++) await page.mouse.move(box.x + box.width * (0.34 + 0.04 * i), box.y + 9);
      await page.mouse.up();
      const after = await text(page);
      assert.notEqual(after, before);
      assert.match(after, /branch_angle: \d+ +# degrees/);
      await page.locator(".cm-content").focus();
      await page.keyboard.press("Control+z");
      assert.equal(await text(page), before);
    });

    await step("what may be written is offered", async () => {
      await putCursor(page, "  up: 0.4");
      await page.keyboard.press("End");
      await page.keyboard.press("End");
      await page.keyboard.press("Enter");
      await page.keyboard.type("tw");
      await page.locator(".cm-tooltip-autocomplete li", { hasText: "twist" }).first().waitFor({ timeout: 3000 });
      await page.screenshot({ path: join(scratch, "offers.png") });
      await page.keyboard.press("Escape");
      for (let i = 0; i < 2; i++) await page.keyboard.press("Backspace");
    });

    await step("a seed that is dragged moves in the scene's text, in one step of undo", async () => {
      await page.getByRole("tab", { name: /garden\.yaml/ }).click();
      const before = await text(page);
      const from = await page.evaluate(() => window.studio.seedPoint(6));
      await page.mouse.move(from.x, from.y);
      await page.mouse.down();
      for (let i = 1; i <= 6; i++) {
        await page.mouse.move(from.x - 6 * i, from.y - 5 * i);
        await page.waitForTimeout(30);
      }
      await page.mouse.up();
      await page.waitForFunction((old) => window.studio.text() !== old && !window.studio.dragging(), before, { timeout: 5000 });
      await page.locator(".cm-content").focus();
      await page.keyboard.press("Control+z");
      assert.equal(await text(page), before);
      await page.keyboard.press("Control+y");
      assert.notEqual(await text(page), before);
    });

    await step("a limb says why it grew so", async () => {
      const { done } = await counts(page);
      await settled(page, done - 1);
      const at = await page.evaluate(() => window.studio.limbPoint(5, 12));
      await page.mouse.click(at.x, at.y);
      await page.locator("#card h2").waitFor({ timeout: 20_000 });
      await page.waitForTimeout(300);
      await page.screenshot({ path: join(scratch, "why.png") });
      await page.locator("#card .close").click();
    });

    await step("what falls on surfaces is shown", async () => {
      await page.getByRole("button", { name: "What is drawn on surfaces" }).click();
      await page.getByRole("menuitemradio", { name: /sky exposure/ }).click();
      await page.locator("#legend").waitFor({ timeout: 20_000 });
      await page.waitForTimeout(500);
      await page.screenshot({ path: join(scratch, "sky.png") });
    });

    await step("how near things are is shown in a cut, which can be moved", async () => {
      await page.getByRole("button", { name: "What is drawn on surfaces" }).click();
      await page.getByRole("menuitemradio", { name: /Boundary layers/ }).click();
      await page.locator("#legend .axis").first().waitFor({ timeout: 20_000 });
      await page.getByRole("button", { name: "At right angles to y" }).click();
      await page.getByRole("slider", { name: "Where the cut lies" }).fill("200");
      await page.waitForTimeout(900);
      await page.screenshot({ path: join(scratch, "layers.png") });
      assert.match(await page.locator("#legend output").textContent(), /^\d+\.\d\d m$/);
      await page.getByRole("button", { name: "What is drawn on surfaces" }).click();
      await page.getByRole("menuitemradio", { name: /As they are/ }).click();
      await page.locator("#legend").waitFor({ state: "hidden", timeout: 5000 });
    });

    await step("the model goes out", async () => {
      const coming = page.waitForEvent("download", { timeout: 60_000 });
      await page.getByRole("button", { name: "Export", exact: true }).click();
      await page.getByRole("menuitem", { name: /Model/ }).click();
      const download = await coming;
      const file = await readFile(await download.path());
      const report = await require("gltf-validator").validateBytes(new Uint8Array(file));
      assert.equal(report.issues.numErrors, 0, JSON.stringify(report.issues.messages.slice(0, 5)));
      assert.ok(report.info.totalTriangleCount > 10_000, `${report.info.totalTriangleCount} triangles`);
    });

    await step("saving, and another hand's change", async () => {
      await page.getByRole("tab", { name: /vine\.yaml/ }).click();
      await page.keyboard.press("Control+s");
      await page.waitForFunction(() => !window.studio.unsaved(), null, { timeout: 5000 });
      const saved = await readFile(join(scratch, "vine.yaml"), "utf8");
      assert.match(saved, /up: 0\.4/);
      await writeFile(join(scratch, "vine.yaml"), saved.replace("up: 0.4", "up: 0.2"));
      await page.getByRole("button", { name: "Take theirs" }).click({ timeout: 10_000 });
      assert.match(await text(page), /up: 0\.2/);
    });

    await step("nothing keeps anybody out", async () => {
      for (const scheme of ["light", "dark"]) {
        await page.emulateMedia({ colorScheme: scheme });
        await page.waitForTimeout(400);
        await page.evaluate(await readFile(require.resolve("axe-core/axe.min.js"), "utf8"));
        const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
        const serious = violations.filter((each) => ["serious", "critical"].includes(each.impact));
        assert.deepEqual(serious.map((each) => `${each.id}: ${each.nodes.slice(0, 3).map((node) => `${node.html} ${node.failureSummary}`).join("; ")}`), [], scheme);
        await page.screenshot({ path: join(scratch, `${scheme}_end.png`) });
      }
    });

    await step("edits leave no memory behind", async () => {
      const before = (await counts(page)).memory;
      for (let i = 0; i < 12; i++) {
        const { done } = await counts(page);
        await page.evaluate((value) => window.studio.type("0.2", value), i % 2 ? "0.2" : "0.20");
        await settled(page, done);
      }
      const after = (await counts(page)).memory;
      assert.ok(after.geometries <= before.geometries + 2 && after.textures <= before.textures + 1, JSON.stringify({ before, after }));
    });

    assert.deepEqual(faults.filter((each) => !/GPU stall|409|ERR_/.test(each)), []);
  } finally {
    await browser.close();
    child.removeAllListeners("exit");
    child.kill("SIGINT");
  }
}

async function step(name, act) {
  const began = Date.now();
  try {
    await act();
    console.log(`ok: ${name} (${Date.now() - began} ms)`);
  } catch (error) {
    console.log(`failed: ${name}: ${error.message}`);
    process.exitCode = 1;
  }
}

await main();

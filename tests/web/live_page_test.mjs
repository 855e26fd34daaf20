// node live_page_test.mjs SITE chromium|firefox RAINREF: the live page gives the hashes that the native program prints, with parameters as they are and
// changed; scenes come from files and go to them; what is refused is said; the ports run beside it.
import assert from "node:assert";
import {execFileSync} from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import {launch, open, serve} from "./browser.mjs";

const [folder, name, rainref] = process.argv.slice(2), effects = ["puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"];
const work = fs.mkdtempSync(path.join(os.tmpdir(), "live-page-"));
/// The lines of the last of N frames, by the native program.
const native = (scene, size, frames, ...set) =>
    execFileSync(rainref, ["hash", scene, "--size", size, "--frames", String(frames), ...set.flatMap(s => ["--set", s])], {encoding: "utf8"})
        .split("\n").filter(line => line.startsWith(`${frames - 1} `));

async function drive(page) {
  page.setDefaultTimeout(120000);
  const text = id => page.$eval(id, e => e.textContent);
  const lines = async () => (await text("#lines")).trimEnd().split("\n");
  const settled = condition => page.waitForFunction(condition);
  const frameIs = frame => page.waitForFunction(wanted => document.body.dataset.frame === String(wanted), {}, frame);
  const opened = () => settled(() => document.body.dataset.frame === "0" && !document.getElementById("status").textContent.startsWith("Opening"));
  const unset = () => page.evaluate(() => { delete document.body.dataset.frame; });
  const smallest = async () => {
    await unset();
    await page.select("#size", "320 x 180");
    await opened();
  };

  let equal = 0;
  const check = (found, expected, words) => {
    assert(expected.length > 0);
    assert.deepStrictEqual(found, expected, words);
    equal += expected.length;
  };
  await settled(() => document.body.dataset.frame !== undefined);
  await settled(() => !document.getElementById("status").textContent.startsWith("Opening"));
  await smallest();
  for (const effect of effects) {
    await unset();
    await page.select("#scene", `${effect}/default.toml`);
    await opened();
    check(await lines(), native(`${effect}/default.toml`, "320x180", 1), `${effect}, frame 0`);
    await page.click("#step");
    await frameIs(1);
    await page.click("#step");
    await frameIs(2);
    check(await lines(), native(`${effect}/default.toml`, "320x180", 3), `${effect}, frame 2`);
    assert.strictEqual(await text("#command"), `rainref hash ${effect}/default.toml --size 320x180 --frames 3`);
  }

  // A parameter on the way, and from the start.
  await unset();
  await page.select("#scene", "puddle/default.toml");
  await opened();
  const give = (id, value) => page.$eval(`[id="${id}"]`, (input, v) => { input.value = v; input.dispatchEvent(new Event("change")); }, value);
  await give("p-rain.rate", "40");
  await settled(() => document.getElementById("status").textContent.startsWith("From the next frame"));
  await page.click("#step");
  await frameIs(1);
  assert.notDeepStrictEqual(await lines(), native("puddle/default.toml", "320x180", 2));
  assert.match(await text("#command"), /^A parameter was changed/);
  await unset();
  await page.click("#reset");
  await opened();
  await page.click("#step");
  await frameIs(1);
  check(await lines(), native("puddle/default.toml", "320x180", 2, "rain.rate=40"), "rain.rate=40");
  assert.strictEqual(await text("#command"), "rainref hash puddle/default.toml --size 320x180 --frames 2 --set rain.rate=40");

  // What a running scene may not change starts anew with it; what no scene may say is refused, and the scene goes on.
  await give("p-puddle.storage", "rg32f");
  const again = ".parameter:has([id='p-puddle.storage']) .refused";
  await page.waitForSelector(`${again}:not([hidden]) button`);
  assert.match(await text(again), /puddle\.storage/);
  await unset();
  await page.click(`${again} button`);
  await opened();
  check(await lines(), native("puddle/default.toml", "320x180", 1, "rain.rate=40", "puddle.storage=rg32f"), "rg32f");
  await give("p-puddle.damping", "7");
  await page.waitForSelector(".parameter:has([id='p-puddle.damping']) .refused:not([hidden])");
  assert.match(await text(".parameter:has([id='p-puddle.damping']) .refused"), /puddle\.damping.*0\.5 to 1.*7/s);
  assert.strictEqual(await page.$eval("[id='p-puddle.damping']", e => e.value), "0.97");

  // Scene files: one of one's own, one with a mistake, and what Save gives.
  const own = path.join(work, "own.toml"), wrong = path.join(work, "wrong.toml");
  fs.writeFileSync(own, 'effect = "edge_splash"\nvariant = "as-published"\nseed = 5\n');
  fs.writeFileSync(wrong, 'effect = "puddle"\nvariant = "corrected"\n[rain]\nrat = 5\n');
  const file = await page.$("#file");
  await unset();
  await file.uploadFile(own);
  await opened();
  check(await lines(), native(own, "320x180", 1), "own scene");
  await file.uploadFile(wrong);
  await page.waitForSelector("#problem:not([hidden])");
  assert.match(await text("#problem"), /wrong\.toml:4.*rain\.rat.*rain\.rate/s);
  const saved = await page.evaluate(async () => {
    const {sceneText} = await import("./live_toml.js"), {Engine} = await import("./engine.js"), engine = new Engine("live_operations.js");
    const effects = await engine.run("describe");
    const opened = await engine.run("open", {toml: await (await fetch("scenes/windshield/default.toml")).text(), set: ["rain.rate=3", "run.size=[320, 180]"]});
    return sceneText(opened.scene, effects.windshield.parameters);
  });
  const kept = path.join(work, "saved.toml");
  fs.writeFileSync(kept, saved);
  assert.deepStrictEqual(native(kept, "320x180", 1), native("windshield/default.toml", "320x180", 1, "rain.rate=3"), "a saved scene");

  // The ports of the GPU, where there is one.
  await unset();
  await page.select("#scene", "rainy_glass/default.toml");
  await opened();
  assert(await page.evaluate(() => navigator.gpu !== undefined), "no WebGPU here");
  await page.click("#run_pass");
  await settled(() => / of \d+ texels differ/.test(document.getElementById("compared").textContent));
  const [, differ, of, most] = (await text("#compared")).match(/(\d+) of (\d+) texels differ, by (\S+) at most/);
  // Where halves are cut, as in Firefox here, an eighth of them is the next one: 2^-5 for radiance up to 64.
  assert(Number(of) === 320 * 180 && Number(differ) < 0.2 * Number(of) && Number(most) < 0.032, `${differ} of ${of}, by ${most}`);
  return equal;
}

const site = await serve(path.resolve(folder)), browser = await launch(name), errors = [];
try {
  const equal = await drive(await open(browser, site, "live.html", errors));
  assert.deepStrictEqual(errors, []);
  console.log(`live page in ${name}: ${equal} hash lines as native`);
} finally {
  await browser.close();
  site.close();
  fs.rmSync(work, {recursive: true});
}

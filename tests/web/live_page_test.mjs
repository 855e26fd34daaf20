// node live_page_test.mjs SITE chromium|firefox RAINREF SOURCES [SHOTS]: the live page as a visitor uses it. RAINREF is the native program, whose
// lines of hashes the page's must be; SHOTS a folder for screenshots.
import assert from "node:assert/strict";
import {spawnSync} from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import {click, expectAccessible, expectReadable, launch, open, serve, stepsIn, textOf} from "./browser.mjs";

const [folder, name, rainref, sources, shots] = process.argv.slice(2);
const site = await serve(path.resolve(folder)), browser = await launch(name), step = stepsIn(name), errors = [];
const work = fs.mkdtempSync(path.join(os.tmpdir(), "live-page-"));
const timeout = 120000, effects = ["puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"];

const frameOf = page => page.$eval("#state", e => Number(/^frame (\d+),/.exec(e.textContent)?.[1] ?? -1));
const atFrame = (page, frame) => page.waitForFunction(n => document.getElementById("state").textContent.startsWith(`frame ${n},`), {timeout, polling: 30}, frame);
const linesOf = page => page.$$eval("#hashes tbody tr", all => all.map(row => [...row.children].map(cell => cell.textContent).join(" ")));
const shownError = (page, selector) => page.waitForFunction(s => { const e = document.querySelector(s); return !e.hidden && e.textContent; }, {timeout}, selector)
  .then(handle => handle.jsonValue());
/// The page at a scene, when its frame 0 is shown.
async function ready(scene, size = "64x36", width = 1280) {
  const page = await open(browser, site, `live.html?scene=${scene}&size=${size}`, errors, width);
  await atFrame(page, 0);
  return page;
}
/// The native program's lines for frames below `frames`: an array for each frame.
function natively(...args) {
  const made = spawnSync(path.resolve(rainref), ["hash", ...args], {cwd: path.resolve(sources), encoding: "utf8"});
  assert.equal(made.status, 0, made.stderr);
  const frames = [];
  for (const line of made.stdout.split("\n")) {
    const [, frame, rest] = /^(\d+) (.*)$/.exec(line) ?? [];
    if (frame !== undefined) (frames[frame] ??= []).push(rest);
  }
  return frames;
}
/// The same by the command that the page shows, through a shell.
function asCommanded(command, cwd = sources) {
  const made = spawnSync("sh", ["-c", command.replace(/^rainref /, '"$0" '), path.resolve(rainref)], {cwd: path.resolve(cwd), encoding: "utf8"});
  assert.equal(made.status, 0, `${command}: ${made.stderr}`);
  const frame = /--frames (\d+)/.exec(command)[1] - 1;
  return made.stdout.split("\n").filter(line => line.startsWith(`${frame} `)).map(line => line.slice(`${frame} `.length));
}
async function type(page, key, value) {
  await page.evaluate((k, v) => {
    const field = document.getElementById(`parameter-${k}`);
    field.value = v;
    field.dispatchEvent(new Event("change", {bubbles: true}));
  }, key, value);
}
const shot = async (page, what) => shots && page.screenshot({path: path.join(shots, `live-${what}-${page.viewport().width}-${name}.png`), fullPage: true});

try {
  await step("every effect's default scene has the native hashes", async () => {
    let lines = 0;
    for (const effect of effects) {
      const native = natively(`scenes/${effect}/default.toml`, "--size", "64x36", "--frames", "4"), page = await ready(`${effect}/default.toml`);
      for (let frame = 0; frame < 4; ++frame) {
        if (frame > 0) await click(page, "#step");
        await atFrame(page, frame);
        assert.deepEqual(await linesOf(page), native[frame], `${effect}, frame ${frame}`);
        lines += native[frame].length;
      }
      assert.equal(await textOf(page, "#command"), `rainref hash scenes/${effect}/default.toml --frames 4 --size 64x36`);
      const colours = await page.$eval("#picture", c => new Set(new Uint32Array(c.getContext("2d").getImageData(0, 0, c.width, c.height).data.buffer)).size);
      assert(colours > 50, `${effect}: a picture of ${colours} colours`);
      await page.close();
    }
    console.log(`${name}: ${lines} lines as native`);
  });

  await step("the automatic size does not antialias, and the command says so", async () => {
    const page = await open(browser, site, "live.html?scene=edge_splash/default.toml", errors);
    await atFrame(page, 0);
    const command = await textOf(page, "#command");
    assert.match(command, /^rainref hash scenes\/edge_splash\/default\.toml --frames 1 --size \d+x\d+ --set run\.supersample=1$/);
    assert.deepEqual(await linesOf(page), asCommanded(command));
    await page.close();
  });

  const page = await ready("puddle/default.toml");
  await step("reset gives frame 0 again", async () => {
    const first = await linesOf(page);
    for (let frame = 1; frame <= 3; ++frame) {
      await page.keyboard.press(".");
      await atFrame(page, frame);
    }
    assert.notDeepEqual(await linesOf(page), first);
    await page.keyboard.press("r");
    await atFrame(page, 0);
    assert.deepEqual(await linesOf(page), first);
  });

  await step("a parameter is what --set is", async () => {
    const plain = natively("scenes/puddle/default.toml", "--size", "64x36", "--frames", "3");
    await click(page, "#reset");
    await atFrame(page, 0);
    // By its slider, while the scene stands at frame 0; then from the beginning with it.
    const rate = await page.evaluate(() => {
      const slider = document.querySelector('[data-key="rain.rate"] input[type="range"]');
      slider.value = 800;
      slider.dispatchEvent(new Event("input", {bubbles: true}));
      return document.getElementById("parameter-rain.rate").value;
    });
    assert(Number(rate) > 20, rate);
    await atFrame(page, 1);  // shown at once
    assert.equal(await page.$eval("#changed", e => e.hidden), false);
    await click(page, "#reset");
    await page.waitForFunction(() => document.getElementById("changed").hidden, {timeout});
    for (let frame = 1; frame <= 2; ++frame) {
      await click(page, "#step");
      await atFrame(page, frame);
    }
    const command = await textOf(page, "#command");
    assert.equal(command, `rainref hash scenes/puddle/default.toml --frames 3 --size 64x36 --set rain.rate=${rate}`);
    assert.deepEqual(await linesOf(page), asCommanded(command));
    assert.notDeepEqual(await linesOf(page), plain[2]);
  });

  await step("what a parameter may not be is said beside it", async () => {
    await type(page, "rain.rate", "1000");
    assert.match(await shownError(page, '[data-key="rain.rate"] .error'), /rain\.rate.*200/s);
    // A grid of another size does not fit what is held: a new start takes it.
    await type(page, "puddle.grid", "96, 64");
    assert.match(await shownError(page, '[data-key="puddle.grid"] .error'), /puddle\.grid/);
    await click(page, '[data-key="puddle.grid"] .error button');
    await page.waitForFunction(() => document.getElementById("command").textContent.includes("puddle.grid"), {timeout, polling: 50});
    await atFrame(page, 0);
    assert.deepEqual(await linesOf(page), asCommanded(await textOf(page, "#command")));
  });

  await step("a scene's text with an error is refused, and the scene that runs stays", async () => {
    const lines = await linesOf(page);
    await page.$eval("#text", e => { e.value = 'effect = "puddle"\nvariant = "corrected"\n[rain]\nrat = 4\n'; });
    await click(page, "#open-text");
    assert.match(await shownError(page, "#scene-error"), /scenes\/puddle\/default\.toml:4:1.*rat.*rate/s);
    assert.deepEqual(await linesOf(page), lines);
    await click(page, "#step");
    await atFrame(page, 1);
    const file = path.join(work, "wrong.toml");
    fs.writeFileSync(file, 'effect = "puddel"\n');
    await (await page.$("#files")).uploadFile(file);
    await page.waitForFunction(() => document.getElementById("scene-error").textContent.includes("puddel"), {timeout});
    assert.match(await textOf(page, "#scene-error"), /wrong\.toml.*puddle/s);
  });

  await step("a file that is opened, changed and saved is the same scene natively", async () => {
    const file = path.join(work, "own.toml");
    fs.writeFileSync(file, 'effect = "screen_drops"\nvariant = "corrected"\nseed = 9007199254740993\n[run]\nsize = [64, 36]\n[rain]\nrate = 20\n[flow]\nwarm_up = 1\nheight_size = [64, 36]\n');
    await page.select("#size", "scene");
    await page.waitForFunction(() => document.getElementById("command").textContent.includes("--frames 1"), {timeout, polling: 50});
    await (await page.$("#files")).uploadFile(file);
    await page.waitForFunction(() => document.getElementById("command").textContent.includes("own.toml"), {timeout, polling: 50});
    await click(page, "#step");
    await atFrame(page, 1);
    assert.deepEqual(await linesOf(page), asCommanded(await textOf(page, "#command"), work));
    const saved = await page.evaluate(() => new Promise(done => {
      const real = URL.createObjectURL;
      URL.createObjectURL = blob => {
        URL.createObjectURL = real;
        blob.text().then(done);
        return real.call(URL, blob);
      };
      document.getElementById("save").click();
    }));
    assert.match(saved, /^seed = 9007199254740993$/m);  // a double has no such number
    fs.writeFileSync(path.join(work, "saved.toml"), saved);
    assert.deepEqual(await linesOf(page), natively(path.join(work, "saved.toml"), "--frames", "2")[1]);
  });

  await step("a preset sets its keys, and the command holds them", async () => {
    const other = await ready("puddle/default.toml");
    await other.select("#weather", "storm");
    await other.waitForFunction(() => document.getElementById("command").textContent.includes("rain.rate"), {timeout, polling: 50});
    await atFrame(other, 0);
    assert.deepEqual(await linesOf(other), natively("scenes/puddle/default.toml", "--size", "64x36", "--frames", "1", "--preset", "storm")[0]);
    assert.deepEqual(await linesOf(other), asCommanded(await textOf(other, "#command")));
    // A preset that brings a picture; the link does, too.
    await other.select("#light", "day");
    await other.waitForFunction(() => document.getElementById("command").textContent.includes("city.png"), {timeout, polling: 50});
    await atFrame(other, 0);
    const lines = natively("scenes/puddle/default.toml", "--size", "64x36", "--frames", "1", "--preset", "storm,day")[0];
    assert.deepEqual(await linesOf(other), lines);
    assert.deepEqual(await linesOf(other), asCommanded(await textOf(other, "#command")));
    await other.reload();
    await atFrame(other, 0);
    assert.deepEqual(await linesOf(other), lines);
    assert.equal(await other.$eval("#light", e => e.value), "day");
    await other.close();
  });

  await step("the other variant, and one that the scene's keys do not fit", async () => {
    await page.select("#size", "64x36").catch(() => {});
    await page.select("#scene", "puddle/default.toml");
    await page.waitForFunction(() => document.getElementById("command").textContent.includes("puddle/default.toml"), {timeout, polling: 50});
    await page.select("#variant", "as-published");
    await page.waitForFunction(() => document.getElementById("command").textContent.includes("puddle/as_published.toml"), {timeout, polling: 50});
    assert.match(await textOf(page, "#about"), /keys that as-published does not have/);
    assert.equal(await page.$('[data-key="rain.rate"]'), null);  // a key of corrected alone
    assert.notEqual(await page.$('[data-key="puddle.rain_speed"]'), null);
  });

  await step("plays and pauses", async () => {
    const before = await frameOf(page);
    await page.evaluate(() => document.activeElement.blur());
    await page.keyboard.press(" ");
    await page.waitForFunction(n => Number(/^frame (\d+)/.exec(document.getElementById("state").textContent)[1]) > n + 3, {timeout, polling: 30}, before);
    await page.keyboard.press(" ");
    assert.equal(await textOf(page, "#play"), "Play");
    await new Promise(done => setTimeout(done, 500));
    const paused = await frameOf(page);
    await new Promise(done => setTimeout(done, 500));
    assert.equal(await frameOf(page), paused);
  });

  await step("a port runs beside it", async () => {
    const other = await ready("edge_splash/default.toml");
    await other.select("#pass", "display");
    await click(other, "#compare");
    await other.waitForFunction(() => !document.getElementById("comparison").hidden || !document.getElementById("compare-error").hidden, {timeout, polling: 100});
    assert.equal(await textOf(other, "#compare-error"), "");
    assert.match(await textOf(other, "#verdict"), name === "firefox" ? /^(PASS|WARN)$/ : /^PASS$/);
    const [, differing, texels] = /: ([\d,]+) of ([\d,]+) texels? /.exec(await textOf(other, "#counts"));
    assert.equal(texels, (128 * 72).toLocaleString("en"));  // the scene antialiases: its passes run at twice the size
    // The differing texels are those that the difference shows, once its gain makes a code of every difference.
    await other.$eval("#gain", e => { e.value = 16; e.dispatchEvent(new Event("input")); });
    const shown = await other.$eval("#difference", c => {
      const {data} = c.getContext("2d").getImageData(0, 0, c.width, c.height);
      let count = 0;
      for (let k = 0; k < data.length; k += 4) count += data[k] > 0 || data[k + 1] > 0 || data[k + 2] > 0;
      return count;
    });
    assert.equal(shown, Number(differing.replaceAll(",", "")));
    // A list, and a buffer that is no picture.
    for (const [scene, pass] of [["puddle/default.toml", "raindrops"], ["puddle/default.toml", "wave_step"]]) {
      await other.select("#scene", scene);
      await other.waitForFunction(p => [...document.getElementById("pass").options].some(o => o.value === p), {timeout, polling: 50}, pass);
      await atFrame(other, 0);
      await other.select("#pass", pass);
      await click(other, "#compare");
      await other.waitForFunction(() => !document.getElementById("comparison").hidden || !document.getElementById("compare-error").hidden, {timeout, polling: 100});
      assert.equal(await textOf(other, "#compare-error"), "");
      assert.match(await textOf(other, "#verdict"), /^(PASS|WARN|UNTESTED)$/, `${pass}: ${await textOf(other, "#counts")}`);
      await click(other, "#reset");
      await atFrame(other, 0);
    }
    await shot(other, "port");
    await other.close();
  });

  await step("the library with its judge goes on where the smaller one stood", async () => {
    const native = natively("scenes/puddle/default.toml", "--size", "64x36", "--frames", "5", "--set", "rain.rate=60");
    site.requests();
    const other = await ready("puddle/default.toml");
    await type(other, "rain.rate", "60");
    await other.waitForFunction(() => document.getElementById("command").textContent.includes("rain.rate"), {timeout, polling: 50});
    await click(other, "#reset");
    await other.waitForFunction(() => document.getElementById("changed").hidden, {timeout});
    for (let frame = 1; frame <= 2; ++frame) {
      await click(other, "#step");
      await atFrame(other, frame);
    }
    const loaded = () => site.requests().filter(name => name.endsWith(".wasm"));
    assert.deepEqual(loaded(), ["/rainref_simulator.wasm"]);
    await click(other, "#compare");
    await atFrame(other, 3);
    await other.waitForFunction(() => !document.getElementById("comparison").hidden || !document.getElementById("compare-error").hidden, {timeout, polling: 100});
    assert.equal(await textOf(other, "#compare-error"), "");
    await click(other, "#step");
    await atFrame(other, 4);
    assert.deepEqual(await linesOf(other), native[4]);
    assert.deepEqual(loaded(), ["/rainref_module.wasm"]);
    await other.close();
  });

  await step("without WebGPU it simulates", async () => {
    const other = await browser.newPage();
    await other.evaluateOnNewDocument(() => Object.defineProperty(navigator, "gpu", {value: undefined}));
    await other.goto(`${site.url}live.html?scene=edge_splash/default.toml&size=64x36`);
    await atFrame(other, 0);
    assert.match(await textOf(other, "#no-gpu"), /no WebGPU/);
    assert.equal(await other.$eval("#compare", e => e.disabled), true);
    await other.close();
  });

  await step("no page is wider than its window, and controls have names", async () => {
    for (const width of [390, 1280]) {
      const other = await ready("rainy_glass/default.toml", "320x180", width);
      await other.waitForSelector("#gallery img");
      await expectReadable(other);
      await expectAccessible(other);
      await shot(other, "start");
      await other.close();
    }
  });
  assert.deepEqual(errors, []);
  console.log(`${name}: the live page works`);
} finally {
  await browser.close();
  site.close();
  fs.rmSync(work, {recursive: true, force: true});
}

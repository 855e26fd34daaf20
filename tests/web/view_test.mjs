// node view_test.mjs RAINREF chromium|firefox SOURCES: the page of `rainref view` as its user has it. Pictures, lines and films must be those of the
// same program's other commands. Prints times too, which no test depends on.
import assert from "node:assert/strict";
import {spawnSync} from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import os from "node:os";
import path from "node:path";
import {click, expectReadable, launch, stepsIn, textOf, view} from "./browser.mjs";

const [program, name, sources] = process.argv.slice(2), rainref = path.resolve(program);
const effects = ["puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"], timeout = 120000;
const work = fs.mkdtempSync(path.join(os.tmpdir(), "view-")), step = stepsIn(name), errors = [];

function natively(...args) {
  const made = spawnSync(rainref, args, {cwd: path.resolve(sources), encoding: "utf8"});
  assert.equal(made.status, 0, `${args.join(" ")}: ${made.stderr}`);
  return made.stdout;
}
const nativeLines = (frame, ...args) => natively("hash", ...args).split("\n").filter(line => line.startsWith(`${frame} `)).map(line => line.slice(`${frame} `.length));
/// The native command that the page shows, through a shell: its last frame's lines.
function asCommanded(command) {
  const made = spawnSync("sh", ["-c", command.replace(/^rainref /, '"$0" '), rainref], {cwd: path.resolve(sources), encoding: "utf8"});
  assert.equal(made.status, 0, `${command}: ${made.stderr}`);
  const frame = /--frames (\d+)/.exec(command)[1] - 1;
  return made.stdout.split("\n").filter(line => line.startsWith(`${frame} `)).map(line => line.slice(`${frame} `.length));
}

const atFrame = (page, frame) => page.waitForFunction(n => document.getElementById("state").textContent.startsWith(`frame ${n},`), {timeout, polling: "raf"}, frame);
const linesOf = page => page.$$eval("#hashes tbody tr", all => all.map(row => [...row.children].map(cell => cell.textContent).join(" ")));
const frameOf = page => page.$eval("#state", e => Number(/^frame (\d+),/.exec(e.textContent)?.[1] ?? -1));
/// How many pixels of the shown picture are not the PNG's.
const differingPixels = (page, png) => page.evaluate(async data => {
  const image = new Image();
  image.src = `data:image/png;base64,${data}`;
  await image.decode();
  const shown = document.getElementById("picture"), {width, height} = shown;
  if (image.width !== width || image.height !== height) return -1;
  const drawn = Object.assign(document.createElement("canvas"), {width, height}).getContext("2d");
  drawn.drawImage(image, 0, 0);
  const [a, b] = [shown.getContext("2d"), drawn].map(context => new Uint32Array(context.getImageData(0, 0, width, height).data.buffer));
  return a.reduce((count, pixel, k) => count + (pixel !== b[k]), 0);
}, fs.readFileSync(png).toString("base64"));
/// Moves a slider, as a hand does.
const slide = (page, key, place) => page.evaluate((k, at) => {
  const slider = document.querySelector(`[data-key="${k}"] input[type="range"]`);
  slider.value = at;
  slider.dispatchEvent(new Event("input", {bubbles: true}));
  return document.getElementById(`parameter-${k}`).value;
}, key, place);

const viewed = await view(rainref, ["scenes/puddle/default.toml", "--set", "rain.rate=20"], path.resolve(sources));
const printed = viewed.address, root = viewed.root, browser = await launch(name);
async function ready(search, width = 1280) {
  const page = await browser.newPage();
  page.on("pageerror", error => errors.push(error.message));
  page.on("request", request => { if (!/^(blob|data):/.test(request.url()) && !request.url().startsWith(root)) errors.push(`asked for ${request.url()}`); });
  await page.setViewport({width, height: 900});
  await page.goto(`${root}live.html?${search}`);
  await atFrame(page, 0);
  return page;
}

try {
  await step("the printed address shows the scene with its keys", async () => {
    const page = await ready(printed.slice(printed.indexOf("?") + 1));
    assert.equal(await textOf(page, "#command"), "rainref hash scenes/puddle/default.toml --frames 1 --size 640x360 --set rain.rate=20");
    assert.deepEqual(await linesOf(page), asCommanded(await textOf(page, "#command")));
    for (const hidden of ["#ports", "#pages", "#gallery-section"]) assert.equal(await page.$eval(hidden, e => e.hidden), true, hidden);
    assert.match(await textOf(page, "#where"), /in the program on this machine/);
    await page.close();
  });

  await step("each default scene's pictures are the program's", async () => {
    const changed = {puddle: "rain.rate", windshield: "rain.rate", edge_splash: "display.exposure", screen_drops: "rain.rate", rainy_glass: "display.exposure"};
    for (const effect of effects) {
      const scene = `scenes/${effect}/default.toml`, begin = performance.now(), page = await ready(`scene=${effect}/default.toml&size=640x360`);
      const first = performance.now() - begin;
      natively("run", scene, "--size", "640x360", "--frames", "1", "-o", path.join(work, effect));
      assert.equal(await differingPixels(page, path.join(work, effect, `${effect}.0000.png`)), 0, `${effect}, frame 0`);
      // From a hand's move to the picture, twice: what the first prepares is kept.
      const times = [];
      for (const [frame, place] of [[1, 500], [2, 800]]) {
        const moved = performance.now();
        await slide(page, changed[effect], place);
        await atFrame(page, frame);
        times.push((performance.now() - moved).toFixed(0));
      }
      console.log(`${name}: ${effect}: first picture after ${(first / 1000).toFixed(2)} s; ${changed[effect]} moved to the picture: ${times.join(" and ")} ms`);
      // From the beginning with that value, it is the scene with --set.
      await click(page, "#reset");
      await atFrame(page, 0);
      await click(page, "#step");
      await atFrame(page, 1);
      const command = await textOf(page, "#command"), set = command.split(" --set ").slice(1).flatMap(word => ["--set", word.replaceAll("'", "")]);
      assert.equal(set.length, 2, command);
      assert.deepEqual(await linesOf(page), asCommanded(command));
      natively("run", scene, "--size", "640x360", "--frames", "2", ...set, "--overwrite", "-o", path.join(work, effect));
      assert.equal(await differingPixels(page, path.join(work, effect, `${effect}.0001.png`)), 0, `${effect}, ${set[1]}`);
      await page.close();
    }
  });

  await step("a preset sets its keys: sliders, lines, command and link", async () => {
    const other = await ready("scene=puddle/default.toml&size=64x36"), size = ["--size", "64x36", "--frames", "1"];
    const chosen = () => other.$$eval("#weather, #light", all => all.map(e => e.value));
    const commanded = key => other.waitForFunction(k => document.getElementById("command").textContent.includes(k), {timeout, polling: 50}, key);
    const choose = async (kind, name, key) => {
      await other.select(`#${kind}`, name);
      await commanded(key);
      await atFrame(other, 0);
    };
    assert.deepEqual(await other.$$eval("#weather option", all => all.map(o => o.value)), ["", "drizzle", "rain", "storm", "after_the_rain"]);
    assert.deepEqual(await chosen(), ["", ""]);
    await choose("weather", "storm", "rain.rate");
    assert.deepEqual(await linesOf(other), nativeLines(0, "scenes/puddle/default.toml", ...size, "--preset", "storm"));
    const rate = JSON.parse(natively("describe", "puddle/default", "--preset", "storm", "--json")).values["rain.rate"];
    assert.equal(Number(await other.$eval('[id="parameter-rain.rate"]', e => e.value)), rate);
    assert.match(await textOf(other, "#about"), /street at night.* storm/i);
    await choose("light", "day", "environment.image");
    assert.deepEqual(await linesOf(other), nativeLines(0, "scenes/puddle/default.toml", ...size, "--preset", "storm,day"));
    assert.deepEqual(await linesOf(other), asCommanded(await textOf(other, "#command")));
    // The link holds the keys, and what is chosen follows from them.
    const again = await ready(new URL(other.url()).searchParams.toString());
    assert.deepEqual(await again.$$eval("#weather, #light", all => all.map(e => e.value)), ["storm", "day"]);
    assert.deepEqual(await linesOf(again), await linesOf(other));
    await again.close();
    // Another preset leaves nothing of this one; another value is no preset's.
    await choose("weather", "drizzle", "rain.rate=0.");
    assert.deepEqual(await linesOf(other), nativeLines(0, "scenes/puddle/default.toml", ...size, "--preset", "drizzle,day"));
    await slide(other, "rain.rate", 700);
    await atFrame(other, 1);
    assert.deepEqual(await chosen(), ["", "day"]);
    await choose("weather", "rain", "rain.rate=4");
    // The next scene has them, too, where they describe its effect.
    await other.select("#scene", "edge_splash/default.toml");
    await commanded("edge_splash/default");
    await atFrame(other, 0);
    assert.equal((await chosen())[0], "rain");
    assert.deepEqual(await linesOf(other), asCommanded(await textOf(other, "#command")));
    await other.select("#scene", "puddle/as_published.toml");
    await commanded("as_published");
    assert.deepEqual(await other.$$eval("#weather, #light", all => all.map(e => e.disabled)), [true, true]);
    await other.close();
  });

  const page = await ready("scene=puddle/default.toml&size=64x36");
  await step("plays, pauses and steps", async () => {
    await click(page, "#play");
    await page.waitForFunction(() => Number(/^frame (\d+)/.exec(document.getElementById("state").textContent)[1]) > 5, {timeout, polling: 30});
    await click(page, "#play");
    await new Promise(done => setTimeout(done, 500));
    const paused = await frameOf(page);
    await new Promise(done => setTimeout(done, 300));
    assert.equal(await frameOf(page), paused);
    await click(page, "#step");
    await atFrame(page, paused + 1);
    assert.deepEqual(await linesOf(page), nativeLines(paused + 1, "scenes/puddle/default.toml", "--size", "64x36", "--frames", String(paused + 2)));
  });

  /// What the page saves next, by this button: bytes.
  const saved = async button => Buffer.from(await page.evaluate(id => new Promise(done => {
    const real = URL.createObjectURL;
    URL.createObjectURL = blob => {
      URL.createObjectURL = real;
      blob.arrayBuffer().then(bytes => done([...new Uint8Array(bytes)]));
      return real.call(URL, blob);
    };
    document.getElementById(id).click();
  }), button));

  await step("the saved scene is the one that runs", async () => {
    const rate = await slide(page, "rain.rate", 700);
    await click(page, "#reset");  // at once: the value is on its way
    await atFrame(page, 0);
    assert.match(await textOf(page, "#command"), new RegExp(`rain\\.rate=${rate}$`));
    const file = path.join(work, "saved.toml");
    fs.writeFileSync(file, await saved("save"));
    assert.match(fs.readFileSync(file, "utf8"), new RegExp(`^rate = ${rate}`, "m"));
    assert.deepEqual(await linesOf(page), nativeLines(0, file, "--frames", "1"));
  });

  if (spawnSync("ffmpeg", ["-version"]).status === 0) {
    await step("a film is the program's", async () => {
      await page.$eval("#film-frames", e => { e.value = "4"; });
      const film = await saved("film"), file = path.join(work, "film.mp4");
      const rate = /rain\.rate=([\d.]+)/.exec(await textOf(page, "#command"))[1];
      natively("run", "scenes/puddle/default.toml", "--size", "64x36", "--frames", "4", "--set", `rain.rate=${rate}`, "--film", file, "--image", "none", "-o", path.join(work, "film"));
      assert(film.equals(fs.readFileSync(file)), `${film.length} bytes`);
      await page.$eval("#film-frames", e => { e.value = "100000"; });
      await click(page, "#film");
      await page.waitForFunction(() => / of 100000$/.test(document.getElementById("film-state").textContent), {timeout});
      await click(page, "#film");
      await page.waitForFunction(() => document.getElementById("film").textContent === "Make a film", {timeout});
      await click(page, "#step");  // the scene is still there
      await atFrame(page, 1);
      assert.equal(await page.$eval("#film-error", e => e.hidden), true);
    });
  }

  await step("what a parameter may not be is said beside it", async () => {
    await page.evaluate(() => {
      const field = document.getElementById("parameter-rain.rate");
      field.value = "1000";
      field.dispatchEvent(new Event("change", {bubbles: true}));
    });
    await page.waitForFunction(() => /rain\.rate.*200/s.test(document.querySelector('[data-key="rain.rate"] .error').textContent), {timeout});
  });

  await step("a scene of one's own, with its picture", async () => {
    fs.writeFileSync(path.join(work, "own.toml"), "effect = 'puddle'\nvariant = 'corrected'\n[run]\nsize = [64, 36]\n[environment]\nimage = 'sky.npy'\n");
    const rows = Buffer.from(Array.from({length: 4 * 8 * 3}, (_, k) => 40 + 2 * k));
    const head = "{'descr': '|u1', 'fortran_order': False, 'shape': (4, 8, 3), }".padEnd(117) + "\n";
    fs.writeFileSync(path.join(work, "sky.npy"), Buffer.concat([Buffer.from("\x93NUMPY\x01\x00v\x00", "latin1"), Buffer.from(head), rows]));
    await page.select("#size", "scene");
    await (await page.$("#files")).uploadFile(path.join(work, "own.toml"), path.join(work, "sky.npy"));
    await page.waitForFunction(() => document.getElementById("command").textContent.includes("own.toml --frames 1"), {timeout, polling: 50});
    assert.deepEqual(await linesOf(page), nativeLines(0, path.join(work, "own.toml"), "--frames", "1"));
    assert.equal(await textOf(page, "#scene-error"), "");
  });

  await step("no other page reaches it", async () => {
    const elsewhere = http.createServer((request, response) => response.setHeader("content-type", "text/html").end("<!doctype html>"));
    await new Promise(done => elsewhere.listen(0, "127.0.0.1", done));
    const other = await browser.newPage();
    await other.goto(`http://127.0.0.1:${elsewhere.address().port}/`);
    const seen = await other.evaluate(async address => {
      const ways = {
        read: () => fetch(`${address}live.html`).then(answer => answer.text()),
        send: () => fetch(`${address}run/1/step`, {method: "POST", body: "{}"}).then(answer => answer.text()),
        script: () => new Promise((done, failed) => document.head.append(Object.assign(document.createElement("script"), {src: `${address}live_scenes.js`, type: "module", onload: done, onerror: failed}))),
      };
      const held = {};
      for (const [way, run] of Object.entries(ways)) held[way] = await run().then(() => false, () => true);
      const frame = document.body.appendChild(Object.assign(document.createElement("iframe"), {src: `${address}live.html`}));
      await new Promise(done => { frame.onload = done; setTimeout(done, 2000); });
      return held;
    }, root);
    assert.deepEqual(seen, {read: true, send: true, script: true});
    // Nothing of the framed page ran: its script would have asked for a scene.
    const inside = other.frames().find(frame => frame !== other.mainFrame());
    assert.equal(await inside?.evaluate(() => document.getElementById("picture") !== null).catch(() => false) ?? false, false);
    await other.close();
    elsewhere.close();
  });

  await step("no page is wider than its window, and controls have names", async () => {
    for (const width of [390, 1280]) {
      const other = await ready("scene=edge_splash/default.toml&size=320x180", width);
      await expectReadable(other);
      await other.close();
    }
  });
  await page.close();
  assert.deepEqual(errors, []);
  console.log(`${name}: rainref view works`);
} finally {
  await browser.close();
  viewed.close();
  fs.rmSync(work, {recursive: true, force: true});
}

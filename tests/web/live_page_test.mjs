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
/// What the page saves next, by this button: bytes.
const savedBy = async (page, button) => Buffer.from(await page.evaluate(id => new Promise((done, failed) => {
  const real = URL.createObjectURL;
  URL.createObjectURL = blob => {
    URL.createObjectURL = real;
    blob.arrayBuffer().then(bytes => done([...new Uint8Array(bytes)]));
    return real.call(URL, blob);
  };
  if (id === "film") new MutationObserver(() => failed(new Error(document.getElementById("film-error").textContent))).observe(document.getElementById("film-error"), {childList: true});
  document.getElementById(id).click();
}), button));
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
    for (const [effect, more] of [["edge_splash", ""], ["windshield", " --set 'scene.size=[640, 360]'"]]) {
      const page = await open(browser, site, `live.html?scene=${effect}/default.toml`, errors);
      await atFrame(page, 0);
      const command = await textOf(page, "#command");
      assert.equal(command, `rainref hash scenes/${effect}/default.toml --frames 1 --size 320x180 --set run.supersample=1${more}`);
      assert.deepEqual(await linesOf(page), asCommanded(command));
      await page.close();
    }
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
    assert.match(await shownError(page, "#scene-error"), /edited\.toml:4:1.*rat.*rate/s);
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

  await step("picture, buttons and knobs are on the first screen, the rest is folded", async () => {
    for (const [width, height] of [[1280, 800], [390, 844]]) {
      const other = await ready("puddle/default.toml", "320x180", width);
      await other.setViewport({width, height});
      const boxes = await other.evaluate(() => ["#scene", "#weather", "#light", "#picture", "#play", "#step", "#reset", '[data-key="rain.rate"]', '[data-key="rain.smallest_drop"] input']
        .map(s => [s, document.querySelector(s).getBoundingClientRect()]).map(([s, {left, top, right, bottom}]) => ({s, left, top, right, bottom})));
      for (const {s, left, top, right, bottom} of boxes)
        assert(left >= 0 && top >= 0 && right <= width && bottom <= height && right > left, `${s} at ${width} x ${height}: ${[left, top, right, bottom]}`);
      const picture = boxes.find(({s}) => s === "#picture"), share = (picture.right - picture.left) * (picture.bottom - picture.top) / (width * height);
      assert(share > (width > 600 ? 0.35 : 0.18), `the picture takes ${share} of ${width} x ${height}`);
      // What is moved comes before what is typed.
      const typed = await other.$$eval('[data-section="rain"] .parameter', all => all.map(row => row.querySelector(".whole") !== null));
      assert(typed.includes(true) && typed.includes(false));
      assert.deepEqual(typed, [...typed].sort());
      assert.deepEqual(await other.$$eval("#text-details, #hash-details, #ports, #film-row", all => all.map(e => e.open)), [false, false, false, false]);
      // On a phone, what is chosen seldom is behind a button.
      assert.equal(await other.$eval("#size", e => e.getBoundingClientRect().width > 0), width > 600);
      if (width < 600) await other.click("#more");
      assert.equal(await other.$eval("#size", e => e.getBoundingClientRect().width > 0), true);
      await expectReadable(other);
      await other.close();
    }
  });

  await step("the scene's picture stands in until frame 0, and Cancel leaves the opening", async () => {
    const other = await open(browser, site, "live.html?scene=windshield/default.toml&size=960x540", errors);
    await other.waitForFunction(() => /Opening|Computing/.test(document.getElementById("busy-text").textContent) && !document.getElementById("busy").hidden, {timeout, polling: 20});
    assert.match(await other.$eval("#stand-in", e => e.hidden ? "" : e.src), /gallery\/windshield_default\.jpg$/);
    await click(other, "#cancel");
    await other.waitForFunction(() => document.getElementById("state").textContent.startsWith("Cancelled."), {timeout});
    assert.equal(await other.$eval("#busy", e => e.hidden), true);
    // The page goes on: another scene, without the load of the first.
    await other.select("#size", "160x90");
    await other.select("#scene", "edge_splash/default.toml");
    await other.waitForFunction(() => document.getElementById("command").textContent.includes("edge_splash"), {timeout, polling: 50});
    await atFrame(other, 0);
    assert.equal(await other.$eval("#stand-in", e => e.hidden), true);
    assert.deepEqual(await linesOf(other), asCommanded(await textOf(other, "#command")));
    // A scene that is open and then left is begun again.
    await other.evaluate(() => {
      const wait = setInterval(() => {
        const busy = document.getElementById("busy");
        if (!busy.hidden && !document.getElementById("cancel").hidden) document.getElementById("cancel").click(), clearInterval(wait);
      }, 10);
    });
    await other.select("#scene", "windshield/default.toml");
    await other.waitForFunction(() => document.getElementById("state").textContent.startsWith("Cancelled."), {timeout});
    const runs = await other.$eval("#scene", e => e.value);
    await click(other, "#step");
    await atFrame(other, 0);
    assert(["edge_splash/default.toml", "windshield/default.toml"].includes(runs));
    assert.deepEqual(await linesOf(other), asCommanded(await textOf(other, "#command")));
    await other.close();
  });

  await step("a link holds scene, keys, size and frame", async () => {
    const native = natively("scenes/puddle/default.toml", "--size", "64x36", "--frames", "6", "--set", "rain.rate=60");
    const other = await open(browser, site, "live.html?scene=puddle/default.toml&size=64x36&set=rain.rate=60&frame=5", errors);
    await atFrame(other, 5);
    assert.deepEqual(await linesOf(other), native[5]);
    await other.evaluate(() => { navigator.clipboard.writeText = async text => { window.link = text; }; });
    const copy = async () => {
      await other.evaluate(() => { window.link = null; });
      await click(other, "#copy-link");
      return new URL(await (await other.waitForFunction(() => window.link, {timeout})).jsonValue()).search;
    };
    assert.equal(await copy(), "?scene=puddle%2Fdefault.toml&size=64x36&set=rain.rate%3D60&frame=5");
    assert.match(await textOf(other, "#link-state"), /frame 5\.$/);
    // A slider's value is in the address at once, and in the link, which says what it means.
    await type(other, "rain.rate", "30");
    await atFrame(other, 6);
    await other.waitForFunction(() => location.search.endsWith("set=rain.rate%3D30"), {timeout});
    assert.match(await copy(), /set=rain\.rate%3D30&frame=6$/);
    assert.match(await textOf(other, "#link-state"), /changed while the scene ran/);
    await other.close();
    const cut = await open(browser, site, "live.html?scene=puddle/default.toml&size=64x36&frame=x1", errors);
    assert.match(await shownError(cut, "#scene-error"), /frame: expected a whole number from 0 to 999999, found 'x1'/);
    await atFrame(cut, 0);
    await cut.close();
    // A far frame: with progress, and left where Cancel finds it.
    const far = await open(browser, site, "live.html?scene=puddle/default.toml&size=64x36&frame=90000", errors);
    await far.waitForFunction(() => /^Simulating: frame \d+ of 90001, 0 %$/.test(document.getElementById("busy-text").textContent), {timeout, polling: 20});
    await click(far, "#cancel");
    await far.waitForFunction(() => document.getElementById("busy").hidden, {timeout});
    const left = await frameOf(far);
    await click(far, "#step");
    await atFrame(far, left + 1);
    await far.close();
  });

  await step("keys are marked as slow that the native program says make things again", async () => {
    const other = await ready("puddle/default.toml");
    const described = JSON.parse(spawnSync(path.resolve(rainref), ["describe", "puddle", "--json"], {encoding: "utf8"}).stdout);
    const slow = described.parameters.filter(({makes}) => makes.length > 0).map(({name}) => name);
    const shown = await other.$$eval(".parameter", all => all.map(row => [row.dataset.key, row.querySelector(".slow") !== null]));
    assert(shown.some(([, isSlow]) => isSlow) && shown.some(([, isSlow]) => !isSlow));
    for (const [key, isSlow] of shown) assert.equal(isSlow, slow.includes(key), key);
    await other.close();
  });

  await step("a film is saved, one frame for each simulated one", async () => {
    const other = await ready("edge_splash/default.toml", "160x90"), frames = 7;
    await other.$eval("#film-frames", (e, n) => { e.value = n; }, frames);
    const bytes = await savedBy(other, "film"), file = path.join(work, "film.webm");
    fs.writeFileSync(file, bytes);
    await atFrame(other, frames - 1);
    assert.match(await textOf(other, "#film-state"), /^saved: edge_splash\.webm, 7 frames.*rainref run scenes\/edge_splash\/default\.toml --frames 7 --film edge_splash\.webm/);
    assert.deepEqual(await linesOf(other), asCommanded(await textOf(other, "#command")));
    // It plays as long as the frames take, and its last picture is the page's.
    const picture = await other.$eval("#picture", c => [...c.getContext("2d").getImageData(0, 0, c.width, c.height).data]);
    const player = await browser.newPage();  // the page's own policy lets no film in
    const {duration, width, height, apart} = await player.evaluate(async (data, picture) => {
      const film = document.createElement("video");
      film.muted = true;
      film.src = `data:video/webm;base64,${data}`;
      await new Promise((done, failed) => { film.onloadeddata = done; film.onerror = () => failed(new Error(film.error.message)); });
      const {duration, videoWidth: width, videoHeight: height} = film;
      film.currentTime = duration - 0.005;
      await new Promise(done => { film.onseeked = done; });
      const canvas = Object.assign(document.createElement("canvas"), {width, height}), context = canvas.getContext("2d");
      context.drawImage(film, 0, 0);
      const shown = context.getImageData(0, 0, width, height).data;
      return {duration, width, height, apart: shown.reduce((sum, code, k) => sum + Math.abs(code - picture[k]), 0) / shown.length};
    }, bytes.toString("base64"), picture);
    await player.close();
    const fps = Number(/^fps *= *(\d+)/m.exec(fs.readFileSync(path.join(sources, "scenes/edge_splash/default.toml"), "utf8"))?.[1] ?? 60);
    assert.deepEqual([width, height], [160, 90]);
    assert(Math.abs(duration - frames / fps) < 0.002, `${duration} s at ${fps} frames a second`);
    assert(apart < 6, `codes apart: ${apart}`);
    const probed = spawnSync("ffprobe", ["-v", "error", "-count_frames", "-show_entries", "stream=nb_read_frames,r_frame_rate", "-of", "csv=p=0", file], {encoding: "utf8"});
    if (probed.status !== null) assert.equal(probed.stdout.trim(), `${fps}/1,${frames}`, probed.stderr);
    // Cancelled, it saves nothing.
    await other.$eval("#film-frames", e => { e.value = "100000"; });
    await click(other, "#film");
    await other.waitForFunction(() => / of 100000$/.test(document.getElementById("film-state").textContent), {timeout});
    await click(other, "#film");
    await other.waitForFunction(() => document.getElementById("film").textContent === "Make a film", {timeout});
    assert.equal(await textOf(other, "#film-state"), "");
    await other.$eval("#film-frames", e => { e.value = "0"; });
    await click(other, "#film");
    assert.match(await shownError(other, "#film-error"), /frames: expected 1 to 1000000, found '0'/);
    await other.close();
  });

  await step("the picture fills the screen and leaves it", async () => {
    const other = await ready("edge_splash/default.toml");
    await other.bringToFront();
    await other.click("#full-screen");
    await other.waitForFunction(() => document.fullscreenElement?.id === "stage" && document.getElementById("full-screen").textContent === "Leave full screen", {timeout});
    await shot(other, "full");
    await click(other, "#full-screen");
    await other.waitForFunction(() => !document.fullscreenElement && document.getElementById("full-screen").textContent === "Full screen", {timeout});
    await other.close();
  });

  await step("the command of an edited text names a file that the page saves", async () => {
    const other = await ready("edge_splash/default.toml"), file = path.join(sources, "scenes/edge_splash/default.toml");
    assert.equal(await other.$eval("#save-text", e => e.hidden), true);
    const text = fs.readFileSync(file, "utf8").replace(/^seed = .*$/m, "");
    await other.$eval("#text", (e, t) => { e.value = t; }, `seed = 8\n${text}`);
    await click(other, "#open-text");
    await other.waitForFunction(() => document.getElementById("command").textContent.includes("edited.toml"), {timeout, polling: 50});
    await atFrame(other, 0);
    assert.equal(await textOf(other, "#command"), "rainref hash edited.toml --frames 1 --size 64x36");
    assert.match(await textOf(other, "#edited"), /Save it as edited\.toml/);
    assert.equal(await textOf(other, "#save-text"), "Save edited.toml");
    fs.writeFileSync(path.join(work, "edited.toml"), await savedBy(other, "save-text"));
    assert.deepEqual(await linesOf(other), asCommanded(await textOf(other, "#command"), work));
    assert.notDeepEqual(await linesOf(other), natively("scenes/edge_splash/default.toml", "--size", "64x36", "--frames", "1")[0]);
    await click(other, "#copy-link");
    await other.waitForFunction(() => /save it as TOML/.test(document.getElementById("link-state").textContent), {timeout});
    // The scene of the list again.
    await other.select("#scene", "edge_splash/default.toml");
    await other.waitForFunction(() => document.getElementById("edited").hidden, {timeout});
    await other.close();
  });

  await step("a scene without a variant has a command that names it", async () => {
    const file = path.join(work, "without.toml");
    fs.writeFileSync(file, 'effect = "edge_splash"\n[run]\nsize = [64, 36]\n[display]\n# variant = "as-published" is a comment in another table\n');
    const other = await ready("edge_splash/default.toml");
    await (await other.$("#files")).uploadFile(file);
    await other.waitForFunction(() => document.getElementById("command").textContent.includes("without.toml"), {timeout, polling: 50});
    await atFrame(other, 0);
    assert.match(await textOf(other, "#command"), /--set variant=corrected/);
    assert.deepEqual(await linesOf(other), asCommanded(await textOf(other, "#command"), work));
    await other.close();
  });

  await step("a size that is refused leaves a page that takes another", async () => {
    for (const size of ["65536x65536", "0x0", "axb"]) {
      const other = await open(browser, site, `live.html?scene=edge_splash/default.toml&size=${size}&set=display.exposure=2`, errors);
      assert.notEqual(await shownError(other, "#scene-error"), "");
      await other.select("#size", "160x90");
      await atFrame(other, 0);
      assert.equal(await other.$eval("#scene-error", e => e.hidden), true);
      assert.equal(await textOf(other, "#command"), "rainref hash scenes/edge_splash/default.toml --frames 1 --size 160x90 --set display.exposure=2");
      await other.close();
    }
  });

  await step("a trap in the library is called a defect, and the next try begins anew", async () => {
    // Steps trap from the second one on in the first worker; "unreachable" is a whole module's only function.
    const trap = "const bytes = new Uint8Array([0,97,115,109,1,0,0,0,1,4,1,96,0,0,3,2,1,0,7,5,1,1,116,0,0,10,5,1,3,0,0,11]);\n";
    const trapped = await serve(path.resolve(folder), {"/live_operations.js": text => `let steps = 0;\n${trap}${text.replace("export function step(library) {",
      "export function step(library) {\n  if (++steps === 2) new WebAssembly.Instance(new WebAssembly.Module(bytes)).exports.t();")}`});
    const other = await open(browser, trapped, "live.html?scene=edge_splash/default.toml&size=64x36", errors);
    await atFrame(other, 0);
    const first = await linesOf(other);
    await click(other, "#step");
    assert.match(await shownError(other, "#run-error"), /rainref failed inside \(a defect.*unreachable/);
    await click(other, "#step");
    await atFrame(other, 0);
    assert.deepEqual(await linesOf(other), first);
    assert.equal(await other.$eval("#run-error", e => e.hidden), true);
    await other.close();
    trapped.close();
  });

  await step("automatic opens once, with a size that the browser keeps", async () => {
    const sizeWith = async kept => {
      const other = await browser.newPage();
      await other.evaluateOnNewDocument(speeds => {
        if (speeds) localStorage.setItem("rainref.milliseconds_per_megapixel", speeds);
        else localStorage.clear();
        window.opened = 0;
        const post = Worker.prototype.postMessage;
        Worker.prototype.postMessage = function (message, ...more) {
          window.opened += message.operation === "open";
          return post.call(this, message, ...more);
        };
      }, kept);
      await other.goto(`${site.url}live.html?scene=edge_splash/default.toml`);
      await atFrame(other, 0);
      await click(other, "#step");
      await atFrame(other, 1);
      const found = {opened: await other.evaluate(() => window.opened), size: /--size (\S+)/.exec(await textOf(other, "#command"))[1],
                     speed: await other.evaluate(() => JSON.parse(localStorage.getItem("rainref.milliseconds_per_megapixel")).edge_splash)};
      await other.close();
      return found;
    };
    const first = await sizeWith(null);
    assert.deepEqual([first.opened, first.size], [1, "320x180"]);
    assert(first.speed > 0, `${first.speed}`);
    // Where the first frames were fast, the page offers what the next visit takes.
    const other = await browser.newPage();
    await other.evaluateOnNewDocument(() => localStorage.clear());
    await other.goto(`${site.url}live.html?scene=edge_splash/default.toml`);
    await atFrame(other, 0);
    assert.equal(await other.$eval("#larger", e => e.hidden), true);
    for (let frame = 1; frame <= 3; ++frame) {
      await click(other, "#step");
      await atFrame(other, frame);
    }
    const speed = await other.evaluate(() => JSON.parse(localStorage.getItem("rainref.milliseconds_per_megapixel")).edge_splash);
    const fits = ["960 x 540", "640 x 360"].find(size => size.split(" x ").reduce((a, b) => a * b) * speed / 1e6 <= 125);
    assert.equal(await other.$eval("#larger", e => e.hidden ? undefined : e.textContent), fits && `Larger: ${fits}`);
    if (fits) {
      await click(other, "#larger");
      await other.waitForFunction(size => document.getElementById("state").textContent.includes(`frame 0, ${size}`), {timeout, polling: 50}, fits);
    }
    await other.close();
    assert.deepEqual(await sizeWith('{"edge_splash": 1}').then(({opened, size}) => [opened, size]), [1, "960x540"]);
    assert.deepEqual(await sizeWith('{"edge_splash": 400}').then(({size}) => size), "640x360");
    assert.deepEqual(await sizeWith('{"edge_splash": 90000}').then(({size}) => size), "320x180");
    assert.deepEqual(await sizeWith("nonsense").then(({size}) => size), "320x180");
  });

  await step("what the library prepared is kept for the next visit, and made again where it is damaged", async () => {
    const native = natively("scenes/rainy_glass/default.toml", "--size", "96x54", "--frames", "1")[0];
    /// The images that the browser keeps for the scene: [{name, bytes, used, last}], last: the last byte, which `damage` then changes.
    const kept = (page, damage = false) => page.evaluate(damage => new Promise(done => {
      indexedDB.open("rainref.kept", 1).onsuccess = ({target: {result: database}}) => {
        const transaction = database.transaction("images", "readwrite"), store = transaction.objectStore("images"), found = [];
        store.get("index").onsuccess = ({target: {result}}) => {
          const names = Object.entries(result?.scenes ?? {}).find(([scene]) => /rainy_glass.*96, 54/.test(scene))?.[1] ?? [];
          for (const name of names) store.get(name).onsuccess = ({target: {result: bytes}}) => {
            found.push({name, ...result.images[name], last: bytes.at(-1)});
            bytes[bytes.length - 1] ^= 1;
            if (damage) store.put(bytes, name);
          };
        };
        transaction.oncomplete = () => {
          database.close();
          done(found);
        };
      };
    }), damage);
    const visited = async () => {
      const other = await ready("rainy_glass/default.toml", "96x54");
      assert.deepEqual(await linesOf(other), native);
      return other;
    };
    const untilKept = async (page, since) => {
      for (const end = Date.now() + timeout; Date.now() < end;) {
        const images = await kept(page);
        if (images.some(({used}) => used > since)) return images;
        await new Promise(done => setTimeout(done, 100));
      }
      throw new Error("nothing is kept");
    };
    let page = await visited();
    const first = await untilKept(page, 0);
    assert(first.every(({bytes}) => bytes > 1000));
    await page.close();
    // The library marks what it reads; a mark is proof that it was used.
    let since = Date.now();
    page = await visited();
    const sorted = images => images.map(({name, bytes, last}) => ({name, bytes, last})).sort((a, b) => a.name.localeCompare(b.name));
    assert.deepEqual(sorted(await untilKept(page, since)), sorted(first));
    await kept(page, true);
    await page.close();
    since = Date.now();
    page = await visited();
    assert.deepEqual(sorted(await untilKept(page, since)), sorted(first));
    await page.close();
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

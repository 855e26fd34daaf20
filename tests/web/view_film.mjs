// node view_film.mjs RAINREF SOURCES FILM.webm: half a minute of somebody who uses `rainref view`, as Chromium shows it. Needs ffmpeg.
import assert from "node:assert/strict";
import {spawnSync} from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import {launch, textOf, view} from "./browser.mjs";

const [program, sources, film] = process.argv.slice(2), length = 30, timeout = 60000;
const folder = fs.mkdtempSync(path.join(os.tmpdir(), "view-film-")), shots = [];
const viewed = await view(path.resolve(program), ["scenes/puddle/default.toml"], path.resolve(sources)), browser = await launch("chromium");
const wait = seconds => new Promise(done => setTimeout(done, Math.max(seconds, 0) * 1000));
try {
  const page = await browser.newPage();
  await page.setViewport({width: 1280, height: 800});
  await page.goto(viewed.address);
  const frame = () => page.$eval("#state", e => Number(/^frame (\d+),/.exec(e.textContent)?.[1] ?? -1));
  const shown = () => page.waitForFunction(() => /^frame \d+,/.test(document.getElementById("state").textContent), {timeout});
  // A screen has a pointer; the browser's pictures of the page have none.
  await page.evaluate(() => {
    const pointer = document.createElement("div");
    pointer.style.cssText = "position:fixed;z-index:9;width:14px;height:14px;margin:-7px;border-radius:7px;background:#fa0c;border:2px solid #000;pointer-events:none;left:640px;top:400px";
    document.body.append(pointer);
    addEventListener("mousemove", event => Object.assign(pointer.style, {left: `${event.clientX}px`, top: `${event.clientY}px`}), true);
  });
  await shown();

  // The browser sends a picture whenever the page has changed, with its time [s].
  const client = await page.createCDPSession();
  client.on("Page.screencastFrame", ({data, metadata, sessionId}) => {
    const file = path.join(folder, `${shots.length}.jpg`);
    fs.writeFileSync(file, Buffer.from(data, "base64"));
    shots.push({file, time: metadata.timestamp});
    client.send("Page.screencastFrameAck", {sessionId}).catch(() => {});  // the page may be gone
  });
  await client.send("Page.startScreencast", {format: "jpeg", quality: 90});
  const begin = Date.now() / 1000, until = time => wait(begin + time - Date.now() / 1000);
  /// Moves the pointer to the middle of what the selector names, and gives its box.
  const to = async selector => {
    const found = await page.waitForSelector(selector, {visible: true});
    await found.scrollIntoView();
    const box = await found.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, {steps: 12});
    return box;
  };
  const press = async selector => {
    await to(selector);
    await page.mouse.down();
    await page.mouse.up();
  };
  const play = async () => { if (await textOf(page, "#play") === "Play") await press("#play"); };

  await play();
  await until(5);
  assert.ok(await frame() > 0, "the scene plays");
  // A knob by its name, dragged to the right.
  await press("#find");
  await page.keyboard.type("rain.rate", {delay: 60});
  const slider = await to('[data-key="rain.rate"] input[type="range"]'), rate = '[id="parameter-rain.rate"]', before = await page.$eval(rate, e => e.value);
  await page.mouse.down();
  for (let k = 1; k <= 20; ++k, await wait(0.08)) await page.mouse.move(slider.x + slider.width * (0.5 + k / 41), slider.y + slider.height / 2);
  await page.mouse.up();
  assert.notEqual(await page.$eval(rate, e => e.value), before);
  await until(12);
  // Weather and light, and another effect.
  for (const [choice, name, end] of [["#light", "day", 16], ["#weather", "storm", 20], ["#scene", "windshield/default.toml", length]]) {
    await to(choice);
    await page.select(choice, name);
    await page.waitForFunction((c, n) => document.querySelector(c).value === n, {timeout}, choice, name);
    await shown();
    await play();
    await until(end);
    assert.ok(await frame() > 0, `${name} plays`);
  }
  await client.send("Page.stopScreencast");
  const end = Date.now() / 1000, list = path.join(folder, "list.txt");
  fs.writeFileSync(list, shots.map(({file, time}, k) => `file '${file}'\nduration ${((shots[k + 1]?.time ?? end) - time).toFixed(4)}\n`).join(""));
  const made = spawnSync("ffmpeg", ["-y", "-v", "error", "-f", "concat", "-safe", "0", "-i", list, "-r", "20", "-c:v", "libvpx-vp9", "-crf", "34", "-b:v", "0",
    "-deadline", "realtime", "-cpu-used", "8", film], {encoding: "utf8"});
  assert.equal(made.status, 0, made.stderr ?? made.error?.message);
  const lasts = Number(spawnSync("ffprobe", ["-v", "error", "-show_entries", "format=duration", "-of", "csv=p=0", film], {encoding: "utf8"}).stdout);
  assert.ok(Math.abs(lasts - length) < 2, `${lasts} s`);
  console.log(`${film}: ${lasts} s of rainref view, ${shots.length} pictures`);
} finally {
  await browser.close();
  viewed.close();
  fs.rmSync(folder, {recursive: true});
}

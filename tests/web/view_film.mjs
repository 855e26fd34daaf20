// node view_film.mjs RAINREF SOURCES FILM.webm: half a minute of somebody who uses `rainref view`, as Chromium shows it. Needs ffmpeg.
import assert from "node:assert/strict";
import path from "node:path";
import {launch, textOf, view} from "./browser.mjs";

const [program, sources, film] = process.argv.slice(2), length = 30000, timeout = 60000;
const viewed = await view(path.resolve(program), ["scenes/puddle/default.toml"], path.resolve(sources)), browser = await launch("chromium");
try {
  const page = await browser.newPage();
  await page.setViewport({width: 1280, height: 800});
  await page.goto(viewed.address);
  const frame = () => page.$eval("#state", e => Number(/^frame (\d+),/.exec(e.textContent)?.[1] ?? -1));
  const shown = () => page.waitForFunction(() => /^frame \d+,/.test(document.getElementById("state").textContent), {timeout});
  const wait = time => new Promise(done => setTimeout(done, time));
  await shown();
  const recorder = await page.screencast({path: path.resolve(film), fps: 20}), begin = Date.now();
  await page.click("#play");
  await wait(5000);
  const calm = await frame();
  assert.ok(calm > 0, "the scene plays");
  // Drags a slider from its middle to its end.
  await page.type("#find", "rain.rate");
  const slider = await page.waitForSelector('[data-key="rain.rate"] input[type="range"]', {visible: true});
  await slider.scrollIntoView();
  const box = await slider.boundingBox();
  const before = await page.$eval('[id="parameter-rain.rate"]', e => e.value);
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  for (let k = 1; k <= 20; ++k, await wait(100)) await page.mouse.move(box.x + box.width * (0.5 + k / 41), box.y + box.height / 2);
  await page.mouse.up();
  assert.notEqual(await page.$eval('[id="parameter-rain.rate"]', e => e.value), before);
  await wait(4000);
  for (const [choice, name] of [["#weather", "storm"], ["#scene", "windshield/default.toml"], ["#light", "day"]]) {
    await page.select(choice, name);
    await shown();
    if (await textOf(page, "#play") === "Play") await page.click("#play");
    await wait(Math.min(5000, Math.max(length - (Date.now() - begin), 0)));
  }
  await wait(Math.max(length - (Date.now() - begin), 0));
  assert.ok(await frame() > 0);
  await recorder.stop();
} finally {
  await browser.close();
  viewed.close();
}
console.log(`${film}: half a minute of rainref view`);

// node page_speed.mjs SITE chromium|firefox [SECONDS [SIZE]]: how soon the live page shows frame 0, on a first and on a later visit, the bytes that a
// first visit loads until then, compressed as static hosts do, and frames a second. SIZE: 640x360, automatic, … Figures, no test: run it where
// nothing else does. speed.mjs times the library without a page.
import path from "node:path";
import {launch, open, serve} from "./browser.mjs";

const [folder, name, seconds = "5", size = "640x360"] = process.argv.slice(2), errors = [];
const state = page => page.$eval("#state", e => e.textContent);
console.log(`${name}, ${size}: first visit, loaded, later visit, frames a second`);
for (const effect of ["puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"]) {
  // A browser and a site that know nothing yet.
  const site = await serve(path.resolve(folder)), browser = await launch(name);
  try {
    const visit = async () => {
      const begin = performance.now(), page = await open(browser, site, `live.html?scene=${effect}/default.toml&size=${size}`, errors);
      await page.waitForFunction(() => document.getElementById("state").textContent.startsWith("frame 0,"), {timeout: 120000, polling: 20});
      return {page, time: `${((performance.now() - begin) / 1000).toFixed(2)} s`};
    };
    const first = await visit(), loaded = site.bytes();
    await new Promise(done => setTimeout(done, 1000));  // what is kept is written after the frame
    await first.page.close();
    const {page, time} = await visit(), frame = async () => Number(/^frame (\d+)/.exec(await state(page))[1]);
    await page.$eval("#play", e => e.click());
    await page.waitForFunction(() => !document.getElementById("state").textContent.startsWith("frame 0,"), {timeout: 120000});
    const from = await frame(), begin = performance.now();
    await new Promise(done => setTimeout(done, 1000 * Number(seconds)));
    const rate = 1000 * (await frame() - from) / (performance.now() - begin);
    console.log([effect, first.time, `${(loaded / 1e6).toFixed(2)} MB`, time, rate.toFixed(1), `(${await state(page)})`].join("  "));
  } finally {
    await browser.close();
    site.close();
  }
}
if (errors.length > 0) throw new Error(errors.join("\n"));

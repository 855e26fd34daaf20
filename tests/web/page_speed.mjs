// node page_speed.mjs SITE chromium|firefox [SECONDS]: frames a second that the live page shows, and the bytes it loads until it shows frame 0,
// compressed as static hosts do. Figures, no test: run it where nothing else does. speed.mjs times the library without a page.
import path from "node:path";
import {launch, open, serve} from "./browser.mjs";

const [folder, name, seconds = "5"] = process.argv.slice(2);
const site = await serve(path.resolve(folder)), browser = await launch(name), errors = [];
const state = page => page.$eval("#state", e => e.textContent);
console.log(`${name}, 640x360: loaded until frame 0, frames a second`);
try {
  for (const effect of ["puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"]) {
    site.bytes();
    const page = await open(browser, site, `live.html?scene=${effect}/default.toml&size=640x360`, errors);
    await page.waitForFunction(() => document.getElementById("state").textContent.startsWith("frame 0,"), {timeout: 120000, polling: 50});
    const loaded = site.bytes(), frame = async () => Number(/^frame (\d+)/.exec(await state(page))[1]);
    await page.$eval("#play", e => e.click());
    await page.waitForFunction(() => !document.getElementById("state").textContent.startsWith("frame 0,"), {timeout: 120000});
    const first = await frame(), begin = performance.now();
    await new Promise(done => setTimeout(done, 1000 * Number(seconds)));
    const rate = 1000 * (await frame() - first) / (performance.now() - begin);
    console.log([effect, `${(loaded / 1e6).toFixed(2)} MB`, rate.toFixed(1), `(${await state(page)})`].join("  "));
    await page.close();
  }
  if (errors.length > 0) throw new Error(errors.join("\n"));
} finally {
  await browser.close();
  site.close();
}

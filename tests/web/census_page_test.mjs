// node census_page_test.mjs SITE BROWSER NATIVE ROOT: the census page in a headless browser: what a visitor does with it, and what it says where
// something fails. NATIVE is not used; ROOT: the sources.
import assert from "node:assert";
import fs from "node:fs";
import {checkCensus} from "../../examples/ports/wgsl/census/check.js";
import {habitRows} from "../../examples/ports/wgsl/census/words.js";
import {expectAccessible, launch, serve, textOf} from "./browser.mjs";

const [folder, browserName, , root] = process.argv.slice(2);
const packs = ["edge_splash-corrected", "rainy_glass-corrected"];
const isShown = (page, selector) => page.$eval(selector, element => element.getClientRects().length > 0);

async function open({before = null, given = [], only = packs} = {}) {
  const page = await browser.newPage();
  page.on("pageerror", error => errors.push(error.message));
  if (before) await page.evaluateOnNewDocument(before, ...given);
  await page.goto(`${site.url}census.html?packs=${only.join(",")}`);
  return page;
}
/// Presses the button and waits for the card, or for an error, which is given.
async function take(page) {
  await page.click("#take");
  await page.waitForFunction(() => !document.getElementById("take").disabled, {timeout: 400000, polling: 200});
  return await isShown(page, "#card") ? JSON.parse(await page.$eval("#json", area => area.value)) : {error: await textOf(page, "#status")};
}
/// In the page, before its scripts: shaders whose path ends so come with `by` in the place of `what`.
function changedShader(ending, what, by) {
  const real = window.fetch;
  window.fetch = async (...request) => {
    const answer = await real(...request);
    if (!String(request[0]).endsWith(ending)) return answer;
    const text = await answer.text();
    if (!text.includes(what)) throw new Error(`${ending} has no ${what}`);
    return new Response(text.replace(what, by));
  };
}

const devices = `${root}/docs/devices`, errors = [], site = await serve(folder), browser = await launch(browserName);
try {
  // Cancelled first; then taken, by the same page.
  const page = await open();
  await page.click("#take");
  await page.waitForFunction(() => /^\d+ of \d+: /.test(document.getElementById("status").textContent), {timeout: 120000, polling: 50});
  assert(await isShown(page, "#progress"));
  await page.click("#cancel");
  await page.waitForFunction(() => !document.getElementById("take").disabled, {timeout: 120000});
  assert.match(await textOf(page, "#status"), /^Cancelled/);
  assert.deepStrictEqual([await isShown(page, "#card"), await isShown(page, "#progress")], [false, false]);

  const census = await take(page);
  assert.strictEqual(census.error, undefined, census.error);
  checkCensus(census);
  assert.deepStrictEqual(census.ports.map(port => port.pack), packs);
  assert.deepStrictEqual(census.ports[0], {pack: packs[0], verdicts: {PASS: 2}, others: []});
  assert.deepStrictEqual(Object.values(census.ports[1].verdicts).reduce((a, b) => a + b), 4);
  assert.strictEqual(await isShown(page, "#progress"), false);
  assert((await textOf(page, "#name")).length > 0);
  const rows = await page.$$eval("#habits tr", all => all.map(row => [...row.children].map(cell => cell.textContent)));
  assert.deepStrictEqual(rows, habitRows(census));
  const pills = await page.$$eval("#totals .pill", all => all.map(pill => [pill.dataset.status, pill.parentElement.textContent]));
  const passed = census.ports.reduce((sum, {verdicts}) => sum + (verdicts.PASS ?? 0), 0);
  assert(pills.some(([status, text]) => status === "PASS" && text === `${passed} PASS`), JSON.stringify(pills));

  // The same browser gave a committed file: it has the same habits.
  const committed = fs.readdirSync(devices).filter(name => name.endsWith(".json")).map(name => JSON.parse(fs.readFileSync(`${devices}/${name}`, "utf8")))
    .find(other => other.by.user_agent === census.by.user_agent && other.device.vendor === census.device.vendor);
  if (committed) assert.deepStrictEqual(census.habits, committed.habits);

  // Copy says what it did; the download is the text that is shown.
  await page.click("#copy");
  await page.waitForFunction(() => document.getElementById("copied").textContent !== "", {timeout: 10000});
  const downloaded = await page.evaluate(async () => {
    const real = URL.createObjectURL;
    let given;
    URL.createObjectURL = blob => real.call(URL, given = blob);
    document.getElementById("download").click();
    URL.createObjectURL = real;
    return given.text();
  });
  assert.strictEqual(downloaded, await page.$eval("#json", area => area.value));

  await expectAccessible(page);
  // Nothing is cut off on a narrow screen.
  await page.setViewport({width: 390, height: 800});
  assert(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), "the page is wider than the screen");
  await page.close();

  // Each page that needs JavaScript says so without it: what DOMParser makes runs no script.
  const words = await browser.newPage();
  await words.goto(`${site.url}index.html`);
  for (const name of ["census", "judge", "live"]) {
    const said = await words.evaluate(async path => new DOMParser().parseFromString(await (await fetch(path)).text(), "text/html").querySelector("noscript p")?.textContent, `${name}.html`);
    assert.strictEqual(said, "This page needs JavaScript.", name);
  }
  await words.close();

  // A port that is wrong FAILs; one that does not compile is NOT RUN, with the line; the other passes are judged.
  const wrong = async (...change) => {
    const page = await open({before: changedShader, given: change, only: [packs[0]]});
    const found = await take(page), shown = found.error ? "" : await textOf(page, "#others");
    await page.close();
    return {...found, shown};
  };
  const failed = await wrong("edge_splash/splash_corrected.wgsl", "u.depth_scale + u.depth_bias", "u.depth_scale - u.depth_bias");
  assert.deepStrictEqual(failed.ports?.[0].verdicts, {PASS: 1, FAIL: 1}, failed.error);
  assert.match(failed.shown, /^FAIL splash of edge_splash-corrected: /);
  const stopped = await wrong("common/display.wgsl", "clamp(u.exposure", "clam(u.exposure");
  assert.deepStrictEqual(stopped.ports?.[0].verdicts, {PASS: 1, "NOT RUN": 1}, stopped.error);
  assert.match(stopped.shown, /^NOT RUN display of edge_splash-corrected: .*display\.wgsl:\d+:/);

  // What a visitor cannot help is said in words.
  const refused = async options => {
    const page = await open(options), {error} = await take(page);
    await page.close();
    return error;
  };
  assert.match(await refused({before: () => Object.defineProperty(Navigator.prototype, "gpu", {value: undefined})}), /^This browser has no WebGPU/);
  assert.match(await refused({before: () => Object.defineProperty(Navigator.prototype, "gpu", {value: {requestAdapter: async () => null}})}), /no WebGPU adapter/);
  assert.match(await refused({only: ["puddle"]}), /^packs: no pack puddle; there are .*edge_splash-as-published/);
  assert.deepStrictEqual(errors, []);
  console.log(`${browserName}: the census page shows what the device does, and what is wrong with ports and browsers`);
} finally {
  await browser.close();
  site.close();
}

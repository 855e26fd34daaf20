// The judge page as its tests drive it.
import path from "node:path";
import {launch, open, serve, stepsIn, textOf} from "./browser.mjs";

export const mostMs = 120000;

/// The arguments of a test of this page, SITE chromium|firefox RAINREF SOURCES [SHOTS], with the page's site served and the browser started.
export async function started() {
  const [folder, name, rainref, sources, shots] = process.argv.slice(2), errors = [];
  return {name, rainref: path.resolve(rainref), sources, shots, packs: path.resolve(sources, "build/release/packs"), errors, site: await serve(path.resolve(folder)),
          browser: await launch(name), step: stepsIn(name), good: name === "firefox" ? /^(PASS|WARN)/ : /^PASS/};  // Firefox is on another device: docs/notes/devices.md
}

/// The page at an address of the site, when it is ready. before: a function that runs in the page before its scripts.
export async function ready({browser, site, errors}, address = "judge.html", before = null) {
  const page = await open(browser, site, "", errors);
  if (before) await page.evaluateOnNewDocument(before);
  await page.goto(site.url + address);
  await page.waitForSelector("html[data-ready]", {timeout: mostMs});
  return page;
}
/// Presses a button and waits for what comes of it: the text of the verdict's line.
export async function after(page, press) {
  await page.evaluate(() => { document.getElementById("verdict").textContent = "waiting"; });
  await press();
  await page.waitForFunction(() => document.getElementById("working").hidden && document.getElementById("verdict").textContent !== "waiting", {timeout: mostMs});
  return textOf(page, "#verdict");
}
/// What a link of the page would save.
export const saved = (page, id) => page.$eval(id, async link => (await fetch(link.href)).text());
export const reportOf = async page => JSON.parse(await saved(page, "#save-json"));
export async function choose(page, values) {
  for (const [id, value] of Object.entries(values)) {
    await page.select(`#${id}`, value);
    await page.waitForFunction((i, v) => document.getElementById(i).value === v &&
      document.documentElement.dataset.shown === `${document.getElementById("pack").value} ${document.getElementById("pass").value}`, {timeout: mostMs}, id, value);
  }
}
export async function edit(page, from, to) {
  await page.evaluate((a, b) => {
    const text = document.getElementById("shader");
    if (!text.value.includes(a)) throw new Error(`the example has no ${a}`);
    text.value = text.value.replace(a, b);
    text.dispatchEvent(new Event("input", {bubbles: true}));
  }, from, to);
}

/// Gives the page an archive, and what its lines of the folder and of the verdict then say.
export async function give(page, file) {
  await page.evaluate(() => { document.getElementById("verdict").textContent = ""; });
  await (await page.$("#archive-input")).uploadFile(file);
  await page.waitForFunction(() => document.getElementById("archive-input").files.length === 0, {timeout: mostMs});  // when it was taken
  return {state: await textOf(page, "#folder-state"), verdict: await textOf(page, "#verdict")};
}

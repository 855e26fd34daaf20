// node front_page_test.mjs SITE chromium|firefox RAINREF SOURCES [SHOTS]: the front page, the port with a mistake that it leads to, and the site
// as it is published. SHOTS: a folder for screenshots.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import {click, expectReadable, launch, open, serve, stepsIn, textOf} from "./browser.mjs";

const [folder, name, , sources, shots] = process.argv.slice(2), mostMs = 120000;
const work = fs.mkdtempSync(path.join(os.tmpdir(), "front-page-")), published = path.join(work, "published");
const publish = (site, to) => execFileSync("bash", ["-c", '. scripts/lib.sh && . scripts/web_site.sh && publish_site "$@"', "bash", path.resolve(site), to],
  {cwd: sources, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"]});
const site = await serve(path.resolve(folder)), browser = await launch(name), step = stepsIn(name), errors = [];
const good = name === "firefox" ? /^(PASS|WARN)/ : /^PASS/;  // Firefox is on another device: docs/notes/devices.md
const shot = async (page, what, fullPage = true) => shots && page.screenshot({path: path.join(shots, `front-${what}-${page.viewport().width}-${name}.png`), fullPage});
/// Addresses that a page asks of other hosts, from now on.
function strangers(page, home) {
  const found = [];
  page.on("request", request => { if (/^https?:/.test(request.url()) && !request.url().startsWith(home)) found.push(request.url()); });
  return found;
}
const playing = page => page.$eval("#film", async film => {
  const begin = film.currentTime;
  for (let tries = 0; tries < 200 && film.currentTime === begin; ++tries) await new Promise(done => setTimeout(done, 50));
  return film.currentTime !== begin && film.videoWidth;
});
const seenPictures = page => page.evaluate(async () => {
  for (const image of document.images) image.loading = "eager";
  await Promise.all([...document.images].map(image => image.decode()));
  return document.images.length;
});

try {
  await step("moving rain at once, and nothing of WebAssembly", async () => {
    const page = await open(browser, site, "", errors), others = strangers(page, site.url);
    assert.equal(await playing(page), 960, "the film does not move");
    await page.waitForSelector("#mistake-verdict .pill", {timeout: mostMs});
    const bytes = site.bytes(), asked = site.requests();
    assert.deepEqual(asked.filter(file => /\.wasm$|rainref_|packs\//.test(file)), []);
    assert(bytes < 2e6, `the first view has ${bytes} bytes`);
    console.log(`${name}: first view ${bytes} bytes compressed, ${asked.length} files`);
    assert.equal(await page.$eval("#film", film => film.muted && film.loop), true);
    assert.equal(await seenPictures(page), 9);
    assert.equal(await textOf(page, "#mistake-verdict .pill"), "FAIL");
    assert.match(await textOf(page, "#mistake-verdict"), /4694 of 5760 pixels .* refraction ratio inverted/);
    assert.match(await textOf(page, "#mistake-verdict code"), /^shade_corrected\.comp:\d+: .*refract\(view, normal, WATER_IOR\)/);
    await click(page, "#film-play");
    assert.equal(await page.$eval("#film", film => film.paused), true);
    for (const [width, height] of [[390, 844], [1280, 800]]) {
      await page.setViewport({width, height});
      await expectReadable(page);
      await shot(page, "page");
      await shot(page, "top", false);
    }
    if (shots && name === "chromium") {
      await page.emulateMediaFeatures([{name: "prefers-color-scheme", value: "dark"}]);
      await shot(page, "dark");
      await page.setViewport({width: 390, height: 844});
      await shot(page, "dark");
      await page.emulateMediaFeatures([]);
    }
    assert.deepEqual(others, []);
    await page.close();
  });

  if (name === "chromium") await step("the film stands still for who wants less motion", async () => {
    const page = await browser.newPage();
    await page.emulateMediaFeatures([{name: "prefers-reduced-motion", value: "reduce"}]);
    await page.goto(site.url);
    await page.waitForSelector("#mistake-verdict .pill", {timeout: mostMs});
    assert.deepEqual(await page.$eval("#film", film => [film.paused, film.currentTime]), [true, 0]);
    await click(page, "#film-play");
    assert(await playing(page));
    await page.close();
  });

  await step("its links lead to scenes that are there", async () => {
    const page = await open(browser, site, "", errors), links = await page.$$eval("a[href]", all => all.map(a => a.getAttribute("href")));
    const scenes = new Set(JSON.parse(fs.readFileSync(path.join(folder, "scenes/index.json"))).scenes.filter(s => !s.error).map(s => s.path));
    assert.equal(await page.$eval("#film", film => film.parentElement.getAttribute("href")), "live.html?scene=puddle/default.toml");
    for (const link of links) {
      assert(fs.existsSync(path.join(folder, link.replace(/[?#].*/, ""))), link);
      const scene = /scene=([^&]*)/.exec(link)?.[1];
      assert(!scene || scenes.has(scene), link);
    }
    assert.equal(links.filter(link => link.includes("scene=")).length, 7);
    await page.close();
  });

  for (const device of ["a GPU", "no WebGPU"]) {
    await step(`the mistake in a browser with ${device}: FAIL, and mended by one click`, async () => {
      const page = await browser.newPage(), isRecorded = device === "no WebGPU";
      page.on("pageerror", error => errors.push(error.message));
      await page.setViewport({width: 1280, height: 900});
      if (isRecorded) await page.evaluateOnNewDocument(() => Object.defineProperty(Navigator.prototype, "gpu", {get: () => undefined}));
      await page.goto(site.url);
      const others = strangers(page, site.url);
      await Promise.all([page.waitForNavigation(), click(page, "#mistake .button.primary")]);
      await page.waitForSelector("html[data-mistake]", {timeout: mostMs});
      assert.equal(await page.evaluate(() => document.documentElement.dataset.mistake), isRecorded ? "recorded" : "run");
      const verdict = await textOf(page, "#verdict");
      assert.match(verdict, /^FAILshade is the first bad pass: .*Likely cause: refraction ratio inverted/);
      const frame = await (await page.$("#report")).contentFrame();
      await frame.waitForSelector(".banner .verdict", {timeout: mostMs});
      assert(await frame.evaluate(async () => (await Promise.all([...document.images].map(i => i.decode()))).length > 0), "pictures");
      if (isRecorded) assert.match(await frame.evaluate(() => document.body.textContent), /shade_corrected\.comp:\d+: .*refract\(view, normal, WATER_IOR\)/);
      assert.match(await page.$eval("#shader", e => e.value), /refract\(view, normal, water_ior\)/);
      assert.match(await textOf(page, "#mistake-notice"), /^One line of this shader is wrong/);
      for (const width of [390, 1280]) {
        await page.setViewport({width, height: 844});
        await expectReadable(page);
        await shot(page, isRecorded ? "recorded" : "run", false);
      }
      await click(page, "#mend");
      await page.waitForFunction(() => document.getElementById("mend")?.textContent === "Make the mistake again", {timeout: mostMs});
      assert.match(await textOf(page, "#mistake-notice"), /^The line is right now/);
      assert.match(await textOf(page, "#verdict"), good);
      assert.match(await page.$eval("#shader", e => e.value), /refract\(view, normal, 1\.0 \/ water_ior\)/);
      await shot(page, isRecorded ? "recorded-mended" : "run-mended", false);
      await click(page, "#mend");
      await page.waitForFunction(() => document.getElementById("mend")?.textContent === "Mend the line", {timeout: mostMs});
      assert.match(await textOf(page, "#verdict"), /^FAIL/);
      assert.deepEqual(others, []);
      await page.close();
    });
  }

  await step("another example has no such mistake", async () => {
    const page = await open(browser, site, "judge.html?mistake#pack=edge_splash-corrected&pass=display", errors);
    await page.waitForSelector("html[data-mistake]", {timeout: mostMs});
    assert.match(await textOf(page, "#verdict"), /neither changed nor run/);
    assert.equal(await page.$("#mend"), null);
    // Nor has the text of a link, although it has the line.
    await page.goto(`${site.url}judge.html#pack=puddle-corrected&pass=shade&profile=webgpu`);
    await page.waitForSelector("html[data-ready]", {timeout: mostMs});
    await page.$eval("#shader", e => { e.value += "// a stranger's\n"; e.dispatchEvent(new Event("input", {bubbles: true})); });
    await page.waitForFunction(() => /shader=/.test(location.hash), {timeout: mostMs});
    const hash = await page.evaluate(() => location.hash);
    await page.evaluate(() => sessionStorage.clear());
    await page.goto(`${site.url}judge.html?mistake${hash}`);
    await page.waitForSelector("html[data-mistake]", {timeout: mostMs});
    assert.match(await page.$eval("#shader", e => e.value), /a stranger's/);
    assert.match(await textOf(page, "#verdict"), /neither changed nor run/);
    await page.close();
  });

  await step("published: names with hashes, and no file twice", async () => {
    const said = publish(folder, published), all = root => fs.readdirSync(root, {recursive: true}).filter(file => fs.statSync(path.join(root, file)).isFile());
    console.log(`${name}: ${said.trim()}`);
    const files = all(published);
    for (const file of files.filter(f => /\.(wasm|webm|mp4|gz)$/.test(f))) assert.match(file, /\.[0-9a-f]{16}\./);
    const bytes = root => all(root).reduce((sum, file) => sum + fs.statSync(path.join(root, file)).size, 0);
    assert(bytes(published) < bytes(folder) + 2e5, "the published folder is larger than the site");
    assert.match(fs.readFileSync(path.join(published, "index.html"), "utf8"), /The whole site has \d+\.\d MB\. At the first visit your browser keeps \d+\.\d MB of it, sent as \d+\.\d MB/);
    // Again into the same folder; and never over something else.
    publish(folder, published);
    assert.deepEqual(all(published).sort(), files.sort());
    fs.mkdirSync(path.join(work, "other"));
    fs.writeFileSync(path.join(work, "other/file"), "");
    assert.throws(() => publish(folder, path.join(work, "other")), error => error.status === 2 && /other: expected a new folder/.test(error.stderr));
    assert.throws(() => publish(path.join(work, "other"), path.join(work, "new")), error => error.status === 2 && /found no rainref_module\.wasm/.test(error.stderr));
    assert.throws(() => publish(folder, path.resolve(folder, "published")), error => error.status === 2 && /expected a folder outside the built site/.test(error.stderr));
    assert.deepEqual(fs.readdirSync(work).sort(), ["other", "published"]);
  });

  await step("published: all of it works after the first visit, without the server", async () => {
    const host = await serve(published), page = await open(browser, host, "", errors), others = strangers(page, host.url);
    await page.waitForSelector("html[data-offline=kept]", {timeout: mostMs});
    assert.match(await textOf(page, "#offline-state"), /^It is kept now/);
    console.log(`${name}: first visit ${host.bytes()} bytes compressed, ${host.requests().length} files`);
    host.close();
    host.drop();
    if (name === "chromium") await page.setOfflineMode(true);
    await page.reload();
    assert(await playing(page), "the film");
    assert.equal(await seenPictures(page), 9);
    await page.goto(`${host.url}live.html?scene=puddle/default.toml&size=160x90`);
    await page.waitForFunction(() => document.getElementById("state").textContent.startsWith("frame 0,"), {timeout: mostMs});
    await page.goto(`${host.url}judge.html?mistake#pack=puddle-corrected&pass=shade&profile=webgpu`);
    await page.waitForSelector("html[data-mistake=run]", {timeout: mostMs});
    assert.match(await textOf(page, "#verdict"), /^FAILshade/);
    await page.goto(`${host.url}census.html`);
    assert.match(await textOf(page, "h1"), /\w/);
    assert.deepEqual(host.requests(), []);
    assert.deepEqual(others, []);
    await page.close();
  });
  assert.deepEqual(errors, []);
} finally {
  await browser.close();
  site.close();
  fs.rmSync(work, {recursive: true, force: true});
}

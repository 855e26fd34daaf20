// node judge_page_test.mjs SITE chromium|firefox RAINREF SOURCES [SHOTS]: the judge page as a visitor uses it. RAINREF is the native program,
// whose text the page's must be; SHOTS a folder for screenshots.
import assert from "node:assert/strict";
import {execFileSync, spawnSync} from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import {click, expectAccessible, expectReadable, textOf} from "./browser.mjs";
import {after, choose, edit, mostMs, ready as readyIn, saved, started} from "./judge_page.mjs";

const test = await started(), {name, rainref, sources, shots, packs, errors, site, browser, step, good} = test;
const work = fs.mkdtempSync(path.join(os.tmpdir(), "judge-page-"));

const ready = (address) => readyIn(test, address);
const shot = async (page, what) => shots && page.screenshot({path: path.join(shots, `judge-${what}-${page.viewport().width}-${name}.png`), fullPage: true});

/// A port of a small pack: its expected outputs, with the pictures of one pass turned over and another pass left out.
function brokenPort() {
  const port = path.join(work, "dumped");
  fs.cpSync(path.join(packs, "puddle-corrected"), port, {recursive: true});
  fs.rmSync(path.join(port, "manifest.json"));
  fs.rmSync(path.join(port, "puddle.shade"), {recursive: true});
  for (const run of fs.readdirSync(path.join(port, "puddle.display"))) {
    const inside = path.join(port, "puddle.display", run), file = path.join(inside, fs.readdirSync(inside).find(f => f.startsWith("out."))), bytes = fs.readFileSync(file);
    const head = 10 + bytes.readUInt16LE(8), height = Number(/'shape': \((\d+),/.exec(bytes.toString("latin1"))[1]), row = (bytes.length - head) / height;
    const rows = Array.from({length: height}, (_, y) => bytes.subarray(head + row * y, head + row * (y + 1)));
    fs.writeFileSync(file, Buffer.concat([bytes.subarray(0, head), ...rows.reverse()]));
  }
  fs.writeFileSync(path.join(port, "port.json"), JSON.stringify({api: "Vulkan 1.3", device: "a test"}));
  execFileSync("tar", ["-czf", path.join(work, "dumped.tar.gz"), "-C", work, "dumped"]);
  return port;
}
/// A port that exchanges red and blue, and its shader, which says so.
function swappedPort() {
  const port = path.join(work, "swapped"), shaders = path.join(work, "spirv/shaders"), ports = path.resolve(sources, "examples/ports");
  fs.cpSync(path.join(packs, "puddle-corrected"), port, {recursive: true});
  fs.rmSync(path.join(port, "manifest.json"));
  for (const run of fs.readdirSync(path.join(port, "puddle.display"))) {
    const file = path.join(port, "puddle.display", run, "out.picture.npy"), bytes = fs.readFileSync(file);
    for (let at = 10 + bytes.readUInt16LE(8); at < bytes.length; at += 4) [bytes[at], bytes[at + 2]] = [bytes[at + 2], bytes[at]];
    fs.writeFileSync(file, bytes);
  }
  fs.cpSync(path.join(ports, "puddle"), shaders, {recursive: true});
  const shader = path.join(shaders, "display_corrected.comp"), text = fs.readFileSync(shader, "utf8");
  assert(text.includes("vec4(code, 1.0)"));
  fs.writeFileSync(shader, text.replace("vec4(code, 1.0)", "vec4(code.bgr, 1.0)"));
  execFileSync("glslangValidator", ["-V", "-g", "--quiet", `-I${path.join(ports, "common")}`, "display_corrected.comp", "-o", "display_corrected.spv"], {cwd: shaders});
  for (const folder of [port, shaders])
    execFileSync("tar", ["-cf", path.join(work, `${path.basename(folder)}.tar`), "-C", path.dirname(folder), path.basename(folder)]);
}
/// What the native program says of it, where the pack lies as the page says that it lies.
function natively(port, ...options) {
  fs.symlinkSync(packs, path.join(work, "packs"));
  const made = spawnSync(rainref, ["validate", "packs/puddle-corrected", "--port", port, ...options], {cwd: work, encoding: "utf8"});
  fs.unlinkSync(path.join(work, "packs"));
  assert.equal(made.status, 1, made.stderr);
  return made.stdout;
}

try {
  const upsideDown = /^FAILdisplay is the first bad pass: .* (Likely cause:|The cause may be) upside down, /;
  let page, link;
  await step("first view", async () => {
    page = await ready("judge.html");
    const bytes = site.bytes(), asked = site.requests();
    assert(!asked.includes("/rainref_module.wasm"), "the first view loads the library");
    assert(bytes < 1.5e6, `the first view has ${bytes} bytes`);
    console.log(`${name}: first view ${bytes} bytes compressed, ${asked.length} files`);
    for (const width of [390, 1280]) {
      await page.setViewport({width, height: 900});
      await expectReadable(page);
    }
    await expectAccessible(page);
    assert.equal(await page.$eval("#verdict", e => e.ariaLive ?? e.getAttribute("aria-live")), "polite");
    await shot(page, "start");
  });

  await step("an example passes", async () => {
    await choose(page, {effect: "edge_splash", pass: "display"});
    assert.match(await after(page, () => click(page, "#run")), good);
    console.log(`${name}: first run ${await page.evaluate(() => document.documentElement.dataset.tookMs)} ms, ${site.bytes()} bytes more`);
    assert.match(await after(page, () => click(page, "#run")), good);
    console.log(`${name}: from click to verdict ${await page.evaluate(() => document.documentElement.dataset.tookMs)} ms`);
    const known = await page.evaluate(async () => {
      const engine = new (await import("./engine.js")).Engine("judge_operations.js"), names = await engine.run("profiles");
      engine.cancel();
      return [names, [...document.getElementById("profile").options].map(o => o.value).filter(value => value !== "")];
    });
    assert.deepEqual([...known[1]].sort(), [...known[0]].sort(), "profiles of the page and of the library");
  });

  await step("a changed example fails, with its cause", async () => {
    await page.focus("#shader");
    await edit(page, "vec2i(place.xy)", "vec2i(i32(place.x), i32(textureDimensions(colour).y) - 1 - i32(place.y))");
    const verdict = await after(page, async () => {
      await page.focus("#shader");
      await page.keyboard.down("Control");
      await page.keyboard.press("Enter");
      await page.keyboard.up("Control");
    });
    assert.match(verdict, upsideDown);
    link = await page.evaluate(() => location.hash);
    const report = JSON.parse(await saved(page, "#save-json"));
    assert.equal(report.format, "rainref.judgement");
    assert.equal(report.device.api, "WebGPU");
    assert.deepEqual([report.status, report.first_bad_pass, report.profile, report.passes.length], ["FAIL", "display", "webgpu", 1]);
    assert.equal(report.passes[0].causes[0].name, "upside down");
    const html = await saved(page, "#save-html");
    assert(html.includes("data:image/png") && html.includes("</html>") && html.includes("upside down"));
    const [suites, failures, broken] = await page.evaluate(xml => {
      const document = new DOMParser().parseFromString(xml, "application/xml");
      return [document.querySelectorAll("testsuite").length, document.querySelectorAll("failure").length, document.querySelectorAll("parsererror").length];
    }, await saved(page, "#save-junit"));
    assert(suites === 1 && failures > 0 && broken === 0, "JUnit");
    assert.match(await saved(page, "#save-text"), /(likely cause|may be): upside down/);
    // The report shows itself, with its pictures, in a frame that may not reach the page.
    const frame = await (await page.$("#report")).contentFrame();
    await frame.waitForSelector(".banner .verdict", {timeout: mostMs});
    assert.equal(await frame.$eval(".banner .verdict", e => e.textContent), "FAIL");
    assert(await frame.evaluate(async () => (await Promise.all([...document.images].map(i => i.decode()))).length > 0), "pictures");
    await frame.$eval('a[href="#pass-display"]', e => e.click());
    assert.equal(await frame.evaluate(() => location.hash), "#pass-display", "links within the report");
    assert.equal(await frame.$eval(".banner .verdict", e => e.textContent), "FAIL");
    assert.equal(await frame.evaluate(() => { try { return parent.document.title; } catch { return "apart"; } }), "apart");
    await expectAccessible(page);
    await shot(page, "fail");
    await page.setViewport({width: 390, height: 844});
    await shot(page, "fail");
    await page.setViewport({width: 1280, height: 900});
    if (shots && name === "chromium") {
      await page.emulateMediaFeatures([{name: "prefers-color-scheme", value: "dark"}]);
      await shot(page, "dark");
      await page.emulateMediaFeatures([]);
    }
  });

  await step("what a shader binds is listed", async () => {
    await choose(page, {pass: "splash"});
    await click(page, "#bindings summary");
    await page.waitForFunction(() => document.querySelectorAll("#bindings tbody tr").length > 0, {timeout: mostMs});
    const rows = await page.$$eval("#bindings tbody tr", all => all.map(row => row.textContent));
    assert.match(rows[0], /^0SplashUniformsuniform block$/);
    assert(rows.some(row => /^1sceneinput, rgba16f \d+x\d+/.test(row)) && rows.some(row => /output/.test(row)), rows.join("; "));
    await choose(page, {pass: "display"});
    await click(page, "#bindings summary");
  });

  await step("a link gives the view again", async () => {
    const other = await ready(`judge.html${link}`);
    const view = p => p.evaluate(() => ["effect", "variant", "pack", "pass", "profile", "shader"].map(id => document.getElementById(id).value));
    assert.deepEqual(await view(other), await view(page));
    assert.match((await view(other))[5], /textureDimensions\(colour\)\.y/);
    await other.close();
    const cut = await ready(`judge.html${link.slice(0, -30)}`);
    assert.match(await textOf(cut, "#verdict"), /shader text cannot be read/);
    await cut.close();
    const wrong = await ready("judge.html#effect=pudle&pass=display");
    assert.match(await textOf(wrong, "#verdict"), /names what is not here: effect pudle/);
    await wrong.close();
  });

  await step("a broken line is named", async () => {
    await click(page, "#reset");
    await page.waitForFunction(() => !document.getElementById("shader").value.includes("textureDimensions"));
    await edit(page, "let linear =", "let linear = no_such_function() +");
    assert.match(await after(page, () => click(page, "#run")), /display did not run/);
    const lines = await page.evaluate(() => document.getElementById("shader").value.split("\n")), wrong = lines.findIndex(l => l.includes("no_such_function")) + 1;
    const place = await textOf(page, "#shader-errors button"), marked = await textOf(page, "#gutter .bad");
    assert.match(place, new RegExp(`^\\S+\\.wgsl:${wrong - lines.slice(0, wrong).findLastIndex(l => l.startsWith("// file:")) - 1}:\\d+$`));
    assert.equal(Number(marked), wrong);
    assert.match(await textOf(page, "#shader-errors li"), /no_such_function/);
    await click(page, "#shader-errors button");
    const caret = await page.evaluate(() => [document.activeElement.id, document.activeElement.value.slice(0, document.activeElement.selectionStart).split("\n").length]);
    assert.deepEqual(caret, ["shader", wrong]);
    await shot(page, "error");
    await edit(page, "no_such_function() +", "");
    assert.match(await after(page, () => click(page, "#run")), good);
    // What has no entry point is said as the runner says it.
    await page.$eval("#shader", e => { e.value = "fn f() {}"; e.dispatchEvent(new Event("input")); });
    assert.match(await after(page, () => click(page, "#run")), /did not run/);
    assert.match(await textOf(page, "#shader-errors"), /needs one entry point/);
    await click(page, "#reset");
  });

  const port = brokenPort();
  await step("a port's folder has the native program's verdict", async () => {
    const expected = natively("dumped", "--partial");
    const input = await page.$("#archive-input");
    await input.uploadFile(path.join(work, "dumped.tar.gz"));
    await page.waitForFunction(() => document.getElementById("folder-state").textContent.startsWith("dumped:"), {timeout: mostMs});
    assert.match(await textOf(page, "#folder-state"), /it is of puddle.*profile vulkan, as its port.json says/);
    assert.match(await after(page, () => click(page, "#judge-folder")), upsideDown);
    assert.equal(await saved(page, "#save-text"), expected);
    assert.equal(JSON.parse(await saved(page, "#save-json")).exit_code, 1);
    await shot(page, "folder");
    if (name === "chromium") {  // the protocol of Firefox gives inputs no folders
      await (await page.$("#folder-input")).uploadFile(port);
      await page.waitForFunction(() => document.getElementById("folder-state").textContent.startsWith("dumped:"), {timeout: mostMs});
      assert.match(await after(page, () => click(page, "#judge-folder")), /^FAIL/);
      assert.equal(await saved(page, "#save-text"), expected);
      await page.$eval("#drop", e => e.scrollIntoView({behavior: "instant", block: "center"}));
      const session = await page.createCDPSession(), {x, y, width, height} = await (await page.$("#drop")).boundingBox();
      const data = {items: [], files: [path.resolve(port)], dragOperationsMask: 1}, at = {x: x + width / 2, y: y + height / 2};
      await page.$eval("#folder-state", e => { e.textContent = ""; });
      for (const type of ["dragEnter", "dragOver", "drop"]) await session.send("Input.dispatchDragEvent", {type, ...at, data});
      await page.waitForFunction(() => document.getElementById("folder-state").textContent.startsWith("dumped:"), {timeout: mostMs});
      assert.match(await after(page, () => click(page, "#judge-folder")), /^FAIL/);
      assert.equal(await saved(page, "#save-text"), expected);
    }
    // All files of a pass that is there are wanted where passes may not be left out.
    await page.$eval("#partial", e => { e.checked = false; });
    await after(page, () => click(page, "#judge-folder"));
    assert(JSON.parse(await saved(page, "#save-json")).files.some(f => f.pass === "shade" && f.exit_code === 3));
  });

  await step("a port's own shaders name the line", async () => {
    swappedPort();
    const expected = natively("swapped", "--partial", "--spirv", "spirv/shaders");
    assert.match(expected, /\ndisplay_corrected\.comp:\d+: /);
    assert.match(expected, /the device did what this shader says/);
    for (const [archive, state, begin] of [["swapped", "#folder-state", "swapped:"], ["shaders", "#shaders-state", "shaders:"]]) {
      await (await page.$("#archive-input")).uploadFile(path.join(work, `${archive}.tar`));
      await page.waitForFunction((id, text) => document.querySelector(id).textContent.startsWith(text), {timeout: mostMs}, state, begin);
    }
    await page.$eval("#partial", e => { e.checked = true; });
    assert.match(await after(page, () => click(page, "#judge-folder")), /^FAIL/);
    assert.equal(await saved(page, "#save-text"), expected);
    await shot(page, "line");
  });

  await step("a pack of one's own", async () => {
    fs.cpSync(path.join(packs, "edge_splash-corrected"), path.join(work, "mine"), {recursive: true});
    execFileSync("tar", ["-cf", path.join(work, "mine.tar"), "-C", work, "mine"]);
    await (await page.$("#archive-input")).uploadFile(path.join(work, "mine.tar"));
    await page.waitForFunction(() => document.getElementById("pack").value === "own:mine", {timeout: mostMs});
    await choose(page, {pass: "splash", profile: "webgpu"});
    assert.match(await after(page, () => click(page, "#run")), good);
    assert.equal(JSON.parse(await saved(page, "#save-json")).pack, "mine");
    // What is no pack and no folder is refused by name.
    fs.writeFileSync(path.join(work, "notes.txt"), "no");
    await (await page.$("#archive-input")).uploadFile(path.join(work, "notes.txt"));
    await page.waitForFunction(() => document.getElementById("verdict").textContent.startsWith("notes.txt: expected a folder"), {timeout: mostMs});
  });

  await step("cancel, and all passes of an effect", async () => {
    await choose(page, {effect: "windshield", pass: "*"});
    const verdict = await after(page, async () => {
      await click(page, "#run");
      await page.waitForFunction(() => /: \d+ of/.test(document.getElementById("doing").textContent), {timeout: mostMs});
      await click(page, "#cancel");
    });
    assert.equal(verdict, "Cancelled.");
    assert.match(await after(page, () => click(page, "#run")), good);
    const report = JSON.parse(await saved(page, "#save-json"));
    assert(report.passes.length > 8 && report.passes.every(p => /PASS|WARN/.test(p.status)), "passes of the windshield");
    await shot(page, "all");
  });

  // Firefox's software device takes minutes for it; scripts/full/wgsl firefox runs the same ports there.
  if (name === "chromium") await step("all passes of every effect and variant", async () => {
    // SwiftShader's sine: scripts/full/wgsl.
    const warns = {rainy_glass: "bake_rivulets"};
    let count = 0;
    for (const effect of ["puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"]) {
      for (const variant of ["corrected", "as-published"]) {
        await choose(page, {effect, variant, pack: `${effect}-${variant}`, pass: "*"});
        assert.match(await after(page, () => click(page, "#run")), /^(PASS|WARN)/, `${effect} ${variant}`);
        for (const {pass, status} of JSON.parse(await saved(page, "#save-json")).passes) {
          assert(status === "PASS" || (status === "WARN" && pass === warns[effect]), `${effect} ${variant} ${pass}: ${status}`);
          ++count;
        }
      }
    }
    console.log(`${name}: ${count} passes of the small packs`);
    assert(count > 40);
  });

  await step("without WebGPU a folder is judged", async () => {
    const plain = await browser.newPage();
    plain.on("pageerror", error => errors.push(error.message));
    await plain.evaluateOnNewDocument(() => Object.defineProperty(Navigator.prototype, "gpu", {get: () => undefined}));
    await plain.goto(`${site.url}judge.html#effect=puddle`);
    await plain.waitForSelector("html[data-ready]", {timeout: mostMs});
    assert.equal(await plain.$eval("#run", e => e.disabled), true);
    assert.match(await textOf(plain, "#no-gpu"), /no WebGPU/);
    await (await plain.$("#archive-input")).uploadFile(path.join(work, "dumped.tar.gz"));
    await plain.waitForFunction(() => !document.getElementById("judge-folder").disabled, {timeout: mostMs});
    assert.match(await after(plain, () => click(plain, "#judge-folder")), /^FAIL/);
    await plain.close();
  });
  assert.deepEqual(errors, []);
} finally {
  await browser.close();
  site.close();
  fs.rmSync(work, {recursive: true, force: true});
}

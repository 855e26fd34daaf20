// node judge_links_page_test.mjs SITE chromium|firefox RAINREF SOURCES: links, edits and reloads of the judge page come from one state of it.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import zlib from "node:zlib";
import {click, textOf} from "./browser.mjs";
import {after, choose, edit, give, mostMs, ready, reportOf, started} from "./judge_page.mjs";

const test = await started(), {name, packs, browser, site, step, errors} = test, work = fs.mkdtempSync(path.join(os.tmpdir(), "judge-links-"));
const viewOf = page => page.evaluate(() => Object.fromEntries(["effect", "variant", "pack", "pass", "profile", "shader"].map(id => [id, document.getElementById(id).value])));
const hashOf = page => page.evaluate(() => location.hash);
const whenHash = (page, part) => page.waitForFunction(text => location.hash.includes(text), {timeout: mostMs}, part);
const follow = async (page, hash) => {
  await page.evaluate(to => { delete document.documentElement.dataset.shown; location.hash = to; }, hash);
  await page.waitForSelector("html[data-shown]", {timeout: mostMs});
};
/// An archive of a small pack with another name; of its outputs alone if it has a port.json.
function archive(as, pack, port = null) {
  fs.cpSync(path.join(packs, pack), path.join(work, as), {recursive: true});
  if (port) {
    fs.rmSync(path.join(work, as, "manifest.json"));
    fs.writeFileSync(path.join(work, as, "port.json"), JSON.stringify(port));
  }
  execFileSync("tar", ["-cf", path.join(work, `${as}.tar`), "-C", work, as]);
  return path.join(work, `${as}.tar`);
}
const wrongCurve = ["1.0 / 2.4", "1.0 / 2.2"];

try {
  await step("a link to all passes carries the edited texts, and so does a reload", async () => {
    const page = await ready(test, "judge.html#effect=edge_splash&pass=splash");
    await edit(page, "@fragment", "// mine\n@fragment");
    await choose(page, {pass: "display"});
    await edit(page, ...wrongCurve);
    await choose(page, {pass: "*"});
    await whenHash(page, "shaders=");
    assert.match(await after(page, () => click(page, "#run")), /^FAIL/);
    const other = await ready(test, `judge.html${await hashOf(page)}`);
    assert.match(await after(other, () => click(other, "#run")), /^FAIL/);
    await other.close();
    // With one of two edited passes in the address, a reload keeps both.
    await choose(page, {pass: "display"});
    await whenHash(page, "shader=");
    await page.reload();
    await page.waitForSelector("html[data-ready]", {timeout: mostMs});
    assert((await viewOf(page)).shader.includes(wrongCurve[1]));
    await choose(page, {pass: "splash"});
    assert((await viewOf(page)).shader.includes("// mine"));
    // The link decides: one without a text means the example.
    await follow(page, "#effect=edge_splash&pass=display");
    assert((await viewOf(page)).shader.includes(wrongCurve[0]));
    await choose(page, {pass: "splash"});
    assert((await viewOf(page)).shader.includes("// mine"), "another pass than the link's");
    await page.evaluate(() => sessionStorage.clear());
    await page.close();
  });

  await step("a link knows a pack of one's own by its content", async () => {
    const mine = archive("puddle-corrected", "puddle-shore"), page = await ready(test, "judge.html#effect=puddle");
    await give(page, mine);
    await page.waitForFunction(() => document.getElementById("pack").value === "own:puddle-corrected", {timeout: mostMs});
    assert.deepEqual((await page.$$eval("#pack option", all => all.map(o => o.textContent))).filter(text => text.startsWith("puddle-corrected")).sort(),
      ["puddle-corrected", "puddle-corrected (yours)"]);
    await whenHash(page, "own=");
    const link = await hashOf(page), other = await ready(test, `judge.html${link}`);
    assert.match(await textOf(other, "#verdict"), /a pack of its sender's own, puddle-corrected \(.*\): drop it here, then open the link again/);
    await give(other, mine);
    await other.waitForFunction(() => document.getElementById("pack").value === "own:puddle-corrected", {timeout: mostMs});
    await choose(other, {pack: "puddle-corrected"});
    await follow(other, link);
    assert.equal((await viewOf(other)).pack, "own:puddle-corrected");
    assert.match(await after(other, () => click(other, "#run")), test.good);
    await click(other, "#copy-link");
    await other.waitForFunction(() => /Who opens it must drop the pack puddle-corrected there first\.$/.test(document.getElementById("link-state").textContent), {timeout: mostMs});
    await Promise.all([page.close(), other.close()]);
  });

  await step("a folder is judged under its port's profile, a run under webgpu, unless one was chosen", async () => {
    const page = await ready(test, "judge.html#effect=edge_splash&pass=splash");
    assert.match((await give(page, archive("native", "edge_splash-corrected", {api: "Vulkan 1.3"}))).state, /profile vulkan, as its port\.json says/);
    await after(page, () => click(page, "#judge-folder"));
    assert.equal((await reportOf(page)).profile, "vulkan");
    await after(page, () => click(page, "#run"));
    assert.deepEqual([(await reportOf(page)).profile, new URLSearchParams((await hashOf(page)).slice(1)).get("profile")], ["webgpu", null]);
    await page.select("#profile", "metal");
    await whenHash(page, "profile=metal");
    assert.match(await textOf(page, "#folder-state"), /profile metal, as chosen above/);
    await after(page, () => click(page, "#judge-folder"));
    assert.equal((await reportOf(page)).profile, "metal");
    await after(page, () => click(page, "#run"));
    assert.equal((await reportOf(page)).profile, "metal");
    const other = await ready(test, `judge.html${await hashOf(page)}`);
    assert.equal((await viewOf(other)).profile, "metal");
    await Promise.all([page.close(), other.close()]);
  });

  await step("what a link cannot mean is said", async () => {
    const text = (length) => zlib.deflateRawSync("a".repeat(length)).toString("base64url");
    for (const [hash, sentence] of [
      [`#effect=puddle&shader=${text(2 ** 20 + 1)}`, /longer than 1 MiB/], [`#effect=puddle&pass=*&shaders=${text(100)}`, /cannot be read/],
      ["#effect=puddle&variant=__proto__", /names what is not here: variant __proto__\./], ["#effect=windshield&pack=puddle-shore", /contradicts itself: the pack puddle-shore is of puddle corrected, not of windshield/],
      ["#pack=puddle-as-published&variant=corrected", /contradicts itself/], ["#effect=puddle&pass=toString", /not here: pass toString/], ["#pack=constructor", /not here: pack constructor/],
    ]) {
      const page = await ready(test, `judge.html${hash}`);
      assert.match(await textOf(page, "#verdict"), sentence, hash.slice(0, 60));
      await page.close();
    }
    const page = await ready(test, `judge.html#effect=edge_splash&pass=display&shader=${text(2 ** 20)}`);
    assert.equal((await viewOf(page)).shader.length, 2 ** 20);
    await page.close();
  });
  assert.deepEqual(errors, []);
} finally {
  await browser.close();
  site.close();
  fs.rmSync(work, {recursive: true, force: true});
}

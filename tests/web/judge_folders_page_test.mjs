// node judge_folders_page_test.mjs SITE chromium|firefox RAINREF SOURCES: the folders that the judge page takes: names of any kind, what cannot be
// used, and what looks like a port's folder but is none.
import assert from "node:assert/strict";
import {execFileSync, spawnSync} from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import {click, expectAccessible, textOf} from "./browser.mjs";
import {after, choose, give, mostMs, ready, reportOf, saved, started} from "./judge_page.mjs";

const test = await started(), {packs, rainref, browser, site, step, errors} = test, work = fs.mkdtempSync(path.join(os.tmpdir(), "judge-folders-"));
const at = (...parts) => path.join(work, ...parts), lines = (page, id = "#folder-state") => textOf(page, id);
const write = (file, text) => {
  fs.mkdirSync(path.dirname(at(file)), {recursive: true});
  fs.writeFileSync(at(file), text);
};
/// A folder with the outputs of a small pack.
function dump(folder, pack = "edge_splash-corrected") {
  fs.cpSync(path.join(packs, pack), at(folder), {recursive: true});
  fs.rmSync(at(folder, "manifest.json"));
  return folder;
}
/// What is inside a folder, as an archive of another name.
const packed = (folder, as = path.basename(folder)) => {
  execFileSync("tar", ["-cf", at(`${as}.tar`), "-C", at(folder), "."]);
  return at(`${as}.tar`);
};
const judged = page => after(page, () => click(page, "#judge-folder"));

try {
  const page = await ready(test, "judge.html#effect=edge_splash&pass=splash");
  await step("folders and files may have any name", async () => {
    dump("good");
    for (const inside of ["__proto__/x.npy", "constructor/y.npy", "toString", "edge_splash.splash/hasOwnProperty"]) write(`good/${inside}`, "x");
    for (const name of ["tests", "dev", "proc", "home", "packs", "spirv", "port", "judging", "__proto__", "with space & #%ü"]) {
      assert.match((await give(page, packed("good", name))).state, new RegExp(`^${name}: \\d+ files`));
      assert.match(await judged(page), /^PASS/, name);
      assert.equal((await reportOf(page)).port, ["packs", "spirv"].includes(name) ? `port/${name}` : name);
    }
  });

  await step("a folder that is refused leaves the former one", async () => {
    await give(page, packed("good"));
    for (const [text, sentence] of [['{"api": "Vul', /^bad\/port\.json: /], ["null", /^bad\/port\.json: expected an object, found null$/], ["[1]", /expected an object, found \[1\]$/]]) {
      dump("bad");
      write("bad/port.json", text);
      const {state, verdict} = await give(page, packed("bad"));
      assert.match(verdict, sentence);
      assert.match(state, /^good: /);
      assert.match(await judged(page), /^PASS/);
      assert.equal((await reportOf(page)).port, "good");
    }
  });

  await step("what looks like a port's folder is named", async () => {
    dump("parent/npy");
    write("parent/readme.txt", "x");
    assert.match((await give(page, packed("parent"))).verdict, /^parent: expected folders such as .*, found none\. It holds npy\/, which looks like it: choose that\.$/);
    assert.match((await give(page, packed("good/edge_splash.splash", "pass"))).verdict, /It looks like the folder of one pass: choose the folder around it\.$/);
    write("other/notes.txt", "x");
    assert.match((await give(page, packed("other"))).verdict, /^other: expected folders such as .*, found none\.$/);
  });

  await step("files that cannot be used, and another variant's pack, are said in the verdict's line", async () => {
    dump("cut");
    const run = fs.readdirSync(at("cut/edge_splash.splash"))[0], file = at("cut/edge_splash.splash", run, fs.readdirSync(at("cut/edge_splash.splash", run)).find(f => f.startsWith("out.")));
    fs.truncateSync(file, fs.statSync(file).size - 5);
    await give(page, packed("cut"));
    assert.match(await judged(page), /1 file is missing, or cannot be used\./);
    await expectAccessible(page);
    await give(page, packed(dump("old", "edge_splash-as-published")));
    await choose(page, {variant: "corrected", pack: "edge_splash-corrected"});
    assert.match(await judged(page), /judged against the pack edge_splash-corrected, which is corrected\. If the port ran another pack or variant, choose that above\./);
    await choose(page, {variant: "as-published", pack: "edge_splash-as-published"});
    const verdict = await judged(page);
    assert(/^PASS/.test(verdict) && !verdict.includes("another pack"), verdict);
  });

  await step("the native command gives the same text", async () => {
    await choose(page, {variant: "corrected", pack: "edge_splash-corrected"});
    await give(page, packed("cut", "it's <cut> & \"so\""));
    await judged(page);
    assert((await textOf(page, "#command")).includes(`--port 'it'\\''s <cut> & "so"' `), await textOf(page, "#command"));
    assert.equal((await reportOf(page)).command, await textOf(page, "#command"));
    const properties = await page.evaluate(xml => [...new DOMParser().parseFromString(xml, "application/xml").querySelectorAll('property[name="command"]')].map(p => p.getAttribute("value")),
      await saved(page, "#save-junit"));
    assert(properties.length > 0 && properties.every(value => value === properties[0]));
    const frame = await (await page.$("#report")).contentFrame();
    await frame.waitForSelector(".command code", {timeout: mostMs});
    for (const value of [properties[0], await frame.$eval(".command code", e => e.textContent)]) assert.equal(value, await textOf(page, "#command"));
    await give(page, packed("cut"));
    await judged(page);
    const command = await textOf(page, "#command");
    fs.symlinkSync(packs, at("packs"));
    const words = command.split(" ");
    assert.equal(words.shift(), "rainref");
    assert.equal(spawnSync(rainref, words, {cwd: work, encoding: "utf8"}).stdout, await saved(page, "#save-text"));
  });

  await step("a manifest that is none is refused by key", async () => {
    const good = JSON.parse(fs.readFileSync(path.join(packs, "edge_splash-corrected/manifest.json"), "utf8")), {passes: [pass], cases: [oneCase]} = good;
    for (const [manifest, sentence] of [
      [null, /^mine\/manifest\.json: expected an object, found null$/], [[], /expected an object, found \[\]$/], [{...good, format: "x"}, /manifest\.json: format: expected "rainref\.pack", found "x"$/],
      [{...good, effect: {}}, /manifest\.json: effect: expected a name, found \{\}$/], [{...good, passes: undefined}, /passes: expected a list that is not empty, found nothing$/],
      [{...good, passes: []}, /passes: expected a list that is not empty, found \[\]$/], [{...good, passes: [{...pass, formula: 1}]}, /passes\[0\]\.formula: expected a text, found 1$/],
      [{...good, cases: [{...oneCase, pass: "toString"}]}, /cases\[0\]\.pass: expected one of the passes .*, found "toString"$/],
    ]) {
      write("mine/manifest.json", JSON.stringify(manifest));
      assert.match((await give(page, packed("mine"))).verdict, sentence);
    }
    assert(!(await page.$$eval("#pack option", all => all.map(o => o.value))).includes("own:mine"));
    // A formula that each object has as a key is no program.
    const named = {...good, effect: "constructor", passes: good.passes.map(p => ({...p, formula: "constructor"}))};
    write("mine/manifest.json", JSON.stringify(named));
    await give(page, packed("mine"));
    await page.waitForFunction(() => document.getElementById("pack").value === "own:mine", {timeout: mostMs});
    assert.equal(await page.$eval("#pass", e => e.value), "*");
    assert.match(await lines(page, "#pack-state"), /^mine is a pack of \d+ cases/);
  });
  assert.deepEqual(errors, []);
} finally {
  await browser.close();
  site.close();
  fs.rmSync(work, {recursive: true, force: true});
}

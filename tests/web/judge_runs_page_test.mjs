// node judge_runs_page_test.mjs SITE chromium|firefox RAINREF SOURCES: runs of the judge page that something disturbs: another choice, Cancel, a GPU
// that is lost or does not answer, a library that does not load or stops.
import assert from "node:assert/strict";
import {click, open, textOf} from "./browser.mjs";
import {after, choose, mostMs, ready, reportOf, started} from "./judge_page.mjs";

const test = await started(), {browser, site, step, errors, good} = test;
const doing = (page, words) => page.waitForFunction(text => document.getElementById("doing").textContent.startsWith(text), {timeout: mostMs, polling: 5}, words);
const small = "judge.html#effect=edge_splash&pass=splash";

try {
  await step("a run uses what was chosen at its click", async () => {
    const page = await ready(test, "judge.html#effect=puddle&pack=puddle-corrected&pass=*");
    const verdict = await after(page, async () => {
      await click(page, "#run");
      await doing(page, "Running: ");
      await choose(page, {pack: "puddle-shore"});
      await page.select("#profile", "metal");
    });
    assert.match(verdict, good);
    const {pack, profile, passes} = await reportOf(page);
    assert.deepEqual([pack, profile, passes.length], ["packs/puddle-corrected", "webgpu", 5]);
    assert.equal(await page.$eval("#save-json", link => link.download), "puddle-corrected-all-webgpu.json");
    await page.close();
  });

  await step("the keyboard's place goes to Cancel, then to the result", async () => {
    const page = await ready(test, small), focused = () => page.evaluate(() => document.activeElement.id), seen = [];
    await page.focus("#run");
    assert.match(await after(page, async () => {
      await page.keyboard.press("Enter");
      seen.push(await focused());
    }), good);
    assert.deepEqual([...seen, await focused()], ["cancel", "result"]);
    await page.close();
  });

  await step("Cancel is taken while the library loads", async () => {
    const page = await ready(test, small, () => {
      const real = window.fetch;
      window.fetch = async (...request) => {
        if (String(request[0]).endsWith(".wasm")) await new Promise(done => { window.letLoad = done; });
        return real(...request);
      };
    });
    const verdict = await after(page, async () => {
      await click(page, "#run");
      await doing(page, "Loading the judge");
      await click(page, "#cancel");
    });
    assert.equal(verdict, "Cancelled.");
    await page.evaluate(() => window.letLoad());
    await new Promise(done => setTimeout(done, 1000));
    assert.equal(await textOf(page, "#verdict"), "Cancelled.");
    assert.match(await after(page, () => click(page, "#run")), good);
    await page.close();
  });

  await step("a GPU that does not answer can be cancelled", async () => {
    const page = await ready(test, small, () => {
      if (!window.GPUBuffer) return;  // as in the report's frame
      const real = GPUBuffer.prototype.mapAsync;
      window.hangs = true;
      GPUBuffer.prototype.mapAsync = function (...args) { return window.hangs ? new Promise(() => {}) : real.apply(this, args); };
    });
    const verdict = await after(page, async () => {
      await click(page, "#run");
      await page.waitForFunction(() => /^Running: 0 of \d+ \(\d+ s\)$/.test(document.getElementById("doing").textContent), {timeout: mostMs});
      await click(page, "#cancel");
      assert.equal(await page.$eval("#run", e => e.disabled), false);
    });
    assert.match(verdict, /^Cancelled\. The GPU may be busy with that shader/);
    await page.evaluate(() => { window.hangs = false; });
    assert.match(await after(page, () => click(page, "#run")), good);
    await page.close();
  });

  await step("a lost GPU is said, and asked for again", async () => {
    const page = await ready(test, "judge.html#effect=puddle&pass=*", () => {
      if (!window.GPUAdapter) return;
      const real = GPUAdapter.prototype.requestDevice;
      GPUAdapter.prototype.requestDevice = async function (...args) { return window.device = await real.apply(this, args); };
    });
    const verdict = await after(page, async () => {
      await click(page, "#run");
      await doing(page, "Running: 1 of");
      await page.evaluate(() => window.device.destroy());
    });
    assert.match(verdict, /^puddle\.\S+: the GPU was lost: .*The next run asks for it again\.$/);
    assert.equal(await page.$eval("#pass", e => e.value), "*");
    assert.match(await after(page, () => click(page, "#run")), good);
    await page.close();
  });

  await step("a site that is not whole is said", async () => {
    for (const file of ["packs/index.json", "ports/edge_splash/programs.json"]) {
      site.once(`/${file}`, 404);
      const page = await open(browser, site, small, errors);
      await page.waitForFunction(path => document.getElementById("verdict").textContent.startsWith(`${path}: 404`), {timeout: mostMs}, file);
      await page.close();
    }
  });

  await step("a library that did not load is asked for again", async () => {
    for (const file of ["rainref_module.js", "engine_worker.js"]) {
      const page = await ready(test, small);
      site.once(`/${file}`, 404);
      const failed = await after(page, () => click(page, "#run"));
      assert(!good.test(failed) && failed !== "", `${file}: ${failed}`);
      assert.match(await after(page, () => click(page, "#run")), good, file);
      await page.close();
    }
  });

  await step("a library that stops is a defect, and is started again", async () => {
    const page = await ready(test, small);
    site.once("/judge_operations.js", 200, 'export const judgeFolder = () => { throw new WebAssembly.RuntimeError("unreachable"); };');
    assert.match(await after(page, () => click(page, "#run")), /rainref failed inside \(a defect.*unreachable/);
    // Errors of Emscripten's files have no message.
    site.once("/judge_operations.js", 200, 'export const judgeFolder = () => { throw {name: "ErrnoError", errno: 44}; };');
    assert.equal(await after(page, () => click(page, "#run")), "ErrnoError 44");
    await page.close();
    const other = await ready(test, small);
    site.once("/judge_operations.js", 200, 'export const judgeFolder = () => { throw new WebAssembly.RuntimeError("unreachable"); };');
    await after(other, () => click(other, "#run"));
    assert.match(await after(other, () => click(other, "#run")), good);
    await other.close();
  });
  assert.deepEqual(errors, []);
} finally {
  await browser.close();
  site.close();
}

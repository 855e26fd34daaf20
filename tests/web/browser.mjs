// A static site served to a headless browser, with what its tests share. node_modules: npm ci beside package.json.
import assert from "node:assert/strict";
import {spawn} from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import {createRequire} from "node:module";
import path from "node:path";
import zlib from "node:zlib";
import puppeteer from "puppeteer-core";

const types = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".json": "application/json", ".wasm": "application/wasm", ".svg": "image/svg+xml"};

/// Serves a folder as static hosts do, compressed by gzip; {url, bytes(), requests(), once(), close(), drop()}: bytes that were sent since they
/// were asked for last, and the paths; once(path, status, body): the next request of that path gets this instead; drop() ends open
/// connections too. `changed`: {path: changed(text)}: files that are served otherwise than they are.
export async function serve(folder, changed = {}) {
  let bytes = 0, paths = [];
  const instead = new Map();
  const compressed = new Map();
  const server = http.createServer((request, response) => {
    const name = decodeURIComponent(new URL(request.url, "http://x").pathname), file = path.join(folder, name.endsWith("/") ? `${name}index.html` : name);
    paths.push(name);
    if (instead.has(name)) {
      const [status, text] = instead.get(name);
      instead.delete(name);
      response.writeHead(status, {"content-type": types[path.extname(name)] ?? "text/plain"});
      return response.end(text);
    }
    if (!file.startsWith(folder) || !fs.existsSync(file) || fs.statSync(file).isDirectory()) {
      response.writeHead(404);
      return response.end();
    }
    const type = types[path.extname(file)];
    const content = () => changed[name] ? Buffer.from(changed[name](fs.readFileSync(file, "utf8"))) : fs.readFileSync(file);
    if (!compressed.has(file)) compressed.set(file, type ? zlib.gzipSync(content(), {level: 6}) : content());
    const body = compressed.get(file);
    bytes += body.length;
    response.writeHead(200, {"content-type": type ?? "application/octet-stream", ...(type ? {"content-encoding": "gzip"} : {})});
    response.end(body);
  });
  await new Promise(done => server.listen(0, "127.0.0.1", done));
  const taken = (value, reset) => { reset(); return value; };
  return {url: `http://127.0.0.1:${server.address().port}/`, bytes: () => taken(bytes, () => { bytes = 0; }), requests: () => taken(paths, () => { paths = []; }),
          once: (path, status, body = "") => instead.set(path, [status, body]), close: () => server.close(), drop: () => server.closeAllConnections()};
}

/// Starts `rainref view ARGUMENT...`: {address, root, close()}: the address that it prints, and that address without the page.
export async function view(rainref, args, folder) {
  const running = spawn(rainref, ["view", ...args, "--no-browser"], {cwd: folder, stdio: ["ignore", "pipe", "inherit"]});
  const address = await new Promise((done, failed) => {
    let text = "";
    running.stdout.on("data", more => { if ((text += more).includes("\n")) done(text.split("\n")[0]); });
    running.on("exit", code => failed(new Error(`rainref view ended with ${code}`)));
  });
  return {address, root: address.slice(0, address.indexOf("live.html")), close: () => { running.removeAllListeners("exit"); running.kill(); }};
}

/// Starts "chromium" or "firefox" with WebGPU on its software adapter.
export function launch(name) {
  if (name === "firefox") {
    return puppeteer.launch({browser: "firefox", executablePath: "/usr/bin/firefox-esr", extraPrefsFirefox: {"dom.webgpu.enabled": true, "gfx.webgpu.ignore-blocklist": true}});
  }
  return puppeteer.launch({executablePath: "/usr/bin/chromium", args: [...(process.getuid() === 0 ? ["--no-sandbox"] : []), "--enable-unsafe-webgpu",
    "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan"]});
}

/// A new page at a path of the site, of the given width; errors that nobody caught are put into `errors`.
export async function open(browser, site, address, errors, width = 1280) {
  const page = await browser.newPage();
  page.on("pageerror", error => errors.push(`${address}: ${error.message}`));
  await page.setViewport({width, height: width < 600 ? 844 : 900});
  await page.goto(site.url + address);
  return page;
}

export const textOf = (page, selector) => page.$eval(selector, e => e.textContent.trim());
export const click = (page, selector) => page.$eval(selector, e => e.click());

/// Steps of a test in this browser: each says how long it took, and what fails names browser and step.
export const stepsIn = name => async (what, test) => {
  const begin = Date.now();
  try {
    await test();
  } catch (error) {
    error.message = `${name}, ${what}: ${error.message}`;
    throw error;
  }
  console.log(`${name}: ${what} (${Date.now() - begin} ms)`);
};

/// The page is no wider than its window, and its controls have names.
export async function expectReadable(page) {
  assert(await page.evaluate(() => document.documentElement.scrollWidth <= document.documentElement.clientWidth), `wider than ${page.viewport().width}`);
  const unnamed = await page.$$eval("select, textarea, input:not([hidden]), button", all =>
    all.filter(e => !e.labels?.length && !e.ariaLabel && !e.getAttribute("aria-label") && !e.textContent.trim()).map(e => e.id || e.outerHTML));
  assert.deepEqual(unnamed, [], "controls without a name");
}

const axe = fs.readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
/// axe-core finds nothing that shuts people out; in Chromium in light and in dark, which the protocol of Firefox cannot choose.
export async function expectAccessible(page) {
  const schemes = page.browser().process().spawnfile.includes("firefox") ? [null] : ["light", "dark"];
  await page.evaluate(axe);
  for (const scheme of schemes) {
    if (scheme) await page.emulateMediaFeatures([{name: "prefers-color-scheme", value: scheme}]);
    const found = await page.evaluate(async () => (await globalThis.axe.run(document, {iframes: false})).violations.map(({id, help, nodes}) =>
      `${id}: ${help}: ${nodes.map(node => node.target.join(" ")).join(", ")}`));
    assert.deepEqual(found, [], `axe-core${scheme ? `, ${scheme}` : ""}`);
    if (scheme) await page.emulateMediaFeatures([]);
  }
}

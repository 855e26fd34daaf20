// The site in a headless browser: inBrowser("chromium", SITE, async ({browser, page, url}) => ...). WebGPU runs on software devices: SwiftShader in
// Chromium, Mesa's in Firefox. What a page throws that nobody catches is an error of the test.
import fs from "node:fs";
import http from "node:http";
import path from "node:path";
import puppeteer from "puppeteer-core";

const types = {".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json", ".wasm": "application/wasm", ".png": "image/png"};
/// Serves a folder to this machine alone; gives {url, close}.
function serve(folder) {
  const server = http.createServer((request, answer) => {
    const file = path.join(folder, path.normalize(decodeURIComponent(new URL(request.url, "http://x").pathname)));
    fs.readFile(file, (error, bytes) => {
      answer.writeHead(error ? 404 : 200, {"content-type": types[path.extname(file)] ?? "application/octet-stream"});
      answer.end(bytes);
    });
  });
  return new Promise(done => server.listen(0, "127.0.0.1", () =>
      done({url: `http://127.0.0.1:${server.address().port}/`, close: () => { server.close(); server.closeAllConnections(); }})));
}

const launchers = {
  chromium: {executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan"]},
  firefox: {browser: "firefox", executablePath: "/usr/bin/firefox-esr", extraPrefsFirefox: {"dom.webgpu.enabled": true, "gfx.webgpu.ignore-blocklist": true}},
};

export async function inBrowser(name, site, body) {
  const served = await serve(site), browser = await puppeteer.launch({headless: true, ...launchers[name]});
  try {
    const page = await browser.newPage(), thrown = [];
    page.setDefaultTimeout(120000);
    page.on("pageerror", error => thrown.push(error.message));
    await page.setViewport({width: 1280, height: 900});
    await body({browser, page, url: served.url});
    if (thrown.length > 0) throw new Error(`the page threw: ${thrown.join("; ")}`);
  } finally {
    await browser.close();
    served.close();
  }
}

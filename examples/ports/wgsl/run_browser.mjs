// node run_browser.mjs chromium|firefox PACK OUT [PASS,...]: as run.mjs, in a headless browser on its software adapter.
import {spawn} from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import os from "node:os";
import path from "node:path";

const [browser, pack, out, passes] = process.argv.slice(2);
const here = path.dirname(new URL(import.meta.url).pathname), profile = fs.mkdtempSync(path.join(os.tmpdir(), "wgsl-"));
const types = {".html": "text/html", ".js": "text/javascript"};
let child;

function end(code, text) {
  console.log(text);
  child?.kill("SIGKILL");
  child?.on("exit", () => {
    fs.rmSync(profile, {recursive: true, force: true, maxRetries: 9});
    process.exit(code);
  });
}
/// The folder of a request and the path in it; null for what leads out of it.
function fileOf(url) {
  const name = decodeURIComponent(url.split("?")[0]), inPack = name.startsWith("/pack/");
  const folder = path.resolve(inPack ? pack : here), file = path.join(folder, inPack ? name.slice(5) : name);
  return file.startsWith(folder + path.sep) ? file : null;
}
const server = http.createServer((request, response) => {
  const chunks = [];
  request.on("data", chunk => chunks.push(chunk)).on("end", () => {
    const body = Buffer.concat(chunks), name = decodeURIComponent(request.url);
    if (request.method === "POST") {
      response.end();
      if (name === "/done") return end(0, body.toString());
      if (name === "/failed") return end(3, body.toString());
      const file = path.join(path.resolve(out), name.slice(4));
      if (!name.startsWith("/out/") || !file.startsWith(path.resolve(out) + path.sep)) return end(3, `${name}: not a file of a port`);
      fs.mkdirSync(path.dirname(file), {recursive: true});
      fs.writeFileSync(file, body);
      return;
    }
    if (name === "/passes") return response.end(JSON.stringify(passes?.split(",") ?? null));
    const file = fileOf(request.url), found = file !== null && fs.existsSync(file);
    response.writeHead(found ? 200 : 404, {"content-type": types[path.extname(file ?? "")] ?? "application/octet-stream"});
    response.end(found ? fs.readFileSync(file) : "");
  });
});

const commands = {
  chromium: url => ["chromium", "--headless", ...(process.getuid() === 0 ? ["--no-sandbox"] : []), `--user-data-dir=${profile}`, "--no-first-run",
                    "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan", url],
  firefox: url => ["firefox-esr", "-headless", "-no-remote", "-profile", profile, url],
};
if (!out || !commands[browser]) {
  console.error("usage: node run_browser.mjs chromium|firefox PACK OUT [PASS,...]");
  process.exit(2);
}
fs.writeFileSync(path.join(profile, "user.js"), 'user_pref("dom.webgpu.enabled", true);\nuser_pref("gfx.webgpu.ignore-blocklist", true);\n');
server.listen(0, "127.0.0.1", () => {
  const [program, ...options] = commands[browser](`http://127.0.0.1:${server.address().port}/run.html?served`);
  child = spawn(program, options, {stdio: "ignore"});
  child.on("error", error => end(3, `${program}: ${error.message}`));
  setTimeout(() => end(3, `${browser}: no answer in two minutes`), 120000).unref();
});

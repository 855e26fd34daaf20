// node run_browser.mjs chromium|firefox PACK OUT [PASS,...] [--shaders FOLDER]: as run.mjs, in a headless browser on its software adapter.
import {spawn} from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import os from "node:os";
import path from "node:path";
import {parseArgs} from "node:util";

const {positionals: [browser, pack, out, passes], values: {shaders}} = parseArgs({allowPositionals: true, options: {shaders: {type: "string"}}});
const here = path.dirname(new URL(import.meta.url).pathname), profile = fs.mkdtempSync(path.join(os.tmpdir(), "wgsl-"));
const types = {".html": "text/html", ".js": "text/javascript"};
let child;

function end(code, text) {
  console.log(text);
  child?.kill("SIGKILL");
  child?.on("exit", () => {
    try {
      fs.rmSync(profile, {recursive: true, force: true, maxRetries: 9});
    } catch {
      // a helper of the browser still writes there: the system clears its temporary folder
    }
    process.exit(code);
  });
}
/// The file of a request: in the pack, among the shaders or here; null for what leads out of these folders.
function fileOf(url) {
  const name = decodeURIComponent(url.split("?")[0]), first = name.split("/")[1];
  const other = first === "pack" ? pack : first === "shaders" ? shaders : undefined;
  const folder = path.resolve(other ?? here), file = path.join(folder, other ? name.slice(1 + first.length) : name);
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
    if (name === "/options") return response.end(JSON.stringify({passes: passes?.split(",") ?? null, shaders: shaders ? "shaders" : null}));
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
  console.error("usage: node run_browser.mjs chromium|firefox PACK OUT [PASS,...] [--shaders FOLDER]");
  process.exit(2);
}
fs.writeFileSync(path.join(profile, "user.js"), 'user_pref("dom.webgpu.enabled", true);\nuser_pref("gfx.webgpu.ignore-blocklist", true);\n');
server.listen(0, "127.0.0.1", () => {
  const [program, ...options] = commands[browser](`http://127.0.0.1:${server.address().port}/run.html?served`);
  child = spawn(program, options, {stdio: "ignore"});
  child.on("error", error => end(3, `${program}: ${error.message}`));
  setTimeout(() => end(3, `${browser}: no answer in two minutes`), 120000).unref();
});

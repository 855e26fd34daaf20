// node port.mjs FLAT OUT: runs port.html on a flat pack in a headless Chromium, and writes what it gives into OUT.
import {spawn} from "node:child_process";
import fs from "node:fs";
import http from "node:http";
import os from "node:os";
import path from "node:path";

const [flat, out] = process.argv.slice(2), here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);
const profile = fs.mkdtempSync(path.join(os.tmpdir(), "three-")), types = {".html": "text/html", ".js": "text/javascript"};
let child;

function end(code, text) {
  console.log(text);
  child?.kill("SIGKILL");
  setTimeout(() => {
    fs.rmSync(profile, {recursive: true, force: true, maxRetries: 9});
    process.exit(code);
  }, 200);
}
/// The file of a request below a folder; null for what leads out of it.
function inside(folder, name) {
  const file = path.resolve(folder, "." + name);
  return file.startsWith(path.resolve(folder) + path.sep) ? file : null;
}
const server = http.createServer((request, response) => {
  const chunks = [], name = decodeURIComponent(request.url.split("?")[0]);
  request.on("data", chunk => chunks.push(chunk)).on("end", () => {
    const body = Buffer.concat(chunks);
    if (request.method === "POST") {
      response.end();
      if (name === "/done" || name === "/failed") return end(name === "/done" ? 0 : 3, body.toString());
      const file = name.startsWith("/out/") ? inside(out, name.slice(4)) : null;
      if (!file) return end(3, `${name}: not a file of a port`);
      fs.mkdirSync(path.dirname(file), {recursive: true});
      return fs.writeFileSync(file, body);
    }
    const file = name.startsWith("/flat/") ? inside(flat, name.slice(5)) : inside(here, name), found = file !== null && fs.existsSync(file);
    response.writeHead(found ? 200 : 404, {"content-type": types[path.extname(file ?? "")] ?? "application/octet-stream"});
    response.end(found ? fs.readFileSync(file) : "");
  });
});
if (!out) {
  console.error("usage: node port.mjs FLAT OUT");
  process.exit(2);
}
server.listen(0, "127.0.0.1", () => {
  child = spawn("chromium", ["--headless", ...(process.getuid() === 0 ? ["--no-sandbox"] : []), `--user-data-dir=${profile}`, "--no-first-run",
                             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", `http://127.0.0.1:${server.address().port}/port.html`], {stdio: "ignore"});
  child.on("error", error => end(3, `chromium: ${error.message}`));
  setTimeout(() => end(3, "chromium: no answer in two minutes"), 120000).unref();
});

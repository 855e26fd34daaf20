// node publish.mjs SITE FOLDER: a copy of the built site for a static host. The large files have a hash of their content in their names, and a
// service worker keeps what a visit may need. FOLDER is new, or of an earlier call; it is replaced when the copy is whole.
import crypto from "node:crypto";
import fs from "node:fs";
import path from "node:path";
import {fileURLToPath} from "node:url";
import zlib from "node:zlib";

const [site, folder] = process.argv.slice(2).map(name => path.resolve(name)), own = path.dirname(fileURLToPath(import.meta.url)), made = `${folder}.part`;
function fail(message) {
  fs.rmSync(made, {recursive: true, force: true});
  process.stderr.write(`publish: ${message}\n`);
  process.exit(2);
}
if (!fs.existsSync(path.join(site, "rainref_module.wasm"))) fail(`${site}: expected the built site, found no rainref_module.wasm: run scripts/web build first`);
if (`${folder}${path.sep}`.startsWith(`${site}${path.sep}`)) fail(`${folder}: expected a folder outside the built site`);
if (fs.existsSync(folder) && (!fs.statSync(folder).isDirectory() || (fs.readdirSync(folder).length > 0 && !fs.existsSync(path.join(folder, "service_worker.js")))))
  fail(`${folder}: expected a new folder, or one of an earlier call, found something else`);

fs.rmSync(made, {recursive: true, force: true});
fs.cpSync(site, made, {recursive: true, filter: from => path.basename(from) !== "node_modules"});
const at = name => path.join(made, name), read = name => fs.readFileSync(at(name)), textOf = name => fs.readFileSync(at(name), "utf8");
const listed = () => fs.readdirSync(made, {recursive: true}).map(name => name.split(path.sep).join("/")).filter(name => fs.statSync(at(name)).isFile()).sort();
const hashOf = bytes => crypto.createHash("sha256").update(bytes).digest("hex").slice(0, 16);
/// Replaces text that has to be there.
function rewrite(name, from, to) {
  const text = textOf(name);
  if (!text.includes(from)) fail(`${name} lacks the text that is replaced: ${from}`);
  fs.writeFileSync(at(name), text.replaceAll(from, () => to));
}

// Names that hold a hash: the modules, the packs, the film. What names them is changed alike.
const renamed = new Map();
for (const name of listed().filter(file => /^(rainref_\w+\.(js|wasm)|packs\/.*\.tar\.gz|film\/.*\.(webm|mp4))$/.test(file))) {
  const [, stem, ending] = /^(.*?)(\.tar\.gz|\.\w+)$/.exec(name), to = `${stem}.${hashOf(read(name))}${ending}`;
  fs.renameSync(at(name), at(to));
  renamed.set(name, to);
}
const those = start => [...renamed].filter(([name]) => name.startsWith(start));
rewrite("names.js", "const published = {};", `const published = ${JSON.stringify(Object.fromEntries(those("rainref_")), null, 2)};`);
for (const [name, to] of those("packs/")) rewrite("packs/index.json", `"${path.basename(name)}"`, `"${path.basename(to)}"`);
for (const [name, to] of those("film/")) rewrite("index.html", `"${name}"`, `"${to}"`);

// Workbox, as npm ci left it beside this script.
fs.mkdirSync(at("workbox"));
for (const part of ["core", "routing", "strategies", "range-requests", "precaching"])
  fs.copyFileSync(path.join(own, `node_modules/workbox-${part}/build/workbox-${part}.prod.js`), at(`workbox/workbox-${part}.prod.js`));
fs.copyFileSync(path.join(own, "node_modules/workbox-core/LICENSE"), at("workbox/LICENSE"));
fs.copyFileSync(path.join(own, "offline.js"), at("offline.js"));
for (const name of listed().filter(file => /^\w+\.html$/.test(file))) rewrite(name, "</head>", '<script type="module" src="offline.js"></script>\n</head>');

// Kept at the first visit: all that a page may load, but for most pictures of the gallery (the front page shows some, the live page others before a frame), what is for
// Node, and the film for browsers that cannot show WebM.
const front = textOf("index.html");
const keeps = name => !/^(workbox|licences)\/|\.mjs$|^film\/.*\.mp4$|package(-lock)?\.json$|README\.md$/.test(name) && (!name.startsWith("gallery/") || front.includes(`"${name}"`) || /_default\.jpg$/.test(name));
const transferred = bytes => Math.min(bytes.length, zlib.gzipSync(bytes, {level: 6}).length), sum = (names, size) => names.reduce((total, name) => total + size(read(name)), 0);
const megabytes = count => `${(count / 1e6).toFixed(1)} MB`;
const before = listed().filter(keeps), size = {
  all: megabytes(sum(listed(), bytes => bytes.length)), kept: megabytes(sum(before, bytes => bytes.length)), sent: megabytes(sum(before, transferred)),
};
rewrite("index.html", '<p id="site-size" hidden></p>', `<p id="site-size" class="dim">The whole site has ${size.all}. At the first visit your browser keeps ${size.kept} of it, ` +
  `sent as ${size.sent}, for use without a network. <span id="offline-state" role="status"></span></p>`);
const hashed = new Set(renamed.values()), kept = before.map(url => ({url, revision: hashed.has(url) ? null : hashOf(read(url))}));
fs.copyFileSync(path.join(own, "service_worker.js"), at("service_worker.js"));
rewrite("service_worker.js", "const kept = [];", `const kept = ${JSON.stringify(kept, null, 1)};`);

const count = listed().length;
fs.rmSync(folder, {recursive: true, force: true});
fs.renameSync(made, folder);
console.log(`${folder}: ${count} files, ${size.all}; kept in a browser at the first visit: ${kept.length} files, ${size.kept}, sent as ${size.sent}`);

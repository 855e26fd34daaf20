// The judge page: the choice, the run, and its result.
import {boundBuffers, isRecords} from "./ports/pack.js";
import {Cancelled} from "./cancelled.js";
import {Engine, loadLibrary} from "./engine.js";
import {chosenFolders, droppedFolders, jsonOf} from "./files.js";
import {Editor} from "./editor.js";
import {runPasses} from "./gpu_run.js";
import {hashOf, viewOf} from "./link.js";
import {exampleOf, hasProgram, packFolder, packList} from "./packs.js";
import {element} from "./report_words.js";
import {filesOf, textOf} from "./shader_text.js";
import {Outcome} from "./outcome.js";

const $ = id => document.getElementById(id);
const everyPass = "*";  // the choice of all passes
const profileNames = ["webgpu", "vulkan", "d3d", "metal", "cuda", "opengl", "gles", "webgl", "opencl", "ieee"];
const engine = new Engine("judge_operations.js");
const outcome = new Outcome($("verdict"), $("outcome"), $("report"));

let packs = [];           // as packs/index.json; `folder` is there where it is one of the visitor's own
let port = null;          // the folder that was dropped: {name, files}
let portShaders = null;   // the one of its SPIR-V: the same
let running = null;       // AbortController of what is under way
let hasChosenProfile = false;
const edits = new Map();  // formula to the text that the visitor made of it
const editor = new Editor($("shader"), $("gutter"), $("shader-errors"), () => {
  edits.set(formula(), editor.value);
  showLink();
});

// ---- the choice ----

const pack = () => packs.find(p => p.name === $("pack").value);
const pass = () => pack()?.passes.find(p => p.name === $("pass").value);
const formula = () => pass()?.formula;
const distinct = values => [...new Set(values)];

/// Fills a <select> with [value, text]s and keeps the current choice if it still exists.
function fill(select, options, wanted = select.value) {
  select.replaceChildren(...options.map(([value, text, isDisabled = false]) => Object.assign(new Option(text, value), {disabled: isDisabled})));
  if (options.some(([value]) => value === wanted)) select.value = wanted;
  else if (select.selectedOptions[0]?.disabled) select.value = options.find(([, , isDisabled]) => !isDisabled)?.[0] ?? "";
  select.disabled = options.length < 2;
}

/// Fills the selects from left to right, after one of them changed or for a given view, and shows the elements for that choice.
async function choose(wanted = {}) {
  const values = key => distinct(packs.filter(p => key === "effect" || p.effect === $("effect").value).map(p => p[key]));
  const named = wanted.pack && packs.find(p => p.name === wanted.pack);
  fill($("effect"), values("effect").map(name => [name, name]), named?.effect ?? wanted.effect);
  fill($("variant"), values("variant").sort().reverse().map(name => [name, name.replace("-", " ")]), named?.variant ?? wanted.variant);
  const fitting = packs.filter(p => p.effect === $("effect").value && p.variant === $("variant").value);
  fill($("pack"), fitting.map(p => [p.name, p.folder ? `${p.name} (yours)` : p.name]), wanted.pack);
  const judged = await Promise.all(pack().passes.map(async p => [p.name, p.name, p.cases === 0 || !await hasProgram(pack().effect, p.formula)]));
  fill($("pass"), [...judged.map(([name, text, isData]) => [name, isData ? `${text} (made by the host)` : text, isData]), [everyPass, "all passes"]], wanted.pass);
  if (wanted.profile) fill($("profile"), profileNames.map(name => [name, name]), wanted.profile);
  await show();
}

async function show() {
  const isAll = $("pass").value === everyPass, chosen = pass();
  $("one-pass").hidden = $("open-shader").hidden = $("reset").hidden = isAll;
  $("all-passes").hidden = !isAll;
  $("run").textContent = isAll ? "Run all passes on this GPU" : "Run on this GPU";
  const cases = isAll ? pack().passes.reduce((sum, p) => sum + p.cases, 0) : chosen.cases;
  $("sentence").textContent = `${isAll ? `Pack of ${pack().scene}.` : chosen.sentence} ${cases} case${cases === 1 ? "" : "s"}.`;
  if (!isAll) {
    const text = edits.get(chosen.formula) ?? textOf(await exampleOf(pack().effect, chosen.formula));
    if (formula() === chosen.formula) editor.value = text;
  }
  document.documentElement.dataset.shown = `${$("pack").value} ${$("pass").value}`;  // for who drives the page
  if ($("bindings").open) showBindings().catch(error => outcome.fail(error.message));
  showLink();
}

/// The bindings of the chosen pass, from the pack's manifest, which is loaded for this.
async function showBindings() {
  if (!pass()) return;
  const chosen = pass(), manifest = await jsonOf(await folder(), "manifest.json"), oneCase = manifest.cases.find(c => c.pass === chosen.name);
  const rows = [[0, manifest.passes.find(p => p.name === chosen.name).uniform_block.name, "uniform block"]];
  for (const {name, binding, isOutput, buffer} of boundBuffers(manifest, oneCase)) {
    const what = !buffer ? "not in this case" : isRecords(buffer) ? `records ${buffer.record}` : `${buffer.format} ${buffer.width}x${buffer.height}`;
    rows.push([binding, name, `${isOutput ? "output" : "input"}, ${what}${!isOutput && buffer && buffer.min_filter && buffer.min_filter !== "none" ? `, sampler at ${binding + 16}` : ""}`]);
  }
  $("bindings").querySelector("tbody").replaceChildren(...rows.map(cells => element("tr", {}, cells.map(text => element("td", {}, String(text))))));
}
const folder = async () => pack().folder ?? packFolder(pack());

// ---- links ----

const view = () => ({effect: $("effect").value, variant: $("variant").value, pack: $("pack").value, pass: $("pass").value, profile: $("profile").value,
                     shader: edits.get(formula())});
let links = 0;
/// Puts the view into the address bar.
async function showLink() {
  const number = ++links, hash = await hashOf(view());
  if (number === links) history.replaceState(null, "", hash);
}
async function followLink() {
  if (location.hash.length < 2) return choose({profile: "webgpu"});
  try {
    const wanted = await viewOf(location.hash), unknown = [];
    for (const [key, known] of [["effect", packs.map(p => p.effect)], ["pack", packs.map(p => p.name)], ["profile", profileNames]])
      if (wanted[key] && !known.includes(wanted[key])) unknown.push(`${key} ${wanted[key]}`);
    await choose({profile: "webgpu", ...wanted});
    if (wanted.pass && $("pass").value !== wanted.pass) unknown.push(`pass ${wanted.pass}`);
    if (unknown.length > 0) return outcome.fail(`The link names what is not here: ${unknown.join(", ")}.`);
    if (wanted.shader && formula()) {
      edits.set(formula(), wanted.shader);
      await show();
    }
  } catch (error) {
    await choose({profile: "webgpu"});
    outcome.fail(error.message);
  }
}

// ---- judging ----

/// Shows the progress.
function working(doing, done = null, of = null) {
  $("working").hidden = doing === null;
  $("doing").textContent = doing === null ? "" : of === null ? `${doing} …` : `${doing}: ${done} of ${of}`;
  if (of === null) $("progress").removeAttribute("value");
  else [$("progress").max, $("progress").value] = [of, done];
}

/// Runs `work(signal)` with progress and Cancel; shows its error.
async function guarded(work) {
  if (running) return;
  running = new AbortController();
  $("run").disabled = $("judge-folder").disabled = true;
  working("Preparing");
  outcome.clear();
  const begin = performance.now();
  try {
    await work(running.signal);
    document.documentElement.dataset.tookMs = String(Math.round(performance.now() - begin));
  } catch (error) {
    if (error instanceof Cancelled || running.signal.aborted) outcome.note("Cancelled.");
    else outcome.fail(error.message);
  } finally {
    running = null;
    working(null);
    $("run").disabled = !navigator.gpu;
    $("judge-folder").disabled = port === null;
  }
}

/// Judges a port's folder and shows the report.
async function judged(portFolder, options) {
  working("Loading the judge");
  await engine.start();
  working("Judging");
  const ownPack = await folder(), path = pack().folder ? ownPack.name : `packs/${pack().name}`;
  const result = await engine.run("judgeFolder", {
    pack: {path, files: [...ownPack.files]},
    port: {path: portFolder.name === path ? `port/${portFolder.name}` : portFolder.name, files: [...portFolder.files]},
    profile: $("profile").value, ...options,
  }, {onProgress: (done, of) => done < of ? working("Judging", done, of) : working("Looking for causes, and drawing")});
  outcome.show(result, `${pack().name}-${$("pass").value === everyPass || !options.passes ? "all" : $("pass").value}-${$("profile").value}`);
  $("result").scrollIntoView({block: "start"});
}

const runShaders = () => guarded(async signal => {
  editor.clearErrors();
  const wanted = pass() ? [pass()] : pack().passes, shaders = new Map();
  for (const p of wanted) {
    if (p.cases === 0 || !await hasProgram(pack().effect, p.formula)) continue;
    shaders.set(p.name, edits.has(p.formula) ? filesOf(edits.get(p.formula)) : await exampleOf(pack().effect, p.formula));
  }
  loadLibrary().catch(() => {});  // meanwhile; judged() says what went wrong
  working("Loading the pack");
  const ownPack = await folder();
  working("Running");
  try {
    const ran = await runPasses(navigator.gpu, ownPack, shaders, {signal, progress: (done, of) => working("Running", done, of)});
    await judged(ran, {passes: [...shaders.keys()]});
  } catch (error) {
    if (!error.pass || signal.aborted) throw error;
    if (!pass()) await choose({...view(), pass: error.pass});
    editor.showError(error.message);
    throw new Error(`${error.pass} did not run: see below its text`);
  }
});
const judgeFolder = () => guarded(() => judged(port, {
  partial: $("partial").checked, spirv: portShaders && {path: `spirv/${portShaders.name}`, files: [...portShaders.files]}}));

/// Takes dropped or chosen folders: packs, one of a port, and one of its shaders.
async function take(promise) {
  try {
    for (const one of await promise) {
      if (one.files.has("bindings.json")) takeShaders(one);
      else if (one.files.has("manifest.json") && !one.files.has("port.json")) await takePack(one);
      else await takePort(one);
    }
  } catch (error) {
    outcome.fail(error.message);
  }
}
async function takePack(one) {
  const manifest = await jsonOf(one, "manifest.json"), {format, effect, variant, scene, passes, cases} = manifest;
  if (format !== "rainref.pack") throw new Error(`${one.name}/manifest.json: expected the format rainref.pack, found ${format}`);
  const about = passes.map(({name, sentence, formula}) => ({name, sentence, formula, cases: cases.filter(c => c.pass === name).length}));
  packs = [...packs.filter(p => p.name !== one.name), {name: one.name, effect, variant, scene, passes: about, folder: one}];
  await choose({pack: one.name});
  $("pack-state").textContent = `${one.name} is a pack of ${cases.length} cases: it is chosen above.`;
  $("pack-state").hidden = false;
}
function takeShaders(one) {
  portShaders = one;
  $("shaders-state").textContent = `${one.name}: the port's shaders are asked too, and the line of a mistake is named.`;
  $("shaders-state").hidden = false;
}
async function takePort(one) {
  port = one;
  const notes = [], effect = distinct([...one.files.keys()].map(path => /^(\w+)\.\w+\//.exec(path)?.[1])).find(name => packs.some(p => p.effect === name));
  if (effect && effect !== pack().effect) {
    await choose({effect});
    notes.push(`it is of ${effect}: look whether the pack above is the one that it ran`);
  }
  const api = one.files.has("port.json") ? String((await jsonOf(one, "port.json")).api ?? "") : "";
  const profile = [["webgpu", /webgpu/i], ["vulkan", /vulkan/i], ["d3d", /direct3d|d3d|directx/i], ["metal", /metal/i], ["cuda", /cuda/i],
    ["webgl", /webgl/i], ["opencl", /opencl/i], ["gles", /opengl ?es|gles/i], ["opengl", /opengl/i]].find(([, word]) => word.test(api))?.[0];
  if (!hasChosenProfile) $("profile").value = profile ?? "vulkan";
  if (!hasChosenProfile) notes.push(`profile ${$("profile").value}${profile ? ", as its port.json says" : ""}`);
  $("folder-state").textContent = `${one.name}: ${one.files.size} files${notes.length ? `; ${notes.join("; ")}` : ""}.`;
  $("judge-folder").disabled = running !== null;
  showLink();
}

// ---- the page's controls ----

for (const id of ["effect", "variant", "pack"]) $(id).addEventListener("change", () => choose());
$("pass").addEventListener("change", show);
$("profile").addEventListener("change", () => { hasChosenProfile = true; showLink(); });
$("bindings").addEventListener("toggle", () => $("bindings").open && showBindings().catch(error => outcome.fail(error.message)));
$("run").addEventListener("click", runShaders);
$("shader").addEventListener("keydown", event => {
  if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey) || $("run").disabled) return;
  event.preventDefault();
  runShaders();
});
$("reset").addEventListener("click", async () => {
  edits.delete(formula());
  await show();
});
$("open-shader").addEventListener("click", () => $("shader-file").click());
$("shader-file").addEventListener("change", async event => {
  const files = [...event.target.files];
  event.target.value = "";
  if (files.length === 0) return;
  editor.value = textOf(await Promise.all(files.map(async file => ({name: file.name, text: await file.text()}))));
  edits.set(formula(), editor.value);
  showLink();
});
for (const [button, input] of [["choose-folder", "folder-input"], ["choose-archive", "archive-input"]]) {
  $(button).addEventListener("click", () => $(input).click());
  $(input).addEventListener("change", () => take(chosenFolders($(input).files)).then(() => { $(input).value = ""; }));
}
$("judge-folder").addEventListener("click", judgeFolder);
$("cancel").addEventListener("click", () => {
  running?.abort();
  engine.cancel();
});
// The whole page accepts folders, because a folder dropped beside the box would otherwise replace the page.
addEventListener("dragover", event => {
  event.preventDefault();
  $("drop").classList.add("over");
});
addEventListener("dragleave", event => event.relatedTarget === null && $("drop").classList.remove("over"));
addEventListener("drop", event => {
  event.preventDefault();
  $("drop").classList.remove("over");
  take(droppedFolders(event.dataTransfer));
});
$("copy-link").addEventListener("click", async () => {
  await showLink();
  try {
    await navigator.clipboard.writeText(location.href);
    $("link-state").textContent = "Copied.";
  } catch {
    $("link-state").textContent = "It stands in the address bar.";
  }
});
addEventListener("hashchange", followLink);

if (!navigator.gpu) {
  $("no-gpu").textContent = "This browser has no WebGPU, so nothing can run here. A folder is judged all the same.";
  $("no-gpu").hidden = false;
  $("run").disabled = true;
}
try {
  packs = await packList();
  fill($("profile"), profileNames.map(name => [name, name]), "webgpu");
  await followLink();
  document.documentElement.dataset.ready = "";
} catch (error) {
  outcome.fail(error.message);
}

// The judge page: the choice, its link, and the page's controls.
import {boundBuffers, isRecords} from "./ports/pack.js";
import {chosenFolders, droppedFolders, jsonOf} from "./files.js";
import {Editor} from "./editor.js";
import {Edits} from "./judge_edits.js";
import {kindOf, packOf, portOf} from "./judge_folders.js";
import {Runs} from "./judge_runs.js";
import {checkView, hashOf, mostLinkBytes, viewOf} from "./link.js";
import {exampleOf, hasProgram, packFolder, packList} from "./packs.js";
import {element} from "./report_words.js";
import {textOf} from "./shader_text.js";
import {Outcome} from "./outcome.js";

const $ = id => document.getElementById(id);
const everyPass = "*";  // the choice of all passes
const byApi = "";       // the choice of no profile: that of the API
const profileNames = ["webgpu", "vulkan", "d3d", "metal", "cuda", "opengl", "gles", "webgl", "opencl", "ieee"];
const outcome = new Outcome($("verdict"), $("outcome"), $("report"));
const runs = new Runs(outcome, showButtons);

let packs = [];           // as packs/index.json, with `id`; `folder` and `own` are there where it is one of the visitor's own
let port = null;          // the folder that was dropped, by portOf
let portNote = "";        // what the page did when it came
let portShaders = null;   // the one of its SPIR-V: {name, files}
const edits = new Edits();
const editor = new Editor($("shader"), $("gutter"), $("shader-errors"), () => {
  edits.set(formula(), editor.value);
  showLink();
});

// ---- the choice ----

/// What the page is about: {pack, pass, passes}: pass null for all; passes for their <select>. It changes at once, with all that shows it, when
/// what it needs was loaded; the selects may be ahead of it.
let chosen = null;
const formula = () => chosen.pass?.formula;
const distinct = values => [...new Set(values)];
const variantsOf = effect => distinct(packs.filter(p => p.effect === effect).map(p => p.variant)).sort().reverse();

/// Fills a <select> with [value, text, isDisabled]s.
function fill(select, options, value) {
  select.replaceChildren(...options.map(([name, text, isDisabled = false]) => Object.assign(new Option(text, name), {disabled: isDisabled})));
  select.value = value;
  select.disabled = options.length < 2;
}
/// Fills the selects from left to right.
function showChoice({pack, pass, passes}) {
  const fitting = packs.filter(p => p.effect === pack.effect && p.variant === pack.variant);
  fill($("effect"), distinct(packs.map(p => p.effect)).map(name => [name, name]), pack.effect);
  fill($("variant"), variantsOf(pack.effect).map(name => [name, name.replace("-", " ")]), pack.variant);
  fill($("pack"), fitting.map(p => [p.id, p.folder ? `${p.name} (yours)` : p.name]), pack.id);
  fill($("pass"), [...passes, [everyPass, "all passes"]], pass?.name ?? everyPass);
}

/// The pack that is wanted, {effect, variant, pack}, and for the rest what the selects say, as far as it is there.
function packOfChoice(wanted) {
  const named = packs.find(p => p.id === wanted.pack), value = key => wanted[key] ?? $(key).value, pick = (values, name) => values.includes(name) ? name : values[0];
  if (named) return named;
  const effect = pick(packs.map(p => p.effect), value("effect")), variant = pick(variantsOf(effect), value("variant"));
  const fitting = packs.filter(p => p.effect === effect && p.variant === variant);
  return fitting.find(p => p.id === value("pack")) ?? fitting[0];
}
let choices = 0;
/// Chooses what is wanted: also {pass, profile}.
async function choose(wanted = {}) {
  const turn = ++choices, pack = packOfChoice(wanted), passWanted = wanted.pass ?? $("pass").value;
  try {
    const passes = await Promise.all(pack.passes.map(async p => {
      const isData = p.cases === 0 || !await hasProgram(pack.effect, p.formula);
      return [p.name, isData ? `${p.name} (made by the host)` : p.name, isData];
    }));
    const runnable = passes.filter(([, , isData]) => !isData).map(([name]) => name);
    const name = [...runnable, everyPass].includes(passWanted) ? passWanted : runnable[0] ?? everyPass;
    const pass = pack.passes.find(p => p.name === name) ?? null, example = pass && textOf(await exampleOf(pack.effect, pass.formula));
    if (turn !== choices) return;  // another choice came meanwhile
    chosen = {pack, pass, passes};
    if (pass) editor.value = edits.get(pass.formula) ?? example;
    if ("profile" in wanted) $("profile").value = wanted.profile;
  } finally {
    if (chosen && turn === choices) showChoice(chosen);
  }
  show();
}
const chooseHere = wanted => choose(wanted).catch(error => outcome.fail(error.message));

function show() {
  const {pack, pass} = chosen;
  $("one-pass").hidden = $("open-shader").hidden = $("reset").hidden = !pass;
  $("all-passes").hidden = Boolean(pass);
  $("run").textContent = pass ? "Run on this GPU" : "Run all passes on this GPU";
  const cases = pass ? pass.cases : pack.passes.reduce((sum, p) => sum + p.cases, 0);
  $("sentence").textContent = `${pass ? pass.sentence : `Pack of ${pack.scene}.`} ${cases} case${cases === 1 ? "" : "s"}.`;
  $("link-state").textContent = "";
  showButtons();
  showPort();
  document.documentElement.dataset.shown = `${pack.id} ${pass?.name ?? everyPass}`;  // for who drives the page
  if ($("bindings").open) showBindings().catch(error => outcome.fail(error.message));
  showLink();
}

/// The bindings of the chosen pass, from the pack's manifest, which is loaded for this.
async function showBindings() {
  const {pack, pass} = chosen;
  if (!pass) return;
  const manifest = await jsonOf(pack.folder ?? await packFolder(pack), "manifest.json"), oneCase = manifest.cases.find(c => c.pass === pass.name);
  const rows = [[0, manifest.passes.find(p => p.name === pass.name).uniform_block.name, "uniform block"]];
  for (const {name, binding, isOutput, buffer} of boundBuffers(manifest, oneCase)) {
    const what = !buffer ? "not in this case" : isRecords(buffer) ? `records ${buffer.record}` : `${buffer.format} ${buffer.width}x${buffer.height}`;
    rows.push([binding, name, `${isOutput ? "output" : "input"}, ${what}${!isOutput && buffer && buffer.min_filter && buffer.min_filter !== "none" ? `, sampler at ${binding + 16}` : ""}`]);
  }
  if (chosen.pass === pass) $("bindings").querySelector("tbody").replaceChildren(...rows.map(cells => element("tr", {}, cells.map(text => element("td", {}, String(text))))));
}

// ---- links ----

/// What a link holds: the choice, and the edited texts of the passes that it shows. `own` says that the pack is the visitor's.
function view() {
  const {pack: {effect, variant, name, own, passes}, pass} = chosen;
  return {effect, variant, pack: name, own: own === undefined ? "" : own || "unknown", pass: pass?.name ?? everyPass, profile: $("profile").value,
          shader: pass && edits.get(pass.formula), shaders: pass ? null : edits.of(passes)};
}
/// What the link does not hold, as sentences.
function linkNotes({pack: name, own, shader, shaders}) {
  const notes = own ? [`Who opens it must drop the pack ${name} there first.`] : [];
  if ((shader?.length ?? 0) > mostLinkBytes || JSON.stringify([...shaders ?? []]).length > mostLinkBytes) notes.push("The shader's text is too long: the link cannot be opened.");
  return notes;
}
let links = 0;
/// Puts the view into the address bar.
async function showLink() {
  const number = ++links, hash = await hashOf(view());
  if (number === links) history.replaceState(null, "", hash);
}
async function copyLink() {
  const shown = view(), address = new URL(await hashOf(shown), location.href).href;
  try {
    await navigator.clipboard.writeText(address);
    $("link-state").textContent = ["Copied.", ...linkNotes(shown)].join(" ");
  } catch {
    $("link-state").textContent = ["It stands in the address bar.", ...linkNotes(shown)].join(" ");
  }
}

async function followLink() {
  if (location.hash.length < 2) return choose({profile: byApi});
  try {
    const wanted = await viewOf(location.hash);
    const named = packs.find(p => wanted.own ? p.own === wanted.own : !p.folder && p.name === wanted.pack);
    checkView(wanted, named, packs, profileNames);
    const view = {...wanted, pack: named?.id, profile: wanted.profile ?? byApi};
    // The link decides over texts that were edited here, of the passes that it shows.
    for (const {name, formula: of} of packOfChoice(view).passes) {
      if (wanted.pass === everyPass) edits.set(of, wanted.shaders.get(of));
      else if (name === wanted.pass) edits.set(of, wanted.shader);
    }
    await choose(view);
    if (wanted.pass && (chosen.pass?.name ?? everyPass) !== wanted.pass) throw new Error(`The link's pass ${wanted.pass} is made by the host: it cannot run here.`);
  } catch (error) {
    await chooseHere({profile: byApi});
    outcome.fail(error.message);
  }
}

// ---- judging ----

function showButtons() {
  $("run").disabled = runs.isRunning || !chosen || !navigator.gpu;
  $("judge-folder").disabled = runs.isRunning || !chosen || port === null;
  $("copy-link").disabled = !chosen;
}
/// The profile of a folder is its port's, unless the visitor chose one.
const folderProfile = () => $("profile").value || port.profile || "vulkan";

/// What a run uses is fixed at its click.
function runShaders() {
  editor.clearErrors();
  const {pack, pass} = chosen, texts = edits.of(pack.passes);
  runs.runShaders(pass ? [pass] : pack.passes, pass?.name ?? "all", {pack, edits: texts, profile: $("profile").value || "webgpu"}, async error => {
    const bad = pack.passes.find(p => p.name === error.pass);
    // The error stands beside the text that has it, if that is still what the page is about.
    const isShown = () => chosen.pack === pack && chosen.pass === bad && edits.get(bad.formula) === texts.get(bad.formula);
    if (chosen.pack === pack && !chosen.pass && !pass) await choose({pack: pack.id, pass: bad.name});
    if (!isShown()) return `${bad.name} did not run: ${error.message}`;
    editor.showError(error.message);
    return `${bad.name} did not run: see below its text`;
  });
}
function judgeFolder() {
  const {pack} = chosen, hint = `It was judged against the pack ${pack.name}, which is ${pack.variant}. If the port ran another pack or variant, choose that above.`;
  runs.judgeFolder(port, {pack, profile: folderProfile(), partial: $("partial").checked, spirv: portShaders}, hint);
}

/// Takes dropped or chosen folders, one after the other: packs, one of a port, and one of its shaders. Each is checked before it is taken over.
let taking = Promise.resolve();
function take(read) {
  const promise = read((name, count) => say(`Reading ${name} …${count ? ` ${count} files` : ""}`));
  taking = taking.then(async () => {
    try {
      for (const one of await promise) {
        const kind = kindOf(one);
        if (kind === "shaders") takeShaders(one);
        else if (kind === "pack") await takePack(await packOf(one));
        else await takePort(await portOf(one));
      }
    } catch (error) {
      if (runs.isRunning) return showPort(error.message);
      outcome.fail(error.message);
    }
    showPort();
  });
  return taking;
}
const say = text => { $("folder-state").textContent = text; };
function note(id, text) {
  $(id).textContent = text;
  $(id).hidden = false;
}
async function takePack(one) {
  packs = [...packs.filter(p => p.id !== one.id), one];
  await choose({pack: one.id});
  note("pack-state", `${one.name} is a pack of ${one.passes.reduce((sum, p) => sum + p.cases, 0)} cases: it is chosen above.`);
}
function takeShaders(one) {
  portShaders = one;
  note("shaders-state", `${one.name}: the port's shaders are asked too, and the line of a mistake is named.`);
}
async function takePort(one) {
  [port, portNote] = [one, ""];
  const other = packs.find(p => one.effects.has(p.effect));
  if (other && !one.effects.has(chosen.pack.effect)) {
    portNote = `it is of ${other.effect}: look whether the pack above is the one that it ran`;
    await choose({effect: other.effect});
  }
  showButtons();
}
/// The line of the port's folder, from what the page has now; `error`: what was refused instead.
function showPort(error = null) {
  if (!port) return say(error ?? "No folder yet.");
  const source = $("profile").value ? ", as chosen above" : port.profile ? ", as its port.json says" : "";
  say(`${port.name}: ${port.files.size} files; ${portNote ? `${portNote}; ` : ""}profile ${folderProfile()}${source}.${error ? ` Not taken: ${error}` : ""}`);
}

// ---- the page's controls ----

for (const id of ["effect", "variant", "pack", "pass"]) $(id).addEventListener("change", () => chooseHere());
$("profile").addEventListener("change", show);
$("bindings").addEventListener("toggle", () => $("bindings").open && showBindings().catch(error => outcome.fail(error.message)));
$("run").addEventListener("click", runShaders);
$("shader").addEventListener("keydown", event => {
  if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey) || $("run").disabled) return;
  event.preventDefault();
  runShaders();
});
$("reset").addEventListener("click", () => {
  edits.set(formula(), undefined);
  chooseHere();
});
$("open-shader").addEventListener("click", () => $("shader-file").click());
$("shader-file").addEventListener("change", async event => {
  const files = [...event.target.files];
  event.target.value = "";
  if (files.length === 0) return;
  const {pass} = chosen, text = textOf(await Promise.all(files.map(async file => ({name: file.name, text: await file.text()}))));
  edits.set(pass.formula, text);
  chooseHere();
});
for (const [button, input] of [["choose-folder", "folder-input"], ["choose-archive", "archive-input"]]) {
  $(button).addEventListener("click", () => $(input).click());
  $(input).addEventListener("change", () => take(progress => chosenFolders($(input).files, progress)).then(() => { $(input).value = ""; }));
}
$("judge-folder").addEventListener("click", judgeFolder);
$("cancel").addEventListener("click", () => runs.cancel());
// The whole page accepts folders, because a folder dropped beside the box would otherwise replace the page.
addEventListener("dragover", event => {
  event.preventDefault();
  $("drop").classList.add("over");
});
addEventListener("dragleave", event => event.relatedTarget === null && $("drop").classList.remove("over"));
addEventListener("drop", event => {
  event.preventDefault();
  $("drop").classList.remove("over");
  take(progress => droppedFolders(event.dataTransfer, progress));
});
$("copy-link").addEventListener("click", copyLink);
addEventListener("hashchange", followLink);

if (!navigator.gpu) {
  $("no-gpu").textContent = "This browser has no WebGPU, so nothing can run here. A folder is judged all the same.";
  $("no-gpu").hidden = false;
}
try {
  showButtons();
  packs = (await packList()).map(p => ({...p, id: p.name}));
  fill($("profile"), [[byApi, "of the API"], ...profileNames.map(name => [name, name])], byApi);
  await followLink();
  document.documentElement.dataset.ready = "";
} catch (error) {
  outcome.fail(error.message);
}

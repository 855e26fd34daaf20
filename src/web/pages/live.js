// The live page: a scene that the reference simulates, its controls, and the lines that the native program prints for the same frame.
// live.html?scene=puddle/default.toml&size=640x360&set=rain.rate=20 opens that scene, with values of keys. A preset is such values.
import {FilmRow} from "./live_film.js";
import {LiveRun} from "./live_run.js";
import {SceneList, sceneOfFiles} from "./live_scenes.js";
import {Parameters} from "./parameters.js";
import {shownGallery} from "./live_gallery.js";
import {element} from "./report_words.js";
import {tomlOf} from "./scene_values.js";

const part = id => document.getElementById(id);
const option = (text, value = text) => element("option", {value}, text);
const kinds = ["weather", "light"];  // of presets
const fileSizes = ["1280x720", "960x540", "640x360", "480x270", "320x180", "160x90"];

const run = new LiveRun(), scenes = new SceneList(), parameters = new Parameters(part("parameters"), changeParameter);
let playing = false, shownTimes = [], stopped = Promise.resolve();
let comparison = null;  // promise of it, where ports run beside the scene
let begun = 0;          // how often a scene began, or began again

function showError(id, error) {
  part(id).textContent = error?.message ?? "";
  part(id).hidden = !error;
}
function setBusy(text) {
  part("busy").textContent = text;
  part("busy").hidden = text === "";
}
/// Shows a message only for noticeable delays, so that a fast frame does not flicker.
async function whileBusy(text, work, delay = 250) {
  const timer = setTimeout(() => setBusy(text), delay);
  try {
    return await work();
  } finally {
    clearTimeout(timer);
    setBusy("");
  }
}

// ---- frames ----

function showPicture({width, height, picture}) {
  const canvas = part("picture");
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
  canvas.getContext("2d").putImageData(new ImageData(picture, width, height), 0, 0);
}
function showFrame(shown) {
  showPicture(shown);
  const [width, height] = run.pictureSize;
  const perSecond = Math.min(1000 / shown.milliseconds, framesPerSecond());
  const rate = playing && shownTimes.length > 2 ? `, ${perSecond.toFixed(perSecond < 10 ? 1 : 0)} frames a second` : "";
  part("state").textContent = `frame ${run.frame}, ${width} x ${height}, ${shown.milliseconds.toFixed(0)} ms${rate}`;
  const hasLines = shown.lines !== undefined;
  part("no-hashes").hidden = hasLines;
  part("hashes").hidden = !hasLines;
  part("no-hashes").textContent = hasLines ? "" : "This frame's buffers went to the port and were not hashed. The next step has its lines again.";
  const rows = (shown.lines ?? []).map(line => element("tr", {}, line.split(" ").slice(1).map(text => element("td", {}, text))));
  part("hashes").tBodies[0].replaceChildren(...rows);
  showCommand();
}
/// The preset of each kind, as the keys say now.
function showPresets() {
  for (const kind of kinds) scenes.presets.show(part(kind), kind, opened(), run.info.variant);
}
const opened = () => ({effect: run.info.effect, sets: run.sets});
function showCommand() {
  part("command").textContent = run.command();
  part("changed").hidden = !run.changedLate;
}
/// For the last frames shown.
function framesPerSecond() {
  const span = shownTimes[shownTimes.length - 1] - shownTimes[0];
  return span > 0 ? 1000 * (shownTimes.length - 1) / span : Infinity;
}

/// The next frame; null if it failed, after showing the error.
async function computed() {
  try {
    return await whileBusy("Computing a frame…", () => run.step());
  } catch (error) {
    if (error.name !== "Cancelled") showError("run-error", error);
    return null;
  }
}
function showNext(shown) {
  shownTimes = [...shownTimes.slice(-19), performance.now()];
  showFrame(shown);
}
async function step() {
  showError("run-error", null);
  const shown = await computed();
  if (shown) showNext(shown);
  return shown !== null;
}
/// The worker makes the next frame while this one is drawn, unless that would exceed the scene's frame rate.
async function play() {
  showError("run-error", null);
  shownTimes = [];
  const period = 1000 / Number(run.values.get("run.fps") ?? 60);
  let due = performance.now(), coming = computed();
  for (let shown; coming && (shown = await coming);) {
    due = Math.max(due + period, performance.now());
    const left = document.hidden ? 500 : due - performance.now();
    coming = playing && left < 1 ? computed() : null;
    showNext(shown);
    if (coming || !playing) continue;
    await new Promise(done => setTimeout(done, left));
    if (playing) coming = computed();
  }
  setPlaying(false);
}
function setPlaying(now) {
  if (now === playing) return;
  playing = now;
  part("play").textContent = now ? "Pause" : "Play";
  part("step").disabled = now;
  if (now) stopped = play();
}

// ---- scenes ----

/// Opens a scene and shows frame 0, replacing the running one; false if it is refused, after showing the error, or another was opened.
async function open(scene, options) {
  const mine = ++begun;
  setPlaying(false);
  showError("scene-error", null);
  const effect = run.info?.effect, variant = run.info?.variant, isFirst = run.info === null;
  try {
    const whole = await scenes.withPresets(scene, options?.sets ?? new Map());
    if (mine !== begun) return false;
    await whileBusy("Opening the scene…", () => run.open(whole, options), 100);
  } catch (error) {
    showError("scene-error", error);
    if (run.frame < 0 && run.info) await step();  // the scene that stays showed no frame yet
    return false;
  }
  await stopped;
  part("state").textContent = "";
  const {description} = run;
  if (isFirst || effect !== run.info.effect || variant !== run.info.variant) {
    part("variant").replaceChildren(...description.variants.map(name => option(name)));
    const passes = description.passes.filter(pass => pass.variants.includes(run.info.variant) && pass.judge !== "input_only");
    part("pass").replaceChildren(...passes.map(pass => option(pass.name)));
    part("pass").value = passes[passes.length - 1].name;
    parameters.build(description, run.values, run.info.variant);
    parameters.find(part("find").value);
  }
  parameters.update(run.values);
  part("variant").value = run.info.variant;
  part("size").value = run.size;
  part("text").value = scene.text;
  const known = scenes.entry(scene.path);
  part("scene").value = known?.path ?? "";
  const said = kinds.map(kind => scenes.presets.chosen(kind, opened())?.sentence).filter(Boolean);
  part("about").textContent = [known?.sentence ?? `${scene.file}: a scene of yours.`, ...said.map(text => `${text}.`)].join(" ");
  showPresets();
  part("warnings").replaceChildren(...run.info.warnings.map(text => element("li", {}, text)));
  part("warnings").hidden = run.info.warnings.length === 0;
  for (const id of ["scene", "variant", "save", "play", "step", "reset"]) part(id).disabled = false;
  (await comparison)?.ready();
  const address = new URL(location), sets = [...run.sets].map(([key, toml]) => ["set", `${key}=${toml}`]);
  address.search = known ? new URLSearchParams([["scene", known.path], ...(run.size === "automatic" ? [] : [["size", run.size]]), ...sets]) : "";
  history.replaceState(null, "", address);
  if (mine === begun) await step();
  return true;
}
/// Opens a listed scene, by its path.
async function openListed(path, options) {
  try {
    return await open(await scenes.read(path), options);
  } catch (error) {
    showError("scene-error", error);
    return false;
  }
}
async function openFiles(list) {
  try {
    await open(await sceneOfFiles([...list]));
  } catch (error) {
    showError("scene-error", error);
  }
}
async function changeVariant(variant) {
  const {scene} = run, {effect} = run.info, sets = new Map([...run.sets, ["variant", JSON.stringify(variant)]]);
  if (await open(scene, {sets})) return;
  // Most scenes have keys that only one variant has.
  const path = `${effect}/${variant === "corrected" ? "default" : "as_published"}.toml`;
  if (await openListed(path)) part("about").textContent = `${scene.file} says keys that ${variant} does not have, so this is ${path}: ${part("about").textContent}`;
  else part("variant").value = run.info.variant;
}

// ---- parameters ----

const waiting = new Map();  // key to the newest value, while an older one is on its way
/// The next frame shows it, also of a scene that does not play.
async function changeParameter(key, toml) {
  if (waiting.has(key)) {
    waiting.set(key, toml);
    return;
  }
  waiting.set(key, toml);
  const scene = begun;
  try {
    for (let value = null; value !== waiting.get(key);) {
      value = waiting.get(key);
      await run.set(key, value);
      showCommand();
      showPresets();
      if (value === waiting.get(key)) parameters.update(run.values);
      if (!playing && scene === begun) await step();
    }
  } catch (error) {
    const value = waiting.get(key);
    error.restart = async () => {
      ++begun;
      setPlaying(false);
      part("state").textContent = "";
      await run.restartWith(key, value);
      parameters.update(run.values);
      showPresets();
      await step();
    };
    throw error;
  } finally {
    waiting.delete(key);
  }
}

// ---- the page ----

async function newComparison() {
  const {Comparison} = await import("./live_compare.js");
  return new Comparison(run, {
    before: () => setPlaying(false),
    shown: shown => {
      shownTimes = [];
      showFrame(shown);
    },
  });
}

async function reset() {
  const mine = ++begun;
  setPlaying(false);
  showError("run-error", null);
  part("state").textContent = "";
  try {
    await whileBusy("Starting again…", () => run.reset(), 100);
  } catch (error) {
    return showError("run-error", error);
  }
  await stopped;
  if (mine === begun) await step();
}
part("play").onclick = () => setPlaying(!playing);
part("step").onclick = () => step();
part("reset").onclick = () => reset();
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, select, textarea, summary, [contenteditable]")) return;
  const button = {" ": "play", ".": "step", r: "reset", R: "reset"}[event.key];
  if (!button || (event.key === " " && event.target.closest("button, a"))) return;
  event.preventDefault();
  if (!part(button).disabled) part(button).click();
});
part("scene").onchange = () => {
  const {effect, variant} = scenes.entry(part("scene").value);
  openListed(part("scene").value, {sets: variant === "corrected" ? scenes.presets.carried(opened(), effect) : new Map()});
};
for (const kind of kinds) part(kind).onchange = () => open(run.scene, {sets: scenes.presets.replaced(kind, part(kind).value, opened())});
part("variant").onchange = () => changeVariant(part("variant").value);
part("size").onchange = () => open(run.scene, {sets: run.sets, size: part("size").value});
part("choose").onclick = () => part("files").click();
part("files").onchange = () => openFiles(part("files").files).then(() => { part("files").value = ""; });
part("open-text").onclick = () => open({...run.scene, path: null, text: part("text").value});
part("find").oninput = () => parameters.find(part("find").value);
part("save").onclick = () => {
  const address = URL.createObjectURL(new Blob([tomlOf(run.values, run.description)], {type: "application/toml"}));
  element("a", {href: address, download: `${run.info.effect}.toml`}).click();
  URL.revokeObjectURL(address);
};
part("copy").onclick = async () => {
  try {
    await navigator.clipboard.writeText(part("command").textContent);
    part("copied").textContent = "copied";
  } catch {
    getSelection().selectAllChildren(part("command"));
    part("copied").textContent = "selected: this browser leaves copying to you";
  }
};
addEventListener("dragover", event => event.preventDefault());
addEventListener("drop", event => {
  event.preventDefault();
  if (event.dataTransfer.files.length > 0) openFiles(event.dataTransfer.files);
});

/// What this page's engine offers beside running scenes: ports on this device's GPU, films, pictures of any kind, and the site around this page.
function showOffers() {
  const offers = what => run.offers.includes(what);
  if (run.where) part("where").textContent = run.where;
  if (offers("film")) new FilmRow(run, {before: () => setPlaying(false)});
  if (offers("ports")) comparison = newComparison();
  part("ports").hidden = !offers("ports");
  part("pages").hidden = !offers("site");
  part("read-files").hidden = offers("pictures");
}
async function start() {
  part("size").append(option("automatic"), ...fileSizes.map(size => option(size.replace("x", " x "), size)), option("as the scene says", "scene"));
  const wanted = new URLSearchParams(location.search);
  try {
    await Promise.all([scenes.load(), run.start()]);
    showOffers();
  } catch (error) {
    setBusy("");
    return showError("run-error", error);
  }
  scenes.show(part("scene"));
  const size = wanted.get("size") ?? "automatic", sets = new Map(wanted.getAll("set").map(text => [text.slice(0, text.indexOf("=")), text.slice(text.indexOf("=") + 1)]));
  if (![...part("size").options].some(o => o.value === size)) part("size").append(option(size));
  part("scene").disabled = false;
  await openListed(wanted.get("scene") ?? "puddle/default.toml", {size, sets});
  // Its pictures load after the frame that the visitor waits for.
  part("gallery-section").hidden = !scenes.all.some(({picture}) => picture);
  shownGallery(part("gallery"), scenes.all, path => {
    openListed(path);
    part("scene-title").scrollIntoView();
  });
}
start();

// The live page: a scene that the reference simulates, its controls, and the lines that the native program prints for the same frame.
// live.html?scene=puddle/default.toml&size=640x360&set=rain.rate=20&frame=100 opens that scene, with values of keys, and simulates up to that frame.
import {Busy} from "./live_busy.js";
import {FilmRow} from "./live_film.js";
import {shownGallery} from "./live_gallery.js";
import {copied, edited, Lines, saveAs} from "./live_lines.js";
import {addressOf, wantedBy} from "./live_link.js";
import {LiveRun} from "./live_run.js";
import {SceneList, sceneOfFiles} from "./live_scenes.js";
import {FullScreen} from "./live_screen.js";
import {Player, showError, workOf} from "./live_player.js";
import {Parameters} from "./parameters.js";
import {element} from "./report_words.js";
import {tomlOf} from "./scene_values.js";

const part = id => document.getElementById(id);
const option = (text, value = text) => element("option", {value}, text);
const kinds = ["weather", "light"];  // of presets
const fileSizes = ["1280x720", "960x540", "640x360", "480x270", "320x180", "160x90"];

const run = new LiveRun(), scenes = new SceneList(), busy = new Busy(), lines = new Lines(run), parameters = new Parameters(part("parameters"), changeParameter);
const player = new Player(run, busy, lines);
let comparison = null;  // promise of it, where ports run beside the scene
let film = null;
let tried = null;       // the scene that was to be opened last
const leave = () => run.cancel();

// ---- scenes ----

/// The preset of each kind, as the keys say now.
function showPresets() {
  for (const kind of kinds) scenes.presets.show(part(kind), kind, opened(), run.info.variant);
}
const opened = () => ({effect: run.info.effect, sets: run.sets});
/// The scene as it runs: its controls say what holds, also after another was refused.
function showOpened() {
  const {scene} = run, known = scenes.entry(scene.path);
  part("variant").value = run.info.variant;
  part("size").value = run.size;
  part("scene").value = known?.path ?? "";
  showPresets();
}
/// The page's address leads to the scene with its keys.
function showAddress() {
  history.replaceState(null, "", addressOf({scene: scenes.entry(run.scene.path)?.path ?? null, size: run.size, sets: run.sets}));
}

/// Opens a scene and shows frame 0, replacing the running one; false if it is refused, after showing the error, or another was opened.
async function open(scene, options) {
  const mine = player.begin();
  film?.abort();
  showError("scene-error", null);
  tried = scene;
  const effect = run.info?.effect, variant = run.info?.variant, isFirst = run.info === null, sets = options?.sets ?? new Map();
  // Of another scene, its picture is shown until its first frame.
  if (scene.path !== run.scene?.path || isFirst) busy.standIn(scenes.entry(scene.path)?.picture ?? null);
  try {
    const whole = await scenes.withPresets(scene, sets);
    if (mine !== player.begun) return false;
    await busy.during("Opening the scene…", () => run.open(whole, options), {cancel: leave, delay: 100, as: workOf("open", scene, sets, options?.size ?? run.size)});
  } catch (error) {
    if (mine !== player.begun) return false;
    if (run.info !== null) {
      busy.showFrames();
      showOpened();
    }
    if (error.name === "Cancelled") {
      if (run.info === null) part("state").textContent = "Cancelled. Choose a scene.";
      player.showLeft();
    } else {
      showError("scene-error", error);
      if (run.frame < 0 && run.info) await player.step();  // the scene that stays showed no frame yet
    }
    return false;
  }
  await player.stopped;
  if (mine !== player.begun) return false;
  part("state").textContent = "";
  const {description} = run;
  if (isFirst || effect !== run.info.effect || variant !== run.info.variant) {
    part("variant").replaceChildren(...description.variants.map(name => option(name)));
    const passes = description.passes.filter(pass => pass.variants.includes(run.info.variant) && pass.judge !== "input_only");
    part("pass").replaceChildren(...passes.map(pass => option(pass.name)));
    part("pass").value = passes[passes.length - 1].name;
    parameters.build(description, run.values, run.info.variant);
    parameters.find(part("find").value);
    part("slow-note").hidden = !parameters.hasSlow;
  }
  parameters.update(run.values);
  part("text").value = scene.text;
  showOpened();
  const known = scenes.entry(scene.path), said = kinds.map(kind => scenes.presets.chosen(kind, opened())?.sentence).filter(Boolean);
  part("about").textContent = [known?.sentence ?? `${scene.file}: a scene of yours.`, ...said.map(text => `${text}.`)].join(" ");
  part("warnings").replaceChildren(...run.info.warnings.map(text => element("li", {}, text)));
  part("warnings").hidden = run.info.warnings.length === 0;
  for (const id of ["scene", "variant", "save", "play", "step", "reset", "copy-link"]) part(id).disabled = false;
  part("link-state").textContent = "";
  (await comparison)?.ready();
  showAddress();
  if (mine === player.begun) await player.step();
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
  if (await open(scene, {sets}) || part("scene-error").hidden) return;
  // Most scenes have keys that only one variant has.
  const path = `${effect}/${variant === "corrected" ? "default" : "as_published"}.toml`;
  if (await openListed(path)) part("about").textContent = `${scene.file} says keys that ${variant} does not have, so this is ${path}: ${part("about").textContent}`;
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
  film?.abort();
  const scene = player.begun;
  try {
    for (let value = null; value !== waiting.get(key);) {
      value = waiting.get(key);
      await busy.during("Setting the key…", () => run.set(key, value), {cancel: leave});
      lines.showCommand();
      showPresets();
      if (value === waiting.get(key)) parameters.update(run.values);
      if (!player.playing && scene === player.begun) await player.step();
    }
    showAddress();
  } catch (error) {
    if (error.name === "Cancelled") {
      parameters.update(run.values);
      return player.showLeft();
    }
    const value = waiting.get(key);
    error.restart = async () => {
      player.begin();
      film?.abort();
      part("state").textContent = "";
      await run.restartWith(key, value);
      parameters.update(run.values);
      showPresets();
      showAddress();
      await player.step();
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
    before: () => {
      player.setPlaying(false);
      film?.abort();
    },
    shown: shown => player.showSingle(shown),
  });
}

async function reset() {
  const mine = player.begin();
  film?.abort();
  part("state").textContent = "";
  try {
    await busy.during("Starting again…", () => run.reset(), {cancel: leave, delay: 100});
  } catch (error) {
    if (mine !== player.begun) return;
    return error.name === "Cancelled" ? player.showLeft() : showError("run-error", error);
  }
  await player.stopped;
  if (mine === player.begun) await player.step();
}
async function copyLink() {
  const known = scenes.entry(run.scene.path);
  if (!known) return void (part("link-state").textContent = "A link cannot hold a scene of yours: save it as TOML.");
  const address = addressOf({scene: known.path, size: run.size, sets: run.sets, frame: run.frame}).href;
  const late = run.changedLate && run.frame > 0 ? " Parameters were changed while the scene ran; the link has them from the first frame on." : "";
  part("link-state").textContent = (await copied(address) ? `Copied: scene, keys, size and frame ${Math.max(0, run.frame)}.` : address) + late;
}
part("play").onclick = () => {
  film?.abort();
  player.setPlaying(!player.playing);
};
part("step").onclick = () => {
  film?.abort();
  player.step();
};
part("reset").onclick = () => reset();
part("larger").onclick = () => open(run.scene, {sets: run.sets});
part("copy-link").onclick = () => copyLink();
new FullScreen(part("full-screen"), part("stage"));
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, select, textarea, summary, [contenteditable]")) return;
  const button = {" ": "play", ".": "step", r: "reset", R: "reset", f: "full-screen", F: "full-screen"}[event.key];
  if (!button || (event.key === " " && event.target.closest("button, a"))) return;
  event.preventDefault();
  if (!part(button).disabled && !part(button).hidden) part(button).click();
});
part("more").onclick = () => {
  const isShown = part("more-choices").classList.toggle("shown");
  part("more").setAttribute("aria-expanded", String(isShown));
};
part("scene").onchange = () => {
  const {effect, variant} = scenes.entry(part("scene").value);
  openListed(part("scene").value, {sets: variant === "corrected" && run.info ? scenes.presets.carried(opened(), effect) : new Map()});
};
for (const kind of kinds) part(kind).onchange = () => open(run.scene, {sets: scenes.presets.replaced(kind, part(kind).value, opened())});
part("variant").onchange = () => changeVariant(part("variant").value);
// A scene that could not be opened with the size before is tried again.
part("size").onchange = () => { if (tried) open(run.scene ?? tried, {sets: run.scene ? run.sets : wanted.sets, size: part("size").value}); };
part("choose").onclick = () => part("files").click();
part("files").onchange = () => openFiles(part("files").files).then(() => { part("files").value = ""; });
part("open-text").onclick = () => open(part("text").value === run.scene.text ? run.scene : edited(run.scene, part("text").value));
part("find").oninput = () => parameters.find(part("find").value);
part("save").onclick = () => saveAs(tomlOf(run.values, run.description), "application/toml", `${run.info.effect}.toml`);
addEventListener("dragover", event => event.preventDefault());
addEventListener("drop", event => {
  event.preventDefault();
  if (event.dataTransfer.files.length > 0) openFiles(event.dataTransfer.files);
});

/// What this page's engine offers beside running scenes: ports on this device's GPU, films, pictures of any kind, and the site around this page.
function showOffers() {
  const offers = what => run.offers.includes(what);
  if (run.where) part("where").textContent = run.where;
  film = new FilmRow(run, {before: () => player.begin(), shown: shown => player.showNext(shown)});
  if (offers("ports")) comparison = newComparison();
  part("ports").hidden = !offers("ports");
  // The address of `rainref view` is its user's secret: no link to pass on.
  part("pages").hidden = part("copy-link").hidden = !offers("site");
  part("read-files").hidden = offers("pictures");
}
const wanted = wantedBy(location.search);
async function start() {
  part("size").append(option("automatic"), ...fileSizes.map(size => option(size.replace("x", " x "), size)), option("as the scene says", "scene"));
  try {
    await busy.during("Loading the library…", async () => {
      const loading = run.start();
      loading.catch(() => {});
      await scenes.load();
      busy.standIn(scenes.entry(wanted.scene)?.picture ?? null);
      await loading;
    }, {cancel: leave, delay: 0, as: "library"});
    showOffers();
  } catch (error) {
    return showError("run-error", error.name === "Cancelled" ? new Error("Cancelled. Load the page again to start.") : error);
  }
  scenes.show(part("scene"));
  if (![...part("size").options].some(o => o.value === wanted.size)) part("size").append(option(wanted.size));
  part("size").value = wanted.size;
  part("scene").value = scenes.entry(wanted.scene)?.path ?? "";
  part("scene").disabled = false;
  if (await openListed(wanted.scene, wanted)) {
    if (wanted.error) showError("scene-error", wanted.error);
    else if (wanted.frame > 0) await player.runTo(wanted.frame);
  }
  // Its pictures load after the frame that the visitor waits for.
  part("gallery-section").hidden = !scenes.all.some(({picture}) => picture);
  shownGallery(part("gallery"), scenes.all, path => {
    openListed(path);
    part("stage").scrollIntoView();
  });
}
start();

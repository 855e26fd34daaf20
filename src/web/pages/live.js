// The live page: a scene in the worker, its picture, hashes and parameters.
import {Cancelled, Engine} from "./engine.js";
import {brightness, difference, draw, passesOf, runPort, spread} from "./live_compare.js";
import {showGallery} from "./live_gallery.js";
import {showParameters} from "./live_parameters.js";
import {sceneText, tomlValue} from "./live_toml.js";

const at = id => document.getElementById(id);
const engine = new Engine("live_operations.js");
const sizes = [[320, 180], [480, 270], [640, 360], [960, 540], [1280, 720]];
const slowest = 250;  // [ms] of a frame, above which the picture that the page chose becomes smaller

let effects = {};
let scenes = [];
// What is open: the scene's text and name, keys with the values that win over it, and what the library says of it.
let open = null;
let playing = false;
let busy = Promise.resolve();

/// One call of the worker after the other; what is asked for twice is done twice.
function inTurn(action) {
  const done = busy.then(action);
  busy = done.catch(() => {});
  return done;
}
function tell(text) { at("status").textContent = text; }
function complain(error) {
  if (error instanceof Cancelled) return;
  at("problem").textContent = error.message;
  at("problem").hidden = false;
  tell("");
  pause();
}

/// Opens a scene anew, at frame 0. `chosen`: [width, height], or null for what this machine affords.
async function start({toml, file, named = [], overrides = new Map()}, chosen) {
  at("problem").hidden = true;
  tell("Opening. What lies around the rain is made once, which takes some seconds.");
  const size = chosen ?? sizes[2], files = {};
  for (const path of named) {
    const answer = await fetch(`scenes/${path}`);
    if (!answer.ok) throw new Error(`scenes/${path}: ${answer.status} ${answer.statusText}`);
    files[path] = new Uint8Array(await answer.arrayBuffer());
  }
  const set = [`run.size=[${size.join(", ")}]`, ...[...overrides].map(([key, value]) => `${key}=${value}`)];
  const info = await engine.run("open", {toml, file, files, set});
  open = {toml, file, named, overrides, chosen, size, info, began: open?.file === file && open?.toml === toml ? open.began : info.scene, changed: false};
  at("canvas").style.aspectRatio = size.join(" / ");
  parameters();
  await passes();
  await next();
  tell(info.warnings.join(" "));
  if (chosen) return;
  // What one frame costs, without what the first one makes.
  const {milliseconds} = await next();
  const affordable = sizes.filter(([w, h]) => milliseconds * w * h / (size[0] * size[1]) <= slowest).pop() ?? sizes[0];
  if (affordable[0] >= size[0]) return;
  await start({toml, file, named, overrides}, affordable);
  open.chosen = null;
  tell(`A smaller picture: one of ${size.join(" x ")} takes this machine ${(milliseconds / 1000).toFixed(1)} s a frame.`);
}

function parameters() {
  showParameters(at("parameters"), effects[open.info.effect].parameters, open.info.scene, open.began, {
    change: (key, value) => inTurn(async () => {
      open.info = await engine.run("set", {key, value});
      open.overrides.set(key, value);
      open.changed = true;
      tell("From the next frame on.");
    }),
    restart: (key, value) => again(new Map([...open.overrides, [key, value]])),
  });
}
async function passes() {
  const found = navigator.gpu ? await passesOf(open.info.effect, open.info.variant) : [];
  open.passes = found;
  at("pass").replaceChildren(...found.map(pass => new Option(pass.name)));
  // First what gives the radiance that is displayed.
  if (found.length > 0) at("pass").selectedIndex = Math.max(0, found.findLastIndex(pass => pass.usual && pass.writes.includes("colour")));
  at("run_pass").disabled = found.length === 0;
  at("trio").hidden = true;
  at("compared").textContent = navigator.gpu ? "" : "This browser has no WebGPU. All else on this page needs none.";
}
/// The same scene from frame 0, with other values; the old one stays where they are refused.
const again = overrides => inTurn(() => start({...open, overrides}, open.chosen ?? open.size)).catch(complain);

function show({frame, width, height, rgba, milliseconds, lines}) {
  const canvas = at("canvas");
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
  canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(rgba), width, height), 0, 0);
  at("clock").textContent = `frame ${frame}   ${milliseconds < 100 ? milliseconds.toFixed(1) : Math.round(milliseconds)} ms`;
  at("hash").textContent = lines.length > 0 ? lines[lines.length - 1].split(" ").pop() : "not taken while a pass is compared";
  at("lines").textContent = lines.join("\n");
  at("command").textContent = command(frame);
  Object.assign(document.body.dataset, {frame, hash: at("hash").textContent});
}
/// What prints the lines of this frame at a prompt, as its last ones.
function command(frame) {
  if (open.changed) return "A parameter was changed on the way: Reset begins with it, and then a command gives the same.";
  const quoted = text => /^[\w.=\/+-]+$/.test(text) ? text : `'${text}'`;
  const set = [...open.overrides].map(([key, value]) => ` --set ${quoted(`${key}=${value}`)}`).join("");
  return `rainref hash ${quoted(open.file)} --size ${open.size.join("x")} --frames ${frame + 1}${set}`;
}
async function next() {
  const done = await engine.run("frame");
  show(done);
  return done;
}

function pause() {
  playing = false;
  at("play").textContent = "Play";
}
async function play() {
  if (playing) return pause();
  playing = true;
  at("play").textContent = "Pause";
  tell("");
  const times = [];
  while (playing) {
    await new Promise(requestAnimationFrame);
    try {
      const {milliseconds} = await inTurn(next);
      times.push(milliseconds);
      if (times.length > 30) times.shift();
      at("clock").textContent += `   ${(1000 * times.length / times.reduce((a, b) => a + b)).toFixed(1)} frames/s`;
    } catch (error) {
      complain(error);
    }
  }
}
const step = () => { pause(); inTurn(next).catch(complain); };
const reset = () => { pause(); again(open.overrides); };

function choose(scene) {
  pause();
  at("scene").value = scene.file;
  inTurn(async () => {
    const answer = await fetch(`scenes/${scene.file}`);
    if (!answer.ok) throw new Error(`scenes/${scene.file}: ${answer.status} ${answer.statusText}`);
    await start({toml: await answer.text(), file: scene.file, named: scene.files}, chosenSize());
    history.replaceState(null, "", `#${scene.file}`);
  }).catch(complain);
}
const chosenSize = () => sizes[at("size").selectedIndex - 1] ?? null;

async function openFile(file) {
  pause();
  const toml = await file.text();
  inTurn(async () => {
    await start({toml, file: file.name}, chosenSize());
    at("scene").selectedIndex = -1;
    history.replaceState(null, "", location.pathname);
  }).catch(complain);
}
function save() {
  const text = sceneText(open.info.scene, effects[open.info.effect].parameters), link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], {type: "application/toml"}));
  link.download = open.file.split("/").pop();
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

async function compare() {
  pause();
  const pass = open.passes[at("pass").selectedIndex];
  at("run_pass").disabled = true;
  try {
    const done = await inTurn(() => engine.run("frameWithCase", {pass: pass.name}));
    show(done);
    if (!done.given) {
      at("compared").textContent = `${pass.name} does not run in this frame.`;
      at("trio").hidden = true;
      return;
    }
    const ran = await runPort(open.info.effect, pass, done.given);
    const chosen = at("output").value;
    at("output").replaceChildren(...ran.outputs.map(output => new Option(output.name)));
    if (ran.outputs.some(output => output.name === chosen)) at("output").value = chosen;
    open.ran = ran;
    showCompared();
  } catch (error) {
    at("compared").textContent = error.message;
    at("trio").hidden = true;
  } finally {
    at("run_pass").disabled = false;
  }
}
function showCompared() {
  const {ran} = open ?? {}, output = ran?.outputs[at("output").selectedIndex];
  at("trio").hidden = !output;
  if (!output) {
    if (ran) at("compared").textContent = "This pass gives lists alone: the judge page compares those.";
    return;
  }
  const {texels, differ, most} = difference(output), gain = at("gain").value, scale = output.format.type === "|u1" ? 1 : brightness(output.expected);
  at("compared").textContent = `${ran.device}, ${ran.milliseconds.toFixed(0)} ms with uploads: ${differ} of ${texels} texels differ, by ${most.toPrecision(3)} at most. ` +
      "Which differences a correct GPU may have, the judge page says.";
  // Radiance spans more than a screen shows: its root does not.
  const shade = output.format.type === "|u1" ? v => v : v => Math.sqrt(Math.abs(v));
  draw(at("expected"), output, output.expected, v => shade(v * scale));
  draw(at("given"), output, output.given, v => shade(v * scale));
  const distances = output.expected.map((v, i) => Math.abs(v - output.given[i]));
  if (gain === "any") draw(at("difference"), {...output, format: {channels: 1}}, spread(output, distances), v => v);
  else draw(at("difference"), output, distances, v => v * scale * Number(gain));
}

at("play").onclick = play;
at("step").onclick = step;
at("reset").onclick = reset;
at("save").onclick = save;
at("run_pass").onclick = compare;
at("output").onchange = at("gain").onchange = showCompared;
at("scene").onchange = () => choose(scenes.find(scene => scene.file === at("scene").value));
at("size").onchange = () => { pause(); inTurn(() => start({...open}, chosenSize())).catch(complain); };
at("file").onchange = ({target}) => { if (target.files[0]) openFile(target.files[0]); target.value = ""; };
at("choose").onsubmit = event => event.preventDefault();
document.addEventListener("dragover", event => event.preventDefault());
document.addEventListener("drop", event => {
  event.preventDefault();
  if (event.dataTransfer.files[0]) openFile(event.dataTransfer.files[0]);
});
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("input, select, textarea, button, summary, a")) return;
  const action = {" ": play, ".": step, r: reset}[event.key];
  if (!action || !open) return;
  event.preventDefault();
  action();
});

async function begin() {
  at("size").replaceChildren(new Option("what this machine affords"), ...sizes.map(size => new Option(size.join(" x "))));
  const answer = await fetch("scenes/index.json");
  if (!answer.ok) throw new Error(`scenes/index.json: ${answer.status} ${answer.statusText}`);
  ({scenes} = await answer.json());
  at("scene").replaceChildren(...scenes.map(({file, traced}) => new Option(traced ? `${file} (traced: slow here)` : file, file)));
  showGallery(at("gallery"), scenes, scene => { choose(scene); scrollTo({top: 0}); });
  effects = await engine.run("describe");
  const wanted = decodeURIComponent(location.hash.slice(1));
  choose(scenes.find(scene => scene.file === wanted) ?? scenes.find(scene => scene.file === "puddle/default.toml"));
}
begin().catch(complain);

// The scene that the live page runs, without the page: the opened scene, the keys set since, and a queue of operations.
import {Engine} from "./engine.js";
import {shellWord, valuesOf} from "./scene_values.js";

/// A slower frame is aborted if another scene is wanted [ms].
const patience = 700;
/// Picture sizes for "automatic", and the longest time for a frame [ms].
const sizes = [[960, 540], [640, 360], [320, 180]], longest = 125;

/// "automatic" picks what the machine can handle; it turns antialiasing off, which takes four times as long, unless the key was set.
const antialiases = (sets, size) => size !== "automatic" || sets.has("run.supersample");
/// A scene in the form of live_operations.js.
const asOpened = (scene, sets, size, pixels) => (
  {...scene, sets: [...[...sets].map(([name, toml]) => `${name}=${toml}`), ...(pixels ? [`run.size=[${pixels.join(", ")}]`] : []),
    ...(antialiases(sets, size) ? [] : ["run.supersample=1"])]});

/// The smaller library reads no pictures in files, whose formats would double it.
const namesPictures = ({files}) => files.some(({path}) => !/\.(csv|npy)$/i.test(path));

export class LiveRun {
  #engine = new Engine("live_operations.js", "rainref_simulator");
  #pixels = null;  // of the open scene's picture; null: its own
  #last = Promise.resolve();
  #stepBegan = null;
  #measured = new Map();  // scene and variant to the size that "automatic" chose
  #scene = null;
  #size = "automatic";

  /// From the library: the result of rr_describe for each effect, its version, its golden generation.
  effects = [];
  version = "";
  generation = 0;
  /// What the engine does beside running scenes: "film", "ports", "site"; and where it computes, if not in this page.
  offers = [];
  where = null;
  /// The keys set, with their text in TOML.
  sets = new Map();
  /// For the open scene: {effect, variant, frames, sceneJson, warnings}, and every key with its text.
  info = null;
  values = new Map();
  /// The last simulated frame; -1: none.
  frame = -1;
  /// Keys were set after the first frame: the native program sets them before it, so its lines differ.
  changedLate = false;

  get scene() { return this.#scene; }
  get size() { return this.#size; }
  get pictureSize() { return JSON.parse(this.values.get("run.size") ?? "[640, 360]"); }

  /// The result of rr_describe for the open scene's effect.
  get description() { return this.effects.find(({effect}) => effect === this.info.effect); }

  /// Loads the library and its effects' descriptions; call it first.
  start() {
    return this.#inTurn(async () => { Object.assign(this, await this.#engine.run("describe")); });
  }

  /// scene: {text, file, files}; sets: null: as they are when its turn comes; size: "automatic", "scene" (its own) or "640x360". The running
  /// scene stays if the new one is refused.
  async open(scene, {sets = new Map(), size = this.#size} = {}) {
    const former = {scene: this.#scene, sets: this.sets, size: this.#size}, lost = this.#giveUp();
    return this.#inTurn(async () => {
      try {
        await this.#open(scene, sets ?? new Map(this.sets), size);
      } catch (error) {
        if (lost && former.scene) await this.#open(former.scene, former.sets, former.size);
        throw error;
      }
    });
  }
  /// Frame 0 again, with the current keys.
  reset() { return this.open(this.#scene, {sets: null}); }
  /// The same with another value that a running scene does not accept.
  restartWith(key, toml) { return this.open(this.#scene, {sets: new Map([...this.sets, [key, toml]])}); }

  /// Sets a key to another value from the next frame on.
  set(key, toml) {
    return this.#inTurn(async () => {
      const info = await this.#engine.run("set", {key, value: toml});
      this.sets.set(key, toml);
      this.changedLate ||= this.frame >= 0;
      this.#took(info);
    });
  }

  /// The next frame: like step of live_operations.js; with `pass` like its stepWithCases.
  step(pass = null) {
    return this.#inTurn(async () => {
      this.#stepBegan = performance.now();
      try {
        if (pass !== null) await this.#takeJudge();
        const shown = pass === null ? await this.#engine.run("step") : await this.#engine.run("stepWithCases", {pass});
        ++this.frame;
        return shown;
      } finally {
        this.#stepBegan = null;
      }
    });
  }
  judge(profile, given) { return this.#inTurn(() => this.#engine.run("judge", {profile, given})); }

  /// The open scene's film: bytes. Only if it is offered. onProgress(done, of); `signal` aborts it.
  film(args, options) { return this.#inTurn(async () => (await this.#engine.run("film", args, options)).film); }

  /// The command that prints this frame's lines natively.
  command() { return this.commandOf("hash", this.frame + 1); }
  /// The native command of a verb for the open scene with its keys, and more words.
  commandOf(verb, frames, more = []) {
    const [width, height] = this.pictureSize, words = ["rainref", verb, this.#scene.file, "--frames", String(frames), ...more];
    if (this.#size !== "scene") words.push("--size", `${width}x${height}`);
    if (!antialiases(this.sets, this.#size)) words.push("--set", "run.supersample=1");
    for (const [key, toml] of this.sets) words.push("--set", `${key}=${toml}`);
    return words.map(shellWord).join(" ");
  }

  #inTurn(action) {
    const done = this.#last.then(action);
    this.#last = done.catch(() => {});
    return done;
  }
  /// Ends the worker if a frame blocks it; returns true if it did.
  #giveUp() {
    if (this.#stepBegan === null || performance.now() - this.#stepBegan < patience) return false;
    this.#engine.cancel();
    return true;
  }

  async #open(scene, sets, size) {
    const key = [scene.file, scene.text.length, sets.get("variant")].join("|");
    let chosen = size === "automatic" ? this.#measured.get(key) ?? sizes[1] : size === "scene" ? null : size.split("x").map(Number);
    const engine = this.#engine.library === "rainref_simulator" && namesPictures(scene) ? new Engine("live_operations.js") : this.#engine;
    const open = () => engine.run("open", asOpened(scene, sets, size, chosen));
    let info = await open();
    if (engine !== this.#engine) this.#engine.cancel();
    this.#engine = engine;
    if (size === "automatic" && !this.#measured.has(key)) {
      const best = await this.#sizeFor(chosen);
      this.#measured.set(key, best);
      chosen = best;
      info = await open();
    }
    Object.assign(this, {sets, frame: -1, changedLate: false});
    this.#scene = scene;
    this.#size = size;
    this.#pixels = chosen;
    this.#took(info);
  }
  /// The library with the judge continues from the state of the smaller one.
  async #takeJudge() {
    if (this.#engine.library === "rainref_module") return;
    const judging = new Engine("live_operations.js"), state = await this.#engine.run("save");
    await judging.run("open", asOpened(this.#scene, this.sets, this.#size, this.#pixels));
    await judging.run("load", {state}, {transfer: [state.buffer]});
    this.#engine.cancel();
    this.#engine = judging;
  }
  /// The size for this machine: times frames 1 and 2 of the open scene, because frame 0 makes things that later frames reuse.
  async #sizeFor([width, height]) {
    let shortest = Infinity;
    this.#stepBegan = performance.now();
    for (let frame = 0; frame < 3; ++frame) {
      const {milliseconds} = await this.#engine.run("step");
      if (frame > 0) shortest = Math.min(shortest, milliseconds);
      if (milliseconds > 20 * longest) break;  // a traced picture
    }
    this.#stepBegan = null;
    // A part of a frame's work does not depend on the picture's size; assuming that all of it does selects a smaller size.
    const fits = sizes.find(([w, h]) => shortest * w * h / (width * height) <= longest);
    return fits ?? sizes[sizes.length - 1];
  }
  #took(info) {
    this.info = info;
    this.values = valuesOf(info.sceneJson);
  }
}

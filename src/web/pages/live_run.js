// The scene that the live page runs, without the page: the opened scene, the keys set since, and a queue of operations.
import {Engine} from "./engine.js";
import {Speeds} from "./live_speed.js";
import {shellWord, valuesOf} from "./scene_values.js";

/// What takes longer is aborted if another scene is wanted [ms].
const patience = 700;

/// The text of a scene names its variant, which the native program wants.
const saysVariant = text => /^[ \t]*["']?variant["']?[ \t]*=/m.test(text.split(/^[ \t]*\[/m)[0]);
const effectOf = text => /^[ \t]*effect[ \t]*=[ \t]*["'](\w+)/m.exec(text)?.[1];
/// "automatic" picks what the machine can handle. It turns antialiasing off, which takes four times as long, and of a small picture it draws the
/// street before a windshield at twice its size only; unless scene or keys say so. key=value, ...
function economies({text}, sets, size, pixels) {
  if (size !== "automatic") return [];
  const [width, height] = pixels.map(length => 2 * length), saysStreet = sets.has("scene.size") || /^[ \t]*\[scene\][^[]*^[ \t]*size[ \t]*=/m.test(text);
  return [...(sets.has("run.supersample") ? [] : ["run.supersample=1"]),
          ...(effectOf(text) === "windshield" && !saysStreet && width < 1280 ? [`scene.size=[${width}, ${height}]`] : [])];
}
/// A scene in the form of live_operations.js.
const asOpened = (scene, sets, size, pixels) => (
  {...scene, sets: [...[...sets].map(([name, toml]) => `${name}=${toml}`), ...(pixels ? [`run.size=[${pixels.join(", ")}]`] : []),
    ...economies(scene, sets, size, pixels)]});

/// The smaller library reads no pictures in files, whose formats would double it.
const namesPictures = ({files}) => files.some(({path}) => !/\.(csv|npy)$/i.test(path));

export class LiveRun {
  #engine = new Engine("live_operations.js", "rainref_simulator");
  #coming = null;  // the larger engine, while it opens its scene
  #pixels = null;  // of the open scene's picture; null: its own
  #last = Promise.resolve();
  #began = null;    // when the operation began that runs now, if it computes
  #openIn = -1;     // engine.ended when the scene was opened
  #speeds = new Speeds();
  #scene = null;
  #frame = -1;
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
  /// Keys were set after the first frame: the native program sets them before it, so its lines differ.
  changedLate = false;

  get scene() { return this.#scene; }
  /// The last simulated frame; -1: none. What ends the engine (cancel, a defect) takes the scene; its next operation opens it again.
  get frame() { return this.#isOpen ? this.#frame : -1; }
  get #isOpen() { return this.#scene !== null && this.#openIn === this.#engine.ended; }
  get size() { return this.#size; }
  /// A larger size that this machine computes in time, where the size is automatic and the first one was chosen without knowing; else null.
  get largerSize() {
    if (this.#size !== "automatic") return null;
    const [width, height] = this.#speeds.sizeFor(this.info.effect, this.where !== null);
    return width > this.#pixels[0] ? [width, height] : null;
  }
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
    const running = this.#began;
    if (running !== null) setTimeout(() => { if (this.#began === running) this.cancel(); }, running + patience - performance.now());
    return this.#inTurn(() => this.#open(scene, sets ?? new Map(this.sets), size));
  }
  /// Leaves what runs now: it rejects with Cancelled.
  cancel() { (this.#coming ?? this.#engine).cancel(); }
  /// Frame 0 again, with the current keys.
  reset() { return this.open(this.#scene, {sets: null}); }
  /// The same with another value that a running scene does not accept.
  restartWith(key, toml) { return this.open(this.#scene, {sets: new Map([...this.sets, [key, toml]])}); }

  /// Sets a key to another value from the next frame on.
  set(key, toml) {
    return this.#withScene(async () => {
      const info = await this.#engine.run("set", {key, value: toml});
      this.sets.set(key, toml);
      this.changedLate ||= this.#frame >= 0;
      this.#took(info);
    });
  }

  /// The next frame: like step of live_operations.js; with `pass` like its stepWithCases.
  step(pass = null) {
    return this.#withScene(async () => {
      if (pass !== null) await this.#takeJudge();
      const shown = pass === null ? await this.#engine.run("step") : await this.#engine.run("stepWithCases", {pass});
      // Frame 0 makes things that later frames reuse.
      if (++this.#frame > 0 && pass === null && this.#size === "automatic" && !this.sets.has("run.supersample")) this.#speeds.measured(this.info.effect, shown);
      return shown;
    });
  }
  judge(profile, given) { return this.#inTurn(() => this.#engine.run("judge", {profile, given})); }

  /// The open scene's film: bytes. Only if it is offered. onProgress(done, of); `signal` aborts it.
  film(args, options) {
    return this.#inTurn(async () => {
      if (!this.#isOpen) await this.#open(this.#scene, this.sets, this.#size);
      return (await this.#engine.run("film", args, options)).film;
    });
  }

  /// The command that prints this frame's lines natively.
  command() { return this.commandOf("hash", this.frame + 1); }
  /// The native command of a verb for the open scene with its keys, and more words.
  commandOf(verb, frames, more = []) {
    const [width, height] = this.pictureSize, words = ["rainref", verb, this.#scene.file, "--frames", String(frames), ...more];
    if (!saysVariant(this.#scene.text) && !this.sets.has("variant")) words.push("--set", `variant=${this.info.variant}`);
    if (this.#size !== "scene") words.push("--size", `${width}x${height}`);
    for (const word of economies(this.#scene, this.sets, this.#size, this.#pixels)) words.push("--set", word);
    for (const [key, toml] of this.sets) words.push("--set", `${key}=${toml}`);
    return words.map(shellWord).join(" ");
  }

  #inTurn(action) {
    const done = this.#last.then(action);
    this.#last = done.catch(() => {});
    return done;
  }
  /// The same, with the scene open, again if need be.
  #withScene(action) {
    return this.#inTurn(async () => {
      if (!this.#isOpen) await this.#open(this.#scene, this.sets, this.#size);
      return this.#timed(action);
    });
  }
  async #timed(action) {
    this.#began = performance.now();
    try {
      return await action();
    } finally {
      this.#began = null;
    }
  }

  async #open(scene, sets, size) {
    const pixels = size === "automatic" ? this.#speeds.sizeFor(effectOf(scene.text), this.where !== null) : size === "scene" ? null : size.split("x").map(Number);
    const isLarger = this.#engine.library === "rainref_simulator" && namesPictures(scene);
    const info = await this.#timed(() => isLarger ? this.#takeLarger(larger => larger.run("open", asOpened(scene, sets, size, pixels)))
                                                  : this.#engine.run("open", asOpened(scene, sets, size, pixels)));
    Object.assign(this, {sets, changedLate: false});
    this.#frame = -1;
    this.#openIn = this.#engine.ended;
    this.#scene = scene;
    this.#size = size;
    this.#pixels = pixels;
    this.#took(info);
  }
  /// The library with the judge continues from the state of the smaller one.
  async #takeJudge() {
    if (this.#engine.library === "rainref_module") return;
    const state = await this.#engine.run("save");
    await this.#takeLarger(async larger => {
      await larger.run("open", asOpened(this.#scene, this.sets, this.#size, this.#pixels));
      await larger.run("load", {state}, {transfer: [state.buffer]});
    });
    this.#openIn = this.#engine.ended;
  }
  /// The whole library in place of the smaller one, which stays if `open` fails.
  async #takeLarger(open) {
    const larger = this.#coming = new Engine("live_operations.js");
    try {
      const result = await open(larger);
      this.#engine.cancel();
      this.#engine = larger;
      return result;
    } catch (error) {
      larger.cancel();
      throw error;
    } finally {
      this.#coming = null;
    }
  }
  #took(info) {
    this.info = info;
    this.values = valuesOf(info.sceneJson);
  }
}

// The frames of the open scene: one after the other, each shown with its lines, as fast as the scene's rate and the engine allow.

const part = id => document.getElementById(id);

/// Shows an error at an element of the page; null: none.
export function showError(id, error) {
  part(id).textContent = error?.message ?? "";
  part(id).hidden = !error;
}
/// A name for work that takes as long each time.
export const workOf = (what, scene, sets, size) => `${what} ${scene?.path ?? "own"} ${size} ${sets?.get("variant") ?? ""}`;

export class Player {
  #run;
  #busy;
  #lines;
  #times = [];  // when the last frames were shown
  #stopped = Promise.resolve();

  playing = false;
  /// How often a scene began, or began again.
  begun = 0;

  constructor(run, busy, lines) {
    [this.#run, this.#busy, this.#lines] = [run, busy, lines];
  }
  /// Playing has ended, its last frame is shown.
  get stopped() { return this.#stopped; }

  /// A scene begins: nothing plays any more. A number: this beginning, while it is `begun`.
  begin() {
    this.setPlaying(false);
    showError("run-error", null);
    return ++this.begun;
  }

  /// Shows a frame, and measures how often.
  showNext(shown) {
    this.#times = [...this.#times.slice(-19), performance.now()];
    this.#show(shown);
  }
  /// Shows a frame that something else took long for.
  showSingle(shown) {
    this.#times = [];
    this.#show(shown);
  }
  #show(shown) {
    const {width, height, picture} = shown, canvas = part("picture"), larger = this.#run.largerSize;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, {width, height});
    canvas.getContext("2d").putImageData(new ImageData(picture, width, height), 0, 0);
    this.#busy.showFrames();
    const perSecond = Math.min(1000 / shown.milliseconds, this.#perSecond());
    const rate = this.playing && this.#times.length > 2 ? `, ${perSecond.toFixed(perSecond < 10 ? 1 : 0)} frames a second` : "";
    part("state").textContent = `frame ${this.#run.frame}, ${width} x ${height}, ${shown.milliseconds.toFixed(0)} ms${rate}`;
    part("larger").hidden = larger === null;
    if (larger) part("larger").textContent = `Larger: ${larger.join(" x ")}`;
    this.#lines.show(shown.lines);
  }
  #perSecond() {
    const span = this.#times[this.#times.length - 1] - this.#times[0];
    return span > 0 ? 1000 * (this.#times.length - 1) / span : Infinity;
  }

  /// The next frame; null if it failed, after showing the error.
  async #computed() {
    const run = this.#run, isFirst = run.frame < 0;
    try {
      return await this.#busy.during(isFirst ? "Computing the first frame…" : "Computing a frame…", () => run.step(),
        {cancel: () => run.cancel(), delay: this.playing ? 700 : 250, as: isFirst ? workOf("frame", run.scene, run.sets, run.size) : null});
    } catch (error) {
      if (error.name === "Cancelled") this.showLeft();
      else showError("run-error", error);
      return null;
    }
  }
  /// After Cancel, or a newer wish.
  showLeft() {
    if (this.#run.info !== null && this.#run.frame < 0) part("state").textContent = "Cancelled. Play or Step begins the scene again.";
  }
  async step() {
    showError("run-error", null);
    const shown = await this.#computed();
    if (shown) this.showNext(shown);
  }
  setPlaying(now) {
    if (now === this.playing) return;
    this.playing = now;
    part("play").textContent = now ? "Pause" : "Play";
    part("step").disabled = now;
    if (now) this.#stopped = this.#play();
  }
  /// The worker makes the next frame while this one is drawn, unless that would exceed the scene's frame rate.
  async #play() {
    showError("run-error", null);
    this.#times = [];
    const period = 1000 / Number(this.#run.values.get("run.fps") ?? 60);
    let due = performance.now(), coming = this.#computed();
    for (let shown; coming && (shown = await coming);) {
      due = Math.max(due + period, performance.now());
      const left = document.hidden ? 500 : due - performance.now();
      coming = this.playing && left < 1 ? this.#computed() : null;
      this.showNext(shown);
      if (coming || !this.playing) continue;
      await new Promise(done => setTimeout(done, left));
      if (this.playing) coming = this.#computed();
    }
    this.setPlaying(false);
  }
  /// Simulates up to a frame, shows each, and stays at the one where it was cancelled.
  async runTo(last) {
    const mine = this.begun;
    let isLeft = false;
    while (!isLeft && mine === this.begun && this.#run.frame < last) {
      this.#busy.counted("Simulating: frame", this.#run.frame + 1, last + 1, () => { isLeft = true; });
      try {
        const shown = await this.#run.step();
        if (mine === this.begun) this.showNext(shown);
      } catch (error) {
        if (error.name !== "Cancelled") showError("run-error", error);
        isLeft = true;
      }
    }
    if (mine === this.begun) this.#busy.hide();
  }
}

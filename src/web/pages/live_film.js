// A film of the open scene from its first frame on, with the parameters as they are now, saved by the browser. The native program makes it where
// the engine is that; else this page does, with the encoder of the browser.
import {saveAs} from "./live_lines.js";
import {webmOf} from "./webm.js";

const part = id => document.getElementById(id);
const types = {mp4: "video/mp4", webm: "video/webm", gif: "image/gif"}, mostFrames = 1000000;
const codecs = [["vp09.00.41.08", "V_VP9"], ["vp8", "V_VP8"]];  // what WebCodecs and Matroska call them

export class FilmRow {
  #run;
  #hooks;
  #aborting = null;  // of the film that is being made
  #isNative;

  /// hooks: before() is called before a film is made, shown(frame) with each frame that this page makes for it.
  constructor(run, hooks) {
    this.#run = run;
    this.#hooks = hooks;
    this.#isNative = run.offers.includes("film");
    part("film-kind").replaceChildren(...(this.#isNative ? Object.keys(types) : ["webm"]).map(kind => new Option(kind)));
    part("film-note").textContent = this.#isNative ? "" : "WebM, one frame for each simulated frame, at the scene's rate. This browser's encoder makes it, so its bits are the browser's.";
    part("film-row").hidden = false;
    part("film").onclick = () => this.#aborting ? this.#aborting.abort() : this.#make();
  }

  /// The scene is wanted for something else: a film that this page makes ends.
  abort() { if (!this.#isNative) this.#aborting?.abort(); }

  async #make() {
    const frames = Number(part("film-frames").value), kind = part("film-kind").value, name = `${this.#run.info.effect}.${kind}`;
    this.#hooks.before();
    part("film-error").hidden = true;
    part("film").textContent = "Cancel";
    this.#aborting = new AbortController();
    const options = {signal: this.#aborting.signal, onProgress: (done, of) => { part("film-state").textContent = `${done} of ${of}`; }};
    try {
      const command = this.#run.commandOf("run", frames, ["--film", name, "--image", "none"]);
      const film = this.#isNative ? await this.#run.film({frames, kind}, options) : await this.#encoded(frames, options);
      saveAs(film, types[kind], name);
      part("film-state").textContent = this.#isNative ? command : `saved: ${name}, ${frames} frames, ${(film.length / 1e6).toFixed(1)} MB. Natively: ${command}`;
    } catch (error) {
      part("film-state").textContent = "";
      if (error.name === "Cancelled") return;
      part("film-error").textContent = error.message;
      part("film-error").hidden = false;
    } finally {
      this.#aborting = null;
      part("film").textContent = "Make a film";
    }
  }

  /// The film's bytes. The scene begins again for it, and stays at the film's last frame.
  async #encoded(frames, {signal, onProgress}) {
    if (!Number.isInteger(frames) || frames < 1 || frames > mostFrames) throw new Error(`frames: expected 1 to ${mostFrames}, found '${part("film-frames").value}'`);
    const fps = Number(this.#run.values.get("run.fps") ?? 60), [width, height] = this.#run.pictureSize;
    const {config, matroska} = await configured(width, height, fps), chunks = [];
    let colour = null, failed = null;
    const encoder = new VideoEncoder({
      output: (chunk, {decoderConfig} = {}) => {
        const bytes = new Uint8Array(chunk.byteLength);
        chunk.copyTo(bytes);
        chunks.push({isKey: chunk.type === "key", bytes});
        colour ??= decoderConfig?.colorSpace ?? null;
      },
      error: error => { failed = error; },
    });
    encoder.configure(config);
    try {
      await this.#run.reset();
      for (let frame = 0; frame < frames; ++frame) {
        const shown = await this.#run.step();
        if (signal.aborted) throw Object.assign(new Error("cancelled"), {name: "Cancelled"});
        this.#hooks.shown(shown);
        const time = k => Math.round(1e6 * k / fps);
        const picture = new VideoFrame(shown.picture, {format: "RGBA", codedWidth: width, codedHeight: height, timestamp: time(frame), duration: time(frame + 1) - time(frame)});
        encoder.encode(picture, {keyFrame: frame % 60 === 0});
        picture.close();
        while (encoder.encodeQueueSize > 3 && !failed) await new Promise(done => setTimeout(done, 5));
        if (failed) throw failed;
        onProgress(frame + 1, frames);
      }
      await encoder.flush();
      if (failed) throw failed;
    } finally {
      if (encoder.state !== "closed") encoder.close();
    }
    return webmOf({chunks, codec: matroska, width, height, fps, colour});
  }
}

/// What this browser encodes; throws if it makes no film.
async function configured(width, height, fps) {
  const bitrate = Math.round(Math.max(2e5, 0.2 * width * height * fps));  // rain is noise: bits are needed
  for (const [codec, matroska] of typeof VideoEncoder === "function" ? codecs : []) {
    const config = {codec, width, height, framerate: fps, bitrate, latencyMode: "quality"};
    const {supported} = await VideoEncoder.isConfigSupported(config).catch(() => ({supported: false}));
    if (supported) return {config, matroska};
  }
  throw new Error(`This browser encodes no film of ${width} x ${height}: it has no WebCodecs with VP9 or VP8, which pages get from https or this machine alone. `
    + "The native program makes films: rainref run SCENE --film FILM.mp4.");
}

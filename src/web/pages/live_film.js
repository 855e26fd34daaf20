// A film of the open scene from its first frame on, with the parameters as they are now, made by the program and saved by the browser.
import {element} from "./report_words.js";

const part = id => document.getElementById(id);
const types = {mp4: "video/mp4", webm: "video/webm", gif: "image/gif"};

export class FilmRow {
  #run;
  #before;
  #aborting = null;  // of the film that is being made

  /// before() is called before a film is made.
  constructor(run, {before}) {
    this.#run = run;
    this.#before = before;
    part("film-row").hidden = false;
    part("film").onclick = () => this.#aborting ? this.#aborting.abort() : this.#make();
  }

  async #make() {
    const frames = Number(part("film-frames").value), kind = part("film-kind").value, name = `${this.#run.info.effect}.${kind}`;
    this.#before();
    part("film-error").hidden = true;
    part("film").textContent = "Cancel";
    this.#aborting = new AbortController();
    try {
      const command = this.#run.commandOf("run", frames, ["--film", name, "--image", "none"]);
      const film = await this.#run.film({frames, kind}, {signal: this.#aborting.signal, onProgress: (done, of) => { part("film-state").textContent = `${done} of ${of}`; }});
      const address = URL.createObjectURL(new Blob([film], {type: types[kind]}));
      element("a", {href: address, download: name}).click();
      URL.revokeObjectURL(address);
      part("film-state").textContent = command;
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
}

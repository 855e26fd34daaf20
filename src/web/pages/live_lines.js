// The lines of hashes of the shown frame, and the native command that prints them.
import {element} from "./report_words.js";

const part = id => document.getElementById(id);

export class Lines {
  #run;

  constructor(run) {
    this.#run = run;
    part("copy").onclick = () => this.#copy();
    part("save-text").onclick = () => saveAs(this.#run.scene.text, "application/toml", baseName(this.#run.scene.file));
  }

  /// The lines of a frame; undefined: it has none, because its buffers went to a port.
  show(lines) {
    part("no-hashes").hidden = lines !== undefined;
    part("hashes").hidden = lines === undefined;
    part("no-hashes").textContent = lines ? "" : "This frame's buffers went to the port and were not hashed. The next step has its lines again.";
    const rows = (lines ?? []).map(line => element("tr", {}, line.split(" ").slice(1).map(text => element("td", {}, text))));
    part("hashes").tBodies[0].replaceChildren(...rows);
    this.showCommand();
  }
  /// The command for the keys as they are now.
  showCommand() {
    const {scene} = this.#run;
    part("command").textContent = this.#run.command();
    part("changed").hidden = !this.#run.changedLate;
    // The native program has no such file yet.
    part("edited").hidden = part("save-text").hidden = !scene.isEdited;
    part("edited").textContent = scene.isEdited ? `The scene's text was changed in this page. Save it as ${scene.file} first; the command reads it from there.` : "";
    part("save-text").textContent = `Save ${baseName(scene.file)}`;
    part("copied").textContent = "";
  }

  async #copy() {
    part("copied").textContent = await copied(part("command").textContent) ? "copied" : "selected: this browser leaves copying to you";
    if (part("copied").textContent !== "copied") getSelection().selectAllChildren(part("command"));
  }
}

const baseName = file => file.slice(file.lastIndexOf("/") + 1);

/// Puts a text on the clipboard; false: the browser did not let the page.
export async function copied(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

/// Saves bytes or a text as a file, as the browser saves what it downloads.
export function saveAs(content, type, name) {
  const address = URL.createObjectURL(new Blob([content], {type}));
  element("a", {href: address, download: name}).click();
  URL.revokeObjectURL(address);
}

/// A scene whose text was edited: its file is another one, beside the files that the text names.
export function edited(scene, text) {
  const folder = scene.file.slice(0, scene.file.lastIndexOf("/") + 1), namesFiles = /^[^#\n]*=[^#\n]*["'][^"'\n]*\.\w+["']/m.test(text);
  return {...scene, path: null, text, file: `${namesFiles ? folder : ""}edited.toml`, isEdited: true};
}

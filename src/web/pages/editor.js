// The text of a shader with line numbers, and its errors beside them.
import {element} from "./report_words.js";
import {errorsOf, filesOf} from "./shader_text.js";

export class Editor {
  #text;
  #gutter;
  #errors;
  #bad = new Set();
  #lines = 0;

  /// Elements: a textarea, a <pre> beside it, and a box for errors. `changed` is called after each edit.
  constructor(text, gutter, errors, changed) {
    [this.#text, this.#gutter, this.#errors] = [text, gutter, errors];
    text.addEventListener("input", () => {
      this.clearErrors();
      changed();
    });
    text.addEventListener("scroll", () => { gutter.scrollTop = text.scrollTop; });
  }

  get value() {
    return this.#text.value;
  }
  set value(text) {
    this.#text.value = text;
    this.clearErrors();
  }

  /// Shows the lines of an error message that refer to this text as a list; shows any other message unchanged.
  showError(message) {
    const errors = errorsOf(message, filesOf(this.value));
    this.#bad = new Set(errors.map(e => e.at));
    this.#drawGutter();
    if (errors.length === 0) return this.#errors.replaceChildren(element("p", {class: "error mono"}, message));
    this.#errors.replaceChildren(element("ul", {}, errors.map(({file, line, column, message: sentence, at}) => {
      const place = element("button", {type: "button"}, `${file}:${line}:${column}`);
      place.addEventListener("click", () => this.goTo(at, column));
      return element("li", {}, place, " ", sentence);
    })));
    this.goTo(errors[0].at, errors[0].column, false);
  }
  clearErrors() {
    this.#bad.clear();
    this.#errors.replaceChildren();
    this.#drawGutter();
  }

  /// Puts the cursor at a line and column, from 1, and shows it.
  goTo(line, column, takesFocus = true) {
    const lines = this.value.split("\n"), at = lines.slice(0, line - 1).reduce((sum, l) => sum + l.length + 1, 0) + Math.max(0, column - 1);
    this.#text.setSelectionRange(at, at);
    this.#text.scrollTop = Math.max(0, (line - 5) * 19);
    if (takesFocus) this.#text.focus();
  }

  #drawGutter() {
    const lines = this.value.split("\n").length;
    if (lines !== this.#lines || this.#gutter.querySelector(".bad") || this.#bad.size > 0) {
      this.#gutter.replaceChildren();
      let plain = "";
      for (let line = 1; line <= lines; ++line) {
        if (!this.#bad.has(line)) {
          plain += `${line}\n`;
          continue;
        }
        this.#gutter.append(plain, element("span", {class: "bad"}, String(line)));
        plain = "";
      }
      this.#gutter.append(plain + "\n");  // as much room below as the text has
      this.#lines = lines;
    }
    this.#gutter.scrollTop = this.#text.scrollTop;
  }
}

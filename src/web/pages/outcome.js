// The result of judging: the verdict in a line, the report as the library writes it, and its files.
import {element, pill, summary} from "./report_words.js";

export class Outcome {
  #verdict;
  #box;
  #frame;
  #urls = [];

  /// Elements: a live region for the verdict, a box with the report's frame and #save-html, -json, -junit and -text, and the frame.
  constructor(verdict, box, frame) {
    [this.#verdict, this.#box, this.#frame] = [verdict, box, frame];
  }

  /// result: {text, json, html, junit}. `name` is the beginning of file names. `hint` stands below what is not PASS; `command` gives the same
  /// natively, "" if none does.
  show(result, name, {hint = "", command = ""} = {}) {
    this.clear();
    const report = JSON.parse(result.json), words = element("span", {}, summary(report)).textContent;  // its links lead into the report
    this.#verdict.replaceChildren(element("div", {class: "line"}, pill(report.status), element("span", {}, words)),
      hint && report.status !== "PASS" ? element("p", {class: "dim"}, hint) : "",
      command ? element("p", {class: "dim"}, "The native program says the same: ", element("code", {id: "command"}, command)) : "");
    for (const [kind, ending, type] of [["html", "html", "text/html"], ["json", "json", "application/json"], ["junit", "xml", "application/xml"], ["text", "txt", "text/plain"]]) {
      const url = URL.createObjectURL(new Blob([result[kind]], {type: `${type};charset=utf-8`})), link = document.getElementById(`save-${kind}`);
      this.#urls.push(url);
      [link.href, link.download] = [url, `${name}.${ending}`];
    }
    // With this base, links within the report stay in it; a separate frame may not navigate within a blob's address.
    this.#frame.srcdoc = result.html.replace("<head>", '<head>\n<base href="about:srcdoc">');
    this.#box.hidden = false;
  }
  /// Shows a sentence that is not a verdict.
  note(text) {
    this.clear();
    this.#verdict.replaceChildren(element("p", {class: "dim"}, text));
  }
  /// Shows what could not be judged, and why.
  fail(message) {
    this.clear();
    this.#verdict.replaceChildren(element("pre", {class: "error"}, message));
  }
  clear() {
    for (const url of this.#urls.splice(0)) URL.revokeObjectURL(url);
    this.#frame.removeAttribute("srcdoc");
    this.#verdict.replaceChildren();
    this.#box.hidden = true;
  }
}

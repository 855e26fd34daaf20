// What came of judging: the verdict in a line, the report as the library writes it, and files of it.
export class Outcome {
  #verdict;
  #box;
  #frame;
  #urls = [];

  /// Elements: a live region for the verdict, a box with the report's frame and #save-html, -json, -junit and -text, and the frame.
  constructor(verdict, box, frame) {
    [this.#verdict, this.#box, this.#frame] = [verdict, box, frame];
  }

  /// result: {status, text, json, html, junit}. `name` begins the names of files.
  show(result, name) {
    this.clear();
    const {status, reason, passes, first_bad_pass: first} = JSON.parse(result.json), bad = passes.find(p => p.pass === first);
    const line = element("div", "line", ""), pill = element("span", "pill", status), cause = bad?.causes[0];
    pill.dataset.status = status;
    line.append(pill);
    const words = bad ? [`${bad.pass} is the first bad pass.`, cause ? `${cause.is_likely ? "Likely cause" : "The cause may be"}: ${cause.name}.` : ""]
                      : [reason ? `${reason}.` : passes.length === 1 ? `${passes[0].pass}.` : `${passes.length} passes.`];
    line.append(element("span", "", words.filter(word => word).join(" ")));
    this.#verdict.replaceChildren(line);
    for (const [kind, ending, type] of [["html", "html", "text/html"], ["json", "json", "application/json"], ["junit", "xml", "application/xml"], ["text", "txt", "text/plain"]]) {
      const url = URL.createObjectURL(new Blob([result[kind]], {type: `${type};charset=utf-8`})), link = document.getElementById(`save-${kind}`);
      this.#urls.push(url);
      [link.href, link.download] = [url, `${name}.${ending}`];
    }
    // With this base links within the report stay in it; a frame apart from the page may not go to places of a blob's address.
    this.#frame.srcdoc = result.html.replace("<head>", '<head>\n<base href="about:srcdoc">');
    this.#box.hidden = false;
  }
  /// A sentence that is no verdict.
  note(text) {
    this.clear();
    this.#verdict.replaceChildren(element("p", "dim", text));
  }
  /// What could not be judged, and why.
  fail(message) {
    this.clear();
    this.#verdict.replaceChildren(element("pre", "error", message));
  }
  clear() {
    for (const url of this.#urls.splice(0)) URL.revokeObjectURL(url);
    this.#frame.removeAttribute("srcdoc");
    this.#verdict.replaceChildren();
    this.#box.hidden = true;
  }
}

function element(name, className, text) {
  const made = document.createElement(name);
  made.className = className;
  made.textContent = text;
  return made;
}

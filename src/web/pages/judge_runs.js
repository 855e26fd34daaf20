// What "Run" and "Judge the folder" do: one at a time, with progress and Cancel. A run uses what it is given, so the page may change meanwhile.
import {Cancelled, until} from "./cancelled.js";
import {Engine, loadLibrary} from "./engine.js";
import {runPasses} from "./gpu_run.js";
import {exampleOf, hasProgram, packFolder} from "./packs.js";
import {shellWord} from "./scene_values.js";
import {filesOf} from "./shader_text.js";

const $ = id => document.getElementById(id);

export class Runs {
  #engine = new Engine("judge_operations.js");
  #outcome;
  #running = null;
  #changed;

  /// `outcome` shows what comes of a run; changed() is called when one begins and when it has ended.
  constructor(outcome, changed) {
    [this.#outcome, this.#changed] = [outcome, changed];
  }
  get isRunning() { return this.#running !== null; }
  cancel() {
    this.#running?.abort();
    this.#engine.cancel();
  }

  /// Runs the passes `wanted` of a pack, as packs/index.json has them. edits: from a formula to a text. refused(error) shows why the shader of
  /// error.pass does not run, and gives a sentence.
  runShaders(wanted, name, {pack, edits, profile}, refused) {
    return this.#guarded(async signal => {
      const shaders = new Map();
      for (const {name: pass, formula, cases} of wanted) {
        if (cases === 0 || !await until(signal, hasProgram(pack.effect, formula))) continue;
        shaders.set(pass, edits.has(formula) ? filesOf(edits.get(formula)) : await until(signal, exampleOf(pack.effect, formula)));
      }
      loadLibrary().catch(() => {});  // meanwhile; #judge says what went wrong
      const folder = await this.#folderOf(pack, signal);
      this.#working("Asking for the GPU, which answers when it has ended what it did before");
      try {
        const ran = await runPasses(navigator.gpu, folder, shaders, {signal, progress: (done, of) => this.#working("Running", done, of)});
        await this.#judge(ran, {pack, folder, profile, passes: [...shaders.keys()]}, name, signal);
      } catch (error) {
        if (!error.pass || signal.aborted) throw error;
        throw new Error(await refused(error));
      }
    });
  }

  /// spirv: a folder of the port's shaders, or null. `hint` stands below what is not PASS.
  judgeFolder(port, {pack, profile, partial, spirv}, hint) {
    return this.#guarded(async signal => {
      try {
        const folder = await this.#folderOf(pack, signal);
        await this.#judge(port, {pack, folder, profile, partial, spirv}, "all", signal, hint);
      } catch (error) {
        if (error instanceof Cancelled || signal.aborted) throw error;
        throw new Error(`${error.message}\n${hint}`);
      }
    });
  }

  async #folderOf(pack, signal) {
    this.#working("Loading the pack");
    return pack.folder ?? until(signal, packFolder(pack));
  }

  async #judge(port, {pack, folder, spirv = null, ...options}, name, signal, hint = "") {
    this.#working("Loading the judge");
    await until(signal, this.#engine.start());
    this.#working("Judging");
    // Reports show these names: the visitor's own ones, as far as they do not meet.
    const packPath = pack.folder && !["port", "spirv"].includes(pack.name) ? pack.name : `packs/${pack.name}`;
    const at = (path, one) => ({path, files: [...one.files]});
    const given = {pack: at(packPath, folder), port: at([packPath, "packs", "spirv"].includes(port.name) ? `port/${port.name}` : port.name, port),
                   spirv: spirv && at(`spirv/${spirv.name}`, spirv)};
    const result = await until(signal, this.#engine.run("judgeFolder", {...given, ...options}, {onProgress: (done, of) => done < of ? this.#working("Judging", done, of) : this.#working("Looking for causes, and drawing")}));
    const command = options.passes ? "" : commandOf(given, options);
    this.#outcome.show(withCommand(result, command), `${pack.name}-${name}-${options.profile}`, {hint, command});
    $("result").scrollIntoView({block: "start"});
  }

  // ---- progress ----

  /// Shows what is being done, and how long it has taken if that is long.
  #working(doing, done = null, of = null) {
    const words = of === null ? `${doing} …` : `${doing}: ${done} of ${of}`;
    this.#doing = {words, since: this.#doing?.words === words ? this.#doing.since : performance.now()};
    if (of === null) $("progress").removeAttribute("value");
    else [$("progress").max, $("progress").value] = [of, done];
    this.#showDoing();
  }
  #doing = null;
  #showDoing() {
    const seconds = Math.round((performance.now() - this.#doing.since) / 1000);
    $("doing").textContent = seconds < 3 ? this.#doing.words : `${this.#doing.words} (${seconds} s)`;
  }

  /// Runs `work(signal)` with progress and Cancel; shows its error. The keyboard's place goes to Cancel, then to the result.
  async #guarded(work) {
    if (this.#running) return;
    const {signal} = this.#running = new AbortController(), begin = performance.now(), cameFrom = document.activeElement;
    this.#outcome.clear();
    this.#working("Preparing");
    $("working").hidden = false;
    const ticking = setInterval(() => this.#showDoing(), 1000);
    if (cameFrom?.tagName === "BUTTON") $("cancel").focus({preventScroll: true});
    this.#changed();
    try {
      await work(signal);
      document.documentElement.dataset.tookMs = String(Math.round(performance.now() - begin));
    } catch (error) {
      if (error.keepsGpu) this.#outcome.note("Cancelled. The GPU may be busy with that shader for a while: the next run waits for it. A folder can be judged meanwhile.");
      else if (error instanceof Cancelled || signal.aborted) this.#outcome.note("Cancelled.");
      else this.#outcome.fail(error.message || error.name);
    } finally {
      clearInterval(ticking);
      this.#running = this.#doing = null;
      const losesFocus = [document.body, $("cancel"), null].includes(document.activeElement);
      $("working").hidden = true;
      $("doing").textContent = "";
      this.#changed();
      if (losesFocus && cameFrom?.tagName === "BUTTON") $("result").focus({preventScroll: true});
    }
  }
}

/// What judges the same natively, where packs/ holds the site's packs.
function commandOf({pack, port, spirv}, {profile, partial}) {
  return ["rainref", "validate", pack.path, "--port", port.path, "--profile", profile, ...(partial ? ["--partial"] : []), ...(spirv ? ["--spirv", spirv.path] : [])].map(shellWord).join(" ");
}
/// The reports with the command, for which the C library has no option: it leaves the text "" of JSON and of the page, and JUnit's property out.
function withCommand({text, json, html, junit}, command) {
  if (command === "") return {text, json, html, junit};
  const marked = command.replace(/[&<>"']/g, c => `&#${c.charCodeAt(0)};`), quoted = JSON.stringify(command).replaceAll("<", "\\u003c");
  const given = page => page.replace('"command": ""', () => `"command": ${quoted}`);
  return {text, json: given(json), html: given(html), junit: junit.replaceAll("    </properties>\n", () => `      <property name="command" value="${marked}"/>\n    </properties>\n`)};
}

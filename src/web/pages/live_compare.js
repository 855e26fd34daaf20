// A port of a pass beside the reference: the example program on this device's GPU, with the inputs of the reference's next frame.
import {requestDevice, runCase} from "./ports/port.js";
import {shaderOf} from "./ports/run_pack.js";
import {element} from "./report_words.js";
import {channelsOf, differenceOf, differingOf, pixelsOf} from "./texels.js";

const part = id => document.getElementById(id);

export class Comparison {
  #run;
  #hooks;
  #device = null;
  #programs = new Map();  // effect to its programs.json
  #outcome = null;        // {entry, outputs} of the last case

  /// hooks: before() is called first, shown(frame) with the frame's picture.
  constructor(run, hooks) {
    this.#run = run;
    this.#hooks = hooks;
    if (!navigator.gpu) this.#without("This browser gives no WebGPU. The simulation above needs none.");
    part("compare").onclick = () => this.#compare();
    part("gain").oninput = () => this.#draw();
    part("output").onchange = () => this.#draw();
    part("pass").onchange = () => this.#clear();
  }
  /// A scene is open.
  ready() {
    part("compare").disabled = !navigator.gpu;
    this.#clear();
  }
  #clear() {
    part("comparison").hidden = true;
    this.#say(null);
  }
  #without(text) {
    part("no-gpu").textContent = text;
    part("no-gpu").hidden = false;
  }
  #say(error) {
    part("compare-error").textContent = error?.message ?? "";
    part("compare-error").hidden = !error;
  }

  async #compare() {
    const button = part("compare"), pass = part("pass").value, profile = part("profile").value;
    this.#hooks.before();
    this.#say(null);
    button.disabled = true;
    try {
      this.#device ??= await requestDevice(navigator.gpu);
      this.#device.device.lost.then(() => { this.#device = null; });
      const frame = await this.#run.step(pass), {cases} = frame;
      this.#hooks.shown(frame);
      if (cases.length === 0) throw new Error(`${pass} does not run in frame ${this.#run.frame}`);
      const given = [];
      for (const entry of cases) given.push(await this.#runPort(entry));
      this.#show(cases, await this.#run.judge(profile, given), profile);
    } catch (error) {
      part("comparison").hidden = true;
      if (error.name !== "Cancelled") this.#say(error);
    } finally {
      button.disabled = false;
    }
  }
  async #runPort({oneCase, records, files}) {
    const {effect} = this.#run.info, description = {reads: oneCase.inputs.map(b => b.name), writes: oneCase.outputs.map(b => b.name), ...this.#passOf(oneCase.pass)};
    if (!this.#programs.has(effect)) this.#programs.set(effect, JSON.parse(new TextDecoder().decode(await readPort(`${effect}/programs.json`))).programs);
    const names = this.#programs.get(effect)[oneCase.formula];
    if (!names) throw new Error(`no example port of ${oneCase.formula}`);
    const manifest = {passes: [{name: oneCase.pass, ...description}], records};
    return runCase(this.#device.device, manifest, oneCase, files, await shaderOf(names, effect, readPort));
  }
  /// The bindings' order is that of rr_describe.
  #passOf(name) {
    const {reads, writes} = this.#run.description.passes.find(pass => pass.name === name);
    return {reads, writes};
  }

  #show(cases, verdict, profile) {
    const last = cases.length - 1;
    this.#outcome = {entry: cases[last], outputs: verdict.outputs[last]};
    part("verdict").textContent = verdict.status;
    part("verdict").dataset.status = verdict.status;
    const count = (number, one, many) => `${number.toLocaleString("en")} ${number === 1 ? one : many}`;
    let texels = 0, differing = 0;
    cases.forEach(({expected}, k) => expected.forEach(({elementBytes, bytes}, output) => {
      texels += Math.max(bytes.length, verdict.outputs[k][output].length) / elementBytes;
      differing += differingOf(bytes, verdict.outputs[k][output], elementBytes);
    }));
    part("counts").textContent = `under ${profile}, frame ${this.#run.frame}, ${count(cases.length, "run", "runs")} of the pass: `
      + `${differing.toLocaleString("en")} of ${count(texels, "texel or record", "texels or records")} ${differing === 1 ? "differs" : "differ"} in bits, `
      + `${count(verdict.outside, "channel is", "channels are")} outside what the profile allows.${verdict.reason ? ` ${verdict.reason}` : ""}`;
    const images = this.#outcome.entry.oneCase.outputs.filter(buffer => buffer.format !== "records");
    part("output").replaceChildren(...images.map(({name}) => element("option", {}, name)));
    part("output-label").hidden = images.length < 2;
    document.querySelector(".three").hidden = images.length === 0;
    part("comparison").hidden = false;
    this.#draw();
  }
  #draw() {
    const gain = 2 ** Number(part("gain").value);
    part("gain-value").textContent = gain.toLocaleString("en");
    const name = part("output").value;
    if (!this.#outcome || !name) return;
    const {entry, outputs} = this.#outcome, k = entry.oneCase.outputs.findIndex(buffer => buffer.name === name);
    const {width, height} = entry.oneCase.outputs[k], {type, channels, bytes} = entry.expected[k];
    const expected = channelsOf(bytes, type), given = channelsOf(outputs[k], type);
    const show = (id, pixels) => {
      const canvas = part(id);
      Object.assign(canvas, {width, height});
      canvas.getContext("2d").putImageData(new ImageData(pixels, width, height), 0, 0);
    };
    // Display code is shown unchanged; other buffers are scaled from their smallest to their largest value.
    const range = type <= 2 ? [0, 1] : rangeOf(expected);
    show("expected", pixelsOf(expected, channels, width, height, range));
    show("given", pixelsOf(given, channels, width, height, range));
    show("difference", differenceOf(expected, given, channels, width, height, gain / (range[1] - range[0] || 1)));
  }
}

function rangeOf(values) {
  let low = Infinity, high = -Infinity;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high && value !== Infinity) high = value;
  }
  return [low, high];
}
const readPort = async path => {
  const answer = await fetch(`ports/${path}`);
  if (!answer.ok) throw new Error(`ports/${path}: ${answer.status} ${answer.statusText}`);
  return new Uint8Array(await answer.arrayBuffer());
};

// judge.html?mistake: the chosen example, the puddle's shade, with one line wrong, which is run and judged at once; a button mends it. Where
// nothing can run, the page shows what `rainref demo` judged when the site was built: the same mistake in the GLSL port.
import {Outcome} from "./outcome.js";
import {exampleOf, packList} from "./packs.js";
import {element} from "./report_words.js";
import {textOf} from "./shader_text.js";

const $ = id => document.getElementById(id);
const lines = {right: "refract(view, normal, 1.0 / water_ior)", wrong: "refract(view, normal, water_ior)"};
const until = async holds => { while (!holds()) await new Promise(done => setTimeout(done, 50)); };
const notice = element("div", {class: "notice", id: "mistake-notice"}), outcome = new Outcome($("verdict"), $("outcome"), $("report"));

/// Whether the text is the example, with either line. A text from a link is not run without a click.
async function isExample() {
  const {formula} = (await packList()).flatMap(pack => pack.passes).find(pass => pass.formula.startsWith("puddle.shade.corrected/"));
  const example = textOf(await exampleOf("puddle", formula));
  return [example, example.replace(lines.right, lines.wrong)].includes($("shader").value);
}
/// Puts one of the lines into the text, in place of the other, and shows it. False if the text has neither.
function write(port) {
  const shader = $("shader"), old = lines[port === "right" ? "wrong" : "right"];
  if (!shader.value.includes(old) && !shader.value.includes(lines[port])) return false;
  if (shader.value.includes(old)) shader.value = shader.value.replace(old, lines[port]);
  shader.dispatchEvent(new Event("input", {bubbles: true}));
  const before = shader.value.slice(0, shader.value.indexOf(lines[port])).split("\n").length;
  shader.scrollTop = shader.scrollHeight * (before - 6) / shader.value.split("\n").length;
  return true;
}
/// Runs the text as a press of the button does. Returns why it could not, or null.
async function refusal() {
  if ($("run").disabled) return "WebGPU is not there";
  $("run").click();
  await until(() => $("working").hidden);
  return $("verdict").querySelector(".error")?.textContent ?? null;
}
async function showRecorded(port) {
  const [html, json, junit, text] = await Promise.all(["html", "json", "xml", "txt"].map(async ending => {
    const answer = await fetch(`mistake/${port}.${ending}`);
    if (!answer.ok) throw new Error(`mistake/${port}.${ending}: ${answer.status} ${answer.statusText}`);
    return answer.text();
  }));
  outcome.show({html, json, junit, text}, `mistake-${port}`);
}

let reason = null;  // why nothing can run here
async function judge(port) {
  const isWrong = port === "wrong", say = (...more) => notice.replaceChildren(element("p", {}, isWrong ? "One line of this shader is wrong: " : "The line is right now: ",
    element("code", {}, lines[port]), "."), ...more);
  say();
  $("result").scrollIntoView({block: "start"});
  if (!write(port)) return notice.replaceChildren(), outcome.note("The example that is chosen above lacks the line that would be changed.");
  try {
    reason ??= await refusal();
    if (reason) await showRecorded(port);
  } catch (error) {
    return outcome.fail(error.message);
  }
  const mend = element("button", {type: "button", id: "mend", class: isWrong && "primary"}, isWrong ? "Mend the line" : "Make the mistake again");
  mend.addEventListener("click", () => judge(isWrong ? "right" : "wrong"));
  say(mend);
  if (reason) notice.append(element("p", {class: "dim small"}, `Nothing runs in this browser: ${reason}. What you see was recorded when the site was built, of a GLSL port with the same line.`));
  $("result").scrollIntoView({block: "start"});
}

if (new URLSearchParams(location.search).has("mistake")) {
  await until(() => "ready" in document.documentElement.dataset);
  $("verdict").before(notice);
  // A browser may know WebGPU and have no device for it.
  if (navigator.gpu && !await navigator.gpu.requestAdapter().catch(() => null)) reason = "WebGPU finds no device";
  if (await isExample()) await judge("wrong");
  else outcome.note("The text above is not the example of the puddle's shade, so it was neither changed nor run.");
  document.documentElement.dataset.mistake = reason ? "recorded" : "run";  // for who drives the page
}

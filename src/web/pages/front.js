// The front page: the film, and what the judge said of the port with a mistake in it. Nothing of WebAssembly is loaded here.
import {element, pill} from "./report_words.js";

// ---- the film: it stands where the visitor wants less motion, and stops at a press ----

const film = document.getElementById("film"), play = document.getElementById("film-play"), calm = matchMedia("(prefers-reduced-motion: reduce)");
const showState = () => { play.textContent = film.paused ? "Play the film" : "Stop the film"; };
for (const event of ["play", "pause"]) film.addEventListener(event, showState);
const start = () => film.play().catch(showState);  // such as where a browser saves power
play.addEventListener("click", () => film.paused ? start() : film.pause());
calm.addEventListener("change", () => calm.matches ? film.pause() : start());
play.hidden = false;
showState();
if (!calm.matches && !navigator.connection?.saveData) start();

// ---- the mistake: as it was judged when this site was built ----

const pictures = document.getElementById("mistake-pictures"), verdict = document.getElementById("mistake-verdict");
const picture = ([name, src, words]) => element("figure", {}, element("img", {width: 96, height: 60, src, alt: words, "data-picture": name}), element("figcaption", {}, words));
try {
  const answer = await fetch("mistake/mistake.json");
  if (!answer.ok) throw new Error(`mistake/mistake.json: ${answer.status} ${answer.statusText}`);
  const {status, pass, failing, invocations, cause, sentence, line, shown} = await answer.json();
  pictures.replaceChildren(...[["reference", shown.reference, "The right port"], ["port", shown.port, "The wrong port"], ["difference", shown.difference, "Their difference"],
    ["verdict", shown.verdict, "Red: outside what any GPU may give"]].map(picture));
  verdict.replaceChildren(element("p", {}, pill(status), ` ${failing} of ${invocations} pixels of ${pass} are outside what a GPU may give.`),
    element("p", {}, "Likely cause: ", element("b", {}, cause), `, ${sentence}`), element("code", {}, line));
} catch (error) {
  verdict.replaceChildren(element("p", {class: "error"}, error.message));
}

// The census page: runs the probes and every port on this device, has them judged, and shows the card.
// census.html?packs=NAME,...: only these packs.
import {Engine} from "./engine.js";
import {bytesOf} from "./files.js";
import {packFolder, packList} from "./packs.js";
import {checkCensus} from "./ports/census/check.js";
import {censusText, takeCensus, totals} from "./ports/census/take.js";
import {deviceName, errorRows, habitRows} from "./ports/census/words.js";
import {element, pill} from "./report_words.js";

const part = id => document.getElementById(id);
const heading = name => element("th", {scope: "row"}, name);

async function portFile(path) {
  const answer = await fetch(`ports/${path}`);
  if (!answer.ok) throw new Error(`${path}: ${answer.status} ${answer.statusText}`);
  return new Uint8Array(await answer.arrayBuffer());
}
/// The packs to run, each loaded on demand.
async function packsToRun() {
  const packs = await packList(), wanted = new URLSearchParams(location.search).get("packs")?.split(",");
  const unknown = wanted?.find(name => !packs.some(pack => pack.name === name));
  if (unknown) throw new Error(`packs: no pack ${unknown}; there are ${packs.map(pack => pack.name).join(", ")}`);
  return packs.filter(pack => !wanted || wanted.includes(pack.name)).map(pack => ({
    name: pack.name, read: async path => bytesOf(await packFolder(pack), path)}));
}

function showCard(census) {
  const {device, by, rainref, ports} = census, sums = totals(census);
  part("name").textContent = deviceName(census) + (device.fallback ? " (software)" : "");
  const rows = (table, list) => table.replaceChildren(...list.map(([name, value]) => element("tr", {}, heading(name), element("td", {}, value))));
  rows(part("device"), [
    ...["vendor", "architecture", "device", "description"].map(key => [key[0].toUpperCase() + key.slice(1), device[key] || "the browser does not say"]),
    ["Features that matter", device.features.join(", ") || "none"], ["User agent", by.user_agent], ["rainref", `${rainref.version}, golden generation ${rainref.golden_generation}`],
  ]);
  part("totals").replaceChildren(...Object.entries(sums).map(([status, count]) => element("span", {}, `${count} `, pill(status))));
  const others = ports.flatMap(({pack, others}) => others.map(other => ({pack, ...other})));
  part("others").replaceChildren(...others.map(({pack, pass, status, reason}) =>
    element("li", {}, pill(status), element("strong", {}, ` ${pass}`), ` of ${pack}: ${reason || "no reason is given"}`)));
  part("all_pass").hidden = others.length > 0;
  rows(part("habits"), habitRows(census));
  part("errors").replaceChildren(...errorRows(census).map(([name, error, at]) =>
    element("tr", {}, heading(name), element("td", {}, error), element("td", {}, at))));
  part("json").value = censusText(census);
  part("card").hidden = false;
}

let running = null;
async function take() {
  const engine = new Engine("census_operations.js");
  running = new AbortController();
  running.signal.addEventListener("abort", () => engine.cancel());
  part("take").disabled = true;
  part("progress").hidden = false;
  part("card").hidden = true;
  part("status").className = "dim";
  try {
    if (!navigator.gpu) throw new Error("This browser has no WebGPU. Chrome and Edge have it; Safari from version 26 on; Firefox on Windows and macOS, elsewhere with dom.webgpu.enabled in about:config.");
    const census = await takeCensus({
      gpu: navigator.gpu, packs: await packsToRun(), readPort: portFile, rainref: await engine.run("versions"),
      judge: given => engine.run("judge", given),
      by: {program: "page", user_agent: navigator.userAgent}, signal: running.signal,
      step: ({done, of, words}) => {
        part("bar").value = done / of;
        part("status").textContent = words === "done" ? "Done." : `${done + 1} of ${of}: ${words}`;
      },
    });
    checkCensus(census);
    showCard(census);
  } catch (error) {
    part("status").textContent = running.signal.aborted ? "Cancelled: nothing is kept." : error.message;
    part("status").className = running.signal.aborted ? "dim" : "error";
  } finally {
    engine.cancel();
    part("progress").hidden = true;
    part("take").disabled = false;
    running = null;
  }
}

part("take").addEventListener("click", take);
part("cancel").addEventListener("click", () => running?.abort());
part("copy").addEventListener("click", async () => {
  try {
    await navigator.clipboard.writeText(part("json").value);
    part("copied").textContent = "Copied.";
  } catch {
    part("json").select();
    part("copied").textContent = "The browser does not let the page copy: press Ctrl+C.";
  }
});
part("download").addEventListener("click", () => {
  const url = URL.createObjectURL(new Blob([part("json").value], {type: "application/json"}));
  element("a", {href: url, download: "census.json"}).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
});

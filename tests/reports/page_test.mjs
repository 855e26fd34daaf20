// node page_test.mjs SOURCES: what the report's script makes of judgements, in a document of a few lines. page_test.cpp has the pages that the
// program makes, and the script in a browser.
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import test from "node:test";
import {standInDocument} from "./stand_in_dom.mjs";

const [sources] = process.argv.slice(2), assets = path.join(sources, "src/reports/assets");
globalThis.document = standInDocument;
// The modules as the page has them: one script.
const names = [...fs.readFileSync(path.join(assets, "report.html"), "utf8").matchAll(/\{\{(\w+\.js)\}\}/g)].map(found => found[1]);
assert.deepEqual(names, ["report_words.js", "report_graph.js", "report_viewer.js", "report.js"]);
const script = names.map(name => fs.readFileSync(path.join(assets, name), "utf8").replaceAll(/\nimport [^\n]*/g, "")).join("");
assert.doesNotMatch(script, /HTML|document\.write|eval|Function\(|^import/m, "text could become markup or script");
const {banner, element, outputElements, sections, share, summary} = await import(`data:text/javascript,${encodeURIComponent(script)}`);

// ---- judgements ----

/// The keys that docs/reports.md lists; json_test.cpp holds it against what is written.
const documented = new Set();
let prefix = null;
for (const line of fs.readFileSync(path.join(sources, "docs/reports.md"), "utf8").split("\n")) {
  if (line.startsWith("## ")) prefix = null;
  const section = /^### `(.*)`/.exec(line);
  if (section) prefix = section[1] === "." ? "" : `${section[1]}.`;
  if (prefix !== null && line.startsWith("| `")) for (const [, key] of line.split(" |")[0].matchAll(/`([^`]*)`/g)) documented.add(prefix + key);
}
/// A judgement whose keys are documented; asking for another is an error.
function strict(value, where = "") {
  if (value === null || typeof value !== "object") return value;
  if (Array.isArray(value)) return value.map(one => strict(one, `${where}[]`));
  const path = key => where === "" ? key : `${where}.${key}`;
  const held = Object.fromEntries(Object.entries(value).map(([key, one]) => {
    assert(documented.has(path(key)) || [...documented].some(d => d.startsWith(`${path(key)}.`)), `${path(key)} is in no table of docs/reports.md`);
    return [key, strict(one, path(key))];
  }));
  return new Proxy(held, {get: (o, key) => {
    assert(typeof key === "symbol" || key in o, `${path(String(key))} is asked for`);
    return o[key];
  }});
}

const outputOf = (name, more = {}) => ({name, format: "rgba16f", shape: "rgba16f 4x2", elements: 32, counted: "values", failing: 0, differing: 0, bounded: 32, vacuous: 0, loose: 0, atypical: 0,
  free: 0, sampled: 32, median_text: "7 codes", p99_text: "vacuous", worst_quantity: null, known: null, worst: [], ...more});
const caseOf = (id, outputs, more = {}) => ({id, status: "PASS", reason: "", broken: false, failing: 0, ambiguous: 0, outputs, ...more});
const figures = {invocations: 8, failing: 0, ambiguous: 0, other_branch: 0, gave_up: 0, elements: 32, outside: 0, differing: 0, bounded: 32, vacuous: 0, loose: 0, free: 0, sampled: 32, median_text: "7 codes", p99_text: "11 codes"};
const passOf = (pass, status, more = {}) => ({pass, formula: `rain.${pass}/1`, sentence: "", takes: [], status, reason: "", inputs_are_good: true, half_text: "", sample_text: "", where: "",
  coverage: {alternatives: 0, text: ""}, quantities: [], worst: null, cause_is_unknown: false, causes: [], cases: [caseOf(`rain.${pass}/0`, [outputOf("out")], {status})], ...more, figures: {...figures, ...more.figures}});
const failure = (x, y, channel, more = {}) => ({x, y, channel, distance: 3, not_a_number: false, text: {place: `(${x}, ${y}).${"xyzw"[channel]}`, got: "2 (0x40)", accepted: "1 (0x3c)", expected: "1 (0x3c)", off: "1 m"}, ...more});
const failing = outputOf("colour", {failing: 6, differing: 6, worst_quantity: "w", worst: [failure(2, 0, 1, {not_a_number: true, distance: null}), failure(0, 1, 3)]});
const cause = {name: "upside down", sentence: "it is stored from the bottom up", counted: "texels", explained: 2, of: 2, inside: 1, is_likely: true, repeats_first: false, line_texts: ["a.comp:7: x = y;"]};
const shade = (more = {}) => passOf("shade", "FAIL", {where: "only channel y", causes: [cause], worst: {case: "rain.shade/0", output: "colour", quantity: "w", off: "0.5 m"},
  cases: [caseOf("rain.shade/0", [failing, outputOf("other")], {status: "FAIL", failing: 2})], ...more, figures: {failing: 2, outside: 6, differing: 6, ...more.figures}});
const reportOf = (status, passes, more = {}) => strict({status, counts: "1 FAIL, 1 PASS", reason: "", first_bad_pass: null, pack: "pack", port: "port", profile: "vulkan", effect: "rain", variant: "corrected", scene: "s.toml",
  device: {api: "Vulkan", name: "Test & <Device>", driver: ""}, rainref: {version: "1", golden_generation: 2}, command: "rainref validate", not_judged: [], files: [], notes: [], stale: [], passes, ...more});
const bad = (more = {}, others = []) => reportOf("FAIL", [passOf("wave", "PASS"), shade(more), ...others], {first_bad_pass: "shade"});

const view = {label: "colour", scale: "codes as stored", x0: 0, y0: 0, width: 4, height: 2, thinned: 1, largest: 2, has_nan: true, colours: ["#001", "#002", "#000", "#100", "#200"],
  reference: "data:image/png;base64,r", port: "data:image/png;base64,p", difference: "data:image/png;base64,d", verdict: "data:image/png;base64,v"};
const shownOf = (more = {}) => ({case: "rain.shade/0", output: "colour", is_left_out: false, verdicts: [5, 1, 0, 2], views: [view, {...view, label: "alpha"}], ...more});
const buffersOf = passes => ({picture_budget: 32 << 20, pictured_failures: 4, verdict_colours: ["#0", "#1", "#2", "#3"], passes});
const made = (report, passes = report.passes.map(() => [])) => element("main", {}, sections(report, buffersOf(passes)));
const words = report => element("p", {}, summary(report)).textContent;
const idsOf = main => main.children.map(child => child.attributes.id).filter(id => id);

// ---- tests ----

test("the banner says what fails and why", () => {
  assert.equal(words(bad({}, [passOf("last", "FAIL")])), "shade is the first bad pass: 2 of 8 invocations (25.00 %) stored what vulkan does not allow. Worst in channel w of out.colour, off by up to 0.5 m. " +
    "Where: only channel y. Likely cause: upside down, it is stored from the bottom up (gives 2 of 2 failing texels bit for bit, comes near 1). Also fail: last.");
  assert.match(words(bad({causes: [{...cause, is_likely: false}]})), / The cause may be upside down, /);
  assert.match(words(bad({causes: [], cause_is_unknown: true})), / The cause is unknown\.$/);
  assert.match(words(bad({worst: {case: "rain.shade/0", output: "colour", quantity: "w", off: null}})), /out\.colour, not a finite number\./);
  const [verdict, rest] = banner(bad());
  assert.equal(verdict.textContent, "FAIL");
  assert.equal(rest.all(".counts")[0].textContent, "1 FAIL, 1 PASS");
  assert.deepEqual(rest.all("a").map(a => a.attributes.href), ["#pass-shade", "#at-rain.shade/0/out.colour"]);
});
test("a wrong input is the cause", () => {
  const reason = "input hit is that of the run before", report = bad({causes: [], reason, cases: [caseOf("rain.shade/0", [failing], {status: "FAIL", broken: true, reason, failing: 2})]});
  assert.match(words(report), /^shade is the first bad pass: input hit is that of the run before\. Worst/);
  const text = made(report).textContent;
  assert.doesNotMatch(text + words(report), /ause unknown|cause is unknown/);
  assert.equal(text.split(reason).length, 2, "the reason stands once, with its run");
});
test("the other verdicts in a sentence", () => {
  const passed = [passOf("wave", "PASS", {figures: {differing: 1}})];
  assert.equal(words(reportOf("PASS", passed)), "Every judged element lies inside what vulkan allows. 96.88 % of the elements have the reference's own bits.");
  assert.match(words(reportOf("WARN", passed)), /^Every judged element lies inside what vulkan allows, with remarks\. 96/);
  assert.match(words(reportOf("KNOWN", passed)), /^Everything that fails is listed in the baseline/);
  assert.equal(words(reportOf("UNTESTED", [], {reason: "port: there is no such folder"})), "port: there is no such folder.");
  assert.equal(words(reportOf("UNTESTED", [...passed, passOf("noise", "UNTESTED", {reason: "no useful bound"})])), "Too little could be judged. noise: no useful bound.");
  assert.deepEqual([share(1, 0), share(0, 9), share(1, 1e9), share(1e9 - 1, 1e9), share(9, 9)], ["-", "0 %", "0.01 %", "99.99 %", "100 %"]);
});
test("what was not judged", () => {
  const file = {error: "out.colour: missing"}, missing = caseOf("rain.shade/1", [], {status: "NOT JUDGED", reason: "out.colour: missing"});
  const report = reportOf("UNTESTED", [passOf("shade", "NOT JUDGED", {cases: [missing]}), passOf("display", "NOT JUDGED", {cases: [], figures: {elements: 0}})], {files: [file], not_judged: ["shade", "display"]});
  assert.match(words(report), /1 file is missing, or cannot be used\. Not judged: shade, display\.$/);
  const main = made(report);
  assert.deepEqual(idsOf(main), ["files", "dataflow", "overview", "pass-shade", "pass-display"]);
  assert.equal(main.all(".broken")[0].textContent, "NOT JUDGED rain.shade/1: out.colour: missing");
  assert.match(main.all("table")[0].textContent, /displaynothing judged-------$/);
});
test("shares of a sample say so", () => {
  const sampled = passOf("wave", "PASS", {sample_text: "widths and shares are those of a sample of 8 of 32 elements", figures: {sampled: 8, bounded: 6, vacuous: 2}});
  const own = made(reportOf("PASS", [sampled])), cells = own.all("table")[0].all("tbody")[0].children[0].children.map(cell => cell.textContent);
  assert.match(own.textContent, /Widths and shares are those of a sample of 8 of 32 elements\./);
  assert.deepEqual([cells[4], cells[8]], ["75.00 %", "25.00 %"]);
});
test("the first bad pass stands first", () => {
  const report = bad({takes: [{input: "hit", from: "wave", previous: false}, {input: "old", from: "shade", previous: true}, {input: "bed", from: "host", previous: false}, {input: "x", from: "gone", previous: false}]});
  const main = made(report), own = main.children.find(child => child.attributes.id === "pass-shade");
  assert.deepEqual(idsOf(main), ["pass-shade", "dataflow", "overview", "pass-wave"]);
  assert.match(own.textContent, /The first bad pass\. Its inputs are good, so no pass before it is to blame\./);
  assert.match(own.textContent, /Takes hit of wave, old of shade \(the run before\), x of gone, bed of the host\./);
  assert.deepEqual(own.all("a").map(a => a.attributes.href), ["#pass-wave", "#pass-shade"], "a pass that is not judged is no link");
  assert.deepEqual(own.all(".causes")[0].all("meter")[0].attributes, {min: "0", max: "2", value: "2"});
  const later = {...cause, is_likely: false}, several = made(bad({causes: [cause, {...later, repeats_first: true}, later]}));
  assert.equal(several.all(".causes")[0].all("li").length, 2, "what the first cause says is not said again");
  assert.equal(own.all(".causes")[0].all("pre")[0].textContent, "a.comp:7: x = y;");
  assert.deepEqual(own.all(".figures")[0].all(".pill").map(pill => pill.textContent), ["FAIL", "PASS"], "an output of a bad case may be good");
  assert.match(main.children[0].textContent, /deviceTest & <Device>.*judged byrainref 1, golden generation 2$/);
  assert.equal(main.all(".command")[0].textContent, "Reproduce: rainref validate");
});
test("the graph", () => {
  const taking = (pass, ...takes) => passOf(pass, "PASS", {takes: takes.map(([input, from, previous = false]) => ({input, from, previous}))});
  const graph = passes => made(reportOf("PASS", passes)).all("svg")[0];
  const alone = graph([taking("shade", ["hit", "hit"])]);
  assert.equal(alone.attributes.viewBox, "0 0 214 80");
  assert.equal(alone.attributes.style, "max-width:214px;min-width:214px");
  const all = graph([taking("wave", ["old", "wave", true]), taking("hit", ["wave", "wave"], ["slope", "wave"]), taking("shade", ["hit", "hit"], ["wave", "wave"])]);
  assert.deepEqual(all.all(".label").map(e => e.textContent), ["old", "wave, slope", "hit", "wave"]);
  assert.equal(all.all(".previous").length, 1);
  assert.deepEqual(all.all("rect").map(e => Number(e.attributes.x)), [12, 12 + 190 + 102, 12 + 2 * (190 + 102)]);  // eleven letters of 6.6 and 30
  assert.deepEqual(all.all(".state").map(e => e.textContent), Array(3).fill("PASS · 0 outside"));
  assert.equal(made(bad()).all("svg")[0].all(".first")[0].all(".state")[0].textContent, "FAIL · 25.00 % outside");
});
test("tables say what they leave out", () => {
  const many = (count, status) => Array.from({length: count}, (_, k) => caseOf(`rain.wave/${status}${k}`, [outputOf("out")], {status}));
  const quantity = {output: "drops", counted: "fields", name: "y", unit: "m", elements: 8, failing: 2, free: 0, sampled: 8, vacuous: 4, loose: 8, farthest: 0.00123456, extent: 0, median_text: "0.1", p99_text: "vacuous"};
  const main = made(reportOf("PASS", [passOf("wave", "PASS", {cases: [...many(30, "PASS"), ...many(3, "WARN")], quantities: [quantity, {...quantity, farthest: null, free: 8, sampled: 0, extent: 4}]})]));
  const own = main.children.at(-1), rows = own.all("table").map(table => table.all("tbody")[0].children.map(row => row.children.map(cell => cell.textContent)));
  assert.equal(rows[0].length, 24 + 3);
  assert.equal(own.all(".remark")[0].textContent, "6 more outputs are not shown; --json lists all.");
  assert.deepEqual(rows[1], [["drops", "y", "m", "field", "2 of 8", "0.00123", "0.1", "vacuous", "-", "50.00 %", "100 %"], ["drops", "y", "m", "field", "2 of 8", "no number", "-", "-", "4", "-", "-"]]);
  assert.equal(own.all("details")[0].attributes.open, "");
  const knownOutput = outputOf("picture", {failing: 1, known: "ticket 481"}), known = made(reportOf("KNOWN", [passOf("display", "KNOWN", {cases: [caseOf("rain.display/0", [knownOutput, knownOutput], {status: "KNOWN"})]})]));
  assert.deepEqual(known.all(".known-reason").map(p => p.textContent), ["Known picture: ticket 481"]);
  const fails = Array.from({length: 6}, (_, k) => caseOf(`rain.shade/${k}`, [failing], {status: "FAIL", failing: 2}));
  assert.deepEqual(made(bad({cases: fails}), [[], [shownOf({views: [], is_left_out: true})]]).all(".remark").map(p => p.textContent),
    ["Pictures of 4 of 6 failing cases: the first and those with most failures.", "No pictures of 1 more outputs: a page holds 32 MiB of them."]);
});
test("pictures and worst elements", () => {
  const main = made(bad(), [[], [shownOf()]]), viewer = main.all(".viewer")[0], [colour, alpha] = viewer.all(".view");
  assert.equal(viewer.attributes.role, "group");
  assert.equal(viewer.attributes["aria-label"], "Pictures of rain.shade/0/out.colour");
  assert.deepEqual(colour.all("img").map(img => [img.attributes.alt, img.attributes.src.at(-1)]), [["reference", "r"], ["port", "p"], ["port", "p"], ["difference", "d"], ["verdict", "v"]]);
  assert.deepEqual(colour.all("figcaption").map(e => e.textContent), ["reference codes as stored; magenta: not a number", "port same scale", "port − reference −2+2 codes", "verdict of texels 5 equal 1 inside 0 atypical 2 outside "]);
  // It opens on the channel that fails worst, and marks its first element in each picture.
  assert.deepEqual([colour.hidden, alpha.hidden], [true, false]);
  assert.deepEqual(alpha.all(".mark").map(e => e.attributes.style), Array(4).fill("left:0%;top:0%;width:25%;height:50%"));
  const rows = main.all(".outliers")[0].all("tbody")[0].children.map(row => row.children.map(cell => cell.textContent));
  assert.deepEqual(rows, [["(2, 0).y", "2 (0x40)", "1 (0x3c)", "1 (0x3c)", "not a number", "1 m"], ["(0, 1).w", "2 (0x40)", "1 (0x3c)", "1 (0x3c)", "3", "1 m"]]);
  main.all(".place")[0].click();
  assert.deepEqual([colour.hidden, alpha.hidden], [false, true]);
  assert.equal(viewer.all(".readout")[0].textContent, "(2, 0).y got 2 (0x40), accepted 1 (0x3c)");
  const thin = outputElements(caseOf("c", []), failing, shownOf({views: [{...view, width: 1281, thinned: 3}]}), [])[1];
  assert.equal(thin.all(".large").length, 1);
  assert.match(thin.all(".remark")[0].textContent, /^One pixel for 3×3 texels/);
  const sampled = outputElements(caseOf("c", []), failing, shownOf({verdicts: [5, 1, 0, 2, 9]}), [])[1];
  assert.equal(sampled.all("figcaption")[3].textContent, "verdict of texels 5 equal 1 inside 0 atypical 2 outside 9 not judged ");
  const passes = outputElements(caseOf("c", []), outputOf("out"), shownOf({views: []}), []);
  assert.deepEqual(passes, [], "nothing is shown where there is nothing");
});
test("fields of lists", () => {
  const list = (counted, shown) => element("div", {}, outputElements(caseOf("rain.drops/0", []), outputOf("drops", {format: "records", shape: "6 records", counted, failing: 2, elements: 24}), shown, []));
  const fields = list("fields", {rows: [["7", "y", "2", "1", "1", "3", "1 m"]], more: 3});
  assert.equal(fields.textContent, "rain.drops/0/out.drops 6 records2 of 24 fields outside, of 6 recordsrecordfieldgotacceptedexpectedcodes offoff by7y21131 m3 more fields are not shown.");
  assert.equal(list("records", {rows: [["7", "", "missing", ""]], more: 0}).textContent, "rain.drops/0/out.drops 6 recordsRecords that differ: 2 of 24recordfieldgotexpected7missing");
  assert.equal(list("fields", {rows: [], more: 0}).all("table").length, 0);
});

// Elements, shares, and the sentence that a judgement comes to: what the report and other pages share. docs/reports.md lists the keys of a
// judgement.

const maker = create => (name, attributes = {}, ...children) => {
  const made = create(name);
  for (const [key, value] of Object.entries(attributes)) if (value !== null && value !== false) made.setAttribute(key, value);
  made.append(...children.flat(Infinity).filter(child => child != null && child !== false && child !== ""));
  return made;
};
/// An element with attributes and children: elements, or texts, which stay text whatever they hold. An attribute that is null or false is left
/// out, and so is a child that is null, false or "".
export const element = maker(name => document.createElement(name));
/// The same of a picture.
export const svgElement = maker(name => document.createElementNS("http://www.w3.org/2000/svg", name));

/// A table; the first `words` columns are words, the others numbers. A cell is a text, an element, or a list of these.
export function table(className, head, rows, words) {
  const cells = (tag, texts) => element("tr", {}, texts.map((text, k) => element(tag, {class: k >= words && "n"}, text)));
  return element("div", {class: "scroll"}, element("table", {class: className}, element("thead", {}, cells("th", head)), element("tbody", {}, rows.map(row => cells("td", row)))));
}

/// The status in its colour.
export const pill = status => element("span", {class: "pill", "data-status": status}, status);

/// "0 %", "0.01 %", "99.99 %", "100 %": never rounded to all or to nothing; "-" of nothing.
export function share(part, of) {
  if (of <= 0) return "-";
  if (part <= 0) return "0 %";
  if (part >= of) return "100 %";
  return `${Math.min(Math.max(100 * part / of, 0.01), 99.99).toFixed(2)} %`;
}

export const isBroken = pass => pass.cases.some(c => c.broken);
export const linkTo = pass => element("a", {href: `#pass-${pass}`}, pass);
/// Where the pictures and worst elements of an output stand.
export const placeOf = (id, output) => `at-${id}/out.${output}`;
/// Things with a separator between them.
export const joined = (things, separator = ", ") => things.flatMap((thing, k) => k === 0 ? [thing] : [separator, thing]);

/// What a reader in a hurry needs of a judgement, as texts and elements that link to its passes.
export function summary(report) {
  const {files: {length: files}, not_judged: notJudged} = report;
  return [verdictWords(report), files > 0 && [" ", element("a", {href: "#files"}, `${files} file${files === 1 ? " is" : "s are"}`), " missing, or cannot be used."],
    notJudged.length > 0 && [" Not judged: ", joined(notJudged.map(linkTo)), "."]];
}

function verdictWords(report) {
  const {passes, profile, status} = report, bad = passes.find(p => p.pass === report.first_bad_pass), allowed = element("b", {}, profile);
  if (bad) return firstBadWords(report, bad, allowed);
  if (report.reason) return `${report.reason}.`;
  if (status === "KNOWN") return "Everything that fails is listed in the baseline, with its reason.";
  if (status === "PASS" || status === "WARN") {
    const sum = key => passes.reduce((all, p) => all + p.figures[key], 0), elements = sum("elements");
    return ["Every judged element lies inside what ", allowed, status === "WARN" ? " allows, with remarks. " : " allows. ",
      `${share(elements - sum("differing"), elements)} of the elements have the reference's own bits.`];
  }
  const untested = passes.filter(p => p.status === "UNTESTED" && p.reason);
  return untested.length === 0 ? "" : ["Too little could be judged. ", joined(untested.map(p => [linkTo(p.pass), `: ${p.reason}.`]), " ")];
}

function firstBadWords(report, bad, allowed) {
  const {figures: f, worst, where, causes: [cause]} = bad, others = report.passes.filter(p => p.status === "FAIL" && p !== bad);
  return [linkTo(bad.pass), " is the first bad pass: ",
    isBroken(bad) || f.outside === 0 ? `${bad.reason}.` : [`${f.failing} of ${f.invocations} invocations (${share(f.failing, f.invocations)}) stored what `, allowed, " does not allow."],
    worst && worstWords(bad, worst), where && ` Where: ${where}.`,
    cause && !bad.cause_is_unknown ? [cause.is_likely ? " Likely cause: " : " The cause may be ", element("b", {}, cause.name),
      `, ${cause.sentence} (gives ${cause.explained} of ${cause.of} failing ${cause.counted} bit for bit, comes near ${cause.inside}).`]
      : bad.cause_is_unknown && " The cause is unknown.",
    others.length > 0 && [" Also fail: ", joined(others.map(p => linkTo(p.pass))), "."]];
}
function worstWords(bad, {case: id, output, quantity, off}) {
  const {format} = bad.cases.find(c => c.id === id).outputs.find(o => o.name === output);
  return [" Worst in ", element("a", {href: `#${placeOf(id, output)}`}, `${format === "records" ? quantity : `channel ${quantity}`} of out.${output}`),
    off === null ? ", not a finite number." : `, off by up to ${off}.`];
}

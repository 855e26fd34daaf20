// The report page, made of a judgement (docs/reports.md lists its keys) and of the buffers that the program could read (buffers.h).
import {graph} from "./report_graph.js";
import {outputElements} from "./report_viewer.js";
import {element, isBroken, joined, linkTo, pill, share, summary, table} from "./report_words.js";

const shownBadRows = 200, shownGoodRows = 24;  // of the table of cases

/// What stands in the banner.
export const banner = report => [element("p", {class: "verdict"}, report.status),
  element("div", {}, element("p", {class: "summary"}, summary(report)), element("p", {class: "counts"}, report.counts))];

/// Everything between the banner and the help. What went wrong first stands first.
export function sections(report, buffers) {
  const {passes} = report, isFirst = p => p.pass === report.first_bad_pass;
  const own = passes.map((p, k) => passSection(p, report, buffers, buffers.passes[k]));
  return [facts(report), report.command && element("p", {class: "command"}, element("span", {class: "dim"}, "Reproduce:"), " ", element("code", {}, report.command)),
    report.stale.map(text => element("p", {class: "stale"}, element("b", {}, "Baseline:"), ` ${text}`)),
    listed("files", "Missing, or cannot be used", report.files.map(f => f.error)),
    own.filter((_, k) => isFirst(passes[k])),
    listed(null, "Notes", report.notes),
    passes.length > 0 && [element("section", {id: "dataflow"}, element("h2", {}, "Dataflow"), element("div", {class: "scroll"}, graph(report))),
      element("section", {id: "overview"}, element("h2", {}, "How much each verdict is worth"), overview(passes))],
    own.filter((_, k) => !isFirst(passes[k]))].flat(2).filter(part => part);
}

const listed = (id, title, texts) => texts.length > 0 && element("section", {id}, element("h2", {}, title), element("ul", {}, texts.map(text => element("li", {}, text))));

function facts({effect, variant, scene, profile, device, pack, port, rainref}) {
  const all = {effect: variant ? `${effect}, ${variant}` : effect, scene, profile, API: device.api, device: device.name, driver: device.driver, pack, port,
               "judged by": `rainref ${rainref.version}, golden generation ${rainref.golden_generation}`};
  return element("dl", {class: "facts"}, Object.entries(all).map(([key, text]) => text && element("div", {}, element("dt", {}, key), element("dd", {}, text))));
}

/// The columns that a pass and an output have: f has their numbers.
const figureCells = (f, ambiguous) => [share(f.differing, f.elements), share(f.bounded, f.sampled), f.median_text, f.p99_text, String(ambiguous),
                                       share(f.vacuous, f.sampled), share(f.loose, f.sampled)];
const figureHead = ["differ", "bounded", "median width", "99 %", "ambiguous", "vacuous", "loose"];

const overview = passes => table("figures", ["verdict", "pass", "invocations outside", ...figureHead], passes.map(({pass, status, figures: f}) =>
  [pill(status), linkTo(pass), ...f.elements === 0 ? ["nothing judged", ...figureHead.map(() => "-")] : [`${f.failing} of ${f.invocations}`, ...figureCells(f, f.ambiguous)]]), 2);

// ---- a pass ----

function passSection(p, report, buffers, shown) {
  const f = p.figures, dim = text => text && element("p", {class: "dim"}, text), {alternatives, text} = p.coverage;
  return element("section", {class: "pass", id: `pass-${p.pass}`, "data-status": p.status},
    element("h2", {}, pill(p.status), ` ${p.pass} `, element("code", {class: "dim"}, p.formula)),
    p.sentence && element("p", {}, p.sentence),
    p.pass === report.first_bad_pass && element("p", {class: "first"}, "The first bad pass.",
      p.inputs_are_good ? " Its inputs are good, so no pass before it is to blame." : " Its inputs are not good either."),
    p.reason && !isBroken(p) && element("p", {class: "reason"}, p.reason),
    broken(p), known(p), takes(p, report.passes), causes(p),
    dim(p.sample_text && `${p.sample_text[0].toUpperCase()}${p.sample_text.slice(1)}.`),
    dim(p.half_text && `${p.half_text[0].toUpperCase()}${p.half_text.slice(1)}.`),
    dim(alternatives > 0 && `The pack ${text}.`),
    dim(f.other_branch > 0 && `${f.other_branch} of ${f.ambiguous} ambiguous invocations took another branch than the reference.`),
    dim(f.gave_up > 0 && `${f.gave_up} invocations had too many open decisions to bound.`),
    cases(p), quantities(p), outputs(p, buffers, shown));
}

/// Cases that fail, or could not be judged, for a reason that no output shows.
function broken(p) {
  const found = p.cases.filter(c => c.broken || (c.outputs.length === 0 && (c.status === "UNTESTED" || c.status === "NOT JUDGED")));
  return found.length > 0 && element("ul", {class: "broken"}, found.slice(0, shownBadRows).map(c => element("li", {}, pill(c.status), ` ${c.id}: ${c.reason}`)),
    found.length > shownBadRows && element("li", {}, `${found.length - shownBadRows} more; --json lists all.`));
}

function known(p) {
  const reasons = p.cases.flatMap(c => c.outputs).filter(o => o.known !== null).map(o => ` ${o.name}: ${o.known}`);
  return [...new Set(reasons)].map(reason => element("p", {class: "known-reason"}, element("b", {}, "Known"), reason));
}

/// "wave of wave_step (the run before), drops of raindrops": where its inputs come from.
function takes(p, passes) {
  const parts = p.takes.filter(t => t.from !== "host").map(({input, from, previous}) =>
    [`${input} of `, passes.some(other => other.pass === from) ? linkTo(from) : from, previous && " (the run before)"]);
  const fromHost = p.takes.filter(t => t.from === "host").map(t => t.input);
  if (fromHost.length > 0) parts.push(`${fromHost.join(", ")} of the host`);
  return parts.length > 0 && element("p", {class: "dim"}, "Takes ", joined(parts), ".");
}

function causes(p) {
  if (p.figures.outside === 0 && p.causes.length === 0) return [];
  const where = p.where && element("p", {class: "cause"}, element("b", {}, "Where:"), ` ${p.where}.`);
  if (p.causes.length === 0 || p.cause_is_unknown)
    return [where, p.cause_is_unknown && element("p", {class: "cause"}, element("b", {}, "Cause unknown:"), " no single mistake that was tried gives these bits.",
      ...p.causes.flatMap(c => c.line_texts.map(line => element("pre", {class: "line"}, line))))];
  return [where, element("h3", {}, p.causes[0].is_likely ? "Likely cause" : "What the cause may be"), element("ol", {class: "causes"}, p.causes.filter(c => !c.repeats_first).map(c =>
    element("li", {}, c.is_likely ? "likely cause " : "may be ", element("b", {}, c.name), `: ${c.sentence} `,
      element("span", {class: "dim"}, `gives ${c.explained} of ${c.of} ${p.status === "WARN" ? "warned" : "failing"} ${c.counted} bit for bit, comes near ${c.inside}`),
      ...c.line_texts.map(line => element("pre", {class: "line"}, line)),
      element("meter", {min: 0, max: c.of, value: c.explained}, share(c.explained, c.of)))))];
}

function cases(p) {
  const all = p.cases.flatMap(c => c.outputs.map(o => ({c, o}))), good = all.filter(({c}) => c.status === "PASS").slice(0, shownGoodRows);
  const bad = all.filter(({c}) => c.status !== "PASS").slice(0, shownBadRows), left = new Set([...good, ...bad]), rows = all.filter(row => left.has(row));
  if (rows.length === 0) return [];
  const statusOf = ({c, o}) => o.failing === 0 && c.status === "FAIL" ? "PASS" : o.failing > 0 && o.known !== null ? "KNOWN" : c.status;
  return [table("figures", ["verdict", "output", "shape", "outside", ...figureHead, "atypical", "free"], rows.map(row => {
    const {c, o} = row;
    return [pill(statusOf(row)), `${c.id}/out.${o.name}`, o.shape, `${o.failing} of ${o.elements}`, ...figureCells(o, c.ambiguous), String(o.atypical), String(o.free)];
  }), 3), rows.length < all.length && element("p", {class: "remark"}, `${all.length - rows.length} more outputs are not shown; --json lists all.`)];
}

/// Each channel and field in its own unit, over all cases.
function quantities(p) {
  const number = value => String(Number(value.toPrecision(3)));
  const rows = p.quantities.map(q => {
    const judged = q.elements - q.free, ofList = q.counted === "fields" || q.counted === "records";
    return [q.output, q.name, q.unit, ofList ? "field" : "channel", `${q.failing} of ${q.elements}`, q.failing === 0 ? "" : q.farthest === null ? "no number" : number(q.farthest),
      judged === 0 ? "-" : q.median_text, judged === 0 ? "-" : q.p99_text, q.extent > 0 ? number(q.extent) : "-", share(q.vacuous, q.sampled), share(q.loose, q.sampled)];
  });
  return rows.length > 0 && element("details", {open: p.quantities.some(q => q.counted === "fields") && ""}, element("summary", {}, "Each channel and field in its own unit"),
    table("figures", ["output", "name", "unit", "", "outside", "farthest off", "median width", "99 %", "declared range", "vacuous", "loose"], rows, 4));
}

function outputs(p, {pictured_failures: mostFailing, picture_budget: budget, verdict_colours: colours}, shown) {
  const failing = p.cases.filter(c => c.status === "FAIL" || c.status === "KNOWN").length, leftOut = shown.filter(s => s.is_left_out).length;
  return [shown.map(s => {
    const c = p.cases.find(one => one.id === s.case);
    return outputElements(c, c.outputs.find(o => o.name === s.output), s, colours);
  }), failing > mostFailing && element("p", {class: "remark"}, `Pictures of ${mostFailing} of ${failing} failing cases: the first and those with most failures.`),
  leftOut > 0 && element("p", {class: "remark"}, `No pictures of ${leftOut} more outputs: a page holds ${budget / 2 ** 20} MiB of them.`)];
}

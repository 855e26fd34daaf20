// The graph of passes: columns by the longest way from a pass that takes from none, rows in the order of execution.
import {share, svgElement} from "./report_words.js";

const nodeWidth = 190, nodeHeight = 56, rowGap = 40, margin = 12;
const legibleWidth = 860;  // a wider graph shrinks to the page, down to this
const letter = 6.6;        // of an edge's label

/// The passes and what flows between them; a node links to its pass.
export function graph(report) {
  const nodes = placed(report.passes), edges = edgesOf(nodes), forward = edges.filter(e => e.to.column - e.from.column === 1);
  const gap = Math.max(60, ...forward.map(e => Math.floor(letter * e.label.length) + 30)), top = margin + (edges.some(e => e.previous) ? 40 : 0);
  const columns = Math.max(...nodes.map(n => n.column)) + 1, rows = Math.max(...nodes.map(n => n.row)) + 1;
  const reach = Math.max(0, ...edges.map(e => e.to.column - e.from.column).filter(span => span > 1).map(span => 40 + 16 * (span - 1)));
  for (const n of nodes) [n.x, n.y] = [margin + n.column * (nodeWidth + gap), top + n.row * (nodeHeight + rowGap)];
  const bottom = top + rows * nodeHeight + (rows - 1) * rowGap, width = 2 * margin + columns * nodeWidth + (columns - 1) * gap;
  return svgElement("svg", {class: "graph", viewBox: `0 0 ${width} ${bottom + reach + margin}`, role: "group", "aria-label": "Passes and what flows between them",
    style: `max-width:${width}px;min-width:${Math.min(width, legibleWidth)}px`},
    svgElement("defs", {}, svgElement("marker", {id: "arrow", viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 7, markerHeight: 7, orient: "auto"},
      svgElement("path", {d: "M0 0L8 4L0 8z"}))),
    edges.map(e => edgeOf(e, top, bottom)), nodes.map(n => nodeOf(n, report.first_bad_pass)));
}

/// Passes come in the order of execution, so what a pass takes from this run is placed before it.
function placed(passes) {
  const nodes = [], rows = [];
  for (const pass of passes) {
    const sources = pass.takes.filter(t => !t.previous).map(t => nodes.find(n => n.pass.pass === t.from)).filter(n => n);
    const column = Math.max(0, ...sources.map(n => n.column + 1));
    rows[column] = (rows[column] ?? -1) + 1;
    nodes.push({pass, column, row: rows[column]});
  }
  return nodes;
}

/// One edge for all inputs of the same way, "hit, normal".
function edgesOf(nodes) {
  const edges = [];
  for (const to of nodes) {
    for (const {input, from: name, previous} of to.pass.takes) {
      const from = nodes.find(n => n.pass.pass === name), same = edges.find(e => e.from === from && e.to === to && e.previous === previous);
      if (same) same.label += `, ${input}`;
      else if (from) edges.push({from, to, previous, label: input});
    }
  }
  return edges;
}

function edgeOf({from, to, previous, label}, top, bottom) {
  const drawn = (path, x, y) => [svgElement("path", {class: previous ? "edge previous" : "edge", d: path}), svgElement("text", {class: "label", x: Math.round(x), y: Math.round(y)}, label)];
  if (from === to) {  // a loop above the node
    const x = from.x + nodeWidth / 2, y = from.y;
    return drawn(`M${x + 28} ${y}C${x + 44} ${y - 34} ${x - 44} ${y - 34} ${x - 28} ${y}`, x, y - 30);
  }
  const span = to.column - from.column;
  if (span === 1 && !previous) {
    const x0 = from.x + nodeWidth, y0 = from.y + nodeHeight / 2, x1 = to.x, y1 = to.y + nodeHeight / 2, middle = (x0 + x1) / 2;
    return drawn(`M${x0} ${y0}C${middle} ${y0} ${middle} ${y1} ${x1 - 2} ${y1}`, middle, (y0 + y1) / 2 - 6);
  }
  // Around the nodes between: forward below them, backward above.
  const side = span > 0 ? 20 : -20, begin = from.x + nodeWidth / 2 + side, end = to.x + nodeWidth / 2 - side;
  const turn = previous ? top - 26 : bottom + 22 + 12 * (span - 1);
  const y0 = previous ? from.y : from.y + nodeHeight, y1 = previous ? to.y - 2 : to.y + nodeHeight + 2;
  return drawn(`M${begin} ${y0}C${begin} ${turn + (turn - y0) / 3} ${end} ${turn + (turn - y1) / 3} ${end} ${y1}`, (begin + end) / 2, turn - 2);
}

function nodeOf({pass: {pass, status, formula, figures: f}, x, y}, firstBad) {
  const middle = x + nodeWidth / 2, outside = f.failing === 0 ? "0 outside" : `${share(f.failing, f.invocations)} outside`;
  return svgElement("a", {href: `#pass-${pass}`}, svgElement("g", {class: pass === firstBad ? "node first" : "node", "data-status": status},
    svgElement("title", {}, formula), svgElement("rect", {x, y, width: nodeWidth, height: nodeHeight, rx: 8}),
    svgElement("text", {class: "name", x: middle, y: y + 24}, pass),
    svgElement("text", {class: "state", x: middle, y: y + 43}, f.elements === 0 ? status : `${status} · ${outside}`)));
}

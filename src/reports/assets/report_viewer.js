// One output: its pictures side by side, with zoom, flicker and the way from a worst element to its place; its worst elements, or its fields.
import {element, placeOf, table} from "./report_words.js";

const shownOutliers = 12, smallColumns = 320;  // wider pictures stand two in a row, where a browser would leave out pixels of four
const kinds = ["reference", "port", "difference", "verdict"];

/// The elements of one output of a case; `shown` is its object of buffers_json(), `colours` those of the verdict map.
export function outputElements(c, output, shown, colours) {
  const name = `${c.id}/out.${output.name}`, title = element("h3", {id: placeOf(c.id, output.name)}, `${name} `, element("span", {class: "dim"}, output.shape));
  if (output.format === "records") return output.failing === 0 ? [] : [title, fieldsOf(output, shown)];
  if (shown.views.length === 0 && output.failing === 0) return [];
  const viewer = element("div", {class: "viewer", tabindex: 0, role: "group", "aria-label": `Pictures of ${name}`});
  const views = shown.views.map(v => viewOf(v, shown.verdicts, colours)), places = output.worst.map(f => placeButton(output, f));
  viewer.append(...views.map(v => v.node), ...outliers(output, places));
  if (views.length > 0) drive(viewer, views, places, output.worst_quantity);
  return [title, viewer];
}

function fieldsOf(output, {rows, more}) {
  const byBits = output.counted === "records", head = byBits ? ["got", "expected"] : ["got", "accepted", "expected", "codes off", "off by"];
  return [element("h4", {}, byBits ? `Records that differ: ${output.failing} of ${output.elements}` : `${output.failing} of ${output.elements} fields outside, of ${output.shape}`),
    rows.length > 0 && table("outliers", ["record", "field", ...head], rows, 2), more > 0 && element("p", {class: "remark"}, `${more} more fields are not shown.`)];
}

// ---- pictures ----

const isShownBy = (view, channel) => {
  const label = view.label.split(",")[0];
  return label === channel || (label === "alpha" && channel === "w") || (label === "colour" && channel !== "w");
};
const columnsOf = v => Math.ceil(v.width / v.thinned), rowsOf = v => Math.ceil(v.height / v.thinned);

/// {view, node, panes}; of each pane the window that is seen through, and the layer of the picture in it.
function viewOf(v, verdicts, colours) {
  const captions = {
    reference: [v.scale, v.has_nan && ["; ", element("span", {class: "nan"}, "magenta: not a number")]],
    port: "same scale", difference: scaleOf(v), verdict: legendOf(verdicts, colours),
  };
  const size = {width: columnsOf(v), height: rowsOf(v)}, picture = (kind, more = {}) => element("img", {...size, alt: kind, src: v[kind], ...more});
  const panes = kinds.map(kind => {
    // The port lies over the reference, hidden, so that a swap moves nothing.
    const layer = element("div", {class: "layer"}, picture(kind), kind === "reference" && picture("port", {class: "other"}));
    const frame = element("div", {class: "window", style: `--ratio:${size.width}/${size.height}`}, layer);
    const words = {difference: "port − reference"}[kind] ?? kind;
    return {frame, layer, node: element("figure", {class: `pane ${kind}`}, frame, element("figcaption", {}, element("b", {}, words), " ", captions[kind]))};
  });
  const node = element("div", {class: "view", "data-label": v.label}, element("div", {class: size.width > smallColumns ? "panes large" : "panes"}, panes.map(p => p.node)),
    v.thinned > 1 && element("p", {class: "remark"}, `One pixel for ${v.thinned}×${v.thinned} texels: reference and port show the first of them, difference and verdict the worst.`));
  return {view: v, node, panes};
}
const swatch = colour => element("i", {style: `background:${colour}`});
/// Blocks of colour, one for each doubling, from the lowest difference to the highest.
const scaleOf = ({largest, colours}) => largest === 0 ? "no difference" : element("span", {class: "bar"}, element("span", {}, `−${largest}`),
  element("span", {class: "blocks"}, colours.map(swatch)), element("span", {}, `+${largest} code${largest === 1 ? "" : "s"}`));
const legendOf = (verdicts, colours) => ["of texels ",
  ["equal", "inside", "atypical", "outside", "not judged"].map((word, k) => (k < 4 || verdicts[k] > 0) && [element("span", {class: "key"}, swatch(colours[k]), `${verdicts[k]} ${word}`), " "])];

// ---- worst elements ----

const placeButton = (output, failure) => ({failure, channel: "xyzw"[failure.channel],
  button: element("button", {type: "button", class: "place", "data-x": failure.x, "data-y": failure.y}, failure.text.place)});

function outliers(output, places) {
  if (output.failing === 0) return [];
  const rows = places.map(({button, failure: {text, distance, not_a_number: isNan}}) =>
    [button, text.got, text.accepted, text.expected, isNan ? "not a number" : String(distance), text.off]);
  const part = some => table("outliers", ["place (column, row).channel", "got", "accepted", "expected", "codes off", "off by"], some, 1);
  return [element("h4", {}, `The worst ${rows.length} of ${output.failing} elements outside`), part(rows.slice(0, shownOutliers)),
    ...rows.length > shownOutliers ? [element("details", {}, element("summary", {}, `${rows.length - shownOutliers} more`), part(rows.slice(shownOutliers)))] : []];
}

// ---- what mouse and keys do ----

function drive(viewer, views, places, worstQuantity) {
  let current = 0, zoom = 1, x = 0, y = 0, timer = 0, isSwapped = false, alone = null;  // x, y: the upper left corner, as a share of the picture
  const apply = () => {
    x = Math.min(Math.max(x, 0), 1 - 1 / zoom);
    y = Math.min(Math.max(y, 0), 1 - 1 / zoom);
    viewer.style.setProperty("--zoom", zoom);
    viewer.style.setProperty("--px", `${-100 * x * zoom}%`);
    viewer.style.setProperty("--py", `${-100 * y * zoom}%`);
  };
  // Keeps the point (cx, cy) of the window in its place.
  const zoomBy = (factor, cx = 0.5, cy = 0.5) => {
    const next = Math.min(Math.max(zoom * factor, 1), 64);
    x += cx / zoom - cx / next;
    y += cy / zoom - cy / next;
    zoom = next;
    apply();
  };
  const moveBy = (dx, dy) => { x += dx; y += dy; apply(); };
  const reset = () => { zoom = 1; x = y = 0; apply(); };
  const swap = (on = !isSwapped) => { isSwapped = on; viewer.classList.toggle("swapped", on); };
  const flicker = () => {
    if (timer) { clearInterval(timer); timer = 0; swap(false); }
    else { swap(true); timer = setInterval(() => swap(), 500); }
    flickerButton.setAttribute("aria-pressed", String(timer !== 0));
  };
  const solo = pane => {
    alone = alone === pane ? null : pane;
    if (alone === null) viewer.removeAttribute("data-solo");
    else viewer.setAttribute("data-solo", String(alone));
  };
  const show = index => {
    current = index;
    views.forEach((v, k) => { v.node.hidden = k !== index; });
    tabs.forEach((t, k) => t.setAttribute("aria-pressed", String(k === index)));
  };

  // The texel at a share of the picture; row 0 is at the bottom.
  const texelAt = (v, u, w) => [v.x0 + Math.floor(u * columnsOf(v)) * v.thinned, v.y0 + (rowsOf(v) - 1 - Math.floor(w * rowsOf(v))) * v.thinned];
  const holds = (v, {x: tx, y: ty}) => tx >= v.x0 && ty >= v.y0 && tx < v.x0 + v.width && ty < v.y0 + v.height;
  const texts = new Map();
  for (const {failure: {x: tx, y: ty, text: {place, got, accepted}}} of places) {
    const key = `${tx},${ty}`, words = `${place} got ${got}, accepted ${accepted}`;
    texts.set(key, texts.has(key) ? `${texts.get(key)}; ${words}` : words);
  }
  const mark = ({view: v, panes}, {x: tx, y: ty}) => {
    const columns = columnsOf(v), rows = rowsOf(v), column = Math.floor((tx - v.x0) / v.thinned), row = rows - 1 - Math.floor((ty - v.y0) / v.thinned);
    for (const pane of panes) {
      pane.mark?.remove();
      pane.mark = element("div", {class: "mark", style: `left:${100 * column / columns}%;top:${100 * row / rows}%;width:${100 / columns}%;height:${100 / rows}%`});
      pane.layer.append(pane.mark);
    }
    return [(column + 0.5) / columns, (row + 0.5) / rows];
  };
  // To the view of the element's channel, at full size where there is one.
  const goTo = ({failure, channel}) => {
    const score = k => !holds(views[k].view, failure) ? -1 : (isShownBy(views[k].view, channel) ? 2 : 0) + (views[k].view.thinned === 1 ? 1 : 0);
    show(views.reduce((best, _, k) => score(k) > score(best) ? k : best, 0));
    const {view: v} = views[current], [u, w] = mark(views[current], failure);
    zoom = Math.max(1, Math.min(64, Math.max(columnsOf(v), rowsOf(v)) / 24));
    x = u - 0.5 / zoom;
    y = w - 0.5 / zoom;
    apply();
    readout.textContent = texts.get(`${failure.x},${failure.y}`);
    viewer.scrollIntoView({block: "nearest"});
  };
  for (const place of places) place.button.addEventListener("click", () => goTo(place));

  const button = (text, action, title, more = {}) => {
    const made = element("button", {type: "button", title, ...more}, text);
    made.addEventListener("click", action);
    return made;
  };
  const gap = () => element("span", {class: "gap"});
  const tabs = views.map((v, k) => button(v.view.label, () => show(k), "Key V: next view"));
  const flickerButton = button("Flicker", flicker, "Key F: reference and port in turn in the first picture", {class: "flicker"}), readout = element("output", {class: "readout"});
  viewer.prepend(element("div", {class: "tools"}, tabs.length > 1 && [tabs, gap()], flickerButton, button("Swap", () => swap(), "Key S"), gap(), button("+", () => zoomBy(2), "Key +"),
    button("−", () => zoomBy(0.5), "Key -"), button("Reset", reset, "Key 0"), readout));

  for (const {view, panes} of views) panes.forEach(({frame}, k) => {
    const pointed = e => {
      const r = frame.getBoundingClientRect();
      return [(e.clientX - r.left) / r.width, (e.clientY - r.top) / r.height];
    };
    let grip = null;
    const release = () => { grip = null; };
    frame.addEventListener("pointerdown", e => { grip = [...pointed(e), x, y]; frame.setPointerCapture(e.pointerId); viewer.focus({preventScroll: true}); e.preventDefault(); });
    frame.addEventListener("pointerup", release);
    frame.addEventListener("pointercancel", release);
    frame.addEventListener("pointermove", e => {
      const [u, w] = pointed(e), inside = share => Math.min(Math.max(share, 0), 0.999999);
      if (grip) { x = grip[2] - (u - grip[0]) / zoom; y = grip[3] - (w - grip[1]) / zoom; apply(); }
      const [tx, ty] = texelAt(view, inside(x + u / zoom), inside(y + w / zoom));
      readout.textContent = texts.get(`${tx},${ty}`) ?? `(${tx}, ${ty})`;
    });
    frame.addEventListener("pointerleave", () => { if (!grip) readout.textContent = ""; });
    frame.addEventListener("dblclick", () => solo(k));
    // The page scrolls by the wheel until the pictures have the focus.
    frame.addEventListener("wheel", e => {
      if (!viewer.contains(document.activeElement) && !e.ctrlKey) return;
      e.preventDefault();
      zoomBy(e.deltaY < 0 ? 1.25 : 0.8, ...pointed(e));
    }, {passive: false});
  });
  viewer.addEventListener("keydown", e => {
    if (e.ctrlKey || e.altKey || e.metaKey) return;
    const step = 0.1 / zoom;
    const actions = {
      f: flicker, s: () => swap(), "+": () => zoomBy(2), "=": () => zoomBy(2), "-": () => zoomBy(0.5), "0": reset, v: () => show((current + 1) % views.length),
      1: () => solo(0), 2: () => solo(1), 3: () => solo(2), 4: () => solo(3),
    };
    if (zoom > 1) Object.assign(actions, {ArrowLeft: () => moveBy(-step, 0), ArrowRight: () => moveBy(step, 0), ArrowUp: () => moveBy(0, -step), ArrowDown: () => moveBy(0, step)});
    const action = actions[e.key] ?? actions[e.key.toLowerCase()];
    if (!action) return;
    e.preventDefault();
    action();
  });
  // What fails worst is seen first.
  show(Math.max(0, views.findIndex(v => isShownBy(v.view, worstQuantity))));
  const worst = places.find(p => p.channel === worstQuantity);
  if (worst && holds(views[current].view, worst.failure)) mark(views[current], worst.failure);
}

"use strict";
// Pictures: zoom, move, flicker, and the way from a worst element to its place. Without scripts the page still shows all.
for (const viewer of document.querySelectorAll(".viewer")) {
  const views = [...viewer.querySelectorAll(".view")];
  if (views.length === 0) continue;
  let current = 0, zoom = 1, x = 0, y = 0, timer = 0;  // x, y: the upper left corner, as a share of the picture

  const button = (text, action, hint) => {
    const b = document.createElement("button");
    b.type = "button";
    b.textContent = text;
    if (hint) b.title = hint;
    b.addEventListener("click", action);
    return b;
  };
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
  const reset = () => { zoom = 1; x = y = 0; apply(); };
  const swap = on => { viewer.classList.toggle("swapped", on); };
  const flicker = () => {
    if (timer) { clearInterval(timer); timer = 0; swap(false); }
    else { swap(true); timer = setInterval(() => swap(), 500); }
    flickerButton.setAttribute("aria-pressed", String(timer !== 0));
  };
  const solo = pane => {
    if (viewer.dataset.solo === String(pane)) delete viewer.dataset.solo;
    else viewer.dataset.solo = pane;
  };
  const show = index => {
    current = index;
    views.forEach((v, k) => { v.hidden = k !== index; });
    tabs.forEach((t, k) => t.setAttribute("aria-pressed", String(k === index)));
  };

  // The texel at a share of the picture; row 0 is at the bottom.
  const area = view => {
    const d = view.dataset;
    const columns = Math.ceil(d.width / d.thinned), rows = Math.ceil(d.height / d.thinned);
    return {x0: +d.x0, y0: +d.y0, columns, rows, thinned: +d.thinned};
  };
  const texelAt = (view, u, v) => {
    const a = area(view);
    return [a.x0 + Math.floor(u * a.columns) * a.thinned, a.y0 + (a.rows - 1 - Math.floor(v * a.rows)) * a.thinned];
  };
  const texts = new Map();
  for (const place of viewer.querySelectorAll(".place")) {
    const cells = [...place.closest("tr").cells].map(c => c.textContent);
    const key = `${place.dataset.x},${place.dataset.y}`;
    texts.set(key, `${texts.has(key) ? texts.get(key) + "; " : ""}${cells[0]} got ${cells[1]}, accepted ${cells[2]}`);
  }
  const mark = (view, tx, ty) => {
    const a = area(view), column = Math.floor((tx - a.x0) / a.thinned), row = a.rows - 1 - Math.floor((ty - a.y0) / a.thinned);
    for (const layer of view.querySelectorAll(".layer")) {
      layer.querySelector(".mark")?.remove();
      const m = document.createElement("div");
      m.className = "mark";
      Object.assign(m.style, {left: `${100 * column / a.columns}%`, top: `${100 * row / a.rows}%`, width: `${100 / a.columns}%`, height: `${100 / a.rows}%`});
      layer.append(m);
    }
    return [(column + 0.5) / a.columns, (row + 0.5) / a.rows];
  };
  const holds = (view, tx, ty) => {
    const d = view.dataset;
    return tx >= +d.x0 && ty >= +d.y0 && tx < +d.x0 + +d.width && ty < +d.y0 + +d.height;
  };
  // To the view of the element's channel, at full size where there is one.
  const goTo = place => {
    const tx = +place.dataset.x, ty = +place.dataset.y, channel = place.textContent.split(".").pop();
    const fits = views.map((v, k) => k).filter(k => holds(views[k], tx, ty));
    const score = k => {
      const label = views[k].dataset.label.split(",")[0];
      return (label === channel || label === "colour" || (label === "alpha" && channel === "w") ? 2 : 0) + (+views[k].dataset.thinned === 1 ? 1 : 0) + (label === "alpha" && channel === "w" ? 1 : 0);
    };
    show(fits.reduce((best, k) => score(k) > score(best) ? k : best, fits[0]));
    const [u, v] = mark(views[current], tx, ty), a = area(views[current]);
    zoom = Math.max(1, Math.min(64, Math.max(a.columns, a.rows) / 24));
    x = u - 0.5 / zoom;
    y = v - 0.5 / zoom;
    apply();
    readout.textContent = texts.get(`${tx},${ty}`);
    viewer.scrollIntoView({block: "nearest"});
  };
  for (const place of viewer.querySelectorAll(".place")) place.addEventListener("click", () => goTo(place));

  const tools = document.createElement("div");
  tools.className = "tools";
  const tabs = views.map((v, k) => button(v.dataset.label, () => show(k), "Key V: next view"));
  const flickerButton = button("Flicker", flicker, "Key F: reference and port in turn in the first picture");
  flickerButton.className = "flicker";
  const readout = document.createElement("output");
  readout.className = "readout";
  const gap = () => Object.assign(document.createElement("span"), {className: "gap"});
  tools.append(...(tabs.length > 1 ? [...tabs, gap()] : []), flickerButton, button("Swap", () => swap(), "Key S"), gap(), button("+", () => zoomBy(2), "Key +"), button("−", () => zoomBy(0.5), "Key -"),
    button("Reset", reset, "Key 0"), readout);
  viewer.prepend(tools);

  for (const view of views) {
    // The port lies over the reference, hidden, so that a swap moves nothing.
    const other = view.querySelector(".port img").cloneNode();
    other.className = "other";
    view.querySelector(".reference .layer").append(other);
    view.querySelectorAll(".pane").forEach((pane, k) => {
      const frame = pane.querySelector(".window");
      const share = e => {
        const r = frame.getBoundingClientRect();
        return [(e.clientX - r.left) / r.width, (e.clientY - r.top) / r.height];
      };
      let grip = null;
      frame.addEventListener("pointerdown", e => { grip = [...share(e), x, y]; frame.setPointerCapture(e.pointerId); viewer.focus({preventScroll: true}); e.preventDefault(); });
      frame.addEventListener("pointerup", () => { grip = null; });
      frame.addEventListener("pointercancel", () => { grip = null; });
      frame.addEventListener("pointermove", e => {
        const [u, v] = share(e);
        if (grip) { x = grip[2] - (u - grip[0]) / zoom; y = grip[3] - (v - grip[1]) / zoom; apply(); }
        const [tx, ty] = texelAt(view, Math.min(Math.max(x + u / zoom, 0), 0.999999), Math.min(Math.max(y + v / zoom, 0), 0.999999));
        const known = texts.get(`${tx},${ty}`);
        readout.textContent = known ?? `(${tx}, ${ty})`;
      });
      frame.addEventListener("pointerleave", () => { if (!grip) readout.textContent = ""; });
      frame.addEventListener("dblclick", () => solo(k));
      // The page scrolls by the wheel until the pictures have the focus.
      frame.addEventListener("wheel", e => {
        if (!viewer.contains(document.activeElement) && !e.ctrlKey) return;
        e.preventDefault();
        zoomBy(e.deltaY < 0 ? 1.25 : 0.8, ...share(e));
      }, {passive: false});
    });
  }
  viewer.addEventListener("keydown", e => {
    if (e.ctrlKey || e.altKey || e.metaKey) return;
    const step = 0.1 / zoom;
    const actions = {
      f: flicker, s: () => swap(), "+": () => zoomBy(2), "=": () => zoomBy(2), "-": () => zoomBy(0.5), "0": reset, v: () => show((current + 1) % views.length),
      1: () => solo(0), 2: () => solo(1), 3: () => solo(2), 4: () => solo(3),
    };
    if (zoom > 1) Object.assign(actions, {ArrowLeft: () => { x -= step; apply(); }, ArrowRight: () => { x += step; apply(); }, ArrowUp: () => { y -= step; apply(); }, ArrowDown: () => { y += step; apply(); }});
    const action = actions[e.key] ?? actions[e.key.toLowerCase()];
    if (!action) return;
    e.preventDefault();
    action();
  });
  // What fails worst is seen first.
  show(Math.max(0, views.findIndex(v => "open" in v.dataset)));
  const worst = viewer.querySelector(".place[data-open]");
  if (worst && holds(views[current], +worst.dataset.x, +worst.dataset.y)) mark(views[current], +worst.dataset.x, +worst.dataset.y);
}

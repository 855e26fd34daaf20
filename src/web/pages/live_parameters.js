// Controls for the parameters of a scene, made from what `describe` says of them.
import {tomlValue} from "./live_toml.js";

// What the page has controls of its own for.
const elsewhere = new Set(["effect", "run.frames", "run.size"]);

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/// Fills `place` with the parameters; change(key, toml) is called with a new value and throws where it is refused; restart(key, toml) opens
/// the scene anew with it. `values`: {key: value} of the scene, `original`: what the scene began with.
export function showParameters(place, parameters, values, original, {change, restart}) {
  const unfolded = new Set([...place.querySelectorAll("details[open]")].map(d => d.dataset.section));
  const kept = place.dataset.effect === values.effect ? unfolded : new Set(matchMedia("(max-width: 900px)").matches ? [] : ["rain", values.effect]);
  place.dataset.effect = values.effect;
  const sections = new Map();
  for (const parameter of parameters) {
    if (elsewhere.has(parameter.name) || !(parameter.name in values)) continue;
    const section = parameter.name.includes(".") ? parameter.name.split(".")[0] : "scene";
    if (!sections.has(section)) sections.set(section, []);
    sections.get(section).push(parameter);
  }
  const order = [...sections.keys()].sort((a, b) => kept.has(b) - kept.has(a));
  place.replaceChildren(...order.map(section => {
    const details = element("details", {open: kept.has(section)}, element("summary", {textContent: section}));
    details.dataset.section = section;
    const fill = () => {
      if (details.childElementCount > 1) return;
      details.append(...sections.get(section).map(parameter => control(parameter, values[parameter.name], original[parameter.name], change, restart)));
    };
    if (details.open) fill();
    details.addEventListener("toggle", fill);
    return details;
  }));
}

function control(parameter, value, began, change, restart) {
  const {name, type, unit, sentence} = parameter, id = `p-${name}`, refused = element("div", {className: "refused", hidden: true});
  refused.setAttribute("role", "alert");
  const whole = element("div", {className: "parameter"});
  const mark = now => whole.classList.toggle("changed", JSON.stringify(now) !== JSON.stringify(began));
  let last = value;
  const give = async (now, show) => {
    const toml = tomlValue(now, type);
    refused.hidden = true;
    try {
      await change(name, toml);
      last = now;
      mark(now);
    } catch (error) {
      const again = element("button", {type: "button", textContent: "Restart with it", onclick: () => restart(name, toml)});
      refused.replaceChildren(element("div", {textContent: error.message}), again);
      refused.hidden = false;
      show(last);
    }
  };
  mark(value);
  whole.append(element("label", {className: "head", htmlFor: id}, element("span", {className: "name", textContent: name.split(".").pop()}),
                       element("span", {className: "unit", textContent: unit === "1" ? "" : unit})),
               element("p", {className: "sentence", textContent: sentence}), ...inputs(parameter, id, value, give), refused);
  return whole;
}

/// What takes the value; give(value, show) is called with a new one, and show(value) puts the old one back.
function inputs(parameter, id, value, give) {
  const {name, type, minimum, maximum, choices} = parameter;
  if (type === "choice") {
    const select = element("select", {id}, ...choices.map(choice => element("option", {value: choice, textContent: choice})));
    select.value = value;
    select.onchange = () => give(select.value, v => { select.value = v; });
    return [select];
  }
  if (type === "boolean") {
    const box = element("input", {id, type: "checkbox", checked: value});
    box.onchange = () => give(box.checked, v => { box.checked = v; });
    return [box];
  }
  if (typeof value === "string") {
    const text = element("input", {id, type: "text", value});
    text.onchange = () => give(text.value, v => { text.value = v; });
    return [text];
  }
  const isInteger = type.startsWith("integer"), step = isInteger ? 1 : "any";
  const number = (v, k) => {
    const made = element("input", {type: "number", value: String(v), step});
    if (minimum !== null) made.min = minimum;
    if (maximum !== null && Number.isSafeInteger(Math.round(maximum))) made.max = maximum;
    made.setAttribute("aria-label", k === null ? name : `${name}, ${"xyzw"[k]}`);
    return made;
  };
  if (Array.isArray(value)) {
    const boxes = value.map((v, k) => number(v, k)), show = values => boxes.forEach((box, k) => { box.value = values[k]; });
    boxes[0].id = id;
    for (const box of boxes) box.onchange = () => give(boxes.map(b => Number(b.value)), show);
    return [element("div", {className: "several"}, ...boxes)];
  }
  const box = number(value, null);
  box.id = id;
  const span = sliderOf(minimum, maximum, value, parameter.default);
  if (!span) {
    box.onchange = () => give(Number(box.value), v => { box.value = v; });
    return [box];
  }
  const slider = element("input", {type: "range", min: span[0], max: span[1], step: isInteger ? 1 : (span[1] - span[0]) / 500, value: String(value)});
  slider.setAttribute("aria-label", name);
  const show = v => { box.value = slider.value = v; };
  box.onchange = () => { slider.value = box.value; give(Number(box.value), show); };
  slider.oninput = () => { box.value = slider.value; };
  // Five significant digits: a slider's steps are no round numbers.
  slider.onchange = () => { box.value = Number(Number(slider.value).toPrecision(5)); give(Number(box.value), show); };
  return [element("div", {className: "slider"}, slider, box)];
}

/// Where a slider begins and ends: the range, or where that is wide, as far as values usually lie.
function sliderOf(minimum, maximum, value, usual) {
  if (minimum === null || maximum === null || maximum > 1e12) return null;
  const size = Math.max(Math.abs(value), Math.abs(usual ?? 0), 1e-3);
  if (maximum - minimum <= 50 * size) return [minimum, maximum];
  return [Math.max(minimum, minimum < 0 ? -4 * size : 0), Math.min(maximum, 4 * size)];
}

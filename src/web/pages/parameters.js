// Controls for the parameters of an effect, made from what rr_describe says of them, in groups by section.
import {element} from "./report_words.js";
import {shownValue, tomlValue} from "./scene_values.js";

// These have controls of their own.
const elsewhere = new Set(["effect", "variant", "run.size", "run.frames"]);
const sliderSteps = 1000;
/// A change makes things anew that other frames share: rr_describe lists them.
const isSlow = ({makes}) => makes?.length > 0;

/// What a slider shows: value = low + (high - low) t^power, where t runs from 0 to 1. Ranges say what is allowed, which is often far more than is
/// of use; the power puts the default at a third where it would lie near the lower end.
function scaleOf({minimum: low, maximum: high, type}, standard) {
  const place = (standard - low) / (high - low), power = place > 0 && place < 0.3 ? Math.log(place) / Math.log(0.35) : 1;
  const rounded = value => type === "integer" ? String(Math.round(value)) : String(Number(value.toPrecision(3)));
  return {
    toValue: t => rounded(Math.min(high, Math.max(low, low + (high - low) * (t / sliderSteps) ** power))),
    toSlider: value => Math.round(sliderSteps * Math.min(1, Math.max(0, (value - low) / (high - low))) ** (1 / power)),
  };
}

export class Parameters {
  #root;
  #rows = new Map();  // key to {parameter, show(toml), row, error, standard}
  #onChange;

  /// onChange(key, toml) is called for each change; it gives a promise, and what that rejects with is shown at the parameter: its `message`, and
  /// where it has `restart`, a button that calls that.
  constructor(root, onChange) {
    this.#root = root;
    this.#onChange = onChange;
  }

  /// `description`: of rr_describe; `values`: each key of the scene with its text in TOML.
  build(description, values, variant) {
    this.#rows.clear();
    const groups = new Map();
    for (const parameter of description.parameters) {
      const {name} = parameter;
      if (elsewhere.has(name) || !values.has(name)) continue;
      const section = name.includes(".") ? name.slice(0, name.indexOf(".")) : "run";
      if (!groups.has(section)) groups.set(section, []);
      groups.get(section).push(this.#row(parameter, variant));
    }
    // What is typed comes after what is moved.
    for (const rows of groups.values()) rows.sort((a, b) => (a.querySelector(".whole") !== null) - (b.querySelector(".whole") !== null));
    // The rain comes first, then what the effect is about; how it is run and seen comes last.
    const order = ["rain", description.effect, "drops", "flow"], last = ["camera", "display", "compositor", "sequence", "run"];
    const place = section => order.includes(section) ? order.indexOf(section) - order.length : 1 + last.indexOf(section);
    const sorted = [...groups].sort(([a], [b]) => place(a) - place(b));
    this.#root.replaceChildren(...sorted.map(([section, rows], k) => {
      const details = element("details", {}, element("summary", {}, section.replaceAll("_", " ")), rows);
      details.open = k === 0 || section === description.effect && rows.length < 24;
      details.dataset.section = section;
      return details;
    }));
    this.update(values);
  }

  /// A key is marked as slow.
  get hasSlow() { return [...this.#rows.values()].some(({parameter}) => isSlow(parameter)); }

  /// Shows the values that the scene has now.
  update(values) {
    for (const [key, {show}] of this.#rows) if (values.has(key)) show(values.get(key));
  }

  /// Shows those whose key or sentence has the text.
  find(text) {
    const wanted = text.trim().toLowerCase();
    for (const [key, {row, parameter}] of this.#rows)
      row.hidden = wanted !== "" && !`${key} ${parameter.sentence}`.toLowerCase().includes(wanted);
    for (const details of this.#root.children) {
      const some = [...details.querySelectorAll(".parameter")].some(row => !row.hidden);
      details.hidden = !some;
      if (wanted !== "" && some) details.open = true;
    }
  }

  #row(parameter, variant) {
    const {name, type, unit, minimum, maximum, sentence} = parameter;
    const standard = parameter.variant_defaults?.[variant] ?? parameter.default, id = `parameter-${name}`;
    const error = element("p", {class: "error", role: "alert"}), inputs = element("div", {class: "inputs"});
    error.hidden = true;
    const range = minimum === null ? "" : ` From ${minimum} to ${maximum}.`, isVector = Array.isArray(standard);
    const tip = `${sentence}${range}${standard === null ? "" : ` Default: ${isVector ? standard.join(", ") : standard}.`}`;
    const change = async toml => {
      error.hidden = true;
      try {
        await this.#onChange(name, toml);
      } catch (failure) {
        error.replaceChildren(failure.message);
        if (failure.restart) {
          const again = element("button", {type: "button"}, "Restart with this value");
          again.onclick = () => { failure.restart().catch(({message}) => error.replaceChildren(message)); };
          error.append(" ", again);
        }
        error.hidden = false;
      }
    };
    const show = this.#inputs(parameter, standard, id, inputs, change);
    const shownUnit = unit === "" || unit === "1" ? "" : unit;
    const row = element("div", {class: "parameter", title: tip, "data-key": name},
      element("div", {class: "top-line"}, element("label", {for: id, class: "name"}, name.slice(name.indexOf(".") + 1).replaceAll("_", " ")), element("span", {class: "unit"}, shownUnit,
        isSlow(parameter) && element("span", {class: "slow", title: `A change makes again: ${parameter.makes.join(", ")}.`}, "slow"))),
      inputs, error, element("p", {class: "sentence"}, sentence));
    const showAll = toml => {
      show(toml);
      error.hidden = true;
      row.classList.toggle("is-changed", standard !== null && shownValue(type, toml) !== shownValue(type, JSON.stringify(standard)));
    };
    this.#rows.set(name, {parameter, row, error, show: showAll});
    return row;
  }

  /// Puts the inputs of a parameter into `inputs`; gives the function that shows a value.
  #inputs(parameter, standard, id, inputs, change) {
    const {type, minimum, maximum, choices} = parameter;
    if (choices || type === "boolean") {  // an integer may have choices, too
      const isFlag = type === "boolean";
      const input = isFlag ? element("input", {type: "checkbox", id}) : element("select", {id}, choices.map(choice => element("option", {}, choice)));
      input.onchange = () => change(isFlag ? String(input.checked) : tomlValue(type, input.value));
      inputs.append(input);
      return toml => {
        if (isFlag) input.checked = toml === "true";
        else input.value = shownValue(type, toml);
      };
    }
    const field = element("input", {type: "text", id, autocomplete: "off", spellcheck: "false"});
    const hasSlider = (type === "real" || type === "integer") && minimum !== null && maximum < 1e15 && standard !== null;
    field.classList.toggle("whole", !hasSlider);
    if (type === "real" || type === "integer") field.inputMode = minimum >= 0 ? "decimal" : "text";
    field.onchange = () => change(tomlValue(type, field.value));
    inputs.append(field);
    if (!hasSlider) return toml => { field.value = shownValue(type, toml); };
    const scale = scaleOf(parameter, standard);
    const slider = element("input", {type: "range", min: 0, max: sliderSteps, step: 1, "aria-label": parameter.name});
    inputs.prepend(slider);
    slider.oninput = () => {
      field.value = scale.toValue(Number(slider.value));
      change(field.value);
    };
    return toml => {
      field.value = shownValue(type, toml);
      if (document.activeElement !== slider) slider.value = scale.toSlider(Number(toml));
    };
  }
}

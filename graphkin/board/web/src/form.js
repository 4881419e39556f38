// The scene as a form: every table of the file with its entries, for those who do not want the text.
import { button, h } from "./dom.js";

/** Shows `form` (the tables of the file); `change(changes)` is told what is put where. */
export function sceneForm(parent, { word, change }) {
  const field = (path, value) => {
    const id = `field-${path}`;
    const label = path.split(".").slice(1).join(" ") || path;
    const kind = typeof value === "number" ? "number" : "text";
    const looks = { id, name: path, value: typeof value === "object" ? JSON.stringify(value) : String(value) };
    if (typeof value === "boolean") {
      const box = h("input", { id, name: path, type: "checkbox", checked: value, onchange: (e) => change({ [path]: e.target.checked }) });
      return h("div.field", {}, h("label", { for: id }, label), box);
    }
    const input = h("input", { ...looks, type: kind, step: "any", onchange: (e) => read(path, value, e.target) });
    return h("div.field", {}, h("label", { for: id }, label), input);
  };
  const read = (path, before, input) => {
    let value = input.value;
    if (typeof before === "number") value = input.valueAsNumber;
    else if (typeof before === "object") {
      try {
        value = JSON.parse(value);
      } catch {
        value = null;
      }
      if (!Array.isArray(value)) {
        input.setCustomValidity(word("wants list"));
        input.reportValidity();
        return;
      }
    }
    if (typeof value === "number" && !Number.isFinite(value)) { // an emptied field gives no value
      input.value = before;
      return;
    }
    input.setCustomValidity("");
    change({ [path]: value });
  };
  const fields = (path, value) => {
    if (Array.isArray(value) && value.length && value.every((one) => typeof one === "number")) {
      return value.map((one, i) => field(item(path, i), one));
    }
    if (Array.isArray(value) && value.some((one) => one && typeof one === "object" && !Array.isArray(one))) {
      return value.map((one, i) => h("fieldset", {}, h("legend", {}, `${path.split(".").at(-1)} ${i + 1}`), ...fields(`${path}.${i + 1}`, one)));
    }
    if (value && typeof value === "object" && !Array.isArray(value)) {
      return Object.entries(value).flatMap(([key, inner]) => {
        const made = fields(`${path}.${key}`, inner);
        const deep = inner && typeof inner === "object" && !Array.isArray(inner) && path === "links";
        return deep ? [h("fieldset", {}, h("legend", {}, `${word("link")} ${key}`), ...made)] : made;
      });
    }
    return [field(path, value)];
  };
  const scales = ["length_scale", "velocity_scale", "acceleration_scale", "force_scale"];
  const wishes = (sheet) => h("fieldset", {}, h("legend", {}, word("scales")), ...scales.map((key) => {
    const id = `field-scale-${key}`;
    const put = (event) => change({ [`sheet.${key}`]: event.target.value === "" ? null : Number(event.target.value) });
    const input = h("input", { id, name: `sheet.${key}`, type: "number", step: "any", min: "0", value: String(sheet?.[key] ?? ""), placeholder: word("chosen"), onchange: put });
    return h("div.field", {}, h("label", { for: id }, word(key)), input);
  }));
  let before = "";
  return {
    show(form) {
      const now = JSON.stringify(form);
      if (!form || now === before) return;
      before = now;
      const focus = document.activeElement?.id;
      const plain = Object.entries(form).filter(([, value]) => typeof value !== "object" || (Array.isArray(value) && typeof value[0] !== "object"));
      const tables = Object.entries(form).filter(([key]) => !plain.some(([name]) => name === key));
      const made = [
        h("fieldset", {}, h("legend", {}, word("scene")), ...plain.flatMap(([key, value]) => [field(key, value)])),
        ...tables.map(([key, value]) => h("fieldset", {}, h("legend", {}, key), ...fields(key, key === "sheet" ? without(value, scales) : value))),
        wishes(form.sheet),
      ];
      parent.replaceChildren(...made);
      if (focus?.startsWith("field-")) document.getElementById(focus)?.focus();
    },
    /** Values that a hand changes now, before the text says them. */
    follow(changes) {
      for (const [path, value] of Object.entries(changes ?? {})) {
        const list = Array.isArray(value);
        const parts = list ? value.map((one, i) => [item(path, i), one]) : [[path, value]];
        for (const [name, one] of parts) {
          const input = document.getElementById(`field-${name}`);
          if (input && input !== document.activeElement) input.value = one;
        }
      }
    },
  };
}

/** The path of an item of a list of numbers: a place has x and y, others (teeth, two compass lengths) are counted. */
const item = (path, i) => `${path}.${(/\.([A-Z]\w*|through|at|centre)$/.test(path) && "xy"[i]) || i + 1}`;
const without = (table, keys) => Object.fromEntries(Object.entries(table).filter(([key]) => !keys.includes(key)));

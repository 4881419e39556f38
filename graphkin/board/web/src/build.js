// A mechanism from nothing: pivots, bars, sliders placed with the mouse, or by the fields below with keys alone.
import { button, h } from "./dom.js";

const SVG = "http://www.w3.org/2000/svg";
const TOOLS = ["pivot", "bar", "point", "slider", "block", "slotted", "pin", "fix", "drive", "delete"];
// what each tool asks for: a point or a new place, a link, a place, an angle
const ASKS = {
  pivot: ["at"], bar: ["from", "to"], point: ["link", "at"], slider: ["point", "angle"], block: ["point", "link"],
  slotted: ["point"], pin: ["old", "of", "link"], fix: ["old"], drive: ["link", "speed"], delete: ["what"],
};

/** The tools and the sketch; `build(step)` is told each piece. */
export function builder(parent, { word, build }) {
  let tool = "pivot";
  let draft = { points: {}, fixed: [], links: {}, guides: [] };
  let begun = null; // of a bar: where the mouse went down
  const board = document.createElementNS(SVG, "svg");
  board.setAttribute("class", "sketch");
  board.setAttribute("role", "group");
  board.setAttribute("aria-label", word("sketch"));
  const tools = h("div.tools", { role: "toolbar", "aria-label": word("tools") });
  const fields = h("form.piece", { onsubmit: (event) => { event.preventDefault(); send(); } });
  const count = h("p.count", { "aria-live": "polite" });
  parent.append(tools, count, board, fields);

  const choose = (name) => {
    tool = name;
    for (const one of tools.children) one.setAttribute("aria-pressed", one.dataset.tool === tool);
    ask();
  };
  for (const name of TOOLS) {
    tools.append(button(word(`build ${name}`), () => choose(name), { "data-tool": name, "aria-pressed": name === tool, title: word(`build ${name} help`) }));
  }

  // -- by keys ------------------------------------------------------------------------------------------------------
  const select = (name, options) => h("label", {}, h("span", {}, word(`ask ${name}`)),
    h("select", { name, onchange: () => shut(name) }, ...options.map(([value, label]) => h("option", { value }, label))));
  const number = (name, label, value) => h("label", {}, h("span", {}, label), h("input", { name, type: "number", step: "any", value }));
  const shut = (name) => {
    const pair = fields.querySelector(`[data-place="${name}"]`);
    if (pair) pair.hidden = fields.elements[name].value !== "";
  };
  const ask = () => {
    const points = Object.keys(draft.points).map((p) => [p, p]);
    const links = Object.keys(draft.links).map((l) => [l, l]);
    const made = [];
    for (const what of ASKS[tool]) {
      if (what === "at") made.push(number("x", "x", "0"), number("y", "y", "0"));
      else if (what === "angle") made.push(number("angle", word("ask angle"), "0"));
      else if (what === "speed") made.push(number("speed", word("ask speed"), "10"));
      else if (what === "link" || what === "of") made.push(select(what, links));
      else if (what === "old") made.push(select("old", points));
      else if (what === "what") {
        made.push(select("what", [...links.map(([l]) => [`link ${l}`, `${word("link")} ${l}`]), ...points.map(([p]) => [`point ${p}`, p])]));
      } else {
        made.push(select(what, [["", word("new point")], ...points]));
        made.push(h("span", { "data-place": what }, number(`${what}x`, "x", "0"), number(`${what}y`, "y", "0")));
      }
    }
    fields.replaceChildren(...made, h("button", { type: "submit" }, word("add")));
  };
  const send = () => {
    const value = (name) => fields.elements[name]?.value ?? "";
    const place = (x, y) => [Number(value(x)), Number(value(y))];
    const step = { what: tool };
    for (const what of ASKS[tool]) {
      if (what === "at") step.at = place("x", "y");
      else if (what === "angle" || what === "speed") step[what] = Number(value(what));
      else if (what === "link" || what === "of") step[what] = value(what);
      else if (what === "old") step.point = value("old");
      else if (what === "what") {
        const [kind, name] = value("what").split(" ");
        step[kind] = name;
      } else step[what] = value(what) || place(`${what}x`, `${what}y`);
    }
    push(step);
  };
  const push = (step) => build({ ...step, places: draft.points });

  // -- by mouse -----------------------------------------------------------------------------------------------------
  const view = () => {
    const places = Object.values(draft.points);
    const xs = [...places.map((p) => p[0]), 0];
    const ys = [...places.map((p) => p[1]), 0];
    const size = Math.max(Math.max(...xs) - Math.min(...xs), (Math.max(...ys) - Math.min(...ys)) * 1.4, places.length ? 1e-9 : 240, 1e-9);
    const wide = places.length > 1 ? size * 1.7 : Math.max(size * 1.7, 300);
    const middle = [(Math.max(...xs) + Math.min(...xs)) / 2, (Math.max(...ys) + Math.min(...ys)) / 2];
    return { left: middle[0] - wide / 2, top: middle[1] + wide * 0.35, wide, high: wide * 0.7 };
  };
  const place = (event) => {
    const box = board.getBoundingClientRect();
    const { left, top, wide } = board.view;
    const per = wide / box.width;
    const step = 10 ** Math.floor(Math.log10(wide / 60));
    const round = (x) => Number((Math.round(x / step) * step).toPrecision(8));
    const at = [round(left + (event.clientX - box.left) * per), round(top - (event.clientY - box.top) * per)];
    const near = Object.entries(draft.points)
      .map(([name, z]) => [name, Math.hypot(z[0] - (left + (event.clientX - box.left) * per), z[1] - (top - (event.clientY - box.top) * per)) / per])
      .sort((a, b) => a[1] - b[1])[0];
    return { at, point: near && near[1] < 12 ? near[0] : null, link: event.target.getAttribute?.("data-link") };
  };
  board.addEventListener("pointerdown", (event) => {
    const here = place(event);
    begun = { ...here, client: [event.clientX, event.clientY] };
    event.preventDefault();
    board.setPointerCapture(event.pointerId);
  });
  board.addEventListener("pointermove", (event) => {
    if (!begun || tool !== "bar") return;
    const here = place(event);
    board.querySelector(".pulling")?.remove();
    const from = begun.point ? draft.points[begun.point] : begun.at;
    board.append(line(from, here.point ? draft.points[here.point] : here.at, "pulling"));
  });
  board.addEventListener("pointerup", (event) => {
    if (!begun) return;
    const [start, end] = [begun, place(event)];
    begun = null;
    const link = start.link ?? Object.keys(draft.links).at(-1);
    const either = (one) => one.point ?? one.at;
    if (tool === "pivot") push({ what: "pivot", at: start.at });
    else if (tool === "bar") push({ what: "bar", from: either(start), to: either(end) });
    else if (tool === "slider") push({ what: "slider", point: either(start), angle: Number(fields.elements.angle?.value ?? 0) });
    else if (tool === "slotted") push({ what: "slotted", point: either(start) });
    else if (tool === "block") push({ what: "block", point: either(start), link: fields.elements.link?.value });
    else if (tool === "point" && start.link) push({ what: "point", link: start.link, at: start.at });
    else if (tool === "fix" && start.point) push({ what: "fix", point: start.point });
    else if (tool === "pin" && start.point) push({ what: "pin", point: start.point, of: fields.elements.of?.value, link: fields.elements.link?.value });
    else if (tool === "drive" && start.link) push({ what: "drive", link: start.link });
    else if (tool === "delete" && start.link) push({ what: "delete", link: start.link });
    else if (tool === "delete" && start.point) push({ what: "delete", point: start.point });
    else if (tool === "drive" && link && start.point) push({ what: "drive", link });
    board.querySelector(".pulling")?.remove();
  });

  const add = (name, looks, text) => {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(looks)) made.setAttribute(key, value);
    if (text !== undefined) made.textContent = text;
    return made;
  };
  const line = (a, b, kind, link) => add("line", { x1: a[0], y1: -a[1], x2: b[0], y2: -b[1], class: kind, ...(link ? { "data-link": link } : {}) });
  const draw = () => {
    const { left, top, wide, high } = (board.view = view());
    board.setAttribute("viewBox", `${left} ${-top} ${wide} ${high}`);
    const unit = wide / 100;
    const parts = [];
    const grid = 10 ** Math.round(Math.log10(wide / 8));
    for (let x = Math.ceil(left / grid) * grid; x < left + wide; x += grid) parts.push(add("line", { x1: x, x2: x, y1: -top, y2: -top + high, class: "grid" }));
    for (let y = Math.ceil((top - high) / grid) * grid; y < top; y += grid) parts.push(add("line", { y1: -y, y2: -y, x1: left, x2: left + wide, class: "grid" }));
    for (const guide of draft.guides) {
      const turn = (guide.angle * Math.PI) / 180;
      const [x, y] = guide.through;
      const [c, s] = [Math.cos(turn) * wide, Math.sin(turn) * wide];
      parts.push(line([x - c, y - s], [x + c, y + s], "guide"));
    }
    for (const [name, link] of Object.entries(draft.links)) {
      const at = link.points.map((p) => draft.points[p]);
      at.forEach((z, i) => i && parts.push(line(at[0], z, "bar", name), line(at[i - 1], z, "bar", name)));
      if (at.length === 1) parts.push(add("rect", { x: at[0][0] - 3 * unit, y: -at[0][1] - 1.6 * unit, width: 6 * unit, height: 3.2 * unit, class: "block", "data-link": name }));
      if (at.length > 1) {
        const z = [(at[0][0] + at[1][0]) / 2, (at[0][1] + at[1][1]) / 2];
        parts.push(add("text", { x: z[0] + unit, y: -z[1] - unit, class: "link-name", "font-size": 3 * unit }, name));
      }
    }
    for (const [name, z] of Object.entries(draft.points)) {
      const fixed = draft.fixed.includes(name);
      if (fixed) parts.push(add("path", { d: `M${z[0]} ${-z[1]}l${-2 * unit} ${3 * unit}h${4 * unit}z`, class: "foot" }));
      parts.push(add("circle", { cx: z[0], cy: -z[1], r: 1.1 * unit, class: "joint" }));
      parts.push(add("text", { x: z[0] + 1.6 * unit, y: -z[1] - 1.6 * unit, "font-size": 3.4 * unit, class: "point-name" }, name));
    }
    board.replaceChildren(...parts);
  };
  ask();
  draw();
  return {
    /** Shows what there is; `freedom` is the sentence about its mobility. */
    show(now, freedom) {
      const changed = JSON.stringify(now) !== JSON.stringify(draft);
      draft = now;
      count.textContent = freedom ?? "";
      draw();
      if (changed) ask();
    },
  };
}

// The figures: shown at the width there is, points that can be pulled by mouse, finger or keys.
import { button, figureOf, h } from "./dom.js";

const MM = 96 / 25.4;

/** Shows figures in `parent`; `pull(point, place, how)` is told where a point is pulled to. */
export function figureBoard(parent, { word, pull, name, again }) {
  const shown = new Map(); // figure -> { section, port, zoom, anchor }
  let last = null; // what the server told last
  let held = null; // the point in the hand
  let step = null; // of the construction: what comes after it is faded

  const anchorOf = (figure, svg) => {
    const fixed = last ? Object.entries(last.points).filter(([, p]) => p.pull === "frame").map(([n]) => n) : [];
    const ids = figure === "mechanism" ? fixed.filter((n) => n !== held?.point).map((n) => `point-${n}`) : [`pole-${figure}`];
    for (const id of ids) {
      const element = svg.querySelector(`[id="${id}"]`);
      if (!element) continue;
      const box = element.getBBox();
      return { id, x: box.x + box.width / 2, y: box.y + box.height / 2 };
    }
    return null;
  };

  const make = (figure) => {
    const port = h("div.port");
    const section = h("section.figure", { "aria-label": name(figure), "data-figure": figure }, 
      h("div.row", {}, h("h2", {}, name(figure)), button(word("enlarge"), (event) => {
        const wide = section.classList.toggle("wide");
        event.target.setAttribute("aria-pressed", wide);
        again();
      }, { "aria-pressed": "false" })), port);
    parent.append(section);
    return { section, port, zoom: MM, anchor: null };
  };

  /** Lays a figure into its place; null where it is no drawing but words. */
  const put = (figure, text) => {
    if (!shown.has(figure)) shown.set(figure, make(figure));
    const one = shown.get(figure);
    const svg = figureOf(text);
    one.port.replaceChildren(svg);
    if (svg.nodeName !== "svg") {
      one.port.style.height = "";
      return null;
    }
    const [, , width, height] = svg.getAttribute("viewBox").split(" ").map(Number);
    return { figure, one, svg, width, height };
  };

  /** At rest a figure fills the width there is. */
  const fill = ({ figure, one, svg, width, height }) => {
    one.zoom = Math.min(one.port.clientWidth / width, 2.2 * MM) || MM;
    one.port.style.height = `${height * one.zoom}px`;
    svg.setAttribute("width", width * one.zoom);
    svg.setAttribute("height", height * one.zoom);
    one.anchor = anchorOf(figure, svg);
    if (figure === "mechanism") makePulled(svg);
  };

  /** While a hand moves, the pole and the pivots stay where they were, as long as all of the figure is seen. */
  const keep = (figures) => {
    // all are measured before any is moved, so that the page is laid out once
    const measured = figures.map((it) => ({ ...it, anchor: anchorOf(it.figure, it.svg),
      roomWide: it.one.port.clientWidth, roomHigh: it.one.port.clientHeight }));
    const kept = (shift, long, room) => (long <= room ? Math.min(Math.max(shift, 0), room - long) : (room - long) / 2);
    for (const { figure, one, svg, width, height, anchor, roomWide, roomHigh } of measured) {
      const there = anchor && one.anchor && anchor.id === one.anchor.id;
      const less = Math.min(1, roomWide / (width * one.zoom), roomHigh / (height * one.zoom));
      const zoom = figure === "mechanism" || !there ? one.zoom : one.zoom * less;
      svg.setAttribute("width", width * zoom);
      svg.setAttribute("height", height * zoom);
      if (!there) continue;
      let [dx, dy] = [one.anchor.x * one.zoom - anchor.x * zoom, one.anchor.y * one.zoom - anchor.y * zoom];
      if (figure !== "mechanism") [dx, dy] = [kept(dx, width * zoom, roomWide), kept(dy, height * zoom, roomHigh)];
      svg.style.transform = `translate(${dx}px, ${dy}px)`;
    }
  };

  const makePulled = (svg) => {
    svg.setAttribute("role", "group");
    const found = Object.entries(last.points)
      .map(([point, at]) => [point, at, at.pull && svg.querySelector(`[id="point-${CSS.escape(point)}"]`)?.getBBox()])
      .filter(([, , box]) => box); // all are measured before anything is added, so that the page is laid out once
    for (const [point, at, box] of found) {
      const grip = document.createElementNS("http://www.w3.org/2000/svg", "circle");
      const looks = { cx: box.x + box.width / 2, cy: box.y + box.height / 2, r: 4.5, class: `grip ${at.pull}`, tabindex: 0,
        role: "button", "data-point": point,
        "aria-label": `${word(`point ${at.pull}`)} ${point}: ${at.x.toPrecision(5)}, ${at.y.toPrecision(5)}` };
      for (const [key, value] of Object.entries(looks)) grip.setAttribute(key, value);
      svg.append(grip);
      if (held?.keys === point || (held?.point === point && held.focus)) grip.focus({ preventScroll: true });
    }
  };

  parent.addEventListener("pointerdown", (event) => {
    const point = event.target.getAttribute?.("data-point");
    if (!point || !last) return;
    event.preventDefault();
    const at = last.points[point];
    held = { point, x: event.clientX, y: event.clientY, from: { x: at.x, y: at.y }, moved: false, lengths: event.altKey || event.shiftKey,
      perPixel: last.perMm / shown.get("mechanism").zoom };
    parent.setPointerCapture(event.pointerId);
  });
  const placeOf = (event) => ({
    x: held.from.x + (event.clientX - held.x) * held.perPixel,
    y: held.from.y - (event.clientY - held.y) * held.perPixel,
  });
  parent.addEventListener("pointermove", (event) => {
    if (!held || held.keys) return;
    held.moved = true;
    pull(held.point, placeOf(event), { lengths: held.lengths, final: false });
  });
  const drop = (event) => {
    if (!held || held.keys) return;
    const { point, lengths, moved } = held;
    const place = placeOf(event);
    held = null;
    if (moved) pull(point, place, { lengths, final: true });
  };
  parent.addEventListener("pointerup", drop);
  parent.addEventListener("pointercancel", drop);
  parent.addEventListener("keydown", (event) => {
    const point = event.target.getAttribute?.("data-point");
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!point || !way || !last) return;
    event.preventDefault();
    const step = (event.ctrlKey ? 0.2 : 1) * (event.shiftKey ? 5 : 1) * last.perMm;
    const at = last.points[point];
    held = { keys: point };
    pull(point, { x: at.x + way[0] * step, y: at.y + way[1] * step }, { lengths: event.altKey, final: true });
  });
  document.addEventListener("focusin", (event) => {
    if (held?.keys && event.target.getAttribute("data-point") !== held.keys) held = null;
  });

  const fade = () => {
    for (const element of parent.querySelectorAll("[class*='step-']")) {
      const number = Number(/step-(\d+)/.exec(element.getAttribute("class"))[1]);
      element.classList.toggle("later", step !== null && number > step);
      element.classList.toggle("now", step !== null && number === step);
    }
  };

  return {
    /** Shows what the server told; `moving` keeps scale and place while a hand moves. */
    show(told, wanted, moving = false) {
      last = { ...last, ...told };
      for (const figure of shown.keys()) {
        const stays = wanted.some((name) => figure === name || figure.startsWith(`${name}-`));
        if (!stays || (!moving && !(figure in told.figures))) {
          shown.get(figure).section.remove();
          shown.delete(figure);
        }
      }
      const drawn = Object.entries(told.figures).map(([figure, svg]) => put(figure, svg)).filter((it) => it);
      if (moving) keep(drawn);
      else drawn.forEach(fill);
      const order = (figure) => wanted.indexOf(figure.replace(/-\d+$/, "")) + Number(/-(\d+)$/.exec(figure)?.[1] ?? 0) / 100;
      for (const figure of [...shown.keys()].sort((a, b) => order(a) - order(b))) {
        if (!moving && parent.lastElementChild !== shown.get(figure).section) parent.append(shown.get(figure).section);
      }
      if (held?.keys && !moving) {
        const grip = parent.querySelector(`[data-point="${CSS.escape(held.keys)}"]`);
        grip?.focus({ preventScroll: true });
      }
      fade();
    },
    get holding() {
      return held !== null && !held.keys;
    },
    /** Fades what comes after a step of the construction; none shows all. */
    upTo(number) {
      step = number;
      fade();
    },
  };
}

"use strict";
(async () => {
  const byId = (id) => document.getElementById(id);
  const unpack = async (text) => {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return JSON.parse(await new Response(stream).text());
  };
  const data = await unpack(byId("positions").textContent.trim());
  // by key the values of all positions, figures and steps by rows
  const columns = Object.entries(data.positions);
  const positions = data.positions.at.map((_, i) => Object.fromEntries(columns.map(([key, values]) =>
    [key, ["figures", "steps"].includes(key) ? values.map((row) => row[i]).filter(Boolean) : values[i]])));
  const [viewer, list, figures, live, tabs] = ["viewer", "list", "figures", "live", "tabs"].map(byId);
  const [stepInput, stepOut, placeInput, placeOut] = ["step", "step-out", "place", "place-out"].map(byId);
  const [results, given, paper] = ["results", "given", "paper"].map(byId);
  const LETTER = 12.1; // px of the smallest letters of a figure, a little more for rounding
  const printed = { paper: paper.innerHTML, results: results.innerHTML, given: given.innerHTML };
  let place = data.start;
  let step = 0; // index into the steps of the place

  const here = () => positions[place];
  const numberOf = (element) => {
    const found = element && /(?:^|\s)step-(\d+)(?:\s|$)/.exec(element.getAttribute("class"));
    return found ? Number(found[1]) : 0;
  };
  const parts = () => figures.querySelectorAll("[class*='step-']");
  const fill = (words, gaps) => words.replace(/\{(\w+)\}/g, (_, name) => gaps[name]);

  // a step of the list, by its number
  const itemOf = (number) => list.querySelector(`button[data-step="${number}"]`);

  function readable(root) {
    for (const svg of root.querySelectorAll("svg[viewBox]")) {
      const sizes = [...svg.querySelectorAll("[font-size]")].map((e) => Number(e.getAttribute("font-size")));
      if (sizes.length) svg.style.minWidth = `${(svg.viewBox.baseVal.width * LETTER) / Math.min(...sizes)}px`;
    }
  }

  function showPlace() {
    const now = here();
    const shown = now.figures.map((f) => `<figure id="figure-${f.name}"><div class="pane" tabindex="0" role="group"
      aria-label="${f.name}">${f.svg}</div><figcaption>${f.caption}</figcaption></figure>`);
    // the mechanism and its centres stand beside the polygons
    const [left, right] = [0, 1].map((side) =>
      shown.filter((_, i) => /velocity|acceleration|force|lever|cam-figure/.test(now.figures[i].name) === Boolean(side)).join(""));
    figures.innerHTML = `<div>${left}</div><div>${right}</div>`;
    for (const [i, f] of now.figures.entries()) {
      figures.querySelector(`#figure-${f.name} .pane`).setAttribute("aria-label", figures.querySelectorAll("figcaption")[i].textContent);
    }
    tabs.innerHTML = now.figures.map((f) => `<button type="button" data-figure="${f.name}">${f.caption.split("<span class=\"scale\"")[0]}</button>`).join("");
    list.innerHTML = now.stages.map((number, i) => {
      const stage = data.stages[number];
      const items = now.steps.filter((s) => s.e === i).map((s) =>
        `<li><button type="button" tabindex="-1" data-step="${s.n}"><b>${s.n}</b><span>${s.html}</span></button></li>`);
      return `<h3>${stage.title}</h3><div class="pane"${stage.svg && ' tabindex="0"'}>${stage.svg}</div><ol>${items.join("")}</ol>`;
    }).join("");
    readable(figures);
    readable(list);
    stepInput.max = now.steps.length;
    placeInput.value = place;
    placeInput.setAttribute("aria-valuetext", now.name);
    placeOut.innerHTML = now.label;
    const own = place === data.start;
    results.innerHTML = own || !now.results ? printed.results : now.results;
    given.innerHTML = own ? printed.given : now.given;
    paper.innerHTML = own ? printed.paper : onPaper(now);
    showStep(Math.min(step, now.steps.length - 1), false);
  }

  // the printed page of another position: its steps by equation, and each figure at true size
  function onPaper(now) {
    const bare = (svg) => svg.replace(/ id="[^"]*"/g, "");
    const of = (e) => now.steps.find((s) => s.e === e)?.d.replace("plan-", "");
    const last = (e) => e === now.stages.length - 1 || of(e + 1) !== of(e);
    const title = document.querySelector("h1").innerHTML;
    let count = 0;
    const printedFigure = ({ svg, caption }) => {
      count += 1;
      return `<figure>${bare(svg)}<figcaption>${fill(data.words.figure, { number: count, caption: "" })} ${caption}</figcaption></figure>`;
    };
    const stages = now.stages.map((number, e) => {
      const stage = data.stages[number], steps = now.steps.filter((s) => s.e === e);
      const own = last(e) ? now.figures.filter((f) => [of(e), `plan-${of(e)}`].includes(f.name)) : [];
      const items = steps.map((s) => `<li value="${s.n}">${s.html}</li>`).join("");
      return `<div class="together"><h2>${stage.title}</h2>${stage.svg ? `<figure class="equation">${bare(stage.svg)}</figure>` : ""}` +
        `<ol class="steps">${items}</ol></div>` +
        own.map(printedFigure).join("");
    });
    return `<h2>${title}</h2>${now.given}${stages.join("")}`;
  }

  function showStep(index, aloud = true) {
    const now = here();
    step = Math.max(0, Math.min(index, now.steps.length - 1));
    const current = now.steps[step];
    for (const part of parts()) {
      const number = numberOf(part);
      part.classList.toggle("later", number > current.n);
      part.classList.toggle("now", number === current.n);
      part.classList.toggle("past", number < current.n && Boolean(part.closest(`#figure-${current.d}`)));
    }
    // the polygon that is being drawn stands beside the mechanism
    activate(current.d);
    for (const button of list.querySelectorAll("button")) {
      const number = Number(button.dataset.step);
      button.classList.toggle("now", number === current.n);
      button.classList.toggle("later", number > current.n);
      button.tabIndex = number === current.n ? 0 : -1;
      if (number === current.n) {
        button.setAttribute("aria-current", "step");
        const box = list.getBoundingClientRect(), own = button.getBoundingClientRect();
        if (own.top < box.top || own.bottom > box.bottom) list.scrollTop += own.top - box.top - box.height / 3;
      } else {
        button.removeAttribute("aria-current");
      }
    }
    const count = fill(data.words.stepOf, { number: current.n, count: now.steps[now.steps.length - 1].n });
    stepInput.value = step + 1;
    stepInput.setAttribute("aria-valuetext", `${count}: ${current.text}`);
    stepOut.textContent = count;
    live.innerHTML = `<b>${current.n}</b> ${current.html}`;
    live.setAttribute("aria-live", aloud ? "polite" : "off");
    ask();
  }

  function activate(name) {
    for (const figure of figures.querySelectorAll("figure")) {
      const active = figure.id === `figure-${name}`;
      figure.classList.toggle("active", active);
      const drawn = active && figure.querySelector(".now");
      if (drawn) {
        const pane = figure.querySelector(".pane"), box = pane.getBoundingClientRect(), own = drawn.getBoundingClientRect();
        pane.scrollLeft += own.left + own.width / 2 - box.left - box.width / 2;
        pane.scrollTop += own.top + own.height / 2 - box.top - box.height / 2;
      }
    }
    for (const tab of tabs.children) tab.setAttribute("aria-pressed", String(tab.dataset.figure === name));
  }

  function nextEquation(way) {
    const steps = here().steps;
    const starts = steps.flatMap((s, i) => (i === 0 || s.e !== steps[i - 1].e ? [i] : []));
    const found = way > 0 ? starts.find((i) => i > step) : starts.filter((i) => i < step).pop();
    showStep(found ?? (way > 0 ? steps.length - 1 : 0));
  }

  function light(number) {
    for (const part of parts()) part.classList.toggle("lit", number > 0 && numberOf(part) === number);
    for (const button of list.querySelectorAll("button")) {
      button.classList.toggle("lit", Number(button.dataset.step) === number);
    }
  }

  // -- try first: the next step is hidden until it is found; what is tried stays in this page

  const trial = { on: false, hints: 0, form: byId("trial"), said: byId("trial-said") };
  const tried = new Map();
  const wanted = () => (trial.on ? here().steps[step + 1]?.find : undefined);
  const wayOf = (find) => (find.sense ? (find.sense > 0 ? data.words.ccw : data.words.cw) : `${String(find.angle).replace("-", "\u2212")}°`);

  function ask() {
    const find = wanted();
    document.documentElement.classList.toggle("trying", trial.on);
    trial.form.hidden = !find;
    trial.hints = 0;
    trial.said.innerHTML = "";
    if (!find) return;
    byId("trial-unit").innerHTML = `${find.name} (${find.unit})`;
    const before = tried.get(`${place}/${step}`) ?? ["", ""];
    [byId("trial-size").value, byId("trial-way").value] = before;
    trial.said.innerHTML = data.words.hidden;
  }

  function judge() {
    const find = wanted();
    const [size, way] = ["trial-size", "trial-way"].map((id) => byId(id).value.trim().replace("\u2212", "-"));
    tried.set(`${place}/${step}`, [size, way]);
    const number = Number(size.replace(",", "."));
    const sense = /^(ccw|counter|anti|逆|\+)/i.test(way) ? 1 : /^(cw|clock|顺|-$)/i.test(way) ? -1 : 0;
    const angle = Number(way.replace(/[°,]/g, (c) => (c === "," ? "." : "")));
    if (!size || !Number.isFinite(number) || (find.sense ? !sense : !way || !Number.isFinite(angle))) {
      return data.words.enter;
    }
    const room = data.room[find.symbol] ?? 0.03;
    if (Math.abs(Math.abs(number) - find.size) > room * find.size) return data.words.off;
    const turned = Math.abs(((angle - find.angle) % 360 + 540) % 360 - 180);
    if (find.sense ? sense !== find.sense : turned > Math.max(3, room * 57.3)) return data.words.turned;
    return "";
  }

  trial.form.addEventListener("submit", (event) => {
    event.preventDefault();
    const wrong = judge();
    if (wrong) {
      trial.said.textContent = wrong;
    } else {
      showStep(step + 1);
      trial.said.textContent = data.words.right;
      trial.form.hidden = !wanted();
    }
  });
  byId("trial-hint").addEventListener("click", () => {
    const find = wanted(), next = here().steps[step + 1];
    trial.hints = Math.min(3, trial.hints + 1);
    const title = list.querySelectorAll("h3")[next.e].textContent;
    const [least, most] = [0.9, 1.15].map((f) => Number((find.size * f).toPrecision(2)));
    const gaps = { equation: title, direction: wayOf(find), least, most };
    trial.said.textContent = fill(data.words[`hint${trial.hints}`], gaps);
  });
  byId("trial-show").addEventListener("click", () => showStep(step + 1));
  byId("try").addEventListener("change", (event) => { trial.on = event.target.checked; showStep(trial.on ? 0 : step); });

  const forward = () => (wanted() ? byId("trial-size").focus() : showStep(step + 1));
  const go = {
    first: () => showStep(0),
    previous: () => showStep(step - 1),
    next: forward,
    last: () => showStep(here().steps.length - 1),
    equation: () => nextEquation(1),
    back: () => nextEquation(-1),
  };
  const keys = {
    ArrowRight: "next", ArrowDown: "next", ArrowLeft: "previous", ArrowUp: "previous",
    Home: "first", End: "last", PageDown: "equation", PageUp: "back", "]": "equation", "[": "back",
  };

  document.addEventListener("keydown", (event) => {
    const typing = trial.form.contains(event.target) || event.target === placeInput || event.target.id === "turn";
    if (event.altKey || event.ctrlKey || event.metaKey || typing) return;
    if (event.key === " " && !/^(BUTTON|INPUT)$/.test(event.target.tagName) && !byId("play").hidden) {
      event.preventDefault();
      byId("play").click();
    }
    const name = keys[event.key];
    if (!name) return;
    // outside the viewer the keys that scroll a page keep doing so
    const inside = viewer.contains(event.target) || event.target === document.body;
    const pane = event.target.classList.contains("pane") && event.key.startsWith("Arrow");
    if (!inside || pane || (event.target === document.body && /Up$|Down$/.test(event.key) && event.key.startsWith("Arrow"))) return;
    event.preventDefault();
    go[name]();
    if (list.contains(event.target)) itemOf(here().steps[step].n).focus();
  });
  for (const button of viewer.querySelectorAll("[data-go]")) {
    button.addEventListener("click", () => go[button.dataset.go]());
  }
  tabs.addEventListener("click", (event) => {
    const tab = event.target.closest("button");
    if (tab) activate(tab.dataset.figure);
  });
  stepInput.addEventListener("input", () => showStep(Number(stepInput.value) - 1));
  placeInput.addEventListener("input", () => { place = Number(placeInput.value); showPlace(); follow(); });
  for (const area of [list, figures]) {
    const number = (event) => {
      const button = event.target.closest("button[data-step]");
      return button ? Number(button.dataset.step) : numberOf(event.target.closest("[class*='step-']"));
    };
    area.addEventListener("pointerover", (event) => light(number(event)));
    area.addEventListener("pointerleave", () => light(0));
    area.addEventListener("focusin", (event) => light(number(event)));
    area.addEventListener("focusout", () => light(0));
    area.addEventListener("click", (event) => {
      const index = here().steps.findIndex((s) => s.n === number(event));
      if (index >= 0) showStep(index);
    });
  }

  // -- motion: places over the turn, joined; nothing is computed here

  const m = data.moving;
  const SVG = document.querySelector("svg").namespaceURI;
  let frame = 0;
  let playing = 0;
  const draws = [];
  const names = new Map();
  const SIDES = [[1, -1], [-1, -1], [1, 1], [-1, 1], [0, -1], [0, 1], [1, 0], [-1, 0]];
  const at = (track, k) => (track < 0 ? [0, 0] : [m.tracks[track][2 * k], m.tracks[track][2 * k + 1]]);

  function shape(parent, name, attributes) {
    const made = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    parent.append(made);
    return made;
  }

  function panel(label, tracks, pole) {
    const xs = [], ys = [];
    for (const t of tracks) m.tracks[t].forEach((v, i) => v !== null && (i % 2 ? ys : xs).push(v));
    if (pole) { xs.push(0); ys.push(0); }
    const [left, right, top, bottom] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
    const room = 0.08 * Math.max(right - left, bottom - top, 1);
    const figure = document.createElement("figure");
    const caption = document.createElement("figcaption");
    caption.textContent = label;
    byId("moving").append(figure);
    const svg = shape(figure, "svg", { role: "img", "data-name": label,
      viewBox: `${left - room} ${top - room} ${right - left + 2 * room} ${bottom - top + 2 * room}` });
    figure.append(caption);
    return svg;
  }

  function line(svg, a, b, kind) {
    const made = shape(svg, "line", { class: kind });
    draws.push((k) => {
      const [p, q] = [at(a, k), at(b, k)];
      made.classList.toggle("away", p[0] === null || q[0] === null);
      if (p[0] === null || q[0] === null) return;
      made.setAttribute("x1", p[0]); made.setAttribute("y1", p[1]);
      made.setAttribute("x2", q[0]); made.setAttribute("y2", q[1]);
    });
  }

  function dot(svg, track, name, kind, size) {
    const group = shape(svg, "g", { class: kind });
    shape(group, "circle", { r: size });
    const text = shape(group, "text", {});
    text.textContent = name.replace(/[_{}]/g, "");
    draws.push((k) => {
      const p = at(track, k);
      group.classList.toggle("away", p[0] === null);
      if (p[0] !== null) group.setAttribute("transform", `translate(${p[0]} ${p[1]})`);
    });
    const own = { text, place: () => at(track, frame), off: 1.6 * size, wide: 0, high: 0, side: 0, last: kind === "centre" };
    const page = svg.ownerSVGElement ?? svg;
    names.set(page, [...(names.get(page) ?? []), own].sort((one, other) => one.last - other.last));
  }

  // names beside their points, clear of each other and of the edge: where they were, else on another side; points
  // before centres, and what finds no room waits
  function placeNames(svg) {
    const page = svg.viewBox.baseVal, taken = [];
    for (const name of names.get(svg) ?? []) {
      const [x, y] = name.place();
      if (x === null || !name.wide) continue;
      const boxes = SIDES.map(([right, down]) => {
        const left = x + right * name.off - (1 - right) / 2 * name.wide;
        const low = y + down * name.off + (0.225 + 0.475 * down) * name.high;
        return [left, low - 0.7 * name.high, left + name.wide, low + 0.25 * name.high, low];
      });
      const free = boxes.map((_, i) => (name.side + i) % boxes.length).find((side) => {
        const [a, b, c, d] = boxes[side];
        return a >= page.x && b >= page.y && c <= page.x + page.width && d <= page.y + page.height
          && !taken.some((o) => a < o[2] + 0.2 * name.high && o[0] < c + 0.2 * name.high && b < o[3] && o[1] < d);
      });
      name.text.classList.toggle("away", free === undefined);
      if (free === undefined) continue;
      name.side = free;
      taken.push(boxes[free]);
      name.text.setAttribute("x", boxes[free][0] - x);
      name.text.setAttribute("y", boxes[free][4] - y);
    }
  }

  function setUp() {
    if (!m.at) return;
    byId("motion").hidden = false;
    byId("play").hidden = false;
    byId("turn").max = m.at.length - 1;
    const moving = [...m.points.map(([t]) => t)];
    const main = panel(data.words.mechanism, moving, false);
    const unit = main.viewBox.baseVal.width / 160;
    const traces = shape(main, "g", { class: "traces" });
    for (const [track] of m.points) {
      if (m.fixed.includes(track)) continue;
      const pairs = m.at.map((_, k) => at(track, k).join(" "));
      shape(traces, "polyline", { points: pairs.join(" ") });
    }
    const paths = shape(main, "g", { class: "centre-paths" });
    for (const [track] of m.centres) {
      const runs = [[]];
      for (let k = 0; k < m.at.length; k += 1) {
        const p = at(track, k);
        if (p[0] === null) runs.push([]);
        else runs[runs.length - 1].push(p.join(" "));
      }
      for (const run of runs) if (run.length > 1) shape(paths, "polyline", { points: run.join(" ") });
    }
    for (const [a, b] of m.lines) line(main, a, b, "guide");
    for (const [link, ...own] of m.bars) {
      for (let i = 0; i < own.length - (own.length < 3 ? 1 : 0); i += 1) {
        line(main, own[i], own[(i + 1) % own.length], `bar link-${link % 6}`);
      }
    }
    const poles = shape(main, "g", { class: "poles" });
    for (const [track, name] of m.centres) dot(poles, track, name, "centre", 0.9 * unit);
    for (const [track, name] of m.points) dot(main, track, name, m.fixed.includes(track) ? "pivot fixed" : "pivot", 1.2 * unit);
    for (const diagram of ["velocity", "acceleration"]) {
      const own = m[diagram];
      if (!own.vectors.length) continue;
      const svg = panel(data.words[diagram], own.ends.map(([t]) => t), true);
      const size = svg.viewBox.baseVal.width / 160;
      for (const [a, b] of own.vectors) line(svg, a, b, a < 0 ? "vector" : "vector relative");
      for (const [track, name] of own.ends) dot(svg, track, name, "end", 0.8 * size);
      shape(svg, "circle", { class: "pole", r: 1.2 * size });
    }
    showFrame(0);
    letters();
    window.addEventListener("resize", letters);
  }

  // letters of 12 px, however wide the figures are
  function letters() {
    for (const svg of byId("moving").querySelectorAll("svg")) {
      const scale = svg.getClientRects().length ? svg.getScreenCTM().a : 0;
      const size = scale ? 13 / scale : 4;
      for (const name of names.get(svg) ?? []) {
        name.text.classList.remove("away");
        name.text.setAttribute("font-size", size);
        [name.wide, name.high] = [scale ? name.text.getComputedTextLength() : 0, size];
      }
      placeNames(svg);
    }
  }

  function showFrame(k) {
    frame = k;
    for (const draw of draws) draw(k);
    byId("turn").value = k;
    const at = `${m.driver.replace(/[_{}]/g, "")} = ${String(m.at[k]).replace("-", "\u2212")}${m.unit}`;
    byId("turn-out").textContent = at;
    for (const svg of byId("moving").querySelectorAll("svg")) {
      svg.setAttribute("aria-label", `${svg.dataset.name}. ${at}`);
      placeNames(svg);
    }
  }

  const apart = (a, b) => (m.unit === "°" ? Math.abs(((a - b) % 360 + 540) % 360 - 180) : Math.abs(a - b));
  const nearest = (values, value) => values.reduce((best, v, i) => (apart(v, value) < apart(values[best], value) ? i : best), 0);
  function follow() {
    if (m.at) showFrame(nearest(m.at, here().at));
  }
  function settle() {
    const near = nearest(positions.map((p) => p.at), m.at[frame]);
    if (near !== place) { place = near; showPlace(); }
  }

  function play(on) {
    cancelAnimationFrame(playing);
    playing = 0;
    byId("play").setAttribute("aria-pressed", String(on));
    byId("play").textContent = on ? data.words.pause : data.words.play;
    if (!on) { settle(); return; }
    let last = 0;
    const tick = (now) => {
      if (now - last > 80) { last = now; showFrame((frame + 1) % m.at.length); }
      playing = requestAnimationFrame(tick);
    };
    playing = requestAnimationFrame(tick);
  }
  byId("play").addEventListener("click", () => play(!playing));
  byId("turn").addEventListener("input", () => { if (playing) play(false); showFrame(Number(byId("turn").value)); settle(); });
  for (const [id, kind] of [["traces", "no-traces"], ["poles", "no-poles"], ["centre-paths", "no-centre-paths"]]) {
    byId(id).addEventListener("change", (event) => {
      byId("moving").classList.toggle(kind, !event.target.checked);
      letters();
    });
  }

  document.documentElement.classList.add("scripted");
  viewer.hidden = false;
  placeInput.max = positions.length - 1;
  setUp();
  showPlace();
  follow();
  document.documentElement.classList.add("ready");
})();

// The page: text, form and figures of one scene, each following the others.
import { builder } from "./build.js";
import { button, choice, download, figureOf, h, sentence } from "./dom.js";
import { textEditor } from "./editor.js";
import { figureBoard } from "./figures.js";
import { sceneForm } from "./form.js";
import { newestOnly, overSockets, overWidget } from "./talk.js";

const FIRST = ["mechanism", "velocity", "acceleration"];
const STORE = "graphkin-board";

/** Puts the board into `root`.  `send(question, long)` asks Python; `kept` remembers the work, by itself as long as the
    page lives. */
export async function mount(root, send, { kept = memory(), nonce = "", wrote = () => {} } = {}) {
  const before = kept.read();
  const state = {
    name: "", text: "", mark: "", own: false, at: null, language: before.language ?? (root.dataset.language || navigator.language.slice(0, 2)),
    convention: before.convention ?? "", instrument: "exact", figures: before.figures ?? FIRST, find: "", playing: false, step: null,
  };
  const ask = (question, long) => send({ language: state.language, ...question }, long);
  let names = await ask({ do: "names" });
  state.language = names.language;
  const word = (key) => names.words[key] ?? key;
  let last = null; // the last whole answer
  root.classList.add("graphkin-board");

  // -- asking -------------------------------------------------------------------------------------------------------
  const wishes = () => ({
    text: state.text, name: state.name, at: state.at, language: state.language, convention: state.convention, instrument: state.instrument,
    figures: state.figures, seed: 0,
  });
  const asked = newestOnly(ask, (told, about, more) => heard(told, about, more));
  const show = (extra = {}) => asked({ do: "show", ...wishes(), ...extra }, { text: state.text, moving: Boolean(extra.quick) });
  let resting = null;
  const rest = (after = 250) => {
    clearTimeout(resting);
    resting = setTimeout(() => show(), after);
  };

  const heard = (told, about, more) => {
    if (about.text !== state.text && !about.moving) return;
    if (!told.ok) {
      problems(told.problems);
      sketch.show(told.draft ?? { points: {}, fixed: [], links: {}, guides: [] }, told.mobility ?? "");
      if (told.form) form.show(told.form);
      if (about.letGo) rest(0);
      return;
    }
    if (told.text !== undefined && told.text !== state.text) editor.put(told.text);
    problems([]);
    if (about.drives || about.moving || state.at) state.at = told.at;
    figures.show(told, state.figures, about.moving);
    drive.show(told, more);
    limit.textContent = told.limit ?? "";
    if (about.moving) {
      form.follow(told.changes);
      return;
    }
    last = told;
    whole(told);
  };

  const whole = (told) => {
    form.show(told.form);
    const spots = Object.fromEntries(Object.entries(told.points).map(([p, z]) => [p, [z.x, z.y]]));
    sketch.show({ ...draftOf(told.form, spots) }, told.mobility);
    title.textContent = told.title;
    freedom.textContent = told.mobility;
    verdict.textContent = word(told.agrees ? "agrees" : "differs");
    verdict.className = told.agrees ? "agrees" : "differs";
    readings.replaceChildren(...told.readings.map(([symbol, mm, measured, exact, ok]) =>
      h("tr", {}, h("th", { scope: "row" }, symbol), ...[mm, measured, exact].map((cell) => h("td", {}, cell)), h("td", {}, word(ok === null ? "undetermined" : ok ? "yes" : "no")))));
    steps.replaceChildren(...told.steps.map((one) => h("li", { value: one.n },
      h("button", { type: "button", "data-step": one.n, onclick: () => toStep(state.step === one.n ? null : one.n) }, sentence(one.html)),
      ...one.work.map((line) => h("div", {}, sentence(line))))));
    toStep(state.step);
  };

  const draftOf = (made, spots) => {
    const links = Object.fromEntries(Object.entries(made.links ?? {}).map(([name, link]) => {
      const own = [...(link.points ?? []), ...Object.keys(link.at ?? {})].filter((p) => p in spots);
      return [name, { points: own, block: "on" in link && own.length < 2 }];
    }));
    const guides = Object.values(made.frame?.guides ?? {}).map((guide) => ({
      through: typeof guide.through === "string" ? (spots[guide.through] ?? [0, 0]) : guide.through, angle: guide.angle ?? 0 }));
    return { points: spots, fixed: Object.keys(made.frame?.points ?? {}), links, guides };
  };

  const atLine = ({ line, text }) => {
    const place = word("line").replace("{line}", line);
    return text.startsWith(place) ? text : place + text;
  };
  const problems = (found) => {
    editor.problems(found);
    list.replaceChildren(...found.map((one) => h("li", {}, one.line ? button(atLine(one), () => { tab("text"); editor.goTo(one.line); }) : one.text)));
    if (found.length) {
      verdict.textContent = area.childElementCount ? word("stays") : "";
      verdict.className = "differs";
    }
  };

  const changed = (text, outside) => {
    state.text = text;
    state.dirty = true;
    saying.textContent = "";
    keep();
    wrote(text);
    saveButton.disabled = false;
    if (outside) return;
    rest(150);
  };
  const keep = () => kept.write({ text: state.text, name: state.name, mark: state.mark, own: state.own, language: state.language,
    convention: state.convention, figures: state.figures, at: state.at, dirty: state.dirty });
  const edit = async (question) => {
    const told = await ask({ ...question, ...wishes(), ...question });
    if (!told.ok) {
      problems(told.problems);
      return false;
    }
    editor.put(told.text);
    show();
    return true;
  };

  // -- what there is to see -----------------------------------------------------------------------------------------
  const title = h("h1", {}, "graphkin");
  const fileName = h("span.file");
  const verdict = h("span", { role: "status", "aria-live": "polite" });
  const freedom = h("span.freedom");
  const limit = h("p.told", { role: "status", "aria-live": "polite" });
  const saying = h("p.told", { role: "status", "aria-live": "polite" }); // of saving, until the text changes
  const list = h("ul.problems", { "aria-live": "assertive" });
  const saveButton = button(word("save"), () => save());
  const gone = h("span.differs", { role: "alert" });
  const header = h("header", {}, title, fileName,
    button(word("scenes"), () => wall.open()), button(word("undo"), () => editor.undo(), { title: "Ctrl+Z" }), button(word("redo"), () => editor.redo(), { title: "Ctrl+Y" }),
    saveButton, button(word("out"), () => out.open()), h("span.room"), gone,
    choice(word("language"), Object.keys(names.languages), state.language, (value) => speak(value), names.languages),
    choice(word("convention"), ["", "chinese", "us", "british", "russian"], state.convention, (value) => { state.convention = value; keep(); show(); }, { "": word("of scene"), chinese: word("chinese"), us: word("us"), british: word("british"), russian: word("russian") }),
    choice(word("instrument"), ["exact", "cad", "pencil"], state.instrument, (value) => { state.instrument = value; show(); }, { exact: word("exact"), cad: word("cad"), pencil: word("pencil") }));

  const tabs = {};
  const tabBar = h("div.tabs", { role: "tablist" });
  const tab = (chosen) => {
    for (const [key, { bar, panel }] of Object.entries(tabs)) {
      bar.setAttribute("aria-selected", key === chosen);
      bar.tabIndex = key === chosen ? 0 : -1;
      panel.hidden = key !== chosen;
    }
  };
  for (const key of ["text", "form", "build"]) {
    const panel = h("div", { role: "tabpanel", "aria-label": word(key), hidden: true });
    const bar = h("button", { type: "button", role: "tab", onclick: () => tab(key), "data-tab": key }, word(key));
    tabs[key] = { bar, panel };
    tabBar.append(bar);
  }
  tabBar.addEventListener("keydown", (event) => {
    const way = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!way) return;
    const keys = Object.keys(tabs);
    const next = keys[(keys.findIndex((key) => tabs[key].bar === document.activeElement) + way + keys.length) % keys.length];
    tab(next);
    tabs[next].bar.focus();
  });
  const left = h("div.left", {}, tabBar, list, ...Object.values(tabs).map((one) => one.panel));
  const editor = textEditor(tabs.text.panel, {
    changed, nonce, label: word("text of scene"),
    complete: async (text, line, column) => (await ask({ do: "complete", text, line, column })).options ?? [],
  });
  const form = sceneForm(tabs.form.panel, { word, change: (changes) => edit({ do: "change", changes }) });
  const sketch = builder(tabs.build.panel, { word, build: (step) => edit({ do: "build", step }) });

  const area = h("div.figures");
  const pull = (point, to, { lengths, final }) => asked(
    { do: "pull", ...wishes(), point, x: to.x, y: to.y, lengths, final, quick: !final, scales: final ? null : last?.scales },
    { text: state.text, moving: !final, letGo: final, drives: last?.points[point]?.pull === "driver" && !lengths });
  const figures = figureBoard(area, { word, pull, name: (figure) => word(`figure ${figure.replace(/-\d+$/, "")}`),
    again: () => last && figures.show(last, state.figures) });

  // the driver: by slider, number, keys, playing
  const slider = h("input", { type: "range", min: 0, max: 360, step: "any", "aria-label": word("driver"), "data-driver": "" });
  const value = h("input", { type: "number", step: "any", "aria-label": word("driver value") });
  const playButton = button(word("play"), () => play(), { "aria-pressed": "false" });
  const drive = {
    key: "", low: 0, high: 360, turns: true, sense: 1, held: false,
    show(told, more) {
      if (told.drivers) {
        [[this.key, this.sense]] = told.drivers.map((one) => [one.key, one.sense]);
        Object.assign(this, { low: told.range.low ?? 0, high: told.range.high ?? 360, turns: told.range.turns });
        [slider.min, slider.max] = [this.low, this.high];
        slider.step = (this.high - this.low) / 720 || "any";
        slider.title = told.range.why ?? "";
      }
      const now = told.at[this.key];
      if (now === undefined || more) return;
      if (!this.held) slider.value = this.turns ? ((now % 360) + 360) % 360 : now;
      const rounded = Math.abs(now) < 1e-9 * (this.high - this.low) ? 0 : Number(now.toPrecision(7));
      if (told.drivers || document.activeElement !== value) value.value = rounded;
    },
    to(now, quick) {
      if (!Number.isFinite(now) || !last) return;
      state.at = { ...(state.at ?? last?.at ?? {}), [this.key]: now };
      asked({ do: "show", ...wishes(), quick, scales: quick ? last?.scales : null }, { text: state.text, moving: quick, drives: true });
    },
  };
  slider.addEventListener("input", () => {
    drive.held = true;
    drive.to(Number(slider.value), true);
  });
  const letGo = () => {
    if (drive.held) drive.to(Number(slider.value), false);
    drive.held = false;
  };
  // a slider that comes back to where it was taken changes nothing for the browser
  for (const end of ["change", "pointerup", "pointercancel"]) slider.addEventListener(end, letGo);
  value.addEventListener("change", () => drive.to(value.valueAsNumber, false)); // an emptied field gives no value
  const play = () => {
    if (!last) return undefined;
    state.playing = !state.playing;
    playButton.setAttribute("aria-pressed", state.playing);
    playButton.textContent = word(state.playing ? "stop" : "play");
    if (!state.playing) return show();
    let then = performance.now();
    let { sense } = drive; // that of omega, until the motion ends
    const tick = (time) => {
      if (!state.playing) return;
      const turn = ((drive.high - drive.low) / 6000) * Math.min(time - then, 100) * sense;
      then = time;
      let now = (state.at ?? last.at)[drive.key] + turn;
      if (!drive.turns && (now > drive.high || now < drive.low)) {
        sense = -sense;
        now = Math.min(Math.max(now, drive.low), drive.high);
      }
      drive.to(now, true);
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  };
  const keys = root.parentElement === document.body ? document.body : root; // also where nothing on the page has the focus
  keys.onkeydown = (event) => { // in another language the page is mounted anew: each key is heard once
    if (event.key === " " && (event.target === document.body || event.target === slider)) {
      event.preventDefault();
      play();
    }
    if (event.key === "s" && (event.ctrlKey || event.metaKey)) {
      event.preventDefault();
      save();
    }
  };
  const driveBar = h("div.drive", {}, h("label", {}, word("driver")), slider, value, playButton,
    button(word("own position"), () => { state.at = null; show(); }), button(word("keep position"), () => edit({ do: "keep" })), freedom, verdict);

  const wishBar = h("div.wishes", { role: "group", "aria-label": word("figures") });
  for (const figure of names.figures) {
    const box = h("input", { type: "checkbox", checked: state.figures.includes(figure), "data-figure": figure, onchange: () => {
      state.figures = names.figures.filter((one) => wishBar.querySelector(`[data-figure="${one}"]`).checked);
      keep();
      show();
    } });
    wishBar.append(h("label", {}, box, h("span", {}, word(`figure ${figure}`))));
  }

  const readings = h("tbody");
  const steps = h("ol.steps");
  const toStep = (number) => {
    state.step = number;
    for (const one of steps.querySelectorAll("button")) one.toggleAttribute("aria-current", Number(one.dataset.step) === number);
    figures.upTo(number);
  };
  const along = (way) => {
    const all = [...steps.querySelectorAll("button")].map((one) => Number(one.dataset.step));
    const here = all.indexOf(state.step);
    const next = state.step === null ? (way > 0 ? 0 : all.length - 1) : here + way;
    toStep(all[next] ?? null);
  };
  const charts = h("div.charts");
  const chart = async (question, control) => {
    control.disabled = true;
    charts.replaceChildren(h("p", { role: "status" }, word("working")));
    const told = await ask({ ...wishes(), ...question }, true);
    control.disabled = false;
    if (!told.ok) return charts.replaceChildren(...told.problems.map((one) => h("p.differs", {}, one.text)));
    return charts.replaceChildren(...Object.entries(told.figures).map(([name, svg]) =>
      h("img", { src: `data:image/svg+xml;base64,${btoa(String.fromCharCode(...new TextEncoder().encode(svg)))}`, alt: name })));
  };
  const find = h("input", { type: "text", placeholder: "v_C, omega_3", "aria-label": word("asked") });
  const diagramButton = button(word("diagrams"), () => chart({ do: "diagrams", find: find.value.split(/[,\s]+/).filter(Boolean) }, diagramButton));
  const raceButton = button(word("race"), () => chart({ do: "race" }, raceButton));
  const right = h("div.right", {}, wishBar, driveBar, limit, saying, area,
    h("details", { open: true }, h("summary", {}, word("readings")), h("div.scroll", { tabindex: 0, role: "region", "aria-label": word("readings") },
      h("table", {}, h("thead", {}, h("tr", {}, ...["symbol", "on paper", "measured", "exact value", "agree"].map((key) => h("th", { scope: "col" }, word(key))))), readings))),
    h("details", {}, h("summary", {}, word("steps")), h("div.row", {}, button(word("back"), () => along(-1)), button(word("next"), () => along(1)), button(word("all"), () => toStep(null))), steps),
    h("details", {}, h("summary", {}, word("charts")), h("div.row", {}, find, diagramButton, raceButton), charts));

  // -- scenes, saving, handing out ----------------------------------------------------------------------------------
  const take = (told, put = editor.open) => {
    if (state.playing) play();
    last = null;
    Object.assign(state, { name: told.name, mark: told.mark, own: told.own, at: null, step: null, dirty: false });
    fileName.textContent = told.name + (told.own ? "" : told.name ? ` (${word("comes along")})` : "");
    put(told.text);
    state.text = told.text;
    state.dirty = false;
    saveButton.disabled = true;
    keep();
    show();
  };
  const opened = async (question, put) => {
    const told = await ask({ do: "open", ...question });
    if (!told.ok) return problems(told.problems);
    return take(told, put);
  };
  const dialog = (label, fill) => {
    const box = h("dialog", { "aria-label": label });
    root.append(box);
    const close = () => box.close();
    return { box, close, async open() {
      box.replaceChildren(h("div.row", {}, h("h2", {}, label), h("span.room"), button(word("close"), close)), ...(await fill(close)));
      box.showModal();
    } };
  };
  const wall = dialog(word("choose scene"), async (close) => {
    const told = await ask({ do: "shelf" });
    const pick = (question) => { close(); opened(question); };
    const link = h("input", { type: "text", placeholder: "graphkin:...", "aria-label": word("scene link") });
    const cards = told.scenes.map((one) => {
      const picture = h("div.picture", { "aria-hidden": "true" });
      const card = h("button", { type: "button", "data-scene": one.name, onclick: () => pick({ name: one.name }) }, picture, h("span", {}, one.name));
      card.wanted = async () => {
        const drawn = await ask({ do: "thumbnail", name: one.name, language: state.language }, true);
        if (drawn.ok) {
          picture.append(figureOf(drawn.svg));
          card.append(h("small", {}, drawn.title));
        }
      };
      return card;
    });
    const seen = new IntersectionObserver((entries) => entries.filter((one) => one.isIntersecting).forEach((one) => {
      seen.unobserve(one.target);
      one.target.wanted();
    }));
    cards.forEach((card) => seen.observe(card));
    return [
      h("div.row", {}, h("span", {}, word("new")), button(word("empty"), () => { pick({ new: "empty" }); tab("build"); }, { "data-new": "empty" }),
        ...told.new.map((kind) => button(kind, () => pick({ new: kind }), { "data-new": kind }))),
      h("div.row", {}, h("label", {}, word("scene link")), link, button(word("open"), () => pick({ link: link.value }))),
      h("div.wall", {}, ...cards),
    ];
  });
  const save = async () => {
    let { name, mark } = state;
    if (!state.own) {
      const shelf = await ask({ do: "shelf" });
      if (!shelf.writes || shelf.only) return download(name.endsWith(".toml") ? name : `${name || "scene"}.toml`, "application/toml", state.text);
      name = window.prompt(word("save as"), name && !name.endsWith(".toml") ? `${name}.toml` : name || "mechanism.toml");
      if (!name) return undefined;
      mark = "";
    } else if (!state.asked && !window.confirm(`${word("may write")} ${name}? ${word("kept copy")} ${name}~`)) return undefined;
    state.asked = true;
    const told = await ask({ do: "save", name, text: state.text, mark });
    if (!told.ok) { // the scene is as right as it was
      saying.textContent = told.problems.map((one) => one.text).join(" ");
      return undefined;
    }
    Object.assign(state, { name, mark: told.mark, own: true, dirty: false });
    fileName.textContent = name;
    saveButton.disabled = true;
    saying.textContent = `${word("saved")} ${name}`;
    return keep();
  };
  const out = dialog(word("out"), async (close) => {
    const figure = h("select", { "aria-label": word("figure") }, ...names.figures.map((one) => h("option", { value: one, selected: one === "sheet" }, word(`figure ${one}`))));
    const count = h("input", { type: "number", min: 1, max: 60, value: 5, "aria-label": word("variants") });
    const line = h("p", { role: "status" });
    const carried = h("textarea", { readOnly: true, "aria-label": word("scene link") });
    const send = async (question) => {
      line.textContent = word("working");
      const told = await ask({ ...wishes(), do: "export", ...question }, true);
      line.textContent = told.ok ? `${word("done")} ${told.name}` : told.problems.map((one) => one.text).join("\n");
      if (told.ok) download(told.name, told.type, Uint8Array.from(atob(told.data), (c) => c.charCodeAt(0)));
    };
    ask({ do: "link", text: state.text }).then((told) => { carried.value = told.link ?? ""; });
    return [
      h("div.row", {}, figure, ...["svg", "pdf", "png", "dxf"].map((kind) => button(kind.toUpperCase(), () => send({ kind, figures: [figure.value] }), { "data-out": kind }))),
      h("div.row", {}, button(word("papers"), () => send({ kind: "papers" }), { "data-out": "papers" }), button(word("variants"), () => send({ kind: "variants", count: Number(count.value) }), { "data-out": "variants" }), count,
        button(word("scene file"), () => send({ kind: "scene" }), { "data-out": "scene" })),
      h("label", {}, word("link carries")), carried, line,
    ];
  });

  const speak = async (language) => {
    state.playing = false;
    state.language = language;
    keep();
    root.replaceChildren();
    await mount(root, send, { kept, nonce, wrote });
  };

  // what somebody else changes in the file is said, not taken
  const look = async () => {
    if (!state.own || document.hidden) return;
    const told = await ask({ do: "watch", name: state.name, mark: state.mark });
    if (!told.ok || told.changed === null) return;
    const theirs = told.changed;
    gone.replaceChildren(word("changed elsewhere"), " ", button(word("take theirs"), () => { gone.replaceChildren(); opened({ name: state.name }, editor.put); }),
      button(word("keep mine"), async () => {
        const now = await ask({ do: "open", name: state.name });
        if (now.ok) state.mark = now.mark;
        state.dirty = true;
        saveButton.disabled = false;
        gone.replaceChildren();
      }));
    if (theirs === state.text) {
      const now = await ask({ do: "open", name: state.name });
      state.mark = now.mark;
      gone.replaceChildren();
    }
  };
  clearInterval(root.looking);
  root.looking = setInterval(look, 2000);
  root.connected = (open) => {
    if (!open) gone.textContent = word("server gone");
    else if (gone.textContent === word("server gone")) gone.textContent = "";
  };

  document.documentElement.lang = state.language;
  root.append(header, h("main", {}, left, right));
  tab("text");
  if (before.text?.trim() && (before.dirty || !before.name)) {
    Object.assign(state, { name: before.name, mark: before.mark, own: before.own, at: before.at });
    fileName.textContent = before.name;
    editor.open(before.text);
    show();
  } else if (before.name && before.text !== undefined) {
    await opened({ name: before.name });
    if (before.at) { state.at = before.at; show(); }
  } else {
    const told = await ask({ do: "open" });
    if (told.text) take(told);
    else wall.open();
  }
  root.board = { state, editor, show };
  let wide = area.clientWidth;
  new ResizeObserver(() => {
    if (area.clientWidth === wide) return;
    wide = area.clientWidth;
    clearTimeout(root.sized);
    root.sized = setTimeout(() => last && figures.show(last, state.figures), 150);
  }).observe(area);
}

function memory() {
  let kept = {};
  return { read: () => kept, write: (value) => { kept = value; } };
}

/** What a page remembers of its work, by its address: each tab of its own, a new tab of the last. */
function storage() {
  const key = `${STORE}:${location.pathname}`;
  return {
    read: () => {
      try {
        return JSON.parse(sessionStorage.getItem(key) ?? localStorage.getItem(key)) ?? {};
      } catch {
        return {};
      }
    },
    write: (value) => {
      try {
        for (const store of [sessionStorage, localStorage]) store.setItem(key, JSON.stringify(value));
      } catch { /* a full or forbidden store: the text is on the page all the same */ }
    },
  };
}

/** In a notebook: the widget's own element. */
function render({ model, el }) {
  const root = h("div");
  el.append(root);
  mount(root, overWidget(model), { wrote: (text) => { model.set("text", text); model.save_changes(); } });
}
export default { render };

const page = typeof document !== "undefined" && document.getElementById("board");
if (page) {
  const address = `${location.origin.replace("http", "ws")}${location.pathname}talk`;
  const ask = overSockets(address, (open) => page.connected?.(open));
  mount(page, ask, { kept: storage(), nonce: document.body.dataset.nonce });
}

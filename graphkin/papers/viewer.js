"use strict";
(() => {
  const data = JSON.parse(document.getElementById("positions").textContent);
  const byId = (id) => document.getElementById(id);
  const [viewer, list, figures, live] = ["viewer", "list", "figures", "live"].map(byId);
  const [stepInput, stepOut, placeInput, placeOut] = ["step", "step-out", "place", "place-out"].map(byId);
  let place = data.start;
  let step = 0; // index into the steps of the place

  const here = () => data.positions[place];
  const numberOf = (element) => {
    const found = element && /(?:^|\s)step-(\d+)(?:\s|$)/.exec(element.getAttribute("class"));
    return found ? Number(found[1]) : 0;
  };
  const parts = () => figures.querySelectorAll("[class*='step-']");
  const fill = (words, ...values) => words.replace(/\{(\d)\}/g, (_, i) => values[i]);

  // a step of the list, by its number
  const itemOf = (number) => list.querySelector(`button[data-step="${number}"]`);

  function showPlace() {
    const now = here();
    const shown = now.figures.map((f) =>
      `<figure id="figure-${f.name}">${f.svg}<figcaption>${f.caption}</figcaption></figure>`);
    // the mechanism and its centres stand beside the polygons
    const [left, right] = [0, 1].map((side) =>
      shown.filter((_, i) => /velocity|acceleration/.test(now.figures[i].name) === Boolean(side)).join(""));
    figures.innerHTML = `<div>${left}</div><div>${right}</div>`;
    list.innerHTML = now.stages.map((number, i) => {
      const stage = data.stages[number];
      const items = now.steps.filter((s) => s.e === i).map((s) =>
        `<li><button type="button" tabindex="-1" data-step="${s.n}"><b>${s.n}</b><span>${s.html}</span></button></li>`);
      return `<h3>${stage.title}</h3>${stage.svg}<ol>${items.join("")}</ol>`;
    }).join("");
    stepInput.max = now.steps.length;
    placeInput.value = place;
    placeInput.setAttribute("aria-valuetext", now.name);
    placeOut.innerHTML = now.label;
    showStep(Math.min(step, now.steps.length - 1), false);
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
    for (const figure of figures.querySelectorAll("figure")) {
      figure.classList.toggle("active", figure.id === `figure-${current.d}`);
    }
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
    const count = fill(data.words.stepOf, current.n, now.steps[now.steps.length - 1].n);
    stepInput.value = step + 1;
    stepInput.setAttribute("aria-valuetext", `${count}: ${current.text}`);
    stepOut.textContent = count;
    live.innerHTML = `<b>${current.n}</b> ${current.html}`;
    live.setAttribute("aria-live", aloud ? "polite" : "off");
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

  const go = {
    first: () => showStep(0),
    previous: () => showStep(step - 1),
    next: () => showStep(step + 1),
    last: () => showStep(here().steps.length - 1),
    equation: () => nextEquation(1),
    back: () => nextEquation(-1),
  };
  const keys = {
    ArrowRight: "next", ArrowDown: "next", ArrowLeft: "previous", ArrowUp: "previous",
    Home: "first", End: "last", PageDown: "equation", PageUp: "back", "]": "equation", "[": "back",
  };

  document.addEventListener("keydown", (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey || event.target === placeInput) return;
    const name = keys[event.key];
    if (!name) return;
    // outside the viewer the keys that scroll a page keep doing so
    const inside = viewer.contains(event.target) || event.target === document.body;
    if (!inside || (event.target === document.body && /Up$|Down$/.test(event.key) && event.key.startsWith("Arrow"))) return;
    event.preventDefault();
    go[name]();
    if (list.contains(event.target)) itemOf(here().steps[step].n).focus();
  });
  for (const button of viewer.querySelectorAll("[data-go]")) {
    button.addEventListener("click", () => go[button.dataset.go]());
  }
  stepInput.addEventListener("input", () => showStep(Number(stepInput.value) - 1));
  placeInput.addEventListener("input", () => { place = Number(placeInput.value); showPlace(); });
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
  document.documentElement.classList.add("scripted");
  viewer.hidden = false;
  placeInput.max = data.positions.length - 1;
  showPlace();
})();

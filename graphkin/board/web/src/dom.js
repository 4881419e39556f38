// Elements in short, and parts of pages that arrive as text.

/** An element: h("button.primary", { type: "button", onclick }, "Save"). */
export function h(name, attributes = {}, ...children) {
  const [tag, ...classes] = name.split(".");
  const made = document.createElement(tag);
  if (classes.length) made.className = classes.join(" ");
  for (const [key, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else if (key in made && typeof value !== "string") made[key] = value;
    else made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return made;
}

/** The element of a figure, which the server has made; what could run in it is left out. */
export function figureOf(svg) {
  const read = new DOMParser().parseFromString(withSpaces(svg), "image/svg+xml");
  const root = read.documentElement;
  if (root.nodeName !== "svg") {
    const plain = new DOMParser().parseFromString(svg, "text/html").body.textContent;
    return h("p", {}, plain);
  }
  root.querySelectorAll("script, foreignObject").forEach((one) => one.remove());
  return document.importNode(root, true);
}

function withSpaces(svg) {
  return svg.includes("xmlns=") ? svg : svg.replace("<svg", '<svg xmlns="http://www.w3.org/2000/svg"');
}

/** A sentence with symbols, as the server writes it: only letters in other faces are kept. */
export function sentence(html) {
  const kept = new Set(["I", "B", "SUB", "SUP", "SPAN"]);
  const read = new DOMParser().parseFromString(html, "text/html").body;
  const copy = (from, to) => {
    for (const node of from.childNodes) {
      if (node.nodeType === Node.TEXT_NODE) to.append(node.textContent);
      else if (node.nodeType === Node.ELEMENT_NODE) {
        const inner = kept.has(node.nodeName) ? document.createElement(node.nodeName.toLowerCase()) : h("span");
        if (node.className === "sym" || node.className === "both") inner.className = node.className;
        copy(node, inner);
        to.append(inner);
      }
    }
  };
  const made = h("span");
  copy(read, made);
  return made;
}

/** A button. */
export const button = (label, act, extra = {}) => h("button", { type: "button", onclick: act, ...extra }, label);

/** A choice from a list; labels may differ from values. */
export function choice(label, values, chosen, act, labels = {}) {
  const select = h("select", { onchange: (event) => act(event.target.value) });
  for (const value of values) {
    select.append(h("option", { value, selected: value === chosen }, labels[value] ?? value));
  }
  return h("label", {}, h("span", {}, label), select);
}

/** Hands a file to the user. */
export function download(name, type, bytes) {
  const url = URL.createObjectURL(new Blob([bytes], { type }));
  const link = h("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 60000);
}

// Elements, with what they hold.

// `make("p", { class: "dim" }, "text", child)`; functions become listeners.
export function make(name, about = {}, ...inside) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(about)) {
    if (typeof value === "function") element.addEventListener(key, value);
    else if (value === true) element.setAttribute(key, "");
    else if (value !== false && value != null) element.setAttribute(key, value);
  }
  element.append(...inside.flat().filter((part) => part != null));
  return element;
}

// A part of a picture.
export function drawn(name, about, ...inside) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(about)) element.setAttribute(key, value);
  element.append(...inside);
  return element;
}

export function button(text, act, about = {}) {
  return make("button", { type: "button", click: act, ...about }, text);
}

// A table that scrolls sideways by itself; `numbers` are columns of numbers.
export function table(caption, heads, rows, numbers = []) {
  const cell = (name) => (text, index) => make(name, { class: numbers.includes(index) ? "n" : null, scope: name === "th" ? "col" : null }, text ?? "–");
  const body = rows.map((row) => make("tr", {}, row.map(cell("td"))));
  return make("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption }, make("table", {}, make("caption", {}, caption), make("thead", {}, make("tr", {}, heads.map(cell("th")))), make("tbody", {}, body)));
}

// A number as people read it.
export function number(value, digits = 4) {
  if (value == null || Number.isNaN(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || 1e6 <= size)) return value.toExponential(digits - 1);
  return String(Number(value.toPrecision(digits)));
}

// A chance; below what can be told it only says so.
export function chance(value) {
  if (value == null) return "–";
  if (value < 1e-99) return "< 1e-99";
  return value < 0.001 ? value.toExponential(1) : value.toFixed(3);
}

// Texts of the pages in the language that the reader chose, or that the browser asks for.

const table = new Map();
let language = "en";

export const languages = { en: 1, zh: 2 };

export async function loadWords() {
  const text = await (await fetch("words.tsv")).text();
  for (const line of text.split("\n").slice(1)) {
    const [key, ...texts] = line.split("\t");
    if (key) table.set(key, texts);
  }
  const wanted = localStorage.getItem("language") ?? navigator.language;
  setLanguage(wanted.startsWith("zh") ? "zh" : "en");
}

export function currentLanguage() {
  return language;
}

export function setLanguage(code) {
  language = code;
  localStorage.setItem("language", code);
  document.documentElement.lang = code === "zh" ? "zh-Hans" : "en";
}

// The text of a key, `{name}` replaced from the holes.
export function t(key, holes = {}) {
  const text = table.get(key)?.[languages[language] - 1] ?? key;
  return text.replace(/\{(\w+)\}/g, (whole, name) => holes[name] ?? whole);
}

// The text of a key that is put together; the fallback where the table has none.
export function named(group, name) {
  const key = `${group}.${name}`;
  return table.has(key) ? t(key) : name;
}

// Patterns of what the libraries say in English, with their holes.
let patterns;

function sayings() {
  const escaped = (text) => text.replace(/[.*+?^$()|[\]\\]/g, "\\$&");
  patterns ??= [...table.entries()]
    .filter(([key]) => key.startsWith("said."))
    .map(([key, [english]]) => {
      const holes = [...english.matchAll(/\{(\w+)\}/g)].map((found) => found[1]);
      const parts = english.split(/\{\w+\}/).map((part) => escaped(part).replace(/[{}]/g, "\\$&"));
      return { key, holes, shape: new RegExp(`^${parts.join("(.+?)")}$`) };
    });
  return patterns;
}

// A sentence of a library in the reader's language, piece by piece; unknown ones stay English.
export function say(text) {
  if (language === "en" || !text) return text;
  const whole = text.replace(/[.]$/, "");
  for (const { key, holes, shape } of sayings()) {
    const found = shape.exec(whole);
    if (!found) continue;
    const values = holes.map((name, index) => [name, say(found[index + 1])]);
    return t(key, Object.fromEntries(values));
  }
  if (table.has(`effect.${whole}`)) return t(`effect.${whole}`);
  for (const mark of ["; ", ", "]) {
    if (whole.includes(mark)) {
      const parts = whole.split(mark).map((part) => say(part));
      return parts.join(mark === "; " ? "；" : "，");
    }
  }
  return text;
}

// Puts the texts into everything below an element that asks for one.
export function applyWords(root = document) {
  for (const element of root.querySelectorAll("[data-word]")) element.textContent = t(element.dataset.word);
  for (const element of root.querySelectorAll("[data-label]")) element.setAttribute("aria-label", t(element.dataset.label));
}

// Screen "Measurement": a dropped file, how it is read, and what looks mistaken in it.

import { app, get, post } from "./api.js";
import { run, showLine, showMessage } from "./jobs.js";
import { doubtCards } from "./doubts.js";
import { button, make, number, table } from "./make.js";
import { sayer } from "./said.js";
import { t } from "./words.js";

// What the user said otherwise, piece by piece, until the file is saved.
let said = [];

export async function show(root, page) {
  const reading = make("div", { id: "reading" });
  root.append(make("h2", {}, t("measurement.title")), dropZone(page, reading), reading);
  if (app.data && app.machine) root.append(await checkOf(page));
}

function dropZone(page, reading) {
  const take = (file) => file && page.attempt(async () => {
    said = [];
    render(reading, page, await told(await post("drop", { name: file.name }, await file.arrayBuffer())));
  });
  const input = make("input", { type: "file", id: "file", change: (event) => take(event.target.files[0]) });
  const zone = make("label", { class: "drop", for: "file" }, make("span", {}, t("measurement.drop")), input);
  zone.addEventListener("dragover", (event) => {
    event.preventDefault();
    zone.classList.add("over");
  });
  zone.addEventListener("dragleave", () => zone.classList.remove("over"));
  zone.addEventListener("drop", (event) => {
    event.preventDefault();
    zone.classList.remove("over");
    take(event.dataTransfer.files[0]);
  });
  return zone;
}

// A reading with all that it says in the reader's language.
async function told(reading) {
  const { notes, questions, columns, settings } = reading;
  const asked = questions.flatMap(({ text, answers }) => [text, ...answers.map(({ label }) => label)]);
  const say = await sayer([...notes, ...asked, ...[...columns, ...settings].map(({ reason }) => reason)]);
  const because = (all) => all.map((one) => ({ ...one, reason: say(one.reason) }));
  const answered = (answers) => answers.map((answer) => ({ ...answer, label: say(answer.label) }));
  return {
    ...reading,
    notes: notes.map(say),
    questions: questions.map(({ text, answers }) => ({ text: say(text), answers: answered(answers) })),
    columns: because(columns),
    settings: because(settings),
  };
}

function render(root, page, reading) {
  const otherwise = (recipe) => page.attempt(async () => {
    said.push(recipe);
    try {
      render(root, page, await told(await post("reread", {}, { file: reading.file, recipes: said })));
    } catch (error) {
      said.pop();
      throw error;
    }
  });
  const save = () => page.attempt(async () => {
    const saved = await post("save", {}, { file: reading.file, recipes: said });
    await page.refresh({ data: saved.data });
    await page.show("measurement");
    showMessage(saved.recipe ? t("measurement.saved", { data: saved.data, recipe: saved.recipe }) : t("measurement.as_it_is", { data: saved.data }));
  });
  showLine(reading.line);
  const open = reading.questions.length > 0;
  root.replaceChildren(...[
    make("h2", {}, t("measurement.understood", { name: reading.name })),
    open ? questions(reading.questions, otherwise) : make("p", {}, t("measurement.rows", { n: reading.rows, names: reading.names.join(", ") })),
    make("div", { class: "row" }, button(t("measurement.save"), save, { class: "first", id: "save", disabled: open })),
    columns(reading, otherwise),
    settings(reading.settings, otherwise),
    reading.notes.length ? make("ul", {}, reading.notes.map((note) => make("li", {}, note))) : null,
    ...(reading.lines.length ? [make("h3", {}, t("measurement.lines")), make("pre", { tabindex: 0 }, reading.lines.join("\n"))] : []),
    table(t("measurement.table"), reading.names.map((name) => make("code", {}, name)), reading.first.map((row) => row.map((value) => number(value, 7))), reading.names.map((_, index) => index)),
    make("details", {}, make("summary", {}, t("measurement.recipe")), make("pre", { tabindex: 0 }, reading.recipe)),
  ].filter(Boolean));
}

function questions(all, otherwise) {
  const card = (question) => make("li", { class: "card doubt" }, make("h3", {}, t("measurement.question")), make("p", {}, question.text),
    make("div", { class: "row" }, question.answers.map((answer) => button(answer.label, () => otherwise(answer.recipe)))));
  return make("ul", { class: "cards" }, all.map(card));
}

const quoted = (text) => JSON.stringify(text);

// Every column with what becomes of it; each can be changed.
function columns(reading, otherwise) {
  const rule = (column, more) => otherwise(`[[column]]\nfrom = ${quoted(column.from)}\n${more}`);
  const row = (column) => {
    const targets = ["none", ...new Set([...reading.targets, column.to ?? "none"])].filter((name, index, all) => all.indexOf(name) === index);
    const choose = make("select", { "aria-label": t("measurement.becomes", { name: column.from }), change: (event) => rule(column, `to = ${quoted(event.target.value)}`) },
      targets.map((name) => new Option(name === "none" ? t("measurement.none") : name, name, false, name === (column.to ?? "none"))));
    const unit = make("input", { size: 6, value: column.unit ?? "", "aria-label": t("measurement.unit_of", { name: column.from }), change: (event) => rule(column, `unit = ${quoted(event.target.value)}`) });
    const sign = button(column.sign < 0 ? "−" : "+", () => rule(column, `sign = ${-column.sign}`), { "aria-label": t("measurement.sign_of", { name: column.from }) });
    return [make("code", {}, column.from), choose, unit, sign, make("span", { class: "dim" }, column.reason)];
  };
  const heads = [t("measurement.in_file"), t("measurement.becomes_head"), t("measurement.unit"), t("measurement.sign"), t("measurement.why")];
  return table(t("measurement.columns"), heads, reading.columns.map(row));
}

// How the file is read; what has choices can be changed.
function settings(all, otherwise) {
  const row = (setting) => {
    const set = (value) => otherwise(`[${setting.section}]\n${setting.name} = ${setting.quoted ? quoted(value) : value}`);
    const about = { "aria-label": setting.name, change: (event) => set(event.target.value) };
    const field = setting.choices.length
      ? make("select", about, setting.choices.map((word) => new Option(word, word, false, word === setting.value)))
      : make("input", { ...about, value: setting.value });
    return [make("code", {}, `${setting.section}.${setting.name}`), field, make("span", { class: "dim" }, setting.reason)];
  };
  return table(t("measurement.settings"), [t("measurement.setting"), t("measurement.value"), t("measurement.why")], all.map(row));
}

// A card where something turns faster than the samples can follow: a limit of sound data, no doubt
// of them.
async function spacing() {
  const { highest_order, faster } = await get("faster");
  if (!faster.length) return [];
  const fastest = Math.max(...faster.map(([, order]) => order));
  const say = await sayer(faster.map(([name]) => name));
  const rows = faster.map(([name, order]) => [make("bdi", {}, say(name)), number(order)]);
  return [make("ul", { class: "cards" }, make("li", { class: "card", id: "spacing" },
    make("h3", {}, t("measurement.spacing")),
    make("p", {}, t("measurement.too_wide", { n: number(highest_order, 3), times: number(fastest / highest_order, 2) })),
    table(t("measurement.faster"), [t("machine.shaft"), t("machine.order")], rows, [1])))];
}

// What looks mistaken in the chosen data, before anything is named.
async function checkOf(page) {
  const place = make("div", { id: "check" });
  const check = async () => {
    place.replaceChildren(make("p", { class: "dim" }, t("measurement.checking", { data: app.data })));
    const found = await run("compare");
    if (!found) return;
    const { doubts } = found.result;
    place.replaceChildren(doubts.length ? doubtCards(doubts, page, check) : make("p", { id: "sound" }, t("measurement.sound", { data: app.data })));
    place.append(...(await spacing()));
    if (!doubts.length) place.append(button(t("measurement.on"), () => page.show("fails"), { class: "first" }));
  };
  page.attempt(check);
  return place;
}

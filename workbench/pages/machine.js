// Screen "Machine": a form beside the machine file, both live.

import { app, get, post } from "./api.js";
import { form } from "./form.js";
import { showMessage } from "./jobs.js";
import { button, make, number, table } from "./make.js";
import { sayer } from "./said.js";
import { train } from "./train.js";
import { t } from "./words.js";

const START = `title = "My machine"

[workpiece]
lead = "6 mm"
length = "1000 mm"

[spindle]
speed = "6 rpm"

[lead_screw]
lead = "12 mm"

[grating]
lines = 13906
diameter = "200 mm"

[laser]
wavelength = "0.63281983 um"

[dividers]
a = 110
b = 150
range = 2

[drive]
step = "0.0125 um"
frequency = "160 Hz"

[loop]
closed = false
`;

// What could not be saved, because another tab had saved something meanwhile.
let unsaved = null;

export async function show(root, page) {
  const name = app.machine || "machine.toml";
  const text = make("textarea", { id: "toml", spellcheck: "false", "aria-label": name }, app.state.machine?.text ?? START);
  const errors = make("div", { id: "errors", role: "alert" });
  const facts = make("div", { id: "facts" });
  const fields = make("div", {});
  const save = button(t("machine.save"), () => page.attempt(async () => {
    const revision = app.state.machine ? app.revision : "";
    const state = await post("machine", { machine: name, revision }, { text: text.value }).catch((error) => {
      if (error.status === 409) unsaved = text.value;
      throw error;
    });
    await page.refresh({ machine: state.machine?.name ?? name });
    save.disabled = true;
    showMessage(t("page.saved"));
  }), { class: "first", id: "save-machine" });
  save.disabled = !!app.state.machine;
  const check = () => page.attempt(async () => {
    const found = await post("check", { machine: name }, { text: text.value });
    const said = await sayer(found.errors);
    errors.replaceChildren(...found.errors.map((error) => make("p", { class: "bad" }, said(error))));
    facts.replaceChildren(...(found.errors.length ? [] : told(found)));
    save.disabled = found.errors.length > 0 || text.value === app.state.machine?.text;
    return found.errors.length === 0;
  });
  const changed = async () => {
    form(fields, text, changed, page);
    await check();
  };
  // Another text in place of what stands there, which a button brings back; nothing is saved.
  const replace = async (other) => {
    const before = text.value;
    text.value = other;
    back.replaceChildren(button(t("machine.back"), () => {
      text.value = before;
      back.replaceChildren();
      return changed();
    }, { id: "back" }));
    await changed();
  };
  const back = make("span", {});
  const solved = make("code", { id: "solved" });
  const solve = button(t("machine.solve"), () => page.attempt(async () => {
    const found = await post("dividers", { machine: name }, { text: text.value });
    solved.textContent = found.command;
    await replace(found.text);
  }), { id: "solve" });
  const begin = make("select", { id: "template", change: () => page.attempt(() => replace(templates.find((one) => one.name === begin.value).text)) }, make("option", { value: "", disabled: true, selected: true }, t("machine.begin")));
  const templates = await get("templates");
  begin.append(...templates.map((one) => make("option", { value: one.name }, t(`template.${one.name}`))));
  let later;
  text.addEventListener("input", () => {
    clearTimeout(later);
    later = setTimeout(changed, 200);
  });
  root.append(make("h2", {}, t("machine.title", { name })), errors,
    make("div", { class: "row" }, save, make("label", {}, make("span", {}, t("machine.template")), begin), back),
    make("div", { class: "two" }, make("div", {}, fields, make("div", { class: "row" }, solve, solved), facts), make("div", {}, text)));
  const mine = unsaved;
  unsaved = null;
  await (mine === null ? changed() : replace(mine));
}

function told(found) {
  const left = found.left_um_per_m == null ? null : make("p", { id: "left-by-dividers" }, t("machine.left", { n: number(found.left_um_per_m, 3) }));
  if (!found.gears.length) return [left].filter(Boolean);
  const rows = found.gears.map((gear, index) => [String(index + 1), make("bdi", {}, gear.name), number(gear.order), gear.teeth ? String(gear.teeth) : null]);
  const heads = [t("machine.wheel"), t("machine.shaft"), t("machine.order"), t("machine.teeth")];
  return [left, train(found.gears, found.screw_order), table(t("machine.gears"), heads, rows, [0, 2, 3])].filter(Boolean);
}

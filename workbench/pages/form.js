// The form beside a machine file: its fields as the text has them.

import { app, post } from "./api.js";
import { showMessage } from "./jobs.js";
import { make } from "./make.js";
import { t } from "./words.js";

// Key of the machine file, and what the form calls it.
const FIELDS = () => [
  ["workpiece.lead", t("machine.lead")],
  ["workpiece.length", t("machine.length")],
  ["spindle.speed", t("machine.speed")],
  ["lead_screw.lead", t("machine.screw")],
  ["grating.lines", t("machine.lines")],
  ["grating.diameter", t("machine.diameter")],
  ["dividers.a", t("machine.a")],
  ["dividers.b", t("machine.b")],
  ["dividers.range", t("machine.range")],
  ["drive.step", t("machine.step")],
  ["drive.frequency", t("machine.frequency")],
  ["filter.cutoff", t("machine.cutoff")],
];

// The value of a key as the text has it; nothing where it has none.
function valueOf(text, key) {
  const [section, name] = key.split(".");
  const body = text.split(new RegExp(`^\\[${section}\\].*$`, "m"))[1]?.split(/^\[/m)[0] ?? "";
  const found = body.match(new RegExp(`^${name}\\s*=\\s*(.+?)\\s*(#.*)?$`, "m"));
  return found ? found[1].replace(/^"(.*)"$/, "$1") : null;
}

// Puts the fields into `root`; a change of a field is a change of `text.value`, then `changed` runs.
export function form(root, text, changed, page) {
  if (root.contains(document.activeElement)) {
    for (const input of root.querySelectorAll("input")) {
      if (input !== document.activeElement) input.value = valueOf(text.value, input.dataset.key) ?? "";
    }
    return;
  }
  const field = ([key, label]) => {
    const set = (event) => page.attempt(async () => {
      const plain = /^[0-9]+$/.test(event.target.value);
      const value = plain ? event.target.value : JSON.stringify(event.target.value);
      text.value = (await post("setting", { machine: app.machine || "machine.toml" }, { text: text.value, key, value })).text;
      showMessage("");
      await changed();
    });
    return make("label", { class: "field" }, make("span", {}, label), make("input", { value: valueOf(text.value, key) ?? "", change: set, "data-key": key }));
  };
  root.replaceChildren(make("h3", {}, t("machine.form")), ...FIELDS().map(field));
}

// Screen "Device": the closed loop simulated clock by clock from the form, before and after.

import { app, getFrame, post } from "./api.js";
import { form } from "./form.js";
import { run, showMessage } from "./jobs.js";
import { button, make, number, table } from "./make.js";
import { leadChart } from "./runs.js";
import { sayer } from "./said.js";
import { t } from "./words.js";

export async function show(root, page) {
  const draft = { value: app.state.machine.text };
  const place = make("div", { id: "simulated" });
  const fields = make("div", {});
  const simulate = () => page.attempt(async () => {
    const found = await run("draft", {}, { text: draft.value });
    if (found) await render(place, found, await getFrame("drafted", { job: found.job }));
  });
  const save = button(t("machine.save"), () => page.attempt(async () => {
    await post("machine", {}, { text: draft.value });
    await page.refresh();
    save.disabled = true;
    document.getElementById("unsaved").hidden = true;
    showMessage(t("page.saved"));
  }), { id: "save-device", disabled: true });
  const changed = async () => {
    save.disabled = draft.value === app.state.machine.text;
    form(fields, draft, changed, page);
    await simulate();
  };
  root.append(make("h2", {}, t("device.title")), make("p", {}, t("device.what")),
    make("div", { class: "row" }, button(t("device.run"), simulate, { class: "first", id: "simulate" }), save),
    make("div", { class: "two" }, fields, place));
  form(fields, draft, changed, page);
  await simulate();
}

async function render(root, { result, seconds }, trace) {
  const rows = [
    [t("device.periodic"), "periodic_error_um"],
    [t("device.cumulative"), "cumulative_error_um"],
    [t("device.lead"), "lead_error_peak_to_peak_um"],
    [t("device.recorder"), "recorder_peak_to_peak_um"],
  ].map(([name, key]) => [name, ...["without_correction", "with_correction"].map((way) => make("span", { "data-key": `${way}.${key}`, "data-value": result[way][key] }, number(result[way][key])))]);
  const said = await sayer(result.notes);
  root.replaceChildren(
    table(t("device.table"), [t("device.quantity"), t("device.without"), t("device.with")], rows, [1, 2]),
    make("p", {}, t("device.ran", { mm: number(result.run.length_mm), clocks: result.run.clocks.toLocaleString("en"), s: number(seconds, 2) })),
    ...result.notes.map((note) => make("p", {}, said(note))));
  leadChart(root, trace, "position_mm").box.id = "before-after";
}

// Screen "Device": the closed loop simulated clock by clock, before and after.

import { run } from "./jobs.js";
import { button, make, number, table } from "./make.js";
import { t } from "./words.js";

export async function show(root, page) {
  const place = make("div", { id: "simulated" });
  const simulate = () => page.attempt(async () => {
    const found = await run("sim");
    if (found) render(place, found);
  });
  root.append(make("h2", {}, t("device.title")), make("p", {}, t("device.what")), make("div", { class: "row" }, button(t("device.run"), simulate, { class: "first", id: "simulate" })), place);
}

function render(root, { result, seconds }) {
  const rows = [
    [t("device.periodic"), "periodic_error_um"],
    [t("device.cumulative"), "cumulative_error_um"],
    [t("device.lead"), "lead_error_peak_to_peak_um"],
    [t("device.recorder"), "recorder_peak_to_peak_um"],
  ].map(([name, key]) => [name, number(result.without_correction[key]), number(result.with_correction[key])]);
  root.replaceChildren(...[
    make("p", {}, t("device.ran", { mm: number(result.run.length_mm), clocks: result.run.clocks.toLocaleString("en"), s: number(seconds, 2) })),
    table(t("device.table"), [t("device.quantity"), t("device.without"), t("device.with")], rows, [1, 2]),
    ...result.notes.map((note) => make("p", { lang: "en" }, note)),
    make("p", {}, t("device.files")),
  ]);
}

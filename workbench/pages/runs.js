// The two runs of a simulated machine, without and with the correction.

import { Chart, curvesOf } from "./plot.js";
import { t } from "./words.js";

// Columns of a trace as { without, with }; a machine file says which of them stands first.
function runsOf(trace) {
  const run = (head) => ({ time_s: trace[`${head}time_s`], position_mm: trace[`${head}position_mm`], lead: trace[`${head}lead_error_um`] });
  const corrected = "open_lead_error_um" in trace;
  const other = run(corrected ? "open_" : "closed_");
  return corrected ? { without: other, with: run("") } : { without: run(""), with: other };
}

// The lead error of both, over `time_s` or `position_mm`.
export function leadChart(root, trace, over) {
  const runs = runsOf(trace);
  const line = (run, label, colour) => (run.lead ? [{ label, colour, curves: curvesOf(run[over], run.lead, [{ from: 0, to: run.lead.length }]) }] : []);
  return new Chart(root, { title: t("waves.lead"), x: t(`axis_label.${over}`), y: t("unit.um"), lines: [
    ...line(runs.without, t("device.without"), "orange"),
    ...line(runs.with, t("device.with"), "blue"),
  ] });
}

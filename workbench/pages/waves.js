// Screen "Waves": the run over time, and the bits and micrometres of an instant of it.

import { app, get, getFrame } from "./api.js";
import { run } from "./jobs.js";
import { button, drawn, make, number } from "./make.js";
import { Chart, curvesOf } from "./plot.js";
import { t } from "./words.js";

// Half of what is shown of the bits, s: a few comparisons.
const AROUND_S = 0.25;

export async function show(root, page) {
  const place = make("div", {});
  const begin = () => page.attempt(async () => {
    if (await run("sim")) await draw(place, page);
  });
  root.append(make("h2", {}, t("waves.title")), make("p", {}, t("waves.what")),
    make("div", { class: "row" }, button(t("device.run"), begin, { class: "first", id: "run" })), place);
  if (app.state.simulated) await draw(place, page);
}

async function draw(root, page) {
  const trace = await getFrame("trace");
  await page.refresh();
  root.replaceChildren();
  const whole = [{ from: 0, to: trace.rows }];
  const other = "open_lead_error_um" in trace ? ["open_lead_error_um", t("device.without")] : ["closed_lead_error_um", t("device.with")];
  const own = other[0].startsWith("open") ? t("device.with") : t("device.without");
  const chart = new Chart(root, { title: t("waves.lead"), x: t("axis_label.time_s"), y: t("unit.um"), lines: [
    { label: other[1], colour: "orange", curves: curvesOf(trace.time_s, trace[other[0]], whole) },
    { label: own, colour: "blue", curves: curvesOf(trace.time_s, trace.lead_error_um, whole) },
  ] });
  const bits = make("div", { id: "bits" });
  const instant = make("input", { type: "number", step: "any", min: 0, id: "instant", "aria-label": t("waves.instant") });
  const look = () => page.attempt(async () => {
    const at = Number(instant.value);
    const window = { from: Math.max(0, at - AROUND_S).toFixed(6), to: (at + AROUND_S).toFixed(6) };
    if (await run("sim", window)) paint(bits, await get("waves"), at);
  });
  chart.canvas.addEventListener("click", (event) => {
    const left = event.clientX - chart.plot.over.getBoundingClientRect().left;
    instant.value = chart.plot.posToVal(left, "x").toFixed(4);
  });
  root.append(make("div", { class: "row" }, make("label", { for: "instant" }, t("waves.instant")), instant, button(t("waves.look"), look, { id: "look" })), bits);
  if (app.instant_mm !== undefined) {
    const at = trace.position_mm.findIndex((place) => app.instant_mm <= place);
    instant.value = trace.time_s[Math.max(0, at)].toFixed(4);
    app.instant_mm = undefined;
  }
  paint(bits, await get("waves"), instant.value === "" ? null : Number(instant.value));
}

// One row a signal: bits as steps, counts with their numbers, micrometres as curves.
function paint(root, waves, at) {
  const [left, width, height] = [170, 900, 30];
  const span = waves.end_s - waves.begin_s || 1;
  const x = (second) => left + ((second - waves.begin_s) / span) * width;
  const picture = drawn("svg", { viewBox: `0 0 ${left + width + 10} ${height * waves.signals.length + 26}`, class: "waves", role: "img", "aria-label": t("waves.bits") });
  waves.signals.forEach((signal, row) => {
    const base = (row + 1) * height - 6;
    picture.append(drawn("text", { x: 4, y: base, class: "name" }, signal.path.split(".").pop()));
    picture.append(drawn("path", { d: shape(signal, x, base, height - 12, left + width), class: signal.real ? "real" : "bit" }));
  });
  const bottom = height * waves.signals.length + 18;
  picture.append(drawn("text", { x: left, y: bottom, class: "name" }, `${number(waves.begin_s, 6)} s`));
  picture.append(drawn("text", { x: left + width, y: bottom, class: "name end" }, `${number(waves.end_s, 6)} s`));
  if (at !== null && waves.begin_s <= at && at <= waves.end_s) picture.append(drawn("path", { d: `M${x(at)} 0V${bottom - 14}`, class: "instant" }));
  const last = (signal) => signal.changes[signal.changes.length - 1];
  root.replaceChildren(make("h3", {}, t("waves.bits")), make("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": t("waves.bits") }, picture),
    make("p", { class: "dim" }, t("waves.counted", { n: waves.signals.length, last: waves.signals.length ? number(last(waves.signals[0])[0], 6) : "–" })));
}

function shape(signal, x, base, tall, end) {
  const values = signal.changes.map((change) => change[1] ?? 0);
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const y = (value) => base - ((value - low) / (high - low || 1)) * tall;
  let path = "";
  signal.changes.forEach(([second, value], index) => {
    const [across, up] = [x(second).toFixed(1), y(value ?? 0).toFixed(1)];
    path += index === 0 ? `M${across} ${up}` : signal.real ? `L${across} ${up}` : `H${across}V${up}`;
  });
  return `${path}H${end}`;
}

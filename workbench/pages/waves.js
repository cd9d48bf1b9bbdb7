// Screen "Waves": the run over time, and the bits and micrometres of an instant of it.

import { app, get, getFrame } from "./api.js";
import { blocksOf, centre, unitOf } from "./fails.js";
import { run } from "./jobs.js";
import { button, drawn, make, number } from "./make.js";
import { Chart, curvesOf } from "./plot.js";
import { leadChart } from "./runs.js";
import { named, t } from "./words.js";

// Half of what is shown of the bits, s: a few comparisons.
const AROUND_S = 0.25;

// A neighbour differs by so many times the usual difference where the error jumps.
const JUMPS = 6;
const MOST_JUMPS = 6;

export async function show(root, page) {
  const place = make("div", {});
  const begin = () => page.attempt(async () => {
    if (await run("sim")) await draw(place, page);
  });
  root.append(make("h2", {}, t("waves.title")), make("p", {}, t("waves.what")),
    make("div", { class: "row" }, button(t("device.run"), begin, { class: "first", id: "run" })), place);
  await page.refresh();
  if (app.state.simulated) await draw(place, page);
}

async function draw(root, page) {
  const trace = await getFrame("trace");
  root.replaceChildren();
  const bits = make("div", { id: "bits" });
  const instant = make("input", { type: "number", step: "any", min: 0, id: "instant", "aria-label": t("waves.instant") });
  const look = () => page.attempt(async () => {
    const at = Number(instant.value);
    const window = { from: Math.max(0, at - AROUND_S).toFixed(6), to: (at + AROUND_S).toFixed(6) };
    if (await run("sim", window)) paint(bits, await get("waves"), at);
  });
  const at = (second) => {
    instant.value = second.toFixed(4);
    return look();
  };
  const passing = (mm) => {
    const row = trace.position_mm.findIndex((place) => mm <= place);
    return trace.time_s[row < 0 ? trace.rows - 1 : row];
  };
  leadChart(root, trace, "time_s").pick(at);
  if (app.data) await residual(root, (mm) => at(passing(mm)));
  root.append(make("div", { class: "row" }, make("label", { for: "instant" }, t("waves.instant")), instant, button(t("waves.look"), look, { id: "look" })), bits);
  const wanted = app.instant_mm;
  app.instant_mm = undefined;
  if (wanted === undefined) paint(bits, await get("waves"), null);
  else await at(passing(wanted));
}

// What the model leaves of the data, with the places where it jumps; each leads to its instant.
async function residual(root, at) {
  const series = await getFrame("series");
  if (!series.position_mm) return;
  const sensor = series.blocks[0].sensor;
  const blocks = blocksOf(series, sensor);
  const left = centre(series.residual, series.blocks);
  const chart = new Chart(root, { title: `${t("fails.residual")}, ${named("sensor", sensor)}`, x: t("axis_label.position_mm"), y: unitOf(series), height: 180, lines: [
    { label: t("fails.residual"), colour: "blue", curves: curvesOf(series.position_mm, left, blocks) },
  ] });
  chart.box.id = "waves-residual";
  chart.pick(at);
  const found = jumps(left, blocks);
  const offer = (row) => button(t("waves.jump", { um: number(left[row] - left[row - 1], 3), mm: number(series.position_mm[row], 5) }), () => at(series.position_mm[row]), { class: "jump" });
  if (found.length) root.append(make("div", { class: "row", id: "jumps" }, make("span", { class: "dim" }, t("waves.jumps")), found.map(offer)));
}

// Rows that stand apart from the row before by far more than neighbours usually do, largest first.
function jumps(values, blocks) {
  const steps = blocks.flatMap(({ from, to }) => Array.from({ length: Math.max(0, to - from - 1) }, (_, index) => from + 1 + index));
  const size = (row) => Math.abs(values[row] - values[row - 1]);
  const sizes = Float32Array.from(steps, size).sort();
  const usual = sizes[sizes.length >> 1] ?? 0;
  return steps.filter((row) => JUMPS * usual < size(row)).sort((one, other) => size(other) - size(one)).slice(0, MOST_JUMPS);
}

// One row a signal: bits as steps, counts with their numbers, micrometres as curves; at the right
// what each is at the instant.
function paint(root, waves, at) {
  const [left, width, height, right] = [170, 820, 30, 110];
  const span = waves.end_s - waves.begin_s || 1;
  const x = (second) => left + ((second - waves.begin_s) / span) * width;
  const inside = at !== null && waves.begin_s <= at && at <= waves.end_s;
  const picture = drawn("svg", { viewBox: `0 0 ${left + width + right} ${height * waves.signals.length + 26}`, class: "waves", role: "img", "aria-label": t("waves.bits") });
  waves.signals.forEach((signal, row) => {
    const base = (row + 1) * height - 6;
    picture.append(drawn("text", { x: 4, y: base, class: "name" }, signal.path.split(".").pop()));
    picture.append(drawn("path", { d: shape(signal, x, base, height - 12, left + width), class: signal.real ? "real" : "bit" }));
    if (inside) picture.append(drawn("text", { x: left + width + right - 4, y: base, class: "value end" }, number(valueAt(signal, at), 5)));
  });
  const bottom = height * waves.signals.length + 18;
  picture.append(drawn("text", { x: left, y: bottom, class: "name" }, `${number(waves.begin_s, 6)} s`));
  picture.append(drawn("text", { x: left + width, y: bottom, class: "name end" }, `${number(waves.end_s, 6)} s`));
  if (inside) picture.append(drawn("path", { d: `M${x(at)} 0V${bottom - 14}`, class: "instant" }));
  const title = inside ? t("waves.bits_at", { s: number(at, 8) }) : t("waves.bits");
  root.replaceChildren(make("h3", {}, title), make("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": t("waves.bits") }, picture),
    make("p", { class: "dim" }, t("waves.counted", { n: waves.signals.length })));
}

// The last value at or before an instant.
function valueAt(signal, at) {
  let value = signal.changes[0][1];
  for (const [second, now] of signal.changes) {
    if (at < second) break;
    value = now;
  }
  return value;
}

function shape(signal, x, base, tall, end) {
  const values = signal.changes.map((change) => change[1] ?? 0);
  const [low, high] = values.reduce(([least, most], value) => [Math.min(least, value), Math.max(most, value)], [Infinity, -Infinity]);
  const y = (value) => base - ((value - low) / (high - low || 1)) * tall;
  let path = "";
  signal.changes.forEach(([second, value], index) => {
    const [across, up] = [x(second).toFixed(1), y(value ?? 0).toFixed(1)];
    path += index === 0 ? `M${across} ${up}` : signal.real ? `L${across} ${up}` : `H${across}V${up}`;
  });
  return `${path}H${end}`;
}

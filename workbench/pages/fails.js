// Screen "Where it fails": measured against model, the residual, and every axis it could follow.

import { app, get, getFrame } from "./api.js";
import { run } from "./jobs.js";
import { doubtCards } from "./doubts.js";
import { button, chance, make, number, table } from "./make.js";
import { Chart, curveOf, curvesOf, newGroup } from "./plot.js";
import { named, say, t } from "./words.js";

// What is looked at: a coordinate, a sensor, and the passes that are switched off.
const look = { x: "", sensor: "", without: new Set(), axis: "" };

export async function show(root, page) {
  const series = await getFrame("series");
  const sensors = [...new Set(series.blocks.map((block) => block.sensor))];
  if (!sensors.includes(look.sensor)) look.sensor = sensors[0];
  if (!(look.x in series)) look.x = series.rotary ? "time_s" : "position_mm";
  const verdict = make("div", { id: "compared" }, make("p", { class: "dim" }, t("fails.comparing")));
  const body = make("div", {});
  root.append(make("h2", {}, t("fails.title")), verdict, body);
  await draw(body, page, series, sensors);
  compare(verdict, page);
}

// How large the residual is, and what stands in it: what `helixlock compare --json` says.
async function compare(root, page) {
  const found = await page.attempt(() => run("compare"));
  if (!found) return;
  const { result } = found;
  const unit = t(`unit.${result.unit}`);
  // The noise is told where nothing else is left: beside structure it would hold that, too.
  const sizes = result.sensors.flatMap((one) => [
    make("div", {}, make("dt", {}, t("fails.left_of", { sensor: named("sensor", one.sensor) })), make("dd", { "data-key": "rms_um", "data-value": one.rms_um }, `${number(one.rms_um)} ${unit}`)),
    result.noise_only && make("div", {}, make("dt", {}, t("fails.noise_of", { sensor: named("sensor", one.sensor) })), make("dd", { "data-key": "noise", "data-value": one.noise.white_um }, `${number(one.noise.white_um)} ${unit}`)),
  ]).filter(Boolean);
  const doubts = result.doubts.length ? doubtCards(result.doubts, page, () => page.show("fails")) : null;
  const rows = result.along.slice(0, 12).map((one) => [say(one.along), say(one.shape), number(one.rms_um), chance(one.p_value)]);
  const about = [t("fails.along"), t("fails.shape"), t("fails.size", { unit }), t("fails.chance")];
  root.replaceChildren(...[
    doubts,
    make("p", { id: "sentence" }, result.noise_only ? t("fails.noise_only") : t("fails.structure")),
    make("dl", { class: "numbers" }, sizes),
    make("details", {}, make("summary", {}, t("fails.all_structures")), table(t("fails.all_structures"), about, rows, [2, 3])),
    result.noise_only || doubts ? null : button(t("fails.on"), () => page.show("effects"), { class: "first" }),
  ].filter(Boolean));
}

async function draw(root, page, series, sensors) {
  const again = () => page.attempt(async () => {
    root.replaceChildren();
    await draw(root, page, series, sensors);
  });
  const blocks = blocksOf(series, look.sensor).filter((block) => !look.without.has(block.pass));
  root.append(choices(series, sensors, again));
  const x = series[look.x];
  const unit = unitOf(series);
  const model = series.measured.map((value, row) => value - series.residual[row]);
  const group = newGroup();
  const across = t(`axis_label.${look.x}`);
  const centred = centre(series.residual, series.blocks);
  const above = new Chart(root, { title: t("fails.measured_model", { sensor: named("sensor", look.sensor) }), x: across, y: unit, group, lines: [
    { label: t("fails.measured"), colour: "orange", curves: curvesOf(x, series.measured, blocks), dots: series.rows < 3000 },
    { label: t("fails.model"), colour: "blue", curves: curvesOf(x, model, blocks) },
  ] });
  above.box.id = "measured";
  const residual = new Chart(root, { title: t("fails.residual"), x: across, y: unit, group, height: 200, lines: [
    { label: t("fails.residual"), colour: "blue", curves: curvesOf(x, centred, blocks) },
  ] });
  residual.box.id = "residual";
  if (series.position_mm) leadToWaves(residual, series, x, page);
  const sensor = sensors.indexOf(look.sensor);
  const words = { sensor, without: [...look.without].join(",") };
  await strips(root, words, unit);
  await spectrum(root, words, unit);
}

// A click on the residual offers the flip-flops of a simulated run at that place.
function leadToWaves(chart, series, x, page) {
  const place = make("div", { class: "row" });
  chart.box.append(place);
  chart.pick((value) => {
    let row = 0;
    for (let other = 1; other < series.rows; other++) if (Math.abs(x[other] - value) < Math.abs(x[row] - value)) row = other;
    const at = series.position_mm[row];
    place.replaceChildren(button(t("fails.waves", { mm: number(at, 5) }), () => {
      app.instant_mm = at;
      page.show("waves");
    }, { id: "to-waves" }));
  });
}

export function unitOf(series) {
  return t(`unit.${series.unit === "arcsec" ? "arcsec" : "um"}`);
}

// The passes of one sensor.
export function blocksOf(series, sensor) {
  return series.blocks.filter((block) => block.sensor === sensor);
}

// Every block about its mean, as sizes are counted.
export function centre(values, blocks) {
  const centred = Float32Array.from(values);
  for (const { from, to } of blocks) {
    let sum = 0;
    for (let row = from; row < to; row++) sum += values[row];
    const mean = sum / Math.max(1, to - from);
    for (let row = from; row < to; row++) centred[row] -= mean;
  }
  return centred;
}

function choices(series, sensors, again) {
  const coordinates = ["position_mm", "time_s", "angle_rev"].filter((name) => name in series);
  const select = (label, values, chosen, name, set) => make("label", {}, make("span", {}, label), make("select", { change: (event) => {
    set(event.target.value);
    again();
  } }, values.map((value) => new Option(name(value), value, false, value === chosen))));
  const passes = [...new Set(series.blocks.map((block) => block.pass))];
  const pass = (number) => make("label", { class: "pass" }, make("input", { type: "checkbox", checked: !look.without.has(number), change: (event) => {
    if (event.target.checked) look.without.delete(number);
    else look.without.add(number);
    again();
  } }), ` ${t("fails.pass", { n: number })}`);
  return make("div", { class: "row" }, [
    select(t("fails.over"), coordinates, look.x, (name) => t(`axis_label.${name}`), (value) => (look.x = value)),
    sensors.length > 1 ? select(t("fails.sensor"), sensors, look.sensor, (name) => named("sensor", name), (value) => (look.sensor = value)) : null,
    passes.length > 1 && passes.length <= 24 ? passes.map(pass) : null,
  ].flat());
}

// A strip an axis: blue below, orange above; the axis that holds most stands first.
async function strips(root, words, unit) {
  const { axes, rms } = await get("axes", words);
  const place = make("div", {});
  const show = async (axis, press) => {
    look.axis = axis.key;
    for (const other of list.children) other.setAttribute("aria-pressed", other === press);
    await curve(place, words, unit);
  };
  const strip = (axis) => {
    const canvas = make("canvas", { width: axis.mean.length, height: 1, "aria-hidden": "true" });
    paint(canvas, axis.mean, 1.5 * rms);
    const press = make("button", { type: "button", class: "strip", "aria-pressed": "false", "data-axis": axis.key, click: () => show(axis, press) },
      make("span", {}, nameOf(axis)), canvas, make("span", { class: "n" }, `${(100 * axis.share).toFixed(0)} %`));
    return press;
  };
  const list = make("div", { class: "strips" }, axes.map(strip));
  root.append(make("h2", {}, t("fails.axes")), make("p", { class: "dim" }, t("fails.strips")), list, place);
  const chosen = Math.max(0, axes.findIndex((axis) => axis.key === look.axis));
  if (axes.length) await show(axes[chosen], list.children[chosen]);
}

function nameOf(axis) {
  return axis.name ? t(`axis.${axis.kind}_of`, { name: axis.name }) : t(`axis.${axis.kind}`);
}

function paint(canvas, means, full) {
  const context = canvas.getContext("2d");
  const picture = context.createImageData(means.length, 1);
  means.forEach((mean, index) => {
    const part = mean === null ? 0 : Math.max(-1, Math.min(1, mean / (full || 1)));
    const [red, green, blue] = part < 0 ? [30, 110, 200] : [220, 110, 20];
    picture.data.set([red, green, blue, mean === null ? 0 : Math.round(255 * Math.abs(part))], 4 * index);
  });
  context.putImageData(picture, 0, 0);
}

// The residual along the chosen axis.
async function curve(root, words, unit) {
  const axis = await get("axis", { ...words, key: look.axis });
  const width = (axis.high - axis.low) / axis.mean.length;
  const at = (values) => curveOf(values.map((value, bin) => [axis.low + (bin + 0.5) * width, value]).filter((point) => point[1] !== null));
  root.replaceChildren();
  const across = axis.unit ? `${nameOf(axis)}, ${axis.unit}` : nameOf(axis);
  const chart = new Chart(root, { title: t("fails.residual_along", { axis: nameOf(axis) }), x: across, y: unit, height: 220, lines: [
    { label: t("fails.least"), colour: "dim", curves: [at(axis.least)] },
    { label: t("fails.most"), colour: "dim", curves: [at(axis.most)] },
    { label: t("fails.mean"), colour: "orange", curves: [at(axis.mean)] },
  ] });
  chart.box.id = "along";
  chart.box.dataset.axis = axis.key;
}

// The spectrum with names at its peaks.
async function spectrum(root, words, unit) {
  const { points, peaks, beyond } = await get("spectrum", words);
  if (points.length < 3) return;
  const chart = new Chart(root, { title: t("fails.spectrum"), x: t("fails.orders"), y: unit, lines: [
    { label: t("fails.amplitude"), colour: "blue", curves: [curveOf(points)] },
  ] });
  chart.box.id = "spectrum";
  const text = (peak) => `${peak.name ?? "?"} ${number(peak.order, 3)}`;
  chart.after = (plot) => label(chart, plot, peaks, text);
  label(chart, chart.plot, peaks, text);
  if (look.without.size) root.append(make("p", { class: "dim" }, t("fails.all_passes")));
  if (beyond.length) {
    const lines = beyond.map(([name, order]) => `${name ?? "?"} ${number(order, 3)}`);
    root.append(make("p", { id: "aliased", class: "dim" }, t("fails.aliased", { lines: lines.join(", ") })));
  }
  if (peaks.length) {
    const rows = peaks.map((peak) => [number(peak.order), number(peak.amplitude), peak.name ? make("bdi", {}, peak.name) : t("fails.nameless")]);
    root.append(table(t("fails.peaks"), [t("fails.order"), t("fails.amplitude_in", { unit }), t("fails.name")], rows, [0, 1]));
  }
}

// Names over their peaks, the strongest first; one that would stand on another is left to the table.
function label(chart, plot, peaks, text) {
  for (const old of chart.canvas.querySelectorAll(".peak")) old.remove();
  const taken = [];
  const area = plot.over;
  for (const peak of [...peaks].sort((one, other) => other.amplitude - one.amplitude)) {
    const x = area.offsetLeft + plot.valToPos(peak.order, "x");
    const y = Math.max(area.offsetTop + 16, area.offsetTop + plot.valToPos(peak.amplitude, "y") - 2);
    if (x < area.offsetLeft || area.offsetLeft + area.offsetWidth < x) continue;
    const tag = make("span", { class: "peak", "data-order": peak.order, style: `left:${x}px;top:${y}px` }, text(peak));
    chart.canvas.append(tag);
    const box = tag.getBoundingClientRect();
    const frame = chart.canvas.getBoundingClientRect();
    const clash = taken.some((other) => box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom);
    if (clash || box.right > frame.right || box.left < frame.left) tag.remove();
    else taken.push(box);
  }
}

// The shape of an effect over what the model leaves, small enough for a card.

import { getFrame, postFrame } from "./api.js";
import { blocksOf, centre, unitOf } from "./fails.js";
import { aside } from "./jobs.js";
import { drawn, make, number } from "./make.js";
import { Curve } from "./thin.js";
import { named, t } from "./words.js";

const [WIDTH, HEIGHT] = [280, 70];

// A fast wave is drawn over so many passages of zero, or nothing could be seen of it.
const PASSAGES = 12;

// Fits each effect alone and draws it into its place, one after the other, while they are shown.
export async function sketches(places) {
  if (!places.length) return;
  const series = await getFrame("series");
  const left = centre(series.residual, series.blocks);
  for (const place of places) {
    if (!place.isConnected || place.closest("section").hidden) return;
    const job = await aside("add", { effect: place.dataset.effect });
    if (job === null) continue;
    const trial = await postFrame("trial", { job }, { values: {} });
    const effect = centre(series.residual.map((value, row) => value - trial.residual[row]), series.blocks);
    place.replaceChildren(picture(series, left, effect, named("effect", place.dataset.effect)), ...trial.sensors.map((one) => size(one, unitOf(series))));
  }
}

function size({ sensor, rms_before, rms_after }, unit) {
  const [before, after] = [number(rms_before, 3), number(rms_after, 3)];
  return make("p", { class: "dim", "data-sensor": sensor }, t("effects.alone_on", { sensor: named("sensor", sensor), before, after, unit }));
}

// What is left of the first pass in which the effect moves, and the effect over it.
function picture(series, left, effect, name) {
  const moves = ({ from, to }) => effect.subarray(from, to).some((value) => Math.abs(value) > 0);
  const block = blocksOf(series, series.blocks[0].sensor).find(moves) ?? series.blocks[0];
  const to = end(effect, block);
  // A pass that goes back over its own travel would lie on itself.
  const along = series.position_mm && new Curve(series.position_mm, left, block.from, to);
  const x = along?.sorted ? series.position_mm : series.time_s;
  const [residual, shape] = [left, effect].map((values) => new Curve(x, values, block.from, to));
  const [low, high] = residual.range();
  const bands = [residual, shape].map((curve) => curve.thinned(low, high, WIDTH));
  const all = bands.flatMap(({ least, most }) => [...least, ...most]).filter((value) => value !== undefined);
  const [bottom, top] = [Math.min(...all), Math.max(...all)];
  const y = (value) => (HEIGHT - 4 - ((value - bottom) / (top - bottom || 1)) * (HEIGHT - 8)).toFixed(1);
  const over = `${number(low, 4)} – ${number(high, 4)} ${x === series.time_s ? "s" : "mm"}`;
  return drawn("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": t("effects.sketch", { effect: name, over }) },
    drawn("path", { class: "left", d: dots(bands[0], y) }), drawn("path", { class: "shape", d: line(bands[1], y) }));
}

// The row behind the last that is drawn.
function end(effect, { from, to }) {
  let passages = 0;
  for (let row = from + 1; row < to; row++) {
    if (effect[row - 1] < 0 !== effect[row] < 0) passages += 1;
    if (PASSAGES < passages) return row;
  }
  return to;
}

function dots({ least, most }, y) {
  return least.map((value, column) => (value === undefined ? "" : `M${column} ${y(value)}V${(Number(y(most[column])) - 0.1).toFixed(1)}`)).join("");
}

function line({ least, most }, y) {
  let path = "";
  least.forEach((value, column) => {
    if (value !== undefined) path += `${path ? "L" : "M"}${column} ${y(value)}${most[column] === value ? "" : `V${y(most[column])}`}`;
  });
  return path;
}

// Screen "Which effect": a card a candidate; try it over the data, take it, or refuse it.

import { app, get, getFrame, post, postFrame } from "./api.js";
import { run, showMessage } from "./jobs.js";
import { doubtCards } from "./doubts.js";
import { blocksOf, centre, unitOf } from "./fails.js";
import { button, chance, make, number, table } from "./make.js";
import { Chart, curvesOf } from "./plot.js";
import { sketches } from "./sketch.js";
import { named, say, t } from "./words.js";

// The last diagnosis, for the machine file and data it was made of.
let last = null;

// What the last diagnosis of these data takes for noise; nothing where it did not come to an end.
export function noiseOf(data) {
  const told = last?.data === data && ["explained", "ambiguous", "nothing-missing"].includes(last.result.verdict);
  return told ? last.result.noise_um : null;
}

export async function show(root, page) {
  const place = make("div", { id: "diagnosis" });
  const find = button(t("effects.find"), () => page.attempt(() => diagnose(place, page)), { class: "first", id: "find" });
  root.append(make("h2", {}, t("effects.title")), make("p", {}, t("effects.what")), make("div", { class: "row" }, find), place);
  if (last && last.revision === app.revision && last.data === app.data) await render(place, page);
}

async function diagnose(place, page) {
  const found = await run("diagnose");
  if (!found) return;
  last = { revision: app.revision, data: app.data, result: found.result };
  await render(place, page);
}

// What a diagnosis says: its verdict, what it would add, and everything else that was tried.
async function render(root, page) {
  const { result } = last;
  // Asked for before anything is drawn, so that a verdict never stands without its cards.
  const catalogue = new Map((await get("catalogue")).map((about) => [about.effect, about]));
  const unit = t(`unit.${result.unit}`);
  const first = result.rounds[0];
  const final = result.rounds[result.rounds.length - 1];
  const verdict = make("p", { id: "verdict", "data-verdict": result.verdict }, make("strong", {}, named("verdict", result.verdict)));
  root.replaceChildren(verdict);
  if (result.doubts.length) {
    root.append(doubtCards(result.doubts, page, () => page.attempt(() => diagnose(root, page))));
    return;
  }
  root.append(make("dl", { class: "numbers" },
    make("div", {}, make("dt", {}, t("effects.now")), make("dd", { "data-key": "now", "data-value": first.rms_um }, `${number(first.rms_um)} ${unit}`)),
    make("div", {}, make("dt", {}, t("effects.then")), make("dd", { "data-key": "noise_um", "data-value": result.noise_um }, `${number(result.noise_um)} ${unit}`))));
  const suggested = result.effects ?? [];
  const refused = new Map((app.state.ledger?.rounds ?? []).flatMap((round) => round.refused ?? []).map((one) => [one.effect, one.reason]));
  if (suggested.length) root.append(makeAll(result, page, suggested, refused));
  root.append(unexplained(result, unit));
  const trial = make("div", { id: "trial" });
  root.append(trial);
  const isSuggested = (one) => suggested.some((effect) => effect.effect === one.effect);
  const cards = result.candidates.map((one) => card(one, { result, unit, trial, page, refused, suggested: isSuggested(one), about: catalogue.get(one.effect) }));
  const top = cards.filter((_, index) => isSuggested(result.candidates[index]));
  const rest = cards.filter((_, index) => !isSuggested(result.candidates[index]));
  root.append(make("ul", { class: "cards" }, top));
  const others = make("details", { open: !top.length }, make("summary", {}, t("effects.others", { n: rest.length })), make("ul", { class: "cards" }, rest));
  if (rest.length) root.append(others);
  draw(top, others, page);
  if (result.experiments.length) {
    const rows = result.experiments.map((one) => [say(one.action), one.between.map((name) => named("effect", name)).join(" / "), number(one.separation_um, 3)]);
    root.append(table(t("effects.experiments"), [t("effects.experiment"), t("effects.between"), t("effects.apart", { unit })], rows, [2]));
  }
}

// Fills the cards in with shapes; those that are folded away once they are opened.
async function draw(top, others, page) {
  const places = (cards) => [...cards].map((one) => one.querySelector(".sketch")).filter(Boolean);
  const fill = (cards) => page.attempt(() => sketches(places(cards)));
  await fill(top);
  const rest = others.querySelectorAll("li");
  if (others.open) await fill(rest);
  else others.addEventListener("toggle", () => fill(rest), { once: true });
}

// Everything that is suggested at once: what `helixlock learn` does. It knows of no refusal, so that
// beside one each effect is added by itself.
function makeAll(result, page, suggested, refused) {
  const listed = (effects) => effects.map((effect) => named("effect", effect.effect)).join(", ");
  const names = listed(suggested);
  const unwanted = listed(suggested.filter((effect) => refused.has(effect.effect)));
  const take = () => page.attempt(async () => {
    const found = await run("learn");
    if (!found) return;
    const before = app.state.machine.text;
    await post("take", { job: found.job });
    await page.refresh();
    await page.show("fall");
    showMessage(app.state.machine.text === before ? t("effects.nothing_added") : t("page.saved"));
  });
  const held = result.verdict === "unexplained";
  return make("div", {}, make("p", {}, held ? t("effects.held", { names }) : t("effects.suggested", { names })),
    unwanted ? make("p", {}, t("effects.unwanted", { names: unwanted })) : null,
    held || unwanted ? null : make("div", { class: "row" }, button(t("effects.add_all"), take, { class: "first", id: "add-all" })));
}

// What the best model leaves that no effect accounts for.
function unexplained(result, unit) {
  if (!result.residual.length) return make("div", {});
  const rows = result.residual.map((one) => [say(one.along), say(one.shape), number(one.rms_um), chance(one.p_value)]);
  return table(t("effects.left"), [t("fails.along"), t("fails.shape"), t("fails.size", { unit }), t("fails.chance")], rows, [2, 3]);
}

function card(one, { result, unit, trial, page, refused, suggested, about }) {
  const first = result.rounds[0];
  const names = (all) => all.map((name) => named("effect", name)).join(", ");
  const against = result.rounds.flatMap((round) => round.rejected).find((rejected) => rejected.effect === one.effect);
  const place = make("div", {});
  const fact = (word, text) => (text ? make("p", {}, make("span", { class: "dim" }, `${word} `), text) : null);
  const tried = () => page.attempt(() => tryEffect(one.effect, trial, page));
  const add = () => page.attempt(async () => {
    const found = await run("add", { effect: one.effect });
    if (found) await take(found.job, page);
  });
  return make("li", { class: suggested ? "card suggested" : "card", "data-effect": one.effect },
    suggested ? make("span", { class: "badge" }, t("effects.badge")) : null,
    make("h3", {}, named("effect", one.effect)),
    make("p", { class: "dim" }, make("code", {}, one.effect), about ? ` · ${t(`entry.${about.entry}`)}` : ""),
    about ? make("p", {}, about.summary) : null,
    about ? make("div", { class: "sketch", "data-effect": one.effect }) : null,
    fact(suggested ? t("effects.in_model") : t("effects.alone"), `${number(first.rms_um)} → ${number(one.rms_um)} ${unit}`),
    fact(t("effects.held_out"), `${number(one.holdout_rms_um)} ${unit}`),
    fact(t("effects.chance"), chance(one.p_value)),
    fact(t("effects.behind"), one.evidence_behind > 0 ? number(one.evidence_behind, 3) : null),
    fact(t("effects.against"), against && !suggested ? say(against.reason) : null),
    fact(t("effects.confused"), names(one.confounded_with)),
    one.confounded_with.length ? null : fact(t("effects.alike"), names(about?.confused_with ?? [])),
    fact(t("effects.separate"), one.separate_by ? say(one.separate_by) : about?.separated_by),
    refused.has(one.effect) ? make("p", { class: "refused" }, make("span", { class: "dim" }, `${t("effects.refused")} `), make("bdi", {}, refused.get(one.effect))) : null,
    about ? make("div", { class: "row" },
      button(t("effects.try"), tried, { class: "try" }),
      button(t("effects.add"), add, { class: "add" }),
      button(t("effects.refuse"), () => refuse(one.effect, place, page), { class: "refuse" })) : null,
    place);
}

async function take(job, page) {
  await post("take", { job });
  await page.refresh();
  await page.show("fall");
  showMessage(t("page.saved"));
}

// Asks why, and keeps it in the ledger.
function refuse(effect, place, page) {
  const reason = make("input", { "aria-label": t("effects.reason"), placeholder: t("effects.reason") });
  const keep = () => page.attempt(async () => {
    if (!reason.value.trim()) return reason.focus();
    await post("refuse", {}, { effect, reason: reason.value.trim() });
    await page.refresh();
    last.revision = app.revision;
    await page.show("effects");
    showMessage(t("page.saved"));
  });
  place.replaceChildren(make("div", { class: "row" }, reason, button(t("effects.keep"), keep, { class: "keep" })));
  reason.focus();
}

// Fits an effect and draws it over the data; its values can be moved within three standard errors.
async function tryEffect(effect, root, page) {
  const found = await run("add", { effect });
  if (!found) return;
  const series = await getFrame("series");
  const unit = unitOf(series);
  const sensors = [...new Set(series.blocks.map((block) => block.sensor))];
  const fitted = found.result.effects[found.result.effects.length - 1];
  const moved = {};
  const sizes = make("div", {});
  const charts = make("div", {});
  const x = series.position_mm ?? series.time_s;
  const across = t(series.position_mm ? "axis_label.position_mm" : "axis_label.time_s");
  root.replaceChildren(...[
    make("h2", {}, t("effects.over", { effect: named("effect", effect) })), sizes, charts,
    sliders(fitted?.parameters ?? {}, moved, () => page.attempt(draw)),
    make("div", { class: "row" },
      button(t("effects.add"), () => page.attempt(() => take(found.job, page)), { class: "first", id: "take" }),
      button(t("effects.close"), () => root.replaceChildren())),
  ]);
  const drawn = sensors.map((sensor) => {
    const blocks = series.blocks.filter((block) => block.sensor === sensor);
    const before = curvesOf(x, centre(series.residual, series.blocks), blocks);
    const lines = (effectOf, after) => [
      { label: t("effects.before"), colour: "orange", curves: before, dots: series.rows < 3000 },
      { label: t("effects.effect"), colour: "green", curves: effectOf },
      { label: t("effects.after"), colour: "blue", curves: after, dots: series.rows < 3000 },
    ];
    const chart = new Chart(charts, { title: named("sensor", sensor), x: across, y: unit, lines: lines(before, before) });
    return { chart, blocks, lines };
  });
  // Only the last position of a slider counts: one drawing at a time, the next when it is done.
  let busy = false;
  let again = false;
  async function draw() {
    if (busy) {
      again = true;
      return;
    }
    busy = true;
    try {
      const trial = await postFrame("trial", { job: found.job }, { values: moved });
      const left = centre(trial.residual, series.blocks);
      const effectOf = centre(series.residual.map((value, row) => value - trial.residual[row]), series.blocks);
      for (const { chart, blocks, lines } of drawn) chart.replace(lines(curvesOf(x, effectOf, blocks), curvesOf(x, left, blocks)));
      const rows = trial.sensors.map((one) => [named("sensor", one.sensor), number(one.rms_before), number(one.rms_after)]);
      sizes.replaceChildren(table(t("effects.sizes", { unit }), [t("fails.sensor"), t("effects.before"), t("effects.after")], rows, [1, 2]));
    } finally {
      busy = false;
    }
    if (again) {
      again = false;
      await draw();
    }
  }
  await draw();
  root.scrollIntoView({ block: "start" });
}

function sliders(parameters, moved, draw) {
  const slider = ([key, { value, stderr }]) => {
    const shown = make("output", {}, number(value));
    if (!stderr) return make("div", { class: "slider" }, make("code", {}, key), make("span", {}, t("effects.from_list")), shown);
    const input = make("input", { type: "range", min: value - 3 * stderr, max: value + 3 * stderr, step: stderr / 20, "aria-label": key, input: () => {
      moved[key] = Number(input.value);
      shown.textContent = number(moved[key]);
      draw();
    } });
    input.value = value;
    return make("label", { class: "slider" }, make("span", {}, make("code", {}, key), ` ± ${number(stderr, 2)}`), input, shown);
  };
  const all = Object.entries(parameters);
  return make("div", {}, all.length ? make("h3", {}, t("effects.sliders")) : null, all.map(slider));
}

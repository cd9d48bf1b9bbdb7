// Screen "The error falls": a step an effect, from the first residual to the noise.

import { app, post } from "./api.js";
import { noiseOf } from "./effects.js";
import { run, showMessage } from "./jobs.js";
import { button, make, number, table } from "./make.js";
import { named, t } from "./words.js";

export async function show(root, page) {
  const ledger = app.state.ledger;
  root.append(make("h2", {}, t("fall.title")));
  if (!ledger) {
    root.append(make("p", {}, t("fall.nothing")));
    return;
  }
  const unit = t(`unit.${ledger.unit === "arcsec" ? "arcsec" : "um"}`);
  const turn = (what) => () => page.attempt(async () => {
    await post(what);
    await page.refresh();
    await page.show("fall");
    showMessage(t("page.saved"));
  });
  const list = make("div", {});
  let sized;
  const kept = async () => {
    await sized;
    await keep(root);
  };
  root.append(
    make("div", { class: "row" },
      button(t("fall.undo"), turn("undo"), { id: "undo", disabled: !app.state.can_undo }),
      button(t("fall.redo"), turn("redo"), { id: "redo", disabled: !app.state.can_redo }),
      button(t("fall.print"), () => window.print()),
      button(t("fall.export"), () => page.attempt(kept), { id: "export" })),
    list);
  draw(list, ledger, unit, null);
  root.append(parameters(ledger), refusals(ledger));
  if (app.data) sized = noise(list, ledger, unit, page);
}

// What is left after the last round, and what of it is noise: what `helixlock compare` finds now.
async function noise(list, ledger, unit, page) {
  const found = await page.attempt(() => run("compare"));
  if (!found) return;
  const own = found.result.sensors;
  const samples = own.reduce((sum, one) => sum + one.samples, 0);
  const slow = (one) => one.noise.slow.reduce((sum, part) => sum + part.rms_um ** 2, 0);
  const square = own.reduce((sum, one) => sum + one.samples * (one.noise.white_um ** 2 + slow(one)), 0);
  const rms = Math.sqrt(own.reduce((sum, one) => sum + one.samples * one.rms_um ** 2, 0) / samples);
  const only = found.result.noise_only;
  // Beside structure the noise would hold that, too: there it is known from a diagnosis or not at all.
  draw(list, ledger, unit, { noise: only ? Math.sqrt(square / samples) : noiseOf(app.data), rms, only });
}

// Rounds that stand, each from where the one before has left the error.
function draw(root, ledger, unit, now) {
  const standing = ledger.rounds.filter((round) => !round.taken_back);
  const back = ledger.rounds.filter((round) => round.taken_back);
  const highest = Math.max(...ledger.rounds.flatMap((round) => [round.rms_um ?? 0, round.rms_before_um ?? 0]), now?.noise ?? 0, 1e-12);
  const share = (value) => `${(100 * Math.max(0, value)) / highest}%`;
  const row = (round) => {
    const before = round.rms_before_um ?? round.rms_um ?? 0;
    const after = round.rms_um ?? before;
    const name = round.added ? `+ ${named("effect", round.added)}` : round.round === 0 ? t("fall.first") : t("fall.by_hand");
    const bar = make("span", { class: "bar", "aria-hidden": "true" },
      make("i", { class: "now", style: `width:${share(after)}` }),
      after < before ? make("i", { class: "gone", style: `left:${share(after)};width:${share(before - after)}` }) : null,
      now?.noise ? make("i", { class: "noise", style: `width:${share(now.noise)}` }) : null);
    return make("li", { class: round.taken_back ? "back" : null, "data-rms": round.rms_um }, make("span", {}, name), bar, make("span", { class: "n" }, round.rms_um == null ? "–" : `${number(round.rms_um)} ${unit}`));
  };
  const last = now ? make("p", { id: "left", "data-rms": now.rms, "data-noise": now.noise ?? null }, left(now, unit)) : null;
  root.replaceChildren(...[
    make("ol", { class: "falls", id: "standing" }, standing.map(row)),
    back.length ? make("h3", {}, t("fall.back")) : null,
    back.length ? make("ol", { class: "falls" }, back.map(row)) : null,
    last,
  ].filter(Boolean));
}

function left({ rms, noise, only }, unit) {
  const sizes = { rms: number(rms), noise: number(noise), unit };
  if (only) return t("fall.only_noise", sizes);
  return noise ? t("fall.more", sizes) : t("fall.more_than_noise", sizes);
}

function parameters(ledger) {
  const standing = ledger.rounds.filter((round) => !round.taken_back);
  const model = standing[standing.length - 1]?.model ?? [];
  const rows = model.flatMap((effect) => Object.entries(effect.parameters).map(([key, one]) => [named("effect", effect.effect), make("code", {}, key), number(one.value, 6), one.stderr == null ? t("effects.from_list") : number(one.stderr, 3)]));
  if (!rows.length) return make("div", {});
  return table(t("fall.parameters"), [t("fall.effect"), t("fall.parameter"), t("fall.value"), t("fall.stderr")], rows, [2, 3]);
}

function refusals(ledger) {
  const rows = ledger.rounds.flatMap((round) => round.refused ?? []).map((one) => [named("effect", one.effect), make("bdi", {}, one.reason)]);
  if (!rows.length) return make("div", {});
  return table(t("fall.refused"), [t("fall.effect"), t("effects.reason")], rows);
}

// The screen as one page that needs nothing else.
async function keep(root) {
  const style = await (await fetch("style.css")).text();
  const copy = root.cloneNode(true);
  for (const element of copy.querySelectorAll("button")) element.remove();
  const title = make("title", {}, document.title).outerHTML;
  const text = `<!DOCTYPE html>\n<html lang="${document.documentElement.lang}">\n<head>\n<meta charset="utf-8">\n<meta name="viewport" content="width=device-width, initial-scale=1">\n${title}\n<style>\n${style}</style>\n</head>\n<body>\n<main>${copy.innerHTML}</main>\n</body>\n</html>\n`;
  const link = make("a", { href: URL.createObjectURL(new Blob([text], { type: "text/html" })), download: "the-error-falls.html" });
  link.click();
}

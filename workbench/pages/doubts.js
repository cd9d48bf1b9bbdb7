// What looks mistaken, as cards with their mends.

import { post } from "./api.js";
import { showMessage } from "./jobs.js";
import { button, make, number } from "./make.js";
import { named, say, t } from "./words.js";

const canMend = (mend) => mend.startsWith("[[column]]") || mend.split("\n").every((line) => /^[ab] = \d+$/.test(line));

// One card a doubt; `mended` is called with the name of the new data file, or none.
export function doubtCards(doubts, page, mended) {
  const card = (doubt) => {
    const mend = () => page.attempt(async () => {
      const answer = await post("mend", {}, { mend: doubt.mend });
      await page.refresh(answer.data ? { data: answer.data } : {});
      showMessage(answer.data ? t("doubt_card.mended", { file: answer.data }) : t("page.saved"));
      await mended();
    });
    return make("li", { class: "card doubt", "data-what": doubt.what },
      make("h3", {}, named("doubt", doubt.what)),
      make("p", {}, say(doubt.says)),
      make("p", { class: "dim" }, t("doubt_card.evidence", { n: number(doubt.evidence, 3) })),
      make("pre", { tabindex: 0 }, doubt.mend),
      canMend(doubt.mend) ? button(t("doubt_card.mend"), mend, { class: "first mend" }) : make("p", {}, t("doubt_card.by_hand")));
  };
  return make("div", {}, make("h2", {}, t("doubt_card.title")), make("p", {}, t("doubt_card.first")), make("ul", { class: "cards doubts" }, doubts.map(card)));
}


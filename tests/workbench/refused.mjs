// An effect that its user does not want.

import { hold, opened, screen } from "./browser.mjs";

// Refused with a reason, by the mouse: its card and the rounds say so, now and after the page was
// opened again; what is suggested is no longer added at once, and each effect still by itself.
export async function refuses(url, effect, reason) {
  const { browser, page, faults } = await opened(url);
  const card = `li[data-effect="${effect}"]`;
  const find = async () => {
    await screen(page, "effects");
    const told = page.waitForResponse((answer) => answer.url().includes("/api/result?"));
    await page.click("#find");
    await told;
    await page.waitForSelector(card);
  };
  await find();
  await page.waitForSelector("#add-all");
  await page.click(`${card} .refuse`);
  await page.click(`${card} .keep`);
  hold((await page.$(`${card} .refused`)) === null, "nothing is refused without a reason");
  await page.keyboard.type(reason);
  await page.click(`${card} .keep`);
  const refused = () => page.textContent(`${card} .refused bdi`);
  hold((await refused()) === reason, await refused());
  await page.reload();
  await page.waitForSelector("html[data-ready=yes]");
  await find();
  hold((await refused()) === reason, `${await refused()}, after the page was opened again`);
  hold((await page.$("#add-all")) === null, "what was refused is not added with the rest");
  await screen(page, "fall");
  await page.waitForSelector("#fall #left"); // no work is under way that the next would end
  hold((await page.textContent("#fall table")).includes(reason), "the rounds have the reason");
  await find();
  await page.click(`${card} .add`);
  await page.waitForSelector("#fall #left");
  const sizes = await page.$$eval("#standing li", (all) => all.map((one) => Number(one.dataset.rms)));
  hold(sizes.length === 2 && 0 < sizes[1] && sizes[1] < sizes[0], `the error falls: ${sizes}`);
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

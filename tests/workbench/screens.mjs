// The screens of the workbench, each with all that it can show.

import { idle, screen } from "./browser.mjs";

export const SCREENS = ["measurement", "machine", "fails", "effects", "fall", "waves", "device"];

// Opens a screen and lets it come to rest with all that it can show.
export async function full(page, name) {
  await screen(page, name);
  if (name === "measurement") await page.waitForSelector("#sound");
  if (name === "fails") await page.waitForSelector("#sentence");
  if (name === "effects") {
    await page.click("#find");
    await page.waitForSelector("#verdict");
    await page.click(".try");
    await page.waitForSelector("#trial .scroll table");
    await page.waitForFunction(() => [...document.querySelectorAll("#diagnosis > .cards .sketch")].every((place) => place.querySelector("svg")));
  }
  if (name === "waves") {
    await page.click("#run");
    await page.waitForSelector("#bits svg");
    await page.click("#look");
    await page.waitForSelector("#bits svg .value");
  }
  if (name === "device") await page.waitForSelector("#before-after canvas");
  await idle(page);
}

// The screens on paper.

import { hold, opened, screen } from "./browser.mjs";
import { full, SCREENS } from "./screens.mjs";

// Width of an A4 sheet within its margins, px.
const SHEET_PX = 680;

// Prints every screen from a browser in the dark, and the exported page, into a folder; says the
// headings of each.
export async function prints(url, folder) {
  const { browser, page, faults } = await opened(url, { dark: true });
  const headings = {};
  for (const name of SCREENS) {
    await full(page, name);
    headings[name] = await printed(page, `#${name}`, `${folder}/${name}.pdf`);
    if (name === "effects") await adds(page);
  }
  await screen(page, "fall");
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#export")]);
  const kept = await page.context().newPage();
  await download.saveAs(`${folder}/kept.html`);
  await kept.goto(`file://${folder}/kept.html`);
  headings.kept = await printed(kept, "main", `${folder}/kept.pdf`);
  hold(faults.length === 0, faults.join("\n"));
  process.stdout.write(JSON.stringify(headings));
  await browser.close();
}

// Everything that was suggested, so that the error has something to fall by.
async function adds(page) {
  await page.click("#add-all");
  await page.waitForSelector("#fall #left");
}

// Prints what is open; its headings.
async function printed(page, root, path) {
  await page.pdf({ path, preferCSSPageSize: true });
  const size = page.viewportSize();
  await page.evaluate(() => window.dispatchEvent(new Event("beforeprint")));
  await page.emulateMedia({ media: "print" });
  await page.setViewportSize({ ...size, width: SHEET_PX });
  const { cut, headings, colours } = await page.evaluate(onPaper, root);
  await page.emulateMedia({ media: null });
  await page.setViewportSize(size);
  await page.evaluate(() => window.dispatchEvent(new Event("afterprint")));
  hold(cut.length === 0, `${root}: ${cut.join("\n")}`);
  hold(colours.every((colour) => colour === "rgb(75, 85, 96)"), `${root}: axes in ${colours}`);
  const back = await page.evaluate(() => [...document.querySelectorAll("figure.chart")].map(({ chart }) => chart.plot.axes[0].stroke()));
  hold(back.length === colours.length && back.every((colour) => colour === "rgb(170, 180, 190)"), `${root}: axes in ${back} again`);
  return headings;
}

// What would not be whole on a sheet, and the headings on it.
function onPaper(root) {
  const cut = [];
  const shown = [...document.querySelectorAll(`header, header *, ${root}, ${root} *`)].filter((one) => one.checkVisibility());
  for (const element of shown) {
    const { right, left } = element.getBoundingClientRect();
    const name = `${element.tagName} ${element.id || element.className} ${element.textContent.trim().slice(0, 30)}`;
    if (left < 0 || window.innerWidth + 0.5 < right) cut.push(`${name}: from ${left} to ${right}`);
    const hides = getComputedStyle(element).overflow !== "visible" && !element.closest("svg, select, .u-wrap");
    if (hides && (element.clientWidth + 1 < element.scrollWidth || element.clientHeight + 1 < element.scrollHeight)) cut.push(`${name}: ${element.scrollWidth} x ${element.scrollHeight} in ${element.clientWidth} x ${element.clientHeight}`);
  }
  const headings = shown.filter((one) => one.matches("h2, h3, caption, [open] > summary")).map((one) => one.innerText.trim());
  const lost = [...document.querySelectorAll(`${root} .strip, ${root} .bar, ${root} textarea`)].filter((one) => !one.checkVisibility());
  cut.push(...lost.map((one) => `${one.className} is not on paper: ${one.textContent}`));
  const colours = [...document.querySelectorAll("figure.chart")].map(({ chart }) => chart.plot.axes[0].stroke());
  return { cut, headings, colours };
}

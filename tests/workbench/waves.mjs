// The screen "Waves": from the residual to the flip-flops.

import { hold, idle, opened, screen } from "./browser.mjs";

// How far from a jump the first sample behind it may be, mm.
const APART_MM = 1.5;

// Longer than a run takes, ms.
const LATE_MS = 2000;

// The instant that is looked at, and what each signal is there: the flip-flops are of that instant.
async function looked(page, mm_a_second) {
  const asked = Number(await page.inputValue("#instant"));
  const { rows, title } = await page.$eval("#bits", (bits) => {
    const texts = (name) => [...bits.querySelectorAll(name)].map((text) => text.textContent);
    const names = texts(".name");
    return { rows: Object.fromEntries(texts(".value").map((value, row) => [names[row], value])), title: bits.querySelector("h3").textContent };
  });
  hold(Math.abs(Number(rows.position_mm) - mm_a_second * asked) < 0.5, `${rows.position_mm} mm at ${asked} s`);
  hold(["0", "1"].includes(rows.q) && ["0", "1"].includes(rows.t1), `q ${rows.q}, t1 ${rows.t1}`);
  hold(title.includes(String(Number(asked.toPrecision(8)))), `${title}, ${asked} s`);
  return asked;
}

// A click on the residual shows the flip-flops at that place, with their values.
export async function flips(url, mm_a_second) {
  const { browser, page, faults } = await opened(url);
  await screen(page, "waves");
  await page.click("#run");
  await page.waitForSelector("#bits svg");
  await page.click("#waves-residual .u-over", { position: { x: 200, y: 40 } });
  await page.waitForSelector("#bits svg .value");
  await looked(page, mm_a_second);
  await yields(page, mm_a_second);
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// Work gives way to what is begun after it, even where the workbench has not answered yet: the
// instant that was asked last is shown.
async function yields(page, mm_a_second) {
  const late = async (route) => {
    await new Promise((done) => setTimeout(done, LATE_MS));
    await route.continue();
  };
  await page.route(/api\/begin\?.*from=/, late);
  await page.evaluate(() => {
    document.getElementById("bits").replaceChildren();
    ["run", "look"].forEach((id) => document.getElementById(id).click());
  });
  await page.waitForSelector("#bits svg .value");
  await idle(page);
  await looked(page, mm_a_second);
}

// Where the residual jumps there is a button; it, and a click on the jump in "Where it fails", show
// the flip-flops there.
export async function jumps(url, mm_a_second, ...places) {
  const { browser, page, faults } = await opened(url);
  await screen(page, "waves");
  await page.click("#run");
  await page.waitForSelector("#jumps .jump");
  const offered = await page.$$eval("#jumps .jump", (all) => all.map((one) => one.textContent));
  hold(offered.length === places.length, `${offered}`);
  const wanted = (mm) => page.waitForFunction(([mm, speed, apart]) => document.querySelector("#bits svg .value") && Math.abs(document.getElementById("instant").value - mm / speed) < apart / speed, [mm, mm_a_second, APART_MM]);
  for (const [index, mm] of places.entries()) {
    await page.click(`#jumps .jump:nth-of-type(${index + 1})`);
    await wanted(mm);
    await page.waitForFunction((at) => document.querySelector("#bits h3").textContent.includes(at), (await page.inputValue("#instant")).replace(/\.?0+$/, ""));
    await looked(page, mm_a_second);
    const said = Number(offered[index].match(/at ([0-9.]+) mm/)[1]);
    hold(Math.abs(said - mm) < APART_MM, `${offered[index]}, and it jumps at ${mm} mm`);
  }
  await fromResidual(page, Number(places[0]), wanted);
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// The same from the residual of "Where it fails".
async function fromResidual(page, mm, wanted) {
  await screen(page, "fails");
  await page.waitForSelector("#sentence");
  const [low, high] = await page.$eval("#residual", (figure) => figure.dataset.view.split(" ").map(Number));
  const { width } = await page.locator("#residual .u-over").boundingBox();
  await page.click("#residual .u-over", { position: { x: (width * (mm - low)) / (high - low), y: 40 } });
  await page.click("#to-waves");
  await wanted(mm);
}

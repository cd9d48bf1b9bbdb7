// What a user does in the workbench; `node stories.mjs STORY URL …` does one.

import { readFileSync } from "node:fs";

import { axeSource, hold, idle, opened, picture, screen } from "./browser.mjs";

// Everything with the mouse: data dropped, read, saved; what is missing found and added.
async function learns(url, data) {
  const { browser, page, faults } = await opened(url);
  await page.setInputFiles("#file", data);
  await page.click("#save");
  await page.waitForSelector("#sound");
  await screen(page, "fails");
  await page.waitForSelector("#sentence");
  await screen(page, "effects");
  await page.click("#find");
  await page.waitForSelector("#verdict");
  await page.click("#add-all");
  await page.waitForSelector("#fall #left");
  const { rms, noise } = await page.$eval("#left", (left) => left.dataset);
  await picture(page, "fall");
  hold(Number(rms) <= 1.1 * Number(noise), `left ${rms}, noise ${noise}`);
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// One effect tried, its slider moved, taken; taken back and done again; another refused.
async function tries(url, effect) {
  const { browser, page, faults } = await opened(url);
  await screen(page, "effects");
  await page.click("#find");
  const card = `[data-effect="${effect}"]`;
  await page.click(`${card} .try`);
  await page.waitForSelector("#trial table");
  const sizes = () => page.textContent("#trial table");
  const fitted = await sizes();
  await page.$eval("#trial input[type=range]", (slider) => {
    slider.value = slider.max;
    slider.dispatchEvent(new Event("input"));
  });
  await page.waitForFunction((before) => document.querySelector("#trial table").textContent !== before, fitted);
  await page.click("#take");
  await page.waitForSelector("#fall #left");
  const standing = () => page.$$eval("#standing li", (rounds) => rounds.length);
  hold((await standing()) === 2, `${await standing()} rounds`);
  await page.click("#undo");
  await page.waitForSelector("#redo:not([disabled])");
  hold((await standing()) === 1, "the round is taken back");
  await page.click("#redo");
  await page.waitForSelector("#undo:not([disabled])");
  hold((await standing()) === 2, "the round is done again");
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// A doubt is shown before any verdict; its one button leads to sound data.
async function mends(url, what) {
  const { browser, page, faults } = await opened(url);
  await screen(page, "measurement");
  await page.click(`.doubt[data-what="${what}"] .mend`);
  await page.waitForSelector("#sound");
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// What is not explained is said to be so, and nothing is added.
async function leaves(url) {
  const { browser, page, faults } = await opened(url);
  await screen(page, "effects");
  await page.click("#find");
  await page.waitForSelector("#verdict[data-verdict=unexplained]");
  hold((await page.$("#add-all")) === null, "nothing is offered to be added at once");
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// The numbers on the screen are those that the page was given, and these the command's own.
async function shows(url) {
  const { browser, page, faults } = await opened(url);
  const said = {};
  page.on("response", async (answer) => {
    if (answer.url().includes("/api/result?")) Object.assign(said, { text: await answer.text() });
  });
  await screen(page, "fails");
  await page.waitForSelector("#sentence");
  await idle(page);
  const shown = await page.$$eval("#compared dd[data-key=rms_um]", (all) => all.map((one) => one.dataset.value));
  const sensors = JSON.parse(said.text).sensors.map((one) => String(one.rms_um));
  hold(shown.join() === sensors.join(), `${shown} on the screen, ${sensors} said`);
  hold(faults.length === 0, faults.join("\n"));
  process.stdout.write(said.text);
  await browser.close();
}

const SCREENS = ["measurement", "machine", "fails", "effects", "fall", "waves", "device"];

// Opens a screen and lets it come to rest with all that it can show.
async function full(page, name) {
  await screen(page, name);
  if (name === "measurement") await page.waitForSelector("#sound");
  if (name === "fails") await page.waitForSelector("#sentence");
  if (name === "effects") {
    await page.click("#find");
    await page.waitForSelector("#verdict");
    await page.click(".try");
    await page.waitForSelector("#trial table");
  }
  if (name === "waves") {
    await page.click("#run");
    await page.waitForSelector("#bits svg");
  }
  if (name === "device") {
    await page.click("#simulate");
    await page.waitForSelector("#simulated table");
  }
  await idle(page);
}

// Texts that are too small, what sticks out sideways, and English words in a Chinese page; names
// that users or the circuit gave to things are nobody's to translate.
function unreadable(chinese) {
  const found = [];
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const text = walk.currentNode.textContent.trim();
    const element = walk.currentNode.parentElement;
    if (!text || !element.checkVisibility()) continue;
    if (parseFloat(getComputedStyle(element).fontSize) < 11) found.push(`small: ${text}`);
    const own = element.closest("code, pre, textarea, option, bdi, svg, .peak, [lang=en]");
    if (chinese && !own && /[A-Za-z]{4,}/.test(text) && !/[\u4e00-\u9fff]/.test(text) && text !== "helixlock") found.push(`English: ${text}`);
  }
  const over = document.documentElement.scrollWidth - window.innerWidth;
  if (over > 0) found.push(`${over} px too wide`);
  for (const button of document.querySelectorAll("button, select, input")) {
    const box = button.getBoundingClientRect();
    const scrolls = button.closest(".scroll");
    if (box.width && !scrolls && (box.left < 0 || window.innerWidth < box.right)) found.push(`out of reach: ${button.textContent}`);
  }
  return found;
}

// Every screen in one look: readable, reachable, and without a serious finding of axe-core.
async function reads(url, device, light, language) {
  const size = device === "phone" ? { width: 390, height: 844 } : {};
  const { browser, page, faults } = await opened(url, { ...size, dark: light === "dark", language });
  const found = [];
  for (const name of SCREENS) {
    await full(page, name);
    if (name !== "fall" && device === "desk" && light === "light") await picture(page, name);
    found.push(...(await page.evaluate(unreadable, language.startsWith("zh"))).map((one) => `${name}: ${one}`));
    found.push(...(await serious(page)).map((one) => `${name}: ${one}`));
  }
  hold(found.length === 0, found.join("\n"));
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// What axe-core calls serious or worse.
async function serious(page) {
  await page.evaluate(readFileSync(axeSource(), "utf8"));
  const { violations } = await page.evaluate(() => window.axe.run());
  const bad = violations.filter(({ impact }) => impact === "serious" || impact === "critical");
  return bad.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html.slice(0, 120)).join(" | ")}`);
}

// Every name in a spectrum stands at a drawn peak, and no two texts of a chart overlap.
async function labels(url) {
  const { browser, page, faults } = await opened(url);
  let points = [];
  page.on("response", async (answer) => {
    if (answer.url().includes("/api/spectrum?")) points = (await answer.json()).points;
  });
  await screen(page, "fails");
  const found = [];
  let shown = 0;
  for (const name of await page.$$eval("#choose-machine option", (all) => all.map((one) => one.value))) {
    await page.evaluate(() => document.getElementById("spectrum")?.remove());
    await page.selectOption("#choose-data", name.replace("toml", "csv"));
    await page.waitForSelector("#spectrum", { state: "attached" });
    await page.evaluate(() => document.getElementById("spectrum")?.remove());
    await page.selectOption("#choose-machine", name);
    await page.waitForSelector("#spectrum", { state: "attached" });
    const { count, faults } = await page.evaluate(misplaced, points);
    shown += count;
    found.push(...faults.map((fault) => `${name}: ${fault}`));
  }
  hold(found.length === 0, found.join("\n"));
  hold(shown > 0, "no spectrum has a name");
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// Looks at what is drawn: the points of the curve under each name.
function misplaced(points) {
  const chart = document.getElementById("spectrum");
  const tags = [...chart.querySelectorAll(".peak")];
  const faults = [];
  const boxes = tags.map((tag) => tag.getBoundingClientRect());
  for (const [index, box] of boxes.entries()) {
    for (const other of boxes.slice(index + 1)) {
      if (box.left < other.right && other.left < box.right && box.top < other.bottom && other.top < box.bottom) faults.push(`${tags[index].textContent} stands on another`);
    }
    const order = Number(tags[index].dataset.order);
    const higher = (at) => points[at - 1]?.[1] < points[at][1] && points[at + 1]?.[1] <= points[at][1];
    const top = points.some(([x], at) => Math.abs(x - order) <= 0.02 * order && higher(at));
    if (!top) faults.push(`${tags[index].textContent} has no peak`);
  }
  return { count: tags.length, faults };
}

// Tab, arrows, Enter: to the effects, find, add all.
async function types(url) {
  const { browser, page, faults } = await opened(url);
  const focus = async (wanted) => {
    for (let step = 0; step < 80; step++) {
      if (await page.evaluate((wanted) => document.activeElement?.matches(wanted), wanted)) return;
      await page.keyboard.press("Tab");
    }
    throw new Error(`${wanted} is not reached by the keyboard`);
  };
  await focus("[role=tab][aria-selected=true]");
  await page.keyboard.press("ArrowRight");
  await page.waitForSelector("#effects h2");
  await focus("#find");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#add-all");
  await focus("#add-all");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#fall #left");
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// A machine from nothing: a kind chosen, its wheels drawn, another lead, its dividers solved, saved.
async function describes(url, lead, a, b) {
  const { browser, page, faults } = await opened(url);
  await screen(page, "machine");
  await page.selectOption("#template", "gear-tester");
  await page.waitForSelector(".train rect");
  const wheels = await page.$$eval(".train rect", (all) => all.map((one) => ["x", "y", "height"].map((key) => Number(one.getAttribute(key)))));
  const [driver, driven] = wheels;
  const touch = wheels.length === 2 && driver[0] === driven[0] && Math.abs(driver[1] + driver[2] - driven[1]) < 1e-9;
  hold(touch, `two wheels that mesh: ${JSON.stringify(wheels)}`);
  await page.selectOption("#template", "lead-screw-grinder");
  const field = (key) => `input[data-key="${key}"]`;
  await page.waitForSelector(field("dividers.a"));
  const before = await page.inputValue("#toml");
  await page.fill(field("workpiece.lead"), lead);
  await page.press(field("workpiece.lead"), "Tab");
  await page.waitForFunction((lead) => document.getElementById("toml").value.includes(lead), lead);
  await page.click("#solve");
  await page.waitForFunction(([name, a]) => document.querySelector(name).value === a, [field("dividers.a"), a]);
  hold((await page.inputValue(field("dividers.b"))) === b, "B as the command says");
  hold((await page.textContent("#solved")).startsWith("helixlock dividers --lead"), "the command is shown");
  const solved = await page.inputValue("#toml");
  await page.click("#back");
  hold((await page.inputValue("#toml")).includes(lead), "the lead stays when dividers are taken back");
  hold((await page.inputValue("#toml")) !== solved && before !== solved, "the dividers are taken back");
  await page.click("#solve");
  await page.waitForFunction((text) => document.getElementById("toml").value === text, solved);
  await page.click("#save-machine");
  await page.waitForSelector("#save-machine[disabled]");
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

const stories = { describes, learns, tries, mends, leaves, shows, reads, labels, types };
const [story, ...words] = process.argv.slice(2);
await stories[story](...words).catch((error) => {
  process.stderr.write(`${story}: ${error.message}\n`);
  process.exit(1);
});

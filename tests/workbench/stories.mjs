// What a user does in the workbench; `node stories.mjs STORY URL …` does one.

import { readFileSync } from "node:fs";

import { axeSource, hold, idle, opened, picture, processorSeconds, screen } from "./browser.mjs";
import { follows, passes, resolves } from "./fails.mjs";
import { prints } from "./printed.mjs";
import { refuses } from "./refused.mjs";
import { full, SCREENS } from "./screens.mjs";
import { flips, jumps } from "./waves.mjs";

// Everything with the mouse: data dropped, read, saved; what is missing found and added.
async function learns(url, data) {
  const begun = Date.now();
  const { browser, page, faults } = await opened(url);
  await page.setInputFiles("#file", data);
  await page.click("#save");
  await page.waitForSelector("#sound");
  hold((await page.textContent("#spacing")).includes("change gear 1"), "the samples do not follow that gear");
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
  hold(Date.now() - begun < 60000, `${Date.now() - begun} ms`);
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// One effect tried, its slider moved, taken; taken back and done again; another refused.
async function tries(url, effect) {
  const { browser, page, faults } = await opened(url);
  await screen(page, "effects");
  await page.click("#find");
  const card = `li[data-effect="${effect}"]`;
  await page.waitForSelector(`${card} .sketch svg`);
  const falls = await page.$$eval(`${card} .sketch [data-sensor]`, (all) => all.map((one) => one.textContent.match(/[0-9.]+/g).map(Number)));
  hold(falls.length > 0 && falls.every(([before, after]) => after < before), `the error of every sensor: ${JSON.stringify(falls)}`);
  await page.click(`${card} .try`);
  await page.waitForSelector("#trial .scroll table");
  const sizes = () => page.textContent("#trial .scroll table");
  const fitted = await sizes();
  await page.$eval("#trial input[type=range]", (slider) => {
    slider.value = slider.max;
    slider.dispatchEvent(new Event("input"));
  });
  await page.waitForFunction((before) => document.querySelector("#trial .scroll table").textContent !== before, fitted);
  await page.click("#take");
  await page.waitForSelector("#fall #left");
  const { rms, noise } = await page.$eval("#left", (left) => left.dataset);
  hold(Number(noise) < Number(rms), `half way, ${rms} is left and ${noise} is noise`);
  await keeps(page);
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

// One page that needs nothing else, with a bar for every round.
async function keeps(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#export")]);
  const file = await download.path();
  const text = readFileSync(file, "utf8");
  hold(!/<script|src=|href=|url\(|@import/.test(text), "the page asks for nothing");
  const kept = await page.context().newPage();
  await kept.setContent(text);
  hold((await kept.$$eval(".falls li .bar .now", (bars) => bars.filter((bar) => bar.clientWidth > 0).length)) === 2, "a bar for both rounds");
  await kept.close();
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
  const said = results(page);
  await screen(page, "fails");
  await page.waitForSelector("#sentence");
  await idle(page);
  const compared = await said.last;
  const values = (where) => page.$$eval(where, (all) => all.map((one) => one.dataset.value).join());
  const own = JSON.parse(compared, sameKey).sensors.map((one) => one.rms_um).join();
  hold((await values("#compared dd[data-key=rms_um]")) === own, `${own} said`);
  await screen(page, "effects");
  await page.click("#find");
  await page.waitForSelector("#verdict");
  const diagnosed = await said.last;
  const found = JSON.parse(diagnosed, sameKey);
  hold((await page.getAttribute("#verdict", "data-verdict")) === found.verdict, found.verdict);
  if (found.doubts.length === 0) {
    hold((await values("#diagnosis dd[data-value]")) === [found.rounds[0].rms_um, found.noise_um].join(), "now and then");
    const cards = await page.$$eval("#diagnosis li.card", (all) => all.map((one) => one.dataset.effect).sort().join());
    hold(cards === found.candidates.map((one) => one.effect).sort().join(), cards);
  }
  hold(faults.length === 0, faults.join("\n"));
  process.stdout.write(JSON.stringify({ compare: compared, diagnose: diagnosed }));
  await browser.close();
}

// The last of what the page is given, as it stands.
function results(page) {
  const said = {};
  page.on("response", (answer) => {
    if (answer.url().includes("/api/result?")) said.last = answer.text();
  });
  return said;
}

// Angles have their own keys.
function sameKey(_, value) {
  if (value === null || typeof value !== "object" || Array.isArray(value)) return value;
  return Object.fromEntries(Object.entries(value).map(([key, inner]) => [key.replace(/_arcsec$/, "_um"), inner]));
}

// The device as simulated: before and after are those of the command.
async function simulates(url) {
  const { browser, page, faults } = await opened(url);
  const said = results(page);
  await screen(page, "device");
  await page.waitForSelector("#before-after canvas");
  const shown = await page.$$eval("#simulated [data-key]", (all) => all.map((one) => [one.dataset.key, one.dataset.value]));
  const text = await said.last;
  const found = JSON.parse(text);
  const wrong = shown.filter(([key, value]) => String(key.split(".").reduce((part, name) => part[name], found)) !== value);
  hold(shown.length === 8 && wrong.length === 0, `${wrong}`);
  hold(faults.length === 0, faults.join("\n"));
  process.stdout.write(text);
  await browser.close();
}

// A value changed in the form runs the device again; the file changes when it is saved.
async function lives(url, speed) {
  const { browser, page, faults } = await opened(url);
  await screen(page, "device");
  await page.waitForSelector("#before-after canvas");
  const clocks = () => page.textContent("#simulated").then((text) => Number(text.match(/([0-9,]+) clocks/)[1].replaceAll(",", "")));
  const before = await clocks();
  hold(await page.isHidden("#unsaved"), "the file is as it was shown");
  const field = '#device input[data-key="spindle.speed"]';
  await page.fill(field, speed);
  await page.press(field, "Tab");
  await page.waitForFunction((clocks) => !document.getElementById("simulated").textContent.includes(clocks), before.toLocaleString("en"));
  hold(Math.abs((await clocks()) / before - 0.5) < 0.05, "twice as fast takes half as many clocks");
  const unsaved = () => page.isVisible("#unsaved");
  hold(await unsaved(), "the line at the foot is told to need the saved file");
  await page.click("#save-device");
  await page.waitForSelector("#save-device[disabled]");
  hold(!(await unsaved()), "it is saved now");
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// Two tabs: the second is told, and neither the file nor what it had typed is lost.
async function tabs(url) {
  const { browser, context, page, faults } = await opened(url);
  const other = await context.newPage();
  await other.goto(url);
  await other.waitForSelector("html[data-ready=yes]");
  for (const tab of [page, other]) await screen(tab, "machine");
  const type = async (tab, from, to) => {
    await tab.fill("#toml", (await tab.inputValue("#toml")).replace(from, to));
    await tab.waitForSelector("#save-machine:not([disabled])");
    await tab.click("#save-machine");
  };
  await type(page, "6 rpm", "7 rpm");
  await page.waitForSelector("#save-machine[disabled]");
  await type(other, "600 mm", "500 mm");
  await other.waitForSelector("#message.bad");
  hold((await other.inputValue("#toml")).includes("500 mm"), "what was typed stands there");
  await other.click("#back");
  const saved = await other.inputValue("#toml");
  hold(saved.includes("7 rpm") && saved.includes("600 mm"), "what the first has saved is a click away");
  hold(faults.every((fault) => fault.includes("409")), faults.join("\n"));
  await browser.close();
}

// Very many samples: the processor's time for a frame while panning and zooming, of all processes
// of the browser together, and no extreme lost by what is left out.
async function pans(url) {
  const { browser, page, faults } = await opened(url);
  await screen(page, "fails");
  await page.waitForSelector("#sentence");
  await idle(page);
  const begun = processorSeconds([process.pid]);
  const frames = await page.evaluate(panned);
  const each = (1000 * (processorSeconds([process.pid]) - begun)) / frames;
  hold(each < 50, `a frame takes ${each} ms of the processor`);
  const lost = await page.evaluate(extremes);
  hold(lost === "", lost);
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// Frames in which keys pan and zoom both charts.
async function panned() {
  const chart = document.querySelector("#residual .canvas");
  const frame = () => new Promise((done) => requestAnimationFrame(done));
  const keys = ["+", "ArrowRight", "ArrowRight", "ArrowLeft", "-", "ArrowLeft"];
  const frames = 90;
  for (let step = 0; step < frames; step++) {
    chart.dispatchEvent(new KeyboardEvent("keydown", { key: keys[step % keys.length] }));
    await frame();
  }
  return frames;
}

// The drawn columns of a long curve against all of its samples.
async function extremes() {
  const { Curve } = await import("./thin.js");
  const [count, columns] = [300000, 1000];
  const x = Float64Array.from({ length: count }, (_, row) => row);
  const y = Float32Array.from(x, (row) => Math.sin(row / 9000) + 0.3 * Math.sin(7.7 * row * row));
  for (const [row, value] of [[123456, 50], [222222, -50]]) y[row] = value;
  const curve = new Curve(x, y, 0, count);
  for (const [low, high] of [[0, count - 1], [100000, 250000], [123000, 124000]]) {
    const { least, most } = curve.thinned(low, high, columns);
    if (columns < least.length || columns < most.length) return "more columns than asked for";
    const column = Math.floor(((123456 - low) * columns) / (high - low));
    const near = most.slice(Math.max(0, column - 1), column + 2);
    if (!near.includes(50)) return `a needle of one sample is not drawn between ${low} and ${high}`;
    if (low <= 222222 && 222222 <= high && Math.min(...least.filter((value) => value !== undefined)) !== -50) return "nor one downwards";
  }
  return "";
}

// Measured against model of very many samples; processor time of browser and server until it is drawn.
async function opens(url, server) {
  const { browser, page, faults } = await opened(url, { ready: false });
  await page.waitForSelector("#residual canvas");
  const seconds = processorSeconds([process.pid, Number(server)]);
  const size = await page.$eval("#residual canvas", (canvas) => canvas.width * canvas.height);
  hold(size > 0, "the residual is drawn");
  hold(faults.length === 0, faults.join("\n"));
  process.stdout.write(String(seconds));
  await browser.close();
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
  for (const part of document.querySelectorAll(".scroll")) {
    const hidden = part.scrollWidth - part.clientWidth;
    if (window.innerWidth < 721 && 0 < hidden && getComputedStyle(part).maskImage === "none") found.push(`${hidden} px cut without a sign`);
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
    if (name === "effects" && device === "desk" && light === "dark") await picture(page, "effects-chinese-dark");
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
  await page.fill("#toml", solved.replace(lead, "x").replace("6 rpm", "6 miles"));
  await page.waitForFunction(() => document.querySelectorAll("#errors p").length === 2);
  await page.fill("#toml", solved);
  await page.waitForSelector("#errors:empty", { state: "attached" });
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

// What is said of files of every kind when they are dropped, in Chinese.
async function drops(url, ...files) {
  const { browser, page, faults } = await opened(url, { language: "zh-CN" });
  await screen(page, "measurement");
  const found = [];
  for (const file of files) {
    const name = file.split("/").pop();
    await page.setInputFiles("#file", file);
    await page.waitForFunction((name) => document.querySelector("#reading h2")?.textContent.includes(name), name);
    found.push(...(await page.evaluate(unreadable, true)).map((one) => `${name}: ${one}`));
  }
  hold(found.length === 0, found.join("\n"));
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

const stories = { describes, drops, flips, follows, jumps, labels, learns, leaves, lives, mends, opens, pans, passes, prints, reads, refuses, resolves, shows, simulates, tabs, tries, types };
const [story, ...words] = process.argv.slice(2);
await stories[story](...words).catch((error) => {
  process.stderr.write(`${story}: ${error.message}\n`);
  process.exit(1);
});

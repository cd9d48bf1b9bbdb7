// A real Chromium, driven by Playwright; told where both are by the test that runs this.

import { readdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";

const require = createRequire(`${process.env.NODE_FOLDER}/`);
const { chromium } = require("playwright-core");

export const axeSource = () => require.resolve("axe-core/axe.min.js");

export function launched() {
  return chromium.launch({ executablePath: process.env.CHROMIUM, args: ["--no-sandbox", "--disable-gpu"] });
}

// Opens the workbench; what the page itself throws, or refuses for its own policy, fails the story.
export async function opened(url, { width = 1280, height = 900, dark = false, language = "en-US", ready = true } = {}) {
  const browser = await launched();
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: dark ? "dark" : "light", locale: language, acceptDownloads: true });
  const page = await context.newPage();
  const faults = [];
  page.on("pageerror", (error) => faults.push(error.message));
  page.on("console", (message) => message.type() === "error" && faults.push(message.text()));
  page.setDefaultTimeout(120000);
  await page.goto(url);
  if (ready) await page.waitForSelector("html[data-ready=yes]");
  return { browser, context, page, faults };
}

// Processor time that some processes and all that they have begun have used, s: what else a machine
// does leaves it as it is.
export function processorSeconds(roots) {
  const all = new Map();
  for (const id of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    let stat;
    try {
      stat = readFileSync(`/proc/${id}/stat`, "utf8");
    } catch {
      continue; // it has ended meanwhile
    }
    const fields = stat.slice(stat.lastIndexOf(")") + 2).split(" ").map(Number);
    all.set(Number(id), { parent: fields[1], ticks: fields[11] + fields[12] });
  }
  const counts = (id) => roots.includes(id) || (all.has(id) && counts(all.get(id).parent));
  const ticks = [...all].filter(([id]) => counts(id)).reduce((sum, [, one]) => sum + one.ticks, 0);
  return ticks / 100;
}

export function hold(condition, message) {
  if (!condition) throw new Error(message);
}

// Waits until no work is under way.
export async function idle(page) {
  await page.waitForFunction(() => document.getElementById("work").hidden);
}

// Opens a screen; back when everything stands on it that needs no button.
export async function screen(page, name) {
  await page.click(`#tab-${name}`);
  await page.waitForSelector(`#${name}[aria-busy=false] h2`);
}

// A picture for the documentation, where the test that runs this asks for them.
export async function picture(page, name) {
  if (process.env.PICTURES) await page.screenshot({ path: `${process.env.PICTURES}/${name}.png` });
}

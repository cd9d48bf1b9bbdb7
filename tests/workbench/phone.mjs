// A page on a telephone: `node phone.mjs PAGE.html` tells what is cut there without a sign.

import { pathToFileURL } from "node:url";

import { launched } from "./browser.mjs";

const browser = await launched();
const page = await browser.newPage({ viewport: { width: 390, height: 844 } });
await page.goto(pathToFileURL(process.argv[2]).href);
const found = await page.evaluate(() => {
  const wide = [...document.querySelectorAll("main *")].filter((part) => part.clientWidth && part.clientWidth < part.scrollWidth && part.tagName !== "PRE");
  const cut = wide.filter((part) => getComputedStyle(part).maskImage === "none").map((part) => part.outerHTML.slice(0, 80));
  const over = document.documentElement.scrollWidth - window.innerWidth;
  return { scrolled: wide.length, cut, over };
});
process.stdout.write(JSON.stringify(found));
await browser.close();

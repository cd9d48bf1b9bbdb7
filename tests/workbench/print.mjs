// A page as a printer gets it: `node print.mjs PAGE.html PAGE.pdf`.

import { pathToFileURL } from "node:url";

import { launched } from "./browser.mjs";

const [file, pdf] = process.argv.slice(2);
const browser = await launched();
const page = await browser.newPage();
await page.goto(pathToFileURL(file).href);
await page.pdf({ path: pdf, preferCSSPageSize: true });
await browser.close();

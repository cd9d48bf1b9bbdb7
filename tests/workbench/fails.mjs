// The screen "Where it fails".

import { hold, idle, opened, screen } from "./browser.mjs";

// Opens the screen and lets it come to rest; `answers` has what it was told.
async function there(url) {
  const session = await opened(url);
  const answers = {};
  session.page.on("response", (answer) => {
    const what = answer.url().match(/\/api\/(axes|axis|spectrum|faster)\?/)?.[1];
    if (what) answers[what] = answer.json();
  });
  await session.page.evaluate(async () => {
    const { getFrame } = await import("./api.js");
    const { blocks, position_mm, measured, residual } = await getFrame("series");
    window.series = { blocks, position_mm: [...position_mm], measured: [...measured], residual: [...residual] };
  });
  await screen(session.page, "fails");
  await session.page.waitForSelector("#sentence");
  await idle(session.page);
  return { ...session, answers };
}

// Points at a part of a chart; what its legend and those of other charts say there.
async function pointed(page, chart, part, charts) {
  const area = page.locator(`${chart} .u-over`);
  await area.scrollIntoViewIfNeeded();
  const { x, y, width, height } = await area.boundingBox();
  await page.mouse.move(x + part * width, y + height / 2);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const legend = (figure) => Object.fromEntries([...figure.querySelectorAll(".u-series")].map((row) => [row.querySelector(".u-label").textContent, Number(row.querySelector(".u-value").textContent.replace("–", "NaN"))]));
  return Promise.all(charts.map((name) => page.$eval(name, legend)));
}

const close = (one, other, digits) => Math.abs(one - other) <= 10 ** -digits * Math.max(Math.abs(one), Math.abs(other), 1e-9);

// Each axis that is pressed has its curve: the residual along it, as the cursor reads it.
export async function follows(url) {
  const { browser, page, faults, answers } = await there(url);
  const { axes } = await answers.axes;
  const keys = await page.$$eval(".strip", (all) => all.map((one) => one.dataset.axis));
  hold(axes.length > 5 && keys.join() === axes.map(({ key }) => key).join(), `strips ${keys}`);
  for (const key of [...keys.slice(1), keys[0]]) {
    const told = page.waitForResponse((answer) => answer.url().includes("/api/axis?"));
    await page.click(`.strip[data-axis="${key}"]`);
    await told;
    await page.waitForFunction((key) => document.querySelector("#along")?.dataset.axis === key, key);
    await reads(page, await answers.axis);
  }
  const position = await answers.axes.then(({ axes }) => axes.find(({ key }) => key === "position"));
  const own = await page.evaluate(binned, position);
  const wrong = own.filter((mean, bin) => !close(mean ?? 0, position.mean[bin] ?? 0, 4));
  hold(own.filter((mean) => mean !== null).length > 50 && wrong.length === 0, `means along the position: ${wrong}`);
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// The cursor's values at three places of the curve are those of the bins there.
async function reads(page, axis) {
  const width = (axis.high - axis.low) / axis.mean.length;
  for (const part of [0.2, 0.5, 0.85]) {
    const [{ least, greatest, mean, ...x }] = await pointed(page, "#along", part, ["#along"]);
    const bins = axis.mean.map((mean, bin) => ({ at: axis.low + (bin + 0.5) * width, mean, least: axis.least[bin], most: axis.most[bin] }));
    const same = bins.find((bin) => bin.mean !== null && close(bin.mean, mean, 3) && close(bin.least, least, 3) && close(bin.most, greatest, 3));
    const at = Object.values(x)[0];
    hold(same && Math.abs(same.at - at) <= Math.max(2.5 * width, 0.01 * (axis.high - axis.low)), `${axis.key}: ${least}, ${mean}, ${greatest} at ${at} is in no bin near`);
  }
}

// Means of the residual, each pass about its own, in bins of the position.
function binned({ low, high, mean }) {
  const { blocks, position_mm, residual } = window.series;
  const [sums, counts] = [mean.map(() => 0), mean.map(() => 0)];
  for (const { from, to } of blocks) {
    const zero = residual.slice(from, to).reduce((sum, value) => sum + value, 0) / (to - from);
    for (let row = from; row < to; row++) {
      const bin = Math.min(mean.length - 1, Math.floor((mean.length * (position_mm[row] - low)) / (high - low)));
      sums[bin] += residual[row] - zero;
      counts[bin] += 1;
    }
  }
  return sums.map((sum, bin) => (counts[bin] ? sum / counts[bin] : null));
}

// Cursors of both charts stand at one place and read the same samples; a pass that is switched off
// is in no chart and in no strip, and comes back.
export async function passes(url) {
  const { browser, page, faults, answers } = await there(url);
  const both = ["#measured", "#residual"];
  const all = await pointed(page, both[0], 0.4, both);
  await holds(page, all, [1, 2]);
  const before = (await answers.axes).axes;
  await off(page, 1);
  const one = await pointed(page, both[1], 0.6, both);
  await holds(page, one, [2]);
  const alone = (await answers.axes).axes;
  hold(before.some((axis) => axis.count.some((count, bin) => count !== alone.find(({ key }) => key === axis.key)?.count[bin])), "the strips still hold the pass");
  await page.click(".pass input >> nth=0");
  await page.waitForFunction(() => document.querySelectorAll("#residual .u-series").length === 3);
  const again = await pointed(page, both[0], 0.4, both);
  hold(JSON.stringify(again) === JSON.stringify(all), `back: ${JSON.stringify(again)}`);
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

// Switches a pass off.
async function off(page, pass) {
  const told = page.waitForResponse((answer) => answer.url().includes(`without=${pass}`) && answer.url().includes("/api/axes?"));
  await page.click(`.pass input >> nth=${pass - 1}`);
  await told;
  await page.waitForFunction(() => document.querySelectorAll("#residual .u-series").length === 2 && document.querySelector("#along"));
}

// What two legends say of one place is one sample of each pass that is shown.
async function holds(page, [upper, lower], shown) {
  const at = upper["position in mm"];
  hold(at === lower["position in mm"] && Number.isFinite(at), `cursors at ${at} and ${lower["position in mm"]} mm`);
  for (const pass of shown) {
    const of = (legend, name) => legend[shown.length === 1 ? name : `${name} ${pass}`];
    const read = [of(upper, "measured"), of(upper, "model"), of(lower, "Residual")];
    const near = await page.evaluate(samples, [at, pass]);
    const same = near.some((sample) => sample.every((value, index) => Math.abs(value - read[index]) < 6e-4 * Math.max(1, Math.abs(value))));
    hold(same, `pass ${pass}: ${read} at ${at} mm is none of ${JSON.stringify(near)}`);
  }
}

// Measured, model and what is left about its mean, of the samples nearest to a place in a pass.
function samples([at, pass]) {
  const { blocks, position_mm, measured, residual } = window.series;
  const { from, to } = blocks.find((block) => block.pass === pass);
  const zero = residual.slice(from, to).reduce((sum, value) => sum + value, 0) / (to - from);
  const rows = Array.from({ length: to - from }, (_, index) => from + index);
  rows.sort((one, other) => Math.abs(position_mm[one] - at) - Math.abs(position_mm[other] - at));
  return rows.slice(0, 6).map((row) => [measured[row], measured[row] - residual[row], residual[row] - zero]);
}

// The spectrum ends where two samples a wave end, however far out one looks; names beyond it are
// told with the data, and not drawn.
export async function resolves(url, highest, beyond) {
  const { browser, page, faults, answers } = await there(url);
  const { points, peaks } = await answers.spectrum;
  const last = points.at(-1)[0];
  hold(last <= highest && 0.9 * highest < last, `up to ${last} of ${highest} cycles a turn`);
  const [read] = await pointed(page, "#spectrum", 0.999, ["#spectrum"]);
  hold(Math.abs(read["cycles a spindle turn"] - last) < 0.01 * last && Number.isFinite(read.amplitude), `drawn up to ${JSON.stringify(read)}`);
  await page.click("#spectrum .tools button >> nth=1");
  const [wide] = await pointed(page, "#spectrum", 0.999, ["#spectrum"]);
  hold(JSON.stringify(wide) === JSON.stringify(read), `farther out ${JSON.stringify(wide)}`);
  const tags = await page.$$eval("#spectrum .peak", (all) => all.map((one) => one.textContent));
  hold(peaks.length > 0 && tags.length > 0 && !tags.join().includes(beyond), `names ${tags}`);
  await screen(page, "measurement");
  await page.waitForSelector("#spacing");
  hold((await page.textContent("#spacing")).includes(beyond), `${beyond} is told`);
  hold(faults.length === 0, faults.join("\n"));
  await browser.close();
}

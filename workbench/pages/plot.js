// A chart: uPlot draws, this file thins the data to the view, zooms and pans.

import { Curve } from "./thin.js";
import { t } from "./words.js";

const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

// `light-dark()` is for style sheets: a canvas needs the colour itself.
function resolved(name) {
  const probe = document.createElement("span");
  probe.style.color = colour(name) || name;
  document.body.append(probe);
  const value = getComputedStyle(probe).color;
  probe.remove();
  return value;
}

// Passes that are few are drawn as lines of their own, not joined from one to the next.
const FEW = 4;

function apart(lines) {
  return lines.flatMap((line) => {
    const several = 1 < line.curves.length && line.curves.length <= FEW;
    if (!several) return [line];
    return line.curves.map((curve, index) => ({ ...line, label: `${line.label} ${curve.pass ?? index + 1}`, curves: [curve] }));
  });
}

// While a page is laid out for paper its charts have the width that they were told.
let printing = false;

// Width of a chart on A4 with margins of 15 mm.
const PAPER_PX = 640;

export class Chart {
  // `lines`: { label, colour, curves, dots }; charts of one `group` share view and cursor.
  constructor(parent, { title, x, y, lines, group, height = 240 }) {
    this.lines = apart(lines);
    this.axes = { x, y, height };
    this.group = group;
    group?.charts.push(this);
    this.box = document.createElement("figure");
    this.box.className = "chart";
    const heading = document.createElement("h3");
    heading.textContent = title;
    this.canvas = document.createElement("div");
    this.canvas.className = "canvas";
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${title}: ${y} / ${x}`);
    this.box.append(heading, this.canvas, this.tools());
    parent.append(this.box);
    this.whole = this.range();
    this.see(...this.whole);
    this.draw(this.canvas.clientWidth);
    this.wire();
    this.box.chart = this;
  }

  range() {
    let [low, high] = [Infinity, -Infinity];
    for (const { curves } of this.lines) {
      for (const curve of curves) {
        const [from, to] = curve.range();
        if (from < low) low = from;
        if (high < to) high = to;
      }
    }
    return low < high ? [low, high] : [low - 1, low + 1];
  }

  tools() {
    const tools = document.createElement("div");
    tools.className = "tools";
    const button = (sign, label, act) => {
      const made = document.createElement("button");
      made.type = "button";
      made.textContent = sign;
      made.setAttribute("aria-label", label);
      made.addEventListener("click", act);
      tools.append(made);
    };
    button("+", t("chart.in"), () => this.zoom(0.5));
    button("−", t("chart.out"), () => this.zoom(2));
    button("←", t("chart.left"), () => this.pan(-0.3));
    button("→", t("chart.right"), () => this.pan(0.3));
    button("⟷", t("chart.all"), () => this.look(...this.whole));
    return tools;
  }

  draw(width) {
    const { x, y, height } = this.axes;
    const axis = { stroke: resolved("dim"), grid: { stroke: resolved("line"), width: 1 }, ticks: { stroke: resolved("line"), width: 1 }, font: "12px system-ui", labelFont: "13px system-ui", labelSize: 20 };
    const series = this.lines.map(({ label, colour: name, dots }) => ({
      label,
      stroke: resolved(name),
      width: dots ? 0 : 1.4,
      spanGaps: true,
      points: { show: () => !!dots, size: 4, fill: resolved(name) },
      value: (_, value) => (value == null ? "–" : value.toPrecision(4)),
    }));
    const options = {
      width: Math.max(260, width),
      height,
      scales: { x: { time: false, range: () => this.view } },
      series: [{ label: x, value: (_, value) => (value == null ? "–" : value.toPrecision(6)) }, ...series],
      axes: [{ ...axis, label: x, size: 34 }, { ...axis, label: y, size: 58 }],
      cursor: { sync: this.group ? { key: this.group.key } : undefined, drag: { x: true, y: false, setScale: false } },
      hooks: {
        setSelect: [(plot) => {
          if (plot.select.width < 3) return;
          const low = plot.posToVal(plot.select.left, "x");
          const high = plot.posToVal(plot.select.left + plot.select.width, "x");
          plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
          this.look(low, high);
        }],
        draw: [(plot) => this.after?.(plot)],
      },
    };
    this.plot?.destroy();
    this.plot = new window.uPlot(options, this.data(), this.canvas);
  }

  see(low, high) {
    this.view = [low, high];
    this.box.dataset.view = this.view.join(" ");
  }

  // What the view shows of every line, two places a column.
  data() {
    const [low, high] = this.view;
    const columns = Math.max(200, Math.min(1400, this.canvas.clientWidth || 800));
    const width = (high - low) / columns;
    const xs = new Array(2 * columns);
    for (let column = 0; column < columns; column++) {
      xs[2 * column] = low + (column + 0.25) * width;
      xs[2 * column + 1] = low + (column + 0.75) * width;
    }
    const ys = this.lines.map(({ curves }) => {
      const values = new Array(2 * columns).fill(undefined);
      for (const curve of curves) {
        const { least, most } = curve.thinned(low, high, columns);
        for (let column = 0; column < columns; column++) {
          if (least[column] === undefined) continue;
          const before = values[2 * column];
          values[2 * column] = before === undefined ? least[column] : Math.min(before, least[column]);
          const top = values[2 * column + 1] ?? -Infinity;
          if (most[column] !== values[2 * column] || top !== -Infinity) values[2 * column + 1] = Math.max(top, most[column]);
        }
      }
      return values;
    });
    return [xs, ...ys];
  }

  redraw() {
    this.plot.setData(this.data());
  }

  // Other values in the place of all lines'.
  replace(lines) {
    this.lines = apart(lines);
    this.redraw();
  }

  look(low, high) {
    if (!(low < high)) return;
    for (const chart of this.group?.charts ?? [this]) {
      chart.see(low, high);
      chart.redraw();
    }
  }

  zoom(factor, about = (this.view[0] + this.view[1]) / 2) {
    const [low, high] = this.view;
    const [least, most] = this.whole;
    this.look(Math.max(least, about - (about - low) * factor), Math.min(most, about + (high - about) * factor));
  }

  pan(share) {
    const [low, high] = this.view;
    const way = share * (high - low);
    this.look(low + way, high + way);
  }

  // Calls `act` with the x of a click; a drag zooms instead.
  pick(act) {
    let down = 0;
    this.canvas.classList.add("picks");
    this.canvas.addEventListener("pointerdown", (event) => (down = event.clientX));
    this.canvas.addEventListener("click", (event) => {
      const still = Math.abs(event.clientX - down) < 3 && event.target.closest(".u-over");
      if (still) act(this.plot.posToVal(event.clientX - this.plot.over.getBoundingClientRect().left, "x"));
    });
  }

  wire() {
    new ResizeObserver(() => {
      const width = this.canvas.clientWidth;
      if (!printing && width && width !== this.plot.width) this.plot.setSize({ width, height: this.axes.height });
    }).observe(this.canvas);
    this.canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.shiftKey) return;
      event.preventDefault();
      const at = this.plot.posToVal(event.clientX - this.plot.over.getBoundingClientRect().left, "x");
      this.zoom(event.deltaY < 0 ? 0.8 : 1.25, at);
    }, { passive: false });
    this.canvas.addEventListener("dblclick", () => this.look(...this.whole));
    const keys = { "+": () => this.zoom(0.5), "-": () => this.zoom(2), ArrowLeft: () => this.pan(-0.2), ArrowRight: () => this.pan(0.2), 0: () => this.look(...this.whole) };
    this.canvas.addEventListener("keydown", (event) => {
      if (!keys[event.key]) return;
      event.preventDefault();
      keys[event.key]();
    });
  }
}

// Every chart anew, as wide as it is told or as its place is, in the colours that hold now.
function drawAll(width) {
  for (const { chart } of document.querySelectorAll("figure.chart")) chart.draw(width ?? chart.canvas.clientWidth);
}

// A canvas keeps the width and the colours of the screen, and paper has others.
window.addEventListener("beforeprint", () => {
  printing = true;
  document.documentElement.style.colorScheme = "light";
  drawAll(PAPER_PX);
});
window.addEventListener("afterprint", () => {
  printing = false;
  document.documentElement.style.colorScheme = "";
  drawAll();
});

let groups = 0;

export function newGroup() {
  groups += 1;
  return { key: `group${groups}`, charts: [] };
}

// Curves of chosen blocks of rows.
export function curvesOf(x, y, blocks) {
  return blocks.map(({ from, to, pass }) => Object.assign(new Curve(x, y, from, to), { pass }));
}

// Curve of `[x, y]` pairs.
export function curveOf(points) {
  const x = Float64Array.from(points, (point) => point[0]);
  const y = Float32Array.from(points, (point) => point[1] ?? NaN);
  return new Curve(x, y, 0, x.length);
}

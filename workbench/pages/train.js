// The gear train, drawn as shafts with the wheels on them.
//
// Two wheels mesh when as many teeth of both pass in a turn of the spindle; wheels of one order sit
// on one shaft. What no mesh leads to stands below, apart.

import { drawn, make } from "./make.js";
import { t } from "./words.js";

const LETTER = 9; // widest that is usual
const BESIDE = 24; // from what a shaft is called to its first wheel
const COLUMN = 34;
const LARGEST = 40; // radius of the largest wheel
const SMALLEST = 12;
const APART = 36;

const same = (one, other) => Math.abs(one - other) <= 1e-6 * Math.max(one, other);

// Shafts in the order of the file: `{ order, says, wheels: [{ number, teeth }] }`.
export function shaftsOf(gears, screwOrder) {
  const shafts = [];
  const at = (order) => {
    let shaft = shafts.find((one) => same(one.order, order));
    if (!shaft) shafts.push((shaft = { order, says: [], wheels: [] }));
    return shaft;
  };
  at(1).says.push(t("machine.spindle"));
  gears.forEach(({ order, teeth }, index) => at(order).wheels.push({ number: index + 1, teeth, order }));
  if (screwOrder != null) at(screwOrder).says.push(t("machine.own_screw"));
  return shafts;
}

const called = ({ order, says }) => [...says, `×${Number(order.toPrecision(4))}`].join(" ");

// The meshes by which each shaft is reached from those before it, and where everything stands.
function placed(shafts) {
  const most = Math.max(1, ...shafts.flatMap((shaft) => shaft.wheels.map((wheel) => wheel.teeth ?? 1)));
  const radius = (wheel) => Math.max(SMALLEST, (LARGEST * (wheel.teeth ?? 1)) / most);
  const left = BESIDE + LETTER * Math.max(...shafts.map((shaft) => called(shaft).length));
  let column = 0;
  let bottom = 0;
  const reach = (shaft) => shaft.wheels.map(radius);
  const stand = (shaft, y) => {
    shaft.y = y;
    bottom = Math.max(bottom, y + Math.max(SMALLEST, ...reach(shaft)));
    for (const mine of shaft.wheels) {
      mine.radius = radius(mine);
      mine.x ??= left + COLUMN * column++;
      for (const other of shafts.filter((one) => one.y == null)) {
        const theirs = other.wheels.find((wheel) => mine.teeth && wheel.teeth && same(mine.order * mine.teeth, wheel.order * wheel.teeth));
        if (!theirs) continue;
        theirs.x = mine.x;
        stand(other, y + mine.radius + radius(theirs));
      }
    }
  };
  for (const shaft of shafts) {
    if (shaft.y == null) stand(shaft, bottom + (bottom ? APART : 0) + Math.max(SMALLEST, ...reach(shaft)));
  }
  return { left, width: left + COLUMN * Math.max(1, column), height: bottom };
}

// Numbers on the wheels are those of the table's rows.
export function train(gears, screwOrder) {
  const shafts = shaftsOf(gears, screwOrder);
  const { left, width, height } = placed(shafts);
  const drawing = drawn("svg", { class: "train", width: width + 8, height: height + 8, role: "img", "aria-label": t("machine.train", { n: shafts.length }) });
  for (const { wheels, y, ...shaft } of shafts) {
    drawing.append(drawn("line", { x1: left - 14, x2: width, y1: y + 4, y2: y + 4 }));
    drawing.append(drawn("text", { x: 0, y: y + 8 }, called(shaft)));
    for (const { x, radius, number } of wheels) {
      drawing.append(drawn("rect", { x: x - 9, y: y + 4 - radius, width: 18, height: 2 * radius, rx: 2 }));
      drawing.append(drawn("text", { x, y: y + 8, class: "wheel" }, String(number)));
    }
  }
  return make("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": t("machine.gears") }, drawing);
}

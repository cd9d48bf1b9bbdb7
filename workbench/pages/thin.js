// The least and the greatest of what lies in each pixel column: all that a screen can show.

// Samples are grouped once, so that a view of very many looks at groups instead: where a pixel
// column holds two groups or more, nothing can be seen of the difference.
const GROUP = 64;

export class Curve {
  // `x` and `y` of one pass; `from` and `to` are its rows.
  constructor(x, y, from, to) {
    this.x = x.subarray(from, to);
    this.y = y.subarray(from, to);
    this.sorted = true;
    for (let i = 1; i < this.x.length && this.sorted; i++) this.sorted = this.x[i - 1] <= this.x[i];
    this.groups = null;
  }

  // First index whose x is not below a value, where x is sorted.
  at(value) {
    let [low, high] = [0, this.x.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.x[middle] < value) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  grouped() {
    if (this.groups) return this.groups;
    const count = Math.ceil(this.x.length / GROUP);
    const groups = { x: new Float64Array(count), low: new Float32Array(count), high: new Float32Array(count) };
    for (let g = 0; g < count; g++) {
      let [low, high] = [Infinity, -Infinity];
      const end = Math.min(this.x.length, (g + 1) * GROUP);
      for (let i = g * GROUP; i < end; i++) {
        if (this.y[i] < low) low = this.y[i];
        if (high < this.y[i]) high = this.y[i];
      }
      groups.x[g] = this.x[Math.min(end - 1, g * GROUP + GROUP / 2)];
      groups.low[g] = low;
      groups.high[g] = high;
    }
    this.groups = groups;
    return groups;
  }

  // Two values a column, the least and the greatest; undefined where nothing lies. Gives how many
  // samples were in view, too.
  thinned(low, high, columns) {
    const [first, last] = this.sorted ? [Math.max(0, this.at(low) - 1), Math.min(this.x.length, this.at(high) + 1)] : [0, this.x.length];
    const least = new Array(columns).fill(undefined);
    const most = new Array(columns).fill(undefined);
    const scale = columns / (high - low || 1);
    const put = (x, small, large) => {
      let column = Math.floor((x - low) * scale);
      // The neighbours outside of the view lead the line to its edges.
      if (column < 0 || columns <= column) {
        if (!this.sorted) return;
        column = column < 0 ? 0 : columns - 1;
        if (least[column] !== undefined) return;
      }
      if (!(small >= least[column])) least[column] = small;
      if (!(large <= most[column])) most[column] = large;
    };
    if (2 * GROUP * columns < last - first && this.sorted) {
      const groups = this.grouped();
      for (let g = Math.floor(first / GROUP); g < Math.min(groups.x.length, Math.ceil(last / GROUP)); g++) put(groups.x[g], groups.low[g], groups.high[g]);
    } else {
      for (let i = first; i < last; i++) if (this.y[i] === this.y[i]) put(this.x[i], this.y[i], this.y[i]);
    }
    return { least, most, seen: last - first };
  }

  range() {
    let [low, high] = [Infinity, -Infinity];
    if (this.sorted && this.x.length) return [this.x[0], this.x[this.x.length - 1]];
    for (const value of this.x) {
      if (value < low) low = value;
      if (high < value) high = value;
    }
    return [low, high];
  }
}

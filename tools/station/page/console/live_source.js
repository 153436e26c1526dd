// What was heard of the robot in the last seconds, for plots: a source as of ../source.js.
const window_s = 20;
const frames_a_second = 50; // at most: console_shell.h
const most = 2 * window_s * frames_a_second; // when it is full, the newer half stays

export class LiveSource {
  live = true;
  #count = 0;
  #time_s = new Float64Array(most);

  /** @param layout frame_layout.h's */
  constructor(layout) {
    this.layout = layout;
    this.columns = layout.fields.map(() => new Float32Array(most));
    this.known = layout.fields.map(() => false);
  }

  /** @param row one number for each field, NaN = not measured */
  take(time_s, row) {
    const last_s = this.#count > 0 ? this.#time_s[this.#count - 1] : -Infinity;
    if (time_s === last_s) return;
    if (time_s < last_s) this.#forget(); // another run of the robot
    if (this.#count === most) this.#halve();
    this.#time_s[this.#count] = time_s;
    this.columns.forEach((column, field) => {
      column[this.#count] = row[field];
      if (!this.known[field] && !Number.isNaN(row[field])) this.known[field] = true;
    });
    this.#count += 1;
  }

  range() {
    const last_s = this.#count > 0 ? this.#time_s[this.#count - 1] : 0;
    return [last_s - window_s, last_s];
  }

  series(field) {
    if (!this.known[field]) return null;
    const values = this.columns[field].subarray(0, this.#count);
    return { time_s: this.#time_s.subarray(0, this.#count), low: values, high: values };
  }

  #halve() {
    for (const column of [this.#time_s, ...this.columns]) column.copyWithin(0, most / 2);
    this.#count = most / 2;
  }

  #forget() {
    this.#count = 0;
    this.known.fill(false);
  }
}

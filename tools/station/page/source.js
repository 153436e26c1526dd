// Where the page's numbers come from: a log inside the page. What plots ask a source has console/live_source.js,
// of a running robot, as well:
//   live                    whether time goes on by itself
//   layout                  frame_layout.h's
//   range()                 [first, last] time, s
//   series(field)           {time_s, low, high} for plots, or null; low === high where each is one cycle

/** Index of each field by its name. */
export function index_of_fields(layout) {
  return new Map(layout.fields.map((field, index) => [field.name, index]));
}

/** The word of an enumeration's value, or the number. */
export function word_of(field, value) {
  if (Number.isNaN(value)) return "";
  return field.words?.[String(Math.round(value))] ?? String(value);
}

function bytes_of_base64(text) {
  const binary = atob(text.trim());
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function unpacked(base64) {
  const stream = new Blob([bytes_of_base64(base64)]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Takes columns off the unpacked bytes: of each, all first bytes, then all second ones (play/packing.h). */
class Columns {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }
  take(count, Numbers) {
    const size = Numbers.BYTES_PER_ELEMENT;
    const out = new Uint8Array(count * size);
    for (let plane = 0; plane < size; ++plane) {
      const begin = this.at + plane * count;
      for (let i = 0, to = plane; i < count; ++i, to += size) out[to] = this.bytes[begin + i];
    }
    this.at += count * size;
    return new Numbers(out.buffer);
  }
}

/** Index of the last of the ascending times that is not after `time_s`; 0 where all are. */
export function index_at(times, time_s) {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time_s) low = middle;
    else high = middle - 1;
  }
  return low;
}

export class LogSource {
  constructor(config, base64) {
    this.live = false;
    this.layout = config.layout;
    this.data = config.data;
    this.base64 = base64;
    this.now = new Float32Array(this.layout.fields.length).fill(NaN);
  }

  async open() {
    const columns = new Columns(await unpacked(this.base64));
    this.base64 = "";
    const {moments, moment_fields, stretches, stretch_fields, cycles_a_stretch} = this.data;
    this.time_s = columns.take(moments, Float64Array);
    this.moments = moment_fields.map((field) => ({field, values: columns.take(moments, Float32Array)}));
    this.stretch_time_s = columns.take(stretches, Float64Array);
    this.stretches = new Map();
    for (const field of stretch_fields) {
      const low = columns.take(stretches, Float32Array);
      const high = cycles_a_stretch > 1 ? columns.take(stretches, Float32Array) : low;
      this.stretches.set(field, {time_s: this.stretch_time_s, low, high});
    }
    this.drawn = new Set(moment_fields);
  }

  range() {
    return [this.time_s[0], this.time_s[this.time_s.length - 1]];
  }

  /** One number for each field of the layout, NaN = not measured. The same array at each call. */
  row(time_s) {
    const stretch = index_at(this.stretch_time_s, time_s);
    for (const [field, {low}] of this.stretches)
      if (!this.drawn.has(field)) this.now[field] = low[stretch];
    const moment = index_at(this.time_s, time_s);
    for (const {field, values} of this.moments) this.now[field] = values[moment];
    return this.now;
  }

  /** All values of a field at the moments that the robot is drawn from, or null. */
  moment_column(field) {
    return this.moments.find((column) => column.field === field)?.values ?? null;
  }

  series(field) {
    return this.stretches.get(field) ?? null;
  }
}

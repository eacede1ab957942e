/** Numbers as the program packs them: 16-bit codes in base64, little-endian; value = offset + scale * code. */
export interface PackedNumbers {
  offset: number;
  scale: number;
  values: string;
}

/** The code of a value that is not known. */
export const missing = -32768;

export function bytesOf(base64: string): Uint8Array {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes;
}

export class Column {
  readonly codes: Int16Array;
  readonly offset: number;
  readonly scale: number;

  constructor(packed: PackedNumbers) {
    this.codes = new Int16Array(bytesOf(packed.values).buffer);
    this.offset = packed.offset;
    this.scale = packed.scale;
  }

  get length(): number {
    return this.codes.length;
  }

  /** NaN where the value is not known. */
  at(index: number): number {
    return this.valueOf(this.codes[index]);
  }

  valueOf(code: number): number {
    return code === missing ? NaN : this.offset + this.scale * code;
  }
}

/** A quantity over time: the smallest and the largest value of each stretch of samples; one column where a stretch is one sample. */
export interface Channel {
  lowest: Column;
  highest: Column;
}

export interface PackedChannel {
  low: PackedNumbers;
  high?: PackedNumbers;
}

export function channelOf(packed: PackedChannel): Channel {
  const lowest = new Column(packed.low);
  return { lowest, highest: packed.high ? new Column(packed.high) : lowest };
}

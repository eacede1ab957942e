/** Times that stay marked, so that what lies between them can be read. */
export interface Marks {
  a: number | null;
  b: number | null;
}

const noMarks: Marks = { a: null, b: null };

/** What of a run all of its plots show, where their common cursor stands, and the two that the reader put down. */
export class View {
  readonly first: number;
  readonly last: number;
  from: number;
  to: number;
  cursor: number | null = null;
  marks: Marks = noMarks;
  private beforeClick: Marks = noMarks;
  private readonly finest: number;
  private readonly rangeListeners: (() => void)[] = [];
  private readonly cursorListeners: (() => void)[] = [];
  private readonly markListeners: (() => void)[] = [];
  private readonly resetListeners: (() => void)[] = [];

  /** `step`: the time between neighbours; zooming in ends at some of them. */
  constructor(first: number, last: number, step: number) {
    // A run of one sample still has a picture.
    this.first = last > first ? first : first - 0.5;
    this.last = last > first ? last : first + 0.5;
    this.finest = Math.min(this.last - this.first, 8 * Math.max(step, 1e-9));
    this.from = this.first;
    this.to = this.last;
  }

  get zoomed(): boolean {
    return this.from > this.first || this.to < this.last;
  }

  onRange(listener: () => void): void {
    this.rangeListeners.push(listener);
  }

  onCursor(listener: () => void): void {
    this.cursorListeners.push(listener);
  }

  onMarks(listener: () => void): void {
    this.markListeners.push(listener);
  }

  /** Before the whole run is shown again. */
  onReset(listener: () => void): void {
    this.resetListeners.push(listener);
  }

  putMarks(marks: Partial<Marks>): void {
    this.marks = { ...this.marks, ...marks };
    for (const listener of this.markListeners) listener();
  }

  clearMarks(): void {
    this.putMarks(noMarks);
  }

  /** The first click puts a, the second b, the third begins again. */
  clickAt(time: number): void {
    this.beforeClick = this.marks;
    if (this.marks.a === null) this.putMarks({ a: time });
    else if (this.marks.b === null) this.putMarks({ b: time });
    else this.putMarks({ a: time, b: null });
  }

  /** Where the click turns out to be half of a double click. */
  undoClick(): void {
    this.putMarks(this.beforeClick);
  }

  zoomTo(from: number, to: number): void {
    const width = Math.min(Math.max(to - from, this.finest), this.last - this.first);
    const centre = 0.5 * (from + to);
    this.from = Math.min(Math.max(centre - 0.5 * width, this.first), this.last - width);
    this.to = this.from + width;
    for (const listener of this.rangeListeners) listener();
  }

  /** `factor` below 1 zooms in; the cursor, or else the middle, stays where it is. */
  zoomBy(factor: number): void {
    const inside = this.cursor !== null && this.cursor >= this.from && this.cursor <= this.to;
    const about = inside ? (this.cursor as number) : 0.5 * (this.from + this.to);
    this.zoomTo(about - (about - this.from) * factor, about + (this.to - about) * factor);
  }

  /** By a share of the width. */
  moveBy(share: number): void {
    const step = share * (this.to - this.from);
    this.zoomTo(this.from + step, this.to + step);
  }

  reset(): void {
    for (const listener of this.resetListeners) listener();
    this.zoomTo(this.first, this.last);
  }

  /** The picture follows where the cursor leaves it. */
  putCursor(time: number | null, follow = false): void {
    this.cursor = time === null ? null : Math.min(Math.max(time, this.first), this.last);
    if (follow && this.cursor !== null) {
      if (this.cursor < this.from) this.zoomTo(this.cursor, this.cursor + (this.to - this.from));
      if (this.cursor > this.to) this.zoomTo(this.cursor - (this.to - this.from), this.cursor);
    }
    for (const listener of this.cursorListeners) listener();
  }
}

/** Each indicator over all valves of a series: its median, how far sisters lie apart, and who differs from them. */
import { inUnit, scaled, short, words } from '../live/api';
import { element, row, setText } from '../live/element';
import { colour } from '../colours';
import { readDistribution, readSeries, type Distribution, type Series, type SeriesIndicator } from './api';

const refresh_ms = 20000;

/** Every valve one point: its value across, valves side by side by their order, outliers in the colour of faults. */
function draw(canvas: HTMLCanvasElement, distribution: Distribution, factor: number, unit: string): void {
  const width = canvas.clientWidth, height = canvas.clientHeight, ratio = devicePixelRatio;
  canvas.width = width * ratio;
  canvas.height = height * ratio;
  const pen = canvas.getContext('2d');
  if (pen === null || distribution.value.length === 0) return;
  pen.scale(ratio, ratio);
  const spread = 10 * distribution.scale;  // what lies beyond is drawn at the margin
  const lowest = Math.max(distribution.value.reduce((a, b) => Math.min(a, b)), distribution.median - spread);
  const highest = Math.min(distribution.value.reduce((a, b) => Math.max(a, b)), distribution.median + spread);
  const span = highest - lowest || Math.abs(highest) || 1;
  const left = 12, right = 12, foot = 26;
  const across = (value: number): number =>
    left + (width - left - right) * (Math.min(Math.max(value, lowest), highest) - lowest + 0.03 * span) / (1.06 * span);
  const line = (value: number, shade: string): void => {
    pen.strokeStyle = shade;
    pen.beginPath();
    pen.moveTo(across(value), 4);
    pen.lineTo(across(value), height - foot);
    pen.stroke();
  };
  line(distribution.median, colour('ink'));
  for (const side of [-3.5, 3.5]) line(distribution.median + side * distribution.scale, colour('rule'));
  distribution.value.forEach((value, k) => {
    const outlying = distribution.outlier[k]!;
    pen.fillStyle = colour(outlying ? 'fault' : 'observer');
    pen.globalAlpha = outlying ? 1 : 0.45;
    const size = outlying ? 5 : 3;
    pen.fillRect(across(value) - size / 2, 6 + (height - foot - 12) * (k + 0.5) / distribution.value.length, size, size);
  });
  pen.globalAlpha = 1;
  pen.fillStyle = colour('soft');
  pen.font = '12px system-ui, sans-serif';
  for (const [value, where] of [[lowest, 'left'], [distribution.median, 'center'], [highest, 'right']] as const) {
    pen.textAlign = where;
    pen.fillText(`${short(factor * value)} ${where === 'center' ? unit : ''}`, across(value), height - 8);
  }
}

export class SeriesView {
  readonly place = element('div', '', element('h2', '', 'Series'));
  private readonly choice = element('select', '');
  private readonly body = element('tbody', '');
  private readonly said = element('p', 'soft');
  private readonly title = element('h3', '');
  private readonly canvas = element('canvas', 'dots');
  private readonly named = element('ul', 'named');
  private series: Series[] = [];
  private indicator = '';
  private asked = -Infinity;
  private drawn: [Distribution, number, string] | null = null;

  constructor() {
    this.choice.addEventListener('change', () => {
      this.indicator = '';
      this.list();
    });
    const head = element('thead', '', row('th', 'indicator', 'valves', 'median', 'scale (1.4826 MAD)', 'unit', 'outliers'));
    this.canvas.setAttribute('role', 'img');
    this.place.append(element('p', 'soft', 'Valves of one series are sisters: the median tells what is usual, the median ' +
      'absolute deviation how far they lie apart. A valve is named where it differs by more than 3.5 scales, and by more than ' +
      'its own uncertainty.'), element('div', 'tools', element('label', '', 'Series ', this.choice)), this.said,
      element('div', 'wide', element('table', 'outlying', head, this.body)), this.title, this.canvas, this.named);
  }

  show(): void {
    if (performance.now() - this.asked > refresh_ms) void this.ask();
  }
  resize(): void {
    if (this.drawn !== null) draw(this.canvas, ...this.drawn);
  }

  private async ask(): Promise<void> {
    this.asked = performance.now();
    try {
      this.series = await readSeries();
    } catch {
      setText(this.said, 'The program does not answer.');
      return;
    }
    setText(this.said, this.series.length === 0 ? 'No indicators are kept yet: they come once a minute.' : '');
    const before = this.choice.value;
    this.choice.replaceChildren(...this.series.map((one) => new Option(one.series, one.series)));
    if (this.series.some((one) => one.series === before)) this.choice.value = before;
    this.list();
  }

  private list(): void {
    const chosen = this.series.find((one) => one.series === this.choice.value);
    if (chosen === undefined) return;
    const most = [...chosen.indicators].sort((a, b) => b.outliers.count - a.outliers.count);
    this.body.replaceChildren(...most.map((one) => this.rowOf(chosen.series, one)));
    const first = most.find((one) => one.name === this.indicator) ?? most[0];
    if (first !== undefined) void this.look(chosen.series, first);
  }

  private rowOf(series: string, one: SeriesIndicator): HTMLTableRowElement {
    const { factor, unit } = inUnit(one);
    const made = row('td', '', String(one.valves), short(scaled(one.median, factor)), short(scaled(one.scale, factor)), unit,
                     String(one.outliers.count));
    const button = element('button', '', words(one.name));
    button.type = 'button';
    made.firstChild!.appendChild(button);
    made.dataset['bad'] = String(one.outliers.count > 0);
    made.addEventListener('click', () => void this.look(series, one));
    return made;
  }

  private async look(series: string, one: SeriesIndicator): Promise<void> {
    this.indicator = one.name;
    const { factor, unit } = inUnit(one);
    setText(this.title, `${words(one.name)}: ${one.outliers.count} of ${one.valves} valves differ from their sisters`);
    this.named.replaceChildren(...one.outliers.named.map((each) => {
      const link = element('a', '', each.valve);
      link.href = `#/valve/${encodeURIComponent(each.valve)}`;
      return element('li', '', link, ` ${short(scaled(each.value, factor))} ${unit} (${each.score > 0 ? '+' : '−'}${Math.abs(each.score).toFixed(1)})`);
    }));
    try {
      const distribution = await readDistribution(series, one.name);
      if (this.indicator !== one.name) return;
      this.canvas.setAttribute('aria-label', `${words(one.name)} of ${distribution.value.length} valves about ${short(factor * distribution.median)} ${unit}`);
      this.drawn = [distribution, factor, unit];
      draw(this.canvas, ...this.drawn);
    } catch {
      setText(this.said, 'The program does not answer.');
    }
  }
}

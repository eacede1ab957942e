/** The virtual valve to play with. */
import { button, element } from '../element';
import { numberText } from '../number_text';
import { onThemeChange } from '../theme';
import type { Engine } from './engine';
import { ValvePlot, type PlayedColumns } from './valve_plot';

interface Slider {
  key: string;
  label: string;
  unit: string;
  from: number;
  to: number;
  step: number;
  value: number;
}

const sliders: Slider[] = [
  { key: 'command_percent', label: 'Command', unit: '%', from: 0, to: 100, step: 1, value: 50 },
  { key: 'pressure_bar', label: 'Pressure difference', unit: 'bar', from: 5, to: 70, step: 1, value: 60 },
  { key: 'oil_C', label: 'Oil temperature', unit: '°C', from: 20, to: 80, step: 1, value: 50 },
  { key: 'edge_rounding_um', label: 'Wear: edges rounded by', unit: 'µm', from: 0, to: 80, step: 1, value: 0 },
  { key: 'friction_factor', label: 'Friction, times the new valve’s', unit: '', from: 0.5, to: 4, step: 0.1, value: 1 },
  { key: 'dither_A', label: 'Dither amplitude', unit: 'A', from: 0, to: 0.3, step: 0.01, value: 0 },
  { key: 'dither_Hz', label: 'Dither frequency', unit: 'Hz', from: 50, to: 250, step: 5, value: 140 },
];
const piece_s = 0.05, strokePeriod_s = 6;

export class ValveView {
  readonly root = element('section', 'valve');
  private readonly plot = new ValvePlot();
  private readonly inputs = new Map<string, HTMLInputElement>();
  private readonly numbers = element('dl', 'numbers');
  private readonly statusLine = element('p', 'status-line');
  private readonly moves = element('input', '');
  private readonly pause: HTMLButtonElement;
  private running = false;
  private worked_s = 0;
  private visible = true;

  constructor(private readonly engine: Engine, private readonly model: string) {
    const controls = element('div', 'sliders');
    for (const slider of sliders) controls.append(this.control(slider));
    this.moves.type = 'checkbox';
    this.moves.checked = true;
    this.moves.name = 'moves';
    const moves = element('label', 'check');
    moves.append(this.moves, ' the command moves to and fro by itself');
    this.pause = button('Pause', 'Stop the valve, or let it go on', () => this.toggle());
    const again = button('New valve', 'Begin again with a valve as new', () => void this.begin());
    const tools = element('div', 'tools');
    tools.append(this.pause, again, moves);
    const legend = element('p', 'legend');
    legend.innerHTML = '<span class="key estimated"></span>estimated, with its 95 % band <span class="key truly"></span>true flow, which the sensor never reads';
    const figure = element('div', 'figure');
    figure.append(legend, this.plot.canvas, this.numbers, this.statusLine);
    this.statusLine.setAttribute('aria-live', 'off');
    const sides = element('div', 'sides');
    sides.append(controls, figure);
    this.root.append(tools, sides);
    onThemeChange(() => this.plot.draw());
    new ResizeObserver(() => this.plot.draw()).observe(this.plot.canvas);
    new IntersectionObserver((entries) => { this.visible = entries.some((each) => each.isIntersecting); }).observe(this.root);
  }

  async begin(): Promise<void> {
    for (const slider of sliders) this.set(slider.key, slider.value);
    await this.engine.answer({ work: 'play_begin', model: this.model });
    this.plot.clear();
    this.worked_s = 0;
    if (!this.running) this.toggle();
  }

  private control(slider: Slider): HTMLElement {
    const label = element('label', 'slider');
    const name = element('span', '');
    name.textContent = slider.label;
    const value = element('output', '');
    const input = element('input', '');
    input.type = 'range';
    input.name = slider.key;
    input.min = String(slider.from);
    input.max = String(slider.to);
    input.step = String(slider.step);
    input.value = String(slider.value);
    const show = (): void => { value.textContent = `${input.value} ${slider.unit}`; };
    input.addEventListener('input', () => {
      show();
      if (slider.key === 'command_percent') this.moves.checked = false;
    });
    input.addEventListener('spoolflow-set', show);
    show();
    label.append(name, value, input);
    this.inputs.set(slider.key, input);
    return label;
  }

  private set(key: string, value: number): void {
    const input = this.inputs.get(key) as HTMLInputElement;
    input.value = String(value);
    input.dispatchEvent(new Event('spoolflow-set'));
  }

  private toggle(): void {
    this.running = !this.running;
    this.pause.textContent = this.running ? 'Pause' : 'Go on';
    if (this.running) void this.work();
  }

  private asked(): Record<string, number> {
    if (this.moves.checked) {
      const phase = (this.worked_s % strokePeriod_s) / strokePeriod_s;
      this.set('command_percent', Math.round(10 + 80 * (1 - Math.abs(2 * phase - 1))));
    }
    return Object.fromEntries([...this.inputs].map(([key, input]) => [key, Number(input.value)]));
  }

  /** Piece by piece, no faster than time goes by. */
  private async work(): Promise<void> {
    const begun_ms = performance.now();
    const from_s = this.worked_s;
    while (this.running) {
      const due_ms = 1000 * (this.worked_s - from_s) - (performance.now() - begun_ms);
      if (due_ms > 0 || !this.visible || document.hidden) await new Promise((resolve) => setTimeout(resolve, Math.max(10, due_ms)));
      if (!this.visible || document.hidden) continue;
      try {
        const samples = await this.engine.answer<PlayedColumns>({ work: 'play', duration_s: piece_s, ...this.asked() });
        this.worked_s += piece_s;
        this.plot.add(samples);
        this.plot.draw();
        this.show(samples);
      } catch (error) {
        this.running = false;
        this.pause.textContent = 'Go on';
        this.statusLine.textContent = (error as Error).message;
      }
    }
  }

  private show(samples: PlayedColumns): void {
    const last = <Name extends Exclude<keyof PlayedColumns, 'status'>>(name: Name): number => samples[name][samples[name].length - 1];
    const rows: [string, string][] = [
      ['estimated', `${numberText(last('flow_L_min'), 1)} L/min`],
      ['95 % band', `${numberText(last('flow_lower_L_min'), 1)} to ${numberText(last('flow_upper_L_min'), 1)} L/min`],
      ['true', `${numberText(last('true_flow_L_min'), 1)} L/min`],
      ['current', `${numberText(last('current_A'), 2)} A`],
    ];
    this.numbers.replaceChildren(...rows.flatMap(([name, value]) => {
      const term = element('dt', ''), definition = element('dd', '');
      term.textContent = name;
      definition.textContent = value;
      return [term, definition];
    }));
    this.statusLine.textContent = `status: ${samples.status === '' ? 'all is well' : samples.status.replace(/\|/g, ', ')}`;
    this.root.dataset.worked = this.worked_s.toFixed(2);
    this.root.dataset.flow = String(last('flow_L_min'));
    this.root.dataset.truth = String(last('true_flow_L_min'));
  }
}

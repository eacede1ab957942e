/** The reader's files: what each is, what inspect says of it, and what the program makes of it. */
import { button, element } from '../element';
import { save } from '../saved_file';
import type { Engine } from './engine';
import { MapTable } from './map_table';
import { chosen, dropped, type TakenFile } from './taken_files';

type Kind = 'recording' | 'model' | 'campaign' | 'map' | 'other';
interface Known {
  name: string;
  bytes: number;
  kind: Kind;
  /** The map that this recording is read with; empty: by its own headers. */
  map: string;
}
interface Inspected {
  text: string;
  inspection: { columns: string[]; channels: unknown[]; missing: string[]; helpful: string[]; proposed_channel_map: string };
}
interface Judged {
  sentence: string;
  limits?: string[];
  notes?: string[];
  doubts?: string[];
  summary?: { direction: string; of: string; value: string; unit: string; usual: boolean; usually: string }[];
}

const exampleScenario = 'protocol = "duty_cycle"\nvalve = "size_6"\nseed = 7\n[run]\nduration_s = 20\n';

function kindOf(name: string, beginning: string): Kind {
  if (/\.json$/i.test(name)) return 'model';
  if (/\.toml$/i.test(name)) return beginning.includes('[valve]') || beginning.includes('[[recording]]') ? 'campaign' : 'map';
  if (/\.(csv|txt|tsv|dat|mat|h5|hdf5)$/i.test(name)) return 'recording';
  return 'other';
}

export class FilesView {
  readonly root = element('section', 'files');
  private readonly known = new Map<string, Known>();
  private readonly list = element('ul', 'file-list');
  private readonly models = element('select', '');
  private readonly detail = element('div', 'detail');
  private readonly result = element('div', 'result');
  private readonly bar = element('progress', '');
  private readonly step = element('span', 'step');
  private readonly fault = element('p', 'fault');
  private busy = false;
  private shown = '';

  constructor(private readonly engine: Promise<Engine>, exampleModel: string) {
    this.models.name = 'model';
    this.models.add(new Option('example model of the virtual valve', exampleModel));
    this.bar.max = 1;
    this.bar.setAttribute('aria-label', 'progress');
    this.fault.setAttribute('role', 'alert');
    const working = element('p', 'working');
    working.append(this.bar, this.step);
    working.hidden = true;
    this.root.append(this.dropPlace(), this.list, this.modelLine(), working, this.fault, this.detail, this.result);
    this.showList();
  }

  private dropPlace(): HTMLElement {
    const place = element('div', 'drop');
    const files = element('input', 'unseen'), folder = element('input', 'unseen');
    for (const input of [files, folder]) {
      input.type = 'file';
      input.multiple = true;
      input.tabIndex = -1;
      input.addEventListener('change', () => {
        void this.take(chosen(input.files as FileList)).then(() => { input.value = ''; });
      });
    }
    files.name = 'files';
    files.setAttribute('aria-label', 'files');
    folder.name = 'folder';
    folder.setAttribute('aria-label', 'folder');
    folder.webkitdirectory = true;
    const says = element('p', '');
    says.textContent = 'Drop recordings (CSV), a model (JSON) or the whole folder of a campaign here, or';
    const tools = element('div', 'tools');
    tools.append(button('Choose files', 'Choose recordings, models or channel maps', () => files.click()),
      button('Choose a folder', 'Choose the folder of a campaign', () => folder.click()),
      button('Make an example', 'Let the virtual valve make a recording of 20 s', () => void this.makeExample()));
    place.append(says, tools, files, folder);
    for (const kind of ['dragenter', 'dragover'] as const) {
      place.addEventListener(kind, (event) => {
        event.preventDefault();
        place.classList.add('over');
      });
    }
    place.addEventListener('dragleave', () => place.classList.remove('over'));
    place.addEventListener('drop', (event) => {
      event.preventDefault();
      place.classList.remove('over');
      if (event.dataTransfer) {
        dropped(event.dataTransfer).then((taken) => this.take(taken), (error: Error) => {
          this.fault.textContent = `the browser does not open what was dropped (${error.message}); choose it by the buttons`;
        });
      }
    });
    return place;
  }

  private modelLine(): HTMLElement {
    const label = element('label', 'model-line');
    label.append('Model ', this.models);
    return label;
  }

  private async take(taken: TakenFile[]): Promise<void> {
    let first = '';
    await this.working(async () => {
      for (const { name, file } of taken) {
        const bytes = await file.arrayBuffer();
        const kind = kindOf(name, new TextDecoder().decode(bytes.slice(0, 4096)));
        if (kind === 'other') continue;
        this.showProgress(0, `reading ${name}`);
        this.add({ name, bytes: bytes.byteLength, kind, map: '' });
        await (await this.engine).write(name, bytes);
        const rank = (each: string): number => ['campaign', 'recording'].indexOf(this.known.get(each)?.kind ?? '');
        if (kind !== 'map' && (first === '' || (kind === 'campaign' && rank(first) !== 0))) first = name;
      }
      if (taken.length > 0 && first === '') throw new Error('none of these is a recording (.csv), a model (.json), a campaign or a channel map (.toml)');
    });
    if (first !== '') await this.show(first);
  }

  private add(file: Known): void {
    this.known.set(file.name, file);
    if (file.kind === 'model') {
      if (![...this.models.options].some((option) => option.value === file.name)) this.models.add(new Option(file.name, file.name));
      this.models.value = file.name;
    }
    this.showList();
  }

  private showList(): void {
    const order: Kind[] = ['campaign', 'model', 'map', 'recording', 'other'];
    const files = [...this.known.values()].sort((a, b) => order.indexOf(a.kind) - order.indexOf(b.kind) || a.name.localeCompare(b.name));
    this.list.hidden = files.length === 0;
    this.list.replaceChildren(...files.map((file) => {
      const line = element('li', '');
      const open = element('button', 'file');
      open.type = 'button';
      open.textContent = file.name;
      if (file.name === this.shown) open.setAttribute('aria-current', 'true');
      open.addEventListener('click', () => void this.show(file.name));
      const about = element('span', 'soft');
      about.textContent = `${file.kind}, ${(file.bytes / 1e6).toFixed(file.bytes < 1e5 ? 3 : 1)} MB`;
      line.append(open, about);
      return line;
    }));
  }

  private showProgress(share: number, step: string): void {
    this.bar.value = share;
    this.step.textContent = step === '' ? '' : `${step} ${share > 0 ? `${Math.round(100 * share)} %` : ''}`;
  }

  /** One piece of work at a time; what fails is reported in the program's own words. */
  private async working(work: () => Promise<void>): Promise<void> {
    if (this.busy) return;
    this.busy = true;
    this.root.setAttribute('aria-busy', 'true');
    (this.bar.parentElement as HTMLElement).hidden = false;
    this.fault.textContent = '';
    this.showProgress(0, '');
    try {
      await work();
    } catch (error) {
      this.fault.textContent = (error as Error).message;
    }
    (this.bar.parentElement as HTMLElement).hidden = true;
    this.root.removeAttribute('aria-busy');
    this.busy = false;
  }

  private readonly progress = (share: number, step: string): void => this.showProgress(share, step);

  private async makeExample(): Promise<void> {
    const name = 'example.csv';
    await this.working(async () => {
      await (await this.engine).write('example.toml', new TextEncoder().encode(exampleScenario).buffer);
      await (await this.engine).answer({ work: 'simulate', scenario: 'example.toml', recording: name, truth: 'example_truth.csv' }, this.progress);
      const bytes = await (await this.engine).read(name);
      this.add({ name, bytes: bytes.byteLength, kind: 'recording', map: '' });
    });
    await this.show(name);
  }

  private async show(name: string): Promise<void> {
    const file = this.known.get(name);
    if (file === undefined || this.busy) return;
    this.shown = name;
    this.showList();
    this.result.replaceChildren();
    this.detail.replaceChildren();
    if (file.kind === 'recording') await this.working(() => this.inspect(file));
    else if (file.kind === 'campaign') this.showCampaign(file);
    else if (file.kind === 'model') this.models.value = name;
  }

  private heading(text: string): HTMLElement {
    const out = element('h3', '');
    out.textContent = text;
    return out;
  }

  private async inspect(file: Known): Promise<void> {
    const { text, inspection } = await (await this.engine).answer<Inspected>({ work: 'inspect', file: file.name, channels: file.map }, this.progress);
    const said = element('pre', 'said');
    const cut = text.indexOf('Proposed channel map');
    said.textContent = (cut < 0 ? text : text.slice(0, cut)).trimEnd();
    said.tabIndex = 0;
    const tools = element('div', 'tools');
    const readable = inspection.channels.length > 0;
    if (readable) {
      tools.append(button('Estimate', 'Estimate the flow rate with the model', () => void this.working(() => this.estimate(file))),
        button('Validate', 'Compare with the reference flow, as a report', () => void this.working(() => this.validate(file))));
    }
    this.detail.replaceChildren(this.heading(`${file.name}: what inspect says`), said, this.mapEditor(file, inspection, !readable || inspection.missing.length > 0), tools);
  }

  private mapEditor(file: Known, inspection: Inspected['inspection'], open: boolean): HTMLElement {
    const out = element('details', 'map');
    out.open = open && file.map === '';
    const title = document.createElement('summary');
    title.textContent = file.map === '' ? 'Channel map: as proposed, to be mended by hand' : 'Channel map: the file is read with this one';
    const text = element('textarea', '');
    text.setAttribute('aria-label', 'channel map (TOML)');
    text.spellcheck = false;
    text.value = inspection.proposed_channel_map;
    const table = new MapTable(inspection.columns, [...inspection.missing, ...inspection.helpful], text);
    const put = (bytes: ArrayBuffer): void => {
      text.value = new TextDecoder().decode(bytes);
      table.read();
    };
    if (file.map !== '') void this.engine.then((engine) => engine.read(file.map)).then(put);
    text.rows = Math.min(18, text.value.split('\n').length + 1);
    const tools = element('div', 'tools');
    const read = button('Read with this map', 'Read the recording with this channel map', () => void this.working(async () => {
      const before = file.map;
      file.map = `${file.name}.map.toml`;
      await (await this.engine).write(file.map, new TextEncoder().encode(text.value).buffer);
      try {
        await this.inspect(file);
      } catch (error) {
        file.map = before;
        throw error;
      }
    }));
    tools.append(read, button('Save the map', 'Save the channel map as TOML', () => save(new Blob([text.value]), 'map.toml')));
    for (const map of [...this.known.values()].filter((each) => each.kind === 'map')) {
      tools.append(button(`Take ${map.name}`, 'Take the map from this file', () => void this.engine.then((engine) => engine.read(map.name)).then(put)));
    }
    const written = element('details', 'as-text');
    const says = document.createElement('summary');
    says.textContent = 'The same as text (TOML)';
    written.append(says, text);
    const wide = element('div', 'wide');
    wide.append(table.root);
    out.append(title, wide, written, tools);
    return out;
  }

  private saving(text: string, name: string, type: string): HTMLElement {
    return button(text, `Save ${name.split('/').pop() as string}`, () => void this.engine.then((engine) => engine.read(name)).then((bytes) => {
      save(new Blob([bytes], { type }), name.split('/').pop() as string);
    }));
  }

  private judgement(title: string, judged: Judged, tools: HTMLElement[]): void {
    const sentence = element('p', 'sentence');
    sentence.textContent = judged.sentence;
    const lines = element('ul', 'lines');
    const line = (text: string, doubt: boolean): void => {
      const item = element('li', doubt ? 'doubt' : '');
      item.textContent = doubt ? `doubt: ${text}` : text;
      lines.append(item);
    };
    for (const text of judged.doubts ?? []) line(text, true);
    for (const text of [...(judged.notes ?? []), ...(judged.limits ?? [])]) line(text, false);
    const row = element('div', 'tools');
    row.append(...tools);
    this.result.replaceChildren(this.heading(title), sentence, lines, row);
  }

  private async estimate(file: Known): Promise<void> {
    const output = `${file.name.replace(/\.[^./]*$/, '')}_estimate.csv`;
    const judged = await (await this.engine).answer<Judged>(
      { work: 'estimate', model: this.models.value, recording: file.name, channels: file.map, output }, this.progress);
    this.judgement('Estimate', judged, [this.saving('Save the estimate (CSV)', output, 'text/csv')]);
    await this.report(file);
  }

  private async validate(file: Known): Promise<void> {
    const { judged, report, metrics } = await this.judged(file);
    this.judgement('Validation', judged, [this.saving('Save the report (HTML)', report, 'text/html'), this.saving('Save the figures (JSON)', metrics, 'application/json')]);
    await this.showReport(report);
  }

  private async judged(file: Known): Promise<{ judged: Judged; report: string; metrics: string }> {
    const stem = file.name.replace(/\.[^./]*$/, '');
    const [report, metrics] = [`${stem}_report.html`, `${stem}_metrics.json`];
    const judged = await (await this.engine).answer<Judged>(
      { work: 'validate', model: this.models.value, recordings: [file.name], channels: file.map, report, metrics }, this.progress);
    return { judged, report, metrics };
  }

  private async report(file: Known): Promise<void> {
    await this.showReport((await this.judged(file)).report);
  }

  /** The program's own page, shut off from this one. */
  private async showReport(name: string): Promise<void> {
    const frame = element('iframe', 'report');
    frame.title = 'report';
    frame.setAttribute('sandbox', 'allow-scripts allow-downloads');
    frame.srcdoc = new TextDecoder().decode(await (await this.engine).read(name));
    this.result.append(frame);
  }

  private showCampaign(file: Known): void {
    const says = element('p', '');
    says.textContent = 'A campaign: its bench recordings become a model of the valve. This takes some seconds to minutes, and the page stays alive.';
    const despite = element('input', '');
    despite.type = 'checkbox';
    despite.name = 'despite_doubts';
    const label = element('label', 'check');
    label.append(despite, ' despite contradictions');
    const tools = element('div', 'tools');
    tools.append(button('Calibrate', 'Make the valve’s model', () => void this.working(() => this.calibrate(file, despite.checked))), label);
    this.detail.replaceChildren(this.heading(file.name), says, tools);
  }

  private async calibrate(file: Known, despite: boolean): Promise<void> {
    const folder = file.name.includes('/') ? file.name.slice(0, file.name.lastIndexOf('/')) : 'campaign';
    const model = `${folder.replace(/\//g, '_')}_model.json`, report = `${folder.replace(/\//g, '_')}_calibration.html`;
    const judged = await (await this.engine).answer<Judged>({ work: 'calibrate', campaign: file.name, model, report, despite_doubts: despite }, this.progress);
    const bytes = await (await this.engine).read(model);
    this.add({ name: model, bytes: bytes.byteLength, kind: 'model', map: '' });
    this.judgement('Calibration', judged, [this.saving('Save the model (JSON)', model, 'application/json'), this.saving('Save the report (HTML)', report, 'text/html')]);
    const table = element('table', 'summary');
    for (const line of judged.summary ?? []) {
      const row = table.insertRow();
      if (!line.usual) row.dataset.unusual = 'true';
      for (const text of [`${line.direction} ${line.of}`.trim(), `${line.value} ${line.unit}`, `usually ${line.usually}`]) row.insertCell().textContent = text;
    }
    const wide = element('div', 'wide');
    wide.append(table);
    this.result.append(wide);
    await this.showReport(report);
  }
}

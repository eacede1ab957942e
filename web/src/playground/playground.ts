/** spoolflow in the reader's own browser: files, and a virtual valve to play with. Nothing is asked of any network. */
import { themeControl } from '../theme';
import { carried, Engine, unpacked } from './engine';
import { FilesView } from './files_view';
import { ValveView } from './valve_view';

const model = 'example_model.json';

function views(files: FilesView, valve: ValveView): void {
  const both: [string, HTMLElement][] = [['#valve', valve.root], ['#files', files.root]];
  const show = (): void => {
    const wanted = both.some(([name]) => name === location.hash) ? location.hash : '#valve';
    for (const [name, view] of both) {
      view.hidden = name !== wanted;
      const link = document.querySelector(`nav a[href="${name}"]`) as HTMLElement;
      if (name === wanted) link.setAttribute('aria-current', 'page');
      else link.removeAttribute('aria-current');
    }
  };
  addEventListener('hashchange', show);
  show();
}

async function begin(): Promise<void> {
  document.getElementById('controls')?.append(themeControl());
  const main = document.getElementById('view') as HTMLElement;
  try {
    const parts = await unpacked();
    // The valve has a program of its own, so that it goes on while files are at work.
    const started = async (): Promise<Engine> => {
      const engine = await Engine.started(parts);
      await engine.write(model, await carried('model'));
      return engine;
    };
    const valve = new ValveView(await started(), model);
    const files = new FilesView(started(), model);
    main.replaceChildren(valve.root, files.root);
    views(files, valve);
    await valve.begin();
    document.documentElement.dataset.ready = String(Math.round(performance.now()));
  } catch (error) {
    const message = document.createElement('p');
    message.className = 'fault';
    message.textContent = `The program could not be started: ${(error as Error).message}. It needs a browser with WebAssembly exceptions and DecompressionStream: Chromium 95, Firefox 113, Safari 16.4 or later.`;
    main.replaceChildren(message);
  }
}

void begin();

/** The program at work beside the page: files in, answers and files out. */
import type { Asked, Reply } from './requests';

interface Program {
  FS: {
    mkdirTree(path: string): void;
    chdir(path: string): void;
    writeFile(path: string, bytes: Uint8Array): void;
    readFile(path: string): Uint8Array<ArrayBuffer>;
  };
  _malloc(bytes: number): number;
  _free(at: number): void;
  _spoolflow_answer(at: number): number;
  UTF8ToString(at: number): string;
  stringToUTF8(text: string, at: number, room: number): void;
  lengthBytesUTF8(text: string): number;
}
declare const spoolflowModule: (options: object) => Promise<Program>;
const send = self.postMessage.bind(self) as unknown as (message: Reply, transfer?: Transferable[]) => void;

const folder = '/work';
const progressEvery_ms = 60;
let program: Program | null = null;
let now = 0, lastProgress_ms = 0;

function progress(share: number, step: string): void {
  const time_ms = performance.now();
  if (time_ms - lastProgress_ms < progressEvery_ms && share < 1) return;
  lastProgress_ms = time_ms;
  send({ number: now, progress: { share, step } });
}

/** `compiled` once by the page, for all its workers. */
async function start(compiled: WebAssembly.Module): Promise<void> {
  program = await spoolflowModule({
    progress,
    noInitialRun: true,
    instantiateWasm: (imports: WebAssembly.Imports, receive: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void) => {
      void WebAssembly.instantiate(compiled, imports).then((instance) => receive(instance, compiled));
      return {};
    },
  });
  program.FS.mkdirTree(folder);
  program.FS.chdir(folder);
}

function answered(running: Program, request: object): Record<string, unknown> {
  const text = JSON.stringify(request);
  const room = running.lengthBytesUTF8(text) + 1;
  const at = running._malloc(room);
  running.stringToUTF8(text, at, room);
  try {
    return JSON.parse(running.UTF8ToString(running._spoolflow_answer(at))) as Record<string, unknown>;
  } finally {
    running._free(at);
  }
}

function work(asked: Asked): void {
  const { number } = asked;
  const running = program as Program;
  const name = asked.name ?? '';
  if (asked.kind === 'write') {
    const slash = name.lastIndexOf('/');
    if (slash > 0) running.FS.mkdirTree(`${folder}/${name.slice(0, slash)}`);
    running.FS.writeFile(name, new Uint8Array(asked.bytes as ArrayBuffer));
    send({ number });
  } else if (asked.kind === 'read') {
    const bytes = running.FS.readFile(name).slice().buffer;
    send({ number, bytes }, [bytes]);
  } else {
    const answer = answered(running, asked.request as object);
    if (typeof answer.error === 'string') send({ number, error: answer.error });
    else send({ number, answer });
  }
}

self.addEventListener('message', (event: MessageEvent<Asked>) => {
  const asked = event.data;
  now = asked.number;
  void (async () => {
    try {
      if (asked.kind === 'start') {
        await start(asked.program as WebAssembly.Module);
        send({ number: asked.number });
      } else {
        work(asked);
      }
    } catch (error) {
      send({ number: asked.number, error: `the program stopped: ${String(error)}; load the page again` });
    }
  })();
});

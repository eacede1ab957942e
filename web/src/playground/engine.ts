/** The program in its worker, from what the page carries: nothing is asked of any network. */
import type { Asked, Reply } from './requests';

export type Progress = (share: number, step: string) => void;
interface Waiting {
  resolve(reply: Reply): void;
  reject(error: Error): void;
  progress: Progress | undefined;
}

/** The bytes of one of the page's parts: gzip as base64 in an element that is no script. */
export async function carried(id: string): Promise<ArrayBuffer> {
  const text = (document.getElementById(id) as HTMLElement).textContent as string;
  const letters = atob(text.trim());
  const bytes = new Uint8Array(letters.length);
  for (let k = 0; k < letters.length; ++k) bytes[k] = letters.charCodeAt(k);
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'))).arrayBuffer();
}

/** The worker's script, and the program compiled once for all workers. */
export interface Carried {
  script: ArrayBuffer;
  program: WebAssembly.Module;
}
export async function unpacked(): Promise<Carried> {
  const [script, program] = await Promise.all([carried('worker'), carried('program').then((bytes) => WebAssembly.compile(bytes))]);
  return { script, program };
}

export class Engine {
  private readonly waiting = new Map<number, Waiting>();
  private number = 0;

  private constructor(private readonly worker: Worker) {
    worker.addEventListener('message', (event: MessageEvent<Reply>) => this.hear(event.data));
    worker.addEventListener('error', (event) => {
      for (const each of this.waiting.values()) each.reject(new Error(event.message));
      this.waiting.clear();
    });
  }

  /** In a worker of its own. */
  static async started({ script, program }: Carried): Promise<Engine> {
    const url = URL.createObjectURL(new Blob([script], { type: 'text/javascript' }));
    const engine = new Engine(new Worker(url));
    await engine.ask({ kind: 'start', program });
    URL.revokeObjectURL(url);
    return engine;
  }

  async write(name: string, bytes: ArrayBuffer): Promise<void> {
    await this.ask({ kind: 'write', name, bytes }, [bytes]);
  }
  async read(name: string): Promise<ArrayBuffer> {
    return (await this.ask({ kind: 'read', name })).bytes as ArrayBuffer;
  }
  /** Throws with the program's own words. */
  async answer<Answer>(request: Record<string, unknown>, progress?: Progress): Promise<Answer> {
    return (await this.ask({ kind: 'answer', request }, [], progress)).answer as Answer;
  }

  private ask(asked: Omit<Asked, 'number'>, transfer: Transferable[] = [], progress?: Progress): Promise<Reply> {
    const number = ++this.number;
    return new Promise((resolve, reject) => {
      this.waiting.set(number, { resolve, reject, progress });
      this.worker.postMessage({ ...asked, number }, transfer);
    });
  }

  private hear(reply: Reply): void {
    const waiting = this.waiting.get(reply.number);
    if (waiting === undefined) return;
    if (reply.progress) {
      waiting.progress?.(reply.progress.share, reply.progress.step);
      return;
    }
    this.waiting.delete(reply.number);
    if (reply.error === undefined) waiting.resolve(reply);
    else waiting.reject(new Error(reply.error));
  }
}

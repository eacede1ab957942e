/** What the page and its worker send each other. Files are paths in the worker's own folder, in memory. */
export interface Asked {
  number: number;
  /** `start` brings the program, `write` a file, `read` takes one, `answer` does work (addons/playground/requests/playground.hpp). */
  kind: 'start' | 'write' | 'read' | 'answer';
  name?: string;
  bytes?: ArrayBuffer;
  program?: WebAssembly.Module;
  request?: Record<string, unknown>;
}

export interface Reply {
  number: number;
  answer?: Record<string, unknown>;
  bytes?: ArrayBuffer;
  error?: string;
  progress?: { share: number; step: string };
}

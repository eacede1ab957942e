/** Files that the reader takes from the page; they are made in the browser, nothing is asked for. */
const keep_ms = 60_000;

/** A run's name as part of a file's. */
export function fileName(run: string, what: string): string {
  const safe = run.replace(/[^\p{L}\p{N}._-]+/gu, '_').replace(/^\.+/, '');
  return `${safe === '' ? 'run' : safe}_${what}`;
}

export function save(content: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), keep_ms);
}

/** Files as the reader gives them: chosen, a folder of them, or dropped. */
export interface TakenFile {
  /** With its folders: `valve_a/ramp.csv`. */
  name: string;
  file: File;
}

async function ofEntry(entry: FileSystemEntry, folder: string): Promise<TakenFile[]> {
  if (entry.isFile) {
    const file = await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject));
    return [{ name: folder + entry.name, file }];
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  const out: TakenFile[] = [];
  for (;;) {  // a folder is listed in pieces
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return out;
    for (const each of some) out.push(...await ofEntry(each, `${folder}${entry.name}/`));
  }
}

/** Chromium's way to folders, the only one that it allows a page that was opened from a file. */
async function ofHandle(handle: FileSystemHandle, folder: string): Promise<TakenFile[]> {
  if (handle.kind === 'file') return [{ name: folder + handle.name, file: await (handle as FileSystemFileHandle).getFile() }];
  const out: TakenFile[] = [];
  const inside = (handle as unknown as { values(): AsyncIterable<FileSystemHandle> }).values();
  for await (const each of inside) out.push(...await ofHandle(each, `${folder}${handle.name}/`));
  return out;
}

/** What was dropped has to be asked for at once: once the event is over, its items are gone. */
export async function dropped(data: DataTransfer): Promise<TakenFile[]> {
  const items = [...data.items].filter((item) => item.kind === 'file').map((item) => ({
    entry: item.webkitGetAsEntry(),
    file: item.getAsFile(),
    handle: (item as unknown as { getAsFileSystemHandle?: () => Promise<FileSystemHandle | null> }).getAsFileSystemHandle?.(),
  }));
  const taken = await Promise.all(items.map(async ({ entry, file, handle }) => {
    if (entry === null || entry.isFile) return file === null ? [] : [{ name: file.name, file }];
    const opened = await handle?.catch(() => null);
    return opened ? ofHandle(opened, '') : ofEntry(entry, '');
  }));
  return taken.flat();
}

export function chosen(files: FileList): TakenFile[] {
  return [...files].map((file) => ({ name: file.webkitRelativePath || file.name, file }));
}

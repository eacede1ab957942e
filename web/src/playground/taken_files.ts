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
  for (;;) {  // a folder is told in pieces
    const some = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (some.length === 0) return out;
    for (const each of some) out.push(...await ofEntry(each, `${folder}${entry.name}/`));
  }
}

export async function dropped(data: DataTransfer): Promise<TakenFile[]> {
  const entries = [...data.items].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
  return (await Promise.all(entries.map((entry) => ofEntry(entry, '')))).flat();
}

export function chosen(files: FileList): TakenFile[] {
  return [...files].map((file) => ({ name: file.webkitRelativePath || file.name, file }));
}

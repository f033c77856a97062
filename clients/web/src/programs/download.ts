// Hands a file of the API to the browser. A plain link could not carry the sign-in.
import { fetchApi } from '../api/request';

export async function download(path: string, name: string): Promise<void> {
  save(await (await fetchApi('GET', path)).blob(), name);
}

export function saveText(text: string, name: string): void {
  save(new Blob([text]), name);
}

function save(blob: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}
